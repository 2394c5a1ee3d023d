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
    /// Something taken back, wherever it lies on the line (`UD1`).
    TakenBack,
    /// Something that was taken back is in force again (`UD3`).
    BroughtBack,
    /// A design begun, changed or let go.
    Design,
    /// A grammar set, derived further, or its sliders set.
    Grammar,
    /// A limb that was cut back to an outline and grew into it (`DS12`).
    Refill,
}

/// One operation on a line of time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TimelineOperation {
    /// What it was.
    pub kind: OperationKind,
    /// Who did it: the number of a person, as in `people` (`PS3`).
    pub author: u32,
    /// The step before it.
    pub first: u32,
    /// The step it reached; the same as `first` where it took none.
    pub last: u32,
    /// Whether it has been taken back since, all parts of it (`UD1`).
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[ts(as = "Option<bool>", optional)]
    pub away: bool,
    /// Where several drew at once: what each of them did, the author's first (`UD4`). Otherwise empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[ts(as = "Option<Vec<TimelinePart>>", optional)]
    pub parts: Vec<TimelinePart>,
}

/// What one person did in an operation of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TimelinePart {
    /// Who: the number of a person, as in `people` (`PS3`).
    pub author: u32,
    /// Whether they have taken it back since.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[ts(as = "Option<bool>", optional)]
    pub away: bool,
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

/// What became of the lines of time since they were told last (`TT6`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct TimelineChange {
    /// The number of the present line.
    pub line: u32,
    /// The present step.
    pub step: u32,
    /// The last step of the present line.
    pub last_step: u32,
    /// How many of the operations are in force.
    pub done: u32,
    /// So many of the operations are as they were, but for those in `changed`,
    pub from: u32,
    /// and these follow them, in the place of all others.
    pub operations: Vec<TimelineOperation>,
    /// Of the first `from` those that are otherwise now, by their places.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[ts(as = "Option<Vec<ChangedOperation>>", optional)]
    pub changed: Vec<ChangedOperation>,
    /// All other lines, if any of them changed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub futures: Option<Vec<TimelineFuture>>,
}

/// An operation that was taken back or brought back where it lies (`TT6`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ChangedOperation {
    /// Its place among the operations, from 0.
    pub at: u32,
    /// What it is now.
    pub operation: TimelineOperation,
}

impl TimelineOperation {
    /// Whether it is the same one, though perhaps taken back or brought back since.
    fn is_same_as(&self, later: &Self) -> bool {
        let told = |it: &Self| (it.kind, it.author, it.first, it.last);
        told(self) == told(later)
    }
}

impl Timeline {
    /// What tells those who have this timeline of a later one.
    pub fn change_to(&self, later: &Self) -> TimelineChange {
        let pairs = self.operations.iter().zip(&later.operations);
        let from = pairs.clone().take_while(|(had, has)| had.is_same_as(has)).count();
        let changed = pairs.take(from).enumerate().filter(|(_, (had, has))| had != has);
        TimelineChange {
            line: later.line,
            step: later.step,
            last_step: later.last_step,
            done: later.done,
            from: from as u32,
            operations: later.operations[from..].to_vec(),
            changed: changed
                .map(|(at, (_, has))| ChangedOperation { at: at as u32, operation: has.clone() })
                .collect(),
            futures: (self.futures != later.futures).then(|| later.futures.clone()),
        }
    }

    /// Takes in a change of the timeline that it was before.
    pub fn change(&mut self, change: TimelineChange) {
        let TimelineChange { line, step, last_step, done, from, operations, changed, futures } = change;
        (self.line, self.step, self.last_step, self.done) = (line, step, last_step, done);
        self.operations.truncate(from as usize);
        for ChangedOperation { at, operation } in changed {
            if let Some(place) = self.operations.get_mut(at as usize) {
                *place = operation;
            }
        }
        self.operations.extend(operations);
        if let Some(futures) = futures {
            self.futures = futures;
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn operation(author: u32, first: u32, last: u32) -> TimelineOperation {
        TimelineOperation { kind: OperationKind::Stroke, author, first, last, away: false, parts: Vec::new() }
    }

    #[test]
    fn tt6_a_change_gives_the_later_timeline_and_holds_no_more_than_the_difference() {
        let long: Vec<_> = (0..100).map(|n| operation(n % 3, n, n + 1)).collect();
        let future = |of: &[TimelineOperation]| TimelineFuture {
            future: 1,
            from: 2,
            on: None,
            steps: 3,
            operations: of.to_vec(),
        };
        let mut taken_back = long.clone();
        taken_back[40].away = true;
        taken_back.push(TimelineOperation { kind: OperationKind::TakenBack, ..operation(1, 100, 100) });
        let timelines = [
            Timeline::default(),
            Timeline {
                step: 100,
                last_step: 100,
                done: 100,
                operations: long.clone(),
                ..Timeline::default()
            },
            Timeline { step: 3, last_step: 100, done: 3, operations: long.clone(), ..Timeline::default() },
            Timeline {
                line: 1,
                step: 4,
                last_step: 4,
                done: 4,
                operations: [&long[..3], &[operation(0, 3, 9)]].concat(),
                futures: vec![future(&long[3..])],
            },
            Timeline { step: 100, last_step: 100, done: 101, operations: taken_back, ..Timeline::default() },
        ];
        for had in &timelines {
            for has in &timelines {
                let change = had.change_to(has);
                let told = serde_json::to_string(&change).unwrap();
                let mut page = had.clone();
                page.change(serde_json::from_str(&told).unwrap());
                assert_eq!(page, *has);
                assert!(had != has || change.operations.is_empty() && change.futures.is_none());
            }
        }
        let travelled = timelines[1].change_to(&timelines[2]);
        assert_eq!((travelled.from, travelled.operations.len()), (100, 0));
        let taken_back = timelines[1].change_to(&timelines[4]);
        assert_eq!((taken_back.from, taken_back.operations.len()), (100, 1));
        assert_eq!(taken_back.changed.iter().map(|changed| changed.at).collect::<Vec<_>>(), [40]);
    }
}
