//! Two crossed cards that stand for a plant far away, and the pictures of it that they show.

use glam::{Vec2, Vec3};

use crate::{
    ExportError,
    assembly::Block,
    foliage::cards::{Cards, Grid},
    picture::raster::{View, weights},
    surface::{Depth, Texture},
};

/// Texels along a side of the texture, whose left half shows the plant from the front and its right half from the side.
const SIDE: usize = 512;
/// Samples across a texel.
const SAMPLES: usize = 2;
const SIZE: [usize; 2] = [SIDE / 2 * SAMPLES, SIDE * SAMPLES];
/// Where eyes look from.
const EYES: [Vec3; 2] = [Vec3::Z, Vec3::X];

/// Gives all blocks of a plant and what they show.
pub(crate) type Blocks<'a> =
    &'a dyn Fn(&mut dyn FnMut(&Texture, Block<'_>) -> Result<(), ExportError>) -> Result<(), ExportError>;

/// Cards and their texture.
pub(crate) struct Billboard {
    pub cards: Cards,
    pub texture: Texture,
}

impl Billboard {
    /// Of a plant whose foot is at a place; the blocks are asked for twice.
    pub(crate) fn of(foot: Vec3, blocks: Blocks<'_>) -> Result<Self, ExportError> {
        let (mut low, mut high) = (foot, foot);
        blocks(&mut |_, block| {
            for &place in &block.mesh.positions {
                (low, high) = (low.min(place), high.max(place));
            }
            Ok(())
        })?;
        let mut sides = EYES.map(|eye| Side::new(eye, low, high));
        blocks(&mut |texture, block| {
            sides.iter_mut().for_each(|side| side.add(texture, &block));
            Ok(())
        })?;
        let mut cards = Cards::default();
        for (half, side) in sides.iter().enumerate() {
            side.add_card(&mut cards, foot, half as f32);
        }
        Ok(Self { cards, texture: texture(&sides, foot) })
    }
}

/// What is seen from one side.
struct Side {
    right: Vec3,
    eye: Vec3,
    /// The corners of the picture: along `right`, and upwards.
    low: Vec2,
    high: Vec2,
    view: View,
    samples: Vec<Sample>,
}

#[derive(Clone, Copy)]
struct Sample {
    near: f32,
    colour: Vec3,
    /// To the right, upwards, to the eye.
    normal: Vec3,
}

const NOTHING: Sample = Sample { near: f32::NEG_INFINITY, colour: Vec3::ZERO, normal: Vec3::Z };

impl Side {
    fn new(eye: Vec3, low: Vec3, high: Vec3) -> Self {
        let right = Vec3::Y.cross(eye);
        let ends = [low.dot(right), high.dot(right)];
        let low = Vec2::new(ends[0].min(ends[1]), low.y);
        // No picture is flat.
        let high = Vec2::new(ends[0].max(ends[1]), high.y).max(low + 1e-3);
        let samples = vec![NOTHING; SIZE[0] * SIZE[1]];
        Self { right, eye, low, high, view: View::new(eye, 1.0, Vec2::ZERO), samples }
    }

    /// The sample of a point, downwards, and how near it is.
    fn project(&self, point: Vec3) -> Vec3 {
        let at = self.view.project(point);
        let share = (Vec2::new(at.x, -at.y) - self.low) / (self.high - self.low);
        Vec3::new(share.x * SIZE[0] as f32, (1.0 - share.y) * SIZE[1] as f32, at.z)
    }

    fn add(&mut self, texture: &Texture, block: &Block<'_>) {
        let (mesh, second) = (block.mesh, block.second);
        for (part, triangles) in [&mesh.indices[..], second].into_iter().enumerate() {
            for corners in triangles.as_chunks::<3>().0 {
                let corners = corners.map(|corner| corner as usize);
                let projected = corners.map(|corner| self.project(mesh.positions[corner]));
                self.fill(projected, |weights| {
                    let mix = |values: &[Vec3]| {
                        let [a, b, c] = corners.map(|corner| values[corner]);
                        a * weights.x + b * weights.y + c * weights.z
                    };
                    let [a, b, c] = corners.map(|corner| mesh.uvs[corner]);
                    let texel = texture.texel(a * weights.x + b * weights.y + c * weights.z);
                    let colour = mix(block.colours);
                    // A second surface is plain.
                    let colour = if part == 0 { colour * texture.colours[texel] } else { colour };
                    (part == 1 || texture.cover[texel] >= 128).then(|| (colour, mix(&mesh.normals)))
                });
            }
        }
    }

    /// Samples a projected triangle where it is in front, and `seen` finds anything.
    fn fill(&mut self, corners: [Vec3; 3], seen: impl Fn(Vec3) -> Option<(Vec3, Vec3)>) {
        let [a, b, c] = corners.map(Vec3::truncate);
        // Casting takes what is below zero to zero.
        let [left, top] = (a.min(b).min(c) - 0.5).ceil().to_array().map(|part| part as usize);
        let [right, foot] = (a.max(b).max(c) + 0.5).floor().to_array().map(|part| part as usize);
        for y in top..foot.min(SIZE[1]) {
            for x in left..right.min(SIZE[0]) {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let Some(weights) = weights(corners, at).filter(|weights| weights.min_element() >= 0.0)
                else {
                    continue;
                };
                let near = weights.x * corners[0].z + weights.y * corners[1].z + weights.z * corners[2].z;
                let sample = &mut self.samples[y * SIZE[0] + x];
                if near > sample.near
                    && let Some((colour, normal)) = seen(weights)
                {
                    let facing = Vec3::new(normal.dot(self.right), normal.y, normal.dot(self.eye));
                    // Both sides of a leaf look to the eye.
                    let normal = if facing.z < 0.0 { -facing } else { facing };
                    *sample = Sample { near, colour, normal };
                }
            }
        }
    }

    fn add_card(&self, cards: &mut Cards, foot: Vec3, half: f32) {
        let first = cards.mesh.positions.len() as u32;
        cards.grids.push(Grid { first, columns: 1, rows: 1, stalk: None });
        let depth = self.eye * foot.dot(self.eye);
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let at = self.low + (self.high - self.low) * Vec2::new(x, y);
            let place = depth + self.right * at.x + Vec3::Y * at.y;
            cards.mesh.vertex(place, self.eye, Vec2::new(0.5 * (half + x), y));
            cards.tangents.push(self.right.extend(1.0));
            cards.hues.push(Vec3::ONE);
        }
        cards.mesh.triangle(first, first + 1, first + 2);
        cards.mesh.triangle(first + 2, first + 1, first + 3);
    }

    /// A texel, from the foot upwards.
    fn texel(&self, x: usize, y: usize) -> Option<Texel> {
        let (mut colour, mut normal, mut count) = (Vec3::ZERO, Vec3::ZERO, 0);
        let mut near = f32::NEG_INFINITY;
        for i in 0..SAMPLES * SAMPLES {
            let at = [x * SAMPLES + i % SAMPLES, (SIDE - 1 - y) * SAMPLES + i / SAMPLES];
            let sample = self.samples[at[1] * SIZE[0] + at[0]];
            if sample.near > f32::NEG_INFINITY {
                colour += sample.colour;
                normal += sample.normal;
                near = near.max(sample.near);
                count += 1;
            }
        }
        let share = count as f32 / (SAMPLES * SAMPLES) as f32;
        let (colour, normal) = (colour / count.max(1) as f32, normal.normalize_or(Vec3::Z));
        (count > 0).then_some(Texel { colour, normal, share, near })
    }
}

/// What a texel shows.
#[derive(Clone, Copy)]
struct Texel {
    colour: Vec3,
    normal: Vec3,
    /// What share of it is covered.
    share: f32,
    /// How near the nearest is.
    near: f32,
}

fn texture(sides: &[Side; 2], foot: Vec3) -> Texture {
    let side_of = |at: usize| &sides[at % SIDE * 2 / SIDE];
    let texels: Vec<_> =
        (0..SIDE * SIDE).map(|at| side_of(at).texel(at % SIDE % (SIDE / 2), at / SIDE)).collect();
    let seen = || texels.iter().flatten();
    // Coarser levels mix in what lies outside.
    let mean = seen().map(|texel| texel.colour).sum::<Vec3>() / seen().count().max(1) as f32;
    // Where half of a texel is covered it is drawn, or thin crowns would vanish.
    let cover = |share: f32| (510.0 * share).min(255.0) as u8;
    // The cards go through the foot; where nothing is seen, the card is.
    let offsets: Vec<f32> = (0..texels.len())
        .map(|at| texels[at].map_or(0.0, |texel| texel.near - foot.dot(side_of(at).eye)))
        .collect();
    let (far, near) = offsets.iter().fold((0.0f32, 0.0f32), |(far, near), &at| (far.min(at), near.max(at)));
    let range = (near - far).max(f32::MIN_POSITIVE);
    Texture {
        side: SIDE,
        colours: texels.iter().map(|texel| texel.map_or(mean, |texel| texel.colour.min(Vec3::ONE))).collect(),
        cover: texels.iter().map(|texel| texel.map_or(0, |texel| cover(texel.share))).collect(),
        normals: texels.iter().map(|texel| texel.map_or(Vec3::Z, |texel| texel.normal)).collect(),
        exposure: None,
        depth: Some(Depth { shares: offsets.iter().map(|at| (at - far) / range).collect(), far, near }),
    }
}

#[cfg(test)]
mod tests {
    use espalier_mesh::TriangleMesh;

    use super::*;

    /// An upright square, two internodes wide, that faces `eye`, so far in front of the origin.
    fn square(mesh: &mut TriangleMesh, eye: Vec3, middle: Vec3) {
        let right = Vec3::Y.cross(eye);
        let first = mesh.positions.len() as u32;
        for (x, y) in [(-1.0, 0.0), (1.0, 0.0), (-1.0, 2.0), (1.0, 2.0)] {
            mesh.vertex(middle + right * x + Vec3::Y * y, eye, Vec2::ZERO);
        }
        mesh.triangle(first, first + 1, first + 2);
        mesh.triangle(first + 2, first + 1, first + 3);
    }

    #[test]
    fn a_plane_at_a_known_distance_has_the_depth_of_it() {
        let foot = Vec3::new(10.0, 5.0, -20.0);
        let mut mesh = TriangleMesh::default();
        // Seen from the front: on the left one three internodes in front of the card, on the right one behind it.
        square(&mut mesh, Vec3::Z, foot + Vec3::new(-2.0, 0.0, 3.0));
        square(&mut mesh, Vec3::Z, foot + Vec3::new(2.0, 0.0, -1.0));
        // Seen from the side: one two internodes in front.
        square(&mut mesh, Vec3::X, foot + Vec3::new(2.0, 0.0, 0.0));
        let plain = Texture {
            side: 1,
            colours: vec![Vec3::ONE],
            cover: vec![255],
            normals: vec![Vec3::Z],
            exposure: None,
            depth: None,
        };
        let colours = vec![Vec3::ONE; mesh.positions.len()];
        let tangents = vec![Vec3::X.extend(1.0); mesh.positions.len()];
        let billboard = Billboard::of(foot, &|take| {
            let (second, places) = (&[][..], None);
            take(
                &plain,
                Block { mesh: &mesh, tangents: &tangents, colours: &colours, second, places, riders: &[] },
            )
        })
        .expect("it is painted");
        let depth = billboard.texture.depth.as_ref().expect("a billboard has depths");
        assert!(
            (depth.far + 1.0).abs() < 1e-4 && (depth.near - 3.0).abs() < 1e-4,
            "{} to {}",
            depth.far,
            depth.near
        );
        // Half-way up: the front picture spans -3 to 3 across, that from the side the squares' own depth.
        let texel = |across: f32| SIDE * SIDE / 2 + (across * (SIDE / 2) as f32) as usize;
        let at = |texel: usize| depth.far + (depth.near - depth.far) * depth.shares[texel];
        assert!((at(texel(1.0 / 6.0)) - 3.0).abs() < 1e-4);
        assert!((at(texel(5.0 / 6.0)) + 1.0).abs() < 1e-4);
        let between = texel(0.5);
        assert!(billboard.texture.cover[between] == 0 && at(between).abs() < 1e-4, "nothing is seen there");
        let from_the_side = (SIDE / 2..SIDE).map(|x| SIDE * SIDE / 2 + x);
        let seen: Vec<usize> = from_the_side.filter(|&at| billboard.texture.cover[at] > 0).collect();
        assert!(!seen.is_empty() && seen.iter().any(|&texel| (at(texel) - 2.0).abs() < 1e-4));
        let png = billboard.texture.depth_png().expect("a picture of them");
        assert!(png.starts_with(b"\x89PNG"));
    }
}
