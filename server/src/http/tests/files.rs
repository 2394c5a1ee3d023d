//! Every refusal of a file names the part at fault and what is allowed there, at every address that takes one.

use serde_json::{Value, json};

use super::*;

const OBSTACLES: &str = "POST /api/v1/sessions/{session}/obstacles";
const QSM: &str = "POST /api/v1/trees/import?name=Oak&format=csv";
const MTG: &str = "POST /api/v1/trees/import?name=Oak&format=mtg";
const SKELETON: &str = "POST /api/v1/trees/import?name=Oak&format=json";
const DOCUMENT: &str = "POST /api/v1/trees/import?name=Oak&format=espalier";

/// A trunk and a branch, as a scanner's program has them.
const SCAN: &str = include_str!("../../../../tests/fuzz/seeds/rtwig.csv");
/// A document with a section that no release reads.
const LATER: &[u8] = include_bytes!("../../../session/golden/later.espalier");

/// Files that are refused: where they are sent, what they are, and what the refusal says in `reason`, `field` and
/// `allowed`.
type Refused = (&'static str, Vec<u8>, &'static str, &'static str, &'static str);

fn refused() -> Vec<Refused> {
    let gltf = |rest: Value| {
        let mut file = json!({ "asset": { "version": "2.0" } });
        file.as_object_mut().unwrap().append(&mut rest.as_object().unwrap().clone());
        file.to_string().into_bytes()
    };
    let triangles = |count: usize| {
        let corners = 3 * count;
        let uri = format!("data:application/octet-stream;base64,{}", "A".repeat(corners * 16));
        gltf(json!({
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
            "accessors": [{ "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": corners }],
            "bufferViews": [{ "buffer": 0, "byteLength": corners * 12 }],
            "buffers": [{ "uri": uri, "byteLength": corners * 12 }],
        }))
    };
    let sound = "glTF 2.0 as .glb, or as .gltf with its buffers inside";
    let obstacle = |file, reason, allowed| (OBSTACLES, file, reason, "body", allowed);
    let tree = |address, file: &str, field, allowed| {
        (address, file.as_bytes().to_vec(), "not-a-tree-file", field, allowed)
    };
    let later = "a document that this version of Espalier reads";
    vec![
        obstacle(b"a garden gnome".into(), "not-gltf", sound),
        obstacle(Vec::new(), "not-gltf", sound),
        obstacle(br#"{"asset":{"version":"1.0"}}"#.into(), "gltf-version", sound),
        obstacle(b"glTF\x01\0\0\0".into(), "gltf-version", sound),
        obstacle(
            gltf(json!({ "buffers": [{ "uri": "gnome.bin", "byteLength": 12 }] })),
            "gltf-buffers",
            sound,
        ),
        obstacle(gltf(json!({ "buffers": [{ "byteLength": 12 }] })), "gltf-damaged", sound),
        obstacle(b"glTF\x02\0\0\0".into(), "gltf-damaged", sound),
        obstacle(
            gltf(json!({ "extensionsRequired": ["KHR_draco_mesh_compression"] })),
            "gltf-needs",
            "glTF 2.0 as .glb, or as .gltf with its buffers inside, without the extension KHR_draco_mesh_compression",
        ),
        obstacle(gltf(json!({})), "empty-mesh", "at least one triangle"),
        obstacle(triangles(131_073), "large-mesh", "up to 131072 triangles and 65536 vertices"),
        tree(QSM, "", "line 1", "cylinders of a QSM (.csv)"),
        tree(QSM, "a,b\n1,2\n", "line 1", "cylinders of a QSM (.csv)"),
        tree(QSM, &SCAN.replace("0.02,0.5", "-0.02,0.5"), "line 3, column 10", "more than 0"),
        tree(
            QSM,
            &SCAN.replace("20,30,6,", "20,30,6e9,"),
            "line 2",
            "up to 100 m, as far as 1000 internodes of 0.1 m reach",
        ),
        tree(MTG, "", "body", "a multiscale tree graph (.mtg)"),
        tree(MTG, "CODE:\tFORM-A\nMTG:\n", "body", "a multiscale tree graph (.mtg)"),
        tree(MTG, SCAN, "line 1", "a multiscale tree graph (.mtg)"),
        tree(SKELETON, "", "line 1, column 0", "a skeleton (.json)"),
        tree(SKELETON, "{}", "format", "espalier-skeleton"),
        tree(DOCUMENT, "", "body", "a document (.espalier)"),
        tree(DOCUMENT, "an oak", "body", "a document (.espalier)"),
        (DOCUMENT, LATER[..20].to_vec(), "not-a-tree-file", "body", "a document (.espalier)"),
        (DOCUMENT, LATER.to_vec(), "newer-program", "body", later),
    ]
}

/// Addresses whose files are tried.
pub(super) fn addresses() -> impl Iterator<Item = &'static str> {
    refused().into_iter().map(|(address, ..)| address.split('?').next().unwrap())
}

#[tokio::test]
async fn every_refused_file_names_the_part_at_fault_and_what_is_allowed() {
    let (server, _) = server().await;
    for (address, file, reason, field, allowed) in refused() {
        let asked = format!("{address} with {:?}", String::from_utf8_lossy(&file[..file.len().min(60)]));
        let request = request(&method_of(address), &filled(path_of(address)));
        let answer = server.clone().oneshot(request.body(Body::from(file)).unwrap()).await.unwrap();
        let status = answer.status();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let problem: Value = serde_json::from_slice(&bytes).unwrap_or_default();
        let found = ["reason", "field", "allowed"].map(|name| problem[name].as_str().unwrap_or_default());
        assert_eq!(found, [reason, field, allowed], "{asked}: {problem}");
        let expected =
            if problem["code"] == "refused" { StatusCode::CONFLICT } else { StatusCode::BAD_REQUEST };
        assert_eq!(status, expected, "{asked}: {problem}");
    }
}
