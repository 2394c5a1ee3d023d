//! Cells of a lattice, 4 × 4 × 4 of them to a word: one bit each.

use glam::Vec3;

use crate::directory::{Directory, voxel_of};

/// Cells in a word: four to a row, 2 × 2 along x and z, x faster; of the rows, x fastest, then z, then y.
pub(crate) const CELLS: usize = 64;
/// Cells in a row.
pub(crate) const ROW: usize = 4;
const EDGE: i32 = 4;
/// Cells of a word whose x, y or z is at least a value, and at most one: `FROM[axis][least]`, `TO[axis][greatest]`.
const FROM: [[u64; 4]; 3] = ranges(false);
const TO: [[u64; 4]; 3] = ranges(true);

/// A box of cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellBox {
    /// The words that it meets: the first and the last along each axis.
    first: [i32; 3],
    last: [i32; 3],
    /// For each axis: the cells of the first of these words, and of the last, whose coordinate along it lies in the box.
    ends: [[u64; 2]; 3],
}

impl CellBox {
    /// The cells that meet the box from `low` to `high`, in cells.
    #[inline(always)]
    pub(crate) fn new(low: Vec3, high: Vec3) -> Self {
        let (low, high) = (voxel_of(low), voxel_of(high));
        let (first, last) = (low.map(|i| i >> 2), high.map(|i| i >> 2));
        let ends = core::array::from_fn(|axis| {
            let from = FROM[axis][(low[axis] & 3) as usize];
            let to = TO[axis][(high[axis] & 3) as usize];
            if first[axis] == last[axis] { [from & to, 0] } else { [from, to] }
        });
        Self { first, last, ends }
    }

    /// Calls `visit` with the chunks of all words that the box meets, made if there were none: with the chunk's number
    /// among all, its word, and those of the word's cells that lie in the box.
    #[inline(always)]
    pub(crate) fn visit<C>(
        &self,
        chunks: &mut Directory<C>,
        make: impl Fn([i32; 3]) -> C + Copy,
        mut visit: impl FnMut(&mut C, Word),
    ) {
        let Self { first, last, ends } = *self;
        let within = |axis: usize, word: i32| match word {
            _ if word == first[axis] => ends[axis][0],
            _ if word == last[axis] => ends[axis][1],
            _ => u64::MAX,
        };
        let (start, [_, per_y, per_z]) = chunks.cover(first, last);
        let mut layer = start;
        for y in first[1]..last[1] + 1 {
            let of_y = within(1, y);
            let mut row = layer;
            for z in first[2]..last[2] + 1 {
                let of_yz = of_y & within(2, z);
                for (x, slot) in (first[0]..last[0] + 1).zip(row..) {
                    let at = [x, y, z];
                    let number = chunks.number_in_slot(slot, at, make);
                    visit(&mut chunks.all_mut()[number], Word { number, at, cells: of_yz & within(0, x) });
                }
                row += per_z;
            }
            layer += per_y;
        }
    }
}

/// A word of which a box holds some cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Word {
    /// The number of its chunk among all.
    pub number: usize,
    /// Its coordinates.
    pub at: [i32; 3],
    /// The cells.
    pub cells: u64,
}

/// The coordinates of a cell of a word.
pub(crate) fn cell_at(word: [i32; 3], cell: usize) -> [i32; 3] {
    core::array::from_fn(|axis| word[axis] * EDGE + within_word(cell)[axis])
}

/// The coordinates of a cell among those of its word.
const fn within_word(cell: usize) -> [i32; 3] {
    let i = cell as i32;
    [i & 1 | i >> 1 & 2, i >> 4, i >> 1 & 1 | i >> 2 & 2]
}

/// The first cells of those rows in which some bit is set, one bit each.
#[inline(always)]
pub(crate) fn rows_of(word: u64) -> u64 {
    let any = word | word >> 1;
    (any | any >> 2) & 0x1111_1111_1111_1111
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
        CellBox::new(low, high).visit(&mut self.words, |at| (at, 0), |found, word| found.1 |= word.cells);
    }

    /// Every cell.
    pub(crate) fn iter(&self) -> impl Iterator<Item = [i32; 3]> + '_ {
        self.words.all().iter().flat_map(|&(at, cells)| bits(cells).map(move |cell| cell_at(at, cell)))
    }
}

const fn ranges(is_upper: bool) -> [[u64; 4]; 3] {
    let mut ranges = [[0; 4]; 3];
    let mut cell = 0;
    while cell < CELLS {
        let within = within_word(cell);
        let mut axis = 0;
        while axis < 3 {
            let mut bound = 0;
            while bound < 4 {
                let belongs =
                    if is_upper { within[axis] <= bound as i32 } else { within[axis] >= bound as i32 };
                ranges[axis][bound] |= (belongs as u64) << cell;
                bound += 1;
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
