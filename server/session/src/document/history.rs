//! Operations: what undo takes back as a whole, each a span of simulation steps.

use std::sync::Arc;

use espalier_growth::Parameters;
use espalier_plant::hash::StableHash;

use super::obstacles::Standings;

/// What an operation was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Kind {
    /// One stroke, or several that overlapped in time.
    Stroke = 0,
    /// Growth without guidance.
    Growth = 1,
    /// A change of parameters.
    Parameters = 2,
    /// Another seed.
    Seed = 3,
    /// Growth into an outline.
    Lasso = 4,
    /// An obstacle placed, moved or removed.
    Obstacle = 5,
}

/// What growth works with and an operation may change.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setting {
    pub parameters: Arc<Parameters>,
    pub obstacles: Standings,
}

/// One operation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Operation {
    pub kind: Kind,
    pub author: String,
    pub gesture: Option<u32>,
    /// The step it started from.
    pub first: u32,
    /// The step it led to; the same for operations that do not grow anything.
    pub last: u32,
    pub before: Setting,
    pub after: Setting,
}

/// All operations, those undone behind those in force.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct History {
    pub operations: Vec<Operation>,
    /// How many are in force, the last of them perhaps in part.
    pub done: usize,
}

impl History {
    pub fn can_undo(&self) -> bool {
        self.done > 0
    }

    pub fn can_redo(&self, now: u32) -> bool {
        self.done < self.operations.len() || self.current().is_some_and(|operation| now < operation.last)
    }

    /// The last operation in force.
    fn current(&self) -> Option<&Operation> {
        self.done.checked_sub(1).map(|last| &self.operations[last])
    }

    /// Starts an operation at step `now`.
    pub fn record(&mut self, kind: Kind, author: &str, gesture: Option<u32>, now: u32, mut setting: Setting) {
        self.operations.truncate(self.done);
        if let Some(last) = self.operations.last_mut() {
            last.last = last.last.min(now);
            // Most operations change no parameters: they share one set.
            if last.after.parameters == setting.parameters {
                setting.parameters = Arc::clone(&last.after.parameters);
            }
        }
        self.operations.push(Operation {
            kind,
            author: author.to_owned(),
            gesture,
            first: now,
            last: now,
            before: setting.clone(),
            after: setting,
        });
        self.done += 1;
    }

    /// The operation in progress has reached a step.
    pub fn reach(&mut self, now: u32) {
        self.operations.truncate(self.done);
        if let Some(last) = self.operations.last_mut() {
            last.last = now;
        }
    }

    /// Forgets the last operation if it neither grew nor changed anything: undoing it would show nothing.
    pub fn forget_idle(&mut self) {
        let idle = |last: &Operation| {
            last.first == last.last && matches!(last.kind, Kind::Stroke | Kind::Growth | Kind::Lasso)
        };
        if self.done == self.operations.len() && self.current().is_some_and(idle) {
            self.operations.pop();
            self.done -= 1;
        }
    }

    /// The operation in progress has left things so.
    pub fn settle(&mut self, setting: Setting) {
        if let Some(last) = self.operations.last_mut() {
            last.after = setting;
        }
    }

    /// Whether growth at step `now` belongs to the last operation: same author, same gesture, nothing between.
    pub fn continues(&self, author: &str, gesture: Option<u32>, now: u32) -> bool {
        gesture.is_some()
            && self.done == self.operations.len()
            && self.current().is_some_and(|last| {
                last.kind == Kind::Growth
                    && last.author == author
                    && last.gesture == gesture
                    && last.last == now
            })
    }

    /// Time has gone back to a step: operations that lie beyond it are not in force any more.
    pub fn go_back_to(&mut self, now: u32) {
        while self.current().is_some_and(|last| last.last > now && last.first >= now || last.first > now) {
            self.done -= 1;
        }
    }

    /// Takes the last operation out of force and returns it.
    pub fn undo(&mut self) -> Option<&Operation> {
        self.done = self.done.checked_sub(1)?;
        Some(&self.operations[self.done])
    }

    /// Brings the operation that was left in part, or the next one, into force and returns it.
    pub fn redo(&mut self, now: u32) -> Option<&Operation> {
        let in_part = self.current().is_some_and(|operation| now < operation.last);
        if !in_part {
            if self.done == self.operations.len() {
                return None;
            }
            self.done += 1;
        }
        self.current()
    }

    pub fn hash(&self, hash: &mut StableHash) {
        hash.word(self.done as u64);
        for operation in &self.operations {
            hash.word(operation.kind as u64);
            hash.word(u64::from(operation.first) | u64::from(operation.last) << 32);
        }
    }
}
