//! Space: the zones that nodes occupy and the volumes that buds perceive (TreeSketch §3.2, Figure 8B).
//!
//! The paper gives the occupancy zone to buds. Here every living node has one: a bud sits at a node, so each
//! bud has its zone, and wood whose buds have all grown out does not offer its place to others again.

use espalier_plant::{AxisId, MetamerId, reserve};
use glam::Vec3;

use crate::{
    cells::CellSet,
    parameter_table::ParameterTable,
    parameters::Parameters,
    place_grid::{PlaceGrid, Stand, Vectors, Visit},
};

/// Edges of the cells: as wide as what is searched for, so that few cells are visited; found by measuring.
const NODE_CELL: f32 = 4.0;
const BUD_CELL: f32 = 6.0;
/// Nodes and buds that are read together. Buds are more often looked up one by one, so their blocks are short.
const NODES: usize = 8;
const BUDS: usize = 4;

/// All living nodes and buds by place. A bud is named by its axis.
#[derive(Clone, Debug)]
pub struct Space {
    nodes: PlaceGrid<NODES>,
    buds: PlaceGrid<BUDS, Vectors<BUDS>>,
    /// Where the bud of each axis stands among the buds.
    stands: Vec<Stand<BUDS>>,
    /// Axes whose buds have come, moved or gone since someone last took note of it: one bit each.
    moved: Vec<u64>,
}

/// A bud as space sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bud {
    /// Where it is.
    pub position: Vec3,
    /// Unit direction in which it points.
    pub direction: Vec3,
}

impl Space {
    /// Empty space.
    pub fn new() -> Self {
        Self {
            nodes: PlaceGrid::new(NODE_CELL),
            buds: PlaceGrid::new(BUD_CELL),
            stands: Vec::new(),
            moved: Vec::new(),
        }
    }

    /// Enters a node.
    pub fn occupy(&mut self, id: MetamerId, position: Vec3) {
        self.nodes.insert(id.raw(), position, ());
    }

    /// Nodes in and around a set of boxes: those of all cells that meet one.
    pub(crate) fn nodes_around(
        &self,
        boxes: impl Iterator<Item = (Vec3, Vec3)>,
        mut visit: impl FnMut(MetamerId),
    ) {
        let mut cells = CellSet::new();
        for (low, high) in boxes {
            cells.insert(low * (1.0 / NODE_CELL), high * (1.0 / NODE_CELL));
        }
        for cell in cells.iter() {
            self.nodes.visit_in_cell(cell, |number| visit(MetamerId::new(number as usize)));
        }
    }

    /// Takes a node out that was entered at this place.
    pub fn vacate(&mut self, id: MetamerId, position: Vec3) {
        self.nodes.remove(self.nodes.find(id.raw(), position));
    }

    /// Enters a bud, or moves it if it is there already.
    pub fn place_bud(&mut self, axis: AxisId, bud: Bud) {
        let index = axis.index();
        let stand = self.stands.get(index).copied().filter(|stand| *stand != Stand::NOWHERE);
        if stand.is_some_and(|stand| self.buds.shift(stand, bud.position, bud.direction)) {
            self.moved[index / 64] |= 1 << (index % 64);
            return;
        }
        self.remove_bud(axis);
        if index >= self.stands.len() {
            let more = index + 1 - self.stands.len();
            reserve(&mut self.stands, more);
            self.stands.resize(index + 1, Stand::NOWHERE);
            let words = index / 64 + 1;
            let more = words - self.moved.len();
            reserve(&mut self.moved, more);
            self.moved.resize(words, 0);
        }
        self.moved[index / 64] |= 1 << (index % 64);
        self.stands[index] = self.buds.insert(axis.raw(), bud.position, bud.direction);
    }

    /// Takes a bud out, if it is there.
    pub fn remove_bud(&mut self, axis: AxisId) {
        let Some(stand) = self.stands.get_mut(axis.index()).filter(|stand| **stand != Stand::NOWHERE) else {
            return;
        };
        let left = std::mem::replace(stand, Stand::NOWHERE);
        self.moved[axis.index() / 64] |= 1 << (axis.index() % 64);
        if let Some(moved) = self.buds.remove(left) {
            self.stands[moved as usize] = left;
        }
    }

    /// Whether the bud of an axis has come, moved or gone since [`Space::forget_moves`]; so it has if there never
    /// was one.
    #[inline]
    pub(crate) fn has_moved(&self, axis: AxisId) -> bool {
        self.moved.get(axis.index() / 64).is_none_or(|axes| axes >> (axis.index() % 64) & 1 != 0)
    }

    /// Takes the buds as they are for those that have not moved.
    pub(crate) fn forget_moves(&mut self) {
        self.moved.fill(0);
    }

    /// The bud of an axis, if it lives.
    pub fn bud(&self, axis: AxisId) -> Option<Bud> {
        let stand = self.stands.get(axis.index()).filter(|stand| **stand != Stand::NOWHERE)?;
        let (position, direction) = self.buds.at(*stand);
        Some(Bud { position, direction })
    }

    /// Calls `visit` with every bud within `radius` of a place and its squared distance.
    pub(crate) fn visit_buds(&self, place: Vec3, radius: f32, mut visit: impl FnMut(AxisId, Bud, f32)) {
        self.buds.visit_near(place, radius, |number, distance_squared| {
            let axis = AxisId::new(number as usize);
            if let Some(bud) = self.bud(axis) {
                visit(axis, bud, distance_squared);
            }
            Visit::Go
        });
    }

    /// Whether a place lies in the occupancy zone of some node for which `counts` holds.
    pub(crate) fn is_occupied(&self, place: Vec3, radius: f32, counts: impl Fn(MetamerId) -> bool) -> bool {
        self.nodes.any_near(place, radius, |number| counts(MetamerId::new(number as usize)))
    }

    /// The nearest bud that counts and whose perception volume holds a place, and its squared distance;
    /// of equally near ones the oldest.
    pub(crate) fn nearest_perceiving(
        &self,
        place: Vec3,
        parameters: &ParameterTable,
        counts: impl Fn(AxisId) -> bool,
    ) -> Option<(AxisId, f32)> {
        let mut limit = parameters.farthest_perception() * parameters.farthest_perception();
        let mut best: Option<(f32, AxisId)> = None;
        let widest = Cone::new(parameters.widest_perception()).signed_cos_squared;
        self.buds.visit_nearing(place, parameters.farthest_perception(), |block| {
            block.visit_seeing(place, limit, widest, |number, distance_squared, dot| {
                let axis = AxisId::new(number as usize);
                let nearer = best.is_none_or(|(d, a)| (distance_squared, axis) < (d, a));
                let cone = Cone::new(parameters.of(axis));
                if nearer && cone.holds(distance_squared, dot) && counts(axis) {
                    best = Some((distance_squared, axis));
                    limit = distance_squared;
                }
            });
            limit
        });
        best.map(|(distance_squared, axis)| (axis, distance_squared))
    }
}

impl Default for Space {
    fn default() -> Self {
        Self::new()
    }
}

/// The form of a perception volume, with the zone before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    /// Its reach, squared.
    pub far_squared: f32,
    /// Cosine of half its opening angle times its own magnitude: squares keep order and sign, and need no root.
    pub signed_cos_squared: f32,
}

impl Cone {
    /// That of buds with these parameters.
    pub(crate) fn new(parameters: &Parameters) -> Self {
        let (far, cos) = (parameters.perception_radius(), parameters.cos_half_perception);
        Self { far_squared: far * far, signed_cos_squared: cos * cos.abs() }
    }

    /// Whether it holds a place at this squared distance from the bud, whose difference to the bud's place has
    /// this dot product with the bud's direction.
    #[inline(always)]
    pub(crate) fn holds(self, distance_squared: f32, dot: f32) -> bool {
        (distance_squared <= self.far_squared)
            & (dot * dot.abs() >= self.signed_cos_squared * distance_squared)
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
                Cone::new(parameters).holds(*d2, (place - *position).dot(*direction))
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
                grid.place_bud(AxisId::new(i), Bud { position: *p, direction: *d });
            }
            for (i, p) in moves {
                let i = i % plain.len();
                plain[i].0 = p;
                grid.place_bud(AxisId::new(i), Bud { position: p, direction: plain[i].1 });
            }
            for i in removed {
                let i = i % plain.len();
                plain[i].0 = Vec3::splat(1e6);
                grid.remove_bud(AxisId::new(i));
            }
            prop_assert_eq!(grid.nearest_perceiving(place, &table, |_| true).map(|(axis, _)| axis), nearest_by_definition(&plain, place, &parameters));
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
        }
    }
}
