//! How rows move with the joint they ride on.

use glam::{DMat3, DVec3};

use crate::{limbs::Limbs, rows::NONE, statics::Borne, wood::Wood};

/// How one row rides: by the rotation Θ of its joint, its node moves by Θ × `first` + ½ Θ × (Θ × `second`) and turns
/// by `weight` Θ.
///
/// That is the integral of exp(wΘ) along the way from the joint's node, up to the second order. Internodes keep their
/// length up to the fourth.
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
        bend.cross(self.first) + 0.5 * bend.cross(bend.cross(self.second))
    }

    /// The ride at the end of a way from a row that rides like this, with another weight there.
    fn extended(&self, way: DVec3, weight: f64) -> Self {
        let middle = 0.5 * (self.weight + weight);
        let (first, second) = (self.first + middle * way, self.second + middle * middle * way);
        Self { weight, first, second, ..*self }
    }
}

/// The rides of all rows, whose joints are given by limb.
///
/// Along a limb the weight is the share of its rotation at the tip that best describes the rotation there, over winds
/// along x and z. What is no joint goes on as stiffly as the node it stands on.
pub(crate) fn rides(limbs: &Limbs, wood: &Wood, drag: &Borne, joint_of_limb: &[u32]) -> Vec<Ride> {
    let mut rides = vec![Ride::STILL; wood.len()];
    for (limb, at) in limbs.all().iter().enumerate() {
        let mut below = match joint_of_limb[limb] {
            NONE => rides[at.node as usize],
            joint => Ride { joint, ..Ride::STILL },
        };
        let rows = limbs.rows(limb as u32);
        let bend = |row: u32| drag.bend(wood, &wood.drag_area, row as usize);
        let whole = match joint_of_limb[limb] {
            NONE => DMat3::ZERO,
            _ => rows.iter().map(|&row| bend(row)).fold(DMat3::ZERO, |sum, turn| sum + turn),
        };
        let size = level_product(&whole, &whole);
        let mut turned = DMat3::ZERO;
        for &row in rows {
            let weight = if size > 0.0 {
                turned += bend(row);
                level_product(&turned, &whole) / size
            } else {
                below.weight
            };
            below = below.extended(wood.way(row as usize), weight);
            rides[row as usize] = below;
        }
    }
    rides
}

/// The inner product of rotations under winds along x and z.
fn level_product(a: &DMat3, b: &DMat3) -> f64 {
    a.x_axis.dot(b.x_axis) + a.z_axis.dot(b.z_axis)
}
