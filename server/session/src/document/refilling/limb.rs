//! A limb, and what of it goes before it fills an outline; and limbs that somebody looks at (`DS13`).

use espalier_design::GrownLimb;
use espalier_plant::{MetamerId, Plant};
use espalier_proto::{DesignValue, LimbOutline};

use super::hull::Hull;
use crate::document::{
    Document,
    designing::{rotation, rounded, vector},
};

/// What stays of a limb above its first fork.
pub(super) enum Keeps<'a> {
    /// Nothing.
    BelowFork,
    /// What lies in an outline, and stands on what does.
    Within(&'a Hull),
}

/// What goes of a limb, and what stays.
pub(super) struct CutBack {
    /// The lowest metamers that go, in order.
    pub cuts: Vec<MetamerId>,
    /// The end that goes on growing by a new bud, where nothing stands on the first fork any more.
    pub sprout: Option<MetamerId>,
    first: MetamerId,
    /// Of each row from the first on, whether it is one of the limb that stays.
    stays: Vec<bool>,
}

impl CutBack {
    /// Of the limb that begins with a living metamer. Up to and with its first fork all of it stays.
    pub fn of(plant: &Plant, first: MetamerId, keeps: &Keeps<'_>) -> Self {
        let metamers = plant.metamers();
        let rows =
            || (first.index()..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
        let at = |id: MetamerId| id.index().checked_sub(first.index());
        let parent = |id: MetamerId| metamers.parent(id).and_then(at);
        let mut bears = vec![0u32; plant.metamer_count() - first.index()];
        for below in rows().filter_map(parent) {
            bears[below] += 1;
        }
        let mut stays = vec![false; bears.len()];
        let (mut cuts, mut fork, mut is_bare) = (Vec::new(), first, true);
        stays[0] = true;
        for id in rows().skip(1) {
            let (Some(below), Some(own)) = (parent(id), at(id)) else { continue };
            if !stays[below] {
                continue;
            }
            let is_below_fork = Some(below) == at(fork) && bears[below] == 1;
            let is_kept = match keeps {
                Keeps::BelowFork => false,
                Keeps::Within(hull) => hull.contains(metamers.end(id)),
            };
            if is_below_fork {
                fork = id;
            } else if !is_kept {
                cuts.push(id);
                continue;
            }
            stays[own] = true;
            is_bare &= is_below_fork;
        }
        let axis = metamers.axis(fork);
        let has_bud = plant.is_axis_alive(axis) && plant.bud_node(axis) == fork;
        Self { cuts, sprout: (is_bare && !has_bud).then_some(fork), first, stays }
    }

    /// Whether a metamer is one of the limb that stays.
    pub fn keeps(&self, id: MetamerId) -> bool {
        id.index().checked_sub(self.first.index()).and_then(|at| self.stays.get(at)) == Some(&true)
    }
}

impl Document {
    /// The limb that a row lies on; none where none lives, or it follows an open design.
    pub(crate) fn limb_at(&mut self, row: u32) -> Option<LimbOutline> {
        let is_known = (row as usize) < self.plant().metamer_count();
        if !is_known || self.is_designed(row) {
            return None;
        }
        let limb = GrownLimb::around(self.plant(), &self.girth(), MetamerId::new(row as usize))?;
        Some(LimbOutline {
            row: limb.first.raw(),
            bearer: limb.bearer.map(|bearer| bearer.raw()),
            base: vector(limb.base),
            frame: rotation(limb.frame),
            length: rounded(limb.length),
            radius: rounded(limb.radius),
            heading: vector(limb.heading),
            envelope: DesignValue::from(limb.outline.to_json()),
            bears: limb.bears,
        })
    }
}
