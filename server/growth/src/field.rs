//! The field of markers that fills all space for growth without guidance (TreeSketch §3.2, "Competition for
//! space").
//!
//! One marker lies in each cell of a lattice, anywhere in it; the cells are as wide as makes a bud perceive
//! `markers_per_bud` of them. Which bud is nearest to each free marker is kept up as nodes and buds come and go,
//! so a step costs what has changed, not what there is. The field holds nothing that could not be made afresh
//! from the nodes and the buds.

use espalier_plant::AxisId;
use glam::{Vec3, Vec4};
use rayon::prelude::*;

use crate::{
    cells::{CELLS, CellBox, bits, cell_at},
    directory::Directory,
    obstacles::Obstacles,
    parameter_table::ParameterTable,
    parameters::Parameters,
    random::{Draw, Purpose},
    space::{Bud, Cone, Space},
};

/// The finest and the coarsest lattice, in internodes: beyond them parameters would ask for millions of markers
/// or for none.
const SPACING: (f32, f32) = (0.5, 8.0);
/// Chunks that one thread goes through at a time.
const BATCH: usize = 64;

/// The markers of the lattice, as far as nodes and buds have touched it.
#[derive(Clone, Debug)]
pub(crate) struct MarkerField {
    lattice: Lattice,
    chunks: Directory<Chunk>,
}

/// Where markers lie: one in each cell, or, for plants that grow in the plane z = 0, one in each cell of that plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    seed: u32,
    /// Edge of a cell.
    pub(crate) spacing: f32,
    is_flat: bool,
}

/// 4 × 4 × 4 markers, x fastest, then z, then y.
#[derive(Clone, Debug)]
struct Chunk {
    x: [f32; CELLS],
    y: [f32; CELLS],
    z: [f32; CELLS],
    /// Squared distance to the bud that claims the marker, infinite for none. Should that bud have gone, the
    /// others are at least as far away.
    nearest: [f32; CELLS],
    claimant: [AxisId; CELLS],
    /// Markers that may ever be claimed: above ground and in no obstacle.
    valid: u64,
    /// Markers in no occupancy zone.
    free: u64,
    /// Markers that some bud claims or claimed.
    claimed: u64,
}

impl MarkerField {
    /// A field that nothing has touched.
    pub(crate) fn new(seed: u32, parameters: &Parameters) -> Self {
        Self { lattice: Lattice::new(seed, parameters), chunks: Directory::new() }
    }

    /// A node takes the markers in its zone.
    pub(crate) fn occupy(&mut self, place: Vec3, radius: f32, obstacles: &Obstacles) {
        self.visit(obstacles, place - radius, place + radius, |chunk, cells| {
            let mut near = 0;
            for row in rows(cells & chunk.free) {
                near |= chunk.near(row, place, radius * radius);
            }
            let left = !(near & cells);
            chunk.free &= left;
            chunk.claimed &= left;
        });
    }

    /// A node gives the markers back that lie in no other's zone.
    pub(crate) fn vacate(&mut self, place: Vec3, radius: f32, space: &Space, obstacles: &Obstacles) {
        self.visit(obstacles, place - radius, place + radius, |chunk, cells| {
            for cell in bits(cells & chunk.valid & !chunk.free) {
                let near = chunk.distance_squared(cell, place) <= radius * radius;
                if near && !space.is_occupied(chunk.marker(cell), radius, |_| true) {
                    // Who claims it is unknown: as if a bud at this very place had gone.
                    chunk.free |= 1 << cell;
                    chunk.claimed |= 1 << cell;
                    (chunk.nearest[cell], chunk.claimant[cell]) = (-1.0, nobody());
                }
            }
        });
    }

    /// A bud claims what it perceives and no bud is nearer to.
    pub(crate) fn place_bud(
        &mut self,
        axis: AxisId,
        bud: Bud,
        parameters: &Parameters,
        obstacles: &Obstacles,
    ) {
        let Bud { position: place, direction } = bud;
        let (low, high) = reach(place, direction, parameters);
        let cone = Cone::new(parameters);
        self.visit(obstacles, low, high, |chunk, cells| {
            let free = cells & chunk.free;
            let mut seen = 0;
            for row in rows(free) {
                seen |= chunk.seen(row, place, direction, cone);
            }
            for cell in bits(seen & free) {
                let distance_squared = chunk.distance_squared(cell, place);
                let is_outdone = distance_squared == chunk.nearest[cell] && chunk.claimant[cell] <= axis;
                if is_outdone || obstacles.hides(place, chunk.marker(cell)) {
                    continue;
                }
                chunk.nearest[cell] = distance_squared;
                chunk.claimant[cell] = axis;
                chunk.claimed |= 1 << cell;
            }
        });
    }

    /// Finds the claimants of all markers whose claimants have gone: moved on, or died. The buds that have not moved
    /// are those of the time before.
    pub(crate) fn resolve(&mut self, space: &Space, parameters: &ParameterTable, obstacles: &Obstacles) {
        let resolve = |chunk: &mut Chunk| {
            for cell in bits(chunk.claimed) {
                let claimant = chunk.claimant[cell];
                if !space.has_moved(claimant) {
                    continue;
                }
                let marker = chunk.marker(cell);
                let stays = space.bud(claimant).is_some_and(|bud| {
                    let distance_squared = (marker - bud.position).length_squared();
                    distance_squared == chunk.nearest[cell]
                        && Cone::new(parameters.of(claimant))
                            .holds(distance_squared, (marker - bud.position).dot(bud.direction))
                });
                if stays {
                    continue;
                }
                let sees = |axis| {
                    obstacles.is_empty()
                        || space.bud(axis).is_some_and(|bud| !obstacles.hides(bud.position, marker))
                };
                let nearest = space.nearest_perceiving(marker, parameters, sees);
                match nearest {
                    Some((axis, distance_squared)) => {
                        (chunk.nearest[cell], chunk.claimant[cell]) = (distance_squared, axis);
                    }
                    None => {
                        chunk.nearest[cell] = f32::INFINITY;
                        chunk.claimed &= !(1 << cell);
                    }
                }
            }
        };
        self.chunks.all_mut().par_iter_mut().with_min_len(BATCH).for_each(resolve);
    }

    /// Calls `visit` with every claimed marker's claimant, and where it sees the marker from itself, as they were last
    /// resolved.
    pub(crate) fn claims(&self, space: &Space, mut visit: impl FnMut(AxisId, Vec3)) {
        let seen = |chunks: &[Chunk]| {
            let mut seen: Vec<(AxisId, Vec3)> = Vec::with_capacity(8 * chunks.len());
            for chunk in chunks {
                for cell in bits(chunk.claimed) {
                    let axis = chunk.claimant[cell];
                    let bud = space.bud(axis);
                    seen.extend(bud.map(|bud| (axis, chunk.marker(cell) - bud.position)));
                }
            }
            seen
        };
        let batches: Vec<_> = self.chunks.all().par_chunks(BATCH).map(seen).collect();
        batches.into_iter().flatten().for_each(|(axis, offset)| visit(axis, offset));
    }

    /// Calls `visit` with each marker and its claimant where only these buds may claim: those that are nearer do not count.
    pub(crate) fn claims_among(
        &mut self,
        buds: impl Iterator<Item = (AxisId, Bud)>,
        parameters: &ParameterTable,
        obstacles: &Obstacles,
        mut visit: impl FnMut(Vec3, AxisId),
    ) {
        // Each free marker that one of the buds perceives, by its place, with who perceives it.
        let mut perceived: Vec<([u32; 3], f32, AxisId)> = Vec::new();
        for (axis, bud) in buds {
            let cone = Cone::new(parameters.of(axis));
            let (low, high) = reach(bud.position, bud.direction, parameters.of(axis));
            self.visit(obstacles, low, high, |chunk, cells| {
                for marker in bits(cells & chunk.free).map(|cell| chunk.marker(cell)) {
                    let offset = marker - bud.position;
                    let distance_squared = offset.length_squared();
                    if cone.holds(distance_squared, offset.dot(bud.direction))
                        && !obstacles.hides(bud.position, marker)
                    {
                        perceived.push((marker.to_array().map(f32::to_bits), distance_squared, axis));
                    }
                }
            });
        }
        perceived.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        perceived.dedup_by_key(|&mut (place, ..)| place);
        for (place, _, axis) in perceived {
            visit(Vec3::from_array(place.map(f32::from_bits)), axis);
        }
    }

    /// Calls `visit` with every chunk that meets the box from `low` to `high`, and which of its cells do.
    #[inline(always)]
    fn visit(&mut self, obstacles: &Obstacles, low: Vec3, high: Vec3, visit: impl FnMut(&mut Chunk, u64)) {
        let lattice = self.lattice;
        let per_cell = 1.0 / lattice.spacing;
        let make = move |at| Chunk::new(lattice, at, obstacles);
        CellBox::new(low * per_cell, high * per_cell).visit(&mut self.chunks, make, visit);
    }
}

impl Chunk {
    #[cold]
    fn new(lattice: Lattice, at: [i32; 3], obstacles: &Obstacles) -> Self {
        let mut chunk = Self {
            x: [0.0; CELLS],
            y: [0.0; CELLS],
            z: [0.0; CELLS],
            nearest: [f32::INFINITY; CELLS],
            claimant: [AxisId::new(0); CELLS],
            valid: 0,
            free: 0,
            claimed: 0,
        };
        for cell in 0..CELLS {
            let Some(marker) = lattice.marker_in(cell_at(at, cell)) else { continue };
            [chunk.x[cell], chunk.y[cell], chunk.z[cell]] = marker.to_array();
            chunk.valid |= u64::from(marker.y > 0.0 && !obstacles.contains(marker)) << cell;
        }
        chunk.free = chunk.valid;
        chunk
    }

    #[inline(always)]
    fn marker(&self, cell: usize) -> Vec3 {
        Vec3::new(self.x[cell], self.y[cell], self.z[cell])
    }

    #[inline(always)]
    fn distance_squared(&self, cell: usize, place: Vec3) -> f32 {
        (self.marker(cell) - place).length_squared()
    }

    /// Which of the four markers from cell `row` on lie within the square root of `limit`.
    #[inline(always)]
    fn near(&self, row: usize, place: Vec3, limit: f32) -> u64 {
        let [dx, dy, dz] = self.offsets(row, place);
        let squares = dx * dx + dy * dy + dz * dz;
        u64::from(squares.cmple(Vec4::splat(limit)).bitmask()) << row
    }

    /// Which of the four markers from cell `row` on a bud perceives no farther away than their claimants do.
    #[inline(always)]
    fn seen(&self, row: usize, place: Vec3, direction: Vec3, cone: Cone) -> u64 {
        let [dx, dy, dz] = self.offsets(row, place);
        let squares = dx * dx + dy * dy + dz * dz;
        let dots = dx * direction.x + dy * direction.y + dz * direction.z;
        let near = squares.cmple(four(&self.nearest, row).min(Vec4::splat(cone.far_squared)));
        let ahead = (dots * dots.abs()).cmpge(squares * cone.signed_cos_squared);
        u64::from((near & ahead).bitmask()) << row
    }

    /// Offsets of the four markers from cell `row` on, coordinate by coordinate.
    #[inline(always)]
    fn offsets(&self, row: usize, place: Vec3) -> [Vec4; 3] {
        [
            four(&self.x, row) - Vec4::splat(place.x),
            four(&self.y, row) - Vec4::splat(place.y),
            four(&self.z, row) - Vec4::splat(place.z),
        ]
    }
}

/// The four values of the row that begins with a cell.
#[inline(always)]
fn four(values: &[f32; CELLS], row: usize) -> Vec4 {
    Vec4::from_slice(&values[row & (CELLS - 4)..])
}

impl Lattice {
    pub(crate) fn new(seed: u32, parameters: &Parameters) -> Self {
        Self { seed, spacing: spacing(parameters), is_flat: parameters.is_flat }
    }

    /// The marker in a cell, if there is one.
    pub(crate) fn marker_in(&self, cell: [i32; 3]) -> Option<Vec3> {
        let [x, y, z] = cell;
        let draw =
            Draw::new(self.seed, Purpose::Autonomous, (x as u32 & 0xffff) | (z as u32) << 16, y as u32);
        let offset = Vec3::new(draw.unit(0), draw.unit(1), draw.unit(2));
        let marker = (Vec3::new(x as f32, y as f32, z as f32) + offset) * self.spacing;
        if self.is_flat { (z == 0).then_some(marker.with_z(0.0)) } else { Some(marker) }
    }
}

/// Stands for an axis that there is not.
fn nobody() -> AxisId {
    AxisId::new(u32::MAX as usize - 1)
}

/// Edge of a cell: a perception volume then holds `markers_per_bud` markers on average.
fn spacing(parameters: &Parameters) -> f32 {
    let (near, far) = (parameters.occupancy_radius, parameters.perception_radius());
    if parameters.is_flat {
        let area = 0.5 * parameters.perception_angle.to_radians() * (far * far - near * near);
        return (area / parameters.markers_per_bud as f32).sqrt().clamp(SPACING.0, SPACING.1);
    }
    let cap = core::f32::consts::TAU / 3.0 * (1.0 - parameters.cos_half_perception);
    let volume = cap * (far * far * far - near * near * near);
    libm::cbrtf(volume / parameters.markers_per_bud as f32).clamp(SPACING.0, SPACING.1)
}

/// The box around the perception volume of a bud and the zone before it.
fn reach(place: Vec3, direction: Vec3, parameters: &Parameters) -> (Vec3, Vec3) {
    let cos = parameters.cos_half_perception;
    let far = parameters.perception_radius();
    let mut reach = [[0.0; 2]; 3];
    for (reach, along) in reach.iter_mut().zip(direction.to_array()) {
        // Sines of the angles that the axis of coordinates makes with the cone's own, and half its opening.
        let across = ((1.0 - along * along) * (1.0 - cos * cos)).max(0.0).sqrt();
        // How far the unit cone reaches both ways along an axis with which its own makes an angle of this cosine.
        let extent = |along: f32| if along >= cos { 1.0 } else { (along * cos + across).max(0.0) };
        *reach = [extent(-along), extent(along)];
    }
    let [low, high] = [0, 1].map(|end| Vec3::from_array(reach.map(|reach| reach[end])) * far);
    // A hair wider, against rounding.
    let margin = Vec3::splat(1e-3);
    (place - low - margin, place + high + margin)
}

/// The first cells of those rows of four in which some bit is set.
#[inline(always)]
fn rows(word: u64) -> impl Iterator<Item = usize> {
    let any = word | word >> 1;
    bits((any | any >> 2) & 0x1111_1111_1111_1111)
}
