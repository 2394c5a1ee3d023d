//! Files are what their formats say, for any plant.

mod frequencies;
mod lightmap;
mod models;
mod pivots;
mod reader;
mod saplings;
mod scenes;
mod shades;
mod species;
mod structure;
mod swaying;
mod wind_weights;

use espalier_export::{About, ExportError, Model, in_memory};
use espalier_mesh::{Style, StyleOptions, leaves, wood};
use espalier_plant::{Internode, MetamerId, Plant};
use espalier_settings::{
    Appearance, FlowerKind, FlowerLook, FruitKind, FruitLook, LeafKind, ParameterValues, Place,
};
use glam::Vec3;
use proptest::prelude::*;
use serde_json::Value;

const METRES: f32 = 0.1;

fn style() -> Style {
    Style::new(StyleOptions { girth_exponent: 2.0, twig_diameter: 0.1, leaves_per_node: 2, leaf_size: 0.5 })
}

fn looks() -> Appearance {
    Appearance::default()
}

/// A file of plants whose internodes are so long.
fn glb(plant: &Plant, style: &Style, looks: &Appearance, metres: f32) -> Result<Vec<u8>, ExportError> {
    model(plant, style, looks, metres, &Model::default())
}

/// The same with options.
fn model(
    plant: &Plant,
    style: &Style,
    looks: &Appearance,
    metres: f32,
    model: &Model,
) -> Result<Vec<u8>, ExportError> {
    let parameters = ParameterValues { internode_length: metres, ..ParameterValues::default() };
    let about = About {
        program: "Espalier",
        simulation: 1,
        species: None,
        seed: Some(7),
        parameters: &parameters,
        obstacles: &[],
        author: Some("Ada"),
        licence: Some("CC-BY-4.0"),
    };
    in_memory(|out| espalier_export::glb(plant, style, looks, &about, model, out))
}

/// Whether places or directions are the same but for rounding.
fn are_near(found: &[Vec3], wanted: impl ExactSizeIterator<Item = Vec3>) -> bool {
    found.len() == wanted.len()
        && found
            .iter()
            .zip(wanted)
            .all(|(&found, wanted)| found.distance(wanted) < 1e-4 * wanted.length().max(1.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_plant_is_a_valid_glb(growth in saplings::growth(), metres in 0.005f32..1.0) {
        let (plant, style) = (saplings::grown(&growth), style());
        let file = glb(&plant, &style, &looks(), metres).expect("it exports");
        let meshes = reader::read(&file);
        let bark: Vec<_> = wood(&plant, &style, &looks().bark);
        let ids = (0..plant.metamer_count()).map(MetamerId::new);
        let leaves = ids.flat_map(|id| leaves::of(&plant, id, &style)).count();
        let kinds: Vec<_> = meshes.iter().map(|mesh| mesh.name.as_str()).collect();
        let wanted = [(!bark.is_empty()).then_some("Wood"), (leaves > 0).then_some("Leaves")];
        prop_assert_eq!(kinds, wanted.into_iter().flatten().collect::<Vec<_>>());
        for (read, source) in meshes.iter().zip(&bark) {
            let surface = &source.surface;
            prop_assert!(read.indices.iter().copied().eq(source.triangles().flatten()));
            let scaled = surface.positions.iter().map(|&position| position * metres);
            prop_assert!(are_near(&read.normals, surface.normals.iter().copied()));
            prop_assert!(are_near(&read.positions, scaled));
            let (uvs, tangents) = (surface.uvs.iter(), source.tangents.iter());
            prop_assert!(read.uvs.iter().zip(uvs).all(|(read, uv)| read.x == uv.x && read.y == 1.0 - uv.y));
            prop_assert!(read.tangents.iter().zip(tangents).all(|(read, tangent)| read == tangent));
        }
        if let Some(mesh) = meshes.iter().find(|mesh| mesh.name == "Leaves") {
            // In summer all hang, each with as many vertices.
            prop_assert_eq!(mesh.positions.len() % leaves, 0);
        }
        prop_assert_eq!(file, glb(&plant, &style, &looks(), metres).expect("it exports again"));
    }
}

#[test]
fn seed_alone_gives_a_valid_file_without_meshes() {
    let file = glb(&Plant::new(Vec3::ZERO), &style(), &looks(), METRES).expect("it exports");
    assert!(reader::read(&file).is_empty());
}

#[test]
fn bare_tree_has_no_leaves() {
    let bare = Style::new(StyleOptions { leaves_per_node: 0, ..*style().options() });
    let meshes = reader::read(&glb(&saplings::fork(), &bare, &looks(), METRES).expect("it exports"));
    assert_eq!(meshes.iter().map(|mesh| mesh.name.as_str()).collect::<Vec<_>>(), ["Wood"]);
}

#[test]
fn many_vertices_get_wide_indices() {
    // The reader checks the width; this is about eight vertices an internode and six a leaf.
    let meshes = reader::read(&glb(&saplings::pole(12_000), &style(), &looks(), METRES).expect("it exports"));
    assert!(meshes.iter().all(|mesh| mesh.positions.len() > 65_535));
}

#[test]
fn internode_is_as_long_as_told() {
    let meshes = reader::read(&glb(&saplings::fork(), &style(), &looks(), 0.25).expect("it exports"));
    let top = meshes[0].positions.iter().map(|position| position.y).fold(0.0, f32::max);
    // Two internodes and the cone at the tip: 0.45 of a twig's radius of 0.05.
    assert!((top - 0.25 * (2.0 + 0.45 * 0.05)).abs() < 1e-6, "{top}");
}

#[test]
fn a_stub_is_as_wide_as_its_constraint() {
    let mut plant = saplings::fork();
    plant.begin_edit();
    plant.set_width(MetamerId::new(1), Some(0.5));
    plant.prune(&[MetamerId::new(2)]);
    plant.prune(&[MetamerId::new(4)]);
    plant.end_step();
    assert!(structure::radius_of(&plant, 1).is_some_and(|radius| (radius - 0.025).abs() < 1e-8));
    let meshes = reader::read(&glb(&plant, &style(), &looks(), METRES).expect("it exports"));
    let top = meshes[0].positions.iter().filter(|position| (position.y - METRES).abs() < 1e-6);
    let widest = top.map(|position| position.with_y(0.0).length()).fold(0.0, f32::max);
    // The flare of the roots is gone but for two hundredths.
    assert!((widest - 0.25 * METRES).abs() < 0.02 * METRES, "{widest}");
}

#[test]
fn given_radii_are_exported() {
    let mut plant = saplings::fork();
    plant.begin_edit();
    plant.give_radii(&[(MetamerId::new(1), Some(0.25))]).expect("living wood");
    plant.prune(&[MetamerId::new(2), MetamerId::new(4)]);
    plant.end_step();
    assert!(structure::radius_of(&plant, 1).is_some_and(|radius| (radius - 0.025).abs() < 1e-8));
    let meshes = reader::read(&glb(&plant, &style(), &looks(), METRES).expect("it exports"));
    let top = meshes[0].positions.iter().filter(|position| (position.y - METRES).abs() < 1e-6);
    let widest = top.map(|position| position.with_y(0.0).length()).fold(0.0, f32::max);
    assert!((widest - 0.25 * METRES).abs() < 0.02 * METRES, "{widest}");
}

/// What a file says in JSON.
fn root(file: &[u8]) -> Value {
    let length = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    serde_json::from_slice(&file[20..20 + length]).expect("it is JSON")
}

#[test]
fn a_file_says_where_it_comes_from() {
    let file = glb(&saplings::fork(), &style(), &looks(), 0.25).expect("it exports");
    let asset = &root(&file)["asset"];
    assert_eq!(asset["copyright"], "Ada, CC-BY-4.0");
    let extras = &asset["extras"];
    assert_eq!((extras["simulation"].as_u64(), extras["seed"].as_u64()), (Some(1), Some(7)));
    assert_eq!((&extras["author"], &extras["licence"]), (&"Ada".into(), &"CC-BY-4.0".into()));
    assert_eq!(extras["metres_per_internode"].as_f64(), Some(0.25));
    assert_eq!(extras["parameters"]["internode_length"].as_f64(), Some(0.25));
    assert!(extras.get("species").is_none(), "nobody has said it");
}

#[test]
fn each_plant_is_a_node_at_its_seed() {
    let mut plant = saplings::pole(3);
    plant.begin_step();
    let axis = plant.sow(Vec3::new(4.0, 0.0, 2.0));
    plant.end_step();
    plant.begin_step();
    let end = Vec3::new(4.0, 1.0, 2.0);
    plant.extend(axis, &Internode { end, normal: Vec3::X, laterals: &[] });
    plant.end_step();
    let file = glb(&plant, &style(), &looks(), 0.5).expect("it exports");
    let root = root(&file);
    let nodes = root["scenes"][0]["nodes"].as_array().expect("nodes");
    let named: Vec<_> =
        nodes.iter().map(|at| &root["nodes"][at.as_u64().expect("an index") as usize]).collect();
    assert_eq!(named.iter().map(|node| &node["name"]).collect::<Vec<_>>(), ["Tree 1", "Tree 2"]);
    assert_eq!(named[1]["translation"], serde_json::json!([2.0, 0.0, 1.0]));
    assert_eq!(named[1]["extras"]["metamers"], 1);
    let meshes = reader::read(&file);
    assert_eq!(meshes.len(), 4);
    // Vertices are measured from the seed.
    assert!(meshes[2].positions.iter().all(|place| place.with_y(0.0).length() < 0.1));
}

/// The mean colour that a mesh shows, linear: of its vertices times its texture.
fn mean_colour(mesh: &reader::ReadMesh) -> Vec3 {
    mesh.colours.iter().sum::<Vec3>() / mesh.colours.len() as f32 * mesh.texture_mean
}

#[test]
fn plants_have_the_colours_of_the_looks() {
    let meshes = |looks: &Appearance| {
        reader::read(&glb(&saplings::pole(40), &style(), looks, METRES).expect("it exports"))
    };
    let mut looks = looks().leafy(LeafKind::Round, [0, 0, 255]).turned(0.0, 1.0, 0.0);
    looks.bark.tint = [255, 0, 0];
    let [wood, leaves] = &meshes(&looks)[..] else { panic!("two meshes") };
    let [wood, leaves] = [wood, leaves].map(mean_colour);
    assert!(wood.x > 2.0 * wood.z, "{wood}");
    assert!(leaves.z > 0.4 && leaves.x < 0.1, "{leaves}");
}

#[test]
fn each_leaf_has_a_colour_of_its_own() {
    let meshes = reader::read(&glb(&saplings::pole(40), &style(), &looks(), METRES).expect("it exports"));
    let colours: Vec<_> =
        meshes[1].colours.iter().map(|colour| colour.to_array().map(f32::to_bits)).collect();
    let distinct: std::collections::BTreeSet<_> = colours.iter().collect();
    assert!(distinct.len() > 30, "{}", distinct.len());
}

#[test]
fn flowers_and_fruits_are_exported() {
    let mut looks = looks();
    looks.flowers =
        FlowerLook { kind: FlowerKind::Rosette, share: 1.0, place: Place::Twigs, ..looks.flowers };
    for &kind in FruitKind::ALL {
        looks.fruits = FruitLook { kind, share: 1.0, place: Place::Twigs, ..looks.fruits };
        let file = glb(&saplings::pole(40), &style(), &looks, METRES).expect("it exports");
        let meshes = reader::read(&file);
        let names: Vec<_> = meshes.iter().map(|mesh| mesh.name.as_str()).collect();
        let expected = ["Wood", "Leaves", "Flowers", "Fruits"];
        assert_eq!(names, expected[..if kind == FruitKind::None { 3 } else { 4 }]);
    }
}

#[test]
fn a_cut_is_seen_without_bark() {
    let mut plant = saplings::pole(6);
    plant.begin_edit();
    plant.set_width(MetamerId::new(3), Some(0.5));
    plant.prune(&[MetamerId::new(4)]);
    plant.end_step();
    let root = root(&glb(&plant, &style(), &looks(), METRES).expect("it exports"));
    let names: Vec<_> =
        root["materials"].as_array().expect("materials").iter().map(|one| &one["name"]).collect();
    assert!(names.contains(&&"Cut".into()), "{names:?}");
}

#[test]
fn a_file_has_the_leaves_of_its_season() {
    let positions = |season| {
        let looks = looks().leafy(LeafKind::Round, [88, 128, 52]).turned(0.0, season, 0.0);
        let file = glb(&saplings::pole(60), &style(), &looks, METRES).expect("it exports");
        let leaves = reader::read(&file).into_iter().find(|mesh| mesh.name == "Leaves");
        leaves.map_or(0, |leaves| leaves.positions.len())
    };
    let [burst, summer, autumn, winter] = [0.0, 1.0, 2.0, 3.0].map(positions);
    assert!(0 < burst && burst < summer && 0 < autumn && autumn < summer, "{burst} {summer} {autumn}");
    assert_eq!(winter, 0, "leaves have fallen");
}

#[test]
fn impossible_scales_are_refused() {
    for metres in [0.0, -1.0, f32::INFINITY] {
        assert_eq!(glb(&saplings::fork(), &style(), &looks(), metres), Err(ExportError::Scale(metres)));
    }
    assert!(matches!(glb(&saplings::fork(), &style(), &looks(), f32::NAN), Err(ExportError::Scale(_))));
    assert_eq!(glb(&saplings::fork(), &style(), &looks(), f32::MAX), Err(ExportError::NotFinite));
}
