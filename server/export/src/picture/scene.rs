//! A plant in the sun: how it looks, and how large it is drawn.

mod ground;
mod meshes;
mod shading;
mod sun;

use std::convert::Infallible;

use espalier_growth::species::{Species, Stand};
use espalier_mesh::Style;
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::{Vec2, Vec3};

pub(super) use self::meshes::Meshes;
use self::{
    ground::{ground, stand},
    meshes::{Painted, Skin},
    shading::{Lawn, Scene},
    sun::Sun,
};
use super::{
    camera::{Camera, FOOT, Framing},
    canvas::Canvas,
    raster::View,
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

/// Samples across a pixel.
const SAMPLES: usize = 3;
/// Pixels that are drawn at once.
const MOST_AT_ONCE: usize = 1_100_000;
/// Sine of the angle by which the eye looks down.
const EYE_HEIGHT: f32 = 0.1;
/// Sine of the least of such angles by which there is much of the lawn.
const LEVEL: f32 = 0.02;
/// How far the lawn reaches for an eye that is near, in reaches of the plant.
const LAWN: f32 = 3.0;

pub(crate) const SKY: [u8; 3] = [244, 245, 240];

/// Draws a plant from the front, framed to fill the picture, its foot always at the same height.
pub fn draw(plant: &Plant, style: &Style, look: &Look, width: usize, height: usize) -> Canvas {
    let (stage, size) = (Stage::of(plant, style, look), [width, height]);
    stage.seen(&stage.front(size), size)
}

/// A plant on what it stands on, ready for pictures.
pub(super) struct Stage {
    scene: Scene,
    /// Corners beside those of the meshes that a picture has room for.
    room: Vec<Vec3>,
    base: f32,
}

impl Stage {
    pub(super) fn of(plant: &Plant, style: &Style, look: &Look) -> Self {
        Self::on(Meshes::of(plant, style, &look.appearance, None), look.stand, Vec::new())
    }

    /// Meshes on what they stand on, framed with room for more corners than theirs.
    pub(super) fn on(Meshes(mut meshes): Meshes, under: Stand, room: Vec<Vec3>) -> Self {
        let reach = corners(&meshes).map(Vec3::length).fold(1.0, f32::max);
        let base = stand(&mut meshes, under, reach);
        ground(&mut meshes, base, reach);
        let sun = Sun::new(&meshes, corners(&meshes).chain(room.iter().copied()));
        Self { scene: Scene { sun, meshes, reach }, room, base }
    }

    /// The view from the front, looking down a little.
    fn front(&self, size: [usize; 2]) -> View {
        let eye = Vec3::new(0.0, EYE_HEIGHT, 1.0).normalize();
        self.framing(size, false).distant(self.points(), &[eye]).swap_remove(0)
    }

    /// The view from a camera.
    pub(super) fn view(&self, camera: Camera, size: [usize; 2]) -> View {
        self.views(camera, &[camera.eye()], &self.framing(size, false)).swap_remove(0)
    }

    /// So many views from all around, beginning with that from a camera, between which what is in the middle stays there.
    pub(super) fn steady_views(&self, camera: Camera, size: [usize; 2], frames: u16) -> Vec<View> {
        self.views(camera, &camera.around(frames), &self.framing(size, true))
    }

    fn views(&self, camera: Camera, eyes: &[Vec3], framing: &Framing) -> Vec<View> {
        match camera.perspective {
            Some(perspective) => framing.close(self.points(), eyes, perspective),
            None => framing.distant(self.points(), eyes),
        }
    }

    fn framing(&self, size: [usize; 2], is_steady: bool) -> Framing {
        Framing { size: samples(size), base: self.base, is_steady }
    }

    /// All that is to be seen.
    fn points(&self) -> impl Iterator<Item = Vec3> + Clone {
        corners(&self.scene.meshes).chain(self.room.iter().copied())
    }

    fn lawn(&self, view: &View, size: [usize; 2]) -> Lawn {
        if view.place().is_some() {
            return Lawn { reach: Vec2::splat(LAWN * self.scene.reach), middle: 0.0 };
        }
        let size = samples(size);
        let down = FOOT * size.y / view.eye().y.max(LEVEL);
        Lawn {
            reach: Vec2::new(0.5 * size.x, down) / view.scale(),
            middle: (0.5 * size.x - view.project(Vec3::ZERO).x) / view.scale(),
        }
    }

    pub(super) fn seen(&self, view: &View, size: [usize; 2]) -> Canvas {
        // What nobody gives up is drawn to its end.
        let drawn: Result<_, Infallible> = self.seen_while(view, size, || Ok(()));
        drawn.unwrap_or_else(|never| match never {})
    }

    /// The same, unless whoever wants it has given it up; that is asked before each band.
    pub(super) fn seen_while<E>(
        &self,
        view: &View,
        size: [usize; 2],
        mut go_on: impl FnMut() -> Result<(), E>,
    ) -> Result<Canvas, E> {
        let [width, height] = size;
        let lawn = self.lawn(view, size);
        // A large picture is drawn in bands, since a sample takes far more than what is kept of it.
        let rows = (MOST_AT_ONCE / width.max(1)).clamp(1, height.max(1));
        let mut canvas = Canvas::new(width, height, Vec3::ZERO);
        for top in (0..height).step_by(rows) {
            go_on()?;
            let rows = rows.min(height - top);
            let view = view.below_row((top * SAMPLES) as f32);
            let band = self.scene.paint(&view, &lawn, width * SAMPLES, rows * SAMPLES);
            canvas.paste(&band.reduced(SAMPLES), 0, top);
        }
        Ok(canvas)
    }
}

fn samples([width, height]: [usize; 2]) -> Vec2 {
    Vec2::new((width * SAMPLES) as f32, (height * SAMPLES) as f32)
}

/// All corners of the plant and of what it stands on, but for the ground.
fn corners(meshes: &[(Skin, Painted)]) -> impl Iterator<Item = Vec3> + Clone {
    let standing = meshes.iter().filter(|(skin, _)| *skin != Skin::Ground);
    standing.flat_map(|(_, painted)| painted.mesh.positions.iter().copied())
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
    fn a_picture_in_bands_is_whole() {
        let plant = pole(6);
        let stage = Stage::of(&plant, &Style::default(), &Look::default());
        let view = stage.front([64, 48]);
        let whole = stage.seen(&view, [64, 48]);
        for top in [0, 16, 32] {
            let lawn = stage.lawn(&view, [64, 48]);
            let rows = view.below_row((top * SAMPLES) as f32);
            let band = stage.scene.paint(&rows, &lawn, 64 * SAMPLES, 16 * SAMPLES).reduced(SAMPLES);
            for (x, y) in (0..16).flat_map(|y| (0..64).map(move |x| (x, y))) {
                assert!((band.get(x, y) - whole.get(x, top + y)).length() < 0.02, "{x}, {}", top + y);
            }
        }
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
