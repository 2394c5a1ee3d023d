//! Points in space, found by place.

mod neighbours;

use espalier_plant::reserve;
use glam::{Vec3, Vec4};

use self::neighbours::Neighbours;
use crate::{
    cells::bits,
    voxel_grid::{VoxelGrid, voxel_of},
};

/// Lanes that the processor compares at once.
const WIDTH: usize = 4;

/// What a block holds beside its points, lane by lane.
pub(crate) trait Lanes: Clone + core::fmt::Debug {
    /// What belongs to one point.
    type Item: Copy;
    /// A block's worth of nothing.
    const EMPTY: Self;
    /// What stands in a lane.
    fn get(&self, lane: usize) -> Self::Item;
    /// Writes a lane.
    fn set(&mut self, lane: usize, item: Self::Item);
}

/// Points alone.
impl Lanes for () {
    type Item = ();
    const EMPTY: Self = ();
    fn get(&self, _: usize) {}
    fn set(&mut self, _: usize, (): ()) {}
}

/// One vector for each lane, coordinate by coordinate.
#[derive(Clone, Debug)]
pub(crate) struct Vectors<const LANES: usize> {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
}

impl<const LANES: usize> Vectors<LANES> {
    /// The vectors in the lanes from `lane` on, coordinate by coordinate.
    #[inline(always)]
    fn from(&self, lane: usize) -> [Vec4; 3] {
        [&self.x, &self.y, &self.z].map(|values| Vec4::from_slice(&values[lane..lane + WIDTH]))
    }

    /// `place` less the vectors in the lanes from `lane` on.
    #[inline(always)]
    fn offsets(&self, lane: usize, place: Vec3) -> [Vec4; 3] {
        let [x, y, z] = self.from(lane);
        [Vec4::splat(place.x) - x, Vec4::splat(place.y) - y, Vec4::splat(place.z) - z]
    }
}

/// The greater of two numbers, where it does not matter which if one is none: `f32::max` is slower for that.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn dot([ax, ay, az]: [Vec4; 3], [bx, by, bz]: [Vec4; 3]) -> Vec4 {
    ax * bx + ay * by + az * bz
}

/// Calls `test` with the first of each few lanes; puts together what it says of them, one bit each.
#[inline(always)]
fn lanes<const LANES: usize>(mut test: impl FnMut(usize) -> u32) -> u64 {
    (0..LANES).step_by(WIDTH).map(|lane| u64::from(test(lane)) << lane).fold(0, |all, some| all | some)
}

impl<const LANES: usize> Lanes for Vectors<LANES> {
    type Item = Vec3;
    /// Infinitely far from everywhere.
    const EMPTY: Self =
        Self { x: [f32::INFINITY; LANES], y: [f32::INFINITY; LANES], z: [f32::INFINITY; LANES] };

    fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    fn set(&mut self, lane: usize, item: Vec3) {
        [self.x[lane], self.y[lane], self.z[lane]] = item.to_array();
    }
}

/// Numbered points in cubic cells, each with an item of its own.
///
/// Each cell holds its points in a chain of blocks, of which only the first may have room left: a search reads
/// positions side by side instead of hopping from point to point. A block has so many lanes, a multiple of four.
#[derive(Clone, Debug)]
pub(crate) struct PlaceGrid<const LANES: usize, L = ()> {
    /// Edge of a cell.
    cell: f32,
    /// In each cell its first block, plus one; 0 for none.
    heads: VoxelGrid<u32>,
    blocks: Vec<Block<LANES, L>>,
    /// Blocks to use again.
    spare: Vec<u32>,
}

/// Points that are read together. A lane without a point is infinitely far away.
#[derive(Clone, Debug)]
pub(crate) struct Block<const LANES: usize, L> {
    places: Vectors<LANES>,
    items: L,
    number: [u32; LANES],
    len: u32,
    /// The next block of the cell, plus one.
    next: u32,
}

/// Where a point stands among so many lanes to a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stand<const LANES: usize>(u32);

impl<const LANES: usize> Stand<LANES> {
    /// Where nothing stands.
    pub(crate) const NOWHERE: Self = Self(u32::MAX);

    fn new(block: usize, lane: usize) -> Self {
        Self((block * LANES + lane) as u32)
    }

    fn block(self) -> usize {
        self.0 as usize / LANES
    }

    fn lane(self) -> usize {
        self.0 as usize % LANES
    }
}

/// Whether a search goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Visit {
    Go,
    Stop,
}

impl<const LANES: usize, L: Lanes> Block<LANES, L> {
    const EMPTY: Self = Self { places: Vectors::EMPTY, items: L::EMPTY, number: [0; LANES], len: 0, next: 0 };

    fn set(&mut self, lane: usize, place: Vec3, number: u32, item: L::Item) {
        self.places.set(lane, place);
        self.items.set(lane, item);
        self.number[lane] = number;
    }

    /// The lanes of all points within the root of `limit` of a place.
    #[inline(always)]
    fn near(&self, place: Vec3, limit: f32) -> impl Iterator<Item = usize> {
        bits(lanes::<LANES>(|lane| {
            let offsets = self.places.offsets(lane, place);
            dot(offsets, offsets).cmple(Vec4::splat(limit)).bitmask()
        }))
    }

    /// Takes out the last point.
    fn pop(&mut self) -> (Vec3, u32, L::Item) {
        self.len -= 1;
        let lane = self.len as usize;
        let last = (self.places.get(lane), self.number[lane], self.items.get(lane));
        self.places.set(lane, Vec3::INFINITY);
        last
    }
}

impl<const LANES: usize> Block<LANES, Vectors<LANES>> {
    /// Calls `visit` with number, squared distance and cosine-times-distance of every point no farther than
    /// `limit` (squared) from `place` that sees it in the cone around its own direction (see [`crate::space::Cone`]).
    #[inline(always)]
    pub(crate) fn visit_seeing(
        &self,
        place: Vec3,
        limit: f32,
        signed_cos_squared: f32,
        mut visit: impl FnMut(u32, f32, f32),
    ) {
        let (mut squares, mut dots) = ([0.0; LANES], [0.0; LANES]);
        let seen = lanes::<LANES>(|lane| {
            let offsets = self.places.offsets(lane, place);
            let (square, along) = (dot(offsets, offsets), dot(offsets, self.items.from(lane)));
            square.write_to_slice(&mut squares[lane..]);
            along.write_to_slice(&mut dots[lane..]);
            let ahead = (along * along.abs()).cmpge(signed_cos_squared * square);
            (square.cmple(Vec4::splat(limit)) & ahead).bitmask()
        });
        for lane in bits(seen) {
            visit(self.number[lane], squares[lane], dots[lane]);
        }
    }
}

impl<const LANES: usize, L: Lanes> PlaceGrid<LANES, L> {
    /// No points yet.
    pub(crate) fn new(cell: f32) -> Self {
        Self { cell, heads: VoxelGrid::new(), blocks: Vec::new(), spare: Vec::new() }
    }

    /// Enters a point, and says where it stands.
    pub(crate) fn insert(&mut self, number: u32, place: Vec3, item: L::Item) -> Stand<LANES> {
        let cell = self.cell_of(place);
        let head = self.heads.get_mut(cell);
        let has_room = *head != 0 && (self.blocks[*head as usize - 1].len as usize) < LANES;
        if !has_room {
            let block = self.spare.pop().unwrap_or(self.blocks.len() as u32);
            if block as usize == self.blocks.len() {
                reserve(&mut self.blocks, 1);
                self.blocks.push(Block::EMPTY);
            }
            self.blocks[block as usize].next = *head;
            *head = block + 1;
        }
        let block = *head as usize - 1;
        let lane = self.blocks[block].len as usize;
        self.blocks[block].set(lane, place, number, item);
        self.blocks[block].len += 1;
        Stand::new(block, lane)
    }

    /// Where a point stands that was entered at this place.
    pub(crate) fn find(&self, number: u32, place: Vec3) -> Stand<LANES> {
        let mut at = self.heads.get(self.cell_of(place));
        loop {
            debug_assert!(at != 0, "point {number} was never entered");
            let block = &self.blocks[at as usize - 1];
            if let Some(lane) = block.number[..block.len as usize].iter().position(|&n| n == number) {
                return Stand::new(at as usize - 1, lane);
            }
            at = block.next;
        }
    }

    /// Takes out the point that stands here. If another moves to its stand, returns that one's number.
    pub(crate) fn remove(&mut self, stand: Stand<LANES>) -> Option<u32> {
        let (block, lane) = (stand.block(), stand.lane());
        let cell = self.cell_of(self.blocks[block].places.get(lane));
        let number = self.blocks[block].number[lane];
        // The last point of the cell's first block takes the place of the one that goes.
        let head = self.heads.get_mut(cell);
        let first = *head as usize - 1;
        let (place, moved, item) = self.blocks[first].pop();
        if moved != number {
            self.blocks[block].set(lane, place, moved, item);
        }
        if self.blocks[first].len == 0 {
            *head = self.blocks[first].next;
            self.spare.push(first as u32);
        }
        (moved != number).then_some(moved)
    }

    /// Moves the point that stands here, if its new place lies in the same cell. Returns whether it does.
    pub(crate) fn shift(&mut self, stand: Stand<LANES>, place: Vec3, item: L::Item) -> bool {
        let (block, lane) = (stand.block(), stand.lane());
        let stays = self.cell_of(self.blocks[block].places.get(lane)) == self.cell_of(place);
        if stays {
            self.blocks[block].places.set(lane, place);
            self.blocks[block].items.set(lane, item);
        }
        stays
    }

    /// Place and item of the point that stands here.
    pub(crate) fn at(&self, stand: Stand<LANES>) -> (Vec3, L::Item) {
        let block = &self.blocks[stand.block()];
        (block.places.get(stand.lane()), block.items.get(stand.lane()))
    }

    /// Calls `visit` with every point within `radius` of `place` and its squared distance, in no particular
    /// order, until it says stop.
    #[inline]
    pub(crate) fn visit_near(&self, place: Vec3, radius: f32, mut visit: impl FnMut(u32, f32) -> Visit) {
        let limit = radius * radius;
        self.visit_blocks(place, radius, |block| {
            for lane in block.near(place, limit) {
                let square = (place - block.places.get(lane)).length_squared();
                if visit(block.number[lane], square) == Visit::Stop {
                    return Visit::Stop;
                }
            }
            Visit::Go
        });
    }

    /// Calls `visit` with every block of every cell within `radius` of `place`, until it says stop.
    #[inline]
    fn visit_blocks(&self, place: Vec3, radius: f32, mut visit: impl FnMut(&Block<LANES, L>) -> Visit) {
        let limit = radius * radius;
        self.visit_nearing(place, radius, |block| match visit(block) {
            Visit::Go => limit,
            Visit::Stop => -1.0,
        });
    }

    /// Calls `visit` with every block of every cell that is near enough to `place`: nearer than `radius`, and
    /// then than the root of what `visit` last returned. The place's own cell comes first: what ends a search is
    /// mostly near.
    #[inline]
    pub(crate) fn visit_nearing(
        &self,
        place: Vec3,
        radius: f32,
        mut visit: impl FnMut(&Block<LANES, L>) -> f32,
    ) {
        let mut limit = radius * radius;
        let (low, centre) = (self.cell_of(place - radius), self.cell_of(place));
        let high = self.cell_of(place + radius);
        let heads = self.heads.within(low, high);
        let count = |axis: usize| high[axis] - low[axis] + 1;
        // Along an axis first the cell of the place itself, then the others.
        let nth = |axis: usize, n: i32| match n {
            0 => centre[axis],
            _ => low[axis] + n - i32::from(low[axis] + n <= centre[axis]),
        };
        let gap_squared = |cell: i32, at: f32| {
            let from = cell as f32 * self.cell;
            let gap = greater(greater(from - at, at - (from + self.cell)), 0.0);
            // A hair less than it is, for the gap itself is rounded.
            gap * gap * 0.9999
        };
        for y in (0..count(1)).map(|n| nth(1, n)) {
            let gap_y = gap_squared(y, place.y);
            for z in (0..count(2)).map(|n| nth(2, n)) {
                let gap_yz = gap_y + gap_squared(z, place.z);
                if gap_yz > limit {
                    continue;
                }
                for x in (0..count(0)).map(|n| nth(0, n)) {
                    if gap_yz + gap_squared(x, place.x) <= limit {
                        self.visit_chain(heads.get([x, y, z]), &mut limit, &mut visit);
                    }
                }
            }
        }
    }

    /// Calls `visit` with every point in a cell.
    pub(crate) fn visit_in_cell(&self, cell: [i32; 3], mut visit: impl FnMut(u32)) {
        self.visit_chain(self.heads.get(cell), &mut 0.0, &mut |block| {
            block.number[..block.len as usize].iter().for_each(|&number| visit(number));
            0.0
        });
    }

    /// Whether some point within `radius` of a place counts.
    #[inline]
    pub(crate) fn any_near(&self, place: Vec3, radius: f32, counts: impl Fn(u32) -> bool) -> bool {
        if radius > Neighbours::LONGEST * self.cell {
            return self.any_farther(place, radius, counts);
        }
        let own = self.cell_of(place);
        let cells = Neighbours::new(place, own, self.cell, radius);
        let window = self.heads.within(own, cells.corner());
        // The first block of each chain that is still to be searched, after one that stands for none. All are looked up
        // before any is searched, and chains are searched as if they were one: no branch depends on how many there are.
        let (mut heads, mut left) = ([0; 9], 0);
        for (cell, is_in_reach) in cells.cells() {
            let head = window.get(cell);
            heads[left + 1] = head;
            left += usize::from(is_in_reach & (head != 0));
        }
        let mut at = heads[left];
        while let Some(block) = self.blocks.get((at as usize).wrapping_sub(1)) {
            if block.near(place, radius * radius).any(|lane| counts(block.number[lane])) {
                return true;
            }
            left -= usize::from(block.next == 0);
            at = if block.next == 0 { heads[left] } else { block.next };
        }
        false
    }

    /// The same for a radius that may reach any number of cells.
    #[cold]
    fn any_farther(&self, place: Vec3, radius: f32, counts: impl Fn(u32) -> bool) -> bool {
        let mut found = false;
        self.visit_near(place, radius, |number, _| {
            found = counts(number);
            if found { Visit::Stop } else { Visit::Go }
        });
        found
    }

    /// Calls `visit` with the blocks of a cell, until it returns a limit below zero.
    #[inline(always)]
    fn visit_chain(&self, head: u32, limit: &mut f32, visit: &mut impl FnMut(&Block<LANES, L>) -> f32) {
        let mut at = head;
        while at != 0 && *limit >= 0.0 {
            let block = &self.blocks[at as usize - 1];
            *limit = visit(block);
            at = block.next;
        }
    }

    #[inline]
    fn cell_of(&self, place: Vec3) -> [i32; 3] {
        voxel_of(place * (1.0 / self.cell))
    }
}
