//! The way from leaves to the root of a subtree, for those that are thicker at their root than leaves can make it.

use crate::{columns::Columns, plant::Plant};

/// For each metamer from row `first` on: its place between the farthest leaf above it, 0, and the root of its
/// subtree, 1, along the wood. It never falls on the way down. Empty if no subtree tapers.
pub(super) fn rise(
    plant: &Plant,
    first: usize,
    subtrees: &[u32],
    tapers: impl Fn(usize) -> bool,
) -> Vec<f32> {
    let Some(&most) = subtrees.iter().max() else { return Vec::new() };
    let tapers: Vec<bool> = (0..=most as usize).map(tapers).collect();
    if !tapers.contains(&true) {
        return Vec::new();
    }
    let columns = plant.columns(first..plant.metamer_count());
    let Columns { parent, end, .. } = columns;
    // The row below, if it is in a subtree that tapers. That of a seed lies beyond all rows.
    let bearer = |row: usize| {
        let below = parent[row].index().checked_sub(first)?;
        subtrees.get(below).is_some_and(|&subtree| tapers[subtree as usize]).then_some(below)
    };
    // Lengths of the wood from each metamer's node to the farthest leaf, and of its own.
    let (mut above, mut own) = (vec![0.0f32; subtrees.len()], vec![0.0f32; subtrees.len()]);
    for row in (0..subtrees.len()).rev() {
        if let Some(below) = bearer(row).filter(|_| columns.lives(row, plant.step())) {
            let is_leaf = subtrees[row] != subtrees[below];
            own[row] = end[row].distance(end[below]);
            let farthest = own[row] + if is_leaf { 0.0 } else { above[row] };
            above[below] = above[below].max(farthest);
        }
    }
    // From roots to leaves, by the way that leads from the root.
    let (mut rise, mut way) = (vec![1.0; subtrees.len()], vec![0.0; subtrees.len()]);
    for (row, rise) in rise.iter_mut().enumerate() {
        if let Some(below) = bearer(row).filter(|&below| subtrees[below] == subtrees[row]) {
            way[row] = way[below] + own[row];
            *rise = above[row] / (above[row] + way[row]).max(f32::MIN_POSITIVE);
        }
    }
    rise
}
