//! Materials of formats that do not multiply a texture by the colours of vertices: the texture is multiplied by the mean
//! of these, for not all readers multiply it by a colour of the material either.

use glam::Vec3;

use crate::{
    assembly::{Block, Surface},
    surface::Texture,
};

/// The materials that a file has used so far.
#[derive(Default)]
pub(crate) struct MeanMaterials(pub Vec<MeanMaterial>);

/// One material.
pub(crate) struct MeanMaterial {
    pub name: String,
    /// What is multiplied by the mean colour, and how deep its relief is.
    pub texture: Option<(Texture, f32)>,
    /// Whether the texture has nothing in places.
    pub is_cut_out: bool,
    sum: Vec3,
    count: usize,
}

impl MeanMaterials {
    /// Counts the colours of vertices that have this surface.
    pub(crate) fn add(&mut self, surface: &Surface<'_>, block: &Block<'_>) {
        self.count(surface, block.colours.iter().sum(), block.colours.len());
    }

    /// Counts so many colours by their sum.
    pub(crate) fn count(&mut self, surface: &Surface<'_>, sum: Vec3, count: usize) {
        let name = surface.name();
        let at = self.0.iter().position(|material| material.name == name).unwrap_or_else(|| {
            let (texture, is_cut_out) = match surface {
                Surface::Plain(..) => (None, false),
                Surface::Bark(bark, relief) => (Some((bark.texture.clone(), *relief)), false),
                Surface::Thin(_, texture) => (Some(((*texture).clone(), 1.0)), true),
            };
            self.0.push(MeanMaterial {
                name: name.to_owned(),
                texture,
                is_cut_out,
                sum: Vec3::ZERO,
                count: 0,
            });
            self.0.len() - 1
        });
        let material = &mut self.0[at];
        match surface {
            Surface::Plain(_, colour) => (material.sum, material.count) = (*colour, 1),
            _ => {
                material.sum += sum;
                material.count += count;
            }
        }
    }
}

impl MeanMaterial {
    /// Linear.
    pub(crate) fn mean(&self) -> Vec3 {
        self.sum / self.count.max(1) as f32
    }

    /// The mean of what is seen, linear.
    pub(crate) fn seen(&self) -> Vec3 {
        let Some((texture, _)) = &self.texture else { return self.mean() };
        let inside = || texture.colours.iter().zip(&texture.cover).filter(|(_, cover)| **cover >= 128);
        let sum: Vec3 = inside().map(|(colour, _)| *colour).sum();
        self.mean() * sum / inside().count().max(1) as f32
    }

    /// Its pictures, each with the end of its name.
    pub(crate) fn pictures(&self) -> Vec<(String, Vec<u8>)> {
        let Some((texture, _)) = &self.texture else { return Vec::new() };
        let depth = texture.depth_png().map(|png| (self.picture("depth"), png));
        let both = [
            (self.picture("colour"), texture.colour_png(self.mean())),
            (self.picture("normal"), texture.normal_png()),
        ];
        both.into_iter().chain(depth).collect()
    }

    /// The name of its picture of a kind.
    pub(crate) fn picture(&self, kind: &str) -> String {
        format!("{}_{kind}.png", self.name.to_lowercase())
    }
}
