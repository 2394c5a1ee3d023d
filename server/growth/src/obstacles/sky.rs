//! How much sky a place sees past the obstacles.
//!
//! Shadows of metamers fade within a few voxels, for light passes between leaves; a roof keeps out the sky
//! however high it is. So obstacles do not cast such shadows: instead, rays go out from a lattice of places to
//! parts of an overcast sky that shed equal light on the ground, and the share that gets through dims what
//! the shadows of metamers leave. Shapes without bounds cost no more than small ones.

use core::f32::consts::PI;
use std::sync::LazyLock;

use glam::Vec3;

use super::body::Body;
use crate::voxel_grid::{VoxelGrid, voxel_of};

/// Distance between the places of the lattice.
const SPACING: f32 = 2.0;
/// Parts of the sky.
const PARTS: usize = 32;

/// Shares known so far.
#[derive(Clone, Debug)]
pub(super) struct SkyMap {
    /// For each place of the lattice the parts of the sky it sees, plus one; 0 where nobody has looked.
    seen: VoxelGrid<u8>,
}

impl Default for SkyMap {
    fn default() -> Self {
        Self { seen: VoxelGrid::new() }
    }
}

impl SkyMap {
    /// The share seen from a place, interpolated.
    pub(super) fn share(&self, place: Vec3, bodies: &[Body]) -> f32 {
        let (low, f) = cell_of(place);
        let octet = self.seen.octet(low);
        let mut s = [0.0; 8];
        for (corner, (s, known)) in s.iter_mut().zip(octet).enumerate() {
            let parts = if known > 0 { known - 1 } else { parts_seen(lattice_place(low, corner), bodies) };
            *s = f32::from(parts);
        }
        let along_x = |i: usize| s[i] * (1.0 - f.x) + s[i + 1] * f.x;
        let along_z = |i: usize| along_x(i) * (1.0 - f.z) + along_x(i + 2) * f.z;
        (along_z(0) * (1.0 - f.y) + along_z(4) * f.y) / PARTS as f32
    }

    /// Looks from the lattice places around a place, where nobody has yet.
    pub(super) fn survey(&mut self, place: Vec3, bodies: &[Body]) {
        let (low, _) = cell_of(place);
        for (corner, known) in self.seen.octet(low).into_iter().enumerate() {
            if known == 0 {
                let parts = parts_seen(lattice_place(low, corner), bodies);
                *self.seen.get_mut(lattice_voxel(low, corner)) = parts + 1;
            }
        }
    }
}

/// The lattice place below a place on each axis, and how far towards the next one it lies.
fn cell_of(place: Vec3) -> ([i32; 3], Vec3) {
    let at = place / SPACING;
    let low = voxel_of(at);
    (low, at - Vec3::from_array(low.map(|c| c as f32)))
}

/// The corners in the order of `VoxelGrid::octet`.
fn lattice_voxel([x, y, z]: [i32; 3], corner: usize) -> [i32; 3] {
    let corner = corner as i32;
    [x + (corner & 1), y + (corner >> 2), z + (corner >> 1 & 1)]
}

fn lattice_place(low: [i32; 3], corner: usize) -> Vec3 {
    Vec3::from_array(lattice_voxel(low, corner).map(|c| c as f32)) * SPACING
}

fn parts_seen(place: Vec3, bodies: &[Body]) -> u8 {
    let is_open = |direction: &&Vec3| !bodies.iter().any(|body| body.meets_ray(place, **direction));
    SKY.iter().filter(is_open).count() as u8
}

/// Directions to the parts: dense overhead, for light from near the horizon spreads thinly on the ground.
static SKY: LazyLock<[Vec3; PARTS]> = LazyLock::new(|| {
    let golden_angle = PI * (3.0 - 5.0f32.sqrt());
    core::array::from_fn(|part| {
        let u = (part as f32 + 0.5) / PARTS as f32;
        let (sin, cos) = libm::sincosf(golden_angle * part as f32);
        Vec3::new(u.sqrt() * cos, (1.0 - u).sqrt(), u.sqrt() * sin)
    })
});

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;
    use crate::obstacles::shape::Shape;

    fn share(shape: Shape, place: Vec3) -> f32 {
        let bodies = [Body::new(&shape)];
        let mut map = SkyMap::default();
        let unsurveyed = map.share(place, &bodies);
        map.survey(place, &bodies);
        assert_eq!(map.share(place, &bodies), unsurveyed, "a survey changes nothing but the time it takes");
        unsurveyed
    }

    fn slab(height: f32, half: f32) -> Shape {
        Shape::Box {
            centre: Vec3::Y * (height + 0.5),
            half_extents: Vec3::new(half, 0.5, half),
            rotation: Quat::IDENTITY,
        }
    }

    #[test]
    fn a_roof_darkens_what_is_under_it() {
        assert!(share(slab(20.0, 500.0), Vec3::Y * 5.0) < 0.05);
        assert_eq!(share(slab(20.0, 500.0), Vec3::Y * 30.0), 1.0);
        let under_small = share(slab(20.0, 5.0), Vec3::Y * 10.0);
        assert!((0.5..0.95).contains(&under_small), "{under_small}");
        let beside = share(slab(20.0, 5.0), Vec3::new(60.0, 1.0, 0.0));
        assert!(beside > 0.95, "{beside}");
    }

    #[test]
    fn a_wall_hides_half_of_the_sky() {
        let wall = Shape::Plane { point: Vec3::ZERO, normal: Vec3::X };
        let near = share(wall, Vec3::new(2.0, 9.0, 3.0));
        assert!((near - 0.5).abs() < 0.1, "{near}");
    }

    #[test]
    fn ground_hides_no_sky_from_above_it() {
        let ground = Shape::Plane { point: Vec3::Y, normal: Vec3::Y };
        assert_eq!(share(ground.clone(), Vec3::Y * 9.0), 1.0);
        assert_eq!(share(ground, Vec3::Y * -9.0), 0.0);
    }

    #[test]
    fn parts_of_the_sky_shed_equal_light() {
        // The mean height of a direction weighted by cosine is 2/3.
        let mean = SKY.iter().map(|direction| direction.y).sum::<f32>() / PARTS as f32;
        assert!((mean - 2.0 / 3.0).abs() < 0.01, "{mean}");
        assert!(SKY.iter().all(|direction| (direction.length() - 1.0).abs() < 1e-5 && direction.y > 0.0));
        let sideways = SKY.iter().sum::<Vec3>() / PARTS as f32;
        assert!(sideways.x.abs() < 0.05 && sideways.z.abs() < 0.05, "{sideways}");
    }
}
