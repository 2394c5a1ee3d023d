//! Cards laid flat: each is one piece.

use glam::Vec2;

use super::LightMap;
use crate::foliage::cards::{Cards, Grid};

/// The size of each card, in internodes: the longest of its lines across and along.
pub(crate) fn sizes(cards: &Cards) -> impl Iterator<Item = Vec2> {
    cards.grids.iter().map(|grid| {
        let step = |from: [u32; 2], to: [u32; 2]| {
            let [a, b] = [from, to].map(|[column, row]| cards.mesh.positions[grid.vertex(column, row)]);
            a.distance(b)
        };
        let &Grid { columns, rows, .. } = grid;
        let across = |row| (0..columns).map(|column| step([column, row], [column + 1, row])).sum::<f32>();
        let along = |column| (0..rows).map(|row| step([column, row], [column, row + 1])).sum::<f32>();
        Vec2::new((0..=rows).map(across).fold(0.0, f32::max), (0..=columns).map(along).fold(0.0, f32::max))
    })
}

/// Adds the places of all vertices of cards, whose sizes were given as the pieces from `first` on.
pub(crate) fn places(cards: &Cards, map: &LightMap, first: usize, to: &mut Vec<Vec2>) {
    for ((piece, grid), size) in (first..).zip(&cards.grids).zip(sizes(cards)) {
        for row in 0..=grid.rows {
            for column in 0..=grid.columns {
                let share = Vec2::new(column as f32 / grid.columns as f32, row as f32 / grid.rows as f32);
                to.push(map.at(piece, share * size));
            }
        }
    }
}
