use std::fs;

use espalier_proto::{
    PlacedShape,
    version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES, MAX_MODEL_BYTES},
};
use espalier_tests::{
    client::Client,
    http::{self, Answer},
    program,
    scratch::Scratch,
    server::Server,
};
use serde_json::{Value, json};

const GLB: &str = "model/gltf-binary";

fn at(x: f32, y: f32, z: f32) -> Value {
    json!({ "position": [x, y, z], "rotation": [0.0, 0.0, 0.0, 1.0] })
}

/// One triangle of 1 m, high enough not to lie in the seed's way.
const TRIANGLE: [[f32; 3]; 3] = [[0.0, 3.0, 0.0], [1.0, 3.0, 0.0], [0.0, 4.0, 0.0]];

/// A glTF binary with one triangle; corners in metres.
fn model(corners: [[f32; 3]; 3]) -> Vec<u8> {
    let blob: Vec<u8> = corners.into_iter().flatten().flat_map(f32::to_le_bytes).collect();
    let json = json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": blob.len() }],
        "buffers": [{ "byteLength": blob.len() }],
    });
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + json.len() + 8 + blob.len();
    let mut file = [b"glTF".as_slice(), &2u32.to_le_bytes(), &(length as u32).to_le_bytes()].concat();
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &blob)] {
        file.extend_from_slice(&(chunk.len() as u32).to_le_bytes());
        file.extend_from_slice(kind);
        file.extend_from_slice(chunk);
    }
    file
}

fn upload(server: &Server, session: &str, file: &[u8]) -> Answer {
    let path = format!("/api/v1/sessions/{session}/obstacles");
    http::send_bytes(server.port(), "POST", &path, GLB, file).expect("the server answers")
}

#[tokio::test]
async fn ob3_obstacles_reach_everybody_and_survive_a_crash() {
    let (mut first, server, _scratch) = Client::alone(&[]).await;
    let mut second = Client::connect(server.port(), &first.session.clone(), "browser-2").await;
    let shape = json!({ "kind": "box", "size": [1.0, 40.0, 40.0] });
    first
        .send(json!({ "kind": "place_obstacle", "obstacle": json!({ "shape": shape, "pose": at(2.0, 20.0, 0.0) }) }))
        .await;
    let shape = json!({ "kind": "sphere", "radius": 2.0 });
    first
        .send(json!({ "kind": "place_obstacle", "obstacle": json!({ "shape": shape, "pose": at(-9.0, 2.0, 0.0) }) }))
        .await;
    first.send(json!({ "kind": "move_obstacle", "id": 2, "pose": at(-12.0, 2.0, 0.0) })).await;
    first.send(json!({ "kind": "grow", "steps": 12 })).await;
    first.until_settled().await;
    let moved =
        |client: &Client| client.obstacles.get(1).is_some_and(|one| json!(one.pose) == at(-12.0, 2.0, 0.0));
    second.until("both are told, and the move", moved).await;
    let rows = &first.table.rows;
    assert!(rows.iter().all(|row| row.position[0] <= 384), "something grew through the wall");
    assert!(rows.iter().any(|row| row.position[0] < -384), "nothing grew on the free side");
    let (obstacles, form) = (first.obstacles.clone(), first.form().await);
    let server = server.kill_and_restart();
    first.reconnect(server.port()).await;
    first.until("the list comes again", |client| !client.obstacles.is_empty()).await;
    assert_eq!(first.obstacles, obstacles);
    first.until_form(&form).await;
    first.send(json!({ "kind": "remove_obstacle", "id": 1 })).await;
    first.send(json!({ "kind": "undo" })).await;
    first.send(json!({ "kind": "remove_obstacle", "id": 2 })).await;
    first.until_settled().await;
    assert_eq!(first.obstacles.iter().map(|obstacle| obstacle.id).collect::<Vec<_>>(), [1]);
}

#[tokio::test]
async fn ob6_a_gltf_file_becomes_an_obstacle() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    let session = client.session.clone();
    let answer = upload(&server, &session, &model(TRIANGLE));
    assert_eq!(answer.status, 201, "{}", answer.text());
    assert_eq!(answer.json()["id"], 1);
    client.until("it is told", |client| client.obstacles.len() == 1).await;
    // A metre is ten internodes unless the parameters say otherwise.
    assert_eq!(client.obstacles[0].shape, PlacedShape::Mesh { vertices: 3, triangles: 1, scale: 10.0 });
    let server = server.kill_and_restart();
    let path = format!("/api/v1/sessions/{session}/obstacles/1");
    let mesh = http::get(server.port(), &path).expect("the server answers");
    let words: Vec<u32> = mesh
        .body
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes(word.try_into().expect("four bytes")))
        .collect();
    assert_eq!((mesh.status, words.len(), &words[..2], &words[11..]), (200, 14, &[3, 1][..], &[0, 1, 2][..]));
    assert_eq!(f32::from_bits(words[3]), 3.0);
    client.reconnect(server.port()).await;
    client.send(json!({ "kind": "undo" })).await;
    client.until_settled().await;
    assert_eq!(client.obstacles, []);
    assert_eq!(http::get(server.port(), &path).expect("the server answers").status, 404);
}

#[tokio::test]
async fn ob1_a_tree_grows_around_an_uploaded_model() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    // A screen 2 internodes to the right, far taller and wider than the tree will be.
    let screen = model([[0.2, -5.0, -30.0], [0.2, -5.0, 30.0], [0.2, 40.0, 0.0]]);
    assert_eq!(upload(&server, &client.session.clone(), &screen).status, 201);
    client.send(json!({ "kind": "grow", "steps": 14 })).await;
    client.until_settled().await;
    let xs = || client.table.rows.iter().map(|row| row.position[0] as f32 / 256.0);
    assert!(xs().all(|x| x < 2.0), "something grew through the screen");
    assert!(xs().any(|x| x > 1.0) && xs().any(|x| x < -6.0), "it fills the room up to the screen and beyond");
}

/// An oak as the command line exports it, with options.
fn oak(scratch: &Scratch, name: &str, options: &[&str]) -> Vec<u8> {
    let out = scratch.path(name);
    let path = out.to_str().expect("a plain name");
    let grow = ["grow", "--species", "oak", "--seed", "4", "--export", path];
    let grown = program::run(&[&grow[..], options].concat());
    assert_eq!(grown.code, 0, "{}", grown.stderr);
    fs::read(out).expect("the file was written")
}

#[tokio::test]
async fn ob6_a_large_tree_of_our_own_is_simplified_and_another_one_grows_around_it() {
    let (mut client, server, scratch) = Client::alone(&[]).await;
    let session = client.session.clone();
    let large = oak(&scratch, "large.glb", &[]);
    assert!(large.len() > 32 << 20, "more than was taken once: {}", large.len());
    let packed = oak(&scratch, "packed.glb", &["--quantised", "--compressed", "--instanced"]);
    for (number, file) in [&large, &packed].into_iter().enumerate() {
        let answer = upload(&server, &session, file);
        assert_eq!(answer.status, 201, "{}", answer.text());
        let answer = answer.json();
        let count = |value: &Value| value.as_u64().expect("a number") as usize;
        let (shape, from) = (&answer["shape"], &answer["simplified_from"]);
        assert!((1..=MAX_MESH_VERTICES).contains(&count(&shape["vertices"])), "{answer}");
        assert!((1..=MAX_MESH_TRIANGLES).contains(&count(&shape["triangles"])), "{answer}");
        assert!(count(&from["triangles"]) > 4 * MAX_MESH_TRIANGLES, "{answer}");
        client.until("it is told", |client| client.obstacles.len() == number + 1).await;
    }
    // Beside the seedling, its trunk 20 internodes away.
    for id in 1..=2 {
        client
            .send(json!({ "kind": "move_obstacle", "id": id, "pose": at(20.0 * id as f32, 0.0, 0.0) }))
            .await;
    }
    client.send(json!({ "kind": "grow", "steps": 14 })).await;
    client.until_settled().await;
    assert!(client.table.rows.len() > 20, "it grows");
}

#[tokio::test]
async fn ob6_an_obj_file_becomes_an_obstacle() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    let session = client.session.clone();
    let house = "v 0 3 0\nv 1 3 0\nv 1 4 0\nv 0 4 0\nf 1 2 3 4\n";
    let answer = upload(&server, &session, house.as_bytes());
    assert_eq!(answer.status, 201, "{}", answer.text());
    assert_eq!(answer.json().get("simplified_from"), None);
    client.until("it is told", |client| client.obstacles.len() == 1).await;
    assert_eq!(client.obstacles[0].shape, PlacedShape::Mesh { vertices: 4, triangles: 2, scale: 10.0 });
    let answer = upload(&server, &session, b"v 0 3 0\nv 1 3 0\nf 1 2 3\n");
    let problem = answer.json();
    assert_eq!(
        (answer.status, &problem["reason"], &problem["field"]),
        (400, &json!("obj-damaged"), &json!("line 3"))
    );
}

#[tokio::test]
async fn ob6_what_is_no_mesh_is_refused_in_words() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    let session = client.session.clone();
    let mut cut = model(TRIANGLE);
    cut.truncate(cut.len() - 4);
    for (file, words) in [(b"solid cube".as_slice(), "glTF"), (&cut, "cut short"), (&[0; 64], "glTF")] {
        let answer = upload(&server, &session, file);
        assert_eq!(answer.status, 400, "{}", answer.text());
        let message = answer.json()["detail"].as_str().expect("a problem has a sentence").to_owned();
        assert!(message.contains(words), "{message}");
    }
    // It is refused before it comes, so none of it is sent.
    let path = format!("/api/v1/sessions/{session}/obstacles");
    let large = format!("content-length: {}\r\n", MAX_MODEL_BYTES + 1);
    let answer = http::send_with(server.port(), "POST", &path, &large, b"").expect("the server answers");
    assert_eq!(answer.status, 413);
    assert_eq!(upload(&server, "nowhere", &model(TRIANGLE)).status, 404);
    let path = format!("/api/v1/sessions/{session}/obstacles/one");
    assert_eq!(http::get(server.port(), &path).expect("the server answers").status, 400);
    client.until_settled().await;
    assert_eq!(client.obstacles, []);
    assert!(!client.state.can_undo);
}
