//! A flush: all that grows in one step.
//!
//! Leaders of strokes come first, then the longest shoots; no node may lie in the zone of another that is there by
//! then.

use std::{collections::BTreeSet, ops::Range};

use espalier_plant::{AxisId, MetamerId};
use glam::Vec3;

use crate::{
    claims::Region,
    growth::Growth,
    newcomers::Newcomers,
    obstacles::Obstacles,
    scene::Scene,
    selection::Selection,
    shoot::{Aim, Draft},
    side_by_side::Run,
};

/// Shoots that are drafted by one thread at a time.
const BATCH: usize = if cfg!(test) { 4 } else { 256 };
/// Buds that are asked by one thread at a time.
const ASKED: usize = if cfg!(test) { 4 } else { 2048 };

/// A bud that will grow: the complement of its length in the upper half of a number, its axis in the lower. So those
/// that grow first come first, and two are compared as one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Shoot(u64);

impl Shoot {
    fn new(axis: AxisId, length: u32) -> Self {
        Self(u64::from(!length) << 32 | u64::from(axis.raw()))
    }

    fn axis(self) -> AxisId {
        AxisId::new(self.0 as u32 as usize)
    }

    /// Internodes.
    fn length(self) -> u32 {
        !((self.0 >> 32) as u32)
    }
}

impl Growth {
    /// Lets buds grow: leaders along their paths, others into the space they have claimed. Returns the new metamers
    /// that are not in space yet.
    pub(crate) fn grow(
        &mut self,
        scene: &mut Scene,
        stroke: Option<Vec3>,
        selection: &Selection,
        run: &Run<'_>,
    ) -> Range<usize> {
        let born = scene.plant.metamer_count();
        let led = self.grow_leaders(scene, stroke, selection);
        let shoots = self.shoots(scene, &led, run);
        if run.is_shared() {
            self.grow_side_by_side(scene, born, &shoots, stroke, run);
            return born..scene.plant.metamer_count();
        }
        for id in (born..scene.plant.metamer_count()).map(MetamerId::new) {
            scene.space.occupy(id, scene.plant.metamers().end(id));
        }
        for shoot in shoots {
            if let Some(aim) = self.aim(scene, shoot.axis(), stroke) {
                self.grow_shoot(scene, shoot.axis(), shoot.length(), aim);
            }
        }
        0..0
    }

    /// The same as if they grew one after another: whether a zone of an earlier step is in the way does not depend on
    /// who grows first. So all are drafted as if each were the only one, and grow as far as those before let them.
    fn grow_side_by_side(
        &self,
        scene: &mut Scene,
        born: usize,
        shoots: &[Shoot],
        stroke: Option<Vec3>,
        run: &Run<'_>,
    ) {
        let now = &*scene;
        let draft = |shoots: &[Shoot]| {
            let mut drafts = Vec::with_capacity(shoots.len());
            for &shoot in shoots {
                if let Some(aim) = self.aim(now, shoot.axis(), stroke) {
                    self.draft_shoot(now, shoot.axis(), shoot.length(), aim, &mut drafts);
                }
            }
            drafts
        };
        let drafts: Vec<Vec<Draft>> = run.each(shoots.chunks(BATCH), draft);
        let count = scene.plant.metamer_count() - born + drafts.iter().map(Vec::len).sum::<usize>();
        let mut newcomers = Newcomers::new(self.parameters.scene().occupancy_radius, count);
        for id in (born..scene.plant.metamer_count()).map(MetamerId::new) {
            newcomers.insert(id, scene.plant.metamers().end(id));
        }
        let (mut stopped, mut last_grown) = (None, 0);
        let last = shoots.last().copied();
        for draft in drafts.iter().flatten() {
            if stopped == Some(draft.axis) {
                continue;
            }
            if scene.is_full() {
                break;
            }
            if newcomers
                .is_occupied(draft.end, draft.zone, |id| !self.is_kin(scene, draft.axis, draft.end, id))
            {
                stopped = Some(draft.axis);
                continue;
            }
            let id = self.add(scene, draft);
            newcomers.insert(id, draft.end);
            last_grown += u32::from(last.is_some_and(|shoot| shoot.axis() == draft.axis));
        }
        if last.is_some_and(|shoot| last_grown < shoot.length()) {
            // One after another, the last shoot would have asked for space once more.
            scene.is_full();
        }
    }

    fn aim(&self, scene: &Scene, axis: AxisId, stroke: Option<Vec3>) -> Option<Aim> {
        let claimed = self.claims.of(axis)?;
        Some(Aim { space: Some(self.lit_side(scene, axis, claimed)), stroke, region: claimed.region })
    }

    /// Lets leaders grow along the paths of their strokes. Returns those that did.
    pub(crate) fn grow_leaders(
        &mut self,
        scene: &mut Scene,
        stroke: Option<Vec3>,
        selection: &Selection,
    ) -> BTreeSet<AxisId> {
        let mut led = BTreeSet::new();
        let (mut guides, mut enclosures) =
            (core::mem::take(&mut self.guides), core::mem::take(&mut self.enclosures));
        let zone = self.parameters.scene().occupancy_radius;
        let limbs = || enclosures.iter().flat_map(|one| one.limbs.iter().flatten());
        let mut leading: BTreeSet<AxisId> =
            guides.values().chain(limbs()).filter_map(|guide| guide.leader).collect();
        let limbs = enclosures.iter_mut().flat_map(|one| one.limbs.iter_mut().flatten());
        for guide in guides.values_mut().chain(limbs) {
            // Where the leader is blocked, the stroke gives up a piece of its path and chooses a leader for the rest, until
            // one grows or no path is left.
            while let Some(leader) = guide.leader.filter(|&leader| selection.includes(leader)) {
                let space = self.claims.of(leader).map(|claimed| claimed.space);
                let longest = self.parameters.of(leader).max_shoot_length;
                let aim = Aim { space, stroke, region: Region::Sweep };
                let next = |tip, obstacles: &Obstacles| guide.next_node(tip, obstacles);
                if self.grow_guided(scene, leader, longest, aim, next) > 0 {
                    led.insert(leader);
                    break;
                }
                if scene.is_full() || !guide.is_ahead(scene.plant.bud_position(leader)) {
                    break;
                }
                leading.remove(&leader);
                guide.go_past();
                let may_lead = |axis| selection.includes(axis);
                guide.choose_leader(&scene.space, &scene.obstacles, zone, may_lead, &leading);
                leading.extend(guide.leader);
            }
        }
        (self.guides, self.enclosures) = (guides, enclosures);
        led
    }

    /// What enabled buds will grow, the longest shoot first, of equally long ones the oldest.
    fn shoots(&self, scene: &Scene, led: &BTreeSet<AxisId>, run: &Run<'_>) -> Vec<Shoot> {
        let buds: Vec<(AxisId, Region)> =
            self.claims.claimants().filter(|(axis, _)| !led.contains(axis)).collect();
        let vigor =
            |&(axis, _): &(AxisId, Region)| self.canopy.bud_vigor(&scene.plant, axis, &self.parameters);
        let vigors = run.each(buds.chunks(ASKED), |buds| buds.iter().map(vigor).collect::<Vec<f64>>());
        let vigors = vigors.iter().flatten();
        let greatest = vigors.clone().copied().fold(0.0, f64::max);
        let shoot = |(&(axis, region), &vigor): (&(AxisId, Region), &f64)| {
            let length = region.shoot_length(vigor, greatest, self.parameters.of(axis));
            (length > 0).then(|| Shoot::new(axis, length))
        };
        let mut shoots: Vec<Shoot> = buds.iter().zip(vigors).filter_map(shoot).collect();
        run.sort(&mut shoots);
        shoots
    }
}
