//! `OP1`: what a later program wrote, whichever way it comes into this one: a file, an upload, the library, a session.

use std::{fs, path::Path};

use espalier_tests::{
    client::Client,
    http::{self, Answer},
    program,
    scratch::Scratch,
    server::Server,
};
use serde_json::json;

use crate::upgrades::{KEY, change, copy_of, refused_by, sessions};

/// A document with a section that no release reads.
const LATER: &[u8] = include_bytes!("../../../server/session/golden/later.espalier");
const NEEDED: &str = "section FORK of version 1, which version 9.0.0 and later ones read";

/// A document of this program, as one with another simulation would have written it.
fn of_simulation(version: u32, scratch: &Scratch) -> Vec<u8> {
    let path = scratch.path("own.espalier");
    let out = path.to_str().expect("a plain name");
    assert_eq!(program::run(&["grow", "--metamers", "100", "--export", out]).code, 0);
    let mut bytes = fs::read(path).expect("it was exported");
    bytes[16..20].copy_from_slice(&version.to_le_bytes());
    let count = u32::from_le_bytes(bytes[20..24].try_into().expect("four bytes")) as usize;
    let mut sum = crc32fast::Hasher::new();
    sum.update(&bytes[..24]);
    sum.update(&bytes[28..28 + 28 * count]);
    bytes[24..28].copy_from_slice(&sum.finalize().to_le_bytes());
    bytes
}

fn upload(server: &Server, bytes: &[u8]) -> Answer {
    let address = "/api/v1/trees/import?name=Oak&format=espalier";
    http::send_bytes(server.port(), "POST", address, "application/octet-stream", bytes)
        .expect("the server answers")
}

fn open_first(server: &Server) -> Answer {
    let trees = http::get(server.port(), "/api/v1/trees").expect("the server answers").json();
    let open = json!({ "tree": trees["trees"][0]["id"], "version": 1 });
    http::send(server.port(), "POST", "/api/v1/sessions", Some(&open)).expect("the server answers")
}

/// A kept database in which this is the saved tree.
async fn library_of(scratch: &Scratch, bytes: &[u8]) -> std::path::PathBuf {
    let path = copy_of(scratch, "clean-stop.db");
    assert!(Server::start(&path).terminate().success(), "its schema is today's from here on");
    put(&path, "documents", bytes).await;
    path
}

async fn put(path: &Path, table: &str, bytes: &[u8]) {
    let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    assert!(change(path, &format!("UPDATE {table} SET bytes = X'{hex}'")).await > 0);
}

#[tokio::test]
async fn op1_what_a_later_simulation_grew_opens_whichever_way_it_comes() {
    let scratch = Scratch::new();
    let bytes = of_simulation(99, &scratch);
    let file = scratch.path("later.espalier");
    fs::write(&file, &bytes).expect("the scratch folder can be written");
    let taken = program::run(&["import", file.to_str().expect("a plain name"), "--grow", "1"]);
    assert_eq!(taken.code, 0, "{}", taken.stderr);
    let path = library_of(&scratch, &bytes).await;
    change(&path, "UPDATE documents SET simulation_version = 99").await;
    change(&path, "UPDATE sessions SET simulation_version = 99").await;
    let session = sessions(&path).await.remove(0);
    let server = Server::start(&path);
    let opened = open_first(&server);
    assert_eq!(opened.status, 201, "{}", opened.text());
    let uploaded = upload(&server, &bytes);
    assert_eq!(uploaded.status, 201, "{}", uploaded.text());
    let mut client = Client::connect(server.port(), &session, KEY).await;
    client.until_settled().await;
    assert_eq!(client.notices, [], "every entry is in a snapshot");
    assert!(client.state.metamers > 100);
}

#[tokio::test]
async fn op1_hs6_what_needs_a_later_program_is_refused_whichever_way_it_comes() {
    let scratch = Scratch::new();
    let file = scratch.path("later.espalier");
    fs::write(&file, LATER).expect("the scratch folder can be written");
    let refused = program::run(&["import", file.to_str().expect("a plain name"), "--grow", "1"]);
    assert!(refused.code == 2 && refused.stderr.contains(NEEDED), "{}", refused.stderr);
    let path = library_of(&scratch, LATER).await;
    put(&path, "snapshots", LATER).await;
    let session = sessions(&path).await.remove(0);
    let server = Server::start(&path);
    let export = format!("/api/v1/sessions/{session}/tree.glb");
    let export = http::get(server.port(), &export).expect("the server answers");
    for answer in [open_first(&server), upload(&server, LATER), export] {
        let sentence = answer.json()["detail"].as_str().unwrap_or_default().to_owned();
        assert_eq!(answer.status, 409, "{}", answer.text());
        assert!(
            sentence.starts_with("A newer Espalier made this tree (") && sentence.contains(NEEDED),
            "{sentence}"
        );
    }
    let frame = refused_by(server.port(), &session).await;
    assert_eq!(u16::from(frame.code), 4007);
    assert!(frame.reason.contains(NEEDED), "{}", frame.reason);
    let trees = http::get(server.port(), "/api/v1/trees").expect("the server answers").json();
    assert_eq!(trees["trees"].as_array().map(Vec::len), Some(1), "nothing was kept of what was refused");
}
