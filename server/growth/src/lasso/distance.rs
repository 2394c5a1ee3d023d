//! Exact distances on a pixel grid, by lower envelopes of parabolas (Felzenszwalb and Huttenlocher 2012).

use crate::side_by_side::Work;

/// Values of pixels, row by row.
#[derive(Clone, Debug)]
pub(super) struct Raster {
    pub width: usize,
    pub values: Vec<f32>,
}

impl Raster {
    /// One value everywhere.
    pub(super) fn filled(width: usize, height: usize, value: f32) -> Self {
        Self { width, values: vec![value; width * height] }
    }

    fn height(&self) -> usize {
        self.values.len() / self.width
    }

    /// Rows become columns. In tiles, for a column at a time would miss the cache at every pixel.
    fn transposed(&self) -> Self {
        let (width, height) = (self.width, self.height());
        let mut turned = Self::filled(height, width, 0.0);
        let pieces = turned.values.chunks_mut(ROWS * height).enumerate();
        TURNING.each(self.values.len(), pieces, |(tile, rows)| {
            let left = tile * ROWS;
            let columns = rows.len() / height;
            for top in (0..height).step_by(ROWS) {
                for y in top..(top + ROWS).min(height) {
                    let line = &self.values[y * width + left..][..columns];
                    for (x, &value) in line.iter().enumerate() {
                        rows[x * height + y] = value;
                    }
                }
            }
        });
        turned
    }
}

/// Rows handed to a thread at once.
const ROWS: usize = 16;

/// Rows that become columns, by pixels.
static TURNING: Work = Work::new(1 << 15);
/// Envelopes of rows, by pixels.
static ENVELOPES: Work = Work::new(1 << 15);

/// Replaces each value f(x) by the least of f(s) + |x − s|² over all pixels s. Infinite values do not count.
pub(super) fn lower_envelope(mut raster: Raster) -> Raster {
    for _ in 0..2 {
        envelopes_of_rows(&mut raster);
        raster = raster.transposed();
    }
    raster
}

/// The squared distance, in pixels, from each pixel's centre to the nearest pixel for which `is_target` holds, where
/// that is at most `limit`; some greater number, or infinite, elsewhere.
pub(super) fn squared_distance(
    width: usize,
    mask: &[bool],
    limit: f32,
    is_target: impl Fn(bool) -> bool,
) -> Raster {
    let mut values: Vec<f32> =
        mask.iter().map(|&inside| if is_target(inside) { 0.0 } else { f32::INFINITY }).collect();
    // Along columns a target is simply so many pixels away: down and up again, all columns side by side.
    for row in 1..values.len() / width {
        let (above, below) = values.split_at_mut(row * width);
        step_from(&above[(row - 1) * width..], &mut below[..width]);
    }
    for row in (1..values.len() / width).rev() {
        let (above, below) = values.split_at_mut(row * width);
        step_from(&below[..width], &mut above[(row - 1) * width..]);
    }
    for value in &mut values {
        let squared = *value * *value;
        // What is too far away along the column is so for the whole row.
        *value = if squared > limit { f32::INFINITY } else { squared };
    }
    let mut raster = Raster { width, values };
    envelopes_of_rows(&mut raster);
    raster
}

/// Distances in a row can be one more than in the row beside it at most.
fn step_from(beside: &[f32], row: &mut [f32]) {
    for (value, beside) in row.iter_mut().zip(beside) {
        *value = value.min(beside + 1.0);
    }
}

fn envelopes_of_rows(raster: &mut Raster) {
    let width = raster.width;
    let pixels = raster.values.len();
    ENVELOPES.each(pixels, raster.values.chunks_mut(ROWS * width), |rows| {
        let mut parabolas = Parabolas::new(width);
        rows.chunks_exact_mut(width).for_each(|row| parabolas.replace(row));
    });
}

/// The parabolas that make up the lower envelope of one row.
struct Parabolas {
    pieces: Vec<Piece>,
    /// 1 / 2n.
    half_inverse: Vec<f32>,
}

/// A parabola where it is the lowest.
#[derive(Clone, Copy)]
struct Piece {
    vertex: f32,
    height: f32,
    from: f32,
}

impl Parabolas {
    fn new(width: usize) -> Self {
        let nothing = Piece { vertex: 0.0, height: 0.0, from: 0.0 };
        let half_inverse = (0..=width).map(|n| 0.5 / n as f32).collect();
        Self { pieces: vec![nothing; width], half_inverse }
    }

    fn replace(&mut self, row: &mut [f32]) {
        let pieces = &mut self.pieces[..row.len()];
        let mut len = 0;
        for (x, &height) in row.iter().enumerate() {
            if height == f32::INFINITY {
                continue;
            }
            let vertex = x as f32;
            let mut from = f32::NEG_INFINITY;
            while len > 0 {
                let last = pieces[len - 1];
                let apart = vertex - last.vertex;
                // Where the new parabola meets the last one; in this form nothing large cancels.
                from =
                    0.5 * (vertex + last.vertex) + (height - last.height) * self.half_inverse[apart as usize];
                if from > last.from {
                    break;
                }
                len -= 1;
                from = f32::NEG_INFINITY;
            }
            pieces[len] = Piece { vertex, height, from };
            len += 1;
        }
        // Each piece rules from where it begins to where the next one does.
        let mut x = 0;
        for i in 0..len {
            let Piece { vertex, height, .. } = pieces[i];
            let until = if i + 1 < len { pieces[i + 1].from } else { f32::INFINITY };
            while x < row.len() && x as f32 <= until {
                let away = x as f32 - vertex;
                row[x] = height + away * away;
                x += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn envelope_agrees_with_its_definition(
            width in 1usize..12,
            values in prop::collection::vec(prop_oneof![
                Just(f32::INFINITY), Just(0.0), -60f32..60.0
            ], 1..120),
        ) {
            let height = values.len().div_ceil(width);
            let mut raster = Raster::filled(width, height, f32::INFINITY);
            raster.values[..values.len()].copy_from_slice(&values);
            let found = lower_envelope(raster.clone());
            for (i, &value) in found.values.iter().enumerate() {
                let (x, y) = ((i % width) as f32, (i / width) as f32);
                let least = raster.values.iter().enumerate().fold(f32::INFINITY, |least, (j, &height)| {
                    let (dx, dy) = ((j % width) as f32 - x, (j / width) as f32 - y);
                    least.min(height + dx * dx + dy * dy)
                });
                prop_assert!(value == least || (value - least).abs() < 1e-3, "{} against {}", value, least);
            }
        }

        #[test]
        fn distances_are_whole_and_exact(
            width in 1usize..14,
            mask in prop::collection::vec(prop::bool::weighted(0.2), 1..140),
            limit in 0f32..40.0,
        ) {
            let mask = &mask[..mask.len() - mask.len() % width.min(mask.len())];
            let width = width.min(mask.len());
            let found = squared_distance(width, mask, f32::INFINITY, |inside| inside);
            let near = squared_distance(width, mask, limit, |inside| inside);
            for (i, &value) in found.values.iter().enumerate() {
                let least = mask.iter().enumerate().filter(|(_, inside)| **inside).map(|(j, _)| {
                    let across = (j % width).abs_diff(i % width);
                    let along = (j / width).abs_diff(i / width);
                    (across * across + along * along) as f32
                });
                let least = least.fold(f32::INFINITY, f32::min);
                prop_assert_eq!(value, least);
                prop_assert!(near.values[i] == least || (near.values[i] > limit && least > limit));
            }
        }
    }
}
