//! Reading light: shadows between the centres of the eight voxels around a place.
//!
//! Read at one voxel, shadows would come in blocks.

use glam::Vec3;

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
}

impl ShadowGrid {
    /// Light at a place, 0 to 1, as if the metamer whose node is there cast no shadow.
    pub fn exposure(&self, position: Vec3) -> f32 {
        self.exposure_in(self.octet_around(least_voxel(position)), fraction(position))
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
    #[inline]
    pub(crate) fn exposure_at(&self, spot: Spot, place: impl FnOnce() -> Vec3) -> f32 {
        let at = u32::from(spot.at[0]) | u32::from(spot.at[1]) << 16;
        let octet = if at & Spot::SPLIT == 0 {
            self.octet(at)
        } else if at != NOWHERE {
            self.split_octet(at & !Spot::SPLIT)
        } else {
            self.octet_around(least_voxel(place()))
        };
        self.exposure_in(octet, spot.fraction)
    }

    #[inline(always)]
    fn exposure_in(&self, octet: [u32; 8], fraction: [u16; 3]) -> f32 {
        let (shadow, f) = interpolated(octet, fraction);
        // The metamer's own voxel is the nearest of the eight; its shadow reaches that one and the layer below.
        let [x, y, z] = f.to_array().map(|f| f.max(1.0 - f));
        let below = if f.y < 0.5 { 0.0 } else { 1.0 - f.y };
        let own = self.first * (x * y * z) + self.second * below;
        (1.0 - (shadow - own) * (1.0 / UNIT)).clamp(0.0, 1.0)
    }

    /// The direction towards more light at a place, −∇s by central differences (Pałubicki et al. 2009 §4.1) of the
    /// shadows an internode to each side; none where shadows are even.
    pub fn towards_light(&self, position: Vec3) -> Option<Vec3> {
        let shadow = |place: Vec3| interpolated(self.octet_around(least_voxel(place)), fraction(place)).0;
        let difference = |axis: Vec3| shadow(position - axis) - shadow(position + axis);
        let gradient = Vec3::new(difference(Vec3::X), difference(Vec3::Y), difference(Vec3::Z));
        (gradient * (1.0 / UNIT)).try_normalize()
    }

    /// Shadows in the eight voxels of one chunk of which the least stands here, x fastest, then z, then y.
    #[inline]
    fn octet(&self, at: u32) -> [u32; 8] {
        const LAST: usize = PLANE + WIDTH as usize + 2;
        let values = self.chunks.all().as_flattened().get(at as usize..);
        let Some(values) = values.and_then(|values| values.first_chunk::<LAST>()) else { return [0; 8] };
        const ACROSS: usize = WIDTH as usize;
        [0, 1, ACROSS, ACROSS + 1, PLANE, PLANE + 1, PLANE + ACROSS, PLANE + ACROSS + 1]
            .map(|step| values[step])
    }

    /// The same where they lie in several chunks.
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

/// The shadow between the centres of eight voxels, and where that is.
#[inline(always)]
fn interpolated(octet: [u32; 8], fraction: [u16; 3]) -> (f32, Vec3) {
    let f = Vec3::from_array(fraction.map(|f| f32::from(f) * (1.0 / Spot::STEPS)));
    let mut s = [0.0; 8];
    for (s, shadow) in s.iter_mut().zip(octet) {
        // As a signed number it converts faster; none is so dark that it would matter.
        *s = shadow as i32 as f32;
    }
    let along_x = |i: usize| s[i] * (1.0 - f.x) + s[i + 1] * f.x;
    let along_z = |i: usize| along_x(i) * (1.0 - f.z) + along_x(i + 2) * f.z;
    (along_z(0) * (1.0 - f.y) + along_z(4) * f.y, f)
}
