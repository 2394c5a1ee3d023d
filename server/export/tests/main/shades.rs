//! Colours in formats whose surfaces have one each: a cell of a picture for each of many, a few materials, or a colour of
//! each vertex.

use std::{collections::BTreeMap, io::Cursor};

use espalier_export::{About, ExportError, Model, Sink, in_memory};
use espalier_growth::species;
use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant};
use espalier_session::style_options;
use espalier_settings::{Appearance, ParameterValues};
use glam::{Vec2, Vec3};

use crate::{METRES, glb, looks, reader, saplings, scenes::members, species::raised, style};

type Format = fn(&Plant, &Style, &Appearance, &About<'_>, &Model, &mut dyn Sink) -> Result<(), ExportError>;

/// A file of a plant of a style and looks.
fn file(plant: &Plant, (style, looks): (&Style, &Appearance), format: Format, model: &Model) -> Vec<u8> {
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
    in_memory(|out| format(plant, style, looks, &about, model, out)).expect("it exports")
}

/// A file, which is text but for its pictures, as nothing in it is packed.
fn text(plant: &Plant, format: Format, model: &Model) -> String {
    String::from_utf8_lossy(&file(plant, (&style(), &looks()), format, model)).into_owned()
}

/// A picture: texels across and up, and for each, from the foot on, its linear colour and whether anything is there.
struct Picture(usize, usize, Vec<Option<Vec3>>);

impl Picture {
    fn read(png: &[u8]) -> Self {
        let mut reader = png::Decoder::new(Cursor::new(png)).read_info().expect("a picture");
        let mut bytes = vec![0; reader.output_buffer_size().expect("its size")];
        let info = reader.next_frame(&mut bytes).expect("it is whole");
        let (across, up) = (info.width as usize, info.height as usize);
        let texels = bytes.as_chunks::<4>().0;
        assert_eq!(texels.len(), across * up, "colours and cover");
        let linear = |byte: u8| {
            let share = f32::from(byte) / 255.0;
            if share <= 0.040_45 { share / 12.92 } else { libm::powf((share + 0.055) / 1.055, 2.4) }
        };
        let colours = texels
            .chunks(across)
            .rev()
            .flatten()
            .map(|&[r, g, b, cover]| (cover >= 128).then(|| Vec3::from_array([r, g, b].map(linear))));
        Self(across, up, colours.collect())
    }

    /// The mean of what is there in the cell that a place lies in, of cells of so many texels.
    fn mean(&self, at: Vec2, side: usize) -> Vec3 {
        let Self(across, up, texels) = self;
        let [x, y] = [at.x * *across as f32, at.y * *up as f32].map(|place| place as usize / side * side);
        let inside: Vec<Vec3> = (y..(y + side).min(*up))
            .flat_map(|y| (x..(x + side).min(*across)).map(move |x| y * across + x))
            .filter_map(|texel| texels[texel])
            .collect();
        inside.iter().sum::<Vec3>() / inside.len().max(1) as f32
    }
}

/// A linear colour in CIE L*a*b*, seen in daylight.
fn lab(colour: Vec3) -> Vec3 {
    let Vec3 { x: r, y: g, z: b } = colour;
    let [x, y, z] = [
        (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505,
        0.2126 * r + 0.7152 * g + 0.0722 * b,
        (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089,
    ]
    .map(|part| if part > 0.008_856 { libm::cbrtf(part) } else { 7.787 * part + 16.0 / 116.0 });
    Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// The places that vertices of leaves have in the picture of their colours in OBJ.
fn places(obj: &str) -> Vec<Vec2> {
    let leaves =
        obj.split("\no ").find(|group| group.lines().next().is_some_and(|name| name.ends_with("Leaves")));
    let lines = leaves.expect("there are leaves").lines().filter_map(|line| line.strip_prefix("vt "));
    let place = |line: &str| {
        let (u, v) = line.split_once(' ').expect("two numbers");
        Vec2::new(u.parse().expect("a number"), v.parse().expect("a number"))
    };
    lines.map(place).collect()
}

/// Leaves of three species, one of them in autumn, in OBJ and in glTF, where each has its own colour: what the difference
/// is, as an eye sees it (ΔE; two colours side by side are told apart from about 2 on).
#[test]
fn leaves_of_obj_have_nearly_the_colours_that_they_have_in_gltf() {
    for (slug, season) in [("cherry", None), ("maple", Some(2.0)), ("oak", None)] {
        let mut document = raised(species::find(slug).expect("a species"), 1);
        let style = Style::new(style_options(&document.parameters()));
        let mut looks = *document.appearance();
        looks.leaves.season = season.unwrap_or(looks.leaves.season);
        let plant = document.portrait();
        let gltf = reader::read(&glb(plant, &style, &looks, METRES).expect("it exports"));
        let leaves = gltf.iter().find(|mesh| mesh.name == "Leaves").expect("there are leaves");
        let members = members(&file(plant, (&style, &looks), espalier_export::obj, &Model::default()));
        let obj = String::from_utf8(members["tree.obj"].1.clone()).expect("text");
        let (places, picture) = (places(&obj), Picture::read(&members["leaves_colour.png"].1));
        assert_eq!(places.len(), leaves.positions.len());
        // Places of glTF count downwards.
        let upwards = |uv: Vec2| Vec2::new(uv.x, 1.0 - uv.y);
        let mut means = BTreeMap::new();
        let mut differences = Vec::new();
        for ((&at, &colour), inner) in places.iter().zip(&leaves.colours).zip(&leaves.uvs) {
            // The middle of the cell: vertices may lie on its edge.
            let cells = Vec2::new((picture.0 / 256) as f32, (picture.1 / 256) as f32);
            let middle = ((at * cells - upwards(*inner)).round() + 0.5) / cells;
            let key = [middle.x, middle.y].map(f32::to_bits);
            let seen = *means.entry(key).or_insert_with(|| picture.mean(middle, 256));
            differences.push(lab(seen).distance(lab(colour * leaves.texture_mean)));
        }
        differences.sort_by(f32::total_cmp);
        let mean = differences.iter().sum::<f32>() / differences.len() as f32;
        let most = differences[differences.len() * 99 / 100];
        println!(
            "{slug}: {} colours, ΔE {mean:.2} on the average, below {most:.2} of 99 in 100",
            means.len()
        );
        assert!(mean < 1.5 && most < 4.0, "{slug}: {mean} {most}");
    }
}

#[test]
fn leaves_of_obj_and_usd_have_one_material_with_a_cell_for_each_of_many_colours() {
    let plant = saplings::pole(60);
    let obj = members(&file(&plant, (&style(), &looks()), espalier_export::obj, &Model::default()));
    let of = |name: &str| String::from_utf8(obj[name].1.clone()).expect("text");
    let (text, library) = (of("tree.obj"), of("tree.mtl"));
    assert_eq!(text.matches("usemtl Leaves\n").count(), 1, "triangles of a material stand together");
    assert!(library.contains("newmtl Leaves\n") && library.contains("map_Kd leaves_colour.png\n"));
    let Picture(across, up, _) = Picture::read(&obj["leaves_colour.png"].1);
    let [columns, lines] = [across / 256, up / 256];
    assert!(columns * lines > 6 && across % 256 == 0 && up % 256 == 0, "{columns} by {lines}");
    assert!(library.contains(&format!("norm -bm 1 -s {columns} {lines} 1 leaves_normal.png\n")), "{library}");
    assert!(places(&text).iter().all(|place| place.min_element() >= 0.0 && place.max_element() <= 1.0));
    for instanced in [false, true] {
        let model = Model { instanced, ..Model::default() };
        let usd = members(&file(&plant, (&style(), &looks()), espalier_export::usda_zip, &model));
        let layer = String::from_utf8(usd["tree.usda"].1.clone()).expect("text");
        let Picture(across, up, _) = Picture::read(&usd["leaves_colour.png"].1);
        let [columns, lines] = [across / 256, up / 256];
        assert!(
            layer.contains(&format!("float2 inputs:scale = ({columns}, {lines})")),
            "{columns} by {lines}"
        );
        assert!(
            layer.contains("<{path}/Cell.outputs:result>".replace("{path}", "/Plants/Looks/Leaves").as_str())
        );
        let leaves = layer.split("\"Leaves\"").nth(1).and_then(|part| part.split("def Scope").next());
        assert!(!leaves.expect("there are leaves").contains("GeomSubset"));
        assert!(!layer.contains("UsdPrimvarReader_float3"));
    }
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
