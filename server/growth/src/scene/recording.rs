//! A step while it is recorded. Light and space follow when it ends.

use espalier_plant::{AxisId, BadColumns, Carried, Internode, MetamerId, Motion, Organs};
use glam::Vec3;

use super::Scene;
use crate::{edit_error::EditError, world::is_in_world};

/// A step of the plants between its begin and its end: what is cut, moved, grown and given within it is one step of
/// the timeline. Births come last: only wood that was there before the step can be moved.
#[derive(Debug)]
pub struct Recording<'a> {
    scene: &'a mut Scene,
    /// Rows of metamers and axes there were before.
    before: (usize, usize),
    gone: Vec<MetamerId>,
    /// What has moved, and where it was before that; what moved twice within the step stands here twice.
    moved: Vec<(MetamerId, Vec3)>,
}

impl Scene {
    /// Records one step of growth.
    pub fn record_growth<T>(&mut self, grow: impl FnOnce(&mut Recording<'_>) -> T) -> T {
        self.begin_step();
        Recording::run(self, grow)
    }

    /// Records an edit as a step of its own, in which nothing grows older.
    pub fn record_edit<T>(&mut self, edit: impl FnOnce(&mut Recording<'_>) -> T) -> T {
        self.plant.begin_edit();
        Recording::run(self, edit)
    }
}

impl<'a> Recording<'a> {
    fn run<T>(scene: &'a mut Scene, change: impl FnOnce(&mut Self) -> T) -> T {
        let before = (scene.plant.metamer_count(), scene.plant.axis_count());
        let mut recording = Self { scene, before, gone: Vec::new(), moved: Vec::new() };
        let done = change(&mut recording);
        recording.end();
        done
    }

    /// The scene. Its plants are those of this moment; light and space are still those from before the step.
    pub fn scene(&self) -> &Scene {
        self.scene
    }

    /// Cuts off these metamers and all above them. Those that are dead, or die with others, count for nothing, nor do
    /// seeds.
    pub fn prune(&mut self, cuts: &[MetamerId]) {
        let plant = &mut self.scene.plant;
        let is_wood = |id: &MetamerId| plant.is_alive(*id) && !plant.is_seed(*id);
        let cuts: Vec<MetamerId> = cuts.iter().copied().filter(is_wood).collect();
        self.gone.extend(plant.prune(&cuts));
    }

    /// Puts whole columns of wood elsewhere ([`espalier_plant::Plant::place`]).
    ///
    /// # Errors
    /// Where wood would stand outside the world, or the columns do not fit the plants; then nothing moves.
    pub fn place(&mut self, placed: Carried) -> Result<(), EditError> {
        if !placed.ends.iter().all(|&end| is_in_world(end)) {
            return Err(EditError::OutOfWorld);
        }
        let moved = self.scene.plant.place(placed)?;
        self.note_moved(moved);
        Ok(())
    }

    /// Moves the wood on a path and what it bears ([`espalier_plant::Plant::carry`]); whether all of it stays in the
    /// world.
    pub(crate) fn carry(&mut self, path: &[MetamerId], motions: &[Motion]) -> bool {
        let moved = self.scene.plant.carry(path, motions);
        let metamers = self.scene.plant.metamers();
        let is_inside = moved.iter().all(|&(id, _)| is_in_world(metamers.end(id)));
        self.note_moved(moved);
        is_inside
    }

    /// Grafts a branch onto a node ([`espalier_plant::Plant::graft`]); returns the axis of the graft.
    pub(crate) fn graft(&mut self, source: MetamerId, onto: MetamerId, motion: &Motion) -> AxisId {
        self.scene.plant.graft(source, onto, motion)
    }

    /// Lays down a bud at the node of wood that was there before ([`espalier_plant::Plant::graft_bud`]).
    pub(crate) fn graft_bud(&mut self, onto: MetamerId, direction: Vec3) -> AxisId {
        self.scene.plant.graft_bud(onto, direction)
    }

    /// Plants a seed.
    pub fn sow(&mut self, position: Vec3) -> AxisId {
        self.scene.plant.sow(position)
    }

    /// Lets the bud of a living axis add one internode, unless its end lies outside the world, or the scene holds all
    /// the metamers it may.
    pub fn extend(&mut self, axis: AxisId, internode: &Internode<'_>) -> Option<MetamerId> {
        let grows = is_in_world(internode.end) && !self.scene.is_full();
        grows.then(|| self.scene.plant.extend(axis, internode))
    }

    /// Gives radii to wood, or takes them away ([`espalier_plant::Plant::give_radii`]).
    pub fn give_radii(&mut self, radii: &[(MetamerId, Option<f32>)]) -> Result<(), BadColumns> {
        self.scene.plant.give_radii(radii)
    }

    /// Gives organs to wood, or takes them away ([`espalier_plant::Plant::give_organs`]).
    pub fn give_organs(&mut self, organs: &[(MetamerId, Option<Organs>)]) -> Result<(), BadColumns> {
        self.scene.plant.give_organs(organs)
    }

    fn note_moved(&mut self, moved: Vec<(MetamerId, Vec3)>) {
        if self.moved.is_empty() {
            self.moved = moved;
        } else {
            self.moved.extend(moved);
        }
    }

    fn end(mut self) {
        let scene = self.scene;
        scene.plant.end_step();
        let buds_turn = !self.gone.is_empty() || !self.moved.is_empty();
        let (born, born_axes) = self.before;
        let plant = &scene.plant;
        // Where each was first; the sort keeps those of one metamer in their order.
        self.moved.sort_by_key(|&(id, _)| id);
        self.moved.dedup_by_key(|&mut (id, _)| id);
        let mut gone: Vec<MetamerId> = self.gone.into_iter().filter(|id| id.index() < born).collect();
        gone.sort_unstable();
        let was_at = |id: MetamerId| match self.moved.binary_search_by_key(&id, |&(id, _)| id) {
            Ok(at) => self.moved[at].1,
            Err(_) => plant.metamers().end(id),
        };
        let mut went: Vec<(MetamerId, Vec3)> = gone.iter().map(|&id| (id, was_at(id))).collect();
        self.moved.retain(|(id, _)| gone.binary_search(id).is_err());
        went.extend_from_slice(&self.moved);
        let born = (born..plant.metamer_count()).map(MetamerId::new);
        let living = born.clone().filter(|&id| plant.is_alive(id));
        let came = self.moved.iter().map(|&(id, _)| id).chain(living).collect();
        // Buds sit at nodes, and turn with the wood below them. Otherwise those of axes that have grown are elsewhere.
        let mut changed: Vec<AxisId> = match buds_turn {
            true => Vec::new(),
            false => born.map(|id| plant.metamers().axis(id)).filter(|id| id.index() < born_axes).collect(),
        };
        changed.sort_unstable();
        changed.dedup();
        let from = if buds_turn { 0 } else { born_axes };
        let axes = (from..plant.axis_count()).map(AxisId::new);
        scene.update(went, came, changed.into_iter().chain(axes));
    }
}
