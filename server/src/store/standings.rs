//! How people stand with one tree: who is kept out of it for a while, and to whom it was handed over.

use super::StoreError;

/// A tree, or a session, which may be one of a tree.
#[derive(Clone, Copy, Debug)]
pub enum Room<'a> {
    /// The tree with this identifier, and all its sessions.
    Tree(&'a str),
    /// The session of this name.
    Session(&'a str),
}

impl Room<'_> {
    /// How it is written in a [`Removal`].
    pub fn written(self) -> String {
        match self {
            Self::Tree(id) => format!("tree {id}"),
            Self::Session(name) => format!("session {name}"),
        }
    }
}

/// Keeps who may do less, or more, with one tree than elsewhere.
pub trait Standings {
    /// Somebody is kept out; what they were kept out of the same room by before counts no longer.
    async fn keep_out(&self, removal: Removal, now: &str) -> Result<(), StoreError>;

    /// Who is kept out of a room, in the order in which that ends.
    async fn removals(&self, room: Room<'_>, now: &str) -> Result<Vec<Removal>, StoreError>;

    /// Somebody is kept out no longer; whether they were.
    async fn let_back(&self, id: &str) -> Result<bool, StoreError>;

    /// A tree is handed over to somebody, or to nobody, `by` somebody alone while they have it, if that is said; whether
    /// it was.
    async fn hand_over(&self, tree: &str, to: Option<Heir>, by: Option<&str>) -> Result<bool, StoreError>;

    /// To whom a tree was handed over.
    async fn heir_of(&self, tree: &str) -> Result<Option<Heir>, StoreError>;

    /// How somebody stands with a tree, or with that of a session.
    async fn standing(&self, room: Room<'_>, person: &str, now: &str) -> Result<Standing, StoreError>;
}

/// Somebody is kept out of a room.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Removal {
    /// What it is told from others by.
    pub id: String,
    /// As [`Room::written`] has it.
    pub room: String,
    /// Who, as the server knows them.
    pub person: String,
    /// What they were called.
    pub name: String,
    /// What whoever removed them is called.
    pub by: String,
    /// When it ends.
    pub until: String,
    /// Whether they came by a link, which is revoked.
    pub is_revoked: bool,
}

/// To whom a tree was handed over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heir {
    /// Who, as the server knows them.
    pub person: String,
    /// What they were called.
    pub name: String,
}

/// How somebody stands with a tree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Standing {
    /// Who has locked the tree.
    pub locked_by: Option<String>,
    /// Why they are kept out.
    pub removed: Option<Removed>,
    /// Whether the tree was handed over to them.
    pub is_heir: bool,
    /// Whether the tree is deleted.
    pub is_deleted: bool,
}

/// Why somebody is kept out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Removed {
    /// What whoever removed them is called.
    pub by: String,
    /// Whether they came by a link, which is revoked.
    pub is_revoked: bool,
}
