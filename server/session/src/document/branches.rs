//! Whole branches turned about their base, copied and moved (`BR`).

use espalier_growth::{EditError, Original};
use espalier_plant::{MetamerId, Motion};
use espalier_proto::{Problem, Reason, UnitRotation};
use glam::{Quat, Vec3};

use super::{
    Document,
    history::{Kind, Latest},
};
use crate::cause::Cause;

impl Document {
    pub(super) fn turn_branch(
        &mut self,
        cause: Cause<'_>,
        row: u32,
        rotation: UnitRotation,
    ) -> Result<(), Problem> {
        let rotation = rotation.get();
        let branch = self.wood("row", row)?;
        let base = self.base_of(branch, Reason::TrunkTurned, "turned")?;
        self.require_no_bend_of(branch)?;
        if let Some(designed) = self.designed(&[row]) {
            return self.turn_designed(cause, designed[0], rotation);
        }
        let places = self.plant().above(branch).len();
        self.require_places(places)?;
        let now = self.plant().step();
        let continues = self.history.continues(&[Kind::Turn], cause, now);
        if continues && self.replaces(row) {
            return self.turn_again(branch, base, rotation);
        }
        // Where the gesture's step cannot be taken back, what is new about its rotation comes on top.
        let latest = self.history.latest.filter(|latest| continues && latest.row == row);
        let so_far = latest.and_then(|latest| latest.rotation).unwrap_or(Quat::IDENTITY);
        let recorded = (!continues).then(|| self.record(Kind::Turn, cause));
        let motion = self.turn_about(branch, base, rotation * so_far.inverse());
        match self.simulation.carry(&[branch], &[motion]) {
            Ok(()) if self.plant().step() > now => self.turned(row, rotation, places),
            outcome => {
                if let Some(recorded) = recorded {
                    self.refuse(recorded);
                }
                outcome.map_err(said("rotation"))?;
            }
        }
        Ok(())
    }

    /// Turns a branch from where it was before the gesture in progress.
    fn turn_again(&mut self, branch: MetamerId, base: Vec3, rotation: Quat) -> Result<(), Problem> {
        let now = self.plant().step();
        self.simulation.go_to(now - 1);
        let former = self.simulation.stash_future();
        self.keep_state();
        let motion = self.turn_about(branch, base, rotation);
        if let Err(error) = self.simulation.carry(&[branch], &[motion]) {
            // It was cut off right here.
            let _fits = self.simulation.take_future(former);
            self.simulation.go_to(now);
            self.keep_state();
            return Err(said("rotation")(error));
        }
        if self.plant().step() == now {
            self.history.latest = Some(Latest { step: now, row: branch.raw(), rotation: Some(rotation) });
            self.note_state();
        } else {
            self.history.latest = None;
            self.reach();
            self.forget_idle();
        }
        Ok(())
    }

    fn turned(&mut self, row: u32, rotation: Quat, places: usize) {
        let step = self.plant().step();
        self.reach();
        self.history.keep_places(places);
        self.history.latest = Some(Latest { step, row, rotation: Some(rotation) });
    }

    pub(super) fn graft(
        &mut self,
        cause: Cause<'_>,
        row: u32,
        onto: u32,
        rotation: UnitRotation,
        keep: bool,
    ) -> Result<(), Problem> {
        let rotation = rotation.get();
        let branch = self.wood("row", row)?;
        let bearer = self.wood("onto", onto)?;
        let rows = self.plant().above(branch);
        let is_on_branch = rows.binary_search(&bearer).is_ok();
        if is_on_branch {
            let message = format!("row {onto} belongs to the very branch that begins with row {row}");
            return Err(Problem::new(Reason::OwnBranch, message).at("onto", "wood of another branch"));
        }
        let base = if keep {
            self.plant()
                .metamers()
                .parent(branch)
                .map_or(Vec3::ZERO, |base| self.plant().metamers().end(base))
        } else {
            self.require_no_bend_of(branch)?;
            self.base_of(branch, Reason::TrunkMoved, "moved")?
        };
        if keep {
            let brought = self.plant().widths().filter(|(id, _)| rows.binary_search(id).is_ok()).count();
            self.require_widths(brought)?;
        }
        let motion = Motion { rotation, from: base, to: self.plant().metamers().end(bearer) };
        let original = if keep { Original::Stays } else { Original::Goes };
        let recorded = self.record(Kind::Graft, cause);
        if let Err(error) = self.simulation.graft(branch, bearer, &motion, original) {
            self.refuse(recorded);
            return Err(said("onto")(error));
        }
        self.reach();
        self.release_lost_bends();
        Ok(())
    }

    fn turn_about(&self, branch: MetamerId, base: Vec3, rotation: Quat) -> Motion {
        let end = self.plant().metamers().end(branch);
        Motion { rotation, from: end, to: base + rotation * (end - base) }
    }

    /// Where a branch is borne; a trunk is borne by nothing.
    fn base_of(&self, branch: MetamerId, reason: Reason, done: &str) -> Result<Vec3, Problem> {
        let plant = self.plant();
        let base = plant.metamers().parent(branch).filter(|&base| !plant.is_seed(base));
        base.map(|base| plant.metamers().end(base)).ok_or_else(|| {
            let message = format!("row {} is the foot of a trunk, which cannot be {done}", branch.raw());
            Problem::new(reason, message).at("row", "a row whose parent is no seed")
        })
    }
}

/// An edit's error in words for people; the field says where the wood would go.
pub(super) fn said(field: &str) -> impl Fn(EditError) -> Problem {
    move |error| {
        let (reason, allowed) = match error {
            EditError::OutOfWorld => (Reason::OutsideWorld, "places inside the world"),
            EditError::OutOfBudget => (Reason::TreeFull, "wood that the budget of the document holds"),
            EditError::Columns(_) | EditError::Broken => (Reason::Failed, "wood that fits the plants"),
        };
        Problem::new(reason, error.to_string()).at(field, allowed)
    }
}
