//! What people say of a tree: threads of comments, each pinned to a place on the wood or about the tree as a whole (`CT`).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{
    bounded::{List, Share},
    place::{Offset, Position},
    presence::Camera,
    programme::Slug,
    text::{Name, Saying},
    version::{MAX_COMMENT_LINES, MAX_LINE_PLACES, MAX_MENTIONS},
};

/// Lines drawn over a view: places in it as shares of its width and height, from the upper left corner.
pub type SketchNote = List<List<[Share; 2], 1, MAX_LINE_PLACES>, 1, MAX_COMMENT_LINES>;

/// Where a thread is pinned, as a page sees it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with row, along, offset and place")]
pub struct PinPlace {
    /// The metamer's row.
    pub row: u32,
    /// How far along the metamer, from where it begins (0) to where it ends (1).
    pub along: Share,
    /// From there, in internode lengths along the axes h, u and w of `LF1`.
    pub offset: Offset,
    /// Where that is now.
    pub place: Position,
}

/// Where a thread was pinned; its row is told by `pins`, for it may be another one by now.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ThreadPlace {
    /// How far along its metamer.
    pub along: Share,
    /// From there, along the axes h, u and w of `LF1`.
    pub offset: Offset,
    /// Where that was.
    pub place: Position,
}

/// What somebody saw when they wrote.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with camera, step, line and mode")]
pub struct Bookmark {
    /// From where.
    pub camera: Camera,
    /// The step of the timeline,
    pub step: u32,
    /// and its line.
    pub line: u32,
    /// How the tree was drawn.
    pub mode: Slug,
}

/// Somebody whom a comment is for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with name")]
pub struct NewMention {
    /// As others see them.
    pub name: Name,
    /// Their number among the people of the session, where several have the name (`CT7`).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub person: Option<u32>,
}

/// Somebody whom a comment is for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Mention {
    /// As they were called then.
    pub name: String,
    /// Whether that is whoever asks, whatever they are called now.
    pub you: bool,
}

/// Something to say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with text")]
pub struct NewComment {
    /// In words.
    pub text: Saying,
    /// What whoever says it wants to be called, if they have no name here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub author: Option<Name>,
    /// Whom it is for.
    #[serde(default)]
    #[ts(as = "Option<Vec<NewMention>>", optional)]
    pub mentions: List<NewMention, 0, MAX_MENTIONS>,
    /// The session of the tree in which those people are who are given by number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub session: Option<String>,
    /// What they see.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub bookmark: Option<Bookmark>,
    /// What they have drawn over that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(as = "Option<Vec<Vec<[f32; 2]>>>", optional)]
    pub sketch: Option<SketchNote>,
    /// A picture of it, as a data URL like a thumbnail.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub picture: Option<String>,
}

/// `POST /api/v1/trees/{tree}/threads`: begin a thread (`CT1`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with comment")]
pub struct NewThread {
    /// Where it is pinned; about the tree as a whole if nowhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub pin: Option<NewPin>,
    /// What is said first.
    pub comment: NewComment,
}

/// Where a thread is to be pinned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with session and at")]
pub struct NewPin {
    /// The session of the tree whose rows are meant.
    pub session: String,
    /// The place.
    pub at: PinPlace,
}

/// `PATCH /api/v1/trees/{tree}/threads/{thread}`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with resolved")]
pub struct ChangeThread {
    /// Whether what it is about is done.
    pub resolved: bool,
}

/// `PATCH /api/v1/trees/{tree}/threads/{thread}/comments/{comment}`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with text")]
pub struct ChangeComment {
    /// Its words from now on.
    pub text: Saying,
}

/// `PUT /api/v1/trees/{tree}/threads/{thread}/seen`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with comment")]
pub struct Seen {
    /// The newest comment that whoever asks has seen.
    pub comment: u32,
}

/// A thread of comments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Thread {
    /// Its number on the tree.
    pub thread: u32,
    /// Where it was pinned, if it is about a place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub at: Option<ThreadPlace>,
    /// Who has said that it is done, if anybody has.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub resolved: Option<Resolved>,
    /// The newest comment that whoever asks has seen; 0 for none.
    pub seen: u32,
    /// Those that are there, in order.
    pub comments: Vec<Comment>,
}

/// That a thread is done.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Resolved {
    /// Who says so.
    pub by: String,
    /// When, in UTC.
    pub at: String,
}

/// What somebody has said.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Comment {
    /// Its number in the thread.
    pub comment: u32,
    /// Who said it.
    pub author: String,
    /// Whether that is whoever asks.
    pub own: bool,
    /// When, in UTC.
    pub written_at: String,
    /// When it was changed, if it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub edited_at: Option<String>,
    /// In words.
    pub text: String,
    /// Whom it is for.
    pub mentions: Vec<Mention>,
    /// What they saw.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub bookmark: Option<Bookmark>,
    /// What they drew over it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(as = "Option<Vec<Vec<[f32; 2]>>>", optional)]
    pub sketch: Option<SketchNote>,
    /// Whether it has a picture.
    pub picture: bool,
}

/// How a thread's place is now (`CT2`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum PinState {
    /// Its metamer lives.
    Standing,
    /// Its metamer is born later on this line of time.
    NotYet,
    /// Its metamer is dead, or gone.
    Detached,
    /// Its metamer was born on another line of time, and a like one lives where it was.
    Regrown,
    /// Its metamer is on another line of time.
    Elsewhere,
}

/// Where a thread is now.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// The thread.
    pub thread: u32,
    /// How it is.
    pub state: PinState,
    /// Its metamer's row; where that does not live, the nearest living one below.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub row: Option<u32>,
    /// The step to go to for seeing it, where that is another one,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub step: Option<u32>,
    /// and the line of time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub line: Option<u32>,
}
