//! Pivot Painter 2 for Unreal: a mesh whose vertices each know their element, and two textures with a texel for each
//! element, from which shaders turn limbs about where they begin. See `docs/formats.md`.

use espalier_mesh::Style;
use espalier_motion::{Limbs, NONE};
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::{Vec2, Vec3};
use half::f16;

use crate::{About, ExportError, Model, Sink, exr, glb::Source, in_memory, png, swaying::Swaying, zip::Zip};

/// Elements lie at most so deep: shaders of the engine go up as many levels.
const LEVELS: u32 = 4;
/// The most elements: what is added to a number so that its bits are a plain 16-bit float, and the first that is none.
const BIAS: u16 = 1024;
const MOST: usize = 0x7c00 - BIAS as usize;
/// Centimetres of a metre, and of a step in which lengths are told.
const CENTIMETRES: f32 = 100.0;
const STEP: f32 = 8.0;
const STEPS: f32 = 256.0;

/// What turns by itself: limbs down to a level, each with all that it bears beyond.
pub(crate) struct Elements {
    /// The element of each row; none for what is no wood.
    of_row: Vec<u32>,
    all: Vec<Element>,
    /// Texels of a texture across and down.
    size: [usize; 2],
}

/// One of them, in the axes and units of the engine.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Element {
    /// The one that bears it; itself where it grows from the ground.
    parent: u16,
    pivot: Vec3,
    /// The unit vector from its base to its tip.
    way: Vec3,
    /// How far it reaches along that.
    reach: f32,
}

impl Elements {
    fn of(swaying: &Swaying) -> Self {
        let (limbs, wood) = (&swaying.limbs, &swaying.wood);
        let deepest = (0..LEVELS).rev().find(|&level| count(limbs, level) <= MOST).unwrap_or_default();
        let mut of_limb: Vec<u32> = Vec::with_capacity(limbs.all().len());
        let mut all = Vec::new();
        for (number, limb) in limbs.all().iter().enumerate() {
            let bearer = limb.bearer.map(|bearer| of_limb[bearer as usize]);
            if let Some(bearer) = bearer.filter(|_| limb.level > deepest) {
                of_limb.push(bearer);
                continue;
            }
            // Beyond what can be told, everything goes along with the last.
            let own = all.len().min(MOST - 1) as u32;
            of_limb.push(own);
            if all.len() == MOST {
                continue;
            }
            let place = |row: u32| unreal(wood.place(row).as_vec3());
            let (pivot, rows) = (place(limb.node), limbs.rows(number as u32));
            let tip = rows.last().map_or(pivot, |&row| place(row));
            let way = (tip - pivot).try_normalize().unwrap_or(Vec3::Z);
            let reach = rows.iter().map(|&row| (place(row) - pivot).dot(way)).fold(0.0, f32::max);
            all.push(Element { parent: bearer.unwrap_or(own) as u16, pivot, way, reach });
        }
        let of_row = (0..wood.len() as u32)
            .map(|row| limbs.limb(row).map_or(NONE, |limb| of_limb[limb as usize]))
            .collect();
        let across = (1..).find(|side| side * side >= all.len()).unwrap_or(1);
        Self { of_row, size: [across, all.len().div_ceil(across).max(1)], all }
    }

    /// The middle of the texel of what a row belongs to, upwards.
    pub(crate) fn texel(&self, row: u32) -> Vec2 {
        let element = self.of_row.get(row as usize).copied().filter(|&element| element != NONE);
        let element = element.unwrap_or_default() as usize;
        let [across, down] = self.size;
        let (x, y) = (element % across, element / across);
        Vec2::new((x as f32 + 0.5) / across as f32, 1.0 - (y as f32 + 0.5) / down as f32)
    }

    /// Pivots and bearers, in 16-bit floats.
    fn pivots(&self) -> Vec<u8> {
        let pixel = |element: &Element| {
            let [x, y, z] = element.pivot.to_array().map(|part| f16::from_f32(part).to_bits());
            [x, y, z, BIAS + element.parent]
        };
        exr::halves(self.size[0], &self.filled(pixel, [0, 0, 0, BIAS]))
    }

    /// Ways and reaches, in bytes.
    fn ways(&self) -> Vec<u8> {
        let pixel = |element: &Element| {
            let [x, y, z] = element.way.to_array().map(|part| (127.5 * (part + 1.0)).round() as u8);
            let steps = (element.reach / STEP).round().clamp(1.0, STEPS);
            [x, y, z, (255.0 * steps / STEPS).round() as u8]
        };
        png::rgba(self.size, &self.filled(pixel, [0; 4]))
    }

    /// A texel for each element, and texels that belong to none at the end.
    fn filled<T: Copy>(&self, pixel: impl Fn(&Element) -> T, none: T) -> Vec<T> {
        let mut pixels: Vec<T> = self.all.iter().map(pixel).collect();
        pixels.resize(self.size[0] * self.size[1], none);
        pixels
    }
}

/// How many limbs lie no deeper than a level.
fn count(limbs: &Limbs, deepest: u32) -> usize {
    limbs.all().iter().filter(|limb| limb.level <= deepest).count()
}

/// A place in metres, Y up and right-handed, as the engine has it: in centimetres, Z up and left-handed.
fn unreal(place: Vec3) -> Vec3 {
    CENTIMETRES * Vec3::new(place.x, place.z, place.y)
}

/// The present of `plant` as a ZIP file of a glTF model, whose second places are those of elements, and their textures.
/// The model is made in memory.
///
/// # Errors
/// Where an internode cannot be as long as `about` says, the plant is too large, or the file cannot be written.
pub fn pivots(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let swaying = Swaying::of(plant, style, &appearance.wind, about.scale()?, about.obstacles);
    let elements = Elements::of(&swaying);
    if elements.all.iter().any(|element| !element.pivot.is_finite()) {
        return Err(ExportError::NotFinite);
    }
    let mut zip = Zip::new(out);
    let source = Source { plant, style, appearance, about, model };
    let file = in_memory(|out| source.write(Some(&swaying), Some(&elements), out))?;
    zip.add("tree.glb", |out| Ok(out.write_all(&file)?))?;
    drop(file);
    zip.add("tree_pivot_index.exr", |out| Ok(out.write_all(&elements.pivots())?))?;
    zip.add("tree_xvector_extent.png", |out| Ok(out.write_all(&elements.ways())?))?;
    zip.finish()
}
