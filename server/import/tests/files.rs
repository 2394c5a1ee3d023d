//! Files in the shapes that programs write them, and in shapes that no program should.

use std::io::Cursor;

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_import::{ImportError, Limits, Triangles, read_model};
use glam::Vec3;
use proptest::prelude::*;
use serde_json::{Value, json};

const LIMITS: Limits = Limits { vertices: 400, triangles: 400, most_triangles: 60 };

/// The corners of a tetrahedron, then its faces as bytes.
fn tetrahedron() -> Vec<u8> {
    let corners: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    bytes.extend([0u8, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
    bytes
}

fn document(nodes: Value) -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": nodes,
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4,
              "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0] },
            { "bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 12 }
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 }
        ],
        "buffers": [{ "byteLength": 60 }]
    })
}

fn glb(document: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = serde_json::to_vec(document).expect("JSON");
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF".to_vec();
    for word in [2, (12 + 8 + json.len() + 8 + binary.len()) as u32, json.len() as u32, 0x4e4f_534a] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(&json);
    for word in [binary.len() as u32, 0x004e_4942] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(&binary);
    bytes
}

fn one_node() -> Value {
    document(json!([{ "mesh": 0 }]))
}

fn read_file(bytes: &[u8]) -> Result<Triangles, ImportError> {
    read_model(&mut Cursor::new(bytes), &LIMITS).map(|model| model.triangles)
}

fn read(document: &Value) -> Result<Triangles, ImportError> {
    read_file(&glb(document, &tetrahedron()))
}

fn set(document: &mut Value, at: &str, value: Value) {
    *document.pointer_mut(at).expect("it is there") = value;
}

#[test]
fn a_glb_gives_its_triangles() {
    let mesh = read(&one_node()).expect("a mesh");
    // In the order in which corners first name them.
    assert_eq!(mesh.vertices, [Vec3::ZERO, Vec3::Y, Vec3::X, Vec3::Z]);
    assert_eq!(mesh.corners, [[0, 1, 2], [0, 2, 3], [0, 3, 1], [2, 1, 3]]);
}

#[test]
fn corners_at_one_place_are_one_vertex() {
    // As exporters write a square with hard edges: no vertex is shared, one zero is negative, one is not used.
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [9.0, 9.0]];
    let mut bytes: Vec<u8> =
        corners.iter().flat_map(|&[x, y]| [x, y, 0f32]).flat_map(f32::to_le_bytes).collect();
    bytes.extend([0u8, 1, 2, 3, 4, 5, 1, 1, 2]);
    let mut document = one_node();
    set(&mut document, "/accessors/0/count", json!(7));
    set(&mut document, "/accessors/1/count", json!(9));
    document["bufferViews"] =
        json!([{ "buffer": 0, "byteLength": 84 }, { "buffer": 0, "byteOffset": 84, "byteLength": 9 }]);
    set(&mut document, "/buffers/0/byteLength", json!(93));
    let mesh = read_file(&glb(&document, &bytes)).expect("a mesh");
    assert_eq!(mesh.vertices, [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y]);
    assert_eq!(mesh.corners, [[0, 1, 2], [0, 2, 3]], "the third has no area");
}

#[test]
fn a_mirrored_node_keeps_its_outside() {
    let mirrored = document(json!([{ "mesh": 0, "scale": [-1, 1, 1] }]));
    let outward = |mesh: &Triangles| {
        let middle = mesh.vertices.iter().sum::<Vec3>() / 4.0;
        mesh.corners.iter().all(|corners| {
            let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
            (b - a).cross(c - a).dot(a - middle) > 0.0
        })
    };
    assert!(outward(&read(&one_node()).expect("a mesh")));
    assert!(outward(&read(&mirrored).expect("a mesh")));
}

#[test]
fn json_with_embedded_buffers_reads_alike() {
    let mut text = one_node();
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(tetrahedron()));
    text["buffers"][0]["uri"] = json!(uri);
    let bytes = serde_json::to_vec(&text).expect("JSON");
    assert_eq!(read_file(&bytes), read(&one_node()));
}

#[test]
fn nodes_put_meshes_where_they_say() {
    let half = core::f32::consts::FRAC_1_SQRT_2;
    let nested = document(json!([
        { "children": [1, 2], "translation": [10.0, 0.0, 0.0], "scale": [2.0, 2.0, 2.0] },
        // A quarter turn around y takes x to −z.
        { "mesh": 0, "rotation": [0.0, half, 0.0, half], "translation": [0.0, 1.0, 0.0] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1] }
    ]));
    let mesh = read(&nested).expect("a mesh");
    assert_eq!(mesh.corners.len(), 8);
    let expected = [
        Vec3::new(10.0, 2.0, 0.0),
        Vec3::new(10.0, 4.0, 0.0),
        Vec3::new(10.0, 2.0, -2.0),
        Vec3::new(12.0, 2.0, 0.0),
        Vec3::new(20.0, 12.0, 14.0),
    ];
    for (&found, expected) in mesh.vertices.iter().zip(expected) {
        assert!(found.distance(expected) < 1e-5, "{found} {expected}");
    }
}

#[test]
fn transforms_agree_with_the_gltf_crate() {
    let nodes = json!([
        { "children": [1], "rotation": [0.1825742, 0.3651484, 0.5477226, 0.7302967], "scale": [1.0, -2.0, 0.5] },
        { "mesh": 0, "translation": [3.0, 4.0, 5.0], "rotation": [0.5, -0.5, 0.5, 0.5] }
    ]);
    let bytes = glb(&document(nodes), &tetrahedron());
    let oracle = gltf::Gltf::from_slice(&bytes).expect("the other reader takes it too");
    let matrix = |number: usize| {
        let columns = oracle.nodes().nth(number).expect("a node").transform().matrix();
        glam::Mat4::from_cols_array_2d(&columns)
    };
    let world = matrix(0) * matrix(1);
    let mesh = read_file(&bytes).expect("a mesh");
    let of_first_face = mesh.corners[0].map(|corner| mesh.vertices[corner as usize]);
    // The nodes mirror, so the face [0, 2, 1] has changed its sense.
    for (found, local) in of_first_face.into_iter().zip([Vec3::ZERO, Vec3::X, Vec3::Y]) {
        assert!(found.distance(world.transform_point3(local)) < 1e-4);
    }
}

#[test]
fn strips_fans_and_plain_vertices_are_triangles() {
    let triangles = |mode: u32, indexed: bool| {
        let mut document = one_node();
        let primitive = &mut document["meshes"][0]["primitives"][0];
        primitive["mode"] = json!(mode);
        if !indexed {
            primitive.as_object_mut().expect("an object").remove("indices");
        }
        read(&document).map(|mesh| mesh.corners)
    };
    assert_eq!(triangles(5, false), Ok(vec![[0, 1, 2], [1, 3, 2]]));
    assert_eq!(triangles(6, false), Ok(vec![[0, 1, 2], [0, 2, 3]]));
    assert_eq!(triangles(4, false), Ok(vec![[0, 1, 2]]));
    for points_or_lines in 0..4 {
        assert_eq!(triangles(points_or_lines, true), Err(ImportError::Empty));
    }
}

#[test]
fn interleaved_vertices_are_read_by_their_stride() {
    let corners: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut bytes = Vec::new();
    for corner in corners {
        bytes.extend(corner.iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend([0xff; 8]);
    }
    // The last item does not fill its stride.
    bytes.truncate(72);
    bytes.extend([0u8, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
    let mut document = one_node();
    document["bufferViews"] = json!([
        { "buffer": 0, "byteLength": 72, "byteStride": 20 },
        { "buffer": 0, "byteOffset": 72, "byteLength": 12 }
    ]);
    document["buffers"] = json!([{ "byteLength": 84 }]);
    assert_eq!(read_file(&glb(&document, &bytes)), read(&one_node()));
}

/// A binary part made of pieces, and the views of them.
fn pieces(parts: &[Vec<u8>]) -> (Vec<u8>, Vec<Value>) {
    let (mut binary, mut views) = (Vec::new(), Vec::new());
    for part in parts {
        views.push(json!({ "buffer": 0, "byteOffset": binary.len(), "byteLength": part.len() }));
        binary.extend(part);
        binary.resize(binary.len().next_multiple_of(4), 0);
    }
    (binary, views)
}

fn close(found: &[Vec3], wanted: &[Vec3]) -> bool {
    found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| a.distance(*b) < 1e-4)
}

#[test]
fn ob6_quantised_places_are_numbers_or_fractions() {
    let corners = |parts: &[[i32; 3]], width: usize| -> Vec<u8> {
        parts
            .iter()
            .flat_map(|corner| corner.iter().flat_map(|part| part.to_le_bytes()[..width].to_vec()))
            .collect()
    };
    let wanted = |one: f32| [Vec3::ZERO, Vec3::new(one, 0.0, 0.0), Vec3::new(0.0, one, 0.0)];
    for (component_type, width, most, is_signed) in
        [(5120, 1, 127, true), (5121, 1, 255, false), (5122, 2, 32767, true), (5123, 2, 65535, false)]
    {
        for normalized in [false, true] {
            let largest = if is_signed { -most } else { most };
            let (binary, views) = pieces(&[corners(&[[0; 3], [largest, 0, 0], [0, largest, 0]], width)]);
            let mut document = one_node();
            document["nodes"][0]["scale"] = json!([2.0, 2.0, 2.0]);
            document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
            document["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": 0 } }] }]);
            document["accessors"] = json!([{ "bufferView": 0, "componentType": component_type, "type": "VEC3",
                "count": 3, "normalized": normalized }]);
            document["bufferViews"] = json!(views);
            document["buffers"] = json!([{ "byteLength": binary.len() }]);
            let mesh = read_file(&glb(&document, &binary)).expect("a mesh");
            let one = if normalized { largest.signum() as f32 } else { largest as f32 };
            assert!(close(&mesh.vertices, &wanted(2.0 * one)), "{component_type} {normalized}: {mesh:?}");
        }
    }
}

/// A file that shows the tetrahedron at three places, the second of them turned and twice as large.
fn instances(count: usize) -> (Value, Vec<u8>) {
    let floats =
        |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    let half = core::f32::consts::FRAC_1_SQRT_2;
    let quarter = (half * 32767.0).round() as i16;
    let turns = [[0, 0, 0, i16::MAX], [0, quarter, 0, quarter], [0, 0, 0, i16::MAX]];
    let (binary, views) = pieces(&[
        tetrahedron()[..48].to_vec(),
        tetrahedron()[48..].to_vec(),
        floats(&[0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 20.0, 0.0]),
        turns.as_flattened().iter().flat_map(|part| part.to_le_bytes()).collect(),
        floats(&[1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0, 1.0]),
    ]);
    let mut document = document(json!([{ "mesh": 0, "translation": [0, 0, 5], "extensions": {
        "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 2, "ROTATION": 3, "SCALE": 4 } } } }]));
    let accessors = document["accessors"].as_array_mut().expect("a list");
    accessors.push(json!({ "bufferView": 2, "componentType": 5126, "type": "VEC3", "count": count }));
    accessors.push(
        json!({ "bufferView": 3, "componentType": 5122, "type": "VEC4", "count": count, "normalized": true }),
    );
    accessors.push(json!({ "bufferView": 4, "componentType": 5126, "type": "VEC3", "count": count }));
    document["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    document["bufferViews"] = json!(views);
    document["buffers"] = json!([{ "byteLength": binary.len() }]);
    (document, binary)
}

#[test]
fn ob6_instances_are_shown_where_they_say() {
    let (document, binary) = instances(3);
    let mesh = read_file(&glb(&document, &binary)).expect("a mesh");
    assert_eq!(mesh.corners.len(), 12);
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z + 5.0);
    let wanted = [
        [at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 0.0, 1.0)],
        // A quarter turn around y takes x to −z, and z to x.
        [at(10.0, 0.0, 0.0), at(10.0, 2.0, 0.0), at(10.0, 0.0, -2.0), at(12.0, 0.0, 0.0)],
        [at(0.0, 20.0, 0.0), at(0.0, 21.0, 0.0), at(1.0, 20.0, 0.0), at(0.0, 20.0, 1.0)],
    ];
    assert!(close(&mesh.vertices, wanted.as_flattened()), "{:?}", mesh.vertices);
    let (mut uneven, binary) = instances(3);
    uneven["accessors"][4]["count"] = json!(2);
    assert!(matches!(read_file(&glb(&uneven, &binary)), Err(ImportError::Damaged(_))));
    let (many, binary) = instances(1_000_000_000);
    assert_eq!(read_file(&glb(&many, &binary)), Err(ImportError::TooLarge(LIMITS)));
}

#[test]
fn ob6_of_levels_of_detail_the_finest_is_read() {
    let named = |names: [&str; 2]| {
        let mut both = document(json!([
            { "children": [1, 2] },
            { "name": names[0], "mesh": 0 },
            { "name": names[1], "children": [3] },
            { "mesh": 0, "translation": [3, 0, 0] }
        ]));
        both["extensionsUsed"] = json!(["MSFT_lod"]);
        read(&both).expect("a mesh").corners.len()
    };
    assert_eq!(named(["Oak_LOD0", "Oak_LOD1"]), 4);
    assert_eq!(named(["Oak_LOD1", "Oak_LOD0"]), 4);
    assert_eq!(named(["Oak_LOD1", "Oak_LOD2"]), 8, "which would be left?");
    assert_eq!(named(["Oak", "Elm"]), 8);
}

#[test]
fn ob6_what_is_announced_takes_no_memory() {
    for (at, value) in [
        ("/accessors/0/count", json!(1_000_000_000)),
        ("/accessors/1/count", json!(1_000_000_000)),
        ("/accessors/1/count", json!(u64::MAX)),
        ("/bufferViews/1/byteStride", json!(1_000_000_000)),
    ] {
        let mut document = one_node();
        document["bufferViews"][1]["byteStride"] = json!(1);
        set(&mut document, at, value.clone());
        let refused = read(&document);
        assert!(
            matches!(refused, Err(ImportError::Damaged(_) | ImportError::TooLarge(_))),
            "{at} {value}: {refused:?}"
        );
    }
    // A small part that is shown again and again: each time costs, and there is an end.
    let nodes: Vec<Value> = (0..200_000).map(|_| json!({ "mesh": 0 })).collect();
    let mut many = document(json!(nodes));
    many["scenes"][0]["nodes"] = json!((0..200_000).collect::<Vec<_>>());
    assert_eq!(read(&many), Err(ImportError::TooLarge(LIMITS)));
    let too_many = format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{}{{}}]}}"#, "{},".repeat(300_000));
    let refused = read_file(too_many.as_bytes());
    let Err(ImportError::Member { field, .. }) = &refused else { panic!("{refused:?}") };
    assert_eq!(field, "nodes");
    let spaces = [&b"{"[..], &vec![b' '; 17 << 20]].concat();
    assert!(matches!(read_file(&spaces), Err(ImportError::Damaged(_))));
}

#[test]
fn what_is_not_read_is_named() {
    let required = |name: &str| {
        let mut document = one_node();
        document["extensionsRequired"] = json!([name]);
        read(&document).err()
    };
    for name in ["KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing_2", "VENDOR_future"] {
        assert_eq!(required(name), Some(ImportError::Unsupported(format!("the extension {name}"))));
    }
    assert_eq!(required("KHR_materials_unlit"), None);
    let mut external = one_node();
    external["buffers"][0]["uri"] = json!("house.bin");
    assert_eq!(read(&external), Err(ImportError::ExternalBuffer(0)));
    let mut old = one_node();
    set(&mut old, "/asset/version", json!("1.0"));
    assert_eq!(read(&old), Err(ImportError::Version("1.0".to_owned())));
    let mut sparse = one_node();
    sparse["accessors"][0]["sparse"] = json!({ "count": 1 });
    assert!(matches!(read(&sparse), Err(ImportError::Unsupported(_))));
    for other in
        [&b"hello"[..], b"", b"[]", b"5", b"solid cube\n", b"ply\n", b"PK\x03\x04", b"# a script\nimport x\n"]
    {
        assert!(
            matches!(read_file(other), Err(ImportError::NotModel(_))),
            "{:?}",
            other.escape_ascii().to_string()
        );
    }
    assert!(matches!(read_file(b"{"), Err(ImportError::NotGltf(_))));
    let far = document(json!([{ "mesh": 0, "scale": [1e39, 1, 1] }]));
    assert_eq!(read(&far), Err(ImportError::NotFinite));
    let mut nothing = one_node();
    nothing["scenes"] = json!([{}]);
    assert_eq!(read(&nothing), Err(ImportError::Empty));
}

#[test]
fn damaged_files_are_refused() {
    let changes = [
        ("/scene", json!(7)),
        ("/scenes/0/nodes/0", json!(7)),
        ("/nodes/0/mesh", json!(7)),
        ("/meshes/0/primitives/0/indices", json!(7)),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(7)),
        ("/accessors/0/bufferView", json!(7)),
        ("/accessors/0/bufferView", Value::Null),
        ("/accessors/0/count", json!(5)),
        ("/accessors/0/count", json!(usize::MAX)),
        ("/accessors/0/count", json!(2)),
        ("/accessors/1/componentType", json!(5126)),
        ("/accessors/1/count", json!(13)),
        ("/bufferViews/0/buffer", json!(7)),
        ("/bufferViews/0/byteOffset", json!(usize::MAX)),
        ("/bufferViews/0/byteLength", json!(1000)),
        ("/buffers/0/byteLength", json!(1000)),
    ];
    for (at, value) in changes {
        let mut document = one_node();
        set(&mut document, at, value.clone());
        let refused = read(&document);
        let is_refused = matches!(refused, Err(ImportError::Damaged(_) | ImportError::TooLarge(_)));
        assert!(is_refused, "{at} = {value}: {refused:?}");
    }
    let whole = glb(&one_node(), &tetrahedron());
    for len in 0..whole.len() {
        assert!(read_file(&whole[..len]).is_err(), "cut to {len}");
    }
}

#[test]
fn what_is_refused_in_a_file_names_its_member() {
    for (at, value, member) in [
        ("/nodes/0/mesh", json!(-1), "nodes[0].mesh"),
        ("/nodes/0", json!([[], 0]), "nodes[0]"),
        ("/meshes/0/primitives/0/attributes", json!([0]), "meshes[0].primitives[0].attributes"),
        ("/accessors/1/count", json!("many"), "accessors[1].count"),
        ("/asset", json!(["2.0"]), "asset"),
        ("/asset", json!({}), "asset.version"),
    ] {
        let mut document = one_node();
        set(&mut document, at, value.clone());
        let refused = read(&document);
        let Err(ImportError::Member { field, allowed, .. }) = &refused else { panic!("{at}: {refused:?}") };
        assert_eq!(field, member, "{at} = {value}");
        assert!(!allowed.is_empty() && !allowed.contains("struct"), "{at} = {value}: {allowed}");
    }
}

#[test]
fn nodes_that_bear_themselves_come_to_an_end() {
    for (nodes, field) in [
        (json!([{ "mesh": 0, "children": [0] }]), "nodes[0].children"),
        (json!([{ "mesh": 0, "children": [1] }, { "children": [0] }]), "nodes[0].children"),
        (json!([{ "children": [2, 1] }, { "mesh": 0, "children": [1] }, {}]), "nodes[1].children"),
    ] {
        let refused = read(&document(nodes.clone()));
        let Err(ImportError::Member { field: at, .. }) = &refused else { panic!("{nodes}: {refused:?}") };
        assert_eq!(at, field, "{nodes}");
    }
    let shared = document(json!([{ "children": [1, 2] }, { "children": [2] }, { "mesh": 0 }]));
    assert!(read(&shared).is_ok(), "what is borne twice is no circle");
    // Two of each at every level: 2^60 in all.
    let levels: Vec<Value> = (0..60).map(|i| json!({ "children": [i + 1, i + 1] })).collect();
    let mut doubling = document(json!(levels));
    doubling["nodes"].as_array_mut().expect("an array").push(json!({}));
    assert!(matches!(read(&doubling), Err(ImportError::Damaged(_))));
}

#[test]
fn limits_hold_for_the_whole_scene() {
    let copies = |count: usize, apart: usize| {
        let node = |i: usize| json!({ "mesh": 0, "translation": [i * apart, 0, 0] });
        let mut many = document(json!((0..count).map(node).collect::<Vec<_>>()));
        many["scenes"][0]["nodes"] = json!((0..count).collect::<Vec<_>>());
        read(&many)
    };
    let whole = copies(15, 2).expect("sixty triangles in all");
    assert_eq!((whole.vertices.len(), whole.corners.len()), (60, 60));
    assert_eq!(copies(15, 0).expect("at one place").vertices.len(), 4);
    assert_eq!(copies(16, 0), Err(ImportError::TooLarge(LIMITS)), "four triangles too many");
    let said = ImportError::TooLarge(LIMITS).to_string();
    assert_eq!(said, "it has more than 60 triangles, or repeats its parts too often; simplify it first");
}

proptest! {
    #[test]
    fn any_damage_gives_a_mesh_or_an_error(at in 0usize..900, byte: u8, more in prop::collection::vec((0usize..900, any::<u8>()), 0..4)) {
        let mut bytes = glb(&one_node(), &tetrahedron());
        let len = bytes.len();
        for (at, byte) in more.into_iter().chain([(at, byte)]) {
            bytes[at % len] = byte;
        }
        // What counts is that it returns.
        let _ = read_file(&bytes);
    }
}
