//! How rows move with the joint they ride on.

use glam::DVec3;

use crate::{Limbs, NONE, shapes::Shape, wood::Wood};

/// How one row rides: by the rotation Θ of its joint, θ = |Θ|, its node turns by `weight` Θ and moves by
/// sin θ / θ · Θ × `first` + (1 − cos θ) / θ² · Θ × (Θ × `second`).
///
/// That is the integral of exp(wΘ) along the way from the joint's node up to the second order, and exact where w is 1.
/// Internodes are too short by (1 − cos θ)² w² (1 − w²) / 2: by 2 % at most where θ is 0.9. With the factors 1 and ½ of
/// the bare second order they would be too long by θ⁴/8, which is 8 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ride {
    /// The joint, or [`NONE`] where nothing moves the row.
    pub joint: u32,
    /// w: the share of the joint's rotation that the row's node has.
    pub weight: f64,
    /// Σ w t ℓ from the joint's node to the row's, m.
    pub first: DVec3,
    /// Σ w² t ℓ, m.
    pub second: DVec3,
}

impl Ride {
    const STILL: Self = Self { joint: NONE, weight: 0.0, first: DVec3::ZERO, second: DVec3::ZERO };

    /// How far the row's node moves when its joint turns, in m.
    pub fn shift(&self, bend: DVec3) -> DVec3 {
        let squared = bend.length_squared();
        // Below, the factors are 1 and ½ to the last bit.
        let (across, back) = if squared < 1e-16 {
            (1.0, 0.5)
        } else {
            let (sin, cos) = libm::sincos(squared.sqrt());
            (sin / squared.sqrt(), (1.0 - cos) / squared)
        };
        across * bend.cross(self.first) + back * bend.cross(bend.cross(self.second))
    }

    /// The ride at the end of a way from a row that rides like this, with another weight there.
    fn extended(&self, way: DVec3, weight: f64) -> Self {
        let middle = 0.5 * (self.weight + weight);
        let (first, second) = (self.first + middle * way, self.second + middle * middle * way);
        Self { weight, first, second, ..*self }
    }
}

/// The rides of all rows. What is no joint goes on as stiffly as the node it stands on.
pub(crate) fn rides(limbs: &Limbs, wood: &Wood, joint_of_limb: &[u32], shapes: &[Shape]) -> Vec<Ride> {
    let mut rides = vec![Ride::STILL; wood.len()];
    for (limb, at) in limbs.all().iter().enumerate() {
        let joint = joint_of_limb[limb];
        let mut below = match joint {
            NONE => rides[at.node as usize],
            joint => Ride { joint, ..Ride::STILL },
        };
        for (at, &row) in limbs.rows(limb as u32).iter().enumerate() {
            let weight = if joint == NONE { below.weight } else { shapes[joint as usize].weights[at] };
            below = below.extended(wood.way(row as usize), weight);
            rides[row as usize] = below;
        }
    }
    rides
}
