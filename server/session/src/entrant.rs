//! Who comes into a session, as the server knows them. Nothing of it but name and role is told to others.

use std::sync::Arc;

use espalier_proto::{access::Role, permission::Action};

use crate::{principal::Principal, rights::Access};

/// Somebody at a connection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entrant {
    /// Who they are, whichever device they come with: two connections of one person have the same. It stays in the
    /// server.
    pub person: Arc<str>,
    /// As whom authors know them, whatever they are called: nobody after them is the same.
    pub identity: Arc<str>,
    /// What others may call them until they choose a name.
    pub name: Option<Arc<str>>,
    /// What they may do.
    pub role: Role,
    /// Whether it may be one or another who comes as this person, as with whoever sits at the machine itself.
    pub is_anybody: bool,
}

impl Entrant {
    /// Somebody without a name.
    pub fn new(person: impl Into<Arc<str>>, role: Role) -> Self {
        let person = person.into();
        Self { identity: Arc::clone(&person), person, name: None, role, is_anybody: false }
    }

    /// As whom what they do with a client key is counted, where people take turns and have shares: all devices and tabs
    /// of a person together; where nobody knows who it is, each key for itself.
    pub(crate) fn counted_as(&self, key: &Principal) -> Arc<str> {
        if self.is_anybody { counted_by_key(key) } else { Arc::clone(&self.identity) }
    }

    /// What they may do in a session.
    pub fn access(&self) -> Access {
        if self.role >= Action::EditSession.least() { Access::Edit } else { Access::Look }
    }
}

/// As whom it is counted what was done with a client key of which nobody knows whose it is.
pub(crate) fn counted_by_key(key: &Principal) -> Arc<str> {
    format!("key {}", key.name()).into()
}
