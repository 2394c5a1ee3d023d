//! The HTTP side: sessions and the library of saved trees.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// `POST /api/sessions`: start a session.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NewSession {
    /// The seed of all randomness; drawn by the server if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub seed: Option<u32>,
    /// A saved tree to start from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<String>,
}

/// The answer: the session's name. Its link is `/s/NAME`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct SessionCreated {
    /// The session's name.
    pub session: String,
}

/// `POST /api/trees`: save a session's plants in the library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct SaveTree {
    /// The session.
    pub session: String,
    /// 1 to 80 characters.
    pub name: String,
    /// A picture as a data URL, PNG, JPEG or WebP, at most 192 KiB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub thumbnail: Option<String>,
}

/// One tree of the library; `GET /api/trees` lists them, newest first.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct SavedTree {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Living metamers.
    pub metamers: u32,
    /// When it was saved: RFC 3339, UTC.
    pub saved_at: String,
    /// Where its picture is, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub thumbnail: Option<String>,
}

/// `PATCH /api/trees/ID`: give a tree another name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct RenameTree {
    /// 1 to 80 characters.
    pub name: String,
}
