//! Light by shadow propagation (Pałubicki et al. 2009 §4.1; TreeSketch §3.2, Figure 4).
//!
//! Every metamer darkens its own voxel by `a` and a pyramid below it by `a·b^-q` at depth q. Shadows are kept
//! as whole numbers, so that taking one back leaves exactly what was there before.

use glam::Vec3;

use crate::{
    directory::{self, Directory},
    parameters::Parameters,
};

/// Fixed-point steps of one unit of light.
const UNIT: f32 = 65536.0;

/// Voxels in a chunk: along x, and along each of z and y.
const WIDTH_BITS: i32 = 6;
const DEPTH_BITS: i32 = 4;
const WIDTH: i32 = 1 << WIDTH_BITS;
const DEPTH: i32 = 1 << DEPTH_BITS;
/// Voxels a row of a pyramid is padded to, and the one that its axis goes through.
const ROW: usize = 16;
const MIDDLE: i32 = 8;
/// Values in a row of a chunk: its voxels between two margins. Rows of pyramids that reach into the next chunk
/// write into the margin, which nobody reads, and are written once more to the chunk they belong to.
const STRIDE: usize = WIDTH as usize + 2 * ROW;
/// Rows follow each other along z, then along y.
const VALUES: usize = STRIDE * (DEPTH * DEPTH) as usize;
type Chunk = [u32; VALUES];

/// Rows of this depth still fit, and pyramids of this depth meet no more than two chunks along y and along z.
const FITTING_DEPTH: i32 = 7;

/// The shadows of all metamers.
#[derive(Clone, Debug)]
pub struct ShadowGrid {
    chunks: Directory<Chunk>,
    /// Shadow at each depth below a metamer.
    strength: Vec<u32>,
    /// The pyramid below a metamer, row by row along x.
    rows: Vec<PyramidRow>,
}

/// One row of a pyramid.
#[derive(Clone, Copy, Debug)]
struct PyramidRow {
    /// How far below the metamer.
    depth: i32,
    /// How far beside it along z.
    z: i32,
    /// Half its width along x.
    half: i32,
    /// What it adds to the voxels around the metamer's own x.
    shadows: [u32; ROW],
}

impl ShadowGrid {
    /// No shadows yet.
    pub fn new(parameters: &Parameters) -> Self {
        let depth = parameters.shadow_depth;
        let mut fade = 1.0;
        let strength: Vec<u32> = (0..=depth)
            .map(|_| {
                let shadow = libm::roundf(parameters.shadow_strength * fade * UNIT) as u32;
                fade /= parameters.shadow_decay;
                shadow
            })
            .collect();
        let mut rows = Vec::new();
        for (depth, &shadow) in strength.iter().enumerate() {
            let depth = depth as i32;
            for z in -depth..=depth {
                let half = half_width(depth, z);
                let add = |lane: usize| if (lane as i32 - MIDDLE).abs() <= half { shadow } else { 0 };
                rows.push(PyramidRow { depth, z, half, shadows: core::array::from_fn(add) });
            }
        }
        Self { chunks: Directory::new(), strength, rows }
    }

    /// Adds the shadow of a metamer with its node at `position`.
    pub fn cast(&mut self, position: Vec3) {
        self.spread(position, u32::wrapping_add);
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
        let bases = self.bases_of(left, y, z);
        let reach = self.strength.len() as i32 - 1;
        // Where the next chunk along z begins, as seen from the metamer.
        let seam = ((((z - reach) >> DEPTH_BITS) + 1) << DEPTH_BITS) - z;
        let voxels = self.chunks.all_mut().as_flattened_mut();
        for depth in 0..=reach {
            let at_y = y - depth;
            let layer = &self.rows[(depth * depth) as usize..][..2 * depth as usize + 1];
            let (near, far) = layer.split_at((seam + depth).clamp(0, 2 * depth + 1) as usize);
            let bases = &bases[((at_y >> DEPTH_BITS) - ((y - reach) >> DEPTH_BITS)) as usize & 1];
            for (rows, base) in [near, far].into_iter().zip(bases) {
                let Some(first) = rows.first() else { continue };
                let offset = offset([0, at_y, z + first.z]) + within;
                // In the chunk to the right the same row begins left of its first voxel.
                let parts = [base[0] + offset, (base[1] + offset).wrapping_sub(WIDTH as usize)];
                for &part in &parts[..if within + ROW > WIDTH as usize { 2 } else { 1 }] {
                    let mut at = part;
                    for row in rows {
                        let values = voxels.get_mut(at..).and_then(|voxels| voxels.first_chunk_mut::<ROW>());
                        if let Some(values) = values {
                            // Copies, so that all sixteen can be added at once.
                            let (old, shadows) = (*values, row.shadows);
                            *values = core::array::from_fn(|lane| change(old[lane], shadows[lane]));
                        }
                        at += STRIDE;
                    }
                }
            }
        }
    }

    /// Where the chunks begin that a pyramid meets, two along y and two along z, and each one's neighbour along x
    /// if a row that starts at `left` reaches it.
    #[inline(always)]
    fn bases_of(&mut self, left: i32, y: i32, z: i32) -> [[[usize; 2]; 2]; 2] {
        let reach = self.strength.len() as i32 - 1;
        let (low_y, low_z) = ((y - reach) >> DEPTH_BITS, (z - reach) >> DEPTH_BITS);
        let (first, last) = (left >> WIDTH_BITS, (left + ROW as i32 - 1) >> WIDTH_BITS);
        let mut bases = [[[0; 2]; 2]; 2];
        for (i, base) in bases.as_flattened_mut().iter_mut().enumerate() {
            let (at_y, at_z) = (low_y + (i as i32 >> 1), low_z + (i as i32 & 1));
            if at_y <= y >> DEPTH_BITS && at_z <= (z + reach) >> DEPTH_BITS {
                for chunk_x in first..=last {
                    let chunk = self.chunks.number_or_make([chunk_x, at_y, at_z], || [0; VALUES]);
                    base[(chunk_x - first) as usize] = chunk as usize * VALUES;
                }
            }
        }
        bases
    }

    /// The same for pyramids whose rows do not fit into sixteen voxels.
    #[cold]
    fn spread_deep(&mut self, position: Vec3, change: impl Fn(u32, u32) -> u32) {
        let [x, y, z] = voxel_of(position);
        for row in &self.rows {
            let shadow = self.strength[row.depth as usize];
            for at_x in x - row.half..=x + row.half {
                let voxel = [at_x, y - row.depth, z + row.z];
                let value = &mut self.chunks.get_or_make(chunk_of(voxel), || [0; VALUES])[offset(voxel)];
                *value = change(*value, shadow);
            }
        }
    }

    /// The box of the places at which the shadow of a metamer with its node at `position` is seen.
    pub(crate) fn reach(&self, position: Vec3) -> (Vec3, Vec3) {
        // Shadows are interpolated: they are seen half a voxel beyond those they darken.
        let reach = self.strength.len() as f32 + 0.5;
        (position - reach, position + Vec3::new(reach, 1.5, reach))
    }

    /// Light at a place, 0 to 1, as if the metamer whose node is there cast no shadow.
    pub fn exposure(&self, position: Vec3) -> f32 {
        self.exposure_at(&self.spot(position))
    }

    /// How to read the light at a place again and again.
    pub(crate) fn spot(&self, position: Vec3) -> Spot {
        let low = voxel_of(position - 0.5);
        let [x, y, z] = low;
        let corner = directory::voxel_of(position - 0.5).map(|i| i as f32);
        let f = position - 0.5 - Vec3::from_array(corner);
        let own = voxel_of(position);
        // The metamer's own shadow reaches the corners in its own voxel and those in the layer below.
        let share = |own: i32, base: i32, f: f32| if own == base { 1.0 - f } else { f };
        let at_own_height = share(own[1], y, f.y);
        let in_own_column = share(own[0], x, f.x) * share(own[2], z, f.z);
        let below = if own[1] == y { 0.0 } else { 1.0 - f.y };
        let first = self.strength[0] as f32 * at_own_height * in_own_column;
        let second = self.strength.get(1).map_or(0.0, |&s| s as f32) * below;
        let is_within =
            x & (WIDTH - 1) != WIDTH - 1 && y & (DEPTH - 1) != DEPTH - 1 && z & (DEPTH - 1) != DEPTH - 1;
        let chunk = self.chunks.number(chunk_of(low)).filter(|_| is_within);
        Spot {
            at: chunk.map_or(Spot::SCATTERED, |chunk| chunk * VALUES as u32 + offset(low) as u32),
            low: [x as i16, y as i16, z as i16],
            fraction: f,
            own: first + second,
        }
    }

    /// Light at a place, 0 to 1.
    ///
    /// Shadows are interpolated between voxel centres; read at one voxel they would come in blocks.
    #[inline]
    pub(crate) fn exposure_at(&self, spot: &Spot) -> f32 {
        let octet = self.octet(spot);
        let f = spot.fraction;
        let mut s = [0.0; 8];
        for (s, shadow) in s.iter_mut().zip(octet) {
            // What is darker than dark by far reads the same; as a signed number it converts faster.
            *s = shadow as i32 as f32;
        }
        let along_x = |i: usize| s[i] * (1.0 - f.x) + s[i + 1] * f.x;
        let along_z = |i: usize| along_x(i) * (1.0 - f.z) + along_x(i + 2) * f.z;
        let shadow = along_z(0) * (1.0 - f.y) + along_z(4) * f.y;
        (1.0 - (shadow - spot.own) / UNIT).clamp(0.0, 1.0)
    }

    /// The direction towards more light at a place, −∇s by central differences over one voxel (Pałubicki et
    /// al. 2009 §4.1); none where shadows are even.
    pub fn towards_light(&self, position: Vec3) -> Option<Vec3> {
        let [x, y, z] = voxel_of(position);
        let difference = |low: [i32; 3], high: [i32; 3]| self.shadow(low) as f32 - self.shadow(high) as f32;
        let gradient = Vec3::new(
            difference([x - 1, y, z], [x + 1, y, z]),
            difference([x, y - 1, z], [x, y + 1, z]),
            difference([x, y, z - 1], [x, y, z + 1]),
        );
        (gradient * (1.0 / UNIT)).try_normalize()
    }

    /// The shadow in one voxel.
    fn shadow(&self, voxel: [i32; 3]) -> u32 {
        self.chunks.get(chunk_of(voxel)).map_or(0, |chunk| chunk[offset(voxel)])
    }

    /// Shadows in the eight voxels around a spot, x fastest, then z, then y.
    #[inline]
    fn octet(&self, spot: &Spot) -> [u32; 8] {
        if spot.at == Spot::SCATTERED {
            return self.scattered_octet(spot.low.map(i32::from));
        }
        const UP: usize = STRIDE * DEPTH as usize;
        let Some(values) =
            self.chunks.all().as_flattened()[spot.at as usize..].first_chunk::<{ UP + STRIDE + 2 }>()
        else {
            return [0; 8];
        };
        [0, 1, STRIDE, STRIDE + 1, UP, UP + 1, UP + STRIDE, UP + STRIDE + 1].map(|step| values[step])
    }

    /// The same where the eight lie in several chunks.
    #[cold]
    fn scattered_octet(&self, [x, y, z]: [i32; 3]) -> [u32; 8] {
        let mut octet = [0; 8];
        for (i, pair) in octet.chunks_exact_mut(2).enumerate() {
            let (y, z) = (y + (i as i32 >> 1), z + (i as i32 & 1));
            let Some(chunk) = self.chunks.get(chunk_of([x, y, z])) else { continue };
            let at = offset([x, y, z]);
            pair[0] = chunk[at];
            pair[1] = if x & (WIDTH - 1) == WIDTH - 1 { self.shadow([x + 1, y, z]) } else { chunk[at + 1] };
        }
        octet
    }
}

/// A place whose light is read often: where its voxels are, and what is known beforehand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Where the least of its eight voxels stands among all chunks' values; or [`Spot::SCATTERED`].
    at: u32,
    /// The least of its eight voxels.
    low: [i16; 3],
    /// Where it lies between the centres of the eight.
    fraction: Vec3,
    /// The shadow of its own metamer.
    own: f32,
}

impl Spot {
    /// The eight voxels are not in one chunk.
    const SCATTERED: u32 = u32::MAX;
}

/// The voxel a point lies in, counted so that the axis of a tree at the origin runs amid a chunk.
#[inline]
fn voxel_of(place: Vec3) -> [i32; 3] {
    let [x, y, z] = directory::voxel_of(place);
    [x + WIDTH / 2, y, z + DEPTH / 2]
}

#[inline]
fn chunk_of([x, y, z]: [i32; 3]) -> [i32; 3] {
    [x >> WIDTH_BITS, y >> DEPTH_BITS, z >> DEPTH_BITS]
}

#[inline]
fn offset([x, y, z]: [i32; 3]) -> usize {
    let row = (y & (DEPTH - 1)) << DEPTH_BITS | (z & (DEPTH - 1));
    row as usize * STRIDE + ROW + (x & (WIDTH - 1)) as usize
}

/// Half the width along x of a layer's row at `z`. A layer is a disc of radius q + ½ voxels: square layers would
/// give square crowns.
fn half_width(depth: i32, z: i32) -> i32 {
    let radius = depth as f32 + 0.5;
    let room = radius * radius - (z * z) as f32;
    (0..=depth).rev().find(|x| (x * x) as f32 <= room).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::ParameterValues;
    use proptest::prelude::*;

    fn grid() -> ShadowGrid {
        ShadowGrid::new(&Parameters::default())
    }

    fn with_depth(depth: u32) -> ShadowGrid {
        let values = ParameterValues { shadow_depth: depth, ..ParameterValues::default() };
        ShadowGrid::new(&Parameters::new(values).expect("in range"))
    }

    /// The definition, voxel by voxel.
    fn shadow_by_definition(grid: &ShadowGrid, casters: &[Vec3], [x, y, z]: [i32; 3]) -> u32 {
        let one = |caster: &Vec3| {
            let [cx, cy, cz] = voxel_of(*caster);
            let (q, dx, dz) = (cy - y, cx - x, cz - z);
            let radius = q as f32 + 0.5;
            let lies_within = q >= 0 && ((dx * dx + dz * dz) as f32) <= radius * radius;
            if lies_within { grid.strength.get(q as usize).copied().unwrap_or(0) } else { 0 }
        };
        casters.iter().map(one).sum()
    }

    #[test]
    fn a_metamer_does_not_shade_itself() {
        for at in [Vec3::new(0.5, 9.5, 0.5), Vec3::new(0.1, 9.9, 0.7), Vec3::new(-3.3, 9.2, 4.8)] {
            let mut grid = grid();
            grid.cast(at);
            assert!((grid.exposure(at) - 1.0).abs() < 1e-4, "{at}: {}", grid.exposure(at));
        }
    }

    #[test]
    fn shade_falls_below_and_fades() {
        let shadow_at = |y: f32| {
            let mut grid = grid();
            grid.cast(Vec3::new(0.5, 20.5, 0.5));
            let reader = Vec3::new(0.5, y, 0.5);
            grid.cast(reader);
            1.0 - grid.exposure(reader)
        };
        assert!(shadow_at(22.5).abs() < 1e-4, "nothing above");
        assert!((shadow_at(19.5) - 0.06).abs() < 1e-3, "a/b one voxel below");
        assert!(shadow_at(18.5) < shadow_at(19.5) && shadow_at(16.5) < shadow_at(18.5));
        assert!(shadow_at(12.5).abs() < 1e-4, "nothing beyond the depth");
    }

    #[test]
    fn light_comes_from_beside_a_shadow() {
        let mut grid = grid();
        grid.cast(Vec3::new(0.5, 10.5, 0.5));
        let towards = grid.towards_light(Vec3::new(2.5, 9.5, 0.5)).expect("there is a shadow");
        assert!(towards.x > 0.8, "{towards}");
        assert_eq!(grid.towards_light(Vec3::splat(40.0)), None);
    }

    proptest! {
        #[test]
        fn casts_add_up_as_defined(
            casters in prop::collection::vec((-90f32..90.0, 0f32..40.0, -20f32..20.0), 1..12),
            near in (-8i32..=8, -9i32..2, -8i32..=8),
            depth in 0u32..=8,
        ) {
            let mut grid = with_depth(depth);
            let casters: Vec<Vec3> = casters.into_iter().map(Vec3::from).collect();
            casters.iter().for_each(|&p| grid.cast(p));
            for caster in &casters {
                let [x, y, z] = voxel_of(*caster);
                let voxel = [x + near.0, y + near.1, z + near.2];
                prop_assert_eq!(grid.shadow(voxel), shadow_by_definition(&grid, &casters, voxel));
                let corner = Vec3::new((voxel[0] - WIDTH / 2) as f32, voxel[1] as f32, (voxel[2] - DEPTH / 2) as f32);
                let spot = grid.spot(corner + 0.75);
                prop_assert_eq!(grid.octet(&spot), grid.scattered_octet(voxel));
                for (i, shadow) in (0..).zip(grid.octet(&spot)) {
                    let corner = [voxel[0] + (i & 1), voxel[1] + (i >> 2), voxel[2] + (i >> 1 & 1)];
                    prop_assert_eq!(shadow, grid.shadow(corner));
                }
            }
        }

        #[test]
        fn uncast_leaves_no_trace(places in prop::collection::vec((-40f32..40.0, 0f32..60.0, -40f32..40.0), 1..60)) {
            let mut grid = grid();
            let places: Vec<Vec3> = places.into_iter().map(Vec3::from).collect();
            places.iter().for_each(|&p| grid.cast(p));
            places.iter().rev().for_each(|&p| grid.uncast(p));
            prop_assert!(grid.chunks.all().iter().all(|chunk| chunk.iter().all(|&v| v == 0)));
        }
    }
}
