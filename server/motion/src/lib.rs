//! How a plant sways, from its rows as clients have them.
//!
//! [`Limbs`] says which rows are one limb, [`Wood`] what they weigh and how far they bend, and [`Joints`] which limbs
//! move, how fast and how far. All of that is made with + − × ÷ and square roots in a fixed order, so that clients find
//! the same joints bit by bit.
//!
//! [`Wind`] is a function of place and time, and so is how joints answer it ([`Answers`], [`Sway`], [`Pose`]): nothing is
//! integrated, so whoever looks sees the same gust, and loops close. Lengths of this crate are in metres, Y is up,
//! angles are in radians.

pub mod answers;
pub mod bodies;
pub mod clips;
mod exposure;
pub mod flutter;
mod frequency;
mod joints;
pub mod loads;
mod pose;
mod radii;
mod rides;
mod rig;
mod shapes;
pub mod shelter;
mod siblings;
mod spectrum;
pub mod statics;
mod sway;
mod whole;
mod wind;
mod wood;

pub use answers::{Answer, Answers};
pub use espalier_mesh::{BrokenRows, Limb, Limbs, NONE, Row, Rows};
pub use exposure::Exposure;
pub use joints::{Joint, Joints, MAX_JOINTS};
pub use pose::{Node, Pose, Stand};
pub use rides::Ride;
pub use rig::{Bone, Bound, Rig};
pub use sway::{Pluck, Sway};
pub use wind::{Direction, LIVE_PERIOD, Line, Weather, Wind, profile};
pub use wood::{Scale, Wood};
