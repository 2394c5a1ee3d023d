//! The one shape in which a limb bends, and how far it does.

use glam::DMat3;

use crate::{statics::Borne, wood::Wood};

/// Rounds of the search; each is nearer by the ratio of what the best and the second best shape describe.
const ROUNDS: u32 = 4;

/// How a limb bends: its node a turns by `weights[a]` C e under a wind with a pressure of 1 Pa along e.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Shape {
    /// C, in radians for each Pa along x, y and z.
    pub compliance: DMat3,
    /// Node by node from the base up; the largest is 1 or −1.
    pub weights: Vec<f64>,
}

impl Shape {
    /// The best shape: statics turns node a by θ_a, and Σ s_a |θ_a − w_a C|² over winds along x and z is least. What a
    /// node counts for, s_a, is its length times the drag area of what it bears, because a turn moves all that is
    /// beyond. That is the first singular pair of the θ_a as rows of a matrix, found by turns.
    pub fn of(wood: &Wood, drag: &Borne, rows: &[u32]) -> Self {
        let mut turned = DMat3::ZERO;
        let nodes: Vec<(f64, DMat3)> = rows
            .iter()
            .map(|&row| {
                let row = row as usize;
                turned += drag.bend(wood, &wood.drag_area, row);
                (wood.length[row] * drag.weight[row], turned)
            })
            .collect();
        let mut compliance = turned;
        let mut weights = vec![0.0; rows.len()];
        for _ in 0..ROUNDS {
            let size = level_product(&compliance, &compliance);
            if size == 0.0 {
                break;
            }
            let (mut sum, mut squares) = (DMat3::ZERO, 0.0);
            for ((share, turned), weight) in nodes.iter().zip(&mut weights) {
                *weight = level_product(turned, &compliance) / size;
                sum += *turned * (share * *weight);
                squares += share * *weight * *weight;
            }
            compliance = sum * (1.0 / squares);
        }
        let largest = weights.iter().fold(0.0, |largest: f64, weight| largest.max(weight.abs()));
        if largest > 0.0 {
            weights.iter_mut().for_each(|weight| *weight /= largest);
            compliance *= largest;
        }
        Self { compliance, weights }
    }
}

/// The inner product of rotations under winds along x and z.
fn level_product(a: &DMat3, b: &DMat3) -> f64 {
    a.x_axis.dot(b.x_axis) + a.z_axis.dot(b.z_axis)
}
