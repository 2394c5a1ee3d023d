//! Where branches of the design stand, for those who look at one (`DS8`).

use std::{collections::BTreeSet, sync::Arc};

use espalier_design::{NodeId, Placed};
use espalier_proto::{BranchPath, PlacedBranch};
use glam::{Mat3, Quat, Vec3};

use crate::document::Document;

impl Document {
    /// The branches on the way to one, itself, and the laterals of each of these, as far as they are wood, lower orders
    /// first. Of a branch that does not stand: of the last one on the way that does.
    pub(crate) fn branches_around(&mut self, of: &BranchPath) -> Vec<PlacedBranch> {
        let Some(design) = self.design_in_force().map(Arc::clone) else { return Vec::new() };
        let (Ok(node), Some(shown)) = (of.as_str().parse::<NodeId>(), self.shown(&design)) else {
            return Vec::new();
        };
        let way: BTreeSet<NodeId> =
            std::iter::successors(Some(node), |node| Some(node.bearer()?.0)).collect();
        let is_near = |node: NodeId| node.bearer().is_none_or(|(bearer, _)| way.contains(&bearer));
        let mut near: Vec<&Placed> =
            shown.generated.placed.iter().filter(|placed| is_near(placed.node)).collect();
        near.sort_by_key(|placed| placed.node.order());
        let told = near.into_iter().filter_map(|placed| {
            let path = BranchPath::try_from(placed.node.to_string()).ok()?;
            let bears = shown.design.branch(placed.node).map_or(0, |branch| branch.laterals().len());
            Some(told(path, placed, design.at, bears as u32))
        });
        told.collect()
    }
}

fn told(path: BranchPath, placed: &Placed, at: Vec3, bears: u32) -> PlacedBranch {
    PlacedBranch {
        path,
        base: vector(placed.base + at),
        frame: rotation(placed.frame),
        outline: rotation(placed.outline().0),
        length: rounded(placed.length),
        radius: rounded(placed.radius),
        at: rounded(placed.t),
        heading: vector(placed.heading),
        outside: placed.is_outside,
        bears,
    }
}

/// A ten thousandth of an internode is below what anybody can see, and the message is half as long.
pub(in crate::document) fn rounded(number: f32) -> f32 {
    (number * 1e4).round() / 1e4
}

pub(in crate::document) fn vector(vector: Vec3) -> [f32; 3] {
    vector.to_array().map(rounded)
}

pub(in crate::document) fn rotation(frame: Mat3) -> [f32; 4] {
    Quat::from_mat3(&frame).normalize().to_array().map(rounded)
}
