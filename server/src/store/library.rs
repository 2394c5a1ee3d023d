//! The library: trees, each with the versions that were saved of it.

use espalier_growth::SIMULATION_VERSION;
pub use espalier_proto::thumbnail::Picture;
use espalier_session::Document;

use crate::document::species_in;

use super::{StoreError, TreeQuery};

/// Keeps trees. What a call that writes has returned from is durable. A change of a tree may name the revision that it
/// is made to: at another one it is [`StoreError::Stale`]. Where there is no such tree or version, or it is deleted, it
/// is [`StoreError::NotFound`].
pub trait Library {
    /// Makes a tree of its first version.
    async fn add_tree(&self, tree: NewTree) -> Result<(), StoreError>;

    /// Makes a version a tree's newest one, and says its number.
    async fn add_version(
        &self,
        tree: &str,
        expected: Option<u64>,
        version: NewVersion,
    ) -> Result<u32, StoreError>;

    /// Changes what is said of a tree.
    async fn change_tree(
        &self,
        tree: &str,
        expected: Option<u64>,
        change: TreeChange,
    ) -> Result<(), StoreError>;

    /// Some trees, in order.
    async fn trees(&self, query: &TreeQuery) -> Result<Vec<StoredTree>, StoreError>;

    /// One tree; one that is deleted as well, until it is purged.
    async fn tree(&self, id: &str) -> Result<Option<StoredTree>, StoreError>;

    /// So many versions of a tree, newest first; those before a number, if one is given.
    async fn versions(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredVersion>, StoreError>;

    /// The document of a version.
    async fn document(&self, tree: &str, version: u32) -> Result<Option<TreeDocument>, StoreError>;

    /// The picture of a version, if there is such a version and it has one.
    async fn thumbnail(&self, tree: &str, version: u32) -> Result<Option<Picture>, StoreError>;

    /// The tree that a session belongs to.
    async fn tree_of(&self, session: &str) -> Result<Option<SessionTree>, StoreError>;

    /// Gives up for good so many trees at most that were deleted before a time; says how many.
    async fn purge(&self, before: &str, limit: u32) -> Result<u64, StoreError>;
}

/// A document that was saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeDocument {
    /// The version of the simulation that grew it.
    pub simulation_version: u32,
    /// The document's bytes.
    pub bytes: Vec<u8>,
}

/// A tree to be made.
#[derive(Clone, Debug)]
pub struct NewTree {
    /// Its identifier, made by the caller.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its first version; what it is a copy of is the tree's origin.
    pub version: NewVersion,
}

/// A version to be saved.
#[derive(Clone, Debug)]
pub struct NewVersion {
    /// When: RFC 3339, UTC, with milliseconds, so that times order as texts do.
    pub saved_at: String,
    /// Who saves it.
    pub principal: String,
    /// How they want to be called.
    pub author: Option<String>,
    /// What they say of it.
    pub note: String,
    /// What is saved.
    pub contents: Contents,
    /// The session it is saved from, which belongs to the tree from then on, and the last journal entry in it.
    pub session: Option<(String, u64)>,
}

/// What a version holds.
#[derive(Clone, Debug)]
pub enum Contents {
    /// A document.
    New(Box<Saved>),
    /// What another version holds, of this tree or another.
    Of {
        /// The tree.
        tree: String,
        /// The version.
        version: u32,
    },
}

impl Contents {
    /// Takes the document out of what is new, for a store that keeps documents apart.
    pub(super) fn take_document(&mut self) -> Option<TreeDocument> {
        let Self::New(saved) = self else { return None };
        let simulation_version = saved.document.simulation_version;
        Some(TreeDocument { simulation_version, bytes: std::mem::take(&mut saved.document.bytes) })
    }
}

/// A document with what lists tell of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Saved {
    /// The document.
    pub document: TreeDocument,
    /// Living metamers.
    pub metamers: u32,
    /// The short name of the species it grows by.
    pub species: Option<String>,
    /// Its picture.
    pub thumbnail: Option<Picture>,
}

impl Saved {
    /// A document without a picture.
    pub fn of(document: &Document) -> Self {
        Self {
            metamers: document.metamers(),
            species: species_in(document),
            document: TreeDocument {
                simulation_version: SIMULATION_VERSION,
                bytes: document.to_saved_bytes(),
            },
            thumbnail: None,
        }
    }
}

/// What of a tree is to be changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TreeChange {
    /// Its name.
    pub name: Option<String>,
    /// What is said of it.
    pub note: Option<String>,
    /// Whether new trees are begun with it.
    pub is_template: Option<bool>,
    /// What is said of a version.
    pub version_note: Option<(u32, String)>,
    /// Its tags.
    pub tags: Option<Vec<String>>,
    /// The collection it lies in, or none.
    pub collection: Option<Option<String>>,
    /// Whether it is deleted. All else is changed of trees that are not.
    pub deletion: Option<Deletion>,
}

/// Deleting, and taking that back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Deletion {
    /// It is deleted, at a time.
    Deleted(String),
    /// One that was deleted can be taken back no longer.
    ForGood,
    /// It is there again.
    Undeleted,
}

/// When what is deleted for good was deleted: before anything else was.
pub const LONG_AGO: &str = "0000-01-01T00:00:00.000Z";
/// Before this, and after [`LONG_AGO`].
pub const NOT_SO_LONG_AGO: &str = "0001";

impl Deletion {
    /// Whether it is for what is deleted already.
    pub fn is_of_deleted(&self) -> bool {
        !matches!(self, Self::Deleted(_))
    }
}

/// One tree of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredTree {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: String,
    /// What is said of it.
    pub note: String,
    /// Whether new trees are begun with it.
    pub is_template: bool,
    /// Its tags, in order.
    pub tags: Vec<String>,
    /// The collection it lies in.
    pub collection: Option<String>,
    /// What its first version is a copy of.
    pub origin: Option<(String, u32)>,
    /// When its first version was saved.
    pub created_at: String,
    /// When it was deleted.
    pub deleted_at: Option<String>,
    /// Its newest version.
    pub head: StoredVersion,
    /// The session that it was saved from or opened in last.
    pub session: Option<String>,
    /// How often it was changed, and 1.
    pub revision: u64,
}

/// One version of a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredVersion {
    /// 1, 2, 3 … within the tree.
    pub number: u32,
    /// When it was saved.
    pub saved_at: String,
    /// How whoever saved it wanted to be called.
    pub author: Option<String>,
    /// What was said of it.
    pub note: String,
    /// Living metamers.
    pub metamers: u32,
    /// The short name of the species it grows by.
    pub species: Option<String>,
    /// The version of the same tree whose contents it has.
    pub restored: Option<u32>,
}

/// The tree that a session belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SessionTree {
    /// The tree's identifier.
    pub id: String,
    /// The version that the session was last saved as, or began with.
    pub version: u32,
    /// Whether nothing was done in it since.
    pub is_saved: bool,
}
