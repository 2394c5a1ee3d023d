//! Who logs in with a password.

use espalier_proto::access::Role;

use super::{StoreError, folded};

/// Keeps users. Two whose names differ in large and small letters or accents alone would be taken for each other, so their
/// names are one.
pub trait Users {
    /// Adds somebody; [`StoreError::Taken`] where somebody goes by the name already.
    async fn add_user(&self, user: User) -> Result<(), StoreError>;

    /// Whoever goes by a name.
    async fn user(&self, name: &str) -> Result<Option<User>, StoreError>;

    /// All of them, by name.
    async fn users(&self) -> Result<Vec<User>, StoreError>;

    /// Changes somebody; whether they are there.
    async fn change_user(&self, name: &str, change: UserChange) -> Result<bool, StoreError>;

    /// Removes somebody with all their logins, what sessions they were in, and what they have read; whether they were there.
    async fn remove_user(&self, name: &str) -> Result<bool, StoreError>;
}

/// Whom what a user does counts for, by their name.
pub fn person_of(user: &str) -> String {
    format!("login {}", folded(user))
}

/// Somebody who logs in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct User {
    /// What they are called, and log in by.
    pub name: String,
    /// What they may do by themselves.
    pub role: Role,
    /// The most that a group of theirs lets them do; it is not kept here.
    pub group_role: Option<Role>,
    /// What is kept of their password.
    pub password: String,
    /// When they were added.
    pub created_at: String,
}

impl User {
    /// What they may do.
    pub fn allowed(&self) -> Role {
        self.group_role.map_or(self.role, |role| role.max(self.role))
    }
}

/// What changes of somebody.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UserChange {
    /// What they may do, from now on and wherever they are logged in.
    Role(Role),
    /// What is kept of their password; all their logins end.
    Password(String),
}
