//! Operations: what undo takes back as a whole, each a span of simulation steps on the present line of time.

use std::sync::Arc;

use espalier_plant::hash::StableHash;
use espalier_settings::Appearance;
use glam::Quat;

use super::{
    designing::Designed,
    futures::Fork,
    generators::GeneratorState,
    obstacles::{Standings, stand_alike},
    parts::Parts,
};
use crate::{cause::Cause, principal::Principal, schedule::GrowthSchedule};

/// Changes of parameters, programmes, looks and obstacles that all lines of time may keep: each holds a set (`LM11`).
pub(super) const MAX_SETS: usize = 100_000;

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
    /// A branch bent.
    Bend = 6,
    /// A width constraint set or removed.
    Width = 7,
    /// Branches cut.
    Prune = 8,
    /// A branch turned.
    Turn = 9,
    /// A branch copied or moved.
    Graft = 10,
    /// A change of looks.
    Appearance = 11,
    /// A deed taken back (`UD1`).
    TakenBack = 12,
    /// A deed that was taken back is in force again (`UD3`).
    BroughtBack = 13,
    /// A design begun, changed or let go.
    Design = 14,
    /// A grammar set, derived further, or its sliders set.
    Grammar = 15,
    /// A limb cut back to an outline and grown into it.
    Refill = 16,
}

impl Kind {
    const ALL: [Self; 17] = [
        Self::Stroke,
        Self::Growth,
        Self::Parameters,
        Self::Seed,
        Self::Lasso,
        Self::Obstacle,
        Self::Bend,
        Self::Width,
        Self::Prune,
        Self::Turn,
        Self::Graft,
        Self::Appearance,
        Self::TakenBack,
        Self::BroughtBack,
        Self::Design,
        Self::Grammar,
        Self::Refill,
    ];

    /// Whether such an operation holds a set of parameters, looks or obstacles, a design or a grammar that no other holds.
    fn has_set(self) -> bool {
        let holds = matches!(
            self,
            Self::Parameters | Self::Appearance | Self::Obstacle | Self::Design | Self::Grammar
        );
        holds || self.is_switch()
    }

    /// Whether such an operation grows, and several people can do so in it at once.
    pub fn grows(self) -> bool {
        matches!(self, Self::Stroke | Self::Growth | Self::Lasso)
    }

    /// Whether such an operation says of another one whether it is in force.
    pub fn is_switch(self) -> bool {
        matches!(self, Self::TakenBack | Self::BroughtBack)
    }

    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code)).copied()
    }
}

/// What growth works with, and what is seen of it, as far as an operation may change that.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setting {
    pub schedule: Arc<GrowthSchedule>,
    pub obstacles: Standings,
    pub appearance: Arc<Appearance>,
    pub design: Option<Arc<Designed>>,
    /// Designs that were let go, and whose wood keeps the colours that they say.
    pub let_go: Arc<[Arc<Designed>]>,
}

/// One operation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Operation {
    pub kind: Kind,
    pub author: Principal,
    pub gesture: Option<u32>,
    /// The step it started from.
    pub first: u32,
    /// The step it led to; the same for operations that do not take any.
    pub last: u32,
    /// The setting from its beginning on.
    pub after: Setting,
    /// Places of wood that it keeps because it moved them (`LM11`).
    pub places: u32,
    /// The operation of the line of which it takes back or brings back a part.
    pub deed: Option<u32>,
    /// Which part.
    pub part: u8,
    /// Whether several people did it at once.
    pub is_joint: bool,
    /// What each of them did; of one of an older document nobody knows, and nobody alone may take it back.
    pub parts: Parts,
    /// Whether it grew from a bud that somebody chose.
    pub is_chosen: bool,
}

/// Operations that hold a set of their own.
pub(super) fn sets(operations: &[Operation]) -> usize {
    operations.iter().filter(|operation| operation.kind.has_set()).count()
}

/// The edit made last, which another one of the same gesture may take the place of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Latest {
    /// The step it led to.
    pub step: u32,
    /// The metamer it concerned.
    pub row: u32,
    /// By how much it was turned; nothing for widths.
    pub rotation: Option<Quat>,
}

/// From a step on the generators have another state than before.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StateMark {
    /// The step.
    pub step: u32,
    /// Operations in force when it changed; the mark goes with the last of them.
    pub done: u32,
    /// The state.
    pub state: GeneratorState,
}

/// What there was before the last operation was recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Before {
    /// Operations in force.
    pub done: usize,
    pub latest: Option<Latest>,
    /// The line that lay ahead, and is a future now.
    pub left: Option<u32>,
}

impl Operation {
    /// A stroke in which nothing had grown when somebody else did something: undoing it would show nothing.
    fn is_idle_stroke(&self) -> bool {
        self.kind == Kind::Stroke && self.first == self.last
    }
}

/// All operations of the present line, those undone behind those in force.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct History {
    pub operations: Vec<Operation>,
    /// How many are in force, the last of them perhaps in part.
    pub done: usize,
    /// The setting before the first of them.
    pub initial: Setting,
    pub latest: Option<Latest>,
    /// Where the state of generators changed, in order. Before the first mark it is the default.
    pub states: Vec<StateMark>,
    /// How to take back that the last operation was recorded; none once something else has happened.
    pub before: Option<Before>,
}

impl History {
    pub fn new(initial: Setting) -> Self {
        Self { operations: Vec::new(), done: 0, initial, latest: None, states: Vec::new(), before: None }
    }

    /// The last operation in force.
    pub fn current(&self) -> Option<&Operation> {
        self.done.checked_sub(1).map(|last| &self.operations[last])
    }

    /// Whether the last operation in force reaches beyond a step.
    pub fn is_in_part(&self, now: u32) -> bool {
        self.current().is_some_and(|operation| now < operation.last)
    }

    pub fn can_redo(&self, now: u32) -> bool {
        self.done < self.operations.len() || self.is_in_part(now)
    }

    /// The setting that belongs to what is in force.
    pub fn setting(&self) -> &Setting {
        self.current().map_or(&self.initial, |operation| &operation.after)
    }

    /// The last operation is about a part of this one.
    pub fn concern(&mut self, deed: usize, part: u8) {
        if let Some(last) = self.operations.last_mut() {
            (last.deed, last.part) = (Some(deed as u32), part);
        }
    }

    /// The last operation in force, to be changed.
    pub fn current_mut(&mut self) -> Option<&mut Operation> {
        self.done.checked_sub(1).map(|last| &mut self.operations[last])
    }

    /// What the last operation in force grows, it grows from a bud that was chosen.
    pub fn choose(&mut self) {
        if let Some(last) = self.current_mut() {
            last.is_chosen = true;
        }
    }

    /// Adds an operation at step `now`, where nothing lies ahead.
    pub fn push(&mut self, kind: Kind, cause: Cause<'_>, now: u32, mut after: Setting) {
        debug_assert_eq!(self.done, self.operations.len(), "what lay ahead is a future by now");
        // Most operations change no parameters: they share one set.
        if self.setting().schedule == after.schedule {
            after.schedule = Arc::clone(&self.setting().schedule);
        }
        if self.setting().appearance == after.appearance {
            after.appearance = Arc::clone(&self.setting().appearance);
        }
        self.operations.push(Operation {
            kind,
            author: cause.author.clone(),
            gesture: cause.gesture,
            first: now,
            last: now,
            after,
            places: 0,
            deed: None,
            part: 0,
            is_joint: false,
            parts: Parts::default(),
            is_chosen: false,
        });
        self.done += 1;
        self.latest = None;
        self.before = None;
    }

    /// The operation in progress has reached a step.
    pub fn reach(&mut self, now: u32) {
        debug_assert_eq!(self.done, self.operations.len(), "growth always belongs to the last operation");
        if let Some(last) = self.operations.last_mut() {
            last.last = now;
        }
    }

    /// Whether the last operation neither grew nor changed anything: undoing it would show nothing.
    pub fn is_idle(&self) -> bool {
        let idle = |last: &Operation| last.first == last.last && !last.kind.has_set();
        self.done == self.operations.len() && self.current().is_some_and(idle)
    }

    /// Takes the last operation off, which is in force. What it did to the state of generators stays so.
    pub fn pop(&mut self) {
        self.operations.pop();
        self.done = self.done.min(self.operations.len());
        self.hand_states_down();
    }

    /// States that belong to an operation which is gone belong to the last one that is there.
    pub fn hand_states_down(&mut self) {
        let done = self.operations.len() as u32;
        self.states.iter_mut().for_each(|mark| mark.done = mark.done.min(done));
    }

    /// The state of the generators at a step.
    pub fn state_at(&self, step: u32) -> GeneratorState {
        let is_past = |mark: &&StateMark| mark.step <= step && mark.done as usize <= self.done;
        self.states.iter().rev().find(is_past).map(|mark| mark.state.clone()).unwrap_or_default()
    }

    /// The state of the generators after so many operations.
    pub fn state_after(&self, operations: usize) -> GeneratorState {
        let is_past = |mark: &&StateMark| mark.done as usize <= operations;
        self.states.iter().rev().find(is_past).map(|mark| mark.state.clone()).unwrap_or_default()
    }

    /// At a step, the last of the line, the generators have this state.
    pub fn note_state(&mut self, step: u32, state: &GeneratorState) {
        let done = self.done as u32;
        self.states.truncate(self.states.partition_point(|mark| (mark.step, mark.done) < (step, done)));
        if self.state_at(step) != *state {
            self.states.push(StateMark { step, done, state: state.clone() });
        }
    }

    /// Takes off the states noted on the line from the place on where it is left with these operations.
    pub fn cut_states(&mut self, Fork { shared, step }: Fork, left: &[Operation]) -> Vec<StateMark> {
        let is_in_part = left.first().is_some_and(|operation| operation.first < step);
        let operations = shared + usize::from(is_in_part);
        let stays = |mark: &StateMark| mark.step <= step && mark.done as usize <= operations;
        let first = self.states.iter().position(|mark| !stays(mark)).unwrap_or(self.states.len());
        self.states.split_off(first)
    }

    /// The operation in progress has left things so.
    pub fn settle(&mut self, setting: Setting) {
        if let Some(last) = self.operations.last_mut() {
            last.after = setting;
        }
    }

    /// The operation in progress is of this kind as well: what changes how things grow says more than looks do.
    pub fn widen(&mut self, kind: Kind) {
        if let Some(last) = self.operations.last_mut().filter(|_| kind == Kind::Parameters) {
            last.kind = kind;
        }
    }

    /// Whether the last operation has left the setting as it was before.
    pub fn changes_nothing(&self) -> bool {
        let Some(last) = self.operations.last() else { return false };
        let Setting { schedule, obstacles, appearance, design, let_go } = &last.after;
        let former = self.former();
        Arc::ptr_eq(obstacles, &former.obstacles)
            && *schedule == former.schedule
            && *appearance == former.appearance
            && *design == former.design
            && *let_go == former.let_go
    }

    /// Obstacles that stand as they did before the operation in progress are the very same again.
    pub fn share_former_obstacles(&self, setting: &mut Setting) {
        let former = &self.former().obstacles;
        if stand_alike(former, &setting.obstacles) {
            setting.obstacles = Arc::clone(former);
        }
    }

    /// The setting before the last operation.
    pub fn former(&self) -> &Setting {
        let earlier = self.operations.split_last().and_then(|(_, earlier)| earlier.last());
        earlier.map_or(&self.initial, |operation| &operation.after)
    }

    /// The operation in progress keeps so many places of wood more.
    pub fn keep_places(&mut self, places: usize) {
        if let Some(last) = self.operations.last_mut() {
            last.places = last.places.saturating_add(places as u32);
        }
    }

    /// Whether what is done at step `now` belongs to the last operation if that is one of these kinds: same
    /// author, same gesture, nothing between.
    pub fn continues(&self, kinds: &[Kind], cause: Cause<'_>, now: u32) -> bool {
        cause.gesture.is_some()
            && self.done == self.operations.len()
            && self.current().is_some_and(|last| {
                kinds.contains(&last.kind)
                    && last.author == *cause.author
                    && last.gesture == cause.gesture
                    && last.last == now
            })
    }

    /// The steps of strokes, lassos and refilled limbs in force: after the first, up to the second of each pair.
    pub fn drawn(&self) -> Vec<(u32, u32)> {
        let drawn = self.operations[..self.done].iter();
        let drawn =
            drawn.filter(|operation| matches!(operation.kind, Kind::Stroke | Kind::Lasso | Kind::Refill));
        let mut steps: Vec<(u32, u32)> = Vec::new();
        for operation in drawn.filter(|operation| operation.first < operation.last) {
            match steps.last_mut().filter(|(_, end)| *end == operation.first) {
                Some((_, end)) => *end = operation.last,
                None => steps.push((operation.first, operation.last)),
            }
        }
        steps
    }

    /// How many operations are in force at a step; changes made at that very step are.
    pub fn done_at(&self, step: u32) -> usize {
        let is_in_force = |op: &Operation| op.first < step || op.first == step && op.last == step;
        self.operations.iter().take_while(|operation| is_in_force(operation)).count()
    }

    /// The step to go to for taking back the last operation in force, which is in force no more.
    pub fn undo(&mut self) -> Option<u32> {
        self.done = self.done.checked_sub(1)?;
        while self.done > 0 && self.operations[self.done].is_idle_stroke() {
            self.done -= 1;
        }
        Some(self.operations[self.done].first)
    }

    /// The step to go to for the operation that was left in part, or else the next one, which is in force now.
    pub fn redo(&mut self, now: u32) -> Option<u32> {
        if !self.is_in_part(now) {
            if self.done == self.operations.len() {
                return None;
            }
            self.done += 1;
            while self.done < self.operations.len() && self.operations[self.done - 1].is_idle_stroke() {
                self.done += 1;
            }
        }
        self.current().map(|operation| operation.last)
    }

    pub fn hash(&self, hash: &mut StableHash) {
        hash.word(self.done as u64);
        hash_operations(&self.operations, hash);
        if let Some(latest) = self.latest {
            hash.word(u64::from(latest.step) | u64::from(latest.row) << 32);
        }
        if let Some(before) = self.before {
            hash.word(before.done as u64 | u64::from(before.left.map_or(u32::MAX, |line| line)) << 32);
        }
    }
}

pub(super) fn hash_operations(operations: &[Operation], hash: &mut StableHash) {
    for operation in operations {
        hash.word(operation.kind as u64);
        hash.word(u64::from(operation.first) | u64::from(operation.last) << 32);
        hash.word(u64::from(operation.places));
        if let Some(deed) = operation.deed {
            hash.word(u64::from(deed) | u64::from(operation.part) << 32);
        }
        if operation.is_joint || operation.is_chosen {
            hash.word(u64::from(operation.is_joint) | u64::from(operation.is_chosen) << 1);
        }
        operation.parts.hash(hash);
    }
}
