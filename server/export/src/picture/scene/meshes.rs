//! Meshes with colours and textures: wood in its bark, and what it bears.

use espalier_mesh::{Style, TriangleMesh, wood};
use espalier_plant::{MetamerId, Plant};
use espalier_settings::Appearance;
use glam::{Vec2, Vec3};

use crate::{
    foliage::{Foliage, cards::Cards, leaf_look::Shoot, living},
    surface::{
        Texture,
        bark::{Bark, CUT},
        thin::{self, Thin},
    },
};

/// A mesh with a colour at each corner, which multiplies that of a texture.
#[derive(Clone, Debug, Default)]
pub(super) struct Painted {
    pub(super) mesh: TriangleMesh,
    pub(super) colours: Vec<Vec3>,
    pub(super) texture: Option<Texture>,
}

impl Painted {
    /// Whether there is anything where each corner of a triangle has so much to say.
    pub(super) fn is_there(&self, corners: [u32; 3], weights: Vec3) -> bool {
        self.texture.as_ref().is_none_or(|texture| texture.is_there(self.uv(corners, weights)))
    }

    pub(super) fn uv(&self, corners: [u32; 3], weights: Vec3) -> Vec2 {
        let [a, b, c] = corners.map(|corner| self.mesh.uvs[corner as usize]);
        a * weights.x + b * weights.y + c * weights.z
    }
}

/// How a mesh answers to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Skin {
    Leaf,
    Bark,
    Glaze,
    Ground,
}

/// Wood in its bark, and the faces of cuts.
pub(super) fn wooden(plant: &Plant, style: &Style, look: &Appearance) -> Vec<(Skin, Painted)> {
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
pub(super) fn borne(plant: &Plant, style: &Style, look: &Appearance) -> Vec<(Skin, Painted)> {
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
