//! Where wood stands: moves that do not count are taken back from the last one on, as far as nobody has moved the same
//! wood since. What stands on wood that goes elsewhere by that goes with it.

use std::collections::BTreeMap;

use glam::{Mat3, Vec3};

use super::{Claim, claim, edits, standing::Standing};
use crate::{
    edits::{Carried, Edit},
    id::{AxisId, MetamerId},
    plant::Plant,
    resettled::Resettled,
};

/// The present, as a step of which a place is known.
const NOW: u32 = u32::MAX;

/// The node of a metamer and its normal.
type Place = (Vec3, Vec3);

/// Wood that was moved in a step.
struct Move<'a> {
    step: u32,
    in_force: bool,
    /// Where it was before.
    moved: &'a Carried,
    /// The settling that moved it, which is made anew.
    settling: Option<&'a Resettled>,
}

/// What died when, as of a step that is gone back to edit by edit.
struct Lives<'a> {
    plant: &'a Plant,
    births: &'a [u32],
    rows: Vec<u32>,
    axes: Vec<u32>,
    /// The first metamer of each axis.
    firsts: Vec<MetamerId>,
}

impl<'a> Lives<'a> {
    fn of(plant: &'a Plant, births: &'a [u32]) -> Self {
        let rows = plant.metamers.death.to_rows(plant.metamer_count());
        let axes = plant.axes.death.to_rows(plant.axis_count());
        Self { plant, births, rows, axes, firsts: plant.axes.first[..plant.axis_count()].to_vec() }
    }

    /// Goes back to before an edit.
    fn go_back(&mut self, settling: &Resettled) {
        settling.metamers.iter().for_each(|&(id, death)| self.rows[id.index()] = death);
        settling.axes.iter().for_each(|&(axis, death)| self.axes[axis.index()] = death);
        for ends in &settling.ends {
            self.firsts[ends.axis.index()] = ends.before.map_or(MetamerId::NONE, |(first, _)| first);
        }
    }

    /// When a metamer died, if that was before a step.
    fn death(&self, id: MetamerId, step: u32) -> Option<u32> {
        Some(self.rows[id.index()]).filter(|&death| death < step)
    }

    /// When an axis stood no more, or what bears it, if that was before a step: its direction moved no more then.
    fn axis_death(&self, axis: AxisId, step: u32) -> Option<u32> {
        let bearer = self.plant.axes.bearer(axis).and_then(|bearer| self.death(bearer, step));
        let bud = Some(self.axes[axis.index()]).filter(|&death| death < step);
        let first = self.firsts[axis.index()].some().filter(|first| self.births[first.index()] < step);
        let own = match first {
            Some(first) => bud.zip(self.death(first, step)).map(|(bud, wood)| bud.max(wood)),
            None => bud,
        };
        bearer.into_iter().chain(own).min()
    }
}

/// Where everything was, each at the end of a step of its own.
struct Places<'a> {
    plant: &'a Plant,
    /// Moves up to the present, first to last.
    moves: Vec<Move<'a>>,
    /// Where each metamer was, and when.
    rows: Vec<(Place, u32)>,
    /// Where each bud pointed when it was laid down, and when that was so.
    axes: Vec<(Vec3, u32)>,
}

/// The wood that goes elsewhere, and where to.
pub(super) fn resettled(plant: &Plant, claims: &[Claim], standing: &Standing) -> Carried {
    let moves = edits(plant).filter_map(|(step, edit)| match edit {
        Edit::Carried(moved) => {
            Some(Move { step, in_force: claim(claims, step).in_force, moved, settling: None })
        }
        Edit::Resettled(edit) => {
            Some(Move { step, in_force: false, moved: &edit.carried, settling: Some(edit) })
        }
        _ => None,
    });
    // Before the first that was moved everything was where it grew.
    let moves: Vec<Move<'_>> =
        moves.skip_while(|of| of.moved.metamers.is_empty() && of.moved.axes.is_empty()).collect();
    if moves.is_empty() {
        return Carried::default();
    }
    Places::of(plant, moves, standing).put(standing)
}

impl<'a> Places<'a> {
    /// The places of the present, and of what is dead those of its last step; then the moves that do not count are taken
    /// back, the last first. What they left where it was is where it was before them as well.
    fn of(plant: &'a Plant, moves: Vec<Move<'a>>, standing: &Standing) -> Self {
        let Standing { births, axis_births, .. } = standing;
        let mut lives = Lives::of(plant, births);
        let known = |death: Option<u32>| death.map_or(NOW, |death| death.saturating_sub(1));
        let next = plant.step() + 1;
        let row = |id: MetamerId| {
            ((plant.metamers.end(id), plant.metamers.normal(id)), known(lives.death(id, next)))
        };
        let axis = |axis: AxisId| (plant.axes.direction(axis), known(lives.axis_death(axis, next)));
        let mut rows: Vec<_> = (0..plant.metamer_count()).map(MetamerId::new).map(row).collect();
        let mut axes: Vec<_> = (0..plant.axis_count()).map(AxisId::new).map(axis).collect();
        let mut kept_rows = vec![false; rows.len()];
        let mut kept_axes = vec![false; axes.len()];
        for of in moves.iter().rev() {
            let moved = of.moved;
            if let Some(settling) = of.settling {
                lives.go_back(settling);
            }
            if of.in_force {
                moved.metamers.iter().for_each(|id| kept_rows[id.index()] = true);
                moved.axes.iter().for_each(|axis| kept_axes[axis.index()] = true);
                continue;
            }
            for ((&id, &end), &normal) in moved.metamers.iter().zip(&moved.ends).zip(&moved.normals) {
                if !kept_rows[id.index()] {
                    rows[id.index()].0 = (end, normal);
                }
            }
            for (&axis, &direction) in moved.axes.iter().zip(&moved.directions) {
                if !kept_axes[axis.index()] {
                    axes[axis.index()].0 = direction;
                }
            }
            let before = |death: Option<u32>| death.unwrap_or(of.step).saturating_sub(1);
            let moves_none = moved.metamers.is_empty() && moved.axes.is_empty();
            if moves_none && of.settling.is_none_or(|settling| settling.metamers.is_empty()) {
                continue;
            }
            for (row, (_, since)) in rows.iter_mut().enumerate() {
                if !kept_rows[row] && births[row] < of.step && *since >= of.step {
                    *since = before(lives.death(MetamerId::new(row), of.step));
                }
            }
            for (row, (_, since)) in axes.iter_mut().enumerate() {
                let axis = AxisId::new(row);
                if !kept_axes[row] && axis_births[row] < of.step && *since >= of.step {
                    *since = before(lives.axis_death(axis, of.step));
                }
            }
        }
        Self { plant, moves, rows, axes }
    }

    /// Where a metamer was at the end of a step.
    fn at(&self, id: MetamerId, step: u32) -> Place {
        let (place, since) = self.rows[id.index()];
        if since == step {
            return place;
        }
        let later = self.moves.partition_point(|of| of.step <= step);
        let before = self.moves[later..].iter().find_map(|Move { moved, .. }| {
            let at = moved.metamers.binary_search(&id).ok()?;
            Some((moved.ends[at], moved.normals[at]))
        });
        before.unwrap_or_else(|| (self.plant.metamers.end(id), self.plant.metamers.normal(id)))
    }

    /// Puts all that stands where it belongs on the wood that bears it; what changes by that.
    fn put(self, standing: &Standing) -> Carried {
        let plant = self.plant;
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let is_same = |a: Place, b: Place| bits(a.0) == bits(b.0) && bits(a.1) == bits(b.1);
        let mut carried = Carried::default();
        // Places that are others than now.
        let mut new: BTreeMap<MetamerId, Place> = BTreeMap::new();
        let here = |new: &BTreeMap<MetamerId, Place>, id: MetamerId| match new.get(&id) {
            Some(&place) => place,
            None => (plant.metamers.end(id), plant.metamers.normal(id)),
        };
        // How the wood that bears something was turned and moved since the step of which the place of that is known.
        let motion = |new: &BTreeMap<MetamerId, Place>, bearer: MetamerId, since: u32| {
            let (was, is) = (self.at(bearer, since), here(new, bearer));
            if is_same(was, is) {
                return None;
            }
            let turn = plant.metamers.parent(bearer).map_or(Mat3::IDENTITY, |below| {
                let former = basis(was.0 - self.at(below, since).0, was.1);
                basis(is.0 - here(new, below).0, is.1) * former.transpose()
            });
            Some((turn, was.0, is.0))
        };
        for id in (0..plant.metamer_count()).map(MetamerId::new) {
            if !standing.states[id.index()].stands() {
                continue;
            }
            let ((end, normal), since) = self.rows[id.index()];
            let moved = plant.metamers.parent(id).and_then(|bearer| motion(&new, bearer, since));
            let place = moved.map_or((end, normal), |(turn, from, to)| {
                let reach = turn * (end - from);
                let heading = reach.normalize();
                let across = (turn * normal).reject_from_normalized(heading);
                (to + reach, across.try_normalize().unwrap_or_else(|| heading.any_orthonormal_vector()))
            });
            if !is_same(place, here(&new, id)) {
                new.insert(id, place);
                carried.metamers.push(id);
                carried.ends.push(place.0);
                carried.normals.push(place.1);
            }
        }
        for axis in (0..plant.axis_count()).map(AxisId::new) {
            if !standing.buds[axis.index()] && standing.ends[axis.index()].is_none() {
                continue;
            }
            let (direction, since) = self.axes[axis.index()];
            let moved = plant.axes.bearer(axis).and_then(|bearer| motion(&new, bearer, since));
            let direction = moved.map_or(direction, |(turn, ..)| (turn * direction).normalize());
            if bits(direction) != bits(plant.axes.direction(axis)) {
                carried.axes.push(axis);
                carried.directions.push(direction);
            }
        }
        carried
    }
}

/// A basis along a vector and across it.
fn basis(along: Vec3, across: Vec3) -> Mat3 {
    let along = along.normalize();
    let across = across.reject_from_normalized(along).normalize();
    Mat3::from_cols(along, across, along.cross(across))
}
