//! Going back and forth on the present line of time.

use std::sync::Arc;

use espalier_proto::{Action, Problem, Reason};

use super::Document;
use crate::principal::Principal;

impl Document {
    /// So many steps back, with parameters, looks and obstacles as they are (`CM7`).
    pub(super) fn ungrow(&mut self, steps: u32) -> Result<(), Problem> {
        let now = self.plant().step();
        if now == 0 {
            let message = "the plant is a seed; there is nothing to ungrow";
            return Err(Problem::new(Reason::NothingToUngrow, message)
                .at("kind", "ungrow, where a step has grown something"));
        }
        let step = now.saturating_sub(steps);
        self.history.done = self.history.done.min(self.history.done_at(step));
        self.travel(step);
        Ok(())
    }

    pub(super) fn undo(&mut self) -> Result<(), Problem> {
        if self.strays() {
            self.keep_to_line();
            return Ok(());
        }
        let step = self.history.undo().ok_or_else(nothing_to_undo)?;
        self.travel(step);
        self.keep_to_line();
        Ok(())
    }

    pub(super) fn redo(&mut self) -> Result<(), Problem> {
        let now = self.plant().step();
        let step = self.history.redo(now).ok_or_else(nothing_to_redo)?;
        self.travel(step);
        self.keep_to_line();
        Ok(())
    }

    /// To a step of the line, with the parameters, looks and obstacles it had there (`TT2`).
    pub(super) fn go_to(&mut self, step: u32) -> Result<(), Problem> {
        let last = self.last_step();
        if step > last {
            return Err(Problem::out_of_range("step", step, format!("0 to {last}")));
        }
        self.history.done = self.history.done_at(step);
        self.travel(step);
        self.keep_to_line();
        Ok(())
    }

    /// Moving time is everybody's, and ends what is in progress: it waits for the strokes and bends of others (`TT7`).
    pub(super) fn require_nobody_else_at_work(&self, author: &Principal) -> Result<(), Problem> {
        if self.strokes.open.iter().any(|open| open.author != *author) {
            let message = "somebody else is drawing; wait until the brush is lifted";
            return Err(
                Problem::new(Reason::BeingDrawn, message).at("kind", "a journey while nobody else draws")
            );
        }
        self.require_no_bend_but_of(|of| of == author)
    }

    /// Whether parameters, looks or obstacles are not those of the line: ungrowing leaves them as they are.
    pub(super) fn strays(&self) -> bool {
        let line = self.history.setting();
        let is_placed = Arc::ptr_eq(&line.obstacles, &self.obstacles.standing);
        !is_placed || line.schedule != *self.schedule() || *line.appearance != *self.appearance
    }

    /// Puts the line's setting in force.
    pub(super) fn keep_to_line(&mut self) {
        let setting = self.history.setting().clone();
        self.set(&setting);
        // What was done to the obstacles is no news to the generators.
        self.keep_state();
    }

    /// Travels in time; strokes in progress end where they are, and bends are given up.
    pub(super) fn travel(&mut self, step: u32) {
        self.strokes.close_all();
        self.bends.close_all();
        self.history.latest = None;
        self.history.before = None;
        if step != self.plant().step() {
            self.complete_line();
        }
        self.simulation.go_to(step);
        self.keep_state();
    }
}

/// Whether an action takes everybody to another time.
pub(super) fn moves_time(action: &Action) -> bool {
    matches!(
        action,
        Action::Ungrow { .. }
            | Action::Undo {}
            | Action::Redo {}
            | Action::GoTo { .. }
            | Action::TakeFuture { .. }
    )
}

pub(super) fn nothing_to_undo() -> Problem {
    Problem::new(Reason::NothingToUndo, "there is nothing to undo")
        .at("kind", "undo, where something was done")
}

pub(super) fn nothing_to_redo() -> Problem {
    Problem::new(Reason::NothingToRedo, "there is nothing to redo")
        .at("kind", "redo, where something was undone")
}
