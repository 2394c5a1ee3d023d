//! The nodes of one flush, by place, until they are entered in space.

use espalier_plant::MetamerId;
use glam::Vec3;

use crate::directory::voxel_of;

/// Edge of a cell, over the radius that is searched: few cells meet a search, and few nodes lie in a cell.
const EDGE: f32 = 4.0;
const NONE: u32 = u32::MAX;

/// A table of cells; several may share an entry, which only costs time.
#[derive(Clone, Debug)]
pub(crate) struct Newcomers {
    radius: f32,
    /// The latest node of each entry. As many as a power of two.
    heads: Vec<u32>,
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    id: MetamerId,
    place: Vec3,
    /// The one before it in its entry.
    next: u32,
}

impl Newcomers {
    /// Nobody yet; made for so many, and for searches by this radius.
    pub(crate) fn new(radius: f32, count: usize) -> Self {
        Self { radius, heads: vec![NONE; count.next_power_of_two()], nodes: Vec::with_capacity(count) }
    }

    /// Enters a node.
    pub(crate) fn insert(&mut self, id: MetamerId, place: Vec3) {
        let entry = self.entry(self.cell_of(place));
        let next = core::mem::replace(&mut self.heads[entry], self.nodes.len() as u32);
        self.nodes.push(Node { id, place, next });
    }

    /// Whether a place lies in the zone of some node for which `counts` holds.
    pub(crate) fn is_occupied(&self, place: Vec3, radius: f32, counts: impl Fn(MetamerId) -> bool) -> bool {
        let (low, high) = (self.cell_of(place - radius), self.cell_of(place + radius));
        for y in low[1]..high[1] + 1 {
            for z in low[2]..high[2] + 1 {
                for x in low[0]..high[0] + 1 {
                    let mut at = self.heads[self.entry([x, y, z])];
                    while let Some(node) = self.nodes.get(at as usize) {
                        let near = (place - node.place).length_squared() <= radius * radius;
                        if near && counts(node.id) {
                            return true;
                        }
                        at = node.next;
                    }
                }
            }
        }
        false
    }

    fn cell_of(&self, place: Vec3) -> [i32; 3] {
        voxel_of(place * (1.0 / (EDGE * self.radius)))
    }

    fn entry(&self, [x, y, z]: [i32; 3]) -> usize {
        let mixed = (x as u32).wrapping_mul(0x9e37_79b1)
            ^ (y as u32).wrapping_mul(0x85eb_ca77)
            ^ (z as u32).wrapping_mul(0xc2b2_ae3d);
        (mixed >> 12 ^ mixed) as usize & (self.heads.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn searches_agree_with_definition(
            nodes in prop::collection::vec((-12f32..12.0, 0f32..12.0, -12f32..12.0), 1..60),
            place in (-12f32..12.0, 0f32..12.0, -12f32..12.0),
            radius in 0.5f32..6.0,
        ) {
            let (nodes, place): (Vec<Vec3>, Vec3) = (nodes.into_iter().map(Vec3::from).collect(), place.into());
            // Room for fewer than there are, so that entries are shared.
            let mut newcomers = Newcomers::new(radius, nodes.len() / 4);
            for (i, &node) in nodes.iter().enumerate() {
                newcomers.insert(MetamerId::new(i), node);
            }
            let counts = |id: MetamerId| !id.index().is_multiple_of(3);
            let near = |(i, node): (usize, &Vec3)| {
                counts(MetamerId::new(i)) && (place - *node).length_squared() <= radius * radius
            };
            prop_assert_eq!(newcomers.is_occupied(place, radius, counts), nodes.iter().enumerate().any(near));
        }
    }
}
