//! A sparse grid of unit voxels: a directory of cubic chunks that exist where something was written.

use glam::Vec3;

/// Voxels along one edge of a chunk.
pub(crate) const EDGE: i32 = 1 << EDGE_BITS;
const EDGE_BITS: i32 = 4;
const VOXELS: usize = (EDGE * EDGE * EDGE) as usize;
const ABSENT: u32 = u32::MAX;
/// Offsets of the voxels at +x, +z, +y and their sums within a chunk.
const OCTET: [usize; 8] = {
    let (z, y) = (EDGE as usize, (EDGE * EDGE) as usize);
    [0, 1, z, z + 1, y, y + 1, y + z, y + z + 1]
};

/// Values of a cube of voxels: x fastest, then z, then y.
pub(crate) type Chunk<T> = [T; VOXELS];

/// Values at voxels; what was never written is `T::default()`.
#[derive(Clone, Debug)]
pub(crate) struct VoxelGrid<T> {
    chunks: Vec<Box<Chunk<T>>>,
    directory: Vec<u32>,
    /// Least chunk coordinate of the directory's box, and its size in chunks.
    origin: [i32; 3],
    size: [i32; 3],
}

impl<T: Copy + Default> VoxelGrid<T> {
    /// An empty grid.
    pub(crate) fn new() -> Self {
        Self { chunks: Vec::new(), directory: Vec::new(), origin: [0; 3], size: [0; 3] }
    }

    /// The value at a voxel.
    #[inline]
    pub(crate) fn get(&self, voxel: [i32; 3]) -> T {
        match self.chunk_at(chunk_of(voxel)) {
            ABSENT => T::default(),
            chunk => self.chunks[chunk as usize][offset(voxel)],
        }
    }

    /// The value at a voxel, to change.
    pub(crate) fn get_mut(&mut self, voxel: [i32; 3]) -> &mut T {
        let chunk = self.chunk_or_new(chunk_of(voxel));
        &mut self.chunks[chunk as usize][offset(voxel)]
    }

    /// Calls `visit` with each chunk that meets the box from `low` to `high`, both included, and with the
    /// chunk's least voxel. Chunks are made where there are none.
    pub(crate) fn chunks_mut(
        &mut self,
        low: [i32; 3],
        high: [i32; 3],
        mut visit: impl FnMut(&mut Chunk<T>, [i32; 3]),
    ) {
        let (first, last) = (chunk_of(low), chunk_of(high));
        for y in first[1]..=last[1] {
            for z in first[2]..=last[2] {
                for x in first[0]..=last[0] {
                    let chunk = self.chunk_or_new([x, y, z]);
                    visit(&mut self.chunks[chunk as usize], [x << EDGE_BITS, y << EDGE_BITS, z << EDGE_BITS]);
                }
            }
        }
    }

    /// The values at the eight voxels from `low` to `low + 1`, x fastest, then z, then y.
    #[inline]
    pub(crate) fn octet(&self, low: [i32; 3]) -> [T; 8] {
        let last = EDGE - 1;
        if low[0] & last != last && low[1] & last != last && low[2] & last != last {
            let chunk = self.chunk_at(chunk_of(low));
            if chunk == ABSENT {
                return [T::default(); 8];
            }
            let (chunk, at) = (&self.chunks[chunk as usize], offset(low));
            let mut octet = [T::default(); 8];
            for (value, step) in octet.iter_mut().zip(OCTET) {
                *value = chunk[(at + step) & (VOXELS - 1)];
            }
            return octet;
        }
        let [x, y, z] = low;
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| self.get([x + (i & 1), y + (i >> 2), z + (i >> 1 & 1)]))
    }

    #[inline]
    fn chunk_at(&self, chunk: [i32; 3]) -> u32 {
        self.slot(chunk).map_or(ABSENT, |slot| self.directory[slot])
    }

    #[inline]
    fn slot(&self, chunk: [i32; 3]) -> Option<usize> {
        let [x, y, z] = [chunk[0] - self.origin[0], chunk[1] - self.origin[1], chunk[2] - self.origin[2]];
        let [width, height, depth] = self.size;
        // As unsigned numbers, what lies below the box lies beyond it too.
        let inside = (x as u32) < width as u32 && (y as u32) < height as u32 && (z as u32) < depth as u32;
        inside.then(|| ((y * depth + z) * width + x) as usize)
    }

    fn chunk_or_new(&mut self, chunk: [i32; 3]) -> u32 {
        let slot = self.slot(chunk).unwrap_or_else(|| self.widen(chunk));
        if self.directory[slot] == ABSENT {
            self.directory[slot] = self.chunks.len() as u32;
            self.chunks.push(Box::new([T::default(); VOXELS]));
        }
        self.directory[slot]
    }

    /// Widens the directory's box to hold a chunk, with room to spare, and returns the chunk's slot.
    #[cold]
    fn widen(&mut self, chunk: [i32; 3]) -> usize {
        let mut wider = Self::new();
        for (i, &at) in chunk.iter().enumerate() {
            let empty = self.size[i] == 0;
            let low = if empty { at } else { self.origin[i].min(at) };
            let high = if empty { at } else { (self.origin[i] + self.size[i] - 1).max(at) };
            wider.origin[i] = low - 1;
            wider.size[i] = high - low + 3;
        }
        wider.directory = vec![ABSENT; wider.size.iter().map(|n| *n as usize).product()];
        for y in 0..self.size[1] {
            for z in 0..self.size[2] {
                for x in 0..self.size[0] {
                    let at = [x + self.origin[0], y + self.origin[1], z + self.origin[2]];
                    if let (Some(old), Some(new)) = (self.slot(at), wider.slot(at)) {
                        wider.directory[new] = self.directory[old];
                    }
                }
            }
        }
        (self.directory, self.origin, self.size) = (wider.directory, wider.origin, wider.size);
        self.slot(chunk).unwrap_or_else(|| unreachable!("the box was widened to hold the chunk"))
    }

    /// Every value of every chunk, for tests.
    #[cfg(test)]
    pub(crate) fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.chunks.iter().flat_map(|chunk| chunk.iter().copied())
    }
}

/// The voxel a point lies in.
#[inline]
pub(crate) fn voxel_of(place: Vec3) -> [i32; 3] {
    [floor(place.x), floor(place.y), floor(place.z)]
}

/// The greatest whole number not above `x`. Exact, and cheaper than `libm`'s on processors of the baseline.
#[inline]
fn floor(x: f32) -> i32 {
    let toward_zero = x as i32;
    toward_zero - i32::from(x < toward_zero as f32)
}

#[inline]
fn chunk_of(voxel: [i32; 3]) -> [i32; 3] {
    [voxel[0] >> EDGE_BITS, voxel[1] >> EDGE_BITS, voxel[2] >> EDGE_BITS]
}

#[inline]
fn offset([x, y, z]: [i32; 3]) -> usize {
    let last = EDGE - 1;
    ((((y & last) << EDGE_BITS) | (z & last)) << EDGE_BITS | (x & last)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_voxels_are_kept_apart() {
        let mut grid = VoxelGrid::<u32>::new();
        let voxels =
            [[0, 0, 0], [-1, 0, 0], [1000, -3, 500], [-1000, 900, -1000], [15, 15, 15], [16, 16, 16]];
        for (value, &voxel) in voxels.iter().enumerate() {
            *grid.get_mut(voxel) = value as u32 + 1;
        }
        for (value, &voxel) in voxels.iter().enumerate() {
            assert_eq!(grid.get(voxel), value as u32 + 1);
        }
        assert_eq!(grid.get([7, 7, 7]), 0);
    }

    #[test]
    fn octets_agree_with_single_voxels() {
        let mut grid = VoxelGrid::<u32>::new();
        for i in 0..40 {
            for j in 0..40 {
                *grid.get_mut([i - 20, j - 20, (i * j) % 37 - 18]) = (i * 100 + j) as u32;
            }
        }
        for low in [[0, 0, 0], [-1, 4, 15], [15, 15, 15], [-17, -17, 3], [3, -1, -1]] {
            let [x, y, z] = low;
            let expected =
                [0, 1, 2, 3, 4, 5, 6, 7].map(|i| grid.get([x + (i & 1), y + (i >> 2), z + (i >> 1 & 1)]));
            assert_eq!(grid.octet(low), expected);
        }
    }
}
