//! Space: the zones that nodes occupy and the volumes that buds perceive (TreeSketch §3.2, Figure 8B).
//!
//! The paper gives the occupancy zone to buds. Here every living node has one: a bud sits at a node, so each
//! bud has its zone, and wood whose buds have all grown out does not offer its place to others again.

use espalier_plant::{AxisId, MetamerId};
use glam::Vec3;

use crate::{
    parameter_table::ParameterTable,
    parameters::Parameters,
    place_grid::{PlaceGrid, Vectors, Visit},
};

/// Edges of the cells: as wide as what is searched for, so that few cells are visited; found by measuring.
const NODE_CELL: f32 = 3.0;
const BUD_CELL: f32 = 4.0;

/// All living nodes and buds by place. A bud is named by its axis.
#[derive(Clone, Debug)]
pub struct Space {
    nodes: PlaceGrid,
    bud_places: PlaceGrid<Vectors>,
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

/// What becomes of a place that a bud would like to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contest {
    /// It is the bud's.
    Won,
    /// This nearer bud perceives it.
    LostTo(AxisId),
    /// It lies in an occupancy zone.
    Occupied,
}

impl Space {
    /// Empty space.
    pub fn new() -> Self {
        Self { nodes: PlaceGrid::new(NODE_CELL), bud_places: PlaceGrid::new(BUD_CELL), buds: Vec::new() }
    }

    /// Enters a node.
    pub fn occupy(&mut self, id: MetamerId, position: Vec3) {
        self.nodes.insert(id.raw(), position, ());
    }

    /// Takes a node out that was entered at this place.
    pub fn vacate(&mut self, id: MetamerId, position: Vec3) {
        self.nodes.remove(id.raw(), position);
    }

    /// Enters a bud, or moves it if it is there already.
    pub fn place_bud(&mut self, axis: AxisId, position: Vec3, direction: Vec3) {
        let index = axis.index();
        if index >= self.buds.len() {
            let nowhere = Bud { position: Vec3::ZERO, direction: Vec3::Y, present: false };
            self.buds.resize(index + 1, nowhere);
        }
        let held = std::mem::replace(&mut self.buds[index], Bud { position, direction, present: true });
        if held.present {
            self.bud_places.remove(axis.raw(), held.position);
        }
        self.bud_places.insert(axis.raw(), position, direction);
    }

    /// Takes a bud out, if it is there.
    pub fn remove_bud(&mut self, axis: AxisId) {
        if let Some(bud) = self.buds.get_mut(axis.index()).filter(|bud| bud.present) {
            bud.present = false;
            let position = bud.position;
            self.bud_places.remove(axis.raw(), position);
        }
    }

    /// The bud of an axis, if it lives.
    pub fn bud(&self, axis: AxisId) -> Option<&Bud> {
        self.buds.get(axis.index()).filter(|bud| bud.present)
    }

    /// Calls `visit` with every bud within `radius` of a place and its squared distance.
    pub(crate) fn visit_buds(&self, place: Vec3, radius: f32, mut visit: impl FnMut(AxisId, &Bud, f32)) {
        self.bud_places.visit_near(place, radius, |number, distance_squared| {
            visit(AxisId::new(number as usize), &self.buds[number as usize], distance_squared);
            Visit::Go
        });
    }

    /// Whether a place lies in the occupancy zone of some node for which `counts` holds.
    pub(crate) fn is_occupied(&self, place: Vec3, radius: f32, counts: impl Fn(MetamerId) -> bool) -> bool {
        self.nodes.any_near(place, radius, |number| counts(MetamerId::new(number as usize)))
    }

    /// What becomes of a place in a bud's own perception volume.
    ///
    /// The same as asking [`Space::is_occupied`] and [`Space::nearest_perceiving`], but it looks for other
    /// perceivers no farther than the bud itself is away.
    pub(crate) fn contest(&self, axis: AxisId, place: Vec3, parameters: &ParameterTable) -> Contest {
        if self.is_occupied(place, parameters.of(axis).occupancy_radius, |_| true) {
            return Contest::Occupied;
        }
        let Some(own) = self.bud(axis) else { return Contest::Occupied };
        let own_distance = own.position.distance_squared(place);
        let mut outcome = Contest::Won;
        // A hair farther than needed: a rival at the very same node must not be lost to rounding.
        self.bud_places.visit_blocks(place, own_distance.sqrt() * 1.0001, |block| {
            let is_rival = |number: u32, distance_squared| {
                let rival = AxisId::new(number as usize);
                (distance_squared, rival) < (own_distance, axis)
                    && self.buds[rival.index()].perceives(place, distance_squared, parameters.of(rival))
            };
            match block.seen_by(place, own_distance, parameters.widest_perception(), is_rival) {
                Some(rival) => {
                    outcome = Contest::LostTo(AxisId::new(rival as usize));
                    Visit::Stop
                }
                None => Visit::Go,
            }
        });
        outcome
    }

    /// Whether one bud perceives a place and is nearer to it than another.
    pub(crate) fn outdoes(
        &self,
        rival: AxisId,
        axis: AxisId,
        place: Vec3,
        parameters: &ParameterTable,
    ) -> bool {
        let (Some(near), Some(own)) = (self.bud(rival), self.bud(axis)) else { return false };
        let distance_squared = near.position.distance_squared(place);
        (distance_squared, rival) < (own.position.distance_squared(place), axis)
            && near.perceives(place, distance_squared, parameters.of(rival))
    }

    /// The nearest bud whose perception volume holds a place; of equally near ones the oldest.
    pub fn nearest_perceiving(&self, place: Vec3, parameters: &ParameterTable) -> Option<AxisId> {
        let mut best: Option<(f32, AxisId)> = None;
        self.visit_buds(place, parameters.farthest_perception(), |axis, bud, distance_squared| {
            let nearer = best.is_none_or(|(d, a)| (distance_squared, axis) < (d, a));
            if nearer && bud.perceives(place, distance_squared, parameters.of(axis)) {
                best = Some((distance_squared, axis));
            }
        });
        best.map(|(_, axis)| axis)
    }
}

impl Default for Space {
    fn default() -> Self {
        Self::new()
    }
}

impl Bud {
    /// Whether a place at this squared distance lies in the perception volume or the zone before it.
    pub(crate) fn perceives(&self, place: Vec3, distance_squared: f32, parameters: &Parameters) -> bool {
        let far = parameters.perception_radius();
        if distance_squared > far * far {
            return false;
        }
        (place - self.position).dot(self.direction)
            >= parameters.cos_half_perception * distance_squared.sqrt()
    }
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
            nodes in prop::collection::vec(vector(-8.0..8.0), 0..60),
            removed in prop::collection::vec(0usize..80, 0..10),
            place in vector(-9.0..9.0),
        ) {
            let table = ParameterTable::default();
            let parameters = table.scene().clone();
            let mut plain: Vec<(Vec3, Vec3)> =
                buds.iter().map(|(p, d)| (*p, d.try_normalize().unwrap_or(Vec3::Y))).collect();
            let mut grid = Space::new();
            for (i, (p, d)) in plain.iter().enumerate() {
                grid.place_bud(AxisId::new(i), *p, *d);
            }
            for (i, p) in moves {
                let i = i % plain.len();
                plain[i].0 = p;
                grid.place_bud(AxisId::new(i), p, plain[i].1);
            }
            for i in removed {
                let i = i % plain.len();
                plain[i].0 = Vec3::splat(1e6);
                grid.remove_bud(AxisId::new(i));
            }
            prop_assert_eq!(grid.nearest_perceiving(place, &table), nearest_by_definition(&plain, place, &parameters));
            for (i, node) in nodes.iter().enumerate() {
                grid.occupy(MetamerId::new(i), *node);
            }
            for (i, node) in nodes.iter().enumerate().filter(|(i, _)| i % 3 == 0) {
                grid.vacate(MetamerId::new(i), *node);
            }
            let kept = nodes.iter().enumerate().filter(|(i, _)| i % 3 != 0).map(|(_, node)| node);
            let zone = parameters.occupancy_radius * parameters.occupancy_radius;
            let free = kept.clone().all(|p| p.distance_squared(place) > zone);
            prop_assert_eq!(grid.is_occupied(place, parameters.occupancy_radius, |_| true), !free);
            for (i, (p, d)) in plain.iter().enumerate().filter(|(_, (p, _))| p.x < 1e5) {
                let d2 = p.distance_squared(place);
                let perceives = d2.sqrt() <= parameters.perception_radius()
                    && (place - *p).dot(*d) >= parameters.cos_half_perception * d2.sqrt();
                if perceives {
                    let won = free && nearest_by_definition(&plain, place, &parameters) == Some(AxisId::new(i));
                    let contest = grid.contest(AxisId::new(i), place, &table);
                    prop_assert_eq!(contest == Contest::Won, won);
                    prop_assert_eq!(contest == Contest::Occupied, !free);
                }
            }
        }
    }
}
