//! A limb with all that it bears, in rows of its own.

use std::collections::VecDeque;

use espalier_plant::{WoodAxis, WoodNode, hash::StableHash};

use crate::{
    axis::{Laid, Node, Placed, lay, place},
    generator::Missing,
    key::Key,
    resolution::Branch,
};

/// In place of a row: the one that bears the limb.
pub(crate) const BEARER: u32 = u32::MAX;

/// Rows of wood, numbered from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rows {
    pub nodes: Vec<WoodNode>,
    pub axes: Vec<WoodAxis>,
    /// Where each node stands on its axis.
    pub places: Vec<f32>,
    /// Of each axis, how it stands.
    pub placed: Vec<Placed>,
    /// Branches that are no wood.
    pub missing: Missing,
}

impl Rows {
    /// Adds an axis that begins at a row.
    pub(crate) fn push(&mut self, bearer: u32, placed: &Placed, nodes: &[Node]) {
        let axis = self.axes.len() as u32;
        let has_bud = placed.values.scalar(Key::Cut) >= 1.0;
        let direction = nodes.first().map(|node| node.heading);
        self.axes.push(WoodAxis { bearer: Some(bearer), direction, has_bud });
        let mut parent = bearer;
        for node in nodes {
            let radius = Some(placed.radius_at(node.t));
            let row = WoodNode {
                parent: Some(parent),
                axis,
                end: node.place,
                normal: Some(node.side),
                radius,
                birth: 1,
            };
            parent = self.nodes.len() as u32;
            self.nodes.push(row);
            self.places.push(node.t);
        }
        self.placed.push(placed.clone());
    }
}

/// All that a limb's rows, and what is told of how it stands, depend on.
pub(crate) fn stamp(limb: &Branch, placed: &Placed, seed: u32) -> u64 {
    let mut hash = StableHash::default();
    hash.word(limb.stamp());
    hash.word(limb.id().raw());
    hash.word(seed.into());
    hash.vector(placed.base);
    [placed.frame.x_axis, placed.frame.y_axis, placed.heading].into_iter().for_each(|axis| hash.vector(axis));
    hash.word(u64::from(placed.length.to_bits()) | u64::from(placed.radius.to_bits()) << 32);
    hash.word(u64::from(placed.t.to_bits()) | u64::from(placed.is_outside) << 32);
    hash.finish()
}

/// Grows a limb, lower orders first, until it has as many internodes as the budget.
pub(crate) fn grow(limb: &Branch, placed: Placed, seed: u32, budget: usize) -> Rows {
    let mut rows = Rows::default();
    let mut waiting = VecDeque::from([(limb, placed, BEARER)]);
    while let Some((branch, mut placed, bearer)) = waiting.pop_front() {
        let Laid { nodes, laterals, cut_away } = lay(branch, &placed, seed);
        if nodes.is_empty() {
            rows.missing.too_short += branch.count();
            continue;
        }
        if rows.nodes.len() + nodes.len() > budget {
            rows.missing.left_out += branch.count();
            continue;
        }
        rows.missing.cut_away += cut_away;
        let first = rows.nodes.len();
        for (lateral, node) in laterals {
            match place(lateral, &placed, &nodes[node], seed) {
                Some(of_lateral) => {
                    placed.leafy_from = placed.leafy_from.max(of_lateral.t);
                    waiting.push_back((lateral, of_lateral, (first + node) as u32));
                }
                None => rows.missing.too_short += lateral.count(),
            }
        }
        rows.push(bearer, &placed, &nodes);
    }
    rows
}
