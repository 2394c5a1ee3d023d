//! One shared document: the plants, their simulation, and the timeline of what was done to them.

mod bytes;
mod history;
mod parameters;
mod strokes;
#[cfg(test)]
mod tests;

use std::{collections::VecDeque, sync::Arc};

use espalier_growth::{NoObserver, Observer, Parameters, Simulation, StepInput, StepOutcome, StrokeId};
use espalier_plant::{Plant, hash::StableHash};
use espalier_proto::{ParametersPatch, Problem, ProblemCode};
use glam::Vec3;

pub use self::bytes::DocumentError;
use self::{
    history::{History, Kind},
    strokes::OpenStrokes,
};
use crate::action::Action;

/// Plants, the simulation that grows them, and every operation done so far.
///
/// A document is a function of its seed and of the actions applied, in their order.
#[derive(Clone, Debug)]
pub struct Document {
    simulation: Simulation,
    history: History,
    strokes: OpenStrokes,
    pending: VecDeque<Pending>,
}

/// Steps still to be run for an action taken on.
#[derive(Clone, Debug, PartialEq)]
enum Pending {
    /// One step of brushing.
    Brush(StepInput),
    /// So many steps without guidance.
    Autonomous(u32),
    /// At most so many steps for a lifted brush, while buds find what it left.
    Settle(StrokeId, u32),
}

/// Figures of a document as a whole. Leaves are counted by whoever draws it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// The present simulation step.
    pub step: u32,
    /// Living metamers.
    pub metamers: u32,
    /// Living axes with wood.
    pub axes: u32,
    /// Metamers the document may hold.
    pub metamer_budget: u32,
    /// Whether there is an operation to undo.
    pub can_undo: bool,
    /// Whether there is something to redo.
    pub can_redo: bool,
    /// Steps still to be run.
    pub pending_steps: u32,
}

impl Document {
    /// A seedling.
    pub fn new(seed: u32) -> Self {
        Self {
            simulation: Simulation::new(seed, Parameters::default()),
            history: History::default(),
            strokes: OpenStrokes::default(),
            pending: VecDeque::new(),
        }
    }

    /// Takes an action on; the steps it needs become pending. Nothing changes if it is refused.
    pub fn begin(&mut self, author: &str, action: &Action) -> Result<(), Problem> {
        while self.advance() {}
        match action {
            Action::StrokeBegin { stroke } => self.begin_stroke(author, *stroke),
            Action::StrokeMove { stroke, samples } => {
                let longest = self.simulation.parameters().max_shoot_length;
                let steps = self.strokes.extend(author, *stroke, samples, longest)?;
                self.pending.extend(steps.into_iter().map(Pending::Brush));
                Ok(())
            }
            Action::StrokeEnd { stroke } => {
                let id = self.strokes.close(author, *stroke)?;
                self.pending.push_back(Pending::Settle(id, self.simulation.parameters().marker_max_age));
                Ok(())
            }
            Action::Grow { steps, gesture } => self.begin_growth(author, *steps, *gesture),
            Action::Ungrow { steps } => self.ungrow(*steps),
            Action::Undo => self.undo(),
            Action::Redo => self.redo(),
            Action::SetParameters(patch) => self.set_parameters(author, patch),
            Action::PlantSeed { position } => self.plant_seed(author, *position),
        }
    }

    /// Runs one pending step; false when none is pending.
    pub fn advance(&mut self) -> bool {
        self.advance_observed(&mut NoObserver)
    }

    /// Runs one pending step under the eyes of someone with a clock; false when none is pending.
    pub fn advance_observed(&mut self, observer: &mut impl Observer) -> bool {
        let Some(pending) = self.pending.pop_front() else { return false };
        match pending {
            Pending::Brush(input) => {
                self.simulation.step(&input, observer);
            }
            Pending::Autonomous(left) => {
                self.simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, observer);
                if left > 1 && !self.simulation.is_out_of_budget() {
                    self.pending.push_front(Pending::Autonomous(left - 1));
                }
            }
            Pending::Settle(stroke, left) => {
                let outcome = if left > 0 && self.simulation.has_guidance() {
                    self.simulation.step(&StepInput::default(), observer)
                } else {
                    StepOutcome::default()
                };
                // Once no bud finds a marker and no leader moves, nothing would change any more but their age.
                if outcome == StepOutcome::default() {
                    self.simulation.end_stroke(stroke);
                    if self.strokes.is_empty() {
                        self.simulation.drop_guidance();
                    }
                } else {
                    self.pending.push_front(Pending::Settle(stroke, left - 1));
                }
            }
        }
        self.history.reach(self.simulation.plant().step());
        if self.pending.is_empty() && self.strokes.is_empty() {
            self.history.forget_idle();
        }
        true
    }

    /// Takes an action on and runs all its steps.
    pub fn apply(&mut self, author: &str, action: &Action) -> Result<(), Problem> {
        self.begin(author, action)?;
        while self.advance() {}
        Ok(())
    }

    /// The strokes an author has begun and not ended.
    pub fn open_strokes(&self, author: &str) -> Vec<u32> {
        self.strokes.of(author)
    }

    /// The document's figures. Counts axes, so it costs a pass over them.
    pub fn figures(&self) -> Figures {
        let plant = self.simulation.plant();
        Figures {
            step: plant.step(),
            metamers: plant.living_count(),
            axes: plant.living_axes_count(),
            metamer_budget: self.simulation.metamer_budget(),
            can_undo: self.history.can_undo(),
            can_redo: self.history.can_redo(plant.step()),
            pending_steps: self.pending_steps(),
        }
    }

    /// Living metamers.
    pub fn metamers(&self) -> u32 {
        self.simulation.plant().living_count()
    }

    /// Steps still to be run.
    pub fn pending_steps(&self) -> u32 {
        let steps = |pending: &Pending| match pending {
            Pending::Brush(_) => 1,
            Pending::Autonomous(left) => *left,
            Pending::Settle(..) => 0,
        };
        self.pending.iter().map(steps).sum()
    }

    /// The parameters in force.
    pub fn parameters(&self) -> espalier_proto::Parameters {
        parameters::to_proto(self.simulation.parameters().values())
    }

    /// The plants.
    pub fn plant(&self) -> &Plant {
        self.simulation.plant()
    }

    /// Sets how many metamers the document may hold.
    pub fn set_metamer_budget(&mut self, budget: u32) {
        self.simulation.set_metamer_budget(budget);
    }

    /// A hash over everything that must be equal after replay.
    pub fn hash(&self) -> u64 {
        let mut hash = StableHash::default();
        hash.word(self.simulation.plant().hash());
        hash.word(u64::from(self.simulation.plant().last_step()));
        for marker in self.simulation.markers() {
            hash.vector(marker.position);
            hash.word(u64::from(marker.born));
        }
        for value in parameters::to_words(self.simulation.parameters().values()) {
            hash.word(value);
        }
        self.history.hash(&mut hash);
        self.strokes.hash(&mut hash);
        hash.finish()
    }

    fn begin_stroke(&mut self, author: &str, stroke: u32) -> Result<(), Problem> {
        let joins = !self.strokes.is_empty();
        self.strokes.open(author, stroke)?;
        // Strokes that overlap in time are one operation: their steps cannot be told apart.
        if !joins {
            self.record(Kind::Stroke, author, None);
        }
        Ok(())
    }

    fn begin_growth(&mut self, author: &str, steps: u32, gesture: Option<u32>) -> Result<(), Problem> {
        self.require_room()?;
        let continues = self.history.continues(author, gesture, self.plant().step());
        if self.strokes.is_empty() && !continues {
            self.record(Kind::Growth, author, gesture);
        }
        self.pending.push_back(Pending::Autonomous(steps));
        Ok(())
    }

    fn ungrow(&mut self, steps: u32) -> Result<(), Problem> {
        let now = self.plant().step();
        if now == 0 {
            return Err(refused("the plant is a seed; there is nothing to ungrow"));
        }
        self.go_to(now.saturating_sub(steps));
        self.history.go_back_to(self.plant().step());
        Ok(())
    }

    fn undo(&mut self) -> Result<(), Problem> {
        let operation = self.history.undo().ok_or_else(|| refused("there is nothing to undo"))?;
        let (step, parameters) = (operation.first, Arc::clone(&operation.before));
        self.go_to(step);
        self.simulation.set_parameters(Parameters::clone(&parameters));
        Ok(())
    }

    fn redo(&mut self) -> Result<(), Problem> {
        let now = self.plant().step();
        let operation = self.history.redo(now).ok_or_else(|| refused("there is nothing to redo"))?;
        let (step, parameters) = (operation.last, Arc::clone(&operation.after));
        self.go_to(step);
        self.simulation.set_parameters(Parameters::clone(&parameters));
        Ok(())
    }

    fn set_parameters(&mut self, author: &str, patch: &ParametersPatch) -> Result<(), Problem> {
        let wanted =
            parameters::parse(&self.parameters().patched(patch)).map_err(|p| p.within("parameters"))?;
        if wanted == *self.simulation.parameters() {
            return Ok(());
        }
        self.record(Kind::Parameters, author, None);
        self.simulation.set_parameters(wanted.clone());
        self.history.settle_parameters(Arc::new(wanted));
        Ok(())
    }

    fn plant_seed(&mut self, author: &str, position: Vec3) -> Result<(), Problem> {
        if position.y != 0.0 {
            return Err(Problem::out_of_range("position[1]", position.y, "0, the ground"));
        }
        self.require_room()?;
        self.record(Kind::Seed, author, None);
        self.simulation.sow(position);
        self.history.reach(self.plant().step());
        Ok(())
    }

    /// Ends all strokes where they are: whoever drew them is not there any more.
    pub fn lift_brushes(&mut self) {
        self.strokes.close_all();
        self.simulation.drop_guidance();
    }

    fn require_room(&self) -> Result<(), Problem> {
        let (held, budget) = (self.plant().metamer_count() as u32, self.simulation.metamer_budget());
        if held < budget {
            return Ok(());
        }
        Err(refused(format!("the document holds {held} metamers, its budget is {budget}")))
    }

    /// Starts an operation at the present; what was undone before it cannot be redone any more.
    fn record(&mut self, kind: Kind, author: &str, gesture: Option<u32>) {
        let parameters = Arc::new(self.simulation.parameters().clone());
        self.history.record(kind, author, gesture, self.simulation.plant().step(), parameters);
    }

    /// Travels in time; strokes in progress end where they are.
    fn go_to(&mut self, step: u32) {
        self.strokes.close_all();
        self.simulation.go_to(step);
    }
}

fn refused(message: impl Into<String>) -> Problem {
    Problem::new(ProblemCode::Refused, message)
}
