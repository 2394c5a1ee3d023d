//! The lines along which a plant reaches all parts of an envelope: its chordal axes, as a tree.
//!
//! From where the plant comes in, cheapest ways are found to every place of the silhouette, where it is cheap to keep to
//! the middle. The way to the farthest place is the first limb; what lies near a limb is reached, and the way to the
//! farthest place that is left is the next one, from where it leaves those before (Sato et al. 2000, TEASAR).

use std::{cmp::Reverse, collections::BinaryHeap};

use glam::{Vec2, Vec3};

use super::Envelope;
use crate::brush::BrushSample;

/// Edge of a cell at least, in internodes.
const LEAST_CELL: f32 = 0.5;
/// What an internode costs beyond 1: so much over its distance to the outline, in internodes, so that ways keep to the
/// middle.
const OFF_MIDDLE: f32 = 4.0;
/// A limb reaches what lies within its depth times the first of these and the second, in internodes.
const REACHED: (f32, f32) = (0.7, 0.25);
/// Limbs end so far inside, for their leaves, and shorter ones are none; in internodes.
const LEAF: f32 = 0.7;
const LEAST_LIMB: f32 = 0.5;
/// More limbs than this no outline needs.
const MAX_LIMBS: usize = 64;
/// Costs are compared as whole numbers of this many to the internode.
const UNIT: f32 = 256.0;

impl Envelope {
    /// Limbs, each as places with the depth of the body there. The first begins where the body is nearest to `from`;
    /// each other begins on one before it, or where a separate part is nearest to those.
    pub(crate) fn limbs(&self, from: Vec3) -> Vec<Vec<BrushSample>> {
        let mut cells = Cells::of(self);
        let mut limbs = Vec::new();
        let mut on_limbs: Vec<usize> = Vec::new();
        while limbs.len() < MAX_LIMBS {
            let to_limbs = |place: Vec3| {
                let nearest = on_limbs.iter().map(|&cell| cells.place(cell).distance_squared(place));
                nearest.fold(f32::INFINITY, f32::min)
            };
            let is_first = on_limbs.is_empty();
            let away = |cell: usize| {
                if is_first { cells.place(cell).distance_squared(from) } else { to_limbs(cells.place(cell)) }
            };
            let left =
                (0..cells.depth.len()).filter(|&cell| cells.depth[cell] > 0.0 && !cells.is_known(cell));
            let Some((_, root)) = left.map(|cell| (away(cell), cell)).min_by(|a, b| a.0.total_cmp(&b.0))
            else {
                break;
            };
            let part = cells.find_ways(root);
            on_limbs.push(root);
            cells.reach(root);
            while limbs.len() < MAX_LIMBS {
                let left = part.iter().copied().filter(|&cell| !cells.reached[cell]);
                let Some(end) = left.max_by_key(|&cell| (cells.cost[cell], cell)) else { break };
                let back = |&cell: &usize| (!on_limbs.contains(&cell)).then(|| cells.before[cell]);
                let mut way: Vec<usize> = core::iter::successors(Some(end), back).collect();
                way.reverse();
                way.iter().for_each(|&cell| cells.reach(cell));
                cells.reached[end] = true;
                on_limbs.extend(&way);
                let mut limb: Vec<BrushSample> = way.iter().map(|&cell| cells.sample(cell)).collect();
                let tip = cells.place(end);
                while limb.len() > 1 && limb[limb.len() - 1].position.distance(tip) < LEAF {
                    limb.pop();
                }
                if limb[0].position.distance(limb[limb.len() - 1].position) >= LEAST_LIMB || limbs.is_empty()
                {
                    limbs.push(limb);
                }
            }
        }
        limbs
    }
}

/// The silhouette in cells.
struct Cells<'a> {
    envelope: &'a Envelope,
    /// Pixels to the edge of a cell.
    stride: usize,
    width: usize,
    /// Depth of the body at each, 0 outside and below the ground.
    depth: Vec<f32>,
    /// Of the cheapest way there, and the cell before it on that way.
    cost: Vec<u32>,
    before: Vec<usize>,
    reached: Vec<bool>,
}

impl<'a> Cells<'a> {
    fn of(envelope: &'a Envelope) -> Self {
        let stride = ((LEAST_CELL / envelope.pixel) as usize).max(1);
        let width = envelope.width.div_ceil(stride);
        let height = envelope.rows().div_ceil(stride);
        let count = width * height;
        let mut cells = Self {
            envelope,
            stride,
            width,
            depth: vec![0.0; count],
            cost: vec![u32::MAX; count],
            before: vec![0; count],
            reached: vec![false; count],
        };
        for cell in 0..count {
            let [x, y] = cells.pixel(cell);
            let depth = envelope.height[y * envelope.width + x];
            cells.depth[cell] = if cells.place(cell).y > 0.0 { depth } else { 0.0 };
        }
        cells
    }

    /// The pixel in the middle of a cell.
    fn pixel(&self, cell: usize) -> [usize; 2] {
        let (width, height) = (self.envelope.width, self.envelope.rows());
        let middle = |at: usize, most: usize| (at * self.stride + self.stride / 2).min(most - 1);
        [middle(cell % self.width, width), middle(cell / self.width, height)]
    }

    fn place(&self, cell: usize) -> Vec3 {
        let [x, y] = self.pixel(cell);
        let at = self.envelope.corner + Vec2::new(x as f32, y as f32) * self.envelope.pixel;
        let plane = self.envelope.plane;
        let middle = plane.right.cross(plane.up) * self.envelope.middle(y * self.envelope.width + x);
        plane.origin + plane.right * at.x + plane.up * at.y + middle
    }

    /// How far a cell lies inside the outline.
    fn rim(&self, cell: usize) -> f32 {
        let [x, y] = self.pixel(cell);
        self.envelope.rim[y * self.envelope.width + x]
    }

    fn sample(&self, cell: usize) -> BrushSample {
        BrushSample { position: self.place(cell), radius: self.depth[cell] }
    }

    fn is_known(&self, cell: usize) -> bool {
        self.cost[cell] != u32::MAX
    }

    /// The cells of the silhouette around a cell, and how far away they are in edges.
    fn around(&self, cell: usize) -> impl Iterator<Item = (usize, f32)> + use<'_> {
        let (x, y) = ((cell % self.width) as isize, (cell / self.width) as isize);
        let (width, height) = (self.width as isize, (self.depth.len() / self.width) as isize);
        let offsets = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        let beside = offsets.filter_map(move |(dx, dy): (isize, isize)| {
            let (x, y) = (x + dx, y + dy);
            let is_there = (dx, dy) != (0, 0) && (0..width).contains(&x) && (0..height).contains(&y);
            let away = if dx != 0 && dy != 0 { core::f32::consts::SQRT_2 } else { 1.0 };
            is_there.then(|| ((y * width + x) as usize, away))
        });
        beside.filter(|&(cell, _)| self.depth[cell] > 0.0)
    }

    /// Finds the cheapest ways from a cell to all that hangs together with it; returns these.
    fn find_ways(&mut self, root: usize) -> Vec<usize> {
        let edge = self.stride as f32 * self.envelope.pixel * UNIT;
        let mut part = Vec::new();
        let mut heap = BinaryHeap::from([(Reverse(0), root)]);
        (self.cost[root], self.before[root]) = (0, root);
        while let Some((Reverse(cost), cell)) = heap.pop() {
            if cost > self.cost[cell] {
                continue;
            }
            part.push(cell);
            let beside: Vec<(usize, f32)> = self.around(cell).collect();
            for (next, away) in beside {
                let dear = 1.0 + OFF_MIDDLE / (self.rim(next) + 0.25);
                let there = cost.saturating_add((edge * away * dear) as u32 + 1);
                if there < self.cost[next] {
                    (self.cost[next], self.before[next]) = (there, cell);
                    heap.push((Reverse(there), next));
                }
            }
        }
        part
    }

    /// A limb goes through a cell.
    fn reach(&mut self, cell: usize) {
        let edge = self.stride as f32 * self.envelope.pixel;
        let reach = ((self.depth[cell] * REACHED.0 + REACHED.1) / edge).max(1.0);
        let (x, y) = ((cell % self.width) as f32, (cell / self.width) as f32);
        let rows =
            (y - reach).max(0.0) as usize..=((y + reach) as usize).min(self.depth.len() / self.width - 1);
        for row in rows {
            for column in (x - reach).max(0.0) as usize..=((x + reach) as usize).min(self.width - 1) {
                let (dx, dy) = (column as f32 - x, row as f32 - y);
                self.reached[row * self.width + column] |= dx * dx + dy * dy <= reach * reach;
            }
        }
    }
}
