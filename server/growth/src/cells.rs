//! Cells of a lattice, 4 × 4 × 4 of them to a word: one bit each.

use glam::Vec3;

use crate::directory::{Directory, voxel_of};

/// Cells in a word: x fastest, then z, then y.
pub(crate) const CELLS: usize = 64;
const EDGE: i32 = 4;
/// Cells whose x, y or z lies between two values: `RANGES[axis][low][high]`.
const RANGES: [[[u64; 4]; 4]; 3] = ranges();

/// Calls `visit` with the coordinates of each word that meets the box from `low` to `high`, in cells, and with
/// those of its cells that do.
#[inline(always)]
pub(crate) fn visit_words(low: Vec3, high: Vec3, mut visit: impl FnMut([i32; 3], u64)) {
    let (low, high) = (voxel_of(low), voxel_of(high));
    let (first, last) = (low.map(|i| i >> 2), high.map(|i| i >> 2));
    let within = |axis: usize, word: i32| {
        let from = (low[axis] - word * EDGE).max(0) as usize;
        let to = (high[axis] - word * EDGE).min(EDGE - 1) as usize;
        RANGES[axis][from & 3][to & 3]
    };
    for y in first[1]..=last[1] {
        let of_y = within(1, y);
        for z in first[2]..=last[2] {
            let of_yz = of_y & within(2, z);
            for x in first[0]..=last[0] {
                visit([x, y, z], of_yz & within(0, x));
            }
        }
    }
}

/// The coordinates of a cell of a word.
pub(crate) fn cell_at(word: [i32; 3], cell: usize) -> [i32; 3] {
    let i = cell as i32;
    let within = [i & 3, i >> 4, i >> 2 & 3];
    core::array::from_fn(|axis| word[axis] * EDGE + within[axis])
}

/// The numbers of the bits that are set, lowest first.
#[inline(always)]
pub(crate) fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        (word != 0).then(|| {
            let bit = word.trailing_zeros() as usize;
            word &= word - 1;
            bit
        })
    })
}

/// A set of cells.
#[derive(Clone, Debug)]
pub(crate) struct CellSet {
    words: Directory<([i32; 3], u64)>,
}

impl CellSet {
    /// No cells.
    pub(crate) fn new() -> Self {
        Self { words: Directory::new() }
    }

    /// Puts in the cells that meet the box from `low` to `high`, in cells.
    pub(crate) fn insert(&mut self, low: Vec3, high: Vec3) {
        visit_words(low, high, |at, cells| self.words.get_or_make(at, || (at, 0)).1 |= cells);
    }

    /// Every cell.
    pub(crate) fn iter(&self) -> impl Iterator<Item = [i32; 3]> + '_ {
        self.words.all().iter().flat_map(|&(at, cells)| bits(cells).map(move |cell| cell_at(at, cell)))
    }
}

const fn ranges() -> [[[u64; 4]; 4]; 3] {
    let mut ranges = [[[0; 4]; 4]; 3];
    let mut cell = 0;
    while cell < CELLS {
        let within = [cell & 3, cell >> 4, cell >> 2 & 3];
        let mut axis = 0;
        while axis < 3 {
            let mut low = 0;
            while low <= within[axis] {
                let mut high = within[axis];
                while high < 4 {
                    ranges[axis][low][high] |= 1 << cell;
                    high += 1;
                }
                low += 1;
            }
            axis += 1;
        }
        cell += 1;
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_holds_its_cells_once() {
        let mut set = CellSet::new();
        set.insert(Vec3::new(-5.5, 0.0, 2.0), Vec3::new(3.5, 4.0, 2.9));
        set.insert(Vec3::new(0.0, 1.0, 2.0), Vec3::new(1.0, 2.0, 2.0));
        let mut cells: Vec<[i32; 3]> = set.iter().collect();
        cells.sort_unstable();
        let mut expected = Vec::new();
        for x in -6..=3 {
            for y in 0..=4 {
                expected.push([x, y, 2]);
            }
        }
        assert_eq!(cells, expected);
    }
}
