//! Casting: a metamer's shadow is added to the voxels below it, or taken back.

use glam::Vec3;

use super::{
    DEPTH, DEPTH_BITS, PLANE, ROW, ShadowGrid, VALUES, WIDTH, WIDTH_BITS, chunk_of, half_width, offset,
    voxel_of,
};

/// The voxel of a padded row that the pyramid's axis goes through.
const MIDDLE: i32 = 4;
/// Rows of this depth still fit, and pyramids of this depth meet no more than two chunks along y and three along z.
const FITTING_DEPTH: i32 = 3;

/// One row of a pyramid.
#[derive(Clone, Copy, Debug)]
pub(super) struct PyramidRow {
    /// How far below the metamer.
    depth: i32,
    /// How far beside it along z.
    z: i32,
    /// Half its width along x.
    half: i32,
    /// How far after the pyramid's least voxel it begins, where all of it lies in one chunk.
    from_least: usize,
    /// What it adds to the voxels around the metamer's own x, between as many zeros on either side.
    shadows: [u32; 3 * ROW],
}

/// The pyramid below a metamer with such shadows at each depth.
pub(super) fn pyramid(strength: &[u32]) -> Vec<PyramidRow> {
    let reach = strength.len() as i32 - 1;
    let mut rows = Vec::new();
    for (depth, &shadow) in (0..).zip(strength) {
        for z in -depth..=depth {
            let half = half_width(depth, z);
            let add =
                |lane: usize| if (lane as i32 - ROW as i32 - MIDDLE).abs() <= half { shadow } else { 0 };
            let from_least = (reach - depth) as usize * PLANE + ((reach + z) << WIDTH_BITS) as usize;
            rows.push(PyramidRow { depth, z, half, from_least, shadows: core::array::from_fn(add) });
        }
    }
    rows
}

impl ShadowGrid {
    /// Adds the shadow of a metamer with its node at `position`.
    pub fn cast(&mut self, position: Vec3) {
        self.spread(position, u32::wrapping_add);
    }

    /// Adds the shadows of many: those of the same voxel that follow each other two at a time.
    pub(crate) fn cast_all(&mut self, positions: impl Iterator<Item = Vec3>) {
        self.spread_all(positions, u32::wrapping_add);
    }

    /// Takes the shadows of many back.
    pub(crate) fn uncast_all(&mut self, positions: impl Iterator<Item = Vec3>) {
        self.spread_all(positions, u32::wrapping_sub);
    }

    #[inline(always)]
    fn spread_all(&mut self, positions: impl Iterator<Item = Vec3>, change: impl Fn(u32, u32) -> u32 + Copy) {
        let mut waiting: Option<Vec3> = None;
        for position in positions {
            waiting = match waiting {
                Some(one) if voxel_of(one) == voxel_of(position) => {
                    self.spread(one, |value, shadow| change(change(value, shadow), shadow));
                    None
                }
                other => {
                    other.into_iter().for_each(|one| self.spread(one, change));
                    Some(position)
                }
            };
        }
        waiting.into_iter().for_each(|one| self.spread(one, change));
    }

    /// Takes the same shadow back.
    pub fn uncast(&mut self, position: Vec3) {
        self.spread(position, u32::wrapping_sub);
    }

    #[inline(always)]
    fn spread(&mut self, position: Vec3, change: impl Fn(u32, u32) -> u32 + Copy) {
        let [x, y, z] = voxel_of(position);
        let left = x - MIDDLE;
        let within = (left & (WIDTH - 1)) as usize;
        if self.strength.len() as i32 - 1 > FITTING_DEPTH {
            return self.spread_deep(position, change);
        }
        let reach = self.strength.len() as i32 - 1;
        let (in_y, in_z) = (y & (DEPTH - 1), z & (DEPTH - 1));
        if within + ROW <= WIDTH as usize && in_y >= reach && in_z >= reach && in_z + reach < DEPTH {
            return self.spread_within([left, y - reach, z - reach], change);
        }
        let bases = self.bases_of(left, y, z);
        let (low_y, low_z) = ((y - reach) >> DEPTH_BITS, (z - reach) >> DEPTH_BITS);
        // A row that ends in the next chunk is added to the last voxels of this one and to the first of that one,
        // each time with what does not belong there shifted out.
        let over = (within + ROW).saturating_sub(WIDTH as usize);
        let (here, beyond) = (within - over, 2 * ROW - over);
        let voxels = self.chunks.all_mut().as_flattened_mut();
        let mut add = |row: &PyramidRow, at: usize, shift: usize| {
            let values = voxels.get_mut(at..).and_then(|voxels| voxels.first_chunk_mut::<ROW>());
            let shadows = row.shadows.get(shift..).and_then(|shadows| shadows.first_chunk::<ROW>());
            if let (Some(values), Some(shadows)) = (values, shadows) {
                // Copies, so that all sixteen can be added at once.
                let (old, shadows) = (*values, *shadows);
                *values = core::array::from_fn(|lane| change(old[lane], shadows[lane]));
            }
        };
        // What a row's place owes to its z, for all of them: its chunk, and its offset in there.
        let columns: [(usize, usize); ROW] = core::array::from_fn(|i| {
            let at_z = z - FITTING_DEPTH + i as i32;
            (((at_z >> DEPTH_BITS) - low_z) as usize & 3, offset([0, 0, at_z]))
        });
        let mut rows = self.rows.iter();
        for depth in 0..=reach {
            let at_y = y - depth;
            let layer = &bases[(((at_y >> DEPTH_BITS) - low_y) as usize & 1) * 4..][..4];
            let height = offset([0, at_y, 0]);
            let meets_both = over > 0 && (within as i32 + MIDDLE + depth) >= WIDTH;
            let columns = &columns[(FITTING_DEPTH - depth) as usize..=(FITTING_DEPTH + depth) as usize];
            for (&(chunk, column), row) in columns.iter().zip(rows.by_ref()) {
                let base = layer[chunk];
                add(row, base[0] + height + column + here, ROW - over);
                if meets_both {
                    add(row, base[1] + height + column, beyond);
                }
            }
        }
    }

    /// The same for a pyramid in one chunk, whose least voxel is this.
    #[inline(always)]
    fn spread_within(&mut self, least: [i32; 3], change: impl Fn(u32, u32) -> u32) {
        let chunk = self.number_or_make(chunk_of(least));
        let Some(values) = self.chunks.all_mut()[chunk].get_mut(offset(least)..) else { return };
        for row in &self.rows {
            if let Some(values) = values.get_mut(row.from_least..).and_then(|values| values.first_chunk_mut())
            {
                let old: [u32; ROW] = *values;
                *values = core::array::from_fn(|lane| change(old[lane], row.shadows[ROW + lane]));
            }
        }
    }

    /// Where the chunks begin that a pyramid meets, four numbers along z (the last unused) for each of two along y,
    /// and each one's neighbour along x if a row that starts at `left` reaches it.
    #[inline(always)]
    fn bases_of(&mut self, left: i32, y: i32, z: i32) -> [[usize; 2]; 8] {
        let reach = self.strength.len() as i32 - 1;
        let (low_y, low_z) = ((y - reach) >> DEPTH_BITS, (z - reach) >> DEPTH_BITS);
        let (high_y, high_z) = (y >> DEPTH_BITS, (z + reach) >> DEPTH_BITS);
        let (first, last) = (left >> WIDTH_BITS, (left + ROW as i32 - 1) >> WIDTH_BITS);
        let mut bases = [[0; 2]; 8];
        for (at_y, layer) in (low_y..=high_y).zip(bases.as_chunks_mut::<4>().0) {
            for (at_z, base) in (low_z..=high_z).zip(layer) {
                for (at_x, base) in (first..=last).zip(base) {
                    *base = self.number_or_make([at_x, at_y, at_z]) * VALUES;
                }
            }
        }
        bases
    }

    /// The same for pyramids whose rows do not fit into sixteen voxels.
    #[cold]
    fn spread_deep(&mut self, position: Vec3, change: impl Fn(u32, u32) -> u32) {
        let [x, y, z] = voxel_of(position);
        for row in 0..self.rows.len() {
            let PyramidRow { depth, z: beside, half, .. } = self.rows[row];
            let shadow = self.strength[depth as usize];
            for at_x in x - half..=x + half {
                let voxel = [at_x, y - depth, z + beside];
                let chunk = self.number_or_make(chunk_of(voxel));
                let value = &mut self.chunks.all_mut()[chunk][offset(voxel)];
                *value = change(*value, shadow);
            }
        }
    }
}
