//! The sun, and what it sees.

use glam::{Vec2, Vec3};

use super::{
    super::raster::{Seen, View},
    meshes::{Painted, Skin},
};

/// Pixels across the map of what the sun sees.
const SHADOW_MAP: usize = 2048;

/// What the sun sees.
pub(super) struct Sun {
    view: View,
    seen: Seen,
}

impl Sun {
    /// High, from the left and the front.
    pub(super) fn direction() -> Vec3 {
        Vec3::new(-0.5, 0.8, 0.5).normalize()
    }

    pub(super) fn new(meshes: &[(Skin, Painted)], points: impl Iterator<Item = Vec3>) -> Self {
        let (low, high) =
            points.fold((Vec3::ZERO, Vec3::Y), |(low, high), point| (low.min(point), high.max(point)));
        let (middle, size) = (0.5 * (low + high), SHADOW_MAP as f32);
        let scale = size / (1.5 * (high - low).length());
        let plain = View::new(Self::direction(), scale, Vec2::ZERO);
        let origin = Vec2::splat(0.5 * size) - plain.project(middle).truncate();
        let view = View::new(Self::direction(), scale, origin);
        let mut seen = Seen::new(SHADOW_MAP, SHADOW_MAP);
        for (_, painted) in meshes.iter().filter(|(skin, _)| *skin != Skin::Ground) {
            for corners in painted.mesh.indices.as_chunks::<3>().0 {
                let projected = corners.map(|corner| view.project(painted.mesh.positions[corner as usize]));
                seen.add(projected, 0, |weights| painted.is_there(*corners, weights));
            }
        }
        Self { view, seen }
    }

    /// How much of the sun a place sees, with a shadow as soft as `blur` pixels of the map.
    pub(super) fn reaches(&self, place: Vec3, bias: f32, blur: f32) -> f32 {
        let at = self.view.project(place);
        let mut lit = 0.0;
        for (x, y) in [
            (0.0, 0.0),
            (0.9, 0.35),
            (-0.35, 0.9),
            (-0.9, -0.35),
            (0.35, -0.9),
            (0.5, 0.6),
            (-0.6, 0.5),
            (-0.5, -0.6),
            (0.6, -0.5),
        ] {
            let (x, y) = (at.x + blur * x, at.y + blur * y);
            let inside = x >= 0.0 && y >= 0.0 && x < self.seen.width as f32 && y < self.seen.height as f32;
            let blocked = inside && self.seen.near[y as usize * self.seen.width + x as usize] > at.z + bias;
            lit += if blocked { 0.0 } else { 1.0 / 9.0 };
        }
        lit
    }
}
