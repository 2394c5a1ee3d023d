//! A drawn outline as a mask of pixels.

use glam::Vec2;

use super::distance::{Raster, squared_distance};

/// Pixels of background around the silhouette at least.
const MARGIN: usize = 2;
/// A row's span narrower than this, in pixels, is rounding: the two sides of a line.
const LEAST_SPAN: f64 = 1.0 / 64.0;

/// Which pixels a silhouette covers.
#[derive(Clone, Debug)]
pub(super) struct Mask {
    pub width: usize,
    pub inside: Vec<bool>,
    /// Where the first pixel's centre lies in the plane.
    pub corner: Vec2,
    /// Edge of a pixel.
    pub pixel: f32,
}

impl Mask {
    /// Fills an outline by the even-odd rule; its last point is joined to its first. `margin` is what the
    /// silhouette may be widened by, and `resolution` the mask's longer side in pixels.
    pub(super) fn fill(outline: &[Vec2], margin: f32, resolution: usize) -> Self {
        let (low, high) = bounds(outline);
        let mut mask = Self::of_box((low + high) * 0.5, high - low + 2.0 * margin, resolution);
        mask.fill_even_odd(outline);
        mask
    }

    /// Nothing yet, of a box around a place; its longer side has `resolution` pixels.
    pub(super) fn of_box(around: Vec2, size: Vec2, resolution: usize) -> Self {
        let pixel = size.max_element() / (resolution - 2 * MARGIN) as f32;
        let pixels = |length: f32| ((length / pixel).ceil() as usize).clamp(1, resolution - 2 * MARGIN);
        let (width, height) = (pixels(size.x) + 2 * MARGIN, pixels(size.y) + 2 * MARGIN);
        // The middle of the box is the mask's.
        let middle = Vec2::new((width - 1) as f32, (height - 1) as f32) * 0.5;
        let corner = around - middle * pixel;
        Self { width, inside: vec![false; width * height], corner, pixel }
    }

    fn fill_even_odd(&mut self, outline: &[Vec2]) {
        let height = self.inside.len() / self.width;
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); height];
        let in_pixels = |p: Vec2| {
            let pixel = f64::from(self.pixel);
            let along = |at: f32, from: f32| (f64::from(at) - f64::from(from)) / pixel;
            (along(p.x, self.corner.x), along(p.y, self.corner.y))
        };
        for (i, &from) in outline.iter().enumerate() {
            let (from, to) = (in_pixels(from), in_pixels(outline[(i + 1) % outline.len()]));
            let (low, high) = if from.1 <= to.1 { (from, to) } else { (to, from) };
            // Rows from the lower end up to, but without, the upper one: a corner is crossed once or twice.
            let rows = low.1.ceil().max(0.0) as usize..(high.1.ceil().max(0.0) as usize).min(height);
            for row in rows {
                let t = (row as f64 - low.1) / (high.1 - low.1);
                crossings[row].push(low.0 + t * (high.0 - low.0));
            }
        }
        for (row, crossings) in self.inside.chunks_exact_mut(self.width).zip(&mut crossings) {
            crossings.sort_unstable_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                if pair[1] - pair[0] < LEAST_SPAN {
                    continue;
                }
                let (from, to) = (pair[0].ceil().max(0.0) as usize, pair[1].ceil().max(0.0) as usize);
                let to = to.min(row.len());
                row[from.min(to)..to].fill(true);
            }
        }
    }

    /// Widens by `radius` on each side whatever is narrower than a disc of that radius, which would hold too
    /// few markers to grow into. What is wide enough keeps its outline. Returns the squared distance, in
    /// pixels, from each pixel to the background.
    pub(super) fn widen_narrow_parts(&mut self, radius: f32) -> Raster {
        let reach = radius / self.pixel;
        let depth = self.depth();
        if reach < 1.0 {
            return depth;
        }
        let limit = reach * reach;
        // Where a disc fits in, and all that such discs cover.
        let roomy: Vec<bool> = depth.values.iter().map(|&d| d >= limit).collect();
        // Two pixels more: discs on a grid leave some of a smooth rim uncovered.
        let cover = (reach + 2.0) * (reach + 2.0);
        let covered = squared_distance(self.width, &roomy, cover, |fits| fits);
        let narrow: Vec<bool> = self
            .inside
            .iter()
            .zip(&covered.values)
            .map(|(&inside, &distance)| inside && distance > cover)
            .collect();
        if !narrow.contains(&true) {
            return depth;
        }
        let near = squared_distance(self.width, &narrow, limit, |narrow| narrow);
        for (inside, distance) in self.inside.iter_mut().zip(near.values) {
            *inside |= distance <= limit;
        }
        self.clear_margin();
        self.depth()
    }

    /// The squared distance, in pixels, from each pixel to the background.
    pub(super) fn depth(&self) -> Raster {
        squared_distance(self.width, &self.inside, f32::INFINITY, |inside| !inside)
    }

    /// Keeps a border of background, from which distances are measured.
    pub(super) fn clear_margin(&mut self) {
        let width = self.width;
        let last = self.inside.len() / width - 1;
        for (y, row) in self.inside.chunks_exact_mut(width).enumerate() {
            if y == 0 || y == last {
                row.fill(false);
            }
            (row[0], row[width - 1]) = (false, false);
        }
    }
}

/// Least and greatest coordinates.
pub(super) fn bounds(outline: &[Vec2]) -> (Vec2, Vec2) {
    outline.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)))
}
