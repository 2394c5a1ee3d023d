//! The field of markers that fills all space for growth without guidance (TreeSketch §3.2, "Competition for
//! space").
//!
//! One marker lies in each cell of a lattice, anywhere in it; the cells are as wide as makes a bud perceive
//! `markers_per_bud` of them. Which bud is nearest to each free marker is kept up as nodes and buds come and go,
//! so a step costs what has changed, not what there is. The field holds nothing that could not be made afresh
//! from the nodes and the buds.

mod chunk;

use espalier_plant::{AxisId, reserve};
use glam::{Vec3, Vec4};

use self::chunk::{Chunk, Seeker, Status, TAKEN};
use crate::{
    cells::{CellBox, bits},
    claims::Sighting,
    directory::Directory,
    obstacles::Obstacles,
    parameter_table::ParameterTable,
    parameters::Parameters,
    random::{Draw, Purpose},
    side_by_side::Work,
    space::{Bud, Cone, Space},
};

/// The finest and the coarsest lattice, in internodes: beyond them parameters would ask for millions of markers
/// or for none.
const SPACING: (f32, f32) = (0.5, 8.0);
/// Chunks that one thread goes through at a time.
const BATCH: usize = 64;

/// Chunks of markers whose claimants are found.
static RESOLVING: Work = Work::new(512);

/// The markers of the lattice, as far as nodes and buds have touched it.
#[derive(Clone, Debug)]
pub(crate) struct MarkerField {
    lattice: Lattice,
    statuses: Directory<Status>,
    /// One for each status.
    chunks: Vec<Chunk>,
}

/// Where markers lie: one in each cell, or, for plants that grow in the plane z = 0, one in each cell of that plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    seed: u32,
    /// Edge of a cell.
    pub(crate) spacing: f32,
    is_flat: bool,
}

impl MarkerField {
    /// A field that nothing has touched.
    pub(crate) fn new(seed: u32, parameters: &Parameters) -> Self {
        Self { lattice: Lattice::new(seed, parameters), statuses: Directory::new(), chunks: Vec::new() }
    }

    /// A node takes the markers in its zone; its buds claim of the others what they perceive and no bud is nearer to.
    pub(crate) fn settle(
        &mut self,
        node: Vec3,
        buds: &[(AxisId, Bud)],
        parameters: &ParameterTable,
        obstacles: &Obstacles,
    ) {
        match *buds {
            [] => self.settle_with(node, [], parameters, obstacles),
            [one] => self.settle_with(node, [one], parameters, obstacles),
            [one, two, ref rest @ ..] => {
                self.settle_with(node, [one, two], parameters, obstacles);
                if !rest.is_empty() {
                    self.settle(node, rest, parameters, obstacles);
                }
            }
        }
    }

    fn settle_with<const BUDS: usize>(
        &mut self,
        node: Vec3,
        buds: [(AxisId, Bud); BUDS],
        parameters: &ParameterTable,
        obstacles: &Obstacles,
    ) {
        let radius = parameters.scene().occupancy_radius;
        let (mut low, mut high) = (node - radius, node + radius);
        let seekers = buds.map(|(axis, bud)| {
            let reach = reach(bud, parameters.of(axis));
            (low, high) = (low.min(reach.0), high.max(reach.1));
            Seeker { axis, direction: bud.direction, cone: Cone::new(parameters.of(axis)) }
        });
        self.visit(obstacles, low, high, |chunk, status, cells| {
            chunk.settle(status, cells, node, radius * radius, &seekers, obstacles);
        });
    }

    /// A node gives the markers back that lie in no other's zone.
    pub(crate) fn vacate(&mut self, place: Vec3, radius: f32, space: &Space, obstacles: &Obstacles) {
        self.visit(obstacles, place - radius, place + radius, |chunk, status, cells| {
            for cell in bits(cells & chunk.valid & !status.free) {
                let marker = chunk.marker(cell);
                let near = (marker - place).length_squared() <= radius * radius;
                if near && !space.is_occupied(marker, radius, |_| true) {
                    // Who claims it is unknown: until that is found, nobody else does.
                    status.free |= 1 << cell;
                    status.claimed |= 1 << cell;
                    chunk.set_claim(cell, (nobody(), TAKEN));
                }
            }
        });
    }

    /// Finds the claimants of all markers whose claimants have gone: moved on, or died. The buds that have not moved
    /// are those of the time before. Returns in batches every claimed marker's claimant, and where it sees the marker.
    pub(crate) fn resolve(
        &mut self,
        space: &Space,
        parameters: &ParameterTable,
        obstacles: &Obstacles,
    ) -> Vec<Vec<Sighting>> {
        let resolve = |(statuses, chunks): (&mut [Status], &mut [Chunk])| {
            let mut seen = Vec::new();
            for (status, chunk) in statuses.iter_mut().zip(chunks).filter(|(status, _)| status.claimed != 0) {
                chunk.resolve(status, space, parameters, obstacles, |axis, offset| seen.push((axis, offset)));
            }
            seen
        };
        let batches = self.statuses.all_mut().chunks_mut(BATCH).zip(self.chunks.chunks_mut(BATCH));
        RESOLVING.each(batches.len() * BATCH, batches, resolve)
    }

    /// Each claimant, and where it sees its marker, where only these buds may claim: those that are nearer do not count.
    pub(crate) fn claims_among(
        &mut self,
        buds: impl Iterator<Item = (AxisId, Bud)>,
        parameters: &ParameterTable,
        obstacles: &Obstacles,
    ) -> Vec<Sighting> {
        // Each free marker that one of the buds perceives, by its place, with who perceives it, and where.
        let mut perceived: Vec<([u32; 3], f32, Sighting)> = Vec::new();
        for (axis, bud) in buds {
            let cone = Cone::new(parameters.of(axis));
            let (low, high) = reach(bud, parameters.of(axis));
            self.visit(obstacles, low, high, |chunk, status, cells| {
                for marker in bits(cells & status.free).map(|cell| chunk.marker(cell)) {
                    let offset = marker - bud.position;
                    let distance_squared = offset.length_squared();
                    if cone.holds(distance_squared, offset.dot(bud.direction))
                        && !obstacles.hides(bud.position, marker)
                    {
                        perceived.push((
                            marker.to_array().map(f32::to_bits),
                            distance_squared,
                            (axis, offset),
                        ));
                    }
                }
            });
        }
        perceived.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.0.cmp(&b.2.0)));
        perceived.dedup_by_key(|&mut (place, ..)| place);
        perceived.into_iter().map(|(.., seen)| seen).collect()
    }

    /// Calls `visit` with every chunk that meets the box from `low` to `high`, its status, and which of its cells do.
    #[inline(always)]
    fn visit(
        &mut self,
        obstacles: &Obstacles,
        low: Vec3,
        high: Vec3,
        mut visit: impl FnMut(&mut Chunk, &mut Status, u64),
    ) {
        let Self { lattice, statuses, chunks } = self;
        let per_cell = 1.0 / lattice.spacing;
        CellBox::new(low * per_cell, high * per_cell).visit(
            statuses,
            |_| Status::default(),
            |status, word| {
                if word.number >= chunks.len() {
                    let chunk = Chunk::new(*lattice, word.at, obstacles);
                    status.free = chunk.valid;
                    reserve(chunks, 1);
                    chunks.push(chunk);
                }
                visit(&mut chunks[word.number], status, word.cells);
            },
        );
    }
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
fn reach(bud: Bud, parameters: &Parameters) -> (Vec3, Vec3) {
    let (cos, far) = (Vec4::splat(parameters.cos_half_perception), parameters.perception_radius());
    let along = bud.direction.extend(0.0);
    // Sines of the angles that the axes of coordinates make with the cone's own, and half its opening.
    let across = ((1.0 - along * along) * (1.0 - cos * cos)).max(Vec4::ZERO).to_array().map(f32::sqrt);
    // How far the unit cone reaches both ways along axes with which its own makes angles of these cosines.
    let extent = |along: Vec4| {
        let beside = (along * cos + Vec4::from_array(across)).max(Vec4::ZERO);
        Vec4::select(along.cmpge(cos), Vec4::ONE, beside).truncate()
    };
    // A hair wider, against rounding.
    let margin = Vec3::splat(1e-3);
    let (low, high) = (extent(-along) * far + margin, extent(along) * far + margin);
    (bud.position - low, bud.position + high)
}
