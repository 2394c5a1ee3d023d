//! Wood that follows from a design: what a branch is like from its outline inwards (§3, §4).

use std::{collections::BTreeMap, ops::Range};

use espalier_plant::{Wood, WoodAxis, WoodNode};
use glam::Vec3;

use crate::{
    axis::{Laid, Placed, lay, place, stem},
    design::Design,
    limb::{BEARER, Rows, grow, stamp},
    node::NodeId,
};

/// Most internodes of a plant, unless somebody asks for fewer.
pub const MAX_INTERNODES: usize = 200_000;

/// Grows wood from designs, and keeps limbs that have not changed from one time to the next.
#[derive(Clone, Debug, Default)]
pub struct Generator {
    limbs: BTreeMap<NodeId, (u64, Rows)>,
}

/// Wood that has grown from a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Generated {
    /// The wood: a seed in the origin, then the stem, then one limb after another.
    pub wood: Wood,
    /// Of each axis of the wood, how it stands.
    pub placed: Vec<Placed>,
    /// Where each node of the wood stands on its axis, 0 for the seed.
    pub places: Vec<f32>,
    /// The rows of each limb, in order along the stem.
    pub limbs: Vec<(NodeId, Range<u32>)>,
    /// Branches of the design that are no wood.
    pub missing: Missing,
    /// Limbs that have been grown anew for it.
    pub renewed: Vec<NodeId>,
}

/// Why branches of a design are no wood.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    /// They would be shorter than one and a half internodes.
    pub too_short: usize,
    /// They, or the places where they stood, were cut away.
    pub cut_away: usize,
    /// The plant would have more internodes than it may.
    pub left_out: usize,
}

impl Generator {
    /// Grows the wood of a design of at most so many internodes; what is beyond is left out, last limbs and highest
    /// orders first, and counted.
    pub fn generate(&mut self, design: &Design, budget: usize) -> Generated {
        let seed = design.graph().seed();
        let mut placed = stem(design.root());
        let Laid { mut nodes, laterals, cut_away } = lay(design.root(), &placed, seed);
        let mut missing = Missing { cut_away, ..Missing::default() };
        if nodes.len() > budget {
            nodes.truncate(budget);
            missing.left_out += laterals
                .iter()
                .filter(|(_, node)| *node >= budget)
                .map(|(limb, _)| limb.count())
                .sum::<usize>();
        }
        let mut left = budget - nodes.len();
        let mut kept = BTreeMap::new();
        let mut renewed = Vec::new();
        let mut order = Vec::new();
        for (limb, node) in laterals {
            let Some(at) = nodes.get(node) else { continue };
            let Some(of_limb) = place(limb, &placed, at, seed) else {
                missing.too_short += limb.count();
                continue;
            };
            let stamp = stamp(limb, &of_limb, seed);
            let known = self.limbs.remove(&limb.id()).filter(|(known, rows)| {
                *known == stamp && rows.missing.left_out == 0 && rows.nodes.len() <= left
            });
            let rows = known.map_or_else(
                || {
                    renewed.push(limb.id());
                    grow(limb, of_limb, seed, left)
                },
                |(_, rows)| rows,
            );
            left -= rows.nodes.len();
            placed.leafy_from = placed.leafy_from.max(at.t);
            missing.too_short += rows.missing.too_short;
            missing.cut_away += rows.missing.cut_away;
            missing.left_out += rows.missing.left_out;
            // Rows of the stem stand behind that of the seed.
            order.push((limb.id(), node as u32 + 1));
            kept.insert(limb.id(), (stamp, rows));
        }
        let mut stem = Rows::default();
        stem.push(BEARER, &placed, &nodes);
        self.limbs = kept;
        let limbs: Vec<_> = order
            .into_iter()
            .filter_map(|(id, bearer)| Some((id, bearer, &self.limbs.get(&id)?.1)))
            .collect();
        Assembly::of(&stem, &limbs, missing, renewed)
    }
}

struct Assembly;

impl Assembly {
    fn of(stem: &Rows, limbs: &[(NodeId, u32, &Rows)], missing: Missing, renewed: Vec<NodeId>) -> Generated {
        let count = 1 + stem.nodes.len() + limbs.iter().map(|limb| limb.2.nodes.len()).sum::<usize>();
        let axes = 1 + limbs.iter().map(|limb| limb.2.axes.len()).sum::<usize>();
        let mut wood =
            Wood { nodes: Vec::with_capacity(count), axes: Vec::with_capacity(axes), ..Wood::default() };
        let (mut placed, mut places) = (Vec::with_capacity(axes), Vec::with_capacity(count));
        let seed = WoodNode { parent: None, axis: 0, end: Vec3::ZERO, normal: None, radius: None, birth: 0 };
        wood.nodes.push(seed);
        places.push(0.0);
        let mut ranges = Vec::with_capacity(limbs.len());
        for (id, bearer, rows) in std::iter::once((None, 0, stem))
            .chain(limbs.iter().map(|&(id, bearer, rows)| (Some(id), bearer, rows)))
        {
            let (first, axis) = (wood.nodes.len() as u32, wood.axes.len() as u32);
            let row = |raw: u32| if raw == BEARER { bearer } else { first + raw };
            wood.nodes.extend(rows.nodes.iter().map(|node| WoodNode {
                parent: node.parent.map(row),
                axis: axis + node.axis,
                ..*node
            }));
            wood.axes.extend(rows.axes.iter().map(|own| WoodAxis {
                // The stem is borne by nothing.
                bearer: id.and(own.bearer).map(row),
                ..*own
            }));
            places.extend_from_slice(&rows.places);
            placed.extend_from_slice(&rows.placed);
            ranges.extend(id.map(|id| (id, first..wood.nodes.len() as u32)));
        }
        Generated { wood, placed, places, limbs: ranges, missing, renewed }
    }
}

impl Generated {
    /// How a branch stands, if it is wood.
    pub fn placed(&self, node: NodeId) -> Option<&Placed> {
        self.placed.iter().find(|placed| placed.node == node)
    }

    /// Which branch a row of the wood belongs to, and where on its axis it stands.
    pub fn at(&self, row: u32) -> Option<(NodeId, f32)> {
        let axis = self.wood.nodes.get(row as usize)?.axis;
        Some((self.placed.get(axis as usize)?.node, self.places[row as usize]))
    }

    /// The rows of a branch's own axis, from its base to its tip.
    pub fn rows(&self, node: NodeId) -> impl Iterator<Item = u32> {
        let axis = self.placed.iter().position(|placed| placed.node == node).map(|axis| axis as u32);
        let rows = (0..)
            .zip(&self.wood.nodes)
            .filter(move |(_, row)| Some(row.axis) == axis && row.parent.is_some());
        rows.map(|(row, _)| row)
    }
}
