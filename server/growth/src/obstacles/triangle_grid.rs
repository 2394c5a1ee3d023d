//! Triangles by place: a uniform grid whose cells list the triangles that reach into them.

use glam::Vec3;

use super::triangle::Triangle;
use crate::world::WORLD_EXTENT;

/// Cells along one axis at most.
const MAX_CELLS: u32 = 128;
/// Entries of all cells together at most, counted before those are left out that only come near a cell.
const MAX_ENTRIES: u64 = 8_000_000;
/// Cells list what comes this near to them, in cells, and what rounding far from the origin may move there.
const SLACK: f32 = 1.0e-3;
const ROUNDING: f32 = 1.0e-6;

/// Which triangles reach into which cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TriangleGrid {
    low: Vec3,
    cell: Vec3,
    size: [u32; 3],
    /// Where the list of each cell begins; one more than there are cells.
    starts: Vec<u32>,
    lists: Vec<u32>,
    /// Of a closed mesh, for each cell where it lies.
    sides: Vec<Side>,
}

/// Where a cell lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Triangles pass through it, or nobody has asked.
    Mixed,
    Outside,
    Inside,
}

/// Whether a walk goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Walk {
    Go,
    Stop,
}

impl TriangleGrid {
    /// Sorts in triangles, of which there is at least one.
    pub(super) fn new(triangles: &[Triangle]) -> Self {
        let corners = || triangles.iter().flat_map(|triangle| triangle.0);
        let low = corners().fold(Vec3::INFINITY, Vec3::min);
        let high = corners().fold(Vec3::NEG_INFINITY, Vec3::max);
        // Flat meshes get some thickness, and nothing lies on the outermost border.
        let pad = (high - low).max_element().max(1.0e-3) * 1.0e-3 + high.abs().max(low.abs()) * 1.0e-6;
        let (low, extent) = (low - pad, high - low + 2.0 * pad);
        let volume = f64::from(extent.x) * f64::from(extent.y) * f64::from(extent.z);
        let mut edge = libm::cbrt(volume / (2.0 * triangles.len() as f64)) as f32;
        loop {
            let size = extent.to_array().map(|side| ((side / edge).ceil() as u32).clamp(1, MAX_CELLS));
            let cells = Vec3::from_array(size.map(|cells| cells as f32));
            let mut grid = Self {
                low,
                cell: extent / cells,
                size,
                starts: Vec::new(),
                lists: Vec::new(),
                sides: Vec::new(),
            };
            let entries: u64 = triangles.iter().map(|triangle| grid.boxed(triangle).count()).sum();
            if entries <= MAX_ENTRIES || size == [1; 3] {
                grid.fill(triangles);
                return grid;
            }
            edge *= 2.0;
        }
    }

    fn fill(&mut self, triangles: &[Triangle]) {
        let cells = self.size.iter().product::<u32>() as usize;
        self.starts = vec![0; cells + 1];
        let mut entries: Vec<(u32, u32)> = Vec::new();
        for (number, triangle) in triangles.iter().enumerate() {
            let slab = self.slab(triangle);
            self.boxed(triangle).each(|cell| {
                if slab.reaches(self.middle(cell)) {
                    entries.push((self.slot(cell) as u32, number as u32));
                }
            });
        }
        for &(slot, _) in &entries {
            self.starts[slot as usize + 1] += 1;
        }
        for slot in 0..cells {
            self.starts[slot + 1] += self.starts[slot];
        }
        let mut next = self.starts.clone();
        self.lists = vec![0; entries.len()];
        for (slot, number) in entries {
            let at = &mut next[slot as usize];
            self.lists[*at as usize] = number;
            *at += 1;
        }
    }

    /// Finds out for every cell without triangles on which side it lies. Cells that touch lie on the same.
    pub(super) fn tell_sides(&mut self, is_inside: impl Fn(&Self, Vec3) -> bool) {
        let cells = self.size.iter().product::<u32>() as usize;
        let mut sides = vec![Side::Mixed; cells];
        let is_empty = |slot: usize| self.starts[slot] == self.starts[slot + 1];
        let all = CellBox { low: [0; 3], high: self.size.map(|cells| cells - 1) };
        let mut open = Vec::new();
        all.each(|cell| {
            let first = self.slot(cell);
            if sides[first] != Side::Mixed || !is_empty(first) {
                return;
            }
            let side = if is_inside(self, self.middle(cell)) { Side::Inside } else { Side::Outside };
            sides[first] = side;
            open.push(cell);
            while let Some(cell) = open.pop() {
                for (axis, step) in [(0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)] {
                    let mut beside = cell;
                    beside[axis] = beside[axis].wrapping_add_signed(step);
                    if beside[axis] >= self.size[axis] {
                        continue;
                    }
                    let slot = self.slot(beside);
                    if sides[slot] == Side::Mixed && is_empty(slot) {
                        sides[slot] = side;
                        open.push(beside);
                    }
                }
            }
        });
        self.sides = sides;
    }

    /// On which side a place lies, as far as its cell tells.
    pub(super) fn side(&self, place: Vec3) -> Side {
        if place.cmplt(self.low).any() || place.cmpgt(self.high()).any() {
            return Side::Outside;
        }
        self.sides.get(self.slot(self.cell_of(place))).copied().unwrap_or(Side::Mixed)
    }

    /// Calls `visit` with the triangles of each cell that a ray passes and with the span of the ray in the
    /// cell, in multiples of `along`, near cells first, up to `end`. Spans follow each other without a gap.
    pub(super) fn walk(
        &self,
        from: Vec3,
        along: Vec3,
        end: f32,
        mut visit: impl FnMut(&[u32], f32, f32) -> Walk,
    ) {
        let Some((mut since, leaves)) = self.clip(from, along, end) else { return };
        let mut cell = self.cell_of(from + along * since).map(|at| at as i32);
        loop {
            // The next border crossed, and in which direction.
            let (mut until, mut way) = (f32::INFINITY, 0);
            for axis in 0..3 {
                if along[axis] == 0.0 {
                    continue;
                }
                let border = cell[axis] + i32::from(along[axis] > 0.0);
                let t = (self.low[axis] + border as f32 * self.cell[axis] - from[axis]) / along[axis];
                if t < until {
                    (until, way) = (t, axis);
                }
            }
            // A border behind is one that rounding has put there.
            let until = until.max(since);
            let slot = self.slot(cell.map(|at| at as u32));
            let list = &self.lists[self.starts[slot] as usize..self.starts[slot + 1] as usize];
            if visit(list, since, until) == Walk::Stop || until >= leaves {
                return;
            }
            cell[way] += if along[way] > 0.0 { 1 } else { -1 };
            if cell[way] < 0 || cell[way] >= self.size[way] as i32 {
                return;
            }
            since = until;
        }
    }

    /// Calls `visit` with the triangles of each cell within `radius` of a place along each axis.
    pub(super) fn near(&self, place: Vec3, radius: f32, mut visit: impl FnMut(u32)) {
        if (place + radius).cmplt(self.low).any() || (place - radius).cmpgt(self.high()).any() {
            return;
        }
        let around = CellBox { low: self.cell_of(place - radius), high: self.cell_of(place + radius) };
        around.each(|cell| {
            let slot = self.slot(cell);
            for &number in &self.lists[self.starts[slot] as usize..self.starts[slot + 1] as usize] {
                visit(number);
            }
        });
    }

    /// From where to where a ray is in the grid's box.
    fn clip(&self, from: Vec3, along: Vec3, end: f32) -> Option<(f32, f32)> {
        let (mut since, mut until) = (0.0f32, end);
        for axis in 0..3 {
            let (low, side) = (self.low[axis], self.cell[axis] * self.size[axis] as f32);
            if along[axis] == 0.0 {
                if from[axis] < low || from[axis] > low + side {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - from[axis]) / along[axis], (low + side - from[axis]) / along[axis]);
            since = since.max(a.min(b));
            until = until.min(a.max(b));
        }
        (since <= until).then_some((since, until))
    }

    /// The cell of a place, or the nearest one.
    fn cell_of(&self, place: Vec3) -> [u32; 3] {
        let at = (place - self.low) / self.cell;
        [0, 1, 2].map(|axis| (at[axis].max(0.0) as u32).min(self.size[axis] - 1))
    }

    fn slot(&self, [x, y, z]: [u32; 3]) -> usize {
        ((y * self.size[2] + z) * self.size[0] + x) as usize
    }

    fn middle(&self, cell: [u32; 3]) -> Vec3 {
        self.low + self.cell * Vec3::from_array(cell.map(|at| at as f32 + 0.5))
    }

    fn slack(&self) -> Vec3 {
        let farthest = self.low.abs().max(self.high().abs()) + WORLD_EXTENT;
        self.cell * SLACK + farthest * ROUNDING
    }

    /// The box it covers, which is larger than the triangles'.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        (self.low, self.high())
    }

    fn high(&self) -> Vec3 {
        self.low + self.cell * Vec3::from_array(self.size.map(|cells| cells as f32))
    }

    /// The cells that a triangle's box meets.
    fn boxed(&self, triangle: &Triangle) -> CellBox {
        let [a, b, c] = triangle.0;
        let slack = self.slack();
        CellBox { low: self.cell_of(a.min(b).min(c) - slack), high: self.cell_of(a.max(b).max(c) + slack) }
    }

    /// The space between the planes on either side of a triangle that just leave out cells clear of it.
    fn slab(&self, triangle: &Triangle) -> Slab {
        let normal = triangle.normal();
        let reach = normal.abs().dot(0.5 * self.cell + self.slack());
        Slab { normal, corner: triangle.0[0], reach }
    }
}

/// Cells from `low` to `high`, both included.
struct CellBox {
    low: [u32; 3],
    high: [u32; 3],
}

impl CellBox {
    fn count(&self) -> u64 {
        (0..3).map(|axis| u64::from(self.high[axis] - self.low[axis] + 1)).product()
    }

    fn each(&self, mut visit: impl FnMut([u32; 3])) {
        for y in self.low[1]..=self.high[1] {
            for z in self.low[2]..=self.high[2] {
                for x in self.low[0]..=self.high[0] {
                    visit([x, y, z]);
                }
            }
        }
    }
}

struct Slab {
    normal: Vec3,
    corner: Vec3,
    reach: f32,
}

impl Slab {
    fn reaches(&self, middle: Vec3) -> bool {
        self.normal.dot(middle - self.corner).abs() <= self.reach
    }
}
