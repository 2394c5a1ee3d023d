//! What a hand does to a scene (TreeSketch §3.3): the plant changes in a step of its own, and light, space and
//! buds know of it at once, so that growth goes on from there.

use espalier_plant::{AxisId, BrokenPlant, Future, MetamerId, Motion};
use glam::Vec3;

use crate::{
    observer::NoObserver,
    simulation::Simulation,
    world::{WORLD_EXTENT, is_in_world},
};

/// An edit that cannot be made; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// Wood would stand outside the world.
    #[error("the branch would leave the world, which ends {WORLD_EXTENT} internodes from the origin")]
    OutOfWorld,
    /// The scene may not hold so many metamers.
    #[error("the scene would hold more metamers than its budget")]
    OutOfBudget,
}

/// What becomes of the branch that a graft is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Original {
    /// It stays: the graft is a copy.
    Stays,
    /// It is cut off: the branch has moved.
    Goes,
}

impl Simulation {
    /// Cuts off these metamers and all above them, in one step. Those that are dead, or die with others, count
    /// for nothing.
    pub fn prune(&mut self, cuts: &[MetamerId]) {
        self.plant.begin_edit();
        let gone = self.cut(cuts);
        self.plant.end_step();
        self.take_in(&gone, &[]);
    }

    /// Moves the wood on a path and what it bears ([`espalier_plant::Plant::carry`]).
    pub fn carry(&mut self, path: &[MetamerId], motions: &[Motion]) -> Result<(), EditError> {
        self.plant.begin_edit();
        let moved = self.plant.carry(path, motions);
        self.plant.end_step();
        if moved.iter().any(|&(id, _)| !is_in_world(self.plant.metamers().end(id))) {
            self.plant.go_to(self.plant.step() - 1);
            self.plant.stash_future();
            return Err(EditError::OutOfWorld);
        }
        self.take_in(&[], &moved);
        Ok(())
    }

    /// Grafts a branch onto a node ([`espalier_plant::Plant::graft`]); returns the axis of the graft.
    pub fn graft(
        &mut self,
        source: MetamerId,
        onto: MetamerId,
        motion: &Motion,
        original: Original,
    ) -> Result<AxisId, EditError> {
        let rows = self.plant.above(source);
        if !rows.iter().all(|&id| is_in_world(motion.apply(self.plant.metamers().end(id)))) {
            return Err(EditError::OutOfWorld);
        }
        if self.plant.metamer_count() + rows.len() > self.metamer_budget as usize {
            return Err(EditError::OutOfBudget);
        }
        let born = self.plant.metamer_count();
        self.plant.begin_edit();
        let axis = self.plant.graft(source, onto, motion);
        let gone = match original {
            Original::Stays => Vec::new(),
            Original::Goes => self.cut(&[source]),
        };
        self.plant.end_step();
        for id in (born..self.plant.metamer_count()).map(MetamerId::new) {
            self.enter(id);
        }
        for axis in (axis.index()..self.plant.axis_count()).map(AxisId::new) {
            self.replace_bud(axis);
        }
        self.take_in(&gone, &[]);
        Ok(axis)
    }

    /// Sets, changes or removes a width constraint: the diameter of a metamer in internodes.
    pub fn set_width(&mut self, id: MetamerId, diameter: Option<f32>) {
        self.plant.begin_edit();
        self.plant.set_width(id, diameter);
        self.plant.end_step();
    }

    /// Cuts off everything recorded beyond the present, and returns it.
    pub fn stash_future(&mut self) -> Future {
        self.plant.stash_future()
    }

    /// Puts a future back ahead of the present, where it was cut off.
    pub fn take_future(&mut self, future: Future) -> Result<(), BrokenPlant> {
        self.plant.take_future(future)
    }

    /// Cuts living wood off within a step; returns it.
    fn cut(&mut self, cuts: &[MetamerId]) -> Vec<MetamerId> {
        let is_wood = |id: &MetamerId| self.plant.is_alive(*id) && !self.plant.is_seed(*id);
        let cuts: Vec<MetamerId> = cuts.iter().copied().filter(is_wood).collect();
        self.plant.prune(&cuts)
    }

    /// Tells light, space and buds what has gone, and what has moved and where it was.
    fn take_in(&mut self, gone: &[MetamerId], moved: &[(MetamerId, Vec3)]) {
        self.field = None;
        for &id in gone {
            self.leave(id, self.plant.metamers().end(id));
        }
        for &(id, place) in moved {
            self.leave(id, place);
        }
        for &(id, _) in moved {
            self.enter(id);
        }
        if !gone.is_empty() || !moved.is_empty() {
            // Buds sit at nodes, and turn with the wood below them.
            for axis in (0..self.plant.axis_count()).map(AxisId::new) {
                self.replace_bud(axis);
            }
        }
        self.canopy.forget();
        self.see_light(&[], &mut NoObserver);
    }
}
