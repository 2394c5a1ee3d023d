//! Models that become obstacles.

use std::io::Cursor;

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_import::{Limits, read_model};
use serde_json::{Value, json};

const LIMITS: Limits = Limits { vertices: 100, triangles: 150, most_triangles: 2000 };

/// Reads a glTF file; what it gives is within the limits, and every corner is there.
pub fn read(bytes: &[u8]) -> bool {
    read_within_limits(bytes)
}

/// Reads a file; what it gives is within the limits, and every corner is there.
pub(crate) fn read_within_limits(bytes: &[u8]) -> bool {
    let Ok(model) = read_model(&mut Cursor::new(bytes), &LIMITS) else { return false };
    let mesh = model.triangles;
    assert!(mesh.vertices.len() <= LIMITS.vertices && mesh.corners.len() <= LIMITS.triangles);
    assert!(mesh.vertices.iter().all(|vertex| vertex.is_finite()));
    assert!(mesh.corners.iter().flatten().all(|&corner| (corner as usize) < mesh.vertices.len()));
    true
}

/// One model as JSON with its buffer inside, and as GLB, in a tree of nodes; the same with instances, quantised and
/// compressed.
pub fn seeds() -> Vec<Vec<u8>> {
    let corners: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut binary: Vec<u8> = corners.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    binary.extend([0u8, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&binary));
    let embedded = document(&json!({ "byteLength": 60, "uri": uri }));
    let packed = document(&json!({ "byteLength": 60 }));
    vec![embedded.to_string().into_bytes(), glb(&packed, &binary), compressed()]
}

/// A model with all extensions that are read.
fn compressed() -> Vec<u8> {
    let vertices: [[i16; 4]; 4] = [[0, 0, 0, 0], [32767, 0, 0, 0], [0, 32767, 0, 0], [0, 0, -32767, 0]];
    let corners = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
    let places: Vec<[f32; 3]> = (0..40).map(|i| [i as f32, 0.0, 0.0]).collect();
    let parts = [
        meshopt::encode_vertex_buffer(&vertices).expect("it packs"),
        meshopt::encode_index_buffer(&corners, 4).expect("it packs"),
        meshopt::encode_vertex_buffer(&places).expect("it packs"),
    ];
    let (mut binary, mut views, mut unpacked) = (Vec::new(), Vec::new(), 0);
    for (part, [count, stride], mode) in [
        (&parts[0], [4, 8], "ATTRIBUTES"),
        (&parts[1], [12, 2], "TRIANGLES"),
        (&parts[2], [40, 12], "ATTRIBUTES"),
    ] {
        views.push(json!({
            "buffer": 1, "byteOffset": unpacked, "byteLength": count * stride,
            "byteStride": if mode == "ATTRIBUTES" { json!(stride) } else { Value::Null },
            "extensions": { "EXT_meshopt_compression": {
                "buffer": 0, "byteOffset": binary.len(), "byteLength": part.len(),
                "byteStride": stride, "count": count, "mode": mode, "filter": "NONE"
            }}
        }));
        unpacked += count * stride;
        binary.extend(part);
        binary.resize(binary.len().next_multiple_of(4), 0);
    }
    let document = json!({
        "asset": { "version": "2.0" },
        "extensionsRequired": ["KHR_mesh_quantization", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"],
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "A_LOD0", "mesh": 0, "scale": [2.0, 2.0, 2.0],
            "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 2 } } } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5122, "normalized": true, "type": "VEC3", "count": 4 },
            { "bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 12 },
            { "bufferView": 2, "componentType": 5126, "type": "VEC3", "count": 40 }
        ],
        "bufferViews": views,
        "buffers": [
            { "byteLength": binary.len() },
            { "byteLength": unpacked, "extensions": { "EXT_meshopt_compression": { "fallback": true } } }
        ]
    });
    glb(&document, &binary)
}

fn document(buffer: &Value) -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "children": [1, 2], "translation": [0.0, 1.0, 0.0], "rotation": [0.0, 0.6, 0.0, 0.8] },
            { "mesh": 0, "scale": [2.0, 2.0, -2.0] },
            { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1] }
        ],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0 }, "indices": 1 },
            { "attributes": { "POSITION": 0 }, "mode": 5 }
        ] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4,
              "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0] },
            { "bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 12 }
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 }
        ],
        "buffers": [buffer]
    })
}

fn glb(document: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF".to_vec();
    for word in [2, (12 + 8 + json.len() + 8 + binary.len()) as u32, json.len() as u32, 0x4e4f_534a] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(json);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}
