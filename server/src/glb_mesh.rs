//! Reads the triangles of a glTF binary: one mesh, in metres, of everything its scene shows.
//!
//! Files come from people and from the network, so every length and index is checked here; what the file says
//! about materials, textures, skins and motion is of no interest to an obstacle.

mod gltf;

use std::collections::BTreeMap;

use espalier_proto::version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES};
use espalier_session::Mesh;
use glam::{Mat4, Vec3};

use self::gltf::{Accessor, Gltf, Primitive};

/// A file is no mesh that could be an obstacle; each message ends a sentence.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum GlbError {
    /// Not this format at all.
    #[error("it is not a glTF 2.0 binary file (.glb)")]
    NotGlb,
    /// The JSON part.
    #[error("its JSON cannot be read: {0}")]
    Json(String),
    /// Something that is referred to and not there, or too short.
    #[error("its {0} is missing, too short, or not of the kind that is needed")]
    Missing(&'static str),
    /// Compressed or quantised.
    #[error("it needs the extension {0}, which is not read; export it without")]
    Extension(String),
    /// Data in another file.
    #[error("its data lies in another file; export it as one .glb")]
    External,
    /// Points or lines alone, or no scene.
    #[error("it shows no triangles")]
    Empty,
    /// Too large.
    #[error(
        "it has more than {MAX_MESH_TRIANGLES} triangles or {MAX_MESH_VERTICES} vertices; simplify it first"
    )]
    TooLarge,
    /// NaN or infinite.
    #[error("a vertex is not at a finite place")]
    NotFinite,
    /// A node that bears itself.
    #[error("its nodes are no tree")]
    NoTree,
}

/// The triangles of a file's scene; vertices at the very same place become one.
pub fn read(file: &[u8]) -> Result<Mesh, GlbError> {
    let (json, blob) = split(file)?;
    let gltf: Gltf = serde_json::from_slice(json).map_err(|error| GlbError::Json(error.to_string()))?;
    let unread = |name: &&String| UNREAD_EXTENSIONS.contains(&name.as_str());
    if let Some(name) = gltf.extensions_required.iter().find(unread) {
        return Err(GlbError::Extension(name.clone()));
    }
    let source = Source { gltf: &gltf, blob };
    let mut reader = Reader { source, weld: BTreeMap::new(), vertices: Vec::new(), triangles: Vec::new() };
    reader.read_scene()?;
    let Reader { vertices, triangles, .. } = reader;
    if triangles.is_empty() { Err(GlbError::Empty) } else { Ok(Mesh { vertices, triangles }) }
}

/// Extensions that change what a position means; files that require others look the same without them.
const UNREAD_EXTENSIONS: [&str; 4] = [
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "KHR_mesh_quantization",
];
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";
const FLOAT: u32 = 5126;
const TRIANGLES: u32 = 4;
const TRIANGLE_STRIP: u32 = 5;
const TRIANGLE_FAN: u32 = 6;

/// The JSON and the binary chunk.
fn split(file: &[u8]) -> Result<(&[u8], &[u8]), GlbError> {
    let (header, mut rest) = file.split_at_checked(12).ok_or(GlbError::NotGlb)?;
    if &header[..4] != b"glTF" || header[4..8] != 2u32.to_le_bytes() {
        return Err(GlbError::NotGlb);
    }
    let (mut json, mut binary) = (None, None);
    while let Some((head, after)) = rest.split_first_chunk::<8>() {
        let length = u32::from_le_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let (chunk, after) = after.split_at_checked(length).ok_or(GlbError::Missing("last chunk"))?;
        match &head[4..] {
            JSON_CHUNK if json.is_none() => json = Some(chunk),
            BINARY_CHUNK if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        rest = after;
    }
    Ok((json.ok_or(GlbError::NotGlb)?, binary.unwrap_or_default()))
}

/// A file's parts.
#[derive(Clone, Copy)]
struct Source<'a> {
    gltf: &'a Gltf,
    blob: &'a [u8],
}

struct Reader<'a> {
    source: Source<'a>,
    /// The vertex at each place, by the bits of its coordinates.
    weld: BTreeMap<[u32; 3], u32>,
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Reader<'_> {
    fn read_scene(&mut self) -> Result<(), GlbError> {
        let gltf = self.source.gltf;
        let scene = gltf.scenes.get(gltf.scene.unwrap_or(0)).ok_or(GlbError::Empty)?;
        let mut waiting: Vec<(usize, Mat4)> =
            scene.nodes.iter().map(|&node| (node, Mat4::IDENTITY)).collect();
        let mut visited = 0;
        while let Some((index, outer)) = waiting.pop() {
            visited += 1;
            // In a tree each node is met once.
            if visited > gltf.nodes.len() {
                return Err(GlbError::NoTree);
            }
            let node = gltf.nodes.get(index).ok_or(GlbError::Missing("node"))?;
            let place = outer * node.placement();
            if let Some(mesh) = node.mesh {
                let mesh = gltf.meshes.get(mesh).ok_or(GlbError::Missing("mesh"))?;
                for primitive in &mesh.primitives {
                    self.read_primitive(primitive, place)?;
                }
            }
            waiting.extend(node.children.iter().map(|&child| (child, place)));
        }
        Ok(())
    }

    fn read_primitive(&mut self, primitive: &Primitive, place: Mat4) -> Result<(), GlbError> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        if !(TRIANGLES..=TRIANGLE_FAN).contains(&mode) {
            return Ok(());
        }
        let Some(position) = primitive.attributes.position else { return Ok(()) };
        let count = self.source.accessor(position, "positions")?.count;
        let positions = self.source.elements(position, "positions", "VEC3", &[(FLOAT, 12)])?;
        if count > 4 * MAX_MESH_TRIANGLES {
            return Err(GlbError::TooLarge);
        }
        let mut numbers = Vec::with_capacity(count);
        for (bytes, _) in positions {
            let coordinate =
                |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
            let vertex = place.transform_point3(Vec3::new(coordinate(0), coordinate(4), coordinate(8)));
            numbers.push(self.vertex(vertex)?);
        }
        let corners = match primitive.indices {
            None => numbers,
            Some(indices) => {
                let kinds = [(5121, 1), (5123, 2), (5125, 4)];
                let indices = self.source.elements(indices, "indices", "SCALAR", &kinds)?;
                let index = |(bytes, size): (&[u8], usize)| {
                    bytes[..size].iter().rev().fold(0usize, |index, &byte| index << 8 | usize::from(byte))
                };
                let corner = |element| numbers.get(index(element)).copied();
                indices.map(corner).collect::<Option<Vec<u32>>>().ok_or(GlbError::Missing("vertex"))?
            }
        };
        let triangles: Vec<[u32; 3]> = match mode {
            TRIANGLES => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
            TRIANGLE_STRIP => {
                let turned = |(at, c): (usize, &[u32])| {
                    if at % 2 == 0 { [c[0], c[1], c[2]] } else { [c[1], c[0], c[2]] }
                };
                corners.windows(3).enumerate().map(turned).collect()
            }
            _ => corners.windows(2).skip(1).map(|c| [corners[0], c[0], c[1]]).collect(),
        };
        // A node that mirrors turns its triangles inside out.
        let mirrored = place.determinant() < 0.0;
        let turned = triangles.into_iter().map(|[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] });
        self.triangles.extend(turned.filter(|[a, b, c]| a != b && b != c && c != a));
        if self.triangles.len() > MAX_MESH_TRIANGLES { Err(GlbError::TooLarge) } else { Ok(()) }
    }

    /// The number of the vertex at a place.
    fn vertex(&mut self, place: Vec3) -> Result<u32, GlbError> {
        if !place.is_finite() {
            return Err(GlbError::NotFinite);
        }
        // Adding zero makes the negative zero a positive one.
        let key = (place + Vec3::ZERO).to_array().map(f32::to_bits);
        let next = self.vertices.len();
        let number = *self.weld.entry(key).or_insert(next as u32);
        if number as usize == next {
            if next == MAX_MESH_VERTICES {
                return Err(GlbError::TooLarge);
            }
            self.vertices.push(place);
        }
        Ok(number)
    }
}

impl<'a> Source<'a> {
    fn accessor(self, index: usize, what: &'static str) -> Result<&'a Accessor, GlbError> {
        self.gltf.accessors.get(index).ok_or(GlbError::Missing(what))
    }

    /// The elements of an accessor as bytes, each with its size, if it is of a kind (component type and size)
    /// that is wanted.
    fn elements(
        self,
        index: usize,
        what: &'static str,
        wanted: &str,
        kinds: &[(u32, usize)],
    ) -> Result<impl Iterator<Item = (&'a [u8], usize)> + use<'a>, GlbError> {
        let missing = || GlbError::Missing(what);
        let accessor = self.accessor(index, what)?;
        let kind = kinds.iter().find(|(component, _)| *component == accessor.component_type);
        let &(_, size) = kind.filter(|_| accessor.kind == wanted).ok_or_else(missing)?;
        if accessor.sparse.is_some() {
            return Err(missing());
        }
        let view =
            accessor.buffer_view.and_then(|view| self.gltf.buffer_views.get(view)).ok_or_else(missing)?;
        let buffer = self.gltf.buffers.get(view.buffer).ok_or_else(missing)?;
        if view.buffer != 0 || buffer.uri.is_some() {
            return Err(GlbError::External);
        }
        let stride = view.byte_stride.unwrap_or(size).max(size);
        let bytes = self.blob.get(view.byte_offset..).and_then(|bytes| bytes.get(..view.byte_length));
        let bytes = bytes.and_then(|bytes| bytes.get(accessor.byte_offset..)).ok_or_else(missing)?;
        let needed =
            accessor.count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
        if needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(missing());
        }
        let element = move |at: usize| (&bytes[at * stride..at * stride + size], size);
        Ok((0..accessor.count).map(element))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    /// A file with these parts; the binary chunk is padded as the format asks.
    fn glb(json: &Value, blob: &[u8]) -> Vec<u8> {
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut blob = blob.to_vec();
        blob.resize(blob.len().next_multiple_of(4), 0);
        let total = (12 + 8 + text.len() + 8 + blob.len()) as u32;
        let mut file = [b"glTF".as_slice(), &2u32.to_le_bytes(), &total.to_le_bytes()].concat();
        for (kind, chunk) in [(JSON_CHUNK, &text), (BINARY_CHUNK, &blob)] {
            file.extend_from_slice(&(chunk.len() as u32).to_le_bytes());
            file.extend_from_slice(kind);
            file.extend_from_slice(chunk);
        }
        file
    }

    /// A square of two triangles in the plane z = 0, as exporters write it: no vertex is shared.
    fn square() -> (Value, Vec<u8>) {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]];
        let mut blob: Vec<u8> =
            corners.iter().flat_map(|&[x, y]| [x as f32, y as f32, 0.0]).flat_map(f32::to_le_bytes).collect();
        blob.extend((0..6u16).flat_map(u16::to_le_bytes));
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "children": [1], "translation": [0, 2, 0] }, { "mesh": 0, "scale": [3, 3, 3] }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 7 }, "indices": 1 }] }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3" },
                { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
            ],
            "bufferViews": [
                { "buffer": 0, "byteLength": 72 },
                { "buffer": 0, "byteOffset": 72, "byteLength": 12 },
            ],
            "buffers": [{ "byteLength": 84 }],
        });
        (json, blob)
    }

    /// The sample with one part in place of what was there, or beside it.
    fn changed(pointer: &str, value: Value) -> Result<Mesh, GlbError> {
        let (mut json, blob) = square();
        let (parent, name) = pointer.rsplit_once('/').expect("a pointer has a slash");
        let parent = json.pointer_mut(parent).expect("the sample has such a part");
        match name.parse::<usize>() {
            Ok(index) => parent[index] = value,
            Err(_) => parent[name] = value,
        }
        read(&glb(&json, &blob))
    }

    #[test]
    fn nodes_place_and_vertices_are_welded() {
        let (json, blob) = square();
        let mesh = read(&glb(&json, &blob)).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        let corners = [[0.0, 2.0, 0.0], [3.0, 2.0, 0.0], [3.0, 5.0, 0.0], [0.0, 5.0, 0.0]];
        assert_eq!(mesh.vertices, corners.map(Vec3::from_array));
    }

    #[test]
    fn strips_fans_and_mirrors_keep_their_sides() {
        let strip = changed("/meshes/0/primitives/0", json!({ "attributes": { "POSITION": 0 }, "mode": 5 }));
        assert_eq!(strip.unwrap().triangles, [[0, 1, 2], [2, 1, 0], [2, 0, 3]], "one has no area");
        let fan = changed("/meshes/0/primitives/0", json!({ "attributes": { "POSITION": 0 }, "mode": 6 }));
        assert_eq!(fan.unwrap().triangles, [[0, 1, 2], [0, 2, 3]]);
        let mirrored = changed("/nodes/1/scale", json!([-1, 1, 1])).unwrap();
        assert_eq!(mirrored.triangles, [[0, 2, 1], [0, 3, 2]]);
    }

    #[test]
    fn what_is_wrong_is_said() {
        use GlbError::*;
        assert_eq!(read(b"glTF"), Err(NotGlb));
        assert_eq!(read(b"solid cube"), Err(NotGlb));
        for (pointer, value, error) in [
            ("/accessors/0/count", json!(7), Missing("positions")),
            ("/accessors/0/count", json!(u64::MAX), Missing("positions")),
            ("/accessors/0/type", json!("VEC2"), Missing("positions")),
            ("/accessors/1/count", json!(9), Missing("indices")),
            ("/accessors/1/componentType", json!(5126), Missing("indices")),
            ("/bufferViews/0/byteOffset", json!(99_999), Missing("positions")),
            ("/bufferViews/0/byteLength", json!(71), Missing("positions")),
            ("/buffers/0", json!({ "uri": "cube.bin" }), External),
            ("/nodes/1/mesh", json!(4), Missing("mesh")),
            ("/nodes/1/children", json!([0]), NoTree),
            ("/nodes/1/scale", json!([1e39, 1, 1]), NotFinite),
            ("/meshes/0/primitives/0/mode", json!(1), Empty),
            ("/scenes", json!([]), Empty),
        ] {
            assert_eq!(changed(pointer, value), Err(error), "{pointer}");
        }
        let required = json!({ "extensionsRequired": ["KHR_draco_mesh_compression"] });
        assert_eq!(read(&glb(&required, b"")), Err(Extension("KHR_draco_mesh_compression".into())));
        assert!(matches!(read(&glb(&json!({ "scene": "no" }), b"")), Err(Json(_))));
    }

    #[test]
    fn a_file_cut_anywhere_never_panics() {
        let (json, blob) = square();
        let file = glb(&json, &blob);
        for length in 0..file.len() {
            assert!(read(&file[..length]).is_err(), "{length} bytes");
        }
    }
}
