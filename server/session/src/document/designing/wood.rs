//! The wood of designs in the plants: shown anew where the design changes, and whole where the line of time is left.

use std::sync::Arc;

use espalier_design::{Design, Generator, MAX_INTERNODES};
use espalier_growth::EditError;
use espalier_plant::{MetamerId, Plant};

use super::{Designed, Document, Shown};
use crate::document::history::Operation;

impl Document {
    /// The wood of a design whose step the plants have; made by the line where it is not at hand.
    pub(super) fn shown(&mut self, of: &Arc<Designed>) -> Option<&mut Shown> {
        let first = first_of(self.plant(), of.step);
        let is_there = |shown: &Shown| shown.of.step == of.step && shown.first == first;
        let is_at_hand = self.designs.shown.as_ref().is_some_and(is_there);
        if !is_at_hand {
            let last = last_of(&self.history.operations, of.step).unwrap_or_else(|| Arc::clone(of));
            self.designs.shown = made(&last, self.plant());
        }
        self.designs.shown.as_mut()
    }

    /// Shows a design where the plants are at its step.
    pub(in crate::document) fn show_design(&mut self, design: Option<&Arc<Designed>>) {
        let Some(design) = design.filter(|design| design.step == self.plant().step()) else { return };
        let Some(shown) = self.shown(design) else { return };
        if shown.of == *design {
            shown.of = Arc::clone(design);
            return;
        }
        if let Ok(read) = design.read() {
            // What stood before stands again; where a smaller budget has been set since, it does not fit.
            let _stands = self.put_wood(design, read);
        }
    }

    /// Shows the design that the line has at the present.
    pub(in crate::document) fn keep_to_design(&mut self) {
        let design = self.history.setting().design.clone();
        self.show_design(design.as_ref());
    }

    /// Shows the last design that the line has at the present step: rows ahead stand on that one.
    pub(in crate::document) fn show_last_design_here(&mut self) {
        self.show_last_design_of(&[]);
    }

    /// The same of a line that goes on with these operations.
    pub(in crate::document) fn show_last_design_of(&mut self, ahead: &[Operation]) {
        let now = self.plant().step();
        let last = last_of(ahead, now).or_else(|| last_of(&self.history.operations, now));
        self.show_design(last.as_ref());
    }

    /// Knows which wood of a design stands in the present step, before operations of a complete line are taken away.
    pub(in crate::document) fn know_design_here(&mut self) {
        if let Some(last) = last_of(&self.history.operations, self.plant().step()) {
            self.shown(&last);
        }
    }

    /// Whether the plants have all rows of the line, and each step of a design as the line leaves it.
    pub(in crate::document) fn is_line_complete(&self) -> bool {
        let Some(shown) = &self.designs.shown else { return true };
        let last = last_of(&self.history.operations, shown.of.step);
        self.designs.aside.is_none() && last.is_none_or(|last| last == shown.of)
    }

    /// Gives the plants all rows of the line, before it is left or written.
    pub(in crate::document) fn complete_line(&mut self) {
        if self.is_line_complete() {
            return;
        }
        self.show_last_design_here();
        if let Some(rows) = self.designs.aside.take() {
            // They were cut off right here.
            let _fits = self.simulation.take_future(rows);
        }
    }

    /// Forgets how wood was made that is gone with the rows ahead.
    pub(in crate::document) fn forget_wood_ahead(&mut self) {
        let now = self.plant().step();
        self.designs.shown.take_if(|shown| shown.of.step > now);
    }

    /// The last step of the line, whether its rows are in the plants or aside.
    pub(in crate::document) fn last_step(&self) -> u32 {
        let aside = self.designs.aside.as_ref().map(|rows| rows.step() + rows.steps());
        aside.unwrap_or_else(|| self.plant().last_step())
    }

    /// Puts the wood of a design in place of what stands in its step, which is the present one.
    pub(super) fn put_wood(&mut self, of: &Arc<Designed>, design: Design) -> Result<(), EditError> {
        let now = self.plant().step();
        let Some(Shown { generator, generated: former, .. }) = self.shown(of) else { return Ok(()) };
        let generated = generator.generate(&design, MAX_INTERNODES);
        let is_same = generated.wood == former.wood;
        let first = first_of(self.plant(), now);
        if !is_same {
            if self.plant().last_step() > now {
                self.designs.aside = Some(self.simulation.stash_future());
            }
            let cuts: Vec<MetamerId> = self.plant().cut_in(now).collect();
            self.simulation.go_to(now - 1);
            let before = self.simulation.stash_future();
            if let Err(error) = self.simulation.replant(&cuts, &generated.wood, of.at) {
                // It was cut off right here.
                let _fits = self.simulation.take_future(before);
                self.simulation.go_to(now);
                self.keep_state();
                return Err(error);
            }
            self.keep_state();
            let is_older = |path: &[MetamerId]| path.iter().all(|id| id.raw() < first);
            self.bends.open.retain(|bend| is_older(&bend.path));
        }
        if let Some(shown) = &mut self.designs.shown {
            shown.of = Arc::clone(of);
            shown.design = Arc::new(design);
            shown.generated = Arc::new(generated);
            shown.first = first;
        }
        Ok(())
    }
}

/// The last design of a step that operations leave in force.
fn last_of(operations: &[Operation], step: u32) -> Option<Arc<Designed>> {
    let of_step = |operation: &Operation| operation.after.design.clone().filter(|design| design.step == step);
    operations.iter().rev().find_map(of_step)
}

/// A design whose wood the plants have, with all that its wood is made by.
pub(super) fn made(of: &Arc<Designed>, plant: &Plant) -> Option<Shown> {
    let design = of.read().ok()?;
    let mut generator = Generator::default();
    let generated = generator.generate(&design, MAX_INTERNODES);
    let first = first_of(plant, of.step);
    Some(Shown {
        of: Arc::clone(of),
        design: Arc::new(design),
        generator,
        generated: Arc::new(generated),
        first,
    })
}

/// The first row that was born in a step or later.
pub(super) fn first_of(plant: &Plant, step: u32) -> u32 {
    let (mut from, mut to) = (0, plant.metamer_count());
    while from < to {
        let middle = from.midpoint(to);
        if plant.birth(MetamerId::new(middle)) < step { from = middle + 1 } else { to = middle }
    }
    from as u32
}
