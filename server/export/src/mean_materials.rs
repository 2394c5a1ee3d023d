//! Materials of formats that do not multiply a texture by the colours of vertices. Wood has the mean of these. Leaves,
//! flowers and fruits have a few materials that stand for all of their colours: each of them has its own texture, for not
//! all readers multiply a texture by a colour of the material either.

use std::{borrow::Cow, collections::BTreeMap, rc::Rc};

use espalier_mesh::TriangleMesh;
use glam::Vec3;
use serde_json::Value;

use crate::{
    ExportError,
    assembly::{Assembly, Block, Builder, Part, Scatter, Surface},
    shades::{Palette, Tally},
    surface::Texture,
};

/// Colours that stand for all leaves of a file.
const MOST_SHADES: usize = 6;

/// The materials that a file has used so far.
#[derive(Default)]
pub(crate) struct MeanMaterials {
    pub all: Vec<MeanMaterial>,
    /// The colours of what is thin, by the name of its surface.
    shades: BTreeMap<String, Palette>,
}

/// One material.
pub(crate) struct MeanMaterial {
    pub name: String,
    /// The name of the surface, which it may share with others.
    surface: String,
    /// What is multiplied by the mean colour, and how deep its relief is.
    pub texture: Option<(Rc<Texture>, f32)>,
    /// Whether the texture has nothing in places.
    pub is_cut_out: bool,
    sum: Vec3,
    count: usize,
}

impl MeanMaterials {
    /// With shades for all that is thin in an assembly.
    pub(crate) fn shaded(assembly: &Assembly<'_>) -> Result<Self, ExportError> {
        let mut counted = Counted::default();
        assembly.build(&mut counted)?;
        let shades = counted.0.into_iter().map(|(name, tally)| (name, tally.palette(MOST_SHADES)));
        Ok(Self { all: Vec::new(), shades: shades.collect() })
    }

    /// How many materials a surface has.
    pub(crate) fn shades(&self, surface: &Surface<'_>) -> usize {
        self.shades.get(surface.name()).map_or(1, |palette| palette.colours.len().max(1))
    }

    /// Which of its materials what has such a colour has.
    pub(crate) fn shade(&self, surface: &Surface<'_>, colour: Vec3) -> usize {
        self.shades.get(surface.name()).map_or(0, |palette| palette.of(colour))
    }

    /// The name of one of its materials.
    pub(crate) fn name<'a>(&self, surface: &Surface<'a>, shade: usize) -> Cow<'a, str> {
        let name = surface.name();
        if self.shades(surface) > 1 { format!("{name}_{}", shade + 1).into() } else { name.into() }
    }

    /// Counts the colours of vertices that have this surface.
    pub(crate) fn add(&mut self, surface: &Surface<'_>, block: &Block<'_>) {
        self.count(surface, block.colours.iter().sum(), block.colours.len());
    }

    /// Counts so many colours by their sum; what has shades has these.
    pub(crate) fn count(&mut self, surface: &Surface<'_>, sum: Vec3, count: usize) {
        let shades = self.shades.get(surface.name()).map_or(&[][..], |palette| &palette.colours[..]);
        let colours: Vec<(Vec3, usize)> = match surface {
            Surface::Plain(_, colour) => vec![(*colour, 1)],
            _ if shades.is_empty() => vec![(sum, count)],
            _ => shades.iter().map(|&shade| (shade, 1)).collect(),
        };
        let known = self.all.iter().position(|material| material.surface == surface.name());
        let first = known.unwrap_or(self.all.len());
        if known.is_none() {
            let texture = match surface {
                Surface::Plain(..) => None,
                Surface::Bark(bark, relief) => Some((Rc::new(bark.texture.clone()), *relief)),
                Surface::Thin(_, texture) => Some((Rc::new((*texture).clone()), 1.0)),
            };
            for shade in 0..colours.len() {
                self.all.push(MeanMaterial {
                    name: self.name(surface, shade).into_owned(),
                    surface: surface.name().to_owned(),
                    texture: texture.clone(),
                    is_cut_out: matches!(surface, Surface::Thin(..)),
                    sum: Vec3::ZERO,
                    count: 0,
                });
            }
        }
        let is_mean = matches!(surface, Surface::Bark(..)) || self.shades(surface) == 1;
        for (material, (sum, count)) in self.all[first..].iter_mut().zip(colours) {
            if is_mean && !matches!(surface, Surface::Plain(..)) {
                (material.sum, material.count) = (material.sum + sum, material.count + count);
            } else {
                (material.sum, material.count) = (sum, count);
            }
        }
    }
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
    /// Linear.
    pub(crate) fn mean(&self) -> Vec3 {
        self.sum / self.count.max(1) as f32
    }

    /// The mean of what is seen, linear.
    pub(crate) fn seen(&self) -> Vec3 {
        let texture = self.texture.as_ref().map(|(texture, _)| texture.as_ref());
        self.mean() * texture.map_or(Vec3::ONE, seen_of)
    }

    /// Its pictures, each with the end of its name; what it shares with others is theirs as well.
    pub(crate) fn pictures(&self) -> Vec<(String, Vec<u8>)> {
        let Some((texture, _)) = &self.texture else { return Vec::new() };
        let colour = (self.picture("colour"), texture.colour_png(self.mean()));
        let is_first = self.name == self.surface || self.name == format!("{}_1", self.surface);
        let normal = is_first.then(|| (self.picture("normal"), texture.normal_png()));
        let depth = texture.depth_png().filter(|_| is_first).map(|png| (self.picture("depth"), png));
        [colour].into_iter().chain(normal).chain(depth).collect()
    }

    /// The name of its picture of a kind.
    pub(crate) fn picture(&self, kind: &str) -> String {
        let of = if kind == "colour" { &self.name } else { &self.surface };
        format!("{}_{kind}.png", of.to_lowercase())
    }
}

/// The mean of what is there of a texture, linear.
pub(crate) fn seen_of(texture: &Texture) -> Vec3 {
    let inside = || texture.colours.iter().zip(&texture.cover).filter(|(_, cover)| **cover >= 128);
    let sum: Vec3 = inside().map(|(colour, _)| *colour).sum();
    sum / inside().count().max(1) as f32
}
