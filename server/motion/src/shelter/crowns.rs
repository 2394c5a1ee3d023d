//! The crown itself, and other plants in front.

use glam::DVec3;

use super::RECOVERY;
use crate::wood::Wood;

/// Cells of the grid across the wind, each way.
const CELLS: usize = 64;
/// The most slabs along the wind.
const SLABS: usize = 256;
/// The narrowest cell, m: wakes are wider.
const NARROWEST: f64 = 0.2;

/// The share of the open wind's speed that each row gets past the crowns in front of it. O(rows).
///
/// Rows are marched through slab by slab along the wind. Drag area A in a cell of area C takes momentum, so that
/// pressure falls by exp(−A/C) and speed by exp(−A/2C).
pub fn behind_crowns(wood: &Wood, along: DVec3) -> Vec<f64> {
    let across = along.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::Z);
    let axes = [along, across, across.cross(along)];
    let has_drag = |row: &usize| wood.drag_area[*row] > 0.0;
    let rows: Vec<usize> = (0..wood.len()).filter(has_drag).collect();
    let mut shares = vec![1.0; wood.len()];
    let [mut least, mut most] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let at = |row: usize| axes.map(|axis| axis.dot(wood.middle(row)));
    for &row in &rows {
        for (axis, at) in at(row).into_iter().enumerate() {
            least[axis] = least[axis].min(at);
            most[axis] = most[axis].max(at);
        }
    }
    if rows.is_empty() {
        return shares;
    }
    let extent = [0, 1, 2].map(|axis| most[axis] - least[axis]);
    let cell = (extent[1].max(extent[2]) / CELLS as f64).max(NARROWEST);
    let slab = (extent[0] / SLABS as f64).max(NARROWEST);
    let index = |way: f64, size: f64, count: usize| ((way / size) as usize).min(count - 1);
    let place = |row: usize| {
        let at = at(row);
        let [x, y, z] = [0, 1, 2].map(|axis| at[axis] - least[axis]);
        (index(x, slab, SLABS), index(y, cell, CELLS) * CELLS + index(z, cell, CELLS))
    };
    let mut ordered: Vec<(usize, usize, usize)> = rows
        .iter()
        .map(|&row| {
            let (slab, cell) = place(row);
            (slab, cell, row)
        })
        .collect();
    // Stable, so rows of a slab stay in birth order, and sums are the same everywhere.
    ordered.sort_by_key(|&(slab, ..)| slab);
    let recovery = libm::exp(-slab / (RECOVERY * extent[2].max(NARROWEST)));
    let mut upwind = vec![0.0; CELLS * CELLS];
    let mut reached = 0;
    for slab in ordered.chunk_by(|a, b| a.0 == b.0) {
        for _ in reached..slab[0].0 {
            upwind.iter_mut().for_each(|area| *area *= recovery);
        }
        reached = slab[0].0;
        for &(_, at, row) in slab {
            shares[row] = libm::exp(-0.5 * upwind[at] / (cell * cell));
        }
        for &(_, at, row) in slab {
            upwind[at] += wood.drag_area[row];
        }
    }
    shares
}
