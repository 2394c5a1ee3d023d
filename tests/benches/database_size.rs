//! What trees take of a database's file: saved, saved again a stroke later, and given back when they are deleted.

use std::{fs, path::Path, thread, time::Duration};

use espalier_tests::{client::Client, http, scratch::Scratch, server::Server, strokes::upward};
use serde_json::{Value, json};

/// Living metamers of the tree, at least.
const METAMERS: u32 = 100_000;
/// Trees of other files, which nobody has opened, that are deleted.
const FILES: u32 = 3;
/// How long a file may take to shrink: it is looked at in between.
const LOOKS: u32 = 300;
const PAUSE: Duration = Duration::from_millis(200);

#[tokio::main]
async fn main() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let session = server.new_session(2);
    let mut client = Client::connect(server.port(), &session, "somebody-who-grows").await;
    while client.state.metamers < METAMERS {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until_settled().await;
    }
    let save = json!({ "session": session, "name": "Large" });
    let tree = id(&post(&server, "/api/v1/trees", &save));
    let document =
        http::get(server.port(), &format!("/api/v1/trees/{tree}/versions/1/document")).expect("a file");
    println!("{} metamers, a document of {} kB", client.state.metamers, document.body.len() / 1000);
    let (server, saved) = resting(server, &database, "saved as a tree, with its session");

    client.reconnect(server.port()).await;
    for command in upward(1, 12.0, 3.0) {
        client.send(command).await;
    }
    client.until_settled().await;
    post(&server, &format!("/api/v1/trees/{tree}/versions"), &json!({ "session": session }));
    drop(client);
    let (server, later) = resting(server, &database, "a version one stroke later");
    println!("  that is {:.1} % more", 100.0 * (later as f64 / saved as f64 - 1.0));

    let mut trees = Vec::new();
    for seed in 0..FILES {
        let bytes = other(10 + seed).await;
        let path = format!("/api/v1/trees/import?name=File+{seed}&format=espalier");
        let kind = "application/octet-stream";
        let answer =
            http::send_bytes(server.port(), "POST", &path, kind, &bytes).expect("the server answers");
        assert_eq!(answer.status, 201, "{}", answer.text());
        trees.push(id(&answer.json()));
    }
    let (server, full) = resting(server, &database, "with trees of three files more");
    for tree in trees {
        for address in [format!("/api/v1/trees/{tree}"), format!("/api/v1/trees/{tree}/for-good")] {
            let answer = http::send(server.port(), "DELETE", &address, None).expect("the server answers");
            assert_eq!(answer.status, 204, "{}", answer.text());
        }
    }
    for _ in 0..LOOKS {
        if size(&database) < later + (full - later) / 10 {
            break;
        }
        thread::sleep(PAUSE);
    }
    println!("  while the server runs on after they were deleted: {} kB", size(&database) / 1000);
    let (server, back) = resting(server, &database, "after they were deleted for good");
    println!("  of what they took {:.1} % came back", 100.0 * (full - back) as f64 / (full - later) as f64);
    assert!(server.terminate().success());
}

/// The document of another tree, grown on a server of its own.
async fn other(seed: u32) -> Vec<u8> {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("other.db"));
    let session = server.new_session(seed);
    let mut client = Client::connect(server.port(), &session, "somebody-else").await;
    while client.state.metamers < METAMERS {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until_settled().await;
    }
    let path = format!("/api/v1/sessions/{session}/tree.espalier");
    http::get(server.port(), &path).expect("a file").body
}

/// Stops the server, so that all is in the file, tells how large that is, and starts it again.
fn resting(server: Server, database: &Path, what: &str) -> (Server, u64) {
    let port = server.port();
    assert!(server.terminate().success());
    let bytes = size(database);
    println!("  {what}: {} kB", bytes / 1000);
    (Server::start_on(database, port), bytes)
}

fn size(database: &Path) -> u64 {
    fs::metadata(database).map_or(0, |file| file.len())
}

fn id(tree: &Value) -> String {
    tree["id"].as_str().unwrap_or_default().to_owned()
}

fn post(server: &Server, address: &str, body: &Value) -> Value {
    let answer = http::send(server.port(), "POST", address, Some(body)).expect("the server answers");
    assert!(answer.status < 300, "{address}: {}", answer.text());
    answer.json()
}
