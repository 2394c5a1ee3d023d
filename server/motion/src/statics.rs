//! Exact linear statics of a tree, in two passes over its rows.
//!
//! A tree is statically determinate: what a row bears says how it bends, whatever the rest does. Under loads of one
//! direction e, each w_i e at the middle of its row, the moment in a row is L × e with a *lever* L = Σ w x − x_mid Σ w
//! over all that lies beyond, so one backward pass serves every direction. Beams are those of Euler and Bernoulli; turns
//! are small.

use glam::{DMat3, DVec3};

use crate::{
    NONE,
    wood::{TWIST, Wood},
};

/// What each row bears, itself included.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Borne {
    /// Σ w.
    pub weight: Vec<f64>,
    /// Σ w x, in metres.
    pub moment: Vec<DVec3>,
}

impl Borne {
    /// Of weights of rows, which act in their middles.
    pub fn of(wood: &Wood, weights: &[f64]) -> Self {
        let mut weight = weights.to_vec();
        let mut moment: Vec<DVec3> = (0..wood.len()).map(|row| weights[row] * wood.middle(row)).collect();
        for row in (0..wood.len()).rev() {
            let node = wood.parent[row];
            if node != NONE {
                weight[node as usize] += weight[row];
                let borne = moment[row];
                moment[node as usize] += borne;
            }
        }
        Self { weight, moment }
    }

    /// The mean of L over a row, whose own weight is spread along it: it counts by a sixth of the row's way.
    fn lever(&self, wood: &Wood, weights: &[f64], row: usize) -> DVec3 {
        self.moment[row] - self.weight[row] * wood.middle(row) + weights[row] / 6.0 * wood.way(row)
    }

    /// How a row turns from its lower end to its upper under unit loads along x, y and z, column by column.
    pub fn bend(&self, wood: &Wood, weights: &[f64], row: usize) -> DMat3 {
        let lever = self.lever(wood, weights, row);
        let softness = wood.softness(row);
        let along = if wood.length[row] > 0.0 { wood.way(row) / wood.length[row] } else { DVec3::ZERO };
        let turn = |moment: DVec3| softness * (moment + (TWIST - 1.0) * along.dot(moment) * along);
        DMat3::from_cols(
            turn(DVec3::new(0.0, lever.z, -lever.y)),
            turn(DVec3::new(-lever.z, 0.0, lever.x)),
            turn(DVec3::new(lever.y, -lever.x, 0.0)),
        )
    }
}

/// How a row's node turns and moves, in radians and metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deflection {
    /// Rotation vector.
    pub turn: DVec3,
    /// Displacement.
    pub shift: DVec3,
}

/// The pose of all rows under forces in newtons: each the row's weight times `force`. Wood is as stiff as its
/// uncalibrated modulus makes it.
pub fn deflections(wood: &Wood, weights: &[f64], force: DVec3) -> Vec<Deflection> {
    let borne = Borne::of(wood, weights);
    let mut deflections = vec![Deflection::default(); wood.len()];
    for row in 0..wood.len() {
        let node = wood.parent[row];
        if node == NONE {
            continue;
        }
        let below = deflections[node as usize];
        let bend = borne.bend(wood, weights, row) * force;
        deflections[row] = Deflection {
            turn: below.turn + bend,
            shift: below.shift + (below.turn + 0.5 * bend).cross(wood.way(row)),
        };
    }
    deflections
}

/// The same under a wind that presses alike everywhere, with `pressure` in Pa along its direction.
pub fn in_even_wind(wood: &Wood, pressure: DVec3) -> Vec<Deflection> {
    deflections(wood, &wood.drag_area, pressure)
}
