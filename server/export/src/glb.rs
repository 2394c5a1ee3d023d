//! glTF 2.0 binary: each plant as a node with its wood, leaves, flowers and fruits, textured, in metres, Y up.

mod writer;

use std::collections::BTreeMap;

use espalier_mesh::{Style, seeds, wood};
use espalier_plant::{MetamerId, Plant};
use espalier_settings::{Appearance, ParameterValues};
use serde_json::{Value, json};

use self::writer::{Surface, Vertex, Writer};
use crate::{
    foliage::{Foliage, cards::Cards, living},
    surface::{
        bark::{Bark, CUT},
        thin::{self, Thin},
    },
};

/// Metamers whose leaves are made before they are written: so little is held beside the file itself.
const BLOCK: usize = 1024;

/// Why a plant could not be exported.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// Nothing can be that large or small.
    #[error("an internode cannot be {0} m long")]
    Scale(f32),
    /// The format counts bytes in 32 bits.
    #[error("the file would be larger than 4 GiB")]
    TooLarge,
    /// The plant is so large that a position in metres is infinite.
    #[error("the tree is too large to be measured in metres")]
    NotFinite,
}

/// What a file says about its plants.
#[derive(Clone, Debug)]
pub struct About<'a> {
    /// The program and its version.
    pub program: &'a str,
    /// The version of the simulation that grew them.
    pub simulation: u32,
    /// The name of the species, if it is known.
    pub species: Option<&'a str>,
    /// The seed of all randomness, if it is known.
    pub seed: Option<u32>,
    /// The parameters in force; the length of an internode makes metres.
    pub parameters: &'a ParameterValues,
    /// Who made them.
    pub author: Option<&'a str>,
    /// Under which licence they may be used.
    pub licence: Option<&'a str>,
}

impl About<'_> {
    fn extras(&self) -> Value {
        let Self { simulation, species, seed, parameters, author, licence, .. } = self;
        let all = json!({
            "simulation": simulation,
            "species": species,
            "seed": seed,
            "metres_per_internode": parameters.internode_length,
            "parameters": parameters,
            "author": author,
            "licence": licence,
        });
        let Value::Object(mut all) = all else { return all };
        all.retain(|_, value| !value.is_null());
        Value::Object(all)
    }

    fn copyright(&self) -> Option<String> {
        let said: Vec<&str> = [self.author, self.licence].into_iter().flatten().collect();
        (!said.is_empty()).then(|| said.join(", "))
    }
}

/// The present of `plant` as a glTF binary file. A plant without wood gives a valid file without meshes.
pub fn glb(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
) -> Result<Vec<u8>, ExportError> {
    let scale = about.parameters.internode_length;
    if !(scale.is_finite() && scale > 0.0) {
        return Err(ExportError::Scale(scale));
    }
    let mut writer = Writer::new(scale, about);
    let (bark, foliage) = (Bark::of(&appearance.bark), Foliage::of(plant, style, appearance));
    let mut of_seed: BTreeMap<MetamerId, Vec<MetamerId>> = BTreeMap::new();
    let seed_of = seeds(plant);
    for id in living(plant) {
        of_seed.entry(seed_of[id.index()]).or_default().push(id);
    }
    let [wood_surface, cut_surface] =
        [Surface::Bark(&bark, appearance.bark.relief), Surface::Plain("Cut", CUT)];
    let parts = [
        Some(("Leaves", thin::leaves(&appearance.leaves))),
        thin::flowers(&appearance.flowers).map(|thin| ("Flowers", thin)),
        thin::fruits(&appearance.fruits).map(|thin| ("Fruits", thin)),
    ];
    let mut wood = wood(plant, style, &appearance.bark).into_iter().peekable();
    let seeds: Vec<MetamerId> = (0..plant.metamer_count())
        .map(MetamerId::new)
        .filter(|&id| plant.is_seed(id) && plant.is_alive(id))
        .collect();
    for (number, &seed) in (1..).zip(&seeds) {
        let species = about.species.unwrap_or("Tree");
        let name = if seeds.len() == 1 { species.to_owned() } else { format!("{species} {number}") };
        let ids = of_seed.get(&seed).map_or(&[][..], Vec::as_slice);
        let extras = json!({ "row": seed.raw(), "metamers": ids.len() });
        writer.begin_plant(name, plant.metamers().end(seed), extras);
        let Some(wood) = wood.next_if(|wood| wood.seed == seed) else { continue };
        let mut part = writer.begin_part();
        for (vertex, &place) in wood.surface.positions.iter().enumerate() {
            let (normal, tangent, uv) =
                (wood.surface.normals[vertex], wood.tangents[vertex], wood.surface.uvs[vertex]);
            part.vertex(Vertex { place, normal, tangent, uv, colour: bark.tint(wood.radii[vertex]) });
        }
        part.finish("Wood", &[(&wood.surface.indices, wood_surface), (&wood.cuts, cut_surface)])?;
        drop(wood);
        for (name, thin) in parts.iter().flatten() {
            add_cards(&mut writer, name, thin, ids, |cards, id| match *name {
                "Leaves" => foliage.add_leaves(cards, id),
                "Flowers" => foliage.add_flowers(cards, id),
                _ => foliage.add_fruits(cards, id),
            })?;
        }
    }
    writer.finish()
}

fn add_cards(
    writer: &mut Writer,
    name: &'static str,
    thin: &Thin,
    ids: &[MetamerId],
    add: impl Fn(&mut Cards, MetamerId),
) -> Result<(), ExportError> {
    let (mut part, mut cards, mut indices) = (writer.begin_part(), Cards::default(), Vec::new());
    for block in ids.chunks(BLOCK) {
        for &id in block {
            add(&mut cards, id);
        }
        let first = part.count();
        indices.extend(cards.mesh.indices.iter().map(|&index| first + index));
        for (vertex, &place) in cards.mesh.positions.iter().enumerate() {
            let (normal, tangent, uv) =
                (cards.mesh.normals[vertex], cards.tangents[vertex], cards.mesh.uvs[vertex]);
            part.vertex(Vertex { place, normal, tangent, uv, colour: cards.hues[vertex] * thin.strength });
        }
        cards.clear();
    }
    part.finish(name, &[(&indices, Surface::Thin(name, &thin.texture))])
}
