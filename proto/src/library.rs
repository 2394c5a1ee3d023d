//! The HTTP side: sessions, and the library of trees with their versions.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::text::{Name, Note, Tags};

/// `POST /api/v1/sessions`: start a session, or come into the one of a tree.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewSession {
    /// The seed of all randomness; drawn by the server if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub seed: Option<u32>,
    /// A tree of the library to go on with (`LB3`).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<String>,
    /// The version of it to begin with; its newest one if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub version: Option<u32>,
    /// Whether it is only what a tree of its own begins with (`LB4`).
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[ts(optional, as = "Option<bool>")]
    pub template: bool,
}

/// A session's name, whose link is `/s/NAME`, and the tree it belongs to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SessionCreated {
    /// The session's name.
    pub session: String,
    /// The tree of the library that it belongs to, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<SessionTree>,
}

/// `GET /api/v1/sessions`: some sessions, those first in which something was done last (`LB11`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SessionPage {
    /// The sessions.
    pub sessions: Vec<ListedSession>,
    /// The `after` of the next page, if there may be one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub next: Option<String>,
}

/// A session in a list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ListedSession {
    /// The session's name, whose link is `/s/NAME`.
    pub session: String,
    /// The tree of the library that it belongs to, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<TreeOfSession>,
    /// Whether nothing was done since it was saved, or since it began.
    pub saved: bool,
    /// Living metamers; of a session that is not in memory, as many as there were when its state was kept last.
    pub metamers: u32,
    /// Clients that are in it now.
    pub people: u32,
    /// When somebody entered it or drew in it last: RFC 3339, UTC.
    pub used_at: String,
}

/// The tree of a session in a list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeOfSession {
    /// The tree's identifier.
    pub id: String,
    /// The tree's name.
    pub name: String,
    /// The version that the session was last saved as, or began with.
    pub version: u32,
}

/// The tree that a session belongs to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SessionTree {
    /// The tree's identifier.
    pub id: String,
    /// The version that it was last saved as, or began with.
    pub version: u32,
    /// Whether nothing was done in it since.
    pub saved: bool,
}

/// `POST /api/v1/trees`: save a session's plants as a new tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SaveTree {
    /// The session; it belongs to the tree from then on.
    pub session: String,
    /// 1 to 80 characters.
    pub name: Name,
    /// What is said of this version: up to 2000 characters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub note: Option<Note>,
    /// How whoever saves it wants to be called: 1 to 80 characters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<Name>,
    /// A picture as a data URL, PNG, JPEG or WebP, at most 192 KiB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub thumbnail: Option<String>,
}

/// `POST /api/v1/trees/ID/versions`: save a session's plants as the newest version of a tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SaveVersion {
    /// The session; it belongs to the tree from then on.
    pub session: String,
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub note: Option<Note>,
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<Name>,
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub thumbnail: Option<String>,
}

/// `POST /api/v1/trees/ID/versions/N/restore`: what was saved then becomes the newest version.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct RestoreVersion {
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub note: Option<Note>,
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<Name>,
}

/// `POST /api/v1/trees/ID/copies`: a new tree that begins with a version of this one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct CopyTree {
    /// The new tree's name: 1 to 80 characters.
    pub name: Name,
    /// The version it begins with; the newest one if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub version: Option<u32>,
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub note: Option<Note>,
    /// As in `SaveTree`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<Name>,
}

/// `GET /api/v1/trees`: some trees of the library, in the order that was asked for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreePage {
    /// The trees.
    pub trees: Vec<SavedTree>,
    /// The `after` of the next page, if there may be one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub next: Option<String>,
}

/// What is to be known of a file that became a tree (`IM3`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ImportNote {
    /// Which it is, for programs that have words of their own for it.
    pub note: ImportNoteKind,
    /// What the file has there: the name of a species, a share in percent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub found: Option<String>,
    /// A sentence that says it.
    pub message: String,
}

/// What there is to say of files that become trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "kebab-case")]
pub enum ImportNoteKind {
    /// Its last line has no end, so it may have been cut off there.
    MayBeCutOff,
    /// It names a species that nobody knows.
    UnknownSpecies,
    /// Its trunk is too thick for its height to be likely, so its diameters may be in another unit.
    ThickTrunk,
}

/// One tree of the library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SavedTree {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: String,
    /// What is said of the tree as a whole.
    pub note: String,
    /// The number of its newest version, to which the following belong. The first is 1.
    pub version: u32,
    /// Living metamers.
    pub metamers: u32,
    /// When it was saved: RFC 3339, UTC.
    pub saved_at: String,
    /// How whoever saved it wanted to be called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<String>,
    /// The species whose programme it grows by, by its short name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub species: Option<String>,
    /// Where its picture is: the one that was saved with it, or else one that the server draws when it is first asked
    /// for. What is there never changes.
    pub thumbnail: String,
    /// When its first version was saved.
    pub created_at: String,
    /// Whether new trees are begun with it.
    pub template: bool,
    /// Its tags, in order.
    pub tags: Vec<String>,
    /// The collection it lies in, if it lies in one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub collection: Option<String>,
    /// Whether it is a favourite of whoever asks.
    pub favourite: bool,
    /// What its first version is a copy of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub origin: Option<Origin>,
    /// When it was deleted, if it was; `LB6` says how long it can be taken back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub deleted_at: Option<String>,
    /// How many people are working on it.
    pub people: u32,
    /// The number of its present state, which every change counts up: its `ETag` without the quotes.
    #[ts(type = "number")]
    pub revision: u64,
    /// What is to be known of the file that it was made of, in the answer to its import alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[ts(optional, as = "Option<Vec<ImportNote>>")]
    pub import_notes: Vec<ImportNote>,
}

/// One format of `GET /api/v1/formats`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ExportFormat {
    /// How the names of its files end.
    pub ending: String,
    /// What a person calls it, in English and German.
    pub label: [String; 2],
    /// What it is good for, in a sentence, in English and German.
    pub text: [String; 2],
    /// What can be asked for.
    pub options: Vec<String>,
    /// About how many bytes a file has at least, and for each metamer and each leaf at the finest level of detail.
    pub bytes: [f64; 3],
    /// The share of the bytes for metamers and leaves that each level of detail has.
    pub levels: [f64; 4],
    /// The share of the bytes for metamers and for leaves that an option leaves.
    pub shares: BTreeMap<String, [f64; 2]>,
}

/// `GET /api/v1/sessions/NAME/exports/TICKET`: how far a file is that is being made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ExportProgress {
    /// Bytes so far.
    #[ts(type = "number")]
    pub written: u64,
    /// About how many it will have.
    #[ts(type = "number")]
    pub expected: u64,
    /// How many files are made before it.
    pub ahead: u32,
}

/// A version of a tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Origin {
    /// The tree's identifier; it may be gone by now.
    pub tree: String,
    /// The version's number.
    pub version: u32,
}

/// What was saved of a tree at one time; `GET /api/v1/trees/ID/versions` lists them, newest first.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeVersion {
    /// 1, 2, 3 … within the tree.
    pub number: u32,
    /// When it was saved: RFC 3339, UTC.
    pub saved_at: String,
    /// How whoever saved it wanted to be called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<String>,
    /// What is said of it.
    pub note: String,
    /// Living metamers.
    pub metamers: u32,
    /// The species whose programme it grows by, by its short name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub species: Option<String>,
    /// The version whose tree this is again, if one was restored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub restored: Option<u32>,
    /// Where its picture is: the one that was saved with it, or else one that the server draws when it is first asked
    /// for. What is there never changes.
    pub thumbnail: String,
    /// Where its document is. What is there never changes.
    pub document: String,
    /// What is to be known of the file that it was made of, in the answer to its import alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[ts(optional, as = "Option<Vec<ImportNote>>")]
    pub import_notes: Vec<ImportNote>,
}

/// `PATCH /api/v1/trees/ID`: what is left out stays as it is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangeTree {
    /// Its name: 1 to 80 characters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<Name>,
    /// What is said of it: up to 2000 characters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub note: Option<Note>,
    /// Whether new trees are begun with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub template: Option<bool>,
    /// All of its tags: up to 32, each of 1 to 80 characters without a comma.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tags: Option<Tags>,
    /// The collection it lies in; an empty text for none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub collection: Option<String>,
}

/// A folder of trees and other collections; `GET /api/v1/collections` lists all of them by name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeCollection {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: String,
    /// The collection it lies in, if it lies in one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub parent: Option<String>,
    /// How many trees lie in it itself.
    pub trees: u32,
}

/// `POST /api/v1/collections`: make a collection.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct NewCollection {
    /// 1 to 80 characters.
    pub name: Name,
    /// The collection it lies in, if it lies in one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub parent: Option<String>,
}

/// `PATCH /api/v1/collections/ID`: what is left out stays as it is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangeCollection {
    /// 1 to 80 characters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub name: Option<Name>,
    /// The collection it lies in; an empty text for none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub parent: Option<String>,
}

/// A tag that trees have; `GET /api/v1/tags` lists all of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeTag {
    /// The tag.
    pub tag: String,
    /// How many trees have it.
    pub trees: u32,
}

/// Who saved a tree last, as they wanted to be called; `GET /api/v1/authors` lists all of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TreeAuthor {
    /// The name.
    pub author: String,
    /// How many trees they saved last.
    pub trees: u32,
}

/// How the names of files end that `POST /api/v1/trees/import` makes trees of.
pub const IMPORT_ENDINGS: [&str; 4] = ["espalier", "mtg", "csv", "json"];

/// `PATCH /api/v1/trees/ID/versions/N`: what is said of a version.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangeVersion {
    /// Up to 2000 characters.
    pub note: Note,
}
