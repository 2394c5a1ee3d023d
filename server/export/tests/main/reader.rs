//! A strict reader of glTF binary files: the `gltf` crate's validation, and what the specification asks beyond it.

use glam::{Vec2, Vec3, Vec4};
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
    pub tangents: Vec<Vec4>,
    pub uvs: Vec<Vec2>,
    /// Places in the light map, where there is one.
    pub lit: Vec<Vec2>,
    /// Linear.
    pub colours: Vec<Vec3>,
    /// The mean of what its texture shows, linear; white without one.
    pub texture_mean: Vec3,
    /// Those of cuts last.
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
    scene
        .nodes()
        .flat_map(|plant| {
            assert!(plant.mesh().is_none());
            plant.children().map(|node| read_node(&node, blob)).collect::<Vec<_>>()
        })
        .collect()
}

fn read_node(node: &gltf::Node, blob: &[u8]) -> ReadMesh {
    let mesh = node.mesh().expect("children have meshes");
    let name = node.name().expect("nodes have names").to_owned();
    let mut primitives = mesh.primitives();
    let first = primitives.next().expect("a mesh has a primitive");
    let mut read = read_primitive(name, &first, blob);
    for cut in primitives {
        assert_eq!(cut.material().name(), Some("Cut"));
        // The very same vertices.
        let places = |one: &Primitive| one.get(&Semantic::Positions).map(|places| places.index());
        assert_eq!(places(&cut), places(&first));
        let indices = cut.reader(|_| Some(blob)).read_indices().expect("indices").into_u32();
        read.indices.extend(indices);
    }
    read
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
        let stride = view.stride().unwrap_or(accessor.size());
        assert_eq!(accessor.count() * stride, view.length());
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
    let lit = reader.read_tex_coords(1).map(|places| places.into_f32().map(Vec2::from_array).collect());
    let tangents: Vec<Vec4> = reader.read_tangents().expect("tangents").map(Vec4::from_array).collect();
    for (tangent, normal) in tangents.iter().zip(&normals) {
        let along = tangent.truncate();
        assert!(
            (along.length() - 1.0).abs() < 1e-4 && along.dot(*normal).abs() < 1e-3 && tangent.w.abs() == 1.0
        );
    }
    let colours = reader.read_colors(0).expect("colours").into_rgb_f32().map(Vec3::from_array).collect();
    let material = primitive.material();
    let is_thin = name != "Wood";
    assert_eq!(material.name(), Some(if is_thin { name.as_str() } else { "Bark" }));
    assert_eq!(
        (material.double_sided(), material.alpha_mode() == gltf::material::AlphaMode::Mask),
        (is_thin, is_thin)
    );
    assert!(
        material.normal_texture().is_some() && material.pbr_metallic_roughness().metallic_factor() == 0.0
    );
    let texture = material.pbr_metallic_roughness().base_color_texture().expect("a texture").texture();
    let texture_mean = mean_of(&texture, blob);
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
    ReadMesh {
        name,
        positions,
        normals,
        tangents,
        uvs,
        lit: lit.unwrap_or_default(),
        colours,
        texture_mean,
        indices,
    }
}

/// The mean colour of what a texture covers, linear.
fn mean_of(texture: &gltf::Texture, blob: &[u8]) -> Vec3 {
    let gltf::image::Source::View { view, .. } = texture.source().source() else {
        panic!("images are inside")
    };
    let png = &blob[view.offset()..view.offset() + view.length()];
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("it is a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size().expect("it fits memory")];
    let info = reader.next_frame(&mut bytes).expect("it is whole");
    let channels = info.color_type.samples();
    let covered: Vec<Vec3> = bytes
        .chunks_exact(channels)
        .filter(|texel| texel.get(3).is_none_or(|&cover| cover >= 128))
        .map(|texel| Vec3::new(texel[0].into(), texel[1].into(), texel[2].into()) / 255.0)
        .map(|colour| colour.map(|channel| libm::powf(channel, 2.2)))
        .collect();
    covered.iter().sum::<Vec3>() / covered.len() as f32
}
