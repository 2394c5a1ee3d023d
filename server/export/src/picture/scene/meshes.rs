//! Meshes with colours and textures: wood in its bark, and what it bears.

use std::collections::BTreeMap;

use espalier_mesh::{Bodies, Grain, Style, TriangleMesh, Wood};
use espalier_plant::{MetamerId, Plant};
use espalier_settings::Appearance;
use glam::{Vec2, Vec3};

use crate::{
    foliage::{
        Foliage,
        cards::{Cards, Grid},
        leaf_look::Shoot,
        living,
    },
    picture::swaying::Posed,
    surface::{
        Texture,
        bark::{Bark, CUT},
        thin::{self, Thin},
    },
    swaying::{Rider, Swaying},
};

/// A mesh with a colour at each corner, which multiplies that of a texture.
#[derive(Clone, Debug, Default)]
pub(super) struct Painted {
    pub(super) mesh: TriangleMesh,
    pub(super) colours: Vec<Vec3>,
    pub(super) texture: Option<Texture>,
    /// What its corners go along with in the wind; none where nothing sways.
    pub(super) riders: Vec<Rider>,
    /// The cards of which it is made; none of wood.
    pub(super) grids: Vec<Grid>,
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

/// All that a plant shows.
pub(in crate::picture) struct Meshes(pub(super) Vec<(Skin, Painted)>);

impl Meshes {
    /// With what its corners go along with, where it sways.
    pub(in crate::picture) fn of(
        plant: &Plant,
        style: &Style,
        look: &Appearance,
        motion: Option<&Swaying>,
    ) -> Self {
        let bodies = Bodies::of(plant, style, &look.bark, Grain::default());
        let mut meshes = wooden(&bodies, style, look, motion);
        meshes.extend(borne(plant, style, look, &bodies));
        Self(meshes)
    }

    /// The same as it stands at a moment.
    pub(in crate::picture) fn moved(&self, posed: &Posed<'_>) -> Self {
        let moved = |(skin, painted): &(Skin, Painted)| {
            let mut painted = painted.clone();
            let Painted { mesh, riders, grids, .. } = &mut painted;
            for (at, &rider) in riders.iter().enumerate() {
                let (place, turn) = posed.moved(rider, mesh.positions[at]);
                mesh.positions[at] = place;
                mesh.normals[at] = turn * mesh.normals[at];
            }
            for grid in grids {
                let (Some(stalk), Some(&rider)) = (grid.stalk, riders.get(grid.first as usize)) else {
                    continue;
                };
                let (base, turn) = posed.fluttered(rider, &stalk);
                for at in grid.vertices() {
                    mesh.positions[at] = base + turn * (mesh.positions[at] - base);
                    mesh.normals[at] = turn * mesh.normals[at];
                }
            }
            (*skin, painted)
        };
        Self(self.0.iter().map(moved).collect())
    }

    /// All its corners.
    pub(in crate::picture) fn corners(&self) -> Vec<Vec3> {
        self.0.iter().flat_map(|(_, painted)| painted.mesh.positions.iter().copied()).collect()
    }
}

/// Wood in its bark, and the faces of cuts.
fn wooden(
    bodies: &Bodies,
    style: &Style,
    look: &Appearance,
    motion: Option<&Swaying>,
) -> Vec<(Skin, Painted)> {
    let bark = Bark::of(&look.bark, style.dyes().greatest_of_bark());
    let mut meshes = Vec::new();
    let mut plants: BTreeMap<MetamerId, (Wood, Vec<Rider>)> = BTreeMap::new();
    for body in bodies.iter() {
        let seed = body.seed();
        let (wood, riders) = plants.entry(seed).or_insert_with(|| (Wood::of(seed), Vec::new()));
        let first = wood.surface.positions.len();
        body.sweep(wood);
        if let Some(motion) = motion {
            riders.extend(motion.along(&body, &wood.surface.positions[first..]));
        }
    }
    for (wood, riders) in plants.into_values() {
        let colours = bark.tints(&wood, style.dyes()).collect();
        meshes.push((Skin::Bark, cuts(&wood, &riders)));
        let texture = Some(bark.texture.clone());
        meshes
            .push((Skin::Bark, Painted { mesh: wood.surface, colours, texture, riders, grids: Vec::new() }));
    }
    meshes
}

/// The faces of cuts, with the corners that they have.
fn cuts(wood: &Wood, riders: &[Rider]) -> Painted {
    let mut cuts = Painted::default();
    let mut numbers = BTreeMap::new();
    for &corner in &wood.cuts {
        let next = numbers.len() as u32;
        let number = *numbers.entry(corner).or_insert(next);
        if number == next {
            let (at, surface) = (corner as usize, &wood.surface);
            cuts.mesh.vertex(surface.positions[at], surface.normals[at], surface.uvs[at]);
            cuts.colours.push(CUT);
            cuts.riders.extend(riders.get(at));
        }
        cuts.mesh.indices.push(number);
    }
    cuts
}

/// Leaves, flowers and fruits.
fn borne(plant: &Plant, style: &Style, look: &Appearance, bodies: &Bodies) -> Vec<(Skin, Painted)> {
    let foliage = Foliage::of(plant, style, look, 0).upon(bodies);
    let painted = |thin: Thin, add: &dyn Fn(&mut Cards, MetamerId)| {
        let mut cards = Cards::default();
        for id in living(plant) {
            let first = cards.hues.len();
            add(&mut cards, id);
            cards.ride_on(id);
            // The shadows of the simulation are soft: deep in a crown there is little of the sky.
            let sky = 0.62 + 0.38 * Shoot::of(plant, id).light;
            for hue in &mut cards.hues[first..] {
                *hue *= thin.strength * sky;
            }
        }
        let Cards { mesh, hues: colours, riders, grids, .. } = cards;
        (Skin::Leaf, Painted { mesh, colours, texture: Some(thin.texture), riders, grids })
    };
    let mut meshes = vec![painted(thin::leaves(&look.leaves), &|cards, id| foliage.add_leaves(cards, id))];
    let look = foliage.look();
    let flowers = thin::flowers(&look.flowers);
    meshes.extend(flowers.map(|thin| painted(thin, &|cards, id| foliage.add_flowers(cards, id))));
    let fruits = thin::fruits(&look.fruits);
    meshes.extend(fruits.map(|thin| painted(thin, &|cards, id| foliage.add_fruits(cards, id))));
    meshes
}
