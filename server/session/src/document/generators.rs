//! What grows a document's scene. Another generator is a field here and a kind of [`Step`]. What its next step depends
//! on beside the scene stands in [`GeneratorState`], which goes back and forth in time with the plants, and into a
//! section of its own in `bytes`.

use std::sync::Arc;

use espalier_growth::{Change, Generator, Growth, Observer, Scene, StepInput, StepOutcome, StrokeId};
use espalier_plant::MetamerId;

use super::grammars::{Grammars, InForce, Write, WriteError, Wrote};
use crate::schedule::{GrowthSchedule, ScheduledAction};

/// Steps in a row in which the brush of a programme finds nothing to do.
const PATIENCE: u32 = 64;

/// All generators of a document, on one scene, and the schedule by which growth goes.
#[derive(Clone, Debug)]
pub(crate) struct Generators {
    growth: Growth,
    schedule: Arc<GrowthSchedule>,
    grammars: Grammars,
    state: GeneratorState,
}

/// What generators keep from one step to the next that does not follow from the scene. Each place on a line of time has
/// the state it had when the line came there first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct GeneratorState {
    /// By how much the plants are older than the steps of growth they have taken: a programme goes on where its
    /// brush finds nothing to do.
    pub(super) ahead: u32,
    /// The grammar in force.
    pub(super) written: InForce,
    /// That of the generator which tests have.
    #[cfg(test)]
    pub(super) forks: super::tests::forks::Forks,
}

impl GeneratorState {
    /// The same, of plants that are older by so much.
    pub(super) fn aged(mut self, ahead: u32) -> Self {
        self.ahead = ahead;
        self
    }
}

/// One step of one of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    /// Buds grow into free space, guided by hand or not.
    Growth(StepInput),
    /// The plants grow older by the programme, or on their own where there is none, but not beyond an age.
    Age { chosen: Option<MetamerId>, until: u32 },
    /// A grammar writes, for a slice of work.
    Write(Write),
    /// Every bud becomes a fork.
    #[cfg(test)]
    Fork,
}

impl Step {
    /// Whether plants of an age are too old for it.
    pub(super) fn is_over(&self, age: u32) -> bool {
        matches!(self, Self::Age { until, .. } if age >= *until)
    }

    /// The same, but not beyond an age.
    pub(super) fn up_to(&self, age: u32) -> Self {
        match self {
            &Self::Age { chosen, until } => Self::Age { chosen, until: until.min(age) },
            other => other.clone(),
        }
    }
}

impl Generator for Generators {
    type Input = Step;

    /// One generator makes the step; all others then follow it.
    fn step(&mut self, scene: &mut Scene, input: &Step, observer: &mut impl Observer) -> StepOutcome {
        let outcome = match input {
            Step::Growth(input) => {
                self.end_programme_strokes(None);
                self.growth.step(scene, input, observer)
            }
            &Step::Age { chosen, until } => self.grow_older(scene, chosen, until, observer),
            Step::Write(write) => {
                let before = scene.plant().metamer_count();
                if write.asks_of_vigor(&self.state.written) {
                    self.growth.look(scene);
                }
                let written = self.grammars.write(scene, &self.growth, &self.state.written, write);
                let Wrote::Whole(written) = written else { return StepOutcome::default() };
                self.state.written = written;
                self.growth.follow(scene, &Change::Edited);
                let metamers_grown = scene.plant().metamer_count().saturating_sub(before) as u32;
                StepOutcome { metamers_grown, ..StepOutcome::default() }
            }
            #[cfg(test)]
            Step::Fork => {
                let outcome = self.state.forks.step(scene, &(), observer);
                self.growth.follow(scene, &Change::Edited);
                return outcome;
            }
        };
        self.keep_schedule(scene);
        #[cfg(test)]
        self.state.forks.follow(scene, &Change::Edited);
        outcome
    }

    fn follow(&mut self, scene: &Scene, change: &Change) {
        self.growth.follow(scene, change);
        #[cfg(test)]
        self.state.forks.follow(scene, change);
    }
}

impl Generators {
    /// Growth by a schedule, and all generators in this state.
    pub(crate) fn new(growth: Growth, schedule: Arc<GrowthSchedule>, state: GeneratorState) -> Self {
        Self { growth, schedule, grammars: Grammars::default(), state }
    }

    /// Why the grammar in force could not write the last step, if it could not.
    pub(super) fn refusal(&self) -> Option<&WriteError> {
        self.grammars.refusal.as_ref()
    }

    /// What grammars are at.
    pub(super) fn grammars(&self) -> &Grammars {
        &self.grammars
    }

    /// Lets go of a step of a grammar that is on its way.
    pub(super) fn give_up_writing(&mut self) {
        self.grammars.give_up();
    }

    /// Metamers that the last step of a grammar has moved, or given other organs.
    pub(super) fn moved(&self) -> usize {
        self.grammars.moved
    }

    /// Bytes of the word that is at hand.
    pub(super) fn bytes_of_words(&self) -> usize {
        self.grammars.bytes()
    }

    /// Another grammar is in force, or the same one at another depth.
    pub(super) fn put_in_force(&mut self, written: InForce) {
        self.state.written = written;
        self.grammars.refusal = None;
    }

    /// The schedule in force.
    pub(crate) fn schedule(&self) -> &Arc<GrowthSchedule> {
        &self.schedule
    }

    /// From now on growth does not shed what began in these steps.
    pub(super) fn keep_what_began_in(&mut self, steps: Vec<(u32, u32)>) {
        self.growth.keep_what_began_in(steps);
    }

    /// The age of the plants.
    pub(crate) fn age(&self, scene: &Scene) -> u32 {
        scene.plant().growths().saturating_add(self.state.ahead)
    }

    /// What they keep from step to step.
    pub(super) fn state(&self) -> &GeneratorState {
        &self.state
    }

    /// Another schedule, or another state; [`Document::turn_to`](super::Document::turn_to) puts the parameters in force.
    pub(super) fn turn_to(&mut self, schedule: &Arc<GrowthSchedule>, state: GeneratorState) {
        self.schedule = Arc::clone(schedule);
        self.state = state;
        self.grammars.refusal = None;
    }

    /// Makes the parameters those of the schedule at the present age.
    fn keep_schedule(&mut self, scene: &mut Scene) {
        let wanted = self.schedule.at(self.age(scene));
        if **wanted != *self.growth.parameters() {
            self.growth.set_parameters(scene, (**wanted).clone());
        }
    }

    /// What the programme does next that changes anything (`PG2`).
    fn grow_older(
        &mut self,
        scene: &mut Scene,
        chosen: Option<MetamerId>,
        until: u32,
        observer: &mut impl Observer,
    ) -> StepOutcome {
        let mut outcome = StepOutcome::default();
        let step = scene.plant().step();
        for _ in 0..PATIENCE {
            let age = self.age(scene);
            if age >= until || scene.plant().step() != step {
                break;
            }
            let action = self.begin_action(scene, age);
            self.end_programme_strokes(action.stroke());
            let is_used_up =
                matches!(action, ScheduledAction::Settle(..)) && !self.growth.has_guidance(scene);
            outcome = if is_used_up {
                StepOutcome::default()
            } else {
                self.growth.step(scene, &StepInput { chosen, ..action.input() }, observer)
            };
            match action {
                // What does not grow on its own now does not do so at another age either.
                ScheduledAction::Alone => break,
                ScheduledAction::Follow(_) => self.be_at_least(scene, age + 1),
                ScheduledAction::Settle(stroke, end) => {
                    // Once no bud finds a marker and no leader moves, nothing would change any more but their age.
                    let is_settled = outcome == StepOutcome::default();
                    self.be_at_least(scene, if is_settled { end.min(until) } else { age + 1 });
                    if is_settled || self.age(scene) >= end {
                        self.end_stroke(stroke);
                    }
                }
            }
            self.keep_schedule(scene);
        }
        outcome
    }

    /// Sows what is to be sown at an age; what is to be done then.
    fn begin_action(&mut self, scene: &mut Scene, age: u32) -> ScheduledAction {
        let Some(plan) = self.schedule.plan().cloned() else { return ScheduledAction::Alone };
        for place in plan.seeds_at(age) {
            if !scene.plant().has_seed_at(place) && !scene.is_solid(place) {
                scene.record_edit(|step| step.sow(place));
                self.growth.follow(scene, &Change::Edited);
            }
        }
        plan.action_at(age)
    }

    fn be_at_least(&mut self, scene: &Scene, age: u32) {
        self.state.ahead += age.saturating_sub(self.age(scene));
    }

    fn end_stroke(&mut self, stroke: StrokeId) {
        self.growth.end_stroke(stroke);
        if self.growth.strokes().next().is_none() {
            self.growth.drop_guidance();
        }
    }

    /// Ends the strokes of the programme but one. They end where the hand draws, or it would not get the bud that
    /// leads them, and where growth by hand has made the plants older than a stroke lasts.
    fn end_programme_strokes(&mut self, but: Option<StrokeId>) {
        let is_over = |stroke: &StrokeId| stroke.is_of_programme() && Some(*stroke) != but;
        let over: Vec<_> = self.growth.strokes().filter(is_over).collect();
        over.into_iter().for_each(|stroke| self.growth.end_stroke(stroke));
    }
}

impl AsRef<Growth> for Generators {
    fn as_ref(&self) -> &Growth {
        &self.growth
    }
}

impl AsMut<Growth> for Generators {
    fn as_mut(&mut self) -> &mut Growth {
        &mut self.growth
    }
}
