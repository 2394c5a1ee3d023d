//! The colour of every pixel: what is seen there, in the sun or in shadow.

use glam::{Vec2, Vec3};

use super::{
    super::{
        canvas::Canvas,
        raster::{NOTHING, Seen, View},
    },
    SKY,
    meshes::{Painted, Skin},
    sun::Sun,
};
use crate::colour::linear;

const LAWN: [u8; 3] = [196, 202, 172];

/// Meshes in the sun.
pub(super) struct Scene {
    pub(super) meshes: Vec<(Skin, Painted)>,
    pub(super) sun: Sun,
    /// How far the plant reaches from where it stands.
    pub(super) reach: f32,
}

/// What is seen of the lawn.
pub(super) struct Lawn {
    /// How far to the sides and to the front.
    pub(super) reach: Vec2,
    /// Where the middle of the picture is, to the right of the foot.
    pub(super) middle: f32,
}

impl Scene {
    pub(super) fn paint(&self, view: &View, lawn: &Lawn, width: usize, height: usize) -> Canvas {
        let mut canvas = Canvas::new(width, height, linear(SKY));
        let mut seen = Seen::new(width, height);
        let mut first = 0;
        let mut firsts = Vec::new();
        for (skin, painted) in &self.meshes {
            firsts.push(first);
            // What stands on the ground is seen from below as well.
            let is_hidden = *skin == Skin::Ground && view.is_below(painted.mesh.positions[0]);
            for corners in painted.mesh.indices.as_chunks::<3>().0 {
                if !is_hidden {
                    for piece in view.pieces(corners.map(|corner| painted.mesh.positions[corner as usize])) {
                        let is_there = |weights| painted.is_there(*corners, piece.of_whole(weights));
                        seen.add(piece.corners, first, is_there);
                    }
                }
                first += 1;
            }
        }
        for y in 0..height {
            for x in 0..width {
                let number = seen.triangle[y * width + x];
                if number == NOTHING {
                    continue;
                }
                let mesh = firsts.partition_point(|&first| first <= number) - 1;
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                if let Some(colour) = self.colour(view, lawn, mesh, number - firsts[mesh], at) {
                    canvas.set(x, y, colour);
                }
            }
        }
        canvas
    }

    fn colour(&self, view: &View, lawn: &Lawn, mesh: usize, triangle: u32, at: Vec2) -> Option<Vec3> {
        let (skin, painted) = &self.meshes[mesh];
        let Painted { mesh, colours, texture, .. } = painted;
        let indices = mesh.indices.as_chunks::<3>().0[triangle as usize];
        let corners = indices.map(|corner| corner as usize);
        let shares = view.shares(corners.map(|corner| mesh.positions[corner]), at)?;
        let mix = |values: &[Vec3]| {
            let weighted = corners.iter().zip(shares.to_array());
            weighted.fold(Vec3::ZERO, |sum, (&corner, share)| sum + values[corner] * share)
        };
        let colour = texture
            .as_ref()
            .map_or(Vec3::ONE, |texture| texture.colours[texture.texel(painted.uv(indices, shares))])
            * mix(colours);
        let (place, normal) = (mix(&mesh.positions), mix(&mesh.normals).normalize_or(Vec3::Y));
        let facing = normal.dot(Sun::direction());
        // Warm sun, and a cool sky that is brighter above.
        let (sunlight, skylight) = (Vec3::new(1.02, 0.96, 0.84), Vec3::new(0.52, 0.56, 0.62));
        let lit = |sun: f32, sky: f32| sunlight * sun + skylight * sky;
        let bias = 0.006 * self.reach;
        Some(match skin {
            Skin::Leaf => {
                // Both sides count, and some light comes through.
                let sun = self.sun.reaches(place, bias, 2.0) * (0.3 + 0.62 * facing.abs());
                colour * lit(sun * 1.25, 0.55 + 0.2 * normal.y.abs())
            }
            Skin::Bark => {
                let sun = self.sun.reaches(place, bias, 2.0) * facing.max(0.0);
                colour * lit(sun, 0.5 + 0.2 * normal.y)
            }
            Skin::Glaze => {
                let sun = self.sun.reaches(place, bias, 2.0) * facing.max(0.0);
                colour * lit(sun, 0.55 + 0.25 * normal.y)
            }
            Skin::Ground => {
                let sun = self.sun.reaches(place, bias, 9.0);
                let [right, front] = [view.right(), view.right().cross(Vec3::Y)].map(|way| way.dot(place));
                let far = (Vec2::new(right - lawn.middle, front) / lawn.reach).length();
                let lawn = linear(LAWN) * (0.5 + 0.5 * sun);
                let fade = ((far - 0.3) / 0.7).clamp(0.0, 1.0);
                lawn.lerp(linear(SKY), fade * fade * (3.0 - 2.0 * fade))
            }
        })
    }
}
