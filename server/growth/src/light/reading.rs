//! Reading light: shadows between the centres of the eight voxels around a place.
//!
//! Read at one voxel, shadows would come in blocks.

use glam::{Vec3, Vec4};

use super::{
    DEPTH, DEPTH_BITS, NOWHERE, PLANE, ShadowGrid, UNIT, VALUES, VOXEL, WIDTH, WIDTH_BITS, chunk_of, offset,
    voxel_of,
};
use crate::directory;

/// A place whose light is read often: where its voxels are, and how it lies between them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Where the least of its eight voxels stands among all chunks' values, with [`Spot::SPLIT`] if they lie in
    /// several; [`NOWHERE`] if the least had no chunk yet. The lower half comes first: a number of four bytes would
    /// have the spot rounded up to twelve.
    at: [u16; 2],
    /// Where it lies between the centres of the eight, in steps of 1/[`Spot::STEPS`].
    fraction: [u16; 3],
}

impl Spot {
    const SPLIT: u32 = 1 << 31;
    const STEPS: f32 = 32768.0;

    fn at(&self) -> u32 {
        u32::from(self.at[0]) | u32::from(self.at[1]) << 16
    }
}

impl ShadowGrid {
    /// Light at a place, 0 to 1, as if the metamer whose node is there cast no shadow.
    pub fn exposure(&self, position: Vec3) -> f32 {
        self.exposure_in(Octet::new(self.octet_around(least_voxel(position))), fraction(position))
    }

    /// How to read the light at a place again and again.
    pub(crate) fn spot(&self, position: Vec3) -> Spot {
        let low = least_voxel(position);
        let is_split = low[0] & (WIDTH - 1) == WIDTH - 1
            || low[1] & (DEPTH - 1) == DEPTH - 1
            || low[2] & (DEPTH - 1) == DEPTH - 1;
        let at = self.chunks.number(chunk_of(low)).map_or(NOWHERE, |chunk| {
            let at = chunk * VALUES as u32 + offset(low) as u32;
            if is_split { at | Spot::SPLIT } else { at }
        });
        Spot { at: [at as u16, (at >> 16) as u16], fraction: fraction(position) }
    }

    /// Light at a place with this spot, 0 to 1, as if the metamer whose node is there cast no shadow.
    #[inline(always)]
    pub(crate) fn exposure_at(&self, spot: &Spot, place: impl FnOnce() -> Vec3) -> f32 {
        // A number with the bit of a split lies beyond all values.
        match self.octet(spot.at()) {
            Some(octet) => self.exposure_in(octet, spot.fraction),
            None => self.exposure_across(spot, place),
        }
    }

    /// The same where the eight voxels lie in several chunks, or there was none yet.
    #[inline(never)]
    fn exposure_across(&self, spot: &Spot, place: impl FnOnce() -> Vec3) -> f32 {
        let octet = match spot.at() {
            NOWHERE => self.octet_around(least_voxel(place())),
            at => self.split_octet(at & !Spot::SPLIT),
        };
        self.exposure_in(Octet::new(octet), spot.fraction)
    }

    #[inline(always)]
    fn exposure_in(&self, octet: Octet, fraction: [u16; 3]) -> f32 {
        let (shadow, f) = octet.interpolated(fraction);
        // The metamer's own voxel is the nearest of the eight; its shadow reaches that one and the layer below.
        let [x, y, z, _] = f.max(1.0 - f).to_array();
        let below = if f.y < 0.5 { 0.0 } else { 1.0 - f.y };
        let own = self.first * (x * y * z) + self.second * below;
        (1.0 - (shadow - own) * (1.0 / UNIT)).clamp(0.0, 1.0)
    }

    /// The direction towards more light at a place, −∇s by central differences (Pałubicki et al. 2009 §4.1) of the
    /// shadows an internode to each side; none where shadows are even.
    pub fn towards_light(&self, position: Vec3) -> Option<Vec3> {
        let octet = |place: Vec3| Octet::new(self.octet_around(least_voxel(place)));
        let shadow = |place: Vec3| octet(place).interpolated(fraction(place)).0;
        let difference = |axis: Vec3| shadow(position - axis) - shadow(position + axis);
        let gradient = Vec3::new(difference(Vec3::X), difference(Vec3::Y), difference(Vec3::Z));
        (gradient * (1.0 / UNIT)).try_normalize()
    }

    /// Shadows in the eight voxels of one chunk of which the least stands here.
    #[inline(always)]
    fn octet(&self, at: u32) -> Option<Octet> {
        const ACROSS: usize = WIDTH as usize;
        let values = self.chunks.all().as_flattened();
        let values = values.get(at as usize..at as usize + PLANE + ACROSS + 2)?;
        let rows = [0, ACROSS, PLANE, PLANE + ACROSS];
        Some(Octet::of_rows(rows.map(|row| [values[row], values[row + 1]])))
    }

    /// Shadows in eight voxels that lie in several chunks, x fastest, then z, then y.
    #[inline(never)]
    fn split_octet(&self, at: u32) -> [u32; 8] {
        let within = at as usize % VALUES;
        let (y, in_plane) = (within / PLANE, within % PLANE);
        let (z, x) = (in_plane >> WIDTH_BITS, in_plane & (WIDTH - 1) as usize);
        let octants = &self.octants[at as usize / VALUES];
        let values = self.chunks.all().as_flattened();
        core::array::from_fn(|corner| {
            let (x, y, z) = (x + (corner & 1), y + (corner >> 2), z + (corner >> 1 & 1));
            let octant = x >> WIDTH_BITS | z >> DEPTH_BITS << 1 | y >> DEPTH_BITS << 2;
            let at = octants[octant] as usize + offset([x as i32, y as i32, z as i32]);
            values.get(at).copied().unwrap_or(0)
        })
    }

    /// The same from this voxel on, wherever they are.
    pub(super) fn octet_around(&self, [x, y, z]: [i32; 3]) -> [u32; 8] {
        core::array::from_fn(|corner| {
            let corner = corner as i32;
            self.shadow([x + (corner & 1), y + (corner >> 2), z + (corner >> 1 & 1)])
        })
    }
}

/// The least of the eight voxels around a place.
#[inline(always)]
pub(super) fn least_voxel(place: Vec3) -> [i32; 3] {
    voxel_of(place - 0.5 * VOXEL)
}

/// Where a place lies between the centres of the eight voxels around it.
#[inline(always)]
fn fraction(place: Vec3) -> [u16; 3] {
    let at = place * (1.0 / VOXEL) - 0.5;
    let fraction = at - Vec3::from_array(directory::voxel_of(at).map(|i| i as f32));
    fraction.to_array().map(|f| (f * Spot::STEPS) as i32 as u16)
}

/// Shadows in the eight voxels around a place: in those with the lesser x and in those with the greater, z fastest, then
/// y.
#[derive(Clone, Copy, Debug)]
struct Octet {
    low: Vec4,
    high: Vec4,
}

impl Octet {
    /// From the two values of each row along x.
    #[inline(always)]
    fn of_rows(rows: [[u32; 2]; 4]) -> Self {
        // As signed numbers they convert faster; none is so dark that it would matter.
        let [low, high] = [0, 1].map(|x| Vec4::from_array(rows.map(|row| row[x] as i32 as f32)));
        Self { low, high }
    }

    /// From values x fastest, then z, then y.
    #[inline(always)]
    fn new(values: [u32; 8]) -> Self {
        Self::of_rows([0, 2, 4, 6].map(|row| [values[row], values[row + 1]]))
    }

    /// The shadow between the centres of the voxels, and where that is.
    #[inline(always)]
    fn interpolated(self, fraction: [u16; 3]) -> (f32, Vec4) {
        let [x, y, z] = fraction.map(|f| i32::from(f) as f32);
        let f = Vec4::new(x, y, z, 0.0) * (1.0 / Spot::STEPS);
        let rest = 1.0 - f;
        let along_x = self.low * rest.x + self.high * f.x;
        let [a, b, c, d] = (along_x * Vec4::new(rest.z, f.z, rest.z, f.z)).to_array();
        ((a + b) * rest.y + (c + d) * f.y, f)
    }
}
