//! Colours in formats whose surfaces have one each: a few materials for all leaves, or a colour of each vertex.

use std::collections::BTreeMap;

use espalier_export::{About, ExportError, Model, Sink, in_memory};
use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant};
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
        obstacles: &[],
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
fn each_face_of_wood_with_cuts_is_in_one_subset() {
    let mut pole = saplings::pole(60);
    pole.begin_step();
    pole.prune(&[MetamerId::new(40)]);
    pole.end_step();
    let text = text(&pole, espalier_export::usdz, &Model::default());
    let wood = text.split("def Mesh \"Wood\"").nth(1).expect("there is wood");
    let wood = wood.split("def Mesh").next().expect("it ends");
    let list = |text: &str, name: &str| -> Vec<u32> {
        let list = text.split(name).nth(1).and_then(|rest| rest.split(']').next()).expect("a list");
        list.split(", ").map(|item| item.parse().expect("a number")).collect()
    };
    let faces = list(wood, "int[] faceVertexCounts = [").len() as u32;
    let mut told = Vec::new();
    for name in ["Bark", "Cut"] {
        let subset = wood.split(&format!("def GeomSubset \"{name}\"")).nth(1).expect("a subset");
        assert!(subset.contains(&format!("rel material:binding = </Plants/Looks/{name}>")));
        told.extend(list(subset, "int[] indices = ["));
    }
    told.sort_unstable();
    assert_eq!(told, (0..faces).collect::<Vec<_>>());
    assert!(wood.contains("materialBind:familyType = \"partition\""));
}

#[test]
fn usda_shows_the_colour_of_each_vertex_and_of_each_instance() {
    let plant = saplings::pole(60);
    for instanced in [false, true] {
        let text = text(&plant, espalier_export::usda, &Model { instanced, ..Model::default() });
        // Who reads no colours of vertices has a few materials, each with the colour it stands for.
        let materials: Vec<&str> = text.split("def Material \"Leaves_").skip(1).collect();
        assert!((2..=6).contains(&materials.len()), "{} materials", materials.len());
        let mut values = Vec::new();
        for material in materials {
            let material = material.split("def Material").next().expect("it ends");
            let number = material.split('"').next().expect("it has a name");
            let own =
                format!("inputs:diffuseColor.connect = </Plants/Looks/Leaves_{number}/Own.outputs:result>");
            assert!(material.contains(&own) && material.contains("varname = \"displayColor\""));
            let value = |name: &str| material.split(name).nth(1).and_then(|rest| rest.split('\n').next());
            let fallback = value("float3 inputs:fallback = ").expect("a colour");
            assert_eq!(value("color3f inputs:diffuseColor = "), Some(fallback));
            values.push(fallback);
        }
        values.sort_unstable();
        values.dedup();
        assert!(values.len() > 1, "{values:?}");
        let part = text.split("\"Leaves\"").nth(1).expect("they are there");
        let colours = part.split("primvars:displayColor = [").nth(1).and_then(|rest| rest.split(']').next());
        let mut colours: Vec<&str> = colours.expect("they have colours").split("), ").collect();
        colours.sort_unstable();
        colours.dedup();
        assert!(colours.len() > 20, "{} colours", colours.len());
    }
}
