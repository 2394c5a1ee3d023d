//! Width constraints (`WI`).

use espalier_plant::MetamerId;
use espalier_proto::{Diameter, Problem, Reason};

use super::{
    Document,
    history::{Kind, Latest},
};
use crate::cause::Cause;

/// Width constraints in force at once (`LM12`): all of them are sent to everybody after each change.
pub(super) const MAX_WIDTHS: usize = 256;

impl Document {
    pub(super) fn set_width(
        &mut self,
        cause: Cause<'_>,
        row: u32,
        diameter: Option<Diameter>,
    ) -> Result<(), Problem> {
        let diameter = diameter.map(Diameter::get);
        let metamer = self.wood("row", row)?;
        if let Some(designed) = self.designed(&[row]) {
            return self.widen_designed(cause, designed[0], diameter);
        }
        if self.width(metamer) == diameter {
            return Ok(());
        }
        if diameter.is_some() && self.width(metamer).is_none() {
            self.require_widths(1)?;
        }
        let now = self.plant().step();
        let continues = self.history.continues(&[Kind::Width], cause, now);
        if continues && self.replaces(row) {
            self.take_back_latest();
        } else if !continues {
            self.record(Kind::Width, cause);
        }
        self.simulation.set_width(metamer, diameter);
        self.reach();
        let step = self.plant().step();
        // Back where the gesture began, there is nothing to undo.
        self.forget_idle();
        let is_kept = self.history.continues(&[Kind::Width], cause, step);
        self.history.latest = is_kept.then_some(Latest { step, row, rotation: None });
        Ok(())
    }

    /// Whether so many width constraints more may be in force (`LM12`).
    pub(super) fn require_widths(&self, more: usize) -> Result<(), Problem> {
        let held = self.plant().widths().count();
        if more == 0 || held + more <= MAX_WIDTHS {
            return Ok(());
        }
        let message =
            format!("{held} width constraints are in force, and {MAX_WIDTHS} may be; remove some first");
        Err(Problem::new(Reason::WidthsFull, message)
            .at("diameter", format!("up to {MAX_WIDTHS} width constraints")))
    }

    /// The constraint on a metamer.
    fn width(&self, metamer: MetamerId) -> Option<f32> {
        self.plant().widths().find(|&(id, _)| id == metamer).map(|(_, diameter)| diameter)
    }

    /// Whether an edit of this row, by the gesture in progress, takes the place of the edit made last. While
    /// somebody draws, time is not turned back below the brush.
    pub(super) fn replaces(&self, row: u32) -> bool {
        let now = self.plant().step();
        let is_latest = self.history.latest.is_some_and(|latest| latest.step == now && latest.row == row);
        is_latest && self.strokes.is_empty()
    }

    /// Takes back the step made last; what it did is forgotten.
    pub(super) fn take_back_latest(&mut self) {
        let before = self.plant().step().saturating_sub(1);
        self.simulation.go_to(before);
        self.simulation.stash_future();
        self.keep_state();
        self.reach();
    }
}
