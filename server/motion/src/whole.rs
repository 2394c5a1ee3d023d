//! How fast plants swing as a whole: slower than their trunks would by themselves, for what these bear gives way as well.

use glam::DVec3;

use crate::{NONE, statics::Borne, wood::Wood};

/// ω² by row of a seed, before calibration, by Rayleigh's quotient: the plant is pulled sideways by its own weight, along x
/// and along z, and the slower counts. Infinite where nothing bends. `seed` has the seed of each row.
pub(crate) fn whole_rates(wood: &Wood, mass: &Borne, seed: &[u32]) -> Vec<f64> {
    let mut rates = vec![f64::INFINITY; wood.len()];
    for axis in [0, 2] {
        let mut turn = vec![DVec3::ZERO; wood.len()];
        let mut shift = vec![DVec3::ZERO; wood.len()];
        let mut pulled = vec![0.0; wood.len()];
        let mut moved = vec![0.0; wood.len()];
        for row in 0..wood.len() {
            let node = wood.parent[row];
            if node == NONE {
                continue;
            }
            let node = node as usize;
            let bend = mass.bend(wood, &wood.mass, row).col(axis);
            turn[row] = turn[node] + bend;
            shift[row] = shift[node] + (turn[node] + 0.5 * bend).cross(wood.way(row));
            let middle = 0.5 * (shift[node] + shift[row]);
            let plant = seed[row] as usize;
            pulled[plant] += wood.mass[row] * middle[axis];
            moved[plant] += wood.mass[row] * middle.length_squared();
        }
        for (plant, rate) in rates.iter_mut().enumerate().filter(|&(plant, _)| moved[plant] > 0.0) {
            *rate = rate.min(pulled[plant] / moved[plant]);
        }
    }
    rates
}
