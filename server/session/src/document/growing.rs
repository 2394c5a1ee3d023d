//! Growth of a document: what an action asks for becomes steps, and steps are run one by one.

use espalier_growth::{Envelope, NoObserver, Observer, Plane, Simulation, StepInput, StepOutcome, StrokeId};
use espalier_plant::MetamerId;
use espalier_proto::{
    Age, Depth, DrawingPlane, PlanePoint, Problem, Reason, Steps, version::MAX_OUTLINE_STEPS,
};
use glam::{Vec2, Vec3};

use super::{
    Document, branch_gone,
    designing::fitting,
    generators::{Generators, Step},
    hints::OpenLasso,
    history::Kind,
    strokes::OpenStroke,
};
use crate::{cause::Cause, principal::Principal};

/// Steps still to be run for an action taken on.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Pending {
    /// One step of brushing.
    Brush(StepInput),
    /// So many steps alike, without guidance by hand; whether any of them has changed anything so far.
    Steps { left: u32, has_grown: bool, step: Step },
    /// At most so many steps, while the markers of an envelope make anything grow; a lasso that may be drawn in vain.
    Lasso { left: u32, chosen: Option<MetamerId>, lasso: Option<OpenLasso> },
    /// The step of a grammar that is under way.
    Write,
    /// A design that is being fitted.
    Fit(Box<fitting::Underway>),
    /// At most so many steps for a lifted brush, while anything grows into what it left.
    Settle { stroke: OpenStroke, left: u32 },
}

impl Document {
    /// Runs one pending step; false when none is pending.
    pub fn advance(&mut self) -> bool {
        self.advance_observed(&mut NoObserver)
    }

    /// Runs one pending step under the eyes of someone with a clock; false when none is pending.
    pub fn advance_observed(&mut self, observer: &mut impl Observer) -> bool {
        let Some(pending) = self.pending.pop_front() else { return false };
        match pending {
            Pending::Brush(input) => {
                let strokes: Vec<StrokeId> = input.pieces.iter().map(|piece| piece.stroke).collect();
                let open = &self.strokes.open;
                let author =
                    open.iter().find(|open| strokes.contains(&open.id)).map(|open| open.author.clone());
                let guide = strokes.first().copied();
                self.resume_stroke(&author.unwrap_or_else(Principal::visitor), guide);
                self.step(&Step::Growth(input), guide, observer);
                strokes.into_iter().for_each(|stroke| self.hint_out_of_reach(stroke));
            }
            Pending::Steps { left, has_grown, step } => {
                let (now, age) = (self.plant().step(), self.age());
                // What was asked for is growth: only then does it end at an age.
                let last = if has_grown { age.saturating_add(left) } else { u32::MAX };
                if self.is_stopped() || step.is_over(age) {
                    self.simulation.generator_mut().give_up_writing();
                } else if self.step_in_part(&step.up_to(last), observer) {
                    self.pending.push_front(Pending::Steps { left, has_grown, step });
                } else {
                    if matches!(step, Step::Write(_)) {
                        self.keep_what_moved();
                    }
                    let left = left.saturating_sub((self.age() - age).max(1));
                    let has_grown = has_grown || self.plant().step() != now;
                    let goes_on = !matches!(step, Step::Write(_)) || self.may_derive();
                    if left > 0 && goes_on && !self.simulation.is_out_of_budget() {
                        self.pending.push_front(Pending::Steps { left, has_grown, step });
                    }
                }
            }
            // Where it does not stand nothing has happened.
            Pending::Write => {
                if !self.go_on_writing() {
                    return true;
                }
            }
            // Until it is planted nothing has happened.
            Pending::Fit(underway) => {
                self.go_on_fitting(underway);
                return true;
            }
            Pending::Lasso { left, chosen, lasso } => {
                let mut grows = false;
                if left > 0 && !self.is_stopped() {
                    let step = Step::Growth(StepInput { chosen, ..StepInput::default() });
                    grows = self.step(&step, None, observer).metamers_grown > 0;
                }
                if grows && !self.simulation.is_out_of_budget() {
                    self.pending.push_front(Pending::Lasso { left: left - 1, chosen, lasso });
                } else {
                    self.simulation.drop_envelopes();
                    lasso.into_iter().for_each(|lasso| self.hint_empty(lasso));
                }
            }
            Pending::Settle { stroke, left } => {
                let mut grows = false;
                if left > 0 && !self.is_stopped() && self.simulation.has_guidance() {
                    self.resume_stroke(&stroke.author, Some(stroke.id));
                    let step = Step::Growth(StepInput { chosen: stroke.chosen, ..StepInput::default() });
                    grows = self.step(&step, Some(stroke.id), observer).metamers_grown > 0;
                }
                if !grows {
                    self.hint_shortfall(&stroke);
                    self.simulation.end_stroke(stroke.id);
                    if self.strokes.is_empty() {
                        self.simulation.drop_guidance();
                    }
                } else {
                    self.pending.push_front(Pending::Settle { stroke, left: left - 1 });
                }
            }
        }
        self.reach();
        self.release_lost_bends();
        if self.pending.is_empty() && self.strokes.is_empty() {
            self.forget_idle();
        }
        true
    }

    /// The operation in progress has reached the present step.
    pub(super) fn reach(&mut self) {
        self.history.reach(self.plant().step());
        self.note_state();
    }

    /// A stroke grows on after somebody did something else meanwhile: what it grows from here on is an operation of
    /// its own, or undoing the other one would take it back as well (`CM5`).
    fn resume_stroke(&mut self, author: &Principal, stroke: Option<StrokeId>) {
        if self.history.current().is_some_and(|last| !last.kind.grows()) {
            self.record(Kind::Stroke, Cause::from(author));
        } else if let Some((last, stroke)) = self.history.current_mut().zip(stroke) {
            last.resume(author, stroke);
        }
    }

    /// Whether what somebody begins now becomes part of the operation in progress: somebody is drawing in it.
    fn joins(&self) -> bool {
        !self.strokes.is_empty() && self.history.current().is_some_and(|last| last.kind.grows())
    }

    /// Steps still to be run; a lasso and a stroke that settles count as one each, for nobody knows.
    pub fn pending_steps(&self) -> u32 {
        let steps = |pending: &Pending| match pending {
            Pending::Brush(_) | Pending::Lasso { .. } | Pending::Settle { .. } => 1,
            Pending::Write => self.underway.as_ref().map_or(0, |underway| underway.steps()),
            Pending::Fit(_) => self.trials(),
            Pending::Steps { left, .. } => *left,
        };
        self.pending.iter().map(steps).sum()
    }

    /// Whether somebody is in the midst of a stroke.
    pub(crate) fn has_open_strokes(&self) -> bool {
        !self.strokes.is_empty()
    }

    /// Steps begun up to now, those included in which nothing grew; going back in time takes none away.
    pub fn steps_begun(&self) -> u32 {
        self.steps_begun
    }

    /// From here on growth and lassos end when so many steps have been begun; none for no such end (`ST1`).
    /// Who replays a journal must say the same for the same commands.
    pub(crate) fn stop_at(&mut self, steps_begun: Option<u32>) {
        self.stop_at = steps_begun;
    }

    pub(super) fn begin_stroke(
        &mut self,
        cause: Cause<'_>,
        stroke: u32,
        bud: Option<u32>,
    ) -> Result<(), Problem> {
        let chosen = self.chosen(bud)?;
        let joins = self.joins();
        let overlaps =
            self.strokes.open.iter().rfind(|open| open.author == *cause.author).map(|open| open.id);
        let id = self.strokes.open(cause.author, stroke, chosen)?;
        // Strokes that overlap in time are one operation, of which each has a part: what one of them sows may grow in a step
        // of another's.
        if !joins {
            self.record(Kind::Stroke, cause);
        } else if let Some(last) = self.history.current_mut() {
            last.join(cause.author, id, overlaps);
        }
        Ok(())
    }

    pub(super) fn begin_growth(
        &mut self,
        cause: Cause<'_>,
        steps: Steps,
        until: Option<Age>,
        bud: Option<u32>,
    ) -> Result<(), Problem> {
        let chosen = self.chosen(bud)?;
        let until = until.map_or(u32::MAX, Age::get);
        self.begin_steps(cause, steps.get(), Step::Age { chosen, until })?;
        if chosen.is_some() {
            self.history.choose();
        }
        Ok(())
    }

    /// So many steps of one generator become pending, as one operation.
    pub(super) fn begin_steps(&mut self, cause: Cause<'_>, steps: u32, step: Step) -> Result<(), Problem> {
        self.require_room()?;
        let now = self.plant().step();
        let continues = self.history.continues(&[Kind::Growth, Kind::Prune], cause, now);
        if !self.joins() && !continues {
            self.record(Kind::Growth, cause);
        }
        self.ask(cause, false);
        self.pending.push_back(Pending::Steps { left: steps, has_grown: false, step });
        Ok(())
    }

    pub(super) fn begin_lasso(
        &mut self,
        cause: Cause<'_>,
        outline: &[PlanePoint],
        plane: &DrawingPlane,
        depth: Depth,
        bud: Option<u32>,
    ) -> Result<(), Problem> {
        self.require_room()?;
        let chosen = self.chosen(bud)?;
        let outline: Vec<Vec2> = outline.iter().map(|point| point.get()).collect();
        let (right, up) = plane.axes();
        let plane = Plane { origin: plane.origin(), right, up };
        let zone = self.simulation.parameters().occupancy_radius;
        let envelope = Envelope::inflate(&outline, plane, depth.get(), zone).map_err(|error| {
            Problem::new(Reason::NoRoom, format!("nothing can grow into this: {error}"))
                .at("outline", "an outline around some room")
        })?;
        let continues = self.history.continues(&[Kind::Lasso], cause, self.plant().step());
        if !self.joins() && !continues {
            self.record(Kind::Lasso, cause);
        }
        self.ask(cause, true);
        self.simulation.enclose(&envelope);
        let places: Vec<Vec3> = outline.iter().map(|at| plane.origin + right * at.x + up * at.y).collect();
        let lasso = Some(self.opened_lasso(envelope, &places));
        self.pending.push_back(Pending::Lasso { left: MAX_OUTLINE_STEPS, chosen, lasso });
        Ok(())
    }

    /// Somebody asks for growth while others may be drawing.
    fn ask(&mut self, cause: Cause<'_>, by_hand: bool) {
        if let Some(last) = self.history.current_mut() {
            last.ask(cause.author, by_hand);
        }
    }

    /// The metamer with this row, if one is asked for (`SG1`).
    fn chosen(&self, row: Option<u32>) -> Result<Option<MetamerId>, Problem> {
        let Some(row) = row else { return Ok(None) };
        let plant = self.plant();
        let is_known = (row as usize) < plant.metamer_count();
        let metamer = is_known.then(|| MetamerId::new(row as usize)).filter(|&id| plant.is_alive(id));
        metamer.map(Some).ok_or_else(|| branch_gone("bud", row))
    }

    pub(super) fn require_room(&self) -> Result<(), Problem> {
        let (held, budget) = (self.plant().metamer_count() as u32, self.simulation.scene().metamer_budget());
        if held < budget {
            return Ok(());
        }
        let message = format!("the document holds {held} metamers, its budget is {budget}");
        let allowed = format!("what grows while there are fewer than {budget} metamers");
        Err(Problem::new(Reason::TreeFull, message).at("kind", allowed))
    }

    /// Runs a step, perhaps one that a stroke guides.
    pub(super) fn step(
        &mut self,
        step: &Step,
        guide: Option<StrokeId>,
        observer: &mut impl Observer,
    ) -> StepOutcome {
        let born = self.plant().metamer_count() as u32;
        self.steps_begun = self.steps_begun.wrapping_add(1);
        let kept = self.kept();
        self.simulation.generator_mut().keep_what_began_in(kept);
        let outcome = self.simulation.step(step, observer);
        let born = born..self.plant().metamer_count() as u32;
        if let Some(last) = self.history.current_mut() {
            last.note_births(born, guide, &outcome.shares);
        }
        // Whether something is derived again depends on what is at hand, and the count must not.
        if matches!(step, Step::Write(_)) && self.simulation.generator().grammars().was_again {
            self.steps_begun = self.steps_begun.wrapping_sub(1);
        }
        outcome
    }

    /// The same; whether the step is not at its end then.
    fn step_in_part(&mut self, step: &Step, observer: &mut impl Observer) -> bool {
        self.step(step, None, observer);
        self.simulation.generator().grammars().is_writing()
    }

    /// The steps in which wood began that is not to be shed: what was drawn, unless somebody has set by hand what is shed.
    /// A programme gives the habit, and that does not take away what was drawn.
    fn kept(&self) -> Vec<(u32, u32)> {
        match self.simulation.generator().schedule().by_hand().shedding_threshold {
            Some(_) => Vec::new(),
            None => self.history.drawn(),
        }
    }

    /// A copy of the simulation that goes on as the document would, for a prediction.
    pub(crate) fn fork(&self) -> Simulation<Generators> {
        let mut fork = self.simulation.clone();
        fork.generator_mut().keep_what_began_in(self.kept());
        fork
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.stop_at.is_some_and(|end| self.steps_begun >= end)
    }
}
