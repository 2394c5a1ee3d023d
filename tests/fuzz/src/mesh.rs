//! Meshes of obstacles (`OB4`), and the commands that carry them.

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_proto::Mesh;
use espalier_session::read_command;

/// Reads a mesh by itself and in a command; what can be read is the same when it is written and read again.
pub fn read(bytes: &[u8]) -> bool {
    let place = format!(
        r#"{{"kind":"place_obstacle","obstacle":{{"shape":{{"kind":"mesh","mesh":"{}","scale":1}},"pose":{{"position":[0,0,0]}}}}}}"#,
        STANDARD.encode(bytes)
    );
    let placed = read_command(&place);
    match Mesh::from_bytes(bytes) {
        Ok(mesh) => {
            assert_eq!(mesh.to_bytes(), bytes);
            true
        }
        Err(_) => {
            assert!(placed.is_err(), "a command takes a mesh that cannot be read");
            false
        }
    }
}

/// A tetrahedron and a single triangle.
pub fn seeds() -> Vec<Vec<u8>> {
    let bytes = |vertices: &[[f32; 3]], triangles: &[[u32; 3]]| {
        let mut bytes = Vec::new();
        bytes.extend((vertices.len() as u32).to_le_bytes());
        bytes.extend((triangles.len() as u32).to_le_bytes());
        bytes.extend(vertices.iter().flatten().flat_map(|c| c.to_le_bytes()));
        bytes.extend(triangles.iter().flatten().flat_map(|c| c.to_le_bytes()));
        bytes
    };
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    vec![bytes(&corners, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]), bytes(&corners[..3], &[[0, 1, 2]])]
}
