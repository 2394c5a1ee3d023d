//! Wood from elsewhere, that is to become a plant: what a file of its structure holds.

use glam::Vec3;

use crate::organs::Organs;

/// Internodes shorter than this are none.
pub use crate::edits::SHORTEST;

/// Nodes and axes, lengths in internodes, Y up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wood {
    /// Nodes with the internodes below them; parents stand before their children, and births never decrease.
    pub nodes: Vec<WoodNode>,
    /// Axes; the trunk of each seed is one.
    pub axes: Vec<WoodAxis>,
    /// Width constraints: nodes in ascending order, and diameters.
    pub widths: Vec<(u32, f32)>,
    /// Tips of twigs that were shed, which nodes carry for them: nodes in ascending order, and how many.
    pub scars: Vec<(u32, u32)>,
    /// Organs that nodes bear in place of those that grow on such wood: nodes in ascending order, seeds left out. They are
    /// counted from the [sides](crate::organs::shortest_sides) of the shortest turn, for not all nodes have a normal.
    pub organs: Vec<(u32, Organs)>,
    /// Rows of what has died, which come before nodes: nodes in ascending order, and how many rows. Leaves turn by the rows
    /// of what bears them.
    pub gaps: Vec<(u32, u32)>,
    /// Which dormant buds there are.
    pub buds: DormantBuds,
}

/// Dormant buds beside the axes that have no wood.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DormantBuds {
    /// Each node bears as many laterals as the parameters say; those that have not grown are dormant.
    #[default]
    Everywhere,
    /// So do the nodes of young wood alone: what is older has grown, shed or lost its buds.
    OnYoungWood,
    /// There are no others.
    Known,
}

/// One node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WoodNode {
    /// The node that its internode begins at; none for a seed.
    pub parent: Option<u32>,
    /// The axis that its internode belongs to.
    pub axis: u32,
    /// Where it is.
    pub end: Vec3,
    /// The unit normal of its internode, where it is known.
    pub normal: Option<Vec3>,
    /// The radius here, where it is known; a seed has none.
    pub radius: Option<f32>,
    /// The step of its birth.
    pub birth: u32,
}

/// One axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WoodAxis {
    /// The node that bears it; none for a trunk.
    pub bearer: Option<u32>,
    /// The unit direction of its bud when it was laid down, where it is known.
    pub direction: Option<Vec3>,
    /// Whether it has a living bud at its tip.
    pub has_bud: bool,
}

/// The number that a 32-bit number is written as: 0.1 where the nearest of 32 bits is 0.100000001.
pub fn as_written(number: f32) -> f64 {
    // What was written is a number.
    number.to_string().parse().unwrap_or_else(|_| number.into())
}
