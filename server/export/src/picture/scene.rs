//! A plant in the sun: how large it is drawn, what it stands on, and the colour of every pixel.

use espalier_growth::species::{Species, Stand};
use espalier_mesh::{Style, TriangleMesh, wood};
use espalier_plant::{MetamerId, Plant};
use espalier_settings::Appearance;
use glam::{Vec2, Vec3};

use super::{
    canvas::Canvas,
    raster::{NOTHING, Seen, View, weights},
};
use crate::{
    colour::linear,
    foliage::{Foliage, cards::Cards, leaf_look::Shoot, living},
    surface::{
        Texture,
        bark::{Bark, CUT},
        thin::{self, Thin},
    },
};

/// What a plant looks like beyond its form, and what it stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Leaves, flowers, fruits and bark; pictures have a background of their own.
    pub appearance: Appearance,
    /// What the plant stands on.
    pub stand: Stand,
}

impl From<&Species> for Look {
    fn from(species: &Species) -> Self {
        Self { appearance: species.appearance, stand: species.stand }
    }
}

/// A mesh with a colour at each corner, which multiplies that of a texture.
#[derive(Clone, Debug, Default)]
struct Painted {
    mesh: TriangleMesh,
    colours: Vec<Vec3>,
    texture: Option<Texture>,
}

impl Painted {
    /// Whether there is anything where each corner of a triangle has so much to say.
    fn is_there(&self, corners: [u32; 3], weights: Vec3) -> bool {
        self.texture.as_ref().is_none_or(|texture| texture.is_there(self.uv(corners, weights)))
    }

    fn uv(&self, corners: [u32; 3], weights: Vec3) -> Vec2 {
        let [a, b, c] = corners.map(|corner| self.mesh.uvs[corner as usize]);
        a * weights.x + b * weights.y + c * weights.z
    }
}

/// How a mesh answers to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Skin {
    Leaf,
    Bark,
    Glaze,
    Ground,
}

/// Samples across a pixel.
const SAMPLES: usize = 3;
/// Pixels across the map of what the sun sees.
const SHADOW_MAP: usize = 2048;
/// Share of a picture's height below the foot of the plant.
const FOOT: f32 = 0.1;
/// Share of a picture's width and height that the plant may take.
const ROOM: f32 = 0.94;
/// Sine of the angle by which the eye looks down.
const EYE_HEIGHT: f32 = 0.1;

pub(crate) const SKY: [u8; 3] = [244, 245, 240];
const LAWN: [u8; 3] = [196, 202, 172];

/// Draws a plant from the front, framed to fill the picture, its foot always at the same height.
pub fn draw(plant: &Plant, style: &Style, look: &Look, width: usize, height: usize) -> Canvas {
    let (stage, size) = (Stage::of(plant, style, look), [width, height]);
    let view = stage.framed(Vec3::new(0.0, EYE_HEIGHT, 1.0).normalize(), size, &Framing::default());
    stage.seen(&view, size)
}

/// How a picture is framed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Framing {
    /// Samples to an internode at most.
    pub most: f32,
    /// Whether the foot is in the middle, so that it stays there when the eye goes around.
    pub is_steady: bool,
}

impl Default for Framing {
    /// As large as fits.
    fn default() -> Self {
        Self { most: f32::MAX, is_steady: false }
    }
}

/// A plant on what it stands on, ready for pictures.
pub(super) struct Stage {
    scene: Scene,
    points: Vec<Vec3>,
    base: f32,
}

impl Stage {
    pub(super) fn of(plant: &Plant, style: &Style, look: &Look) -> Self {
        let mut meshes = wooden(plant, style, &look.appearance);
        meshes.extend(borne(plant, style, &look.appearance));
        let (points, reach) = extent(&meshes);
        let base = stand(&mut meshes, look.stand, reach);
        // What it stands on is to be seen as well.
        let (points, _) = if base < 0.0 { extent(&meshes) } else { (points, reach) };
        ground(&mut meshes, base, reach);
        let sun = Sun::new(&meshes, &points);
        Self { scene: Scene { sun, meshes, reach }, points, base }
    }

    /// The view from a direction in which all of it fits above the foot line.
    pub(super) fn framed(&self, eye: Vec3, size: [usize; 2], framing: &Framing) -> View {
        framed(&self.points, eye, self.base, samples(size), framing)
    }

    pub(super) fn seen(&self, view: &View, size: [usize; 2]) -> Canvas {
        let [width, height] = size;
        let size = samples(size);
        let lawn = Lawn {
            reach: Vec2::new(0.5 * size.x, FOOT * size.y / view.eye().y) / view.scale(),
            middle: (0.5 * size.x - view.project(Vec3::ZERO).x) / view.scale(),
        };
        self.scene.paint(view, &lawn, width * SAMPLES, height * SAMPLES).reduced(SAMPLES)
    }
}

fn samples([width, height]: [usize; 2]) -> Vec2 {
    Vec2::new((width * SAMPLES) as f32, (height * SAMPLES) as f32)
}

fn bare(mesh: TriangleMesh) -> Painted {
    let colours = vec![Vec3::ONE; mesh.positions.len()];
    Painted { mesh, colours, texture: None }
}

/// Wood in its bark, and the faces of cuts.
fn wooden(plant: &Plant, style: &Style, look: &Appearance) -> Vec<(Skin, Painted)> {
    let bark = Bark::of(&look.bark);
    let mut meshes = Vec::new();
    for wood in wood(plant, style, &look.bark) {
        let colours = wood.radii.iter().map(|&radius| bark.tint(radius)).collect();
        let cut = TriangleMesh { indices: wood.cuts, ..wood.surface.clone() };
        let colour_of_cuts = vec![CUT; cut.positions.len()];
        meshes.push((Skin::Bark, Painted { mesh: cut, colours: colour_of_cuts, texture: None }));
        let texture = Some(bark.texture.clone());
        meshes.push((Skin::Bark, Painted { mesh: wood.surface, colours, texture }));
    }
    meshes
}

/// Leaves, flowers and fruits.
fn borne(plant: &Plant, style: &Style, look: &Appearance) -> Vec<(Skin, Painted)> {
    let foliage = Foliage::of(plant, style, look, 0);
    let painted = |thin: Thin, add: &dyn Fn(&mut Cards, MetamerId)| {
        let mut cards = Cards::default();
        for id in living(plant) {
            let first = cards.hues.len();
            add(&mut cards, id);
            // The shadows of the simulation are soft: deep in a crown there is little of the sky.
            let sky = 0.62 + 0.38 * Shoot::of(plant, id).light;
            for hue in &mut cards.hues[first..] {
                *hue *= thin.strength * sky;
            }
        }
        (Skin::Leaf, Painted { mesh: cards.mesh, colours: cards.hues, texture: Some(thin.texture) })
    };
    let mut meshes = vec![painted(thin::leaves(&look.leaves), &|cards, id| foliage.add_leaves(cards, id))];
    let flowers = thin::flowers(&look.flowers);
    meshes.extend(flowers.map(|thin| painted(thin, &|cards, id| foliage.add_flowers(cards, id))));
    let fruits = thin::fruits(&look.fruits);
    meshes.extend(fruits.map(|thin| painted(thin, &|cards, id| foliage.add_fruits(cards, id))));
    meshes
}

/// All corners, and how far the plant reaches from where it stands.
fn extent(meshes: &[(Skin, Painted)]) -> (Vec<Vec3>, f32) {
    let points: Vec<Vec3> = meshes.iter().flat_map(|(_, painted)| painted.mesh.positions.clone()).collect();
    let reach = points.iter().map(|p| p.length()).fold(1.0, f32::max);
    (points, reach)
}

/// A view in which all points fit above the foot line, which shows the height `base`.
fn framed(points: &[Vec3], eye: Vec3, base: f32, size: Vec2, framing: &Framing) -> View {
    let plain = View::new(eye, 1.0, Vec2::ZERO);
    let foot = plain.project(Vec3::Y * base).y;
    let seen = points.iter().map(|&point| plain.project(point));
    let (mut low, mut high) = (Vec3::new(-0.5, -1.0, 0.0), Vec3::new(0.5, 0.0, 0.0));
    for point in seen {
        (low, high) = (low.min(point), high.max(point));
    }
    let room = Vec2::new(ROOM * size.x, (ROOM - FOOT) * size.y);
    if framing.is_steady {
        high.x = high.x.max(-low.x);
        low.x = -high.x;
    }
    let scale = (room.x / (high.x - low.x)).min(room.y / (foot - low.y)).min(framing.most);
    let origin =
        Vec2::new(0.5 * size.x - scale * 0.5 * (low.x + high.x), (1.0 - FOOT) * size.y - scale * foot);
    View::new(eye, scale, origin)
}

/// Puts a pot under the plant; returns the height of the ground.
fn stand(meshes: &mut Vec<(Skin, Painted)>, stand: Stand, reach: f32) -> f32 {
    let (half_width, half_depth, height, taper) = match stand {
        Stand::Ground => return 0.0,
        Stand::Tray => (0.42 * reach, 0.26 * reach, 0.11 * reach, 0.86),
        Stand::Pot => (0.2 * reach, 0.2 * reach, 0.42 * reach, 0.78),
    };
    let glaze = linear([92, 62, 50]);
    let mut pot = Painted::default();
    // From the inside of the rim over its edge down to the foot: height, width, colour.
    let soil = linear([74, 84, 48]);
    let profile = [
        (-0.02, 0.0, soil),
        (-0.02, 0.95, soil),
        (0.0, 0.95, glaze),
        (0.0, 1.0, glaze),
        (-0.16, 1.0, glaze),
        (-0.16, 0.95, glaze),
        (-1.0, taper, glaze),
    ];
    const SIDES: u32 = 48;
    for pair in profile.windows(2) {
        let first = pot.mesh.positions.len() as u32;
        for side in 0..=SIDES {
            let (sin, cos) = libm::sincosf(std::f32::consts::TAU * side as f32 / SIDES as f32);
            // A square with round corners.
            let swell = |c: f32| c.signum() * libm::powf(c.abs(), 0.5);
            let out = Vec3::new(swell(cos), 0.0, swell(sin));
            for &(level, width, colour) in pair {
                let place = Vec3::new(out.x * half_width * width, level * height, out.z * half_depth * width);
                let flat = (pair[0].0 - pair[1].0).abs() < 0.01;
                let normal = if flat { Vec3::Y } else { Vec3::new(cos, 0.15, sin).normalize() };
                pot.mesh.vertex(place, normal, Vec2::ZERO);
                pot.colours.push(colour);
            }
        }
        for side in 0..SIDES {
            let corner = first + 2 * side;
            pot.mesh.triangle(corner, corner + 1, corner + 2);
            pot.mesh.triangle(corner + 1, corner + 2, corner + 3);
        }
    }
    meshes.push((Skin::Glaze, pot));
    -height
}

fn ground(meshes: &mut Vec<(Skin, Painted)>, base: f32, reach: f32) {
    let mut mesh = TriangleMesh::default();
    let far = 8.0 * reach;
    for (x, z) in [(-far, -far), (far, -far), (far, far), (-far, far)] {
        mesh.vertex(Vec3::new(x, base - 1e-3, z), Vec3::Y, Vec2::ZERO);
    }
    mesh.triangle(0, 1, 2);
    mesh.triangle(0, 2, 3);
    meshes.push((Skin::Ground, bare(mesh)));
}

/// What the sun sees.
struct Sun {
    view: View,
    seen: Seen,
}

impl Sun {
    /// High, from the left and the front.
    fn direction() -> Vec3 {
        Vec3::new(-0.5, 0.8, 0.5).normalize()
    }

    fn new(meshes: &[(Skin, Painted)], points: &[Vec3]) -> Self {
        let (low, high) = points
            .iter()
            .fold((Vec3::ZERO, Vec3::Y), |(low, high), &point| (low.min(point), high.max(point)));
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
    fn reaches(&self, place: Vec3, bias: f32, blur: f32) -> f32 {
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

struct Scene {
    meshes: Vec<(Skin, Painted)>,
    sun: Sun,
    reach: f32,
}

/// What is seen of the lawn.
struct Lawn {
    /// How far to the sides and to the front.
    reach: Vec2,
    /// Where the middle of the picture is, to the right of the foot.
    middle: f32,
}

impl Scene {
    fn paint(&self, view: &View, lawn: &Lawn, width: usize, height: usize) -> Canvas {
        let mut canvas = Canvas::new(width, height, linear(SKY));
        let mut seen = Seen::new(width, height);
        let mut first = 0;
        let mut firsts = Vec::new();
        for (_, painted) in &self.meshes {
            firsts.push(first);
            for corners in painted.mesh.indices.as_chunks::<3>().0 {
                let projected = corners.map(|corner| view.project(painted.mesh.positions[corner as usize]));
                seen.add(projected, first, |weights| painted.is_there(*corners, weights));
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
        let Painted { mesh, colours, texture } = painted;
        let indices = mesh.indices.as_chunks::<3>().0[triangle as usize];
        let corners = indices.map(|corner| corner as usize);
        let shares = weights(corners.map(|corner| view.project(mesh.positions[corner])), at)?;
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

#[cfg(test)]
mod tests {
    use espalier_mesh::StyleOptions;
    use espalier_plant::{AxisId, Internode};
    use espalier_settings::LeafKind;

    use super::*;

    /// A pole of so many internodes with a lateral bud at each node.
    fn pole(internodes: u32) -> Plant {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        for height in 1..=internodes {
            let end = Vec3::Y * height as f32;
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::X, laterals: &[Vec3::X] });
        }
        plant.end_step();
        plant
    }

    /// Looks of one colour each for leaves and bark.
    fn tinted(leaves: [u8; 3], bark: [u8; 3]) -> Look {
        let mut look = Look::default();
        (look.appearance.leaves.tint, look.appearance.bark.tint) = (leaves, bark);
        look.appearance.leaves.vigor_shift = 0.0;
        look
    }

    /// Pixels that are far from the sky's colour and from the lawn's.
    fn inked(canvas: &Canvas) -> Vec<(usize, usize)> {
        let places = (0..canvas.height()).flat_map(|y| (0..canvas.width()).map(move |x| (x, y)));
        places.filter(|&(x, y)| canvas.get(x, y).y < 0.3).collect()
    }

    #[test]
    fn plants_fill_the_picture_from_its_foot_up() {
        let thick = StyleOptions { twig_diameter: 0.3, ..StyleOptions::default() };
        let look = tinted([0; 3], [0; 3]);
        for internodes in [6, 20] {
            let inked = inked(&draw(&pole(internodes), &Style::new(thick), &look, 100, 120));
            let (top, bottom) = (inked[0].1, inked[inked.len() - 1].1);
            assert!((5..16).contains(&top) && (104..112).contains(&bottom), "{top} to {bottom}");
        }
    }

    #[test]
    fn every_kind_of_leaf_has_a_form_of_its_own() {
        let bare = Style::new(StyleOptions { leaves_per_node: 0, ..Default::default() });
        let mut look = tinted([30, 60, 20], [121, 110, 97]);
        let mut seen = vec![draw(&pole(6), &bare, &look, 100, 100)];
        for leaf in [
            LeafKind::Ovate,
            LeafKind::Round,
            LeafKind::Lanceolate,
            LeafKind::Lobed,
            LeafKind::Palmate,
            LeafKind::Fan,
            LeafKind::Compound,
            LeafKind::Needle,
            LeafKind::Scale,
        ] {
            look.appearance.leaves.shape = leaf;
            let picture = draw(&pole(6), &Style::default(), &look, 100, 100);
            assert!(!seen.contains(&picture), "{leaf:?} looks like another");
            seen.push(picture);
        }
    }

    #[test]
    fn a_pot_lifts_the_plant_off_the_ground() {
        let lowest_wood = |stand| {
            let look = Look { stand, ..tinted([0; 3], [0; 3]) };
            let canvas = draw(&pole(6), &Style::default(), &look, 100, 100);
            (0..100).rev().find(|&y| (0..100).any(|x| canvas.get(x, y).max_element() < 0.02))
        };
        let [ground, tray, pot] = [Stand::Ground, Stand::Tray, Stand::Pot].map(lowest_wood);
        assert!(ground > tray && tray > pot, "{ground:?}, {tray:?}, {pot:?}");
    }

    #[test]
    fn a_seed_alone_is_an_empty_lawn() {
        let canvas = draw(&Plant::new(Vec3::ZERO), &Style::default(), &Look::default(), 40, 40);
        assert_eq!(inked(&canvas), []);
    }

    #[test]
    fn shadows_fall_to_the_right() {
        let lawn = |canvas: &Canvas, x| canvas.get(x, 105).y;
        let canvas = draw(&pole(20), &Style::default(), &Look::default(), 100, 120);
        let darkest = (0..100).min_by(|&a, &b| lawn(&canvas, a).total_cmp(&lawn(&canvas, b)));
        assert!(darkest.is_some_and(|x| x >= 49), "{darkest:?}");
    }
}
