//! Light by shadow propagation (Pałubicki et al. 2009 §4.1; TreeSketch §3.2, Figure 4).
//!
//! Every metamer darkens its own voxel by `a` and a pyramid below it by `a·b^-q` at depth q. Shadows are kept
//! as whole numbers, so that taking one back leaves exactly what was there before. A voxel is two internodes
//! wide: shadows are smoother than that, and eight times fewer voxels are eight times less to write and to hold.

mod casting;
mod reading;

use glam::Vec3;

pub(crate) use reading::Spot;

use casting::{PyramidRow, pyramid};

use crate::{
    directory::{self, Directory},
    parameters::Parameters,
};

/// Edge of a voxel, in internodes: as coarse as shadows, which are a pyramid's, let it be.
const VOXEL: f32 = 2.0;
/// Fixed-point steps of one unit of light.
const UNIT: f32 = 65536.0;

/// Voxels in a chunk: along x, and along each of z and y.
const WIDTH_BITS: i32 = 5;
const DEPTH_BITS: i32 = 4;
const WIDTH: i32 = 1 << WIDTH_BITS;
const DEPTH: i32 = 1 << DEPTH_BITS;
/// By how many voxels those of the first chunk begin before the origin.
const SHIFT: [i32; 3] = [WIDTH / 2, DEPTH / 4, DEPTH / 2];
/// Voxels a row of a pyramid is padded to.
const ROW: usize = 8;
/// Values in a layer of a chunk, rows along z: a few more than voxels, or columns would crowd one corner of the
/// cache.
const PLANE: usize = (WIDTH * DEPTH) as usize + ROW;
const VALUES: usize = PLANE * DEPTH as usize;
type Chunk = [u32; VALUES];
/// Stands for the place of a value that there is not.
const NOWHERE: u32 = u32::MAX;

/// The shadows of all metamers.
#[derive(Clone, Debug)]
pub struct ShadowGrid {
    chunks: Directory<Chunk>,
    /// Where each chunk's own values and those of its seven neighbours towards greater coordinates begin, x fastest,
    /// then z, then y; [`NOWHERE`] for those that do not exist.
    octants: Vec<[u32; 8]>,
    /// Shadow at each depth below a metamer.
    strength: Vec<u32>,
    /// The same of a metamer in its own voxel and in those of the layer below.
    first: f32,
    second: f32,
    /// The pyramid below a metamer, row by row along x.
    rows: Vec<PyramidRow>,
}

impl ShadowGrid {
    /// No shadows yet.
    pub fn new(parameters: &Parameters) -> Self {
        let strength: Vec<u32> =
            strengths(parameters).into_iter().map(|shadow| libm::roundf(shadow * UNIT) as u32).collect();
        let rows = pyramid(&strength);
        let (first, second) = (strength[0] as f32, strength.get(1).map_or(0.0, |&shadow| shadow as f32));
        Self { chunks: Directory::new(), octants: Vec::new(), strength, first, second, rows }
    }

    /// The number of the chunk at these coordinates, made if there was none.
    #[inline(always)]
    fn number_or_make(&mut self, at: [i32; 3]) -> usize {
        let number = self.chunks.number_or_make(at, || [0; VALUES]) as usize;
        if number == self.octants.len() {
            self.introduce(number, at);
        }
        number
    }

    /// Makes a new chunk and its neighbours known to each other.
    #[cold]
    fn introduce(&mut self, number: usize, [x, y, z]: [i32; 3]) {
        let place = |chunk: u32| chunk * VALUES as u32;
        self.octants.push([NOWHERE; 8]);
        for octant in 0..8 {
            let (dx, dy, dz) = (octant & 1, octant >> 2, octant >> 1 & 1);
            if let Some(chunk) = self.chunks.number([x + dx, y + dy, z + dz]) {
                self.octants[number][octant as usize] = place(chunk);
            }
            if let Some(chunk) = self.chunks.number([x - dx, y - dy, z - dz]) {
                self.octants[chunk as usize][octant as usize] = place(number as u32);
            }
        }
    }

    /// The box of the places at which the shadow of a metamer with its node at `position` is seen.
    pub(crate) fn reach(&self, position: Vec3) -> (Vec3, Vec3) {
        // Shadows are interpolated: they are seen half a voxel beyond those they darken.
        let reach = (self.strength.len() as f32 + 0.5) * VOXEL;
        (position - reach, position + Vec3::new(reach, 1.5 * VOXEL, reach))
    }

    /// The shadow in one voxel.
    fn shadow(&self, voxel: [i32; 3]) -> u32 {
        self.chunks.get(chunk_of(voxel)).map_or(0, |chunk| chunk[offset(voxel)])
    }
}

/// The voxel a point lies in, counted so that the axis of a tree at the origin runs amid a chunk, which begins as far
/// below the ground as shadows reach there: a small tree then has one chunk.
#[inline]
fn voxel_of(place: Vec3) -> [i32; 3] {
    let [x, y, z] = directory::voxel_of(place * (1.0 / VOXEL));
    [x + SHIFT[0], y + SHIFT[1], z + SHIFT[2]]
}

#[inline]
fn chunk_of([x, y, z]: [i32; 3]) -> [i32; 3] {
    [x >> WIDTH_BITS, y >> DEPTH_BITS, z >> DEPTH_BITS]
}

#[inline]
fn offset([x, y, z]: [i32; 3]) -> usize {
    let (y, z) = ((y & (DEPTH - 1)) as usize, (z & (DEPTH - 1)) as usize);
    y * PLANE + (z << WIDTH_BITS) + (x & (WIDTH - 1)) as usize
}

/// The shadow of a metamer in its own voxel and in each layer below.
///
/// `a` and `b` speak of voxels of one internode, `q_max` of internodes. In larger voxels a shadow fades as fast
/// with height and is as much in all: so many times smaller voxels as a layer holds, each in its own shade.
fn strengths(parameters: &Parameters) -> Vec<f32> {
    let (depth, decay) = (parameters.shadow_depth as i32, parameters.shadow_decay);
    let area = |depth: i32| (-depth..=depth).map(|z| 2 * half_width(depth, z) + 1).sum::<i32>() as f32;
    let fade = |decay: f32, layer: i32| libm::powf(decay, -(layer as f32));
    let layers = (depth as f32 / VOXEL) as i32 + i32::from(depth % VOXEL as i32 > 0);
    let wanted: f32 = (0..=depth).map(|layer| area(layer) * fade(decay, layer)).sum();
    let decay = libm::powf(decay, VOXEL);
    let held: f32 =
        (0..=layers).map(|layer| area(layer) * fade(decay, layer)).sum::<f32>() * VOXEL * VOXEL * VOXEL;
    (0..=layers).map(|layer| parameters.shadow_strength * wanted / held * fade(decay, layer)).collect()
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
    use espalier_settings::ParameterValues;

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
        assert!(shadow_at(25.0).abs() < 1e-4, "nothing above");
        assert!(shadow_at(19.0) > shadow_at(17.0) && shadow_at(17.0) > shadow_at(15.0));
        assert!(shadow_at(15.0) > 0.0 && shadow_at(10.0).abs() < 1e-4, "nothing beyond the depth");
    }

    #[test]
    fn a_shadow_is_as_much_as_in_small_voxels() {
        let parameters = Parameters::default();
        let cells = |depth: i32| (-depth..=depth).map(|z| 2 * half_width(depth, z) + 1).sum::<i32>() as f32;
        let small: f32 = (0..=6).map(|q| 0.12 * cells(q) * libm::powf(0.5, q as f32)).sum();
        let large: f32 =
            strengths(&parameters).iter().zip(0..).map(|(s, layer)| 8.0 * s * cells(layer)).sum();
        assert!((small - large).abs() < 1e-3, "{small} and {large}");
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
            casters in prop::collection::vec(((-90f32..90.0, 0f32..40.0, -20f32..20.0), 1usize..5), 1..12),
            near in (-8i32..=8, -9i32..2, -8i32..=8),
            depth in 0u32..=8,
        ) {
            let mut grid = with_depth(depth);
            // Some of them where the one before is.
            let casters: Vec<Vec3> =
                casters.into_iter().flat_map(|(at, times)| vec![Vec3::from(at); times]).collect();
            grid.cast_all(casters.iter().copied());
            for caster in &casters {
                let [x, y, z] = voxel_of(*caster);
                let voxel = [x + near.0, y + near.1, z + near.2];
                prop_assert_eq!(grid.shadow(voxel), shadow_by_definition(&grid, &casters, voxel));
                let corner = Vec3::from_array(core::array::from_fn(|axis| (voxel[axis] - SHIFT[axis]) as f32));
                let place = (corner + 0.75) * VOXEL;
                let spot = grid.spot(place);
                let octet = grid.octet_around(reading::least_voxel(place));
                prop_assert_eq!(grid.exposure_at(&spot, || place), grid.exposure(place));
                for (i, shadow) in (0..).zip(octet) {
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
