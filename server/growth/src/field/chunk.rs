//! The markers of 4 × 4 × 4 cells, and who claims them.

use espalier_plant::AxisId;
use glam::{BVec4A, Vec3, Vec4};

use super::Lattice;
use crate::{
    cells::{CELLS, ROW, bits, cell_at, rows_of},
    obstacles::Obstacles,
    parameter_table::ParameterTable,
    space::{Cone, Space},
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
    claimants: [[AxisId; ROW]; CELLS / ROW],
    /// Markers that may ever be claimed: above ground and in no obstacle.
    pub valid: u64,
}

/// The markers of a row of cells, side by side.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct Row {
    x: [f32; ROW],
    y: [f32; ROW],
    z: [f32; ROW],
    /// Squared distance to the bud that claims the marker, infinite for none, [`TAKEN`] for a marker that is not free.
    /// Should that bud have gone, the others are at least as far away.
    nearest: [f32; ROW],
}

/// Nearer than any bud can be.
pub(super) const TAKEN: f32 = -1.0;

/// A bud that looks for markers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seeker {
    pub axis: AxisId,
    pub direction: Vec3,
    pub cone: Cone,
}

impl Row {
    const NONE: Self = Self { x: [0.0; ROW], y: [0.0; ROW], z: [0.0; ROW], nearest: [TAKEN; ROW] };

    /// Offsets of the markers from a place, coordinate by coordinate.
    #[inline(always)]
    fn offsets(&self, place: Vec3) -> [Vec4; 3] {
        [
            Vec4::from_array(self.x) - Vec4::splat(place.x),
            Vec4::from_array(self.y) - Vec4::splat(place.y),
            Vec4::from_array(self.z) - Vec4::splat(place.z),
        ]
    }

    /// Which of the markers, with these offsets and their squares, a bud perceives no farther away than their claimants
    /// do.
    #[inline(always)]
    fn seen(&self, [dx, dy, dz]: [Vec4; 3], squares: Vec4, seeker: &Seeker) -> BVec4A {
        let Seeker { direction, cone, .. } = seeker;
        let dots = dx * direction.x + dy * direction.y + dz * direction.z;
        let near = squares.cmple(Vec4::from_array(self.nearest).min(Vec4::splat(cone.far_squared)));
        let ahead = (dots * dots.abs()).cmpge(squares * cone.signed_cos_squared);
        near & ahead
    }
}

impl Chunk {
    /// The chunk of a word of the lattice, unclaimed.
    #[cold]
    pub fn new(lattice: Lattice, at: [i32; 3], obstacles: &Obstacles) -> Self {
        let nobody = [[AxisId::new(0); ROW]; CELLS / ROW];
        let mut chunk = Self { rows: [Row::NONE; CELLS / ROW], claimants: nobody, valid: 0 };
        for cell in 0..CELLS {
            let Some(marker) = lattice.marker_in(cell_at(at, cell)) else { continue };
            let (row, lane) = (&mut chunk.rows[cell / ROW], cell % ROW);
            [row.x[lane], row.y[lane], row.z[lane]] = marker.to_array();
            if marker.y > 0.0 && !obstacles.contains(marker) {
                chunk.valid |= 1 << cell;
                row.nearest[lane] = f32::INFINITY;
            }
        }
        chunk
    }

    /// The marker in a cell.
    #[inline(always)]
    pub fn marker(&self, cell: usize) -> Vec3 {
        let (row, lane) = (&self.rows[cell / ROW], cell % ROW);
        Vec3::new(row.x[lane], row.y[lane], row.z[lane])
    }

    /// A node comes to a place with its buds. It takes the markers within the square root of `zone_squared`; of the others
    /// in these cells the buds claim what they perceive, is not hidden, and no bud is nearer to.
    #[inline(always)]
    pub fn settle<const BUDS: usize>(
        &mut self,
        status: &mut Status,
        cells: u64,
        place: Vec3,
        zone_squared: f32,
        buds: &[Seeker; BUDS],
        obstacles: &Obstacles,
    ) {
        let Status { mut free, mut claimed } = *status;
        let mut left = rows_of(cells & free);
        while left != 0 {
            let cell = left.trailing_zeros() as usize;
            left &= left - 1;
            let row = cell / ROW % (CELLS / ROW);
            let offsets @ [dx, dy, dz] = self.rows[row].offsets(place);
            let squares = dx * dx + dy * dy + dz * dz;
            let taken = squares.cmple(Vec4::splat(zone_squared));
            let seen = buds.each_ref().map(|bud| self.rows[row].seen(offsets, squares, bud) & !taken);
            if seen.iter().fold(taken, |any, &seen| any | seen).bitmask() == 0 {
                continue;
            }
            let nearest = &mut self.rows[row].nearest;
            *nearest = Vec4::select(taken, Vec4::splat(TAKEN), Vec4::from_array(*nearest)).to_array();
            free &= !(u64::from(taken.bitmask()) << cell);
            for (bud, mut seen) in buds.iter().zip(seen) {
                if !obstacles.is_empty() {
                    seen &= self.not_hidden(row, place, obstacles);
                }
                self.claim_in(row, bud.axis, seen, squares);
                claimed |= u64::from(seen.bitmask()) << cell;
            }
        }
        *status = Status { free, claimed: claimed & free };
    }

    /// A bud claims those of the markers of a row that it has seen and is nearest to; the others have been claimed before.
    #[inline(always)]
    fn claim_in(&mut self, row: usize, axis: AxisId, seen: BVec4A, squares: Vec4) {
        let (nearest, claimants) = (&mut self.rows[row].nearest, &mut self.claimants[row]);
        let before = Vec4::from_array(*nearest);
        *nearest = Vec4::select(seen, squares, before).to_array();
        // Of equally near ones the oldest claims. Masks as numbers, so that four are compared at once.
        let [seen, nearer]: [[u32; ROW]; 2] = [seen, squares.cmplt(before)].map(Into::into);
        *claimants = core::array::from_fn(|lane| {
            let is_oldest = axis < claimants[lane];
            if (seen[lane] != 0) & ((nearer[lane] != 0) | is_oldest) { axis } else { claimants[lane] }
        });
    }

    /// Which of the markers of a row no obstacle hides from a place.
    #[inline(never)]
    fn not_hidden(&self, row: usize, place: Vec3, obstacles: &Obstacles) -> BVec4A {
        let is_seen = |lane: usize| !obstacles.hides(place, self.marker(row * ROW + lane));
        BVec4A::from([0, 1, 2, 3].map(is_seen))
    }

    /// Who claims a marker, and how far away it is, squared.
    #[inline(always)]
    pub fn claim(&self, cell: usize) -> (AxisId, f32) {
        let (row, lane) = (cell / ROW, cell % ROW);
        (self.claimants[row][lane], self.rows[row].nearest[lane])
    }

    /// Enters a claim.
    #[inline(always)]
    pub fn set_claim(&mut self, cell: usize, (axis, distance_squared): (AxisId, f32)) {
        let (row, lane) = (cell / ROW, cell % ROW);
        self.claimants[row][lane] = axis;
        self.rows[row].nearest[lane] = distance_squared;
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
