//! The markers of 4 × 4 × 4 cells, and who claims them.

use espalier_plant::AxisId;
use glam::{Vec3, Vec4};

use super::Lattice;
use crate::{
    cells::{CELLS, ROW, bits, cell_at, rows_of},
    obstacles::Obstacles,
    parameter_table::ParameterTable,
    space::{Bud, Cone, Space},
};

/// Which of the markers are free and which are claimed: all that must be known of a chunk in which nothing happens.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Status {
    /// Markers in no occupancy zone.
    pub free: u64,
    /// Free markers that some bud claims or claimed.
    pub claimed: u64,
}

/// Where the markers are, and who claims them, cell by cell.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    rows: [Row; CELLS / ROW],
    claimant: [AxisId; CELLS],
    /// Markers that may ever be claimed: above ground and in no obstacle.
    pub valid: u64,
}

/// The markers of a row of cells, in one line of a cache.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct Row {
    x: [f32; ROW],
    y: [f32; ROW],
    z: [f32; ROW],
    /// Squared distance to the bud that claims the marker, infinite for none. Should that bud have gone, the
    /// others are at least as far away.
    nearest: [f32; ROW],
}

impl Row {
    const NONE: Self = Self { x: [0.0; ROW], y: [0.0; ROW], z: [0.0; ROW], nearest: [f32::INFINITY; ROW] };

    /// Which of the markers lie within the square root of `limit`.
    #[inline(always)]
    fn near(&self, place: Vec3, limit: f32) -> u32 {
        let [dx, dy, dz] = self.offsets(place);
        let squares = dx * dx + dy * dy + dz * dz;
        squares.cmple(Vec4::splat(limit)).bitmask()
    }

    /// Which of the markers a bud perceives no farther away than their claimants do.
    #[inline(always)]
    fn seen(&self, bud: Bud, cone: Cone) -> u32 {
        let [dx, dy, dz] = self.offsets(bud.position);
        let squares = dx * dx + dy * dy + dz * dz;
        let dots = dx * bud.direction.x + dy * bud.direction.y + dz * bud.direction.z;
        let near = squares.cmple(Vec4::from_array(self.nearest).min(Vec4::splat(cone.far_squared)));
        let ahead = (dots * dots.abs()).cmpge(squares * cone.signed_cos_squared);
        (near & ahead).bitmask()
    }

    /// Offsets of the markers, coordinate by coordinate.
    #[inline(always)]
    fn offsets(&self, place: Vec3) -> [Vec4; 3] {
        [
            Vec4::from_array(self.x) - Vec4::splat(place.x),
            Vec4::from_array(self.y) - Vec4::splat(place.y),
            Vec4::from_array(self.z) - Vec4::splat(place.z),
        ]
    }
}

impl Chunk {
    /// The chunk of a word of the lattice, unclaimed.
    #[cold]
    pub fn new(lattice: Lattice, at: [i32; 3], obstacles: &Obstacles) -> Self {
        let mut chunk = Self { rows: [Row::NONE; CELLS / ROW], claimant: [AxisId::new(0); CELLS], valid: 0 };
        for cell in 0..CELLS {
            let Some(marker) = lattice.marker_in(cell_at(at, cell)) else { continue };
            let (row, lane) = (&mut chunk.rows[cell / ROW], cell % ROW);
            [row.x[lane], row.y[lane], row.z[lane]] = marker.to_array();
            chunk.valid |= u64::from(marker.y > 0.0 && !obstacles.contains(marker)) << cell;
        }
        chunk
    }

    /// The marker in a cell.
    #[inline(always)]
    pub fn marker(&self, cell: usize) -> Vec3 {
        let (row, lane) = (&self.rows[cell / ROW], cell % ROW);
        Vec3::new(row.x[lane], row.y[lane], row.z[lane])
    }

    /// Which markers lie within the square root of `limit`, as far as they lie in these cells; of others it may be said
    /// as well.
    #[inline(always)]
    pub fn near(&self, cells: u64, place: Vec3, limit: f32) -> u64 {
        self.in_rows(cells, |row| row.near(place, limit))
    }

    /// Which markers a bud perceives no farther away than their claimants do; the same holds.
    #[inline(always)]
    pub fn seen(&self, cells: u64, bud: Bud, cone: Cone) -> u64 {
        self.in_rows(cells, |row| row.seen(bud, cone))
    }

    /// What `test` says of the rows of these cells.
    #[inline(always)]
    fn in_rows(&self, cells: u64, test: impl Fn(&Row) -> u32) -> u64 {
        let mut all = 0;
        let mut left = rows_of(cells);
        while left != 0 {
            let first = left.trailing_zeros() as usize;
            left &= left - 1;
            all |= u64::from(test(&self.rows[first / ROW % (CELLS / ROW)])) << first;
        }
        all
    }

    /// Who claims a marker, and how far away it is, squared.
    #[inline(always)]
    pub fn claim(&self, cell: usize) -> (AxisId, f32) {
        (self.claimant[cell], self.rows[cell / ROW].nearest[cell % ROW])
    }

    /// Enters a claim.
    #[inline(always)]
    pub fn set_claim(&mut self, cell: usize, (axis, distance_squared): (AxisId, f32)) {
        self.claimant[cell] = axis;
        self.rows[cell / ROW].nearest[cell % ROW] = distance_squared;
    }

    /// Finds the claimants of all markers whose claimants have gone, and calls `visit` with every claimant, and where it
    /// sees its marker from itself.
    pub fn resolve(
        &mut self,
        status: &mut Status,
        space: &Space,
        parameters: &ParameterTable,
        obstacles: &Obstacles,
        mut visit: impl FnMut(AxisId, Vec3),
    ) {
        for cell in bits(status.claimed) {
            let marker = self.marker(cell);
            let (mut claimant, distance_squared) = self.claim(cell);
            if space.has_moved(claimant) {
                let stays = space.bud(claimant).is_some_and(|bud| {
                    let offset = marker - bud.position;
                    offset.length_squared() == distance_squared
                        && Cone::new(parameters.of(claimant))
                            .holds(distance_squared, offset.dot(bud.direction))
                });
                if !stays {
                    let Some(claim) = claim_again(marker, space, parameters, obstacles) else {
                        self.set_claim(cell, (claimant, f32::INFINITY));
                        status.claimed &= !(1 << cell);
                        continue;
                    };
                    self.set_claim(cell, claim);
                    claimant = claim.0;
                }
            }
            if let Some(bud) = space.bud(claimant) {
                visit(claimant, marker - bud.position);
            }
        }
    }
}

/// The nearest bud that perceives a marker, and its squared distance.
#[inline(never)]
fn claim_again(
    marker: Vec3,
    space: &Space,
    parameters: &ParameterTable,
    obstacles: &Obstacles,
) -> Option<(AxisId, f32)> {
    let sees = |axis| {
        obstacles.is_empty() || space.bud(axis).is_some_and(|bud| !obstacles.hides(bud.position, marker))
    };
    space.nearest_perceiving(marker, parameters, sees)
}
