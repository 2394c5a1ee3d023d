//! One shared document: a scene, what grows it, and the timeline of what was done to it.

mod bending;
mod branches;
mod bytes;
mod deeds;
mod designing;
mod folding;
mod futures;
mod generators;
mod grammars;
mod growing;
mod hints;
mod history;
mod notifications;
mod obstacles;
mod parts;
mod pins;
mod programmes;
mod pruning;
mod refilling;
mod settings;
mod strokes;
#[cfg(test)]
mod tests;
mod transplanting;
mod travelling;
mod variation;
mod widths;

use std::{collections::VecDeque, sync::Arc};

use espalier_growth::{Parameters, Simulation};
use espalier_plant::{MetamerId, Plant, hash::StableHash};
use espalier_proto::{Action, Command, Position, Problem, Reason, Steps, version::MAX_OUTLINE_STEPS};
use espalier_settings::{Appearance, ParameterValues};

pub(crate) use self::bytes::{Container, Reader, SESSION, Writer};
use self::{
    bending::OpenBends,
    bytes::Section,
    deeds::Person,
    designing::Designs,
    futures::Futures,
    grammars::Underway,
    growing::Pending,
    hints::Hints,
    history::{History, Kind, Setting},
    obstacles::Obstacles,
    strokes::OpenStrokes,
    travelling::moves_time,
};
pub use self::{
    bytes::{DocumentError, MAX_METAMER_BUDGET, announced_bytes, plain},
    pins::{Anchor, Search, Whereabouts},
    transplanting::TransplantError,
    variation::LeftOut,
};
pub(crate) use self::{
    deeds::Switched,
    designing::{DesignMark, Designed},
    generators::{GeneratorState, Generators, Step},
    grammars::{GrammarMark, bad_value, sliders_of},
    hints::DrawnInVain,
    obstacles::ObstaclesMark,
    pruning::prune as prune_simulation,
};
use crate::{cause::Cause, form, principal::Principal, room, schedule::GrowthSchedule};

/// A scene, the generators that grow it, and every operation done so far.
///
/// A document is a function of its seed and of the commands applied, in their order.
#[derive(Clone, Debug)]
pub struct Document {
    simulation: Simulation<Generators>,
    history: History,
    futures: Futures,
    strokes: OpenStrokes,
    bends: OpenBends,
    obstacles: Obstacles,
    appearance: Arc<Appearance>,
    designs: Designs,
    pending: VecDeque<Pending>,
    /// The step of a grammar that is on its way, for a command that may still be refused,
    underway: Option<Box<Underway>>,
    /// and what became of that.
    outcome: Option<Result<(), Problem>>,
    hints: Hints,
    /// What came of the last deed that was taken back or brought back, until it is told.
    switched: Option<Switched>,
    steps_begun: u32,
    /// Where growth ends, as counted by `steps_begun`.
    stop_at: Option<u32>,
    /// Sections of a later program that this one carries along unread.
    unknown: Vec<Section>,
}

/// Figures of a document as a whole. Leaves are counted by whoever draws it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// The present simulation step.
    pub step: u32,
    /// The age of the plants.
    pub age: u32,
    /// Living metamers.
    pub metamers: u32,
    /// Living axes with wood.
    pub axes: u32,
    /// Metamers the document may hold.
    pub metamer_budget: u32,
    /// Whether it holds as many.
    pub budget_reached: bool,
    /// Whether there is an operation to undo.
    pub can_undo: bool,
    /// Whether there is something to redo.
    pub can_redo: bool,
    /// Steps still to be run.
    pub pending_steps: u32,
    /// How many of them are trials of a design that is being fitted, at most.
    pub trials: u32,
    /// Steps begun up to now, whatever was taken back since.
    pub steps_begun: u32,
}

impl Document {
    /// A seedling.
    pub fn new(seed: u32) -> Self {
        Self::of(seed, Parameters::default())
    }

    /// A seedling that starts with these parameters.
    pub fn with_parameters(seed: u32, wanted: &ParameterValues) -> Result<Self, Problem> {
        Ok(Self::of(seed, Parameters::new(wanted.clone())?))
    }

    fn of(seed: u32, parameters: Parameters) -> Self {
        let obstacles = Obstacles::default();
        let appearance = Arc::new(Appearance::default());
        let schedule = Arc::new(GrowthSchedule::plain(parameters.clone()));
        let initial = Setting {
            schedule: Arc::clone(&schedule),
            obstacles: Arc::clone(&obstacles.standing),
            appearance: Arc::clone(&appearance),
            design: None,
            let_go: Arc::default(),
        };
        Self {
            simulation: Simulation::new(seed, parameters)
                .grown_by(|growth| Generators::new(growth, schedule, GeneratorState::default())),
            history: History::new(initial),
            futures: Futures::default(),
            strokes: OpenStrokes::default(),
            bends: OpenBends::default(),
            obstacles,
            appearance,
            designs: Designs::default(),
            pending: VecDeque::new(),
            underway: None,
            outcome: None,
            hints: Hints::default(),
            switched: None,
            steps_begun: 0,
            stop_at: None,
            unknown: Vec::new(),
        }
    }

    /// Takes a command on; the steps it needs become pending. Nothing changes if it is refused, which may come only while
    /// it [goes on](Document::take_outcome).
    pub fn begin(&mut self, author: &Principal, command: &Command) -> Result<(), Problem> {
        while self.advance() {}
        self.outcome = None;
        let Command { action, gesture } = command;
        self.take_on(Cause { author, gesture: *gesture }, action)?;
        if !self.is_undecided() {
            self.forget_futures();
        }
        Ok(())
    }

    fn take_on(&mut self, cause: Cause<'_>, action: &Action) -> Result<(), Problem> {
        let author = cause.author;
        if keeps_set(action) {
            self.require_sets()?;
        }
        if moves_time(action) {
            self.require_nobody_else_at_work(author)?;
        }
        match action {
            Action::StrokeBegin { stroke, bud } => self.begin_stroke(cause, *stroke, *bud),
            Action::StrokeMove { stroke, samples } => {
                let longest = self.simulation.parameters().max_shoot_length;
                let steps = self.strokes.extend(author, *stroke, samples, longest)?;
                self.pending.extend(steps.into_iter().map(Pending::Brush));
                Ok(())
            }
            Action::StrokeEnd { stroke } => {
                let stroke = self.strokes.close(author, *stroke)?;
                self.pending.push_back(Pending::Settle { stroke, left: MAX_OUTLINE_STEPS });
                Ok(())
            }
            Action::Grow { steps, until, bud } => self.begin_growth(cause, *steps, *until, *bud),
            Action::Lasso { outline, plane, depth, bud } => {
                self.begin_lasso(cause, outline, plane, *depth, *bud)
            }
            // What it ends was begun before, and has ended by now.
            Action::Stop { .. } => Ok(()),
            Action::Ungrow { steps } => self.ungrow(steps.get()),
            Action::Undo {} => self.travel_back(),
            Action::Redo {} => self.travel_forth(),
            Action::TakeBack { keys } => self.take_back(cause, &Person::new(author, keys)),
            Action::BringBack { keys } => self.bring_back(cause, &Person::new(author, keys)),
            Action::SetParameters { parameters } => self.set_parameters(cause, parameters),
            Action::SetProgramme { programme, keep } => self.set_programme(cause, programme.as_ref(), *keep),
            Action::FollowProgramme { parameters } => self.follow_programme(cause, parameters),
            Action::SetAppearance { appearance } => self.set_appearance(cause, appearance),
            Action::PlantSeed { position } => self.plant_seed(cause, *position),
            Action::PlaceObstacle { obstacle } => self.place_obstacle(cause, obstacle),
            Action::MoveObstacle { id, pose } => self.move_obstacle(cause, *id, pose),
            Action::ReshapeObstacle { id, shape } => self.reshape_obstacle(cause, *id, shape),
            Action::RemoveObstacle { id } => self.remove_obstacle(cause, *id),
            Action::BendBegin { bend, base, touches, stretch } => {
                self.begin_bend(cause, *bend, *base, touches, *stretch)
            }
            Action::BendMove { bend, targets } => self.move_bend(cause, *bend, targets),
            Action::BendEnd { bend } => self.end_bend(cause, *bend),
            Action::BendCancel { bend } => self.bends.close(author, *bend).map(|_| ()),
            Action::SetWidth { row, diameter } => self.set_width(cause, *row, *diameter),
            Action::Prune { rows } => self.prune(cause, rows),
            Action::PruneDim { exposure } => self.prune_dim(cause, *exposure),
            Action::TurnBranch { row, rotation } => self.turn_branch(cause, *row, *rotation),
            Action::Graft { row, onto, rotation, keep } => self.graft(cause, *row, *onto, *rotation, *keep),
            Action::NewDesign { position, template, graph } => {
                self.begin_design(cause, *position, template.as_ref(), graph.as_ref())
            }
            Action::EditDesign { edits } => self.edit_design(cause, edits),
            Action::ReleaseDesign {} => self.release_design(cause),
            Action::FitDesign { row, orders } => self.fit_design(cause, *row, *orders),
            Action::Refill { row, envelope, rotation, length, anew } => {
                let outline =
                    refilling::Outline { envelope, rotation: *rotation, length: *length, anew: *anew };
                self.refill(cause, *row, &outline)
            }
            Action::SetGrammar { text, values, seed, position, depth, within } => {
                let planting = grammars::Planting {
                    text,
                    values,
                    seed: *seed,
                    position: *position,
                    within: within.as_ref(),
                    depth: depth.map(Steps::get),
                };
                self.set_grammar(cause, &planting)
            }
            Action::SetGrammarBody { within } => self.set_grammar_body(cause, within.as_ref()),
            Action::Derive { steps } => self.derive(cause, steps.get()),
            Action::SetGrammarValues { values } => self.set_grammar_values(cause, values),
            Action::GoTo { step } => self.go_to(*step),
            Action::TakeFuture { future } => self.take_future(*future),
        }
    }

    /// Takes a command on and runs all its steps.
    pub fn apply(&mut self, author: &Principal, command: &Command) -> Result<(), Problem> {
        self.begin(author, command)?;
        while self.advance() {}
        self.take_outcome()
    }

    /// The strokes an author has begun and not ended.
    pub fn open_strokes(&self, author: &Principal) -> Vec<u32> {
        self.strokes.of(author)
    }

    /// The document's figures. Counts axes, so it costs a pass over them.
    pub fn figures(&self) -> Figures {
        let plant = self.simulation.plant();
        Figures {
            step: plant.step(),
            age: self.age(),
            metamers: plant.living_count(),
            axes: plant.living_axes_count(),
            metamer_budget: self.simulation.scene().metamer_budget(),
            budget_reached: self.require_room().is_err(),
            can_undo: self.history.done > 0 || self.strays(),
            can_redo: self.history.can_redo(plant.step()),
            pending_steps: self.pending_steps(),
            trials: self.trials(),
            steps_begun: self.steps_begun,
        }
    }

    /// Living metamers.
    pub fn metamers(&self) -> u32 {
        self.simulation.plant().living_count()
    }

    /// What it takes of memory, in rows: metamers, dead ones and those of its futures included, what grammars keep, and as
    /// many triangles of obstacles as [`Document::held_triangles`] said last.
    pub(crate) fn held_rows(&self, triangles: u64) -> u64 {
        let rows = self.simulation.plant().recorded_metamers() + self.futures.metamers();
        let words = self.simulation.generator().bytes_of_words();
        room::as_rows(rows as u64, triangles) + room::grammars_as_rows(self.held_by_grammars().0, words)
    }

    /// The parameters in force.
    pub fn parameters(&self) -> ParameterValues {
        self.simulation.parameters().values().clone()
    }

    /// The seed of all randomness.
    pub fn seed(&self) -> u32 {
        self.simulation.seed()
    }

    /// The plants.
    pub fn plant(&self) -> &Plant {
        self.simulation.plant()
    }

    /// The plant with the looks of the present, for whoever draws it.
    pub fn portrait(&mut self) -> &Plant {
        self.simulation.show();
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
        hash.word(u64::from(self.last_step()));
        for marker in self.simulation.markers() {
            hash.vector(marker.position);
            hash.word(u64::from(marker.born));
        }
        for value in settings::to_words(self.simulation.parameters().values()) {
            hash.word(value);
        }
        self.hash_schedule(&mut hash);
        for value in settings::to_words(&*self.appearance) {
            hash.word(value);
        }
        self.history.hash(&mut hash);
        self.futures.hash(&mut hash);
        self.strokes.hash(&mut hash);
        self.bends.hash(&mut hash);
        self.obstacles.hash(&mut hash);
        if let Some(design) = self.design_in_force() {
            design.hash(&mut hash);
        }
        self.history.setting().let_go.iter().for_each(|design| design.hash(&mut hash));
        self.simulation.generator().state().written.hash(&mut hash);
        hash.word(u64::from(self.steps_begun));
        hash.finish()
    }

    fn plant_seed(&mut self, cause: Cause<'_>, position: Position) -> Result<(), Problem> {
        let position = form::on_ground(position)?;
        if self.simulation.scene().is_solid(position) {
            let value = format!("{position}, in an obstacle");
            let problem = Problem::out_of_range("position", value, "a place outside all obstacles");
            return Err(Problem { reason: Reason::InObstacle, ..problem });
        }
        self.require_room()?;
        self.record(Kind::Seed, cause);
        self.simulation.sow(position);
        self.reach();
        Ok(())
    }

    /// Ends all strokes where they are and cancels bends, whose authors are not connected any more.
    pub fn end_gestures(&mut self) {
        self.strokes.close_all();
        self.bends.close_all();
        self.simulation.drop_guidance();
    }

    /// The living metamer with a row; seeds are no wood.
    fn wood(&self, field: &str, row: u32) -> Result<MetamerId, Problem> {
        wood_of(self.plant(), field, row)
    }
}

/// Whether it leaves a set of parameters, looks or obstacles in the history.
fn keeps_set(action: &Action) -> bool {
    matches!(
        action,
        Action::SetParameters { .. }
            | Action::SetProgramme { .. }
            | Action::FollowProgramme { .. }
            | Action::SetAppearance { .. }
            | Action::PlaceObstacle { .. }
            | Action::MoveObstacle { .. }
            | Action::ReshapeObstacle { .. }
            | Action::RemoveObstacle { .. }
            | Action::NewDesign { .. }
            | Action::EditDesign { .. }
            | Action::ReleaseDesign {}
            | Action::FitDesign { .. }
            | Action::SetGrammar { .. }
            | Action::SetGrammarBody { .. }
            | Action::Derive { .. }
            | Action::SetGrammarValues { .. }
            | Action::TakeBack { .. }
            | Action::BringBack { .. }
    )
}

fn wood_of(plant: &Plant, field: &str, row: u32) -> Result<MetamerId, Problem> {
    let metamer = living(plant, field, row)?;
    if plant.is_seed(metamer) { Err(branch_gone(field, row)) } else { Ok(metamer) }
}

/// A living metamer, seeds included.
fn living(plant: &Plant, field: &str, row: u32) -> Result<MetamerId, Problem> {
    let is_known = (row as usize) < plant.metamer_count();
    let metamer = is_known.then(|| MetamerId::new(row as usize));
    metamer.filter(|&id| plant.is_alive(id)).ok_or_else(|| branch_gone(field, row))
}

fn branch_gone(field: &str, row: u32) -> Problem {
    Problem::new(Reason::BranchGone, format!("there is no living metamer with row {row}"))
        .at(field, "the row of a living metamer")
}
