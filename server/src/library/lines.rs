//! What lists print of trees, versions and sessions, wherever it comes from: the store, or a server's answer.

use espalier_proto::library::TreeOfSession;
use serde::{Deserialize, Serialize};

use crate::store::{SessionLine, StoredTree, StoredVersion};

/// A tree. Of a server's answer only this is read, so that one of another release is understood as well.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TreeLine {
    pub id: String,
    pub name: String,
    pub version: u32,
    pub metamers: u32,
    #[serde(default)]
    pub species: Option<String>,
    #[serde(default)]
    pub tags: Vec<String>,
    #[serde(default)]
    pub note: String,
    #[serde(default)]
    pub author: Option<String>,
    pub saved_at: String,
    pub created_at: String,
    #[serde(default)]
    pub deleted_at: Option<String>,
}

impl From<StoredTree> for TreeLine {
    fn from(StoredTree { head, id, name, tags, note, created_at, deleted_at, .. }: StoredTree) -> Self {
        Self {
            id,
            name,
            version: head.number,
            metamers: head.metamers,
            species: head.species,
            tags,
            note,
            author: head.author,
            saved_at: head.saved_at,
            created_at,
            deleted_at,
        }
    }
}

impl TreeLine {
    /// What stands above the columns.
    pub const HEADS: [&str; 6] = ["ID", "NAME", "VERSION", "METAMERS", "SPECIES", "SAVED"];

    /// The columns.
    pub fn cells(&self) -> [String; 6] {
        [
            self.id.clone(),
            self.name.clone(),
            self.version.to_string(),
            self.metamers.to_string(),
            self.species.clone().unwrap_or_default(),
            self.saved_at.clone(),
        ]
    }
}

/// A version of a tree.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct VersionLine {
    pub number: u32,
    pub metamers: u32,
    #[serde(default)]
    pub species: Option<String>,
    #[serde(default)]
    pub note: String,
    #[serde(default)]
    pub author: Option<String>,
    pub saved_at: String,
    #[serde(default)]
    pub restored: Option<u32>,
}

impl From<StoredVersion> for VersionLine {
    fn from(version: StoredVersion) -> Self {
        let StoredVersion { number, metamers, species, note, author, saved_at, restored, .. } = version;
        Self { number, metamers, species, note, author, saved_at, restored }
    }
}

impl VersionLine {
    /// What stands above the columns.
    pub const HEADS: [&str; 6] = ["VERSION", "METAMERS", "SPECIES", "SAVED", "AUTHOR", "NOTE"];

    /// The columns.
    pub fn cells(&self) -> [String; 6] {
        [
            self.number.to_string(),
            self.metamers.to_string(),
            self.species.clone().unwrap_or_default(),
            self.saved_at.clone(),
            self.author.clone().unwrap_or_default(),
            self.said(),
        ]
    }

    /// The first line of the note, after what it was restored from.
    fn said(&self) -> String {
        let restored = self.restored.map(|number| format!("as version {number}"));
        let note = self.note.lines().next().filter(|note| !note.is_empty()).map(str::to_owned);
        restored.into_iter().chain(note).collect::<Vec<_>>().join(": ")
    }
}

/// A session.
#[derive(Clone, Debug, Serialize)]
pub struct SessionOfList {
    pub session: String,
    pub tree: Option<String>,
    pub tree_name: Option<String>,
    pub version: Option<u32>,
    pub saved: bool,
    pub metamers: u32,
    pub used_at: String,
}

impl From<SessionLine> for SessionOfList {
    fn from(SessionLine { name, tree, is_saved, metamers, used_at }: SessionLine) -> Self {
        let version = tree.as_ref().map(|tree| tree.version);
        let (id, tree_name) = tree.map(|tree| (tree.id, tree.name)).unzip();
        Self { session: name, tree: id, tree_name, version, saved: is_saved, metamers, used_at }
    }
}

/// A session, as a server tells it.
#[derive(Clone, Debug, Deserialize)]
pub struct SessionTold {
    session: String,
    #[serde(default)]
    tree: Option<TreeOfSession>,
    saved: bool,
    metamers: u32,
    used_at: String,
}

impl From<SessionTold> for SessionOfList {
    fn from(SessionTold { session, tree, saved, metamers, used_at }: SessionTold) -> Self {
        let version = tree.as_ref().map(|tree| tree.version);
        let (id, tree_name) = tree.map(|tree| (tree.id, tree.name)).unzip();
        Self { session, tree: id, tree_name, version, saved, metamers, used_at }
    }
}

impl SessionOfList {
    /// What stands above the columns.
    pub const HEADS: [&str; 5] = ["SESSION", "TREE", "SAVED", "METAMERS", "USED"];

    /// The columns.
    pub fn cells(&self) -> [String; 5] {
        [
            self.session.clone(),
            self.tree_name.clone().unwrap_or_default(),
            if self.saved { "yes" } else { "no" }.to_owned(),
            self.metamers.to_string(),
            self.used_at.clone(),
        ]
    }
}
