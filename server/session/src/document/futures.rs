//! Lines of time beside the present one: what lay ahead when something else was done (`TT3`).
//!
//! Lines are a tree. Each future leaves the line it hangs on at a place, and lists what is done on it from the
//! first operation that it does not share. A line keeps its number when another one is taken.

use std::sync::Arc;

use espalier_plant::{Future as Rows, hash::StableHash};
use espalier_proto::{Problem, Reason, version::MAX_FUTURES};

use super::{
    Document,
    history::{Before, History, Kind, MAX_SETS, Operation, Setting, StateMark, hash_operations, sets},
};
use crate::cause::Cause;

/// Metamers that may be born and die in all futures (`LM11`).
pub(super) const MAX_METAMERS: usize = 4_000_000;
/// Places of wood that was moved, in the present line and all futures (`LM11`).
pub(super) const MAX_PLACES: u64 = 4_000_000;

/// A line of time from where it leaves another one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Future {
    /// The line's number.
    pub line: u32,
    /// The future it hangs on; the present line without one.
    pub on: Option<u32>,
    /// Where it leaves that line.
    pub fork: Fork,
    /// What is done on it, the operation that it cuts in two first.
    pub operations: Vec<Operation>,
    /// Where the state of generators changed on it.
    pub states: Vec<StateMark>,
    pub rows: Rows,
}

/// A place on a line of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Fork {
    /// Operations of the line that lie before it as a whole.
    pub shared: usize,
    /// The step.
    pub step: u32,
}

/// All lines but the present one, in the order in which they were left.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Futures {
    pub all: Vec<Future>,
    /// The number of the present line.
    pub present: u32,
    /// The highest number of any line so far.
    pub newest: u32,
}

/// All marks of the present line, then those of each future.
pub(super) fn all_states<'a>(
    history: &'a History,
    futures: &'a Futures,
) -> impl Iterator<Item = &'a StateMark> {
    history.states.iter().chain(futures.all.iter().flat_map(|future| &future.states))
}

/// That an operation was recorded, which may yet be refused.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recorded {
    /// How to take back the operation before it.
    earlier: Option<Before>,
}

impl Futures {
    fn position(&self, line: u32) -> Option<usize> {
        self.all.iter().position(|future| future.line == line)
    }

    /// The last step that a line shares with the present one, beyond which it goes another way; nothing of a line that is
    /// not there. The present line shares all its steps.
    pub fn shared_with(&self, line: u32) -> Option<u32> {
        if line == self.present {
            return Some(u32::MAX);
        }
        let mut future = &self.all[self.position(line)?];
        let mut step = future.fork.step;
        while let Some(on) = future.on {
            future = &self.all[self.position(on)?];
            step = step.min(future.fork.step);
        }
        Some(step)
    }

    /// The futures to be taken one after the other to come to a line, that itself last.
    fn way_to(&self, line: u32) -> Option<Vec<u32>> {
        let mut way = vec![line];
        let mut future = &self.all[self.position(line)?];
        while let Some(on) = future.on {
            way.push(on);
            future = &self.all[self.position(on)?];
        }
        way.reverse();
        Some(way)
    }

    /// What hangs on the present line beyond a place hangs on this line from now on.
    fn hand_over(&mut self, beyond: Fork, line: u32) {
        for future in &mut self.all {
            if future.on.is_none() && future.fork > beyond {
                future.on = Some(line);
            }
        }
    }

    /// What hung on a line hangs on the present one from now on.
    fn take_over(&mut self, line: u32) {
        for future in &mut self.all {
            if future.on == Some(line) {
                future.on = None;
            }
        }
    }

    /// Forgets the oldest future on which no other hangs.
    fn forget_one(&mut self) {
        let is_leaf = |future: &Future| self.all.iter().all(|other| other.on != Some(future.line));
        if let Some(oldest) = self.all.iter().position(is_leaf) {
            self.all.remove(oldest);
        }
    }

    /// Forgets everything that hangs on a line which is gone.
    fn forget_with(&mut self, gone: u32) {
        let mut lines = vec![gone];
        while let Some(line) = lines.pop() {
            lines.extend(self.all.extract_if(.., |future| future.on == Some(line)).map(|future| future.line));
        }
    }

    pub(super) fn metamers(&self) -> usize {
        self.all.iter().map(|future| future.rows.metamers() + future.rows.dying()).sum()
    }

    pub fn hash(&self, hash: &mut StableHash) {
        hash.word(u64::from(self.present) | u64::from(self.newest) << 32);
        for future in &self.all {
            hash.word(u64::from(future.line) | u64::from(future.on.map_or(u32::MAX, |on| on)) << 32);
            hash.word(future.fork.shared as u64 | u64::from(future.fork.step) << 32);
            hash.word(future.rows.metamers() as u64 | u64::from(future.rows.steps()) << 32);
            hash_operations(&future.operations, hash);
        }
    }
}

impl Document {
    /// Starts an operation at the present; what lies ahead becomes a future. Where the setting is not that of the
    /// line, which ungrowing can bring about, an operation that makes it so comes before.
    pub(super) fn record(&mut self, kind: Kind, cause: Cause<'_>) -> Recorded {
        let earlier = self.history.before;
        let (done, latest) = (self.history.done, self.history.latest);
        let left = self.leave_future();
        let now = self.plant().step();
        let present = self.setting();
        let line = self.history.setting().clone();
        let alone = Cause { gesture: None, ..cause };
        let is_same = present.schedule == line.schedule;
        if !is_same || present.appearance != line.appearance {
            let kind = if is_same { Kind::Appearance } else { Kind::Parameters };
            let after = Setting { obstacles: line.obstacles.clone(), ..present.clone() };
            self.history.push(kind, alone, now, after);
        }
        if !Arc::ptr_eq(&present.obstacles, &line.obstacles) {
            self.history.push(Kind::Obstacle, alone, now, present.clone());
        }
        self.history.push(kind, cause, now, present);
        self.history.before = Some(Before { done, latest, left });
        Recorded { earlier }
    }

    /// Takes back that an operation was recorded: it was refused, and nothing has happened.
    pub(super) fn refuse(&mut self, recorded: Recorded) {
        self.unrecord();
        self.history.before = recorded.earlier;
    }

    /// Takes back that the last operation was recorded: it came to nothing, and what lay ahead lies ahead again.
    pub(super) fn unrecord(&mut self) {
        let Some(before) = self.history.before.take() else {
            self.history.pop();
            self.keep_to_design();
            return;
        };
        let left_last = self.futures.all.last().map(|future| future.line);
        if before.left.is_some() && before.left == left_last {
            self.return_to_future();
            self.futures.newest -= 1;
        } else {
            self.history.operations.truncate(before.done);
            self.history.hand_states_down();
        }
        self.history.done = before.done;
        self.history.latest = before.latest;
        self.keep_to_design();
    }

    /// Takes back that the last operation was recorded if it has come to nothing.
    pub(super) fn forget_idle(&mut self) {
        if self.history.is_idle() {
            self.unrecord();
        }
    }

    /// Puts what lies ahead aside, and what was left of the present operation with it; the line that is a future
    /// now, if anything lay ahead.
    fn leave_future(&mut self) -> Option<u32> {
        self.complete_line();
        self.know_design_here();
        let now = self.plant().step();
        let history = &mut self.history;
        let in_part = history.is_in_part(now);
        if !in_part && history.done == history.operations.len() && now == self.simulation.plant().last_step()
        {
            return None;
        }
        let shared = history.done - usize::from(in_part);
        let operations = history.operations[shared..].to_vec();
        history.operations.truncate(history.done);
        if let Some(last) = history.operations.last_mut() {
            last.last = last.last.min(now);
        }
        history.latest = None;
        let fork = Fork { shared, step: now };
        let states = history.cut_states(fork, &operations);
        let line = self.futures.present;
        self.futures.hand_over(fork, line);
        let rows = self.simulation.stash_future();
        self.futures.all.push(Future { line, on: None, fork, operations, states, rows });
        self.futures.newest += 1;
        self.futures.present = self.futures.newest;
        self.forget_wood_ahead();
        self.keep_to_design();
        Some(line)
    }

    /// Takes the future up again that was left last, right here.
    fn return_to_future(&mut self) {
        let Some(Future { line, fork, operations, states, rows, .. }) = self.futures.all.pop() else {
            return;
        };
        self.history.cut_states(fork, &operations);
        self.history.states.extend(states);
        self.history.operations.truncate(fork.shared);
        self.history.operations.extend(operations);
        self.futures.take_over(line);
        self.futures.present = line;
        self.forget_wood_ahead();
        self.show_last_design_here();
        // It was cut off right here.
        let _fits = self.simulation.take_future(rows);
    }

    /// Goes over to another line, at its end (`TT4`).
    pub(super) fn take_future(&mut self, line: u32) -> Result<(), Problem> {
        let way = self.futures.way_to(line).ok_or_else(|| {
            Problem::new(Reason::FutureGone, format!("there is no future {line}"))
                .at("future", "the number of a future in timeline")
        })?;
        for line in way {
            self.cross_over(line)?;
        }
        let end = self.last_step();
        self.travel(end);
        self.history.done = self.history.operations.len();
        self.keep_to_line();
        Ok(())
    }

    /// Makes a line that hangs on the present one the present one, where it leaves it.
    fn cross_over(&mut self, line: u32) -> Result<(), Problem> {
        let Some(at) = self.futures.position(line) else { return Ok(()) };
        let fork = self.futures.all[at].fork;
        self.travel(fork.step);
        self.complete_line();
        self.know_design_here();
        let Future { operations, states, rows, .. } = self.futures.all.remove(at);
        let left = self.history.operations.split_off(fork.shared.min(self.history.operations.len()));
        let left_states = self.history.cut_states(fork, if left.is_empty() { &operations } else { &left });
        let left_rows = self.simulation.stash_future();
        let is_left = !left.is_empty() || left_rows.steps() > 0;
        if is_left {
            let present = self.futures.present;
            self.futures.hand_over(fork, present);
            self.futures.all.push(Future {
                line: present,
                on: None,
                fork,
                operations: left,
                states: left_states,
                rows: left_rows,
            });
        }
        self.history.done = self.history.operations.len();
        self.forget_wood_ahead();
        self.show_last_design_of(&operations);
        if let Err(error) = self.simulation.take_future(rows) {
            if is_left {
                self.return_to_future();
            }
            self.futures.forget_with(line);
            let message = format!("future {line} is damaged: {error}");
            return Err(Problem::new(Reason::FutureDamaged, message).at("future", "a future that is whole"));
        }
        self.futures.take_over(line);
        self.futures.present = line;
        self.history.operations.extend(operations);
        self.history.states.extend(states);
        self.history.done = self.history.done_at(fork.step);
        Ok(())
    }

    /// Whether so many places of wood more can be kept, if need be in place of futures.
    pub(super) fn require_places(&self, places: usize) -> Result<(), Problem> {
        let held: u64 = self.history.operations.iter().map(|op| u64::from(op.places)).sum();
        if held + places as u64 <= MAX_PLACES {
            return Ok(());
        }
        let message = format!(
            "the history keeps {held} places of wood that was moved, and may keep {MAX_PLACES}; undo something"
        );
        let allowed = format!("edits of up to {MAX_PLACES} places of wood in all");
        Err(Problem::new(Reason::HistoryFull, message).at("kind", allowed))
    }

    /// Whether one more set of parameters, looks or obstacles can be kept, if need be in place of futures.
    pub(super) fn require_sets(&self) -> Result<(), Problem> {
        if sets(&self.history.operations[..self.history.done]) < MAX_SETS {
            return Ok(());
        }
        let message = format!(
            "the history keeps {MAX_SETS} changes of parameters, looks and obstacles, and no more; undo something"
        );
        let allowed = format!("up to {MAX_SETS} changes of parameters, looks and obstacles");
        Err(Problem::new(Reason::HistoryFull, message).at("kind", allowed))
    }

    /// Forgets futures until all of them fit (`LM11`).
    pub(super) fn forget_futures(&mut self) {
        let places = |operations: &[Operation]| operations.iter().map(|op| u64::from(op.places)).sum::<u64>();
        let most_sets = MAX_SETS - sets(&self.history.operations).min(MAX_SETS);
        loop {
            let futures = &self.futures.all;
            let held: u64 = futures.iter().map(|future| places(&future.operations)).sum();
            let fits = futures.len() <= MAX_FUTURES
                && self.futures.metamers() <= MAX_METAMERS
                && held + places(&self.history.operations) <= MAX_PLACES
                && futures.iter().map(|future| sets(&future.operations)).sum::<usize>() <= most_sets;
            if fits || futures.is_empty() {
                return;
            }
            self.futures.forget_one();
        }
    }
}
