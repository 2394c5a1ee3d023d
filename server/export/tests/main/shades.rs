//! Colours in formats whose surfaces have one each: a few materials for all leaves, or a colour of each vertex.

use std::collections::BTreeMap;

use espalier_export::{About, ExportError, Model, Sink, in_memory};
use espalier_mesh::Style;
use espalier_plant::Plant;
use espalier_settings::{Appearance, ParameterValues};

use crate::{METRES, glb, looks, reader, saplings, style};

type Format = fn(&Plant, &Style, &Appearance, &About<'_>, &Model, &mut dyn Sink) -> Result<(), ExportError>;

/// A file, which is text but for its pictures, as nothing in it is packed.
fn text(plant: &Plant, format: Format, model: &Model) -> String {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let about = About {
        program: "Espalier",
        simulation: 1,
        species: None,
        seed: None,
        parameters: &parameters,
        author: None,
        licence: None,
    };
    let file = in_memory(|out| format(plant, &style(), &looks(), &about, model, out)).expect("it exports");
    String::from_utf8_lossy(&file).into_owned()
}

fn leaf_triangles(plant: &Plant) -> usize {
    let file = glb(plant, &style(), &looks(), METRES).expect("it exports");
    let leaves = reader::read(&file).into_iter().filter(|mesh| mesh.name == "Leaves");
    leaves.map(|mesh| mesh.indices.len() / 3).sum()
}

#[test]
fn leaves_of_obj_have_a_material_for_each_of_a_few_colours() {
    let plant = saplings::pole(60);
    let text = text(&plant, espalier_export::obj, &Model::default());
    let mut faces: BTreeMap<&str, usize> = BTreeMap::new();
    let (mut material, mut switches) = ("", 0);
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("usemtl ") {
            (material, switches) = (name, switches + usize::from(name.starts_with("Leaves")));
        } else if line.starts_with("f ") {
            *faces.entry(material).or_default() += 1;
        }
    }
    let leaves: Vec<_> = faces.iter().filter(|(name, _)| name.starts_with("Leaves_")).collect();
    assert!((2..=6).contains(&leaves.len()), "{faces:?}");
    assert_eq!(switches, leaves.len(), "triangles of a material stand together");
    assert_eq!(leaves.iter().map(|(_, count)| **count).sum::<usize>(), leaf_triangles(&plant));
    for (name, _) in &leaves {
        let picture = format!("{}_colour.png", name.to_lowercase());
        assert!(text.contains(&format!("newmtl {name}\n")), "{name}");
        assert!(text.contains(&format!("map_Kd {picture}\n")), "{picture}");
    }
    assert_eq!(text.matches("leaves_normal.png\n").count(), leaves.len(), "they share a relief");
}

#[test]
fn leaves_of_usdz_are_parts_by_colour_and_each_is_in_one() {
    let plant = saplings::pole(60);
    let text = text(&plant, espalier_export::usdz, &Model::default());
    let mut told: Vec<u32> = Vec::new();
    for subset in text.split("def GeomSubset \"Leaves_").skip(1) {
        let list = subset.split("int[] indices = [").nth(1).and_then(|rest| rest.split(']').next());
        told.extend(
            list.expect("it has faces").split(", ").map(|face| face.parse::<u32>().expect("a number")),
        );
    }
    told.sort_unstable();
    assert_eq!(told, (0..leaf_triangles(&plant) as u32).collect::<Vec<_>>());
    assert!(text.contains("@leaves_2_colour.png@") && !text.contains("UsdPrimvarReader_float3"));
}

#[test]
fn usda_shows_the_colour_of_each_vertex_and_of_each_instance() {
    let plant = saplings::pole(60);
    for instanced in [false, true] {
        let text = text(&plant, espalier_export::usda, &Model { instanced, ..Model::default() });
        let leaves = text.split("def Material \"Leaves\"").nth(1).expect("they have a material");
        let material = leaves.split("def Material").next().expect("it ends");
        assert!(material.contains("inputs:diffuseColor.connect = </Plants/Looks/Leaves/Own.outputs:result>"));
        assert!(
            material.contains("varname = \"displayColor\"") && material.contains("float3 inputs:fallback")
        );
        let part = text.split("\"Leaves\"").nth(1).expect("they are there");
        let colours = part.split("primvars:displayColor = [").nth(1).and_then(|rest| rest.split(']').next());
        let mut colours: Vec<&str> = colours.expect("they have colours").split("), ").collect();
        colours.sort_unstable();
        colours.dedup();
        assert!(colours.len() > 20, "{} colours", colours.len());
    }
}
