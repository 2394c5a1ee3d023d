//! Options of files of triangles: each changes what it says it does, and nothing else.

use espalier_export::{Detail, Model};
use espalier_growth::species;
use espalier_mesh::Style;
use espalier_plant::{Internode, MetamerId, Plant};
use glam::{Mat4, Quat, Vec3};
use serde_json::Value;

use crate::{METRES, looks, model, root, saplings, species::raised, style};

const PLAIN: Model = Model {
    detail: Detail::Level(0),
    quantised: false,
    compressed: false,
    instanced: false,
    hull: false,
    by_limb: false,
    lightmap: None,
    sway: None,
    wind_weights: false,
};

fn file(plant: &Plant, options: &Model) -> Vec<u8> {
    model(plant, &style(), &looks(), METRES, options).expect("it exports")
}

/// The accessor's numbers, each of its parts from -1 to 1 where it is normalised.
pub fn numbers(file: &[u8], accessor: usize) -> Vec<f32> {
    let root = root(file);
    let number = |value: &Value| value.as_u64().map_or(0, |value| value as usize);
    let (accessor, views) = (&root["accessors"][accessor], &root["bufferViews"]);
    let view = &views[number(&accessor["bufferView"])];
    let parts = match accessor["type"].as_str() {
        Some("SCALAR") => 1,
        Some("VEC2") => 2,
        Some("VEC3") => 3,
        Some("MAT4") => 16,
        _ => 4,
    };
    let size = match accessor["componentType"].as_u64() {
        Some(5120 | 5121) => 1,
        Some(5122 | 5123) => 2,
        _ => 4,
    };
    let json = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let start = 28 + json + number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
    let stride = view["byteStride"].as_u64().map_or(parts * size, |stride| stride as usize);
    let items = (0..number(&accessor["count"])).flat_map(|item| (0..parts).map(move |part| (item, part)));
    items
        .map(|(item, part)| {
            let at = start + item * stride + part * size;
            let bytes = &file[at..at + size];
            match accessor["componentType"].as_u64() {
                Some(5120) => f32::from(bytes[0] as i8) / 127.0,
                Some(5121) => f32::from(bytes[0]) / 255.0,
                Some(5122) => f32::from(i16::from_le_bytes([bytes[0], bytes[1]])) / 32767.0,
                Some(5123) => f32::from(u16::from_le_bytes([bytes[0], bytes[1]])) / 65535.0,
                _ => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
            }
        })
        .collect()
}

/// One mesh in the scene: the name of its node, and where its vertices are, in metres.
struct Shown {
    name: String,
    places: Vec<Vec3>,
    triangles: u64,
}

/// All meshes of the scene, instances unfolded.
fn shown(file: &[u8]) -> Vec<Shown> {
    let root = root(file);
    let mut shown = Vec::new();
    for node in root["scenes"][0]["nodes"].as_array().expect("nodes") {
        visit(file, &root, node.as_u64().expect("an index") as usize, Mat4::IDENTITY, &mut shown);
    }
    shown
}

fn visit(file: &[u8], root: &Value, index: usize, parent: Mat4, shown: &mut Vec<Shown>) {
    let node = &root["nodes"][index];
    let vector = |name: &str, otherwise: f32| {
        let parts = node[name].as_array().map(|parts| parts.iter().filter_map(Value::as_f64));
        parts.map_or(Vec3::splat(otherwise), |parts| {
            Vec3::from_slice(&parts.map(|part| part as f32).collect::<Vec<_>>())
        })
    };
    let own = Mat4::from_scale_rotation_translation(
        vector("scale", 1.0),
        Quat::IDENTITY,
        vector("translation", 0.0),
    );
    let world = parent * own;
    if let Some(mesh) = node["mesh"].as_u64() {
        let primitives = root["meshes"][mesh as usize]["primitives"].as_array().expect("primitives");
        let at = |value: &Value| value.as_u64().expect("an index") as usize;
        let vertices: Vec<Vec3> = numbers(file, at(&primitives[0]["attributes"]["POSITION"]))
            .as_chunks::<3>()
            .0
            .iter()
            .map(|&place| Vec3::from_array(place))
            .collect();
        let triangles: u64 = primitives
            .iter()
            .map(|one| root["accessors"][at(&one["indices"])]["count"].as_u64().unwrap_or(0) / 3)
            .sum();
        let places = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        let transforms: Vec<Mat4> = if places.is_null() {
            vec![Mat4::IDENTITY]
        } else {
            let [places, turns, scales] =
                ["TRANSLATION", "ROTATION", "SCALE"].map(|name| numbers(file, at(&places[name])));
            places
                .as_chunks::<3>()
                .0
                .iter()
                .zip(turns.as_chunks::<4>().0)
                .zip(scales.as_chunks::<3>().0)
                .map(|((&place, &turn), &scale)| {
                    Mat4::from_scale_rotation_translation(
                        scale.into(),
                        Quat::from_array(turn).normalize(),
                        place.into(),
                    )
                })
                .collect()
        };
        shown.push(Shown {
            name: node["name"].as_str().unwrap_or_default().to_owned(),
            places: transforms
                .iter()
                .flat_map(|one| vertices.iter().map(move |&place| (world * *one).transform_point3(place)))
                .collect(),
            triangles: triangles * transforms.len() as u64,
        });
    }
    for child in node["children"].as_array().into_iter().flatten() {
        visit(file, root, child.as_u64().expect("an index") as usize, world, shown);
    }
}

fn bounds(places: &[Vec3]) -> [Vec3; 2] {
    places.iter().fold([Vec3::MAX, Vec3::MIN], |[low, high], &place| [low.min(place), high.max(place)])
}

#[test]
fn quantised_vertices_are_where_the_others_are_in_half_the_bytes() {
    let plant = saplings::pole(60);
    let [plain, small] = [false, true].map(|quantised| file(&plant, &Model { quantised, ..PLAIN }));
    for (plain, small) in shown(&plain).iter().zip(shown(&small)) {
        assert_eq!((&plain.name, plain.triangles), (&small.name, small.triangles));
        for (a, b) in plain.places.iter().zip(&small.places) {
            assert!(a.distance(*b) < 4e-4, "{a} is at {b}");
        }
    }
    let bytes = |file: &[u8]| root(file)["bufferViews"][0]["byteLength"].as_u64().unwrap_or(0);
    assert!(bytes(&small) * 100 < bytes(&plain) * 55);
    assert_eq!(root(&small)["extensionsRequired"], serde_json::json!(["KHR_mesh_quantization"]));
}

#[test]
fn quantised_wood_is_as_thick_as_the_other() {
    let mut plant = saplings::pole(6);
    plant.begin_edit();
    let thick: Vec<_> = (1..=6).map(|row| (MetamerId::new(row), Some(30.0))).collect();
    plant.give_radii(&thick).expect("living wood");
    plant.end_step();
    for by_limb in [false, true] {
        let [plain, small] =
            [false, true].map(|quantised| shown(&file(&plant, &Model { quantised, by_limb, ..PLAIN })));
        let [plain, small] = [&plain, &small].map(|shown| bounds(&shown[0].places));
        assert!(plain[1].x > 30.0 * METRES, "the wood is thick: {plain:?}");
        let off = (plain[0] - small[0]).abs().max((plain[1] - small[1]).abs()).max_element();
        assert!(off < 1e-3, "{plain:?} is {small:?}");
    }
}

/// Whatever goes together is written: each mix of attributes has a stride of its own, which meshoptimizer must know.
#[cfg(feature = "meshopt")]
#[test]
fn all_options_go_together_but_movement_and_instances() {
    let plant = saplings::pole(12);
    let mut strides = std::collections::BTreeSet::new();
    for mix in 0..1u32 << 8 {
        let has = |bit: u32| mix >> bit & 1 == 1;
        let options = Model {
            quantised: has(0),
            compressed: has(1),
            instanced: has(2),
            hull: has(3),
            by_limb: has(4),
            lightmap: has(5).then_some(64),
            sway: has(6).then_some(8),
            wind_weights: has(7),
            ..PLAIN
        };
        if options.instanced && (options.sway.is_some() || options.wind_weights) {
            continue;
        }
        let file = model(&plant, &style(), &looks(), METRES, &options);
        let file = file.unwrap_or_else(|error| panic!("{options:?}: {error}"));
        let root = root(&file);
        let views = root["bufferViews"].as_array().expect("views").iter();
        strides.extend(views.filter_map(|view| view["byteStride"].as_u64()));
    }
    assert!(strides.len() > 8, "{strides:?}");
}

#[cfg(feature = "meshopt")]
#[test]
fn compressed_vertices_and_triangles_are_those_of_the_others() {
    let plant = saplings::pole(60);
    let [plain, packed] =
        [false, true].map(|compressed| file(&plant, &Model { quantised: true, compressed, ..PLAIN }));
    let (before, after) = (root(&plain), root(&packed));
    let json = |file: &[u8]| 28 + u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let mut views = 0;
    for (raw, view) in before["bufferViews"]
        .as_array()
        .into_iter()
        .flatten()
        .zip(after["bufferViews"].as_array().into_iter().flatten())
    {
        let number = |view: &Value, name: &str| view[name].as_u64().unwrap_or(0) as usize;
        let raw = &plain[json(&plain) + number(raw, "byteOffset")..][..number(raw, "byteLength")];
        let extension = &view["extensions"]["EXT_meshopt_compression"];
        if extension.is_null() {
            continue;
        }
        views += 1;
        let bytes =
            &packed[json(&packed) + number(extension, "byteOffset")..][..number(extension, "byteLength")];
        assert!(bytes.len() < raw.len());
        let count = number(extension, "count");
        match (extension["mode"].as_str(), number(extension, "byteStride")) {
            (Some("ATTRIBUTES"), 24) => assert_eq!(
                meshopt::decode_vertex_buffer::<[u8; 24]>(bytes, count).expect("vertices").as_flattened(),
                raw
            ),
            (Some("ATTRIBUTES"), 28) => assert_eq!(
                meshopt::decode_vertex_buffer::<[u8; 28]>(bytes, count).expect("vertices").as_flattened(),
                raw
            ),
            _ => {
                let indices: Vec<u16> = meshopt::decode_index_buffer(bytes, count).expect("triangles");
                let wanted: Vec<u16> =
                    raw.as_chunks::<2>().0.iter().map(|&two| u16::from_le_bytes(two)).collect();
                // The encoder may begin a triangle with another of its corners.
                let turned = |corners: &[u16; 3]| {
                    let mut all = [*corners; 3];
                    all[1].rotate_left(1);
                    all[2].rotate_left(2);
                    all.into_iter().min()
                };
                assert!(
                    indices.as_chunks::<3>().0.iter().map(turned).eq(wanted
                        .as_chunks::<3>()
                        .0
                        .iter()
                        .map(turned))
                );
            }
        }
    }
    assert!(views >= 4, "wood and leaves: vertices and triangles of each");
}

#[test]
fn a_set_has_all_levels_each_with_fewer_triangles() {
    let oak = species::find("oak").or_else(|| species::all().first()).expect("a species");
    let mut oak = raised(oak, 1);
    let (style, looks) = (Style::new(espalier_session::style_options(&oak.parameters())), *oak.appearance());
    let options = Model { detail: Detail::Set, ..PLAIN };
    let set = model(oak.portrait(), &style, &looks, METRES, &options).expect("it exports");
    let root = root(&set);
    let nodes = root["nodes"].as_array().expect("nodes");
    let names: Vec<_> =
        nodes.iter().filter_map(|node| node["name"].as_str()).filter(|name| name.contains("_LOD")).collect();
    assert_eq!(names, ["Tree_LOD0", "Tree_LOD1", "Tree_LOD2", "Tree_LOD3"]);
    let mut before = u64::MAX;
    let whole = bounds(&shown(&set).iter().flat_map(|one| one.places.clone()).collect::<Vec<_>>());
    for level in 0..4 {
        let options = Model { detail: Detail::Level(level), ..PLAIN };
        let shown = shown(&model(oak.portrait(), &style, &looks, METRES, &options).expect("it exports"));
        let triangles: u64 = shown.iter().map(|one| one.triangles).sum();
        assert!(triangles * 2 < before, "level {level} has {triangles} of {before}");
        before = triangles;
        let size = bounds(&shown.iter().flat_map(|one| one.places.clone()).collect::<Vec<_>>());
        let off = (size[1] - whole[1]).abs().max((size[0] - whole[0]).abs()).max_element();
        assert!(off < 0.06 * (whole[1] - whole[0]).max_element(), "level {level} is another size by {off} m");
    }
    assert_eq!(before, 4, "two cards");
}

#[test]
fn each_billboard_has_its_own_pictures_and_says_what_its_depths_mean() {
    let mut plant = saplings::pole(6);
    plant.begin_step();
    let axis = plant.sow(Vec3::new(9.0, 0.0, 0.0));
    plant.end_step();
    plant.begin_step();
    let end = Vec3::new(9.0, 1.0, 3.0);
    plant.extend(axis, &Internode { end, normal: Vec3::X, laterals: &[] });
    plant.end_step();
    // Twigs are left out at the level that billboards show.
    plant.begin_edit();
    plant.give_radii(&[(MetamerId::new(8), Some(0.3))]).expect("living wood");
    plant.end_step();
    let root = root(&file(&plant, &Model { detail: Detail::Level(Detail::BILLBOARD), ..PLAIN }));
    let materials = root["materials"].as_array().expect("materials");
    let names: Vec<_> = materials.iter().map(|one| one["name"].as_str().unwrap_or_default()).collect();
    assert_eq!(names, ["Billboard", "Billboard_2"]);
    let shown = |mesh: usize| root["meshes"][mesh]["primitives"][0]["material"].as_u64();
    assert_eq!((shown(0), shown(1)), (Some(0), Some(1)));
    // The second leans to the front by three internodes, and is no further back than its foot and its leaves.
    let depth = &materials[1]["extras"]["depth"];
    let (far, near) = (depth["far"].as_f64().expect("metres"), depth["near"].as_f64().expect("metres"));
    let lean = f64::from(3.0 * METRES);
    assert!((-0.4 * lean..=0.0).contains(&far) && near > 0.9 * lean && near < 1.6 * lean, "{far} to {near}");
    let picture = |texture: &Value| {
        let texture = texture["index"].as_u64().expect("a texture") as usize;
        let image = root["textures"][texture]["source"].as_u64().expect("an image") as usize;
        root["images"][image]["name"].clone()
    };
    assert_eq!(picture(&depth["texture"]), "Billboard_2 depth");
}

#[test]
fn instances_stand_where_leaves_do() {
    let plant = saplings::pole(60);
    let find = |instanced| {
        let shown = shown(&file(&plant, &Model { instanced, ..PLAIN }));
        let leaves = shown.into_iter().filter(|one| one.name.starts_with("Leaves"));
        leaves.fold((0, Vec::new()), |(triangles, mut places), one| {
            places.extend(one.places);
            (triangles + one.triangles, places)
        })
    };
    let ((triangles, one), (same, other)) = (find(false), find(true));
    assert_eq!((triangles, one.len()), (same, other.len()));
    let [a, b] = [bounds(&one), bounds(&other)];
    // They have one bow and fold for all.
    assert!(a[0].distance(b[0]) < 0.02 && a[1].distance(b[1]) < 0.02, "{a:?} {b:?}");
    let middle = |places: &[Vec3]| places.iter().sum::<Vec3>() / places.len() as f32;
    assert!(middle(&one).distance(middle(&other)) < 0.003);
}

#[test]
fn limbs_are_nodes_where_they_begin_and_together_the_tree() {
    let plant = saplings::fork();
    let [whole, limbs] = [false, true].map(|by_limb| file(&plant, &Model { by_limb, ..PLAIN }));
    let root = root(&limbs);
    let limb =
        root["nodes"].as_array().into_iter().flatten().find(|node| node["name"] == "Limb 1").expect("a limb");
    assert_eq!(
        limb["translation"].as_array().map(|place| place[1].as_f64().map(|y| y as f32)),
        Some(Some(METRES))
    );
    let corners = |file: &[u8]| {
        let mut all: Vec<[i64; 3]> = shown(file)
            .iter()
            .flat_map(|one| &one.places)
            .map(|place| place.to_array().map(|part| (f64::from(part) * 1e5).round() as i64))
            .collect();
        all.sort_unstable();
        all
    };
    let (whole, limbs) = (corners(&whole), corners(&limbs));
    assert_eq!(whole.len(), limbs.len());
    assert!(whole.iter().zip(&limbs).all(|(a, b)| (0..3).all(|i| (a[i] - b[i]).abs() <= 1)));
}

#[test]
fn hulls_are_in_a_scene_of_their_own() {
    let file = file(&saplings::pole(20), &Model { hull: true, ..PLAIN });
    let root = root(&file);
    let named: Vec<_> = root["scenes"][1]["nodes"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|at| root["nodes"][at.as_u64().unwrap_or(0) as usize]["name"].as_str())
        .collect();
    assert_eq!(named, ["UCX_Tree_01"]);
    assert_eq!(root["scene"], 0);
}
