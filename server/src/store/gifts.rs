//! What is given to users and groups: trees, and collections with all that lies in them.

use std::collections::BTreeSet;

use espalier_proto::access::Role;

use super::{Room, StoreError, folded};

/// Keeps what is given to whom. Who is given a collection is given the trees that lie in it, and in the collections that
/// lie there.
pub trait Gifts {
    /// Gives something with a role; what they were given of it before counts no longer. [`StoreError::NotFound`] where it,
    /// the user or the group is not there.
    async fn give(&self, what: Gift<'_>, to: &Receiver, role: Role) -> Result<(), StoreError>;

    /// Takes it back from the user or the group with this identifier; whether they had it.
    async fn take_back(&self, what: Gift<'_>, from: &str) -> Result<bool, StoreError>;

    /// To whom it was given itself: groups first, by name.
    async fn given(&self, what: Gift<'_>) -> Result<Vec<Given>, StoreError>;

    /// The greatest role that somebody was given with a tree, or with that of a session.
    async fn role_given(&self, room: Room<'_>, person: &str) -> Result<Role, StoreError>;

    /// The same with a collection, or one that it lies in.
    async fn role_in(&self, collection: &str, person: &str) -> Result<Role, StoreError>;

    /// The collections that somebody was given, with those that lie in them.
    async fn collections_of(&self, person: &str) -> Result<BTreeSet<String>, StoreError>;
}

/// What is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gift<'a> {
    /// The tree with this identifier.
    Tree(&'a str),
    /// The collection with this identifier.
    Collection(&'a str),
}

/// To whom it is given, by name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Receiver {
    /// A group.
    Group(String),
    /// A user.
    User(String),
}

impl Receiver {
    /// What they are called.
    pub fn name(&self) -> &str {
        match self {
            Self::Group(name) | Self::User(name) => name,
        }
    }

    /// Whether they are of the same kind and have the same name, as names are compared.
    pub fn is_called(&self, other: &Self) -> bool {
        let is_same_kind = std::mem::discriminant(self) == std::mem::discriminant(other);
        is_same_kind && folded(self.name()) == folded(other.name())
    }
}

/// Somebody to whom something was given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    /// The identifier of the user or the group.
    pub id: String,
    /// Who.
    pub to: Receiver,
    /// What they may do with it.
    pub role: Role,
}

/// The folded name of the user that somebody is, if they are one.
pub(super) fn user_of(person: &str) -> Option<&str> {
    person.strip_prefix("login ")
}
