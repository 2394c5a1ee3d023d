//! Who logs in with a password.

use espalier_proto::access::Role;
use serde_json::Value;

use super::{StoreError, folded};
use crate::access::SecretHash;

/// Keeps users. Two whose names differ in large and small letters or accents alone would be taken for each other, so their
/// names are one.
pub trait Users {
    /// Adds somebody; [`StoreError::Taken`] where somebody goes by the name already.
    async fn add_user(&self, user: User) -> Result<(), StoreError>;

    /// Whoever goes by a name.
    async fn user(&self, name: &str) -> Result<Option<User>, StoreError>;

    /// All of them, by name.
    async fn users(&self) -> Result<Vec<User>, StoreError>;

    /// Changes the user with this identifier, who may have another name by now; whether they are there. Whom something
    /// counts for is the same person under another name.
    async fn change_user(&self, id: &str, change: UserChange, terms: Terms) -> Result<bool, StoreError>;

    /// Removes the user with this identifier, with all their logins and tokens, what sessions they were in, and what they
    /// have read; whether they were there. What they have saved and said stays, and is nobody's who gets their name.
    async fn remove_user(&self, id: &str, terms: Terms) -> Result<bool, StoreError>;
}

/// Whom what a user does counts for, by their name.
pub fn person_of(user: &str) -> String {
    format!("login {}", folded(user))
}

/// As whom authors know a user, whatever they are called.
pub fn identity_of(id: &str) -> String {
    format!("user {id}")
}

/// Whom it counts for that somebody did who was removed: nobody who is let in.
pub(super) fn person_removed(id: &str) -> String {
    format!("removed {id}")
}

/// What a comment says, as JSON, with somebody mentioned as another person. What is no such JSON stays as it is.
pub(super) fn mentioning_instead(said: &str, old: &str, new: &str) -> String {
    fn walk(value: &mut Value, old: &str, new: &str) {
        match value {
            Value::Array(all) => all.iter_mut().for_each(|value| walk(value, old, new)),
            Value::Object(fields) => {
                for (name, value) in fields {
                    match value {
                        Value::Array(people) if name == "people" => {
                            let them = people.iter_mut().filter(|person| person.as_str() == Some(old));
                            them.for_each(|person| *person = new.into());
                        }
                        value => walk(value, old, new),
                    }
                }
            }
            _ => {}
        }
    }
    let Ok(mut value) = serde_json::from_str(said) else { return said.to_owned() };
    walk(&mut value, old, new);
    value.to_string()
}

/// Somebody who logs in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct User {
    /// What addresses know them by, made by the caller.
    pub id: String,
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
    /// How often they were changed, and 1.
    pub revision: u64,
}

impl User {
    /// What they may do.
    pub fn allowed(&self) -> Role {
        self.group_role.map_or(self.role, |role| role.max(self.role))
    }
}

/// What changes of somebody.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UserChange {
    /// What they are called; [`StoreError::Taken`] where somebody else is.
    pub name: Option<String>,
    /// What they may do, from now on and wherever they are logged in.
    pub role: Option<Role>,
    /// What is kept of their password; all their logins end but perhaps one.
    pub password: Option<String>,
    /// The login that another password does not end.
    pub stays: Option<SecretHash>,
}

impl UserChange {
    /// Another role.
    pub fn role(role: Role) -> Self {
        Self { role: Some(role), ..Self::default() }
    }

    /// Another password, of which this is kept.
    pub fn password(password: String) -> Self {
        Self { password: Some(password), ..Self::default() }
    }
}

/// On what terms something is changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Terms {
    /// Only at this revision; else it is [`StoreError::Stale`].
    pub expected: Option<u64>,
    /// Also where nobody is an administrator then; else it is [`StoreError::LastAdmin`].
    pub force: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whom_a_comment_is_for_is_somebody_else_and_its_words_stay() {
        let said = r#"{"text":"\"login ada","mentions":[{"name":"Ada","people":["login ada","login bo"]}]}"#;
        let found: Value = serde_json::from_str(&mentioning_instead(said, "login ada", "login cy")).unwrap();
        let expected =
            r#"{"text":"\"login ada","mentions":[{"name":"Ada","people":["login cy","login bo"]}]}"#;
        assert_eq!(found, serde_json::from_str::<Value>(expected).unwrap());
        assert_eq!(
            mentioning_instead("no JSON of login ada", "login ada", "login cy"),
            "no JSON of login ada"
        );
    }
}
