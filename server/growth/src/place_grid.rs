//! Points in space, found by place.

use glam::Vec3;

use crate::voxel_grid::{VoxelGrid, voxel_of};

/// Points in one block: as many as the processor compares at once.
const LANES: usize = 8;

/// Numbered points in cubic cells.
///
/// Each cell holds its points in a chain of blocks, of which only the first may have room left: a search reads
/// positions side by side instead of hopping from point to point.
#[derive(Clone, Debug)]
pub(crate) struct PlaceGrid {
    /// Edge of a cell.
    cell: f32,
    /// In each cell its first block, plus one; 0 for none.
    heads: VoxelGrid<u32>,
    blocks: Vec<Block>,
    /// Blocks to use again.
    spare: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Block {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    number: [u32; LANES],
    len: u32,
    /// The next block of the cell, plus one.
    next: u32,
}

/// Whether a search goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Visit {
    Go,
    Stop,
}

impl Block {
    /// A lane that holds no point is infinitely far from everywhere.
    const EMPTY: Self = Self {
        x: [f32::INFINITY; LANES],
        y: [f32::INFINITY; LANES],
        z: [f32::INFINITY; LANES],
        number: [0; LANES],
        len: 0,
        next: 0,
    };

    #[inline(always)]
    fn distances_squared(&self, place: Vec3) -> [f32; LANES] {
        let mut squares = [0.0; LANES];
        for (lane, square) in squares.iter_mut().enumerate() {
            let (dx, dy, dz) = (self.x[lane] - place.x, self.y[lane] - place.y, self.z[lane] - place.z);
            *square = dx * dx + dy * dy + dz * dz;
        }
        squares
    }

    fn set(&mut self, lane: usize, place: Vec3, number: u32) {
        [self.x[lane], self.y[lane], self.z[lane]] = place.to_array();
        self.number[lane] = number;
    }

    fn push(&mut self, place: Vec3, number: u32) {
        self.set(self.len as usize, place, number);
        self.len += 1;
    }

    /// Takes out the last point.
    fn pop(&mut self) -> (Vec3, u32) {
        self.len -= 1;
        let lane = self.len as usize;
        let last = (Vec3::new(self.x[lane], self.y[lane], self.z[lane]), self.number[lane]);
        self.set(lane, Vec3::INFINITY, 0);
        last
    }
}

impl PlaceGrid {
    /// No points yet.
    pub(crate) fn new(cell: f32) -> Self {
        Self { cell, heads: VoxelGrid::new(), blocks: Vec::new(), spare: Vec::new() }
    }

    /// Enters a point.
    pub(crate) fn insert(&mut self, number: u32, place: Vec3) {
        let cell = self.cell_of(place);
        let head = self.heads.get_mut(cell);
        let has_room = *head != 0 && (self.blocks[*head as usize - 1].len as usize) < LANES;
        if !has_room {
            let block = self.spare.pop().unwrap_or(self.blocks.len() as u32);
            if block as usize == self.blocks.len() {
                self.blocks.push(Block::EMPTY);
            }
            self.blocks[block as usize].next = *head;
            *head = block + 1;
        }
        self.blocks[*head as usize - 1].push(place, number);
    }

    /// Takes out a point that was entered at this place.
    pub(crate) fn remove(&mut self, number: u32, place: Vec3) {
        let cell = self.cell_of(place);
        let head = self.heads.get_mut(cell);
        debug_assert!(*head != 0, "point {number} was never entered");
        let first = *head as usize - 1;
        // The first block's last point takes the place of the one that goes.
        let (moved_place, moved) = self.blocks[first].pop();
        if moved != number {
            let mut at = first;
            loop {
                let block = &mut self.blocks[at];
                if let Some(lane) = block.number[..block.len as usize].iter().position(|&n| n == number) {
                    block.set(lane, moved_place, moved);
                    break;
                }
                at = block.next as usize - 1;
            }
        }
        if self.blocks[first].len == 0 {
            *head = self.blocks[first].next;
            self.spare.push(first as u32);
        }
    }

    /// Calls `visit` with every point within `radius` of `place` and its squared distance, in no particular
    /// order, until it says stop.
    #[inline]
    pub(crate) fn visit_near(&self, place: Vec3, radius: f32, mut visit: impl FnMut(u32, f32) -> Visit) {
        let limit = radius * radius;
        let mut visit_block = |block: &Block| {
            let squares = block.distances_squared(place);
            if squares.iter().fold(f32::INFINITY, |least, &square| least.min(square)) > limit {
                return Visit::Go;
            }
            for (lane, &square) in squares.iter().enumerate() {
                if square <= limit && visit(block.number[lane], square) == Visit::Stop {
                    return Visit::Stop;
                }
            }
            Visit::Go
        };
        let (low, centre) = (self.cell_of(place - radius), self.cell_of(place));
        let high = self.cell_of(place + radius);
        // The place's own cell first: what stops a search is mostly near.
        if self.visit_cell(centre, &mut visit_block) == Visit::Stop {
            return;
        }
        let gap_squared = |cell: i32, at: f32| {
            let from = cell as f32 * self.cell;
            let gap = (from - at).max(at - (from + self.cell)).max(0.0);
            gap * gap
        };
        for y in low[1]..=high[1] {
            let gap_y = gap_squared(y, place.y);
            for z in low[2]..=high[2] {
                let gap_yz = gap_y + gap_squared(z, place.z);
                for x in low[0]..=high[0] {
                    // A hair wider than the limit, for the gap itself is rounded.
                    let beyond = gap_yz + gap_squared(x, place.x) > limit * 1.0001;
                    if !beyond
                        && [x, y, z] != centre
                        && self.visit_cell([x, y, z], &mut visit_block) == Visit::Stop
                    {
                        return;
                    }
                }
            }
        }
    }

    /// Whether some point within `radius` of a place counts.
    pub(crate) fn any_near(&self, place: Vec3, radius: f32, counts: impl Fn(u32) -> bool) -> bool {
        let mut found = false;
        self.visit_near(place, radius, |number, _| {
            found = counts(number);
            if found { Visit::Stop } else { Visit::Go }
        });
        found
    }

    #[inline(always)]
    fn visit_cell(&self, cell: [i32; 3], visit: &mut impl FnMut(&Block) -> Visit) -> Visit {
        let mut at = self.heads.get(cell);
        while at != 0 {
            let block = &self.blocks[at as usize - 1];
            if visit(block) == Visit::Stop {
                return Visit::Stop;
            }
            at = block.next;
        }
        Visit::Go
    }

    #[inline]
    fn cell_of(&self, place: Vec3) -> [i32; 3] {
        voxel_of(place * (1.0 / self.cell))
    }
}
