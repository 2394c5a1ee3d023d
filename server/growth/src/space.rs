//! Where the buds are: occupancy zones and perception volumes (TreeSketch §3.2, Figure 8B).

use espalier_plant::AxisId;
use glam::Vec3;

use crate::{parameters::Parameters, voxel_grid::VoxelGrid};

/// Edge of a cell, in internodes.
const CELL: f32 = 2.5;

/// All living buds by place. A bud is named by its axis.
#[derive(Clone, Debug)]
pub struct BudGrid {
    /// In each cell the first bud, plus one; 0 for none.
    heads: VoxelGrid<u32>,
    /// After each bud the next one of its cell, likewise.
    next: Vec<u32>,
    buds: Vec<Bud>,
}

/// A bud as space sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bud {
    /// Where it is.
    pub position: Vec3,
    /// Unit direction in which it points.
    pub direction: Vec3,
    present: bool,
}

impl BudGrid {
    /// No buds yet.
    pub fn new() -> Self {
        Self { heads: VoxelGrid::new(), next: Vec::new(), buds: Vec::new() }
    }

    /// Enters a bud, or moves it if it is there already.
    pub fn place(&mut self, axis: AxisId, position: Vec3, direction: Vec3) {
        let index = axis.index();
        if index >= self.buds.len() {
            let nowhere = Bud { position: Vec3::ZERO, direction: Vec3::Y, present: false };
            self.buds.resize(index + 1, nowhere);
            self.next.resize(index + 1, 0);
        }
        let bud = Bud { position, direction, present: true };
        let held = self.buds[index];
        if held.present && cell_of(held.position) == cell_of(position) {
            self.buds[index] = bud;
            return;
        }
        self.remove(axis);
        self.buds[index] = bud;
        let head = self.heads.get_mut(cell_of(position));
        self.next[index] = *head;
        *head = axis.raw() + 1;
    }

    /// Takes a bud out, if it is there.
    pub fn remove(&mut self, axis: AxisId) {
        let Some(bud) = self.buds.get_mut(axis.index()).filter(|bud| bud.present) else { return };
        bud.present = false;
        let head = self.heads.get_mut(cell_of(bud.position));
        let after = self.next[axis.index()];
        if *head == axis.raw() + 1 {
            *head = after;
            return;
        }
        let mut at = *head;
        while at != 0 {
            let link = self.next[at as usize - 1];
            if link == axis.raw() + 1 {
                self.next[at as usize - 1] = after;
                return;
            }
            at = link;
        }
    }

    /// The bud of an axis, if it lives.
    pub fn get(&self, axis: AxisId) -> Option<&Bud> {
        self.buds.get(axis.index()).filter(|bud| bud.present)
    }

    /// Calls `visit` with every bud within `radius` of `place`, in no particular order, until it says stop.
    pub(crate) fn visit_near(
        &self,
        place: Vec3,
        radius: f32,
        mut visit: impl FnMut(AxisId, &Bud, f32) -> Visit,
    ) {
        let (low, centre, high) = (cell_of(place - radius), cell_of(place), cell_of(place + radius));
        let limit = radius * radius;
        // The place's own cell first: what stops a search is mostly near.
        if self.visit_cell(centre, place, limit, &mut visit) == Visit::Stop {
            return;
        }
        let gap_squared = |cell: i32, at: f32| {
            let from = cell as f32 * CELL;
            let gap = (from - at).max(at - (from + CELL)).max(0.0);
            gap * gap
        };
        for y in low[1]..=high[1] {
            let gap_y = gap_squared(y, place.y);
            for z in low[2]..=high[2] {
                let gap_yz = gap_y + gap_squared(z, place.z);
                for x in low[0]..=high[0] {
                    let beyond = gap_yz + gap_squared(x, place.x) > limit * 1.0001;
                    if beyond || [x, y, z] == centre {
                        continue;
                    }
                    if self.visit_cell([x, y, z], place, limit, &mut visit) == Visit::Stop {
                        return;
                    }
                }
            }
        }
    }

    #[inline]
    fn visit_cell(
        &self,
        cell: [i32; 3],
        place: Vec3,
        limit: f32,
        visit: &mut impl FnMut(AxisId, &Bud, f32) -> Visit,
    ) -> Visit {
        let mut at = self.heads.get(cell);
        while at != 0 {
            let bud = &self.buds[at as usize - 1];
            let distance_squared = bud.position.distance_squared(place);
            if distance_squared <= limit
                && visit(AxisId::new(at as usize - 1), bud, distance_squared) == Visit::Stop
            {
                return Visit::Stop;
            }
            at = self.next[at as usize - 1];
        }
        Visit::Go
    }

    /// Whether a place lies in the occupancy zone of some bud for which `counts` holds.
    pub(crate) fn is_occupied(&self, place: Vec3, radius: f32, counts: impl Fn(AxisId) -> bool) -> bool {
        let mut occupied = false;
        self.visit_near(place, radius, |axis, _, _| {
            occupied = counts(axis);
            if occupied { Visit::Stop } else { Visit::Go }
        });
        occupied
    }

    /// Whether a bud wins a place in its own perception volume: no zone holds it, no nearer bud perceives it.
    ///
    /// The same as asking [`BudGrid::is_occupied`] and [`BudGrid::nearest_perceiving`], in one search that
    /// looks no farther than the bud itself is away.
    pub(crate) fn wins(&self, axis: AxisId, place: Vec3, parameters: &Parameters) -> bool {
        let Some(own) = self.get(axis) else { return false };
        let own_distance = own.position.distance_squared(place);
        let zone = parameters.occupancy_radius * parameters.occupancy_radius;
        if own_distance <= zone {
            return false;
        }
        let mut wins = true;
        self.visit_near(place, own_distance.sqrt(), |other, bud, distance_squared| {
            let is_nearer = (distance_squared, other) < (own_distance, axis);
            wins =
                distance_squared > zone && !(is_nearer && bud.perceives(place, distance_squared, parameters));
            if wins { Visit::Go } else { Visit::Stop }
        });
        wins
    }

    /// The nearest bud whose perception volume holds a place; of equally near ones the oldest.
    pub fn nearest_perceiving(&self, place: Vec3, parameters: &Parameters) -> Option<AxisId> {
        let mut best: Option<(f32, AxisId)> = None;
        self.visit_near(place, parameters.perception_radius(), |axis, bud, distance_squared| {
            let nearer = best.is_none_or(|(d, a)| (distance_squared, axis) < (d, a));
            if nearer && bud.perceives(place, distance_squared, parameters) {
                best = Some((distance_squared, axis));
            }
            Visit::Go
        });
        best.map(|(_, axis)| axis)
    }
}

/// Whether a search goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Visit {
    Go,
    Stop,
}

impl Default for BudGrid {
    fn default() -> Self {
        Self::new()
    }
}

impl Bud {
    /// Whether a place at this squared distance, not beyond the perception radius, lies in the cone.
    pub(crate) fn perceives(&self, place: Vec3, distance_squared: f32, parameters: &Parameters) -> bool {
        (place - self.position).dot(self.direction)
            >= parameters.cos_half_perception * distance_squared.sqrt()
    }
}

fn cell_of(place: Vec3) -> [i32; 3] {
    (place * (1.0 / CELL)).floor().to_array().map(|c| c as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The definition, word for word, over a plain list.
    fn nearest_by_definition(buds: &[(Vec3, Vec3)], place: Vec3, parameters: &Parameters) -> Option<AxisId> {
        let mut perceiving: Vec<(f32, usize)> = buds
            .iter()
            .enumerate()
            .map(|(i, (position, direction))| (position.distance_squared(place), i, *position, *direction))
            .filter(|(d2, _, position, direction)| {
                d2.sqrt() <= parameters.perception_radius()
                    && (place - *position).dot(*direction) >= parameters.cos_half_perception * d2.sqrt()
            })
            .map(|(d2, i, ..)| (d2, i))
            .collect();
        perceiving.sort_by(|a, b| a.partial_cmp(b).expect("distances are finite"));
        perceiving.first().map(|&(_, i)| AxisId::new(i))
    }

    fn vector(range: std::ops::Range<f32>) -> impl Strategy<Value = Vec3> {
        (range.clone(), range.clone(), range).prop_map(Vec3::from)
    }

    proptest! {
        #[test]
        fn grid_agrees_with_the_definition(
            buds in prop::collection::vec((vector(-8.0..8.0), vector(-1.0..1.0)), 1..80),
            moves in prop::collection::vec((0usize..80, vector(-8.0..8.0)), 0..40),
            removed in prop::collection::vec(0usize..80, 0..10),
            place in vector(-9.0..9.0),
        ) {
            let parameters = Parameters::default();
            let mut plain: Vec<(Vec3, Vec3)> =
                buds.iter().map(|(p, d)| (*p, d.try_normalize().unwrap_or(Vec3::Y))).collect();
            let mut grid = BudGrid::new();
            for (i, (p, d)) in plain.iter().enumerate() {
                grid.place(AxisId::new(i), *p, *d);
            }
            for (i, p) in moves {
                let i = i % plain.len();
                plain[i].0 = p;
                grid.place(AxisId::new(i), p, plain[i].1);
            }
            for i in removed {
                let i = i % plain.len();
                plain[i].0 = Vec3::splat(1e6);
                grid.remove(AxisId::new(i));
            }
            prop_assert_eq!(grid.nearest_perceiving(place, &parameters), nearest_by_definition(&plain, place, &parameters));
            let occupied = plain.iter().any(|(p, _)| p.distance_squared(place) <= 4.0);
            prop_assert_eq!(grid.is_occupied(place, 2.0, |_| true), occupied);
            let zone = parameters.occupancy_radius * parameters.occupancy_radius;
            let free = plain.iter().all(|(p, _)| p.distance_squared(place) > zone);
            for (i, (p, d)) in plain.iter().enumerate().filter(|(_, (p, _))| p.x < 1e5) {
                let d2 = p.distance_squared(place);
                let perceives = d2.sqrt() <= parameters.perception_radius()
                    && (place - *p).dot(*d) >= parameters.cos_half_perception * d2.sqrt();
                if perceives {
                    let won = free && nearest_by_definition(&plain, place, &parameters) == Some(AxisId::new(i));
                    prop_assert_eq!(grid.wins(AxisId::new(i), place, &parameters), won);
                }
            }
        }
    }
}
