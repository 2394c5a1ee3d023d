//! Chunks of space that exist where something was written.

use espalier_plant::reserve;
use glam::{Vec3, Vec4};

const ABSENT: u32 = u32::MAX;
/// 1.5 · 2²³.
const SHIFT: f32 = 12_582_912.0;
/// The farthest place from the origin that a number with [`SHIFT`] added still tells apart, or nearly.
const FARTHEST: f32 = 4_000_000.0;

/// Finds chunks by their whole-number coordinates; a box around all of them, sparse in between.
#[derive(Clone, Debug)]
pub(crate) struct Directory<C> {
    chunks: Vec<C>,
    table: Vec<u32>,
    /// Least chunk coordinate of the table's box, and its size in chunks.
    origin: [i32; 3],
    size: [i32; 3],
}

impl<C> Directory<C> {
    /// No chunks yet.
    pub(crate) fn new() -> Self {
        Self { chunks: Vec::new(), table: Vec::new(), origin: [0; 3], size: [0; 3] }
    }

    /// The chunk at these coordinates, if there is one.
    #[inline]
    pub(crate) fn get(&self, at: [i32; 3]) -> Option<&C> {
        let chunk = self.table[self.slot(at)?];
        self.chunks.get(chunk as usize)
    }

    /// The number of the chunk at these coordinates among [all](Self::all); it never changes.
    #[inline]
    pub(crate) fn number(&self, at: [i32; 3]) -> Option<u32> {
        self.slot(at).map(|slot| self.table[slot]).filter(|&chunk| chunk != ABSENT)
    }

    /// The chunk at these coordinates, made if there was none.
    #[inline]
    pub(crate) fn get_or_make(&mut self, at: [i32; 3], make: impl FnOnce() -> C) -> &mut C {
        let chunk = self.number_or_make(at, make);
        &mut self.chunks[chunk as usize]
    }

    /// The number of the chunk at these coordinates, made if there was none.
    #[inline]
    pub(crate) fn number_or_make(&mut self, at: [i32; 3], make: impl FnOnce() -> C) -> u32 {
        match self.slot(at) {
            Some(slot) if self.table[slot] != ABSENT => self.table[slot],
            _ => self.append(at, |_| make()),
        }
    }

    /// Reserves the table for all chunks from `first` to `last`. Returns the slot of the first, and how far apart
    /// those of neighbours along x, y and z are until a chunk is asked for elsewhere.
    #[inline(always)]
    pub(crate) fn cover(&mut self, first: [i32; 3], last: [i32; 3]) -> (usize, [usize; 3]) {
        let start = match (self.slot(first), self.slot(last)) {
            (Some(start), Some(_)) => start,
            _ => self.widen_around(first, last),
        };
        let [width, _, depth] = self.size.map(|size| size as usize);
        (start, [1, width * depth, width])
    }

    #[cold]
    fn widen_around(&mut self, first: [i32; 3], last: [i32; 3]) -> usize {
        self.widen(last);
        self.slot(first).unwrap_or_else(|| self.widen(first))
    }

    /// The number of the chunk in a slot that was reserved, made if there was none.
    #[inline(always)]
    pub(crate) fn number_in_slot(
        &mut self,
        slot: usize,
        at: [i32; 3],
        make: impl FnOnce([i32; 3]) -> C,
    ) -> usize {
        let mut chunk = self.table[slot];
        if chunk == ABSENT {
            chunk = self.append(at, make);
        }
        chunk as usize
    }

    #[cold]
    #[inline(never)]
    fn append(&mut self, at: [i32; 3], make: impl FnOnce([i32; 3]) -> C) -> u32 {
        let slot = self.slot(at).unwrap_or_else(|| self.widen(at));
        let chunk = self.chunks.len();
        reserve(&mut self.chunks, 1);
        self.table[slot] = chunk as u32;
        self.chunks.push(make(at));
        chunk as u32
    }

    /// All chunks, in the order they were made.
    pub(crate) fn all(&self) -> &[C] {
        &self.chunks
    }

    /// All chunks, to change.
    pub(crate) fn all_mut(&mut self) -> &mut [C] {
        &mut self.chunks
    }

    #[inline]
    fn slot(&self, at: [i32; 3]) -> Option<usize> {
        let [x, y, z] = [at[0] - self.origin[0], at[1] - self.origin[1], at[2] - self.origin[2]];
        let [width, height, depth] = self.size;
        // As unsigned numbers, what lies below the box lies beyond it too.
        let inside = (x as u32) < width as u32 && (y as u32) < height as u32 && (z as u32) < depth as u32;
        inside.then(|| ((y * depth + z) * width + x) as usize)
    }

    /// Widens the table's box to hold a chunk, with room to spare, and returns the chunk's slot.
    #[cold]
    fn widen(&mut self, at: [i32; 3]) -> usize {
        let before = Self { chunks: Vec::new(), table: self.table.clone(), ..*self };
        for (i, &at) in at.iter().enumerate() {
            let empty = before.size[i] == 0;
            let low = if empty { at } else { before.origin[i].min(at) };
            let high = if empty { at } else { (before.origin[i] + before.size[i] - 1).max(at) };
            self.origin[i] = low - 1;
            self.size[i] = high - low + 3;
        }
        // In its own room, for it outlives whatever else is in use just now.
        self.table.clear();
        let slots = self.size.iter().map(|n| *n as usize).product();
        reserve(&mut self.table, slots);
        self.table.resize(slots, ABSENT);
        for y in 0..before.size[1] {
            for z in 0..before.size[2] {
                for x in 0..before.size[0] {
                    let at = [x + before.origin[0], y + before.origin[1], z + before.origin[2]];
                    if let (Some(old), Some(new)) = (before.slot(at), self.slot(at)) {
                        self.table[new] = before.table[old];
                    }
                }
            }
        }
        self.slot(at).unwrap_or_else(|| unreachable!("the box was widened to hold the chunk"))
    }
}

/// The voxel of edge 1 a point lies in; beyond [`FARTHEST`] the one there.
///
/// The last binary place of a number as large as [`SHIFT`] is worth 1: adding that rounds to whole numbers, all
/// three at once, which conversions one by one do not.
#[inline]
pub(crate) fn voxel_of(place: Vec3) -> [i32; 3] {
    let place = place.extend(0.0).min(Vec4::splat(FARTHEST)).max(Vec4::splat(-FARTHEST));
    let rounded = place + Vec4::splat(SHIFT);
    let too_high = (rounded - Vec4::splat(SHIFT)).cmpgt(place);
    let [x, y, z, _] = (rounded - Vec4::select(too_high, Vec4::ONE, Vec4::ZERO)).to_array();
    [x, y, z].map(|x| x.to_bits() as i32 - SHIFT.to_bits() as i32)
}

/// A number that is close for places close to each other: the interleaved bits of their coordinates (Morton
/// code), in voxels two internodes wide around the origin.
#[inline]
pub(crate) fn nearness(place: Vec3) -> u32 {
    let [x, y, z] = voxel_of(place * 0.5).map(|i| spread(i.wrapping_add(1 << 9) as u32 & 0x3ff));
    x | z << 1 | y << 2
}

/// Puts two zero bits after each of the lowest 10 bits.
fn spread(mut bits: u32) -> u32 {
    bits = (bits | bits << 16) & 0x0300_00ff;
    bits = (bits | bits << 8) & 0x0300_f00f;
    bits = (bits | bits << 4) & 0x030c_30c3;
    (bits | bits << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_chunks_are_kept_apart() {
        let mut directory = Directory::<u32>::new();
        let places = [[0, 0, 0], [-1, 0, 0], [60, -3, 50], [-70, 60, -40], [15, 15, 15], [16, 16, 16]];
        for (value, &at) in places.iter().enumerate() {
            *directory.get_or_make(at, || 0) = value as u32 + 1;
        }
        for (value, &at) in places.iter().enumerate() {
            assert_eq!(directory.get(at), Some(&(value as u32 + 1)));
        }
        assert_eq!(directory.get([7, 7, 7]), None);
        assert_eq!(directory.all().len(), places.len());
    }

    #[test]
    fn nearness_interleaves_coordinates() {
        let origin = nearness(Vec3::ZERO);
        assert_eq!(nearness(Vec3::new(2.0, 0.0, 0.0)) - origin, 0b001);
        assert_eq!(nearness(Vec3::new(0.0, 1.9, 3.0)) - origin, 0b010);
        assert_eq!(nearness(Vec3::new(6.0, 4.0, 0.0)) - origin, 0b101_001);
        assert!(nearness(Vec3::splat(-1.0)) < origin);
    }

    #[test]
    fn floors_agree_with_the_library() {
        let places = [-2.5f32, -2.0, -1.5, -0.5, -0.0, 0.0, 0.5, 0.9, 1.0, 1.5, 7.3, -1e-9, -0.999_999_94];
        for x in places.into_iter().chain([2e6 + 0.75, -2e6 - 0.75, 4e6, -4e6, 1e30, -1e30]) {
            let floor = libm::floorf(x.clamp(-4e6, 4e6)) as i32;
            assert_eq!(voxel_of(Vec3::new(x, 0.5, x)), [floor, 0, floor], "{x}");
        }
    }
}
