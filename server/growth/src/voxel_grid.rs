//! A sparse grid of unit voxels: a directory of cubic chunks that exist where something was written.

/// Voxels along one edge of a chunk.
pub(crate) const EDGE: i32 = 1 << EDGE_BITS;
const EDGE_BITS: i32 = 4;
const VOXELS: usize = (EDGE * EDGE * EDGE) as usize;
const ABSENT: u32 = u32::MAX;

/// Values at voxels; what was never written is `T::default()`.
#[derive(Clone, Debug)]
pub(crate) struct VoxelGrid<T> {
    chunks: Vec<Box<[T]>>,
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
        match self.chunk_at(voxel.map(|c| c >> EDGE_BITS)) {
            ABSENT => T::default(),
            chunk => self.chunks[chunk as usize][offset(voxel)],
        }
    }

    /// The value at a voxel, to change.
    pub(crate) fn get_mut(&mut self, voxel: [i32; 3]) -> &mut T {
        let chunk = self.chunk_or_new(voxel.map(|c| c >> EDGE_BITS));
        &mut self.chunks[chunk as usize][offset(voxel)]
    }

    /// Calls `change` with the stretches of voxels from `start` on along x, `len` in all.
    #[inline]
    pub(crate) fn row_mut(&mut self, start: [i32; 3], len: i32, mut change: impl FnMut(&mut [T])) {
        let [mut x, y, z] = start;
        let end = x + len;
        while x < end {
            let stop = end.min(((x >> EDGE_BITS) + 1) << EDGE_BITS);
            let chunk = self.chunk_or_new([x >> EDGE_BITS, y >> EDGE_BITS, z >> EDGE_BITS]);
            let from = offset([x, y, z]);
            change(&mut self.chunks[chunk as usize][from..from + (stop - x) as usize]);
            x = stop;
        }
    }

    #[inline]
    fn chunk_at(&self, chunk: [i32; 3]) -> u32 {
        self.slot(chunk).map_or(ABSENT, |slot| self.directory[slot])
    }

    #[inline]
    fn slot(&self, chunk: [i32; 3]) -> Option<usize> {
        let at = [chunk[0] - self.origin[0], chunk[1] - self.origin[1], chunk[2] - self.origin[2]];
        let inside = (0..3).all(|i| (at[i] as u32) < self.size[i] as u32);
        inside.then(|| ((at[1] * self.size[2] + at[2]) * self.size[0] + at[0]) as usize)
    }

    fn chunk_or_new(&mut self, chunk: [i32; 3]) -> u32 {
        let slot = self.slot(chunk).unwrap_or_else(|| self.widen(chunk));
        if self.directory[slot] == ABSENT {
            self.directory[slot] = self.chunks.len() as u32;
            self.chunks.push(vec![T::default(); VOXELS].into_boxed_slice());
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

#[inline]
fn offset(voxel: [i32; 3]) -> usize {
    let [x, y, z] = voxel.map(|c| c & (EDGE - 1));
    (((y << EDGE_BITS) | z) << EDGE_BITS | x) as usize
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
    fn rows_cross_chunks() {
        let mut grid = VoxelGrid::<u32>::new();
        grid.row_mut([-20, 3, 4], 41, |stretch| stretch.iter_mut().for_each(|v| *v += 1));
        for x in -22..23 {
            assert_eq!(grid.get([x, 3, 4]), u32::from((-20..=20).contains(&x)), "x = {x}");
        }
    }
}
