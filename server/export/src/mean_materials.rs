//! Materials of formats that do not multiply a texture by the colours of vertices. Wood has the mean of these. Leaves,
//! flowers and fruits have colours that stand for all of theirs: a texture is there once in each, in cells of one picture
//! where pictures are written, for not all readers multiply a texture by a colour of the material either.

use std::{borrow::Cow, collections::BTreeMap, rc::Rc};

use espalier_mesh::TriangleMesh;
use glam::{Vec2, Vec3};
use serde_json::Value;

use crate::{
    ExportError,
    assembly::{Assembly, Block, Builder, Part, Scatter, Surface},
    shades::{Palette, Tally},
    surface::{Cells, Texture},
};

/// Colours of what is thin where each is a cell of a picture: a step from one to the next is then hardly seen.
const CELLS: usize = 64;
/// The same where each form of a leaf is a mesh of its own in each of them.
const CELLS_OF_FORMS: usize = 16;
/// The same where each is a material.
const MATERIALS: usize = 6;
/// Steps of a place in a picture of cells from one side to the other: numbers with few digits make small files.
const PLACES: f32 = 1e4;

/// How colours of what is thin are told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Telling {
    /// By cells of one picture.
    Cells,
    /// The same, with a mesh for each form of a leaf in each colour.
    CellsOfForms,
    /// By materials, without pictures.
    Materials,
}

/// The materials that a file has used so far.
pub(crate) struct MeanMaterials {
    pub all: Vec<MeanMaterial>,
    telling: Telling,
    /// The colours of what is thin, by the name of its surface.
    palettes: BTreeMap<String, Palette>,
}

/// One material.
pub(crate) struct MeanMaterial {
    pub name: String,
    /// The name of the surface, which it may share with others.
    surface: String,
    /// What is multiplied by its colours, and how deep its relief is.
    pub texture: Option<(Rc<Texture>, f32)>,
    /// Whether the texture has nothing in places.
    pub is_cut_out: bool,
    /// Colours that it has, linear; none where it has the mean of what was counted.
    tints: Vec<Vec3>,
    sum: Vec3,
    count: usize,
}

impl MeanMaterials {
    /// With colours for all that is thin in an assembly.
    pub(crate) fn of(assembly: &Assembly<'_>, telling: Telling) -> Result<Self, ExportError> {
        let mut counted = Counted::default();
        assembly.build(&mut counted)?;
        let most = match telling {
            Telling::Cells => CELLS,
            Telling::CellsOfForms => CELLS_OF_FORMS,
            Telling::Materials => MATERIALS,
        };
        let palettes = counted.0.into_iter().map(|(name, tally)| (name, tally.palette(most))).collect();
        Ok(Self { all: Vec::new(), telling, palettes })
    }

    fn palette(&self, surface: &Surface<'_>) -> &[Vec3] {
        self.palettes.get(surface.name()).map_or(&[], |palette| &palette.colours)
    }

    /// How many colours a surface has.
    pub(crate) fn shades(&self, surface: &Surface<'_>) -> usize {
        self.palette(surface).len().max(1)
    }

    /// Which of them stands for a colour.
    pub(crate) fn shade(&self, surface: &Surface<'_>, colour: Vec3) -> usize {
        self.palettes.get(surface.name()).map_or(0, |palette| palette.of(colour))
    }

    /// How many materials a surface has.
    pub(crate) fn materials(&self, surface: &Surface<'_>) -> usize {
        if self.telling == Telling::Materials { self.shades(surface) } else { 1 }
    }

    /// The name of the material that shows one of its colours.
    pub(crate) fn name<'a>(&self, surface: &Surface<'a>, shade: usize) -> Cow<'a, str> {
        let name = surface.name();
        if self.materials(surface) > 1 { format!("{name}_{}", shade + 1).into() } else { name.into() }
    }

    /// Where in the picture of its material a place of its texture is, in one of its colours.
    pub(crate) fn place(&self, surface: &Surface<'_>, shade: usize, at: Vec2) -> Vec2 {
        if self.materials(surface) > 1 || self.shades(surface) == 1 {
            return at;
        }
        let [across, up] = cells(self.shades(surface));
        let vector = |x: usize, y: usize| Vec2::new(x as f32, y as f32);
        let place = (vector(shade % across, shade / across) + at) / vector(across, up);
        (place * PLACES).round() / PLACES
    }

    /// Counts the colours of vertices that have this surface.
    pub(crate) fn add(&mut self, surface: &Surface<'_>, block: &Block<'_>) {
        self.count(surface, block.colours.iter().sum(), block.colours.len());
    }

    /// Counts so many colours by their sum.
    pub(crate) fn count(&mut self, surface: &Surface<'_>, sum: Vec3, count: usize) {
        let known = self.all.iter().position(|material| material.surface == surface.name());
        let first = known.unwrap_or(self.all.len());
        if known.is_none() {
            self.begin(surface);
        }
        let material = &mut self.all[first];
        (material.sum, material.count) = (material.sum + sum, material.count + count);
    }

    fn begin(&mut self, surface: &Surface<'_>) {
        let texture = match surface {
            Surface::Plain(..) => None,
            Surface::Bark(bark, relief) => Some((Rc::new(bark.texture.clone()), *relief)),
            Surface::Thin(_, texture) => Some((Rc::new((*texture).clone()), 1.0)),
        };
        let palette = self.palette(surface);
        let tints: Vec<Vec<Vec3>> = match surface {
            Surface::Plain(_, colour) => vec![vec![*colour]],
            _ if self.materials(surface) > 1 => palette.iter().map(|&tint| vec![tint]).collect(),
            _ => vec![palette.to_vec()],
        };
        let materials = tints.into_iter().enumerate().map(|(shade, tints)| MeanMaterial {
            name: self.name(surface, shade).into_owned(),
            surface: surface.name().to_owned(),
            texture: texture.clone(),
            is_cut_out: matches!(surface, Surface::Thin(..)),
            tints,
            sum: Vec3::ZERO,
            count: 0,
        });
        let materials: Vec<_> = materials.collect();
        self.all.extend(materials);
    }
}

/// How many cells across and up a picture has in which a texture is once in each of so many colours.
fn cells(count: usize) -> Cells {
    let across = (1..).find(|side| side * side >= count).unwrap_or(1);
    [across, count.div_ceil(across)]
}

/// What is thin and its colours.
#[derive(Default)]
struct Counted(BTreeMap<String, Tally>);

impl Counted {
    fn of(&mut self, surface: &Surface<'_>) -> &mut Tally {
        self.0.entry(surface.name().to_owned()).or_insert_with(Tally::new)
    }
}

impl Builder<'_> for Counted {
    fn begin(&mut self, _: &str, _: Vec3, _: Option<Value>) -> Result<(), ExportError> {
        Ok(())
    }

    fn end(&mut self) -> Result<(), ExportError> {
        Ok(())
    }

    fn part(&mut self, part: &Part<'_>) -> Result<(), ExportError> {
        let [surface @ Surface::Thin(..)] = part.surfaces else { return Ok(()) };
        let tally = self.of(surface);
        (part.blocks)(&mut |block| {
            block.colours.iter().for_each(|&colour| tally.add(colour));
            Ok(())
        })
    }

    fn scatter(&mut self, scatter: &Scatter<'_>) -> Result<(), ExportError> {
        let tally = self.of(&scatter.surface);
        (scatter.each)(&mut |(_, hue)| {
            tally.add(hue * scatter.strength);
            Ok(())
        })
    }

    fn hull(&mut self, _: &str, _: &TriangleMesh) -> Result<(), ExportError> {
        Ok(())
    }
}

impl MeanMaterial {
    /// Its colours, linear.
    fn tints(&self) -> Vec<Vec3> {
        if self.tints.is_empty() { vec![self.sum / self.count.max(1) as f32] } else { self.tints.clone() }
    }

    /// Their mean.
    pub(crate) fn mean(&self) -> Vec3 {
        let tints = self.tints();
        tints.iter().sum::<Vec3>() / tints.len() as f32
    }

    /// The mean of what is seen, linear.
    pub(crate) fn seen(&self) -> Vec3 {
        let texture = self.texture.as_ref().map(|(texture, _)| texture.as_ref());
        self.mean() * texture.map_or(Vec3::ONE, seen_of)
    }

    /// How often its texture stands side by side and one above the other in the picture of its colours.
    pub(crate) fn cells(&self) -> Cells {
        cells(self.tints.len().max(1))
    }

    /// Its pictures, each with the end of its name; what it shares with others is theirs as well.
    pub(crate) fn pictures(&self) -> Vec<(String, Vec<u8>)> {
        let Some((texture, _)) = &self.texture else { return Vec::new() };
        let colour = (self.picture("colour"), texture.colour_png(&self.tints(), self.cells()));
        let is_first = self.name == self.surface || self.name == format!("{}_1", self.surface);
        let normal = is_first.then(|| (self.picture("normal"), texture.normal_png()));
        let depth = texture.depth_png().filter(|_| is_first).map(|png| (self.picture("depth"), png));
        [colour].into_iter().chain(normal).chain(depth).collect()
    }

    /// The name of its picture of a kind.
    pub(crate) fn picture(&self, kind: &str) -> String {
        format!("{}_{kind}.png", self.surface.to_lowercase())
    }
}

/// The mean of what is there of a texture, linear.
pub(crate) fn seen_of(texture: &Texture) -> Vec3 {
    let inside = || texture.colours.iter().zip(&texture.cover).filter(|(_, cover)| **cover >= 128);
    let sum: Vec3 = inside().map(|(colour, _)| *colour).sum();
    sum / inside().count().max(1) as f32
}
