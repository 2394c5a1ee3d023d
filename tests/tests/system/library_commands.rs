//! The library on the command line, beside a server and without one.

use std::{fs, path::Path};

use espalier_tests::{client::Client, http, program, scratch::Scratch, server::Server};
use serde_json::{Value, json};

/// A trunk and a branch, as a scanner's program has them.
const SCAN: &str = include_str!("../../fuzz/seeds/rtwig.csv");

/// Runs `espalier library` on a database; what it printed.
fn library(database: &Path, arguments: &[&str]) -> String {
    let finished = run(database, arguments);
    assert_eq!(finished.code, 0, "{arguments:?}: {}", finished.stderr);
    finished.stdout
}

fn run(database: &Path, arguments: &[&str]) -> program::Finished {
    let database = database.to_str().expect("a plain name");
    program::run(&[&["library"], arguments, &["--database", database]].concat())
}

fn lines(printed: &str) -> Vec<Value> {
    printed.lines().map(|line| serde_json::from_str(line).expect("an object on a line")).collect()
}

/// Saves what a session holds as a tree; its identifier.
async fn saved(port: u16, session: &str, name: &str) -> String {
    let save = json!({ "session": session, "name": name });
    let answer = http::send(port, "POST", "/api/v1/trees", Some(&save)).expect("the server answers");
    assert_eq!(answer.status, 201, "{}", answer.text());
    answer.json()["id"].as_str().expect("an identifier").to_owned()
}

#[tokio::test]
async fn trees_are_read_beside_a_server_and_changed_without_one() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let session = server.new_session(3);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    client.send(json!({ "kind": "grow", "steps": 6 })).await;
    client.until_settled().await;
    let oak = saved(server.port(), &session, "Old oak").await;
    saved(server.port(), &session, "Twin").await;
    saved(server.port(), &session, "Twin").await;
    let skeleton =
        http::get(server.port(), &format!("/api/v1/sessions/{session}/tree.json")).expect("a file");

    let listed = lines(&library(&database, &["ls", "--json", "--sort", "name"]));
    let names: Vec<_> = listed.iter().map(|line| line["name"].as_str().expect("a name")).collect();
    assert_eq!(names, ["Old oak", "Twin", "Twin"]);
    assert_eq!((&listed[0]["id"], &listed[0]["metamers"]), (&json!(oak), &json!(client.state.metamers)));
    let table = library(&database, &["find", "old", "OAK"]);
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows.len() == 2 && rows[0].starts_with("ID") && rows[1].starts_with(&oak), "{table}");
    let printed = library(&database, &["export", "Old oak", "-", "--format", "json"]);
    assert_eq!(printed.as_bytes(), skeleton.body, "the file is that of the server");
    let ply = scratch.path("oak.ply");
    library(&database, &["export", &oak, ply.to_str().expect("a plain name"), "--points", "500"]);
    assert!(fs::metadata(&ply).is_ok_and(|file| file.len() > 5000));
    let document = scratch.path("Kept oak.espalier");
    let document = document.to_str().expect("a plain name");
    library(&database, &["get", &oak, document]);
    let kept = http::get(server.port(), &format!("/api/v1/trees/{oak}/versions/1/document")).expect("a file");
    assert_eq!(fs::read(document).expect("it is there"), kept.body);

    for (arguments, code, said) in [
        (&["put", document][..], 1, "A server is using the database"),
        (&["restore", &oak, "1"], 1, "A server is using the database"),
        (&["versions", "Twin"], 1, "2 trees are called"),
        (&["versions", "Elm"], 1, "no tree \"Elm\" in the library;"),
        (&["versions", "old oka"], 1, "no tree \"old oka\" in the library (did you mean Old oak?);"),
        (&["export", "Old oak", "oak.gltf"], 2, "unknown format `gltf`: did you mean `glb`?"),
        (&["get", &oak, "-", "--version", "9"], 1, "no version 9"),
        (&["export", &oak, "-"], 2, "--format"),
        (&["export", &oak, "a.mtg", "--hull"], 2, "no option `hull`"),
        (&["ls", "--species", "oka"], 2, "There is no species \"oka\" (did you mean oak?)."),
    ] {
        let finished = run(&database, arguments);
        assert_eq!(finished.code, code, "{arguments:?}: {}", finished.stderr);
        assert!(finished.stderr.contains(said), "{arguments:?}: {}", finished.stderr);
    }

    #[cfg(unix)]
    {
        let link = scratch.path("link.db");
        fs::hard_link(&database, &link).expect("a second name");
        let elsewhere = run(&link, &["ls"]);
        assert_eq!(elsewhere.code, 1);
        assert!(elsewhere.stderr.contains("a server is using it by another name"), "{}", elsewhere.stderr);
        fs::remove_file(&link).expect("it can be removed");
    }

    assert!(server.terminate().success());
    library(&database, &["put", document]);
    library(&database, &["put", document, "--to", "Old oak", "--note", "Again"]);
    library(&database, &["restore", &oak, "1"]);
    let versions = lines(&library(&database, &["versions", &oak, "--json"]));
    let told: Vec<_> = versions.iter().map(|version| (&version["number"], &version["note"])).collect();
    assert_eq!(told, [(&json!(3), &json!("")), (&json!(2), &json!("Again")), (&json!(1), &json!(""))]);
    assert_eq!(versions[0]["restored"], 1);
    let found = lines(&library(&database, &["find", "kept", "--json"]));
    assert_eq!((found.len(), &found[0]["name"]), (1, &json!("Kept oak")));
    let put = found[0]["id"].as_str().expect("an identifier");
    let server = Server::start(&database);
    for (tree, version) in [(put, 1), (oak.as_str(), 2)] {
        let path = format!("/api/v1/trees/{tree}/versions/{version}/thumbnail");
        let picture = http::get(server.port(), &path).expect("the server answers");
        assert_eq!((picture.status, picture.header("content-type")), (200, Some("image/png")));
        assert!(picture.body.starts_with(b"\x89PNG") && picture.body.len() > 2000, "{}", picture.body.len());
    }
    assert!(server.terminate().success());
    let missing = run(&database, &["restore", &oak, "7"]);
    assert!(missing.code == 1 && missing.stderr.contains("no version 7"), "{}", missing.stderr);
    let scan = scratch.path("scan.csv");
    fs::write(&scan, SCAN).expect("the scratch folder can be written");
    let scan = scan.to_str().expect("a plain name");
    library(&database, &["put", scan, "--name", "Scan"]);
    library(&database, &["put", scan, "--to", "Scan", "--internode-length", "0.05"]);
    library(&database, &["put", scan, "--to", "Scan", "--internode-length", "0.05", "--unit", "0.5"]);
    let versions = lines(&library(&database, &["versions", "Scan", "--json"]));
    let metamers: Vec<_> = versions.iter().map(|version| &version["metamers"]).collect();
    assert_eq!(metamers, [&json!(19), &json!(37), &json!(4)], "half the unit is half the size");
    let unseen = run(&database, &["put", document, "--name", "\u{202e}"]);
    assert_eq!(unseen.code, 2, "{}", unseen.stderr);
}
