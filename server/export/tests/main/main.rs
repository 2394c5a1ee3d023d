//! Files are what their formats say, for any plant.

mod reader;
mod saplings;
mod species;

use espalier_export::{ExportError, glb, skeleton_json};
use espalier_mesh::{Style, StyleOptions, leaf_mesh, leaves, wood};
use espalier_plant::{MetamerId, Plant, Widths};
use espalier_settings::{Appearance, LeafKind};
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

/// Whether places or directions are the same but for rounding.
fn are_near(found: &[Vec3], wanted: impl ExactSizeIterator<Item = Vec3>) -> bool {
    found.len() == wanted.len()
        && found
            .iter()
            .zip(wanted)
            .all(|(&found, wanted)| found.distance(wanted) < 1e-4 * wanted.length().max(1.0))
}

proptest! {
    #[test]
    fn any_plant_is_a_valid_glb(growth in saplings::growth(), metres in 0.005f32..1.0) {
        let (plant, style) = (saplings::grown(&growth), style());
        let file = glb(&plant, &style, &looks(), metres).expect("it exports");
        let meshes = reader::read(&file);
        // In summer leaves are as the rules have them.
        let ids = (0..plant.metamer_count()).map(MetamerId::new);
        let leaves: Vec<_> = ids.flat_map(|id| leaves::of(&plant, id, &style)).collect();
        let bark = wood(&plant, &style, &looks().bark).into_iter().map(|wood| ("Bark", wood.into_mesh()));
        let sources: Vec<_> = bark.chain([("Leaves", leaf_mesh(&leaves))]).filter(|(_, mesh)| !mesh.is_empty()).collect();
        prop_assert_eq!(meshes.len(), sources.len());
        for (read, (name, source)) in meshes.iter().zip(&sources) {
            prop_assert_eq!(&read.name, name);
            prop_assert_eq!(&read.indices, &source.indices);
            let scaled = source.positions.iter().map(|&position| position * metres);
            prop_assert!(are_near(&read.normals, source.normals.iter().copied()));
            prop_assert!(are_near(&read.positions, scaled));
            prop_assert!(read.uvs.iter().zip(&source.uvs).all(|(read, uv)| read.x == uv.x && read.y == 1.0 - uv.y));
        }
        prop_assert_eq!(file, glb(&plant, &style, &looks(), metres).expect("it exports again"));
    }

    #[test]
    fn any_skeleton_holds_the_living_in_order(growth in saplings::growth()) {
        let (plant, style) = (saplings::grown(&growth), style());
        let file: Value = serde_json::from_slice(&skeleton_json(&plant, &style)).expect("it is JSON");
        let metamers = file["metamers"].as_array().expect("metamers are a list");
        let (living, widths) = (saplings::living(&plant), Widths::of(&plant, style.girth()));
        prop_assert_eq!(metamers.len(), living.len());
        for (place, (read, &id)) in metamers.iter().zip(&living).enumerate() {
            let parent = read["parent"].as_u64().map(|parent| parent as usize);
            prop_assert!(parent.is_none_or(|parent| parent < place));
            prop_assert_eq!(parent.map(|parent| living[parent]), plant.metamers().parent(id));
            let radius = if parent.is_none() { 0.0 } else { widths.radius(id) };
            prop_assert_eq!(read["radius"].as_f64().map(|radius| radius as f32), Some(radius));
            let position: Vec<f32> =
                read["position"].as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number") as f32).collect();
            prop_assert_eq!(Vec3::from_slice(&position), plant.metamers().end(id));
            prop_assert_eq!(read["birth"].as_u64(), Some(u64::from(plant.birth(id))));
        }
    }
}

#[test]
fn seed_alone_gives_a_valid_file_without_meshes() {
    let file = glb(&Plant::new(Vec3::ZERO), &style(), &looks(), METRES).expect("it exports");
    assert!(reader::read(&file).is_empty());
}

#[test]
fn bare_tree_has_no_leaf_mesh() {
    let bare = Style::new(StyleOptions { leaves_per_node: 0, ..*style().options() });
    let meshes = reader::read(&glb(&saplings::fork(), &bare, &looks(), METRES).expect("it exports"));
    assert_eq!(meshes.iter().map(|mesh| mesh.name.as_str()).collect::<Vec<_>>(), ["Bark"]);
}

#[test]
fn many_vertices_get_wide_indices() {
    // The reader checks the width; this is about six vertices an internode and eight a leaf.
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
    let text = String::from_utf8(skeleton_json(&plant, &style())).expect("JSON is UTF-8");
    assert!(
        text.ends_with(r#"{"parent":0,"position":[0.0,1.0,0.0],"radius":0.25,"order":0,"birth":1}]}"#),
        "{text}"
    );
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
    let text = String::from_utf8(skeleton_json(&plant, &style())).expect("JSON is UTF-8");
    assert!(text.contains(r#""position":[0.0,1.0,0.0],"radius":0.25,"#), "{text}");
    let meshes = reader::read(&glb(&plant, &style(), &looks(), METRES).expect("it exports"));
    let top = meshes[0].positions.iter().filter(|position| (position.y - METRES).abs() < 1e-6);
    let widest = top.map(|position| position.with_y(0.0).length()).fold(0.0, f32::max);
    assert!((widest - 0.25 * METRES).abs() < 0.02 * METRES, "{widest}");
}

#[test]
fn materials_have_the_colours_of_the_looks() {
    let materials = |looks: &Appearance| -> Vec<(String, Vec<f64>)> {
        let file = glb(&saplings::fork(), &style(), looks, METRES).expect("it exports");
        let length = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
        let root: Value = serde_json::from_slice(&file[20..20 + length]).expect("it is JSON");
        let material = |material: &Value| {
            let factor = material["pbrMetallicRoughness"]["baseColorFactor"].as_array().expect("a colour");
            let colour = factor.iter().map(|c| c.as_f64().expect("a number")).collect();
            (material["name"].as_str().expect("a name").to_owned(), colour)
        };
        root["materials"].as_array().expect("materials").iter().map(material).collect()
    };
    let mut looks = looks().leafy(LeafKind::Round, [0, 0, 255]).turned(0.0, 1.0, 0.0);
    looks.bark.tint = [255, 0, 0];
    let [(_, bark), (_, leaves)] = &materials(&looks)[..] else { panic!("two materials") };
    assert_eq!(bark[..], [1.0, 0.0, 0.0, 1.0]);
    assert!(leaves[2] > 0.8 && leaves[0] < 0.01, "{leaves:?}");
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

#[test]
fn skeleton_of_a_fork_is_this_text() {
    let text = String::from_utf8(skeleton_json(&saplings::fork(), &style())).expect("JSON is UTF-8");
    let expected = [
        r#"{"format":"espalier-skeleton","version":1,"unit":"internode","metamers":["#,
        r#"{"parent":null,"position":[0.0,0.0,0.0],"radius":0.0,"order":0,"birth":0},"#,
        r#"{"parent":0,"position":[0.0,1.0,0.0],"radius":0.08660254,"order":0,"birth":1},"#,
        r#"{"parent":1,"position":[0.0,2.0,0.0],"radius":0.05,"order":0,"birth":1},"#,
        r#"{"parent":1,"position":[0.0,1.0,0.5],"radius":0.05,"order":1,"birth":2}]}"#,
    ];
    assert_eq!(text, expected.concat());
}
