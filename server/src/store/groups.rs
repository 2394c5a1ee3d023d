//! Users who have a role together: a studio, a class, those who only look.

use espalier_proto::access::Role;

use super::StoreError;

/// Keeps groups of users. Their names are compared as those of users are. A change may hold for one revision alone; at
/// another one it is [`StoreError::Stale`].
pub trait Groups {
    /// Adds a group without members; [`StoreError::Taken`] where one goes by the name.
    async fn add_group(&self, group: Group) -> Result<(), StoreError>;

    /// All of them, by name, each with its members, by name.
    async fn groups(&self) -> Result<Vec<Group>, StoreError>;

    /// Changes the group with this identifier; whether it is there.
    async fn change_group(
        &self,
        id: &str,
        change: GroupChange,
        expected: Option<u64>,
    ) -> Result<bool, StoreError>;

    /// Removes a group, not its members; whether it was there.
    async fn remove_group(&self, id: &str, expected: Option<u64>) -> Result<bool, StoreError>;

    /// Makes a user a member, who may be one already, both by their identifiers; [`StoreError::NotFound`] where there is no
    /// such group or user.
    async fn join_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<(), StoreError>;

    /// Makes a user a member no longer; whether they were one.
    async fn leave_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<bool, StoreError>;
}

/// Users who have a role together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// What addresses know it by, made by the caller.
    pub id: String,
    /// How people call it.
    pub name: String,
    /// What its members may do, if their own role is not more.
    pub role: Role,
    /// When it was added.
    pub created_at: String,
    /// The names of its members.
    pub members: Vec<String>,
    /// How often it or its members were changed, and 1.
    pub revision: u64,
}

/// What changes of a group.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GroupChange {
    /// How people call it; [`StoreError::Taken`] where another one is called so.
    pub name: Option<String>,
    /// What its members may do, from now on and wherever they are logged in.
    pub role: Option<Role>,
}
