//! Who comes into a session, as the server knows them. Nothing of it but name and role is told to others.

use std::sync::Arc;

use espalier_proto::{access::Role, permission::Action};

use crate::rights::Access;

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
}

impl Entrant {
    /// Somebody without a name.
    pub fn new(person: impl Into<Arc<str>>, role: Role) -> Self {
        let person = person.into();
        Self { identity: Arc::clone(&person), person, name: None, role }
    }

    /// What they may do in a session.
    pub fn access(&self) -> Access {
        if self.role >= Action::EditSession.least() { Access::Edit } else { Access::Look }
    }
}
