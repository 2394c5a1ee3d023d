//! Predictions: how the plants would grow on without some branches (`PD`).
//!
//! A prediction works on a copy of the simulation, beside the document's own work, in slices as that does.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use espalier_growth::{NoObserver, Simulation};
use espalier_mesh::{RingTable, Style};
use espalier_proto::{GhostFrame, Problem, Reason};

use crate::{
    document::{Generators, Step, prune_simulation},
    io::ClientId,
    to_proto::{self, Held},
};

/// Steps of one slice, so that other work has its turn.
const SLICE_STEPS: u32 = 4;

/// Set when a prediction is cancelled.
pub(crate) type Cancelled = Arc<AtomicBool>;

/// What is predicted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Prediction {
    /// Rows of branches to do without.
    pub(crate) rows: Vec<u32>,
    /// How many steps are grown; 0 with rows shows the cut alone.
    pub(crate) steps: u32,
}

/// What a client wants to know.
#[derive(Debug)]
pub(crate) struct Question {
    pub(crate) client: ClientId,
    /// The client's predictions are counted: also the sequence of the ghost.
    pub(crate) number: u32,
    pub(crate) prediction: Prediction,
    pub(crate) cancelled: Cancelled,
}

/// A prediction in the making. Owns all it needs: call [`PredictionRun::run`] on any thread until it is done.
#[derive(Debug)]
pub struct PredictionRun {
    pub(crate) question: Question,
    epoch: u32,
    /// The plants to come; `None` when nothing is left to do.
    simulation: Option<Box<Simulation<Generators>>>,
    is_cut: bool,
    left: u32,
    style: Style,
    /// The ghost, or why there is none; nothing while it is made, or when it was cancelled.
    pub(crate) answer: Option<Result<Arc<[u8]>, Problem>>,
}

impl PredictionRun {
    pub(crate) fn new(
        question: Question,
        simulation: Simulation<Generators>,
        style: Style,
        epoch: u32,
    ) -> Self {
        let left = question.prediction.steps;
        Self {
            question,
            epoch,
            simulation: Some(Box::new(simulation)),
            is_cut: false,
            left,
            style,
            answer: None,
        }
    }

    /// A prediction for which there is no memory (`LM19`).
    pub(crate) fn refused(question: Question, style: Style, epoch: u32) -> Self {
        let (simulation, is_cut, left) = (None, false, 0);
        let mut run = Self { question, epoch, simulation, is_cut, left, style, answer: None };
        run.refuse();
        run
    }

    /// There is no memory for the rest of it (`LM19`): it goes back as [`crate::Input::Predicted`].
    pub fn refuse(&mut self) {
        let problem = Problem::new(Reason::MemoryFull, "the server has no memory for a prediction now");
        self.simulation = None;
        self.answer = Some(Err(problem.at("steps", "a prediction while there is memory for it")));
    }

    /// What its plants take of memory, in rows.
    pub fn held_rows(&self) -> u64 {
        self.simulation.as_ref().map_or(0, |simulation| simulation.plant().metamer_count() as u64)
    }

    /// Does one slice, which ends after the step at which `is_over` says so; true when the prediction is done and goes
    /// back as [`crate::Input::Predicted`].
    pub fn run(&mut self, is_over: impl Fn() -> bool) -> bool {
        let Some(mut simulation) = self.simulation.take() else { return true };
        if self.question.cancelled.load(Ordering::Relaxed) {
            return true;
        }
        if !self.is_cut {
            self.is_cut = true;
            if let Err(problem) = prune_simulation(&mut simulation, &self.question.prediction.rows) {
                self.answer = Some(Err(problem));
                return true;
            }
        }
        for _ in 0..SLICE_STEPS.min(self.left) {
            if self.question.cancelled.load(Ordering::Relaxed) {
                return true;
            }
            simulation.step(&Step::Age { chosen: None, until: u32::MAX }, &mut NoObserver);
            self.left = if simulation.is_out_of_budget() { 0 } else { self.left - 1 };
            if is_over() {
                break;
            }
        }
        if self.left > 0 {
            self.simulation = Some(simulation);
            return false;
        }
        simulation.show();
        let mut table = RingTable::new();
        table.sync(simulation.plant(), &self.style, 1);
        let changes = to_proto::catch_up(&table, &Held::Nothing, self.epoch, 1).changes;
        let ghost = GhostFrame { epoch: self.epoch, sequence: self.question.number, changes };
        self.answer = Some(Ok(ghost.encode().into()));
        true
    }
}
