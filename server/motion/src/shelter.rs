//! What takes the wind away: the crown itself, other plants in front, and obstacles.
//!
//! All of it is reckoned once for each direction of the wind, which is that of its whole mean, rise included.

mod crowns;
mod obstacles;
mod solids;
mod triangles;

use glam::DVec3;

use crate::wood::Wood;

pub use crowns::behind_crowns;
pub use obstacles::at_place;
pub use solids::{Form, Solid};
pub use triangles::Triangles;

/// A wake has filled to 1/e after so many heights of what made it.
const RECOVERY: f64 = 10.0;

/// The share of the open wind's speed that each row gets past crowns and obstacles.
pub fn shares(wood: &Wood, along: DVec3, solids: &[Solid]) -> Vec<f64> {
    let mut shares = behind_crowns(wood, along);
    let past = obstacles::behind_obstacles(wood, along, solids);
    shares.iter_mut().zip(past).for_each(|(share, past)| *share *= past);
    shares
}
