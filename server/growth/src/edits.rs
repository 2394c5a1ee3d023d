//! What a person does to a scene (TreeSketch §3.3): the plants change in a step of its own, and light, space and
//! the generator know of it at once, so that growth goes on from there.

use espalier_plant::{AxisId, BrokenPlant, Carried, Claims, Future, MetamerId, Motion, Settled};
use glam::Vec3;

use crate::{
    edit_error::EditError,
    generator::{Change, Generator},
    obstacles::Obstacle,
    scene::Recording,
    simulation::Simulation,
    world::is_in_world,
};

/// What becomes of the branch that a graft is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Original {
    /// It stays: the graft is a copy.
    Stays,
    /// It is cut off: the branch has moved.
    Goes,
}

impl<G: Generator> Simulation<G> {
    /// Plants another seed, in a step of its own.
    pub fn sow(&mut self, position: Vec3) {
        self.edit(|step| step.sow(position));
    }

    /// Cuts off these metamers and all above them, in one step. Those that are dead, or die with others, count
    /// for nothing.
    pub fn prune(&mut self, cuts: &[MetamerId]) {
        self.edit(|step| step.prune(cuts));
    }

    /// Cuts off these metamers and all above them, and lets a bud stand at the end of another one that goes on where that
    /// went, in one step.
    pub fn cut_back(&mut self, cuts: &[MetamerId], sprout: Option<MetamerId>) {
        self.edit(|step| {
            if !cuts.is_empty() {
                step.prune(cuts);
            }
            if let Some(end) = sprout {
                let heading = step.scene().plant().heading(end);
                step.graft_bud(end, heading);
            }
        });
    }

    /// Puts whole columns of wood elsewhere, in one step ([`espalier_plant::Plant::place`]).
    pub fn place(&mut self, placed: Carried) -> Result<(), EditError> {
        self.edit(|step| step.place(placed))
    }

    /// Moves the wood on a path and what it bears ([`espalier_plant::Plant::carry`]).
    pub fn carry(&mut self, path: &[MetamerId], motions: &[Motion]) -> Result<(), EditError> {
        let before = self.plant().step();
        if self.scene.record_edit(|step| step.carry(path, motions)) {
            self.follow_edit(before);
            return Ok(());
        }
        self.scene.go_to(self.scene.plant.step() - 1);
        self.scene.plant.stash_future();
        Err(EditError::OutOfWorld)
    }

    /// Grafts a branch onto a node ([`espalier_plant::Plant::graft`]); returns the axis of the graft.
    pub fn graft(
        &mut self,
        source: MetamerId,
        onto: MetamerId,
        motion: &Motion,
        original: Original,
    ) -> Result<AxisId, EditError> {
        let plant = &self.scene.plant;
        let rows = plant.above(source);
        if !rows.iter().all(|&id| is_in_world(motion.apply(plant.metamers().end(id)))) {
            return Err(EditError::OutOfWorld);
        }
        if plant.metamer_count() + rows.len() > self.scene.metamer_budget as usize {
            return Err(EditError::OutOfBudget);
        }
        Ok(self.edit(|step| {
            let axis = step.graft(source, onto, motion);
            if original == Original::Goes {
                step.prune(&[source]);
            }
            axis
        }))
    }

    /// Settles anew which wood stands, with some steps not in force ([`espalier_plant::Plant::settle`]), as an edit:
    /// strokes in progress go on. Nothing lies ahead of the present.
    ///
    /// # Errors
    /// Where wood would stand outside the world; then nothing changes.
    pub fn settle(&mut self, claims: &Claims) -> Result<Settled, EditError> {
        let settled = self.scene.plant.settle(claims);
        if settled.is_recorded {
            let before = self.plant().step();
            let shift = self.scene.go_to(before + 1);
            let arrived = shift.metamers_in.iter().chain(shift.moved.iter().map(|(id, _)| id));
            if !arrived.into_iter().all(|&id| is_in_world(self.plant().metamers().end(id))) {
                self.scene.go_to(before);
                self.scene.plant.stash_future();
                return Err(EditError::OutOfWorld);
            }
            self.generator.follow(&self.scene, &Change::Edited);
        }
        Ok(settled)
    }

    /// Sets, changes or removes a width constraint: the diameter of a metamer in internodes.
    pub fn set_width(&mut self, id: MetamerId, diameter: Option<f32>) {
        let plant = &mut self.scene.plant;
        plant.begin_edit();
        plant.set_width(id, diameter);
        plant.end_step();
    }

    /// Puts obstacles in place of those there were. Wood that has grown where they stand stays.
    pub fn set_obstacles(&mut self, obstacles: Vec<Obstacle>) {
        self.scene.set_obstacles(obstacles);
        self.generator.follow(&self.scene, &Change::Edited);
    }

    /// Goes to a recorded step, back or forth; light, space and the generator follow exactly.
    pub fn go_to(&mut self, step: u32) {
        let shift = self.scene.go_to(step);
        self.generator.follow(&self.scene, &Change::Travelled(shift));
    }

    /// Cuts off everything recorded beyond the present, and returns it.
    pub fn stash_future(&mut self) -> Future {
        self.scene.plant.stash_future()
    }

    /// Puts a future back ahead of the present, where it was cut off.
    pub fn take_future(&mut self, future: Future) -> Result<(), BrokenPlant> {
        self.scene.plant.take_future(future)
    }

    pub(crate) fn edit<T>(&mut self, edit: impl FnOnce(&mut Recording<'_>) -> T) -> T {
        let before = self.plant().step();
        let done = self.scene.record_edit(edit);
        self.follow_edit(before);
        done
    }

    /// Tells the generator of an edit, if it has left a step beyond this one: one that changes nothing leaves none.
    fn follow_edit(&mut self, before: u32) {
        if self.plant().step() != before {
            self.generator.follow(&self.scene, &Change::Edited);
        }
    }
}
