//! A sparse grid of values at unit voxels.

use crate::directory::Directory;
pub(crate) use crate::directory::voxel_of;

/// Voxels along one edge of a chunk.
const EDGE: i32 = 1 << EDGE_BITS;
const EDGE_BITS: i32 = 4;
const VOXELS: usize = (EDGE * EDGE * EDGE) as usize;

/// Values at voxels; what was never written is `T::default()`.
#[derive(Clone, Debug)]
pub(crate) struct VoxelGrid<T> {
    /// Values of cubes of voxels: x fastest, then z, then y.
    chunks: Directory<[T; VOXELS]>,
}

impl<T: Copy + Default> VoxelGrid<T> {
    /// An empty grid.
    pub(crate) fn new() -> Self {
        Self { chunks: Directory::new() }
    }

    /// The value at a voxel.
    #[inline]
    pub(crate) fn get(&self, voxel: [i32; 3]) -> T {
        self.chunks.get(chunk_of(voxel)).map_or_else(T::default, |chunk| chunk[offset(voxel)])
    }

    /// The values at the voxels of a box, to be asked for many times.
    #[inline]
    pub(crate) fn within(&self, low: [i32; 3], high: [i32; 3]) -> Window<'_, T> {
        let is_whole = chunk_of(low) == chunk_of(high);
        Window { grid: self, chunk: self.chunks.get(chunk_of(low)).filter(|_| is_whole) }
    }

    /// The value at a voxel, to change.
    #[inline]
    pub(crate) fn get_mut(&mut self, voxel: [i32; 3]) -> &mut T {
        &mut self.chunks.get_or_make(chunk_of(voxel), || [T::default(); VOXELS])[offset(voxel)]
    }

    /// The values at the eight voxels from `low` to `low + 1`, x fastest, then z, then y.
    pub(crate) fn octet(&self, [x, y, z]: [i32; 3]) -> [T; 8] {
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| self.get([x + (i & 1), y + (i >> 2), z + (i >> 1 & 1)]))
    }
}

/// The values at the voxels of a box.
pub(crate) struct Window<'a, T> {
    grid: &'a VoxelGrid<T>,
    /// The chunk that holds all of them, if one does.
    chunk: Option<&'a [T; VOXELS]>,
}

impl<T: Copy + Default> Window<'_, T> {
    /// The value at a voxel.
    #[inline]
    pub(crate) fn get(&self, voxel: [i32; 3]) -> T {
        self.chunk.map_or_else(|| self.grid.get(voxel), |chunk| chunk[offset(voxel)])
    }
}

/// A voxel counted so that the axis of a tree at the origin runs amid a chunk: a small tree then has one and not four.
#[inline]
fn shifted([x, y, z]: [i32; 3]) -> [i32; 3] {
    [x + EDGE / 2, y, z + EDGE / 2]
}

#[inline]
fn chunk_of(voxel: [i32; 3]) -> [i32; 3] {
    shifted(voxel).map(|i| i >> EDGE_BITS)
}

#[inline]
fn offset(voxel: [i32; 3]) -> usize {
    let [x, y, z] = shifted(voxel).map(|i| i & (EDGE - 1));
    (((y << EDGE_BITS) | z) << EDGE_BITS | x) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_voxels_are_kept_apart() {
        let mut grid = VoxelGrid::<u32>::new();
        let voxels = [[0, 0, 0], [-1, 0, 0], [1000, -3, 500], [-1000, 900, -1000], [7, 15, 7], [8, 16, 8]];
        for (value, &voxel) in voxels.iter().enumerate() {
            *grid.get_mut(voxel) = value as u32 + 1;
        }
        for (value, &voxel) in voxels.iter().enumerate() {
            assert_eq!(grid.get(voxel), value as u32 + 1);
        }
        assert_eq!(grid.get([7, 7, 7]), 0);
        assert_eq!(grid.octet([7, 15, 7]), [5, 0, 0, 0, 0, 0, 0, 6], "in eight chunks");
    }
}
