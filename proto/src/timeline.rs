//! What was done to a document, as a strip shows it, and the width constraints in force.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// What an operation was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum OperationKind {
    /// One or more strokes that overlapped in time.
    Stroke,
    /// Growth without guidance.
    Growth,
    /// Growth into an outline.
    Lasso,
    /// A change of parameters, perhaps with one of the appearance.
    Parameters,
    /// A change of the appearance alone.
    Appearance,
    /// A seed planted.
    Seed,
    /// An obstacle placed, moved or removed.
    Obstacle,
    /// A branch bent.
    Bend,
    /// A width constraint set or removed.
    Width,
    /// Branches cut, perhaps with growth after it.
    Prune,
    /// A branch turned.
    Turn,
    /// A branch copied or moved.
    Graft,
}

/// One operation on a line of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TimelineOperation {
    /// What it was.
    pub kind: OperationKind,
    /// Who did it: 0, 1, 2 … in the order in which people appear in this message.
    pub author: u32,
    /// The step before it.
    pub first: u32,
    /// The step it reached; the same as `first` where it took none.
    pub last: u32,
}

/// Another line of time, as far as it differs from the present one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TimelineFuture {
    /// Its number, for `take_future`.
    pub future: u32,
    /// The step at which it leaves the line it hangs on.
    pub from: u32,
    /// The future whose line it hangs on; the present line if none is named.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub on: Option<u32>,
    /// How many steps it goes on from there.
    pub steps: u32,
    /// What was done there.
    pub operations: Vec<TimelineOperation>,
}

/// The present line of time and all others (`TT1`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Timeline {
    /// The number of the present line: it is a future's once another line is taken.
    pub line: u32,
    /// The present step.
    pub step: u32,
    /// The last step of the present line.
    pub last_step: u32,
    /// How many of the operations are in force.
    pub done: u32,
    /// Everything done on the present line, in order, also what lies ahead.
    pub operations: Vec<TimelineOperation>,
    /// Other lines, in order of their numbers.
    pub futures: Vec<TimelineFuture>,
}

/// A metamer whose width somebody has set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct WidthConstraint {
    /// Its row.
    pub row: u32,
    /// The diameter asked for, in internode lengths.
    pub diameter: f32,
    /// The diameter it has: more where it bears something thicker.
    pub effective: f32,
}
