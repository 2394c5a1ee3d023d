//! The server as an owner sees it: what is in memory, and how much that takes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::control::Pause;

/// `GET /api/v1/status`: how the server is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ServerStatus {
    /// The version of the program.
    pub version: String,
    /// Seconds since it was started.
    #[ts(type = "number")]
    pub up_seconds: u64,
    /// Sockets that are open.
    pub sockets: u32,
    /// Bytes of memory that may be taken (`LM19`).
    #[ts(type = "number")]
    pub memory_bytes: u64,
    /// Those that are.
    #[ts(type = "number")]
    pub taken_bytes: u64,
    /// The same by what they are taken for.
    pub used: Vec<MemoryUse>,
    /// How often there was none left.
    #[ts(type = "number")]
    pub refused: u64,
    /// Sessions in memory, the largest first.
    pub sessions: Vec<SessionStatus>,
}

/// Memory that is taken for something.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct MemoryUse {
    /// For what.
    pub what: String,
    /// How much.
    #[ts(type = "number")]
    pub bytes: u64,
}

/// A session in memory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct SessionStatus {
    /// Its name.
    pub name: String,
    /// The identifier of the tree that it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub tree: Option<String>,
    /// Clients that are there.
    pub people: u32,
    /// Living metamers.
    pub metamers: u32,
    /// Memory that is taken for it.
    #[ts(type = "number")]
    pub memory_bytes: u64,
    /// Commands that wait to be done or to be durable.
    #[ts(type = "number")]
    pub waiting_commands: u64,
    /// Bytes of frames that were sent and not answered.
    #[ts(type = "number")]
    pub unanswered_bytes: u64,
    /// Why its growth rests.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub paused: Option<Pause>,
    /// Whether it answered within a second; the other figures are 0 where it did not.
    pub answers: bool,
}
