//! A strict reader of glTF binary files: the `gltf` crate's validation, and what the specification asks beyond it.

use glam::{Mat4, Vec2, Vec3};
use gltf::{
    Gltf, Primitive, Semantic,
    accessor::{DataType, Dimensions},
    mesh::Mode,
};

#[derive(Debug)]
pub struct ReadMesh {
    pub name: String,
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub uvs: Vec<Vec2>,
    pub indices: Vec<u32>,
}

/// The meshes in the order of their nodes.
pub fn read(file: &[u8]) -> Vec<ReadMesh> {
    check_container(file);
    let gltf = Gltf::from_slice(file).expect("the file is valid");
    assert_eq!(gltf.as_json().asset.version, "2.0");
    assert_eq!(gltf.as_json().asset.generator.as_deref(), Some("Espalier"));
    let blob = gltf.blob.as_deref().unwrap_or_default();
    check_views(&gltf, blob);
    let scene = gltf.default_scene().expect("there is a default scene");
    let roots: Vec<_> = scene.nodes().collect();
    assert_eq!(roots.len(), 1);
    assert_eq!(roots[0].name(), Some("Tree"));
    assert!(gltf.nodes().all(|node| node.transform().matrix() == Mat4::IDENTITY.to_cols_array_2d()));
    roots[0]
        .children()
        .map(|node| {
            let mesh = node.mesh().expect("children have meshes");
            assert_eq!(mesh.primitives().len(), 1);
            let primitive = mesh.primitives().next().expect("a mesh has a primitive");
            let name = node.name().expect("nodes have names").to_owned();
            let material = primitive.material();
            assert_eq!(material.name(), Some(name.as_str()));
            assert_eq!(material.double_sided(), name == "Leaves");
            assert_eq!(material.pbr_metallic_roughness().metallic_factor(), 0.0);
            read_primitive(name, &primitive, blob)
        })
        .collect()
}

/// The header and chunks: lengths that add up, multiples of four, JSON first, padded with the right byte.
fn check_container(file: &[u8]) {
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().expect("four bytes"));
    assert_eq!(&file[..4], b"glTF");
    assert_eq!((word(4), word(8) as usize), (2, file.len()));
    let mut kinds = Vec::new();
    let mut at = 12;
    while at < file.len() {
        let length = word(at) as usize;
        assert!(length > 0 && length.is_multiple_of(4));
        kinds.push(file[at + 4..at + 8].to_vec());
        at += 8 + length;
    }
    assert_eq!(at, file.len());
    assert!(kinds == [b"JSON"] || kinds == [b"JSON", b"BIN\0"], "chunks are {kinds:?}");
}

/// Views lie in the buffer one after the other without overlap; accessors fill them, aligned to their components.
fn check_views(gltf: &Gltf, blob: &[u8]) {
    assert!(gltf.buffers().all(|buffer| buffer.length() == blob.len()));
    let mut end = 0;
    for view in gltf.views() {
        assert!(view.offset() >= end && view.length() > 0);
        end = view.offset() + view.length();
    }
    assert!(end <= blob.len() && blob.len() - end < 4);
    for accessor in gltf.accessors() {
        let view = accessor.view().expect("accessors have views");
        assert!(accessor.count() > 0);
        assert_eq!(accessor.count() * accessor.size(), view.length());
        assert_eq!((view.offset() + accessor.offset()) % accessor.data_type().size(), 0);
    }
}

fn read_primitive(name: String, primitive: &Primitive, blob: &[u8]) -> ReadMesh {
    assert_eq!(primitive.mode(), Mode::Triangles);
    let accessor = primitive.get(&Semantic::Positions).expect("there are positions");
    assert_eq!((accessor.data_type(), accessor.dimensions()), (DataType::F32, Dimensions::Vec3));
    let reader = primitive.reader(|_| Some(blob));
    let positions: Vec<Vec3> = reader.read_positions().expect("positions").map(Vec3::from_array).collect();
    let normals: Vec<Vec3> = reader.read_normals().expect("normals").map(Vec3::from_array).collect();
    let uvs: Vec<Vec2> = reader.read_tex_coords(0).expect("uvs").into_f32().map(Vec2::from_array).collect();
    let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();

    let bound = |value: Option<gltf::json::Value>| -> Vec3 {
        let list = value.expect("positions have bounds");
        let numbers = list.as_array().expect("bounds are lists").iter();
        Vec3::from_slice(&numbers.map(|number| number.as_f64().expect("a number") as f32).collect::<Vec<_>>())
    };
    let (low, high) =
        positions.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), &p| (low.min(p), high.max(p)));
    assert_eq!((bound(accessor.min()), bound(accessor.max())), (low, high), "bounds are exact");

    let counts = [positions.len(), normals.len(), uvs.len()];
    assert!(counts.iter().all(|&count| count == counts[0]) && indices.len().is_multiple_of(3));
    assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-4));
    let is_short = primitive.indices().expect("indices").data_type() == DataType::U16;
    assert_eq!(is_short, positions.len() <= 65_535);
    // The largest index of a type restarts strips, so it may not name a vertex.
    assert!(
        indices.iter().all(|&index| (index as usize) < positions.len() && !(is_short && index == 0xffff))
    );
    ReadMesh { name, positions, normals, uvs, indices }
}
