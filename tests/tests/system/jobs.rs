//! Trees that are grown on request.

use std::{fs, thread, time::Duration};

use espalier_tests::{client::Client, http, program, scratch::Scratch, server::Server};
use serde_json::{Value, json};

fn post(port: u16, order: &Value) -> http::Answer {
    http::send(port, "POST", "/api/v1/grow", Some(order)).expect("the server answers")
}

/// Orders a job and waits for its end.
fn done(port: u16, order: &Value) -> Value {
    let answer = post(port, order);
    assert_eq!(answer.status, 202, "{}", answer.text());
    let address = answer.header("location").expect("it says where the job is").to_owned();
    loop {
        let job = http::get(port, &address).expect("the server answers").json();
        if job["state"] == "done" || job["state"] == "failed" {
            return job;
        }
        thread::sleep(Duration::from_millis(20));
    }
}

/// All files of a job are in one, each as it is, and a part of it is that of the whole.
fn is_one_file(port: u16, address: &str, files: [(String, Vec<u8>); 2]) {
    let archive = http::get(port, address).expect("an answer");
    assert_eq!((archive.status, archive.header("content-type")), (200, Some("application/zip")));
    let zip = &archive.body;
    let number = |at: usize| u32::from_le_bytes(zip[at..at + 4].try_into().expect("four bytes")) as usize;
    let mut at = 0;
    for (name, file) in files {
        assert_eq!(
            (&zip[at..at + 4], &zip[at + 30..at + 30 + name.len()]),
            (&b"PK\x03\x04"[..], name.as_bytes())
        );
        assert_eq!((number(at + 18), number(at + 22)), (file.len(), file.len()), "nothing is packed");
        let data = at + 30 + name.len();
        assert!(zip[data..data + file.len()] == file, "{name} is in it as it is");
        at = data + file.len();
    }
    assert_eq!(
        (&zip[at..at + 4], &zip[zip.len() - 22..zip.len() - 18]),
        (&b"PK\x01\x02"[..], &b"PK\x05\x06"[..])
    );
    assert_eq!(number(zip.len() - 6), at, "its end says where its list begins");
    let part = http::send_with(port, "GET", address, "range: bytes=100-299\r\n", b"").expect("an answer");
    assert_eq!((part.status, &part.body[..]), (206, &zip[100..300]));
}

#[test]
fn jb1_the_same_seed_and_settings_give_the_file_of_the_command_line() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let name = scratch.path("juniper-{seed}.glb");
    let grown = program::run(&[
        "grow",
        "--species",
        "juniper",
        "--steps",
        "2",
        "--seeds",
        "4-5",
        "--parameter",
        "leaf_size=0.5",
        "--export",
        name.to_str().expect("a plain name"),
        "--quantised",
        "--lod",
        "1",
    ]);
    assert_eq!(grown.code, 0, "{}", grown.stderr);
    let order = json!({
        "template": "juniper",
        "parameters": { "leaf_size": 0.5 },
        "steps": 2,
        "seeds": "4-5",
        "format": "glb",
        "options": { "quantised": true, "lod": 1 },
    });
    let job = done(server.port(), &order);
    assert_eq!((&job["done"], &job["all"], &job["failed"]), (&json!(2), &json!(2), &json!([])), "{job}");
    for (result, seed) in job["results"].as_array().expect("a list").iter().zip([4, 5]) {
        let file =
            http::get(server.port(), result["address"].as_str().expect("an address")).expect("an answer");
        assert_eq!(file.header("content-type"), Some("model/gltf-binary"));
        assert_eq!((&result["seed"], &result["bytes"]), (&json!(seed), &json!(file.body.len())));
        let ours = fs::read(scratch.path(&format!("juniper-{seed}.glb"))).expect("the file is there");
        assert!(file.body == ours, "seed {seed}: {} and {} bytes", file.body.len(), ours.len());
    }
    let address = format!("/api/v1/jobs/{}", job["id"].as_str().expect("a name"));
    is_one_file(
        server.port(),
        &format!("{address}/results.zip"),
        [4, 5].map(|seed| {
            let ours = fs::read(scratch.path(&format!("juniper-{seed}.glb"))).expect("the file is there");
            (format!("{seed}.glb"), ours)
        }),
    );
    assert_eq!(http::send(server.port(), "DELETE", &address, None).expect("an answer").status, 204);
    assert_eq!(http::get(server.port(), &address).expect("an answer").status, 404);
}

#[tokio::test]
async fn jb1_a_saved_tree_gives_its_programme_parameters_and_looks() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    let port = server.port();
    client.send(json!({ "kind": "set_parameters", "parameters": { "leaf_size": 0.25 } })).await;
    client.send(json!({ "kind": "set_appearance", "appearance": { "leaves": { "season": 2 } } })).await;
    client.send(json!({ "kind": "grow", "steps": 6 })).await;
    client.until_settled().await;
    let save = json!({ "session": client.session, "name": "Mother" });
    let tree = http::send(port, "POST", "/api/v1/trees", Some(&save)).expect("an answer").json();
    let order = json!({ "template": tree["id"], "seeds": [7, 8], "format": "json" });
    let job = tokio::task::spawn_blocking(move || done(port, &order)).await.expect("it ends");
    let skeletons: Vec<Value> = job["results"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|result| {
            http::get(port, result["address"].as_str().expect("an address")).expect("a file").json()
        })
        .collect();
    // The session has seed 7 as well, and nothing was drawn in it.
    let own =
        http::get(port, &format!("/api/v1/sessions/{}/tree.json", client.session)).expect("a file").json();
    assert_eq!(skeletons[0], own);
    assert_ne!(skeletons[1]["metamers"], own["metamers"]);
    assert_eq!(skeletons[1]["parameters"], own["parameters"]);
}

#[tokio::test]
async fn jb10_a_job_says_what_of_its_template_its_trees_are_without() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    let port = server.port();
    client.send(json!({ "kind": "grow", "steps": 8 })).await;
    client.until_settled().await;
    let session = client.session.clone();
    let job_like_it = async move || {
        let save = json!({ "session": session, "name": "Mother" });
        tokio::task::spawn_blocking(move || {
            let tree = http::send(port, "POST", "/api/v1/trees", Some(&save)).expect("an answer").json();
            done(port, &json!({ "template": tree["id"], "seeds": [7], "format": "json" }))
        })
        .await
        .expect("it ends")
    };
    assert_eq!(job_like_it().await.get("notes"), None, "nothing is missing");
    client.send(json!({ "kind": "prune", "rows": [5] })).await;
    client.send(json!({ "kind": "plant_seed", "position": [9, 0, 0] })).await;
    client.until_settled().await;
    let notes = job_like_it().await["notes"].take();
    let operations = json!([{ "kind": "prune", "count": 1 }, { "kind": "seed", "count": 1 }]);
    assert_eq!((&notes[0]["note"], &notes[0]["operations"]), (&json!("by-hand-left-out"), &operations));
    assert!(notes[0]["message"].as_str().is_some_and(|text| text.contains("by hand")) && notes[1].is_null());

    // A tree of a scan is its wood.
    let job = tokio::task::spawn_blocking(move || {
        let address = "/api/v1/trees/import?name=Scan&format=csv";
        let scan = crate::imports::SCAN.as_bytes();
        let tree = http::send_bytes(port, "POST", address, "text/csv", scan).expect("an answer").json();
        done(port, &json!({ "template": tree["id"], "seeds": [7], "format": "json" }))
    });
    let notes = job.await.expect("it ends")["notes"].take();
    assert_eq!((notes[0]["note"].as_str(), notes[1].is_null()), (Some("wood-left-out"), true), "{notes}");
}

#[test]
fn jb1_what_is_wrong_is_refused_with_its_field() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let with = |more: Value| {
        let mut order = json!({ "template": "oak", "format": "glb" });
        order.as_object_mut().expect("an object").append(&mut more.as_object().expect("one").clone());
        order
    };
    for (order, field) in [
        (json!({ "format": "glb" }), "metamers"),
        (with(json!({ "format": "fbx" })), "format"),
        (with(json!({ "template": "triffid" })), "template"),
        (with(json!({ "seeds": [] })), "seeds"),
        (with(json!({ "seeds": [1, 2, 1] })), "seeds[2]"),
        (with(json!({ "seeds": "1-1001" })), "seeds"),
        (with(json!({ "seeds": "5-1" })), "seeds"),
        (with(json!({ "seeds": -1 })), "seeds"),
        (with(json!({ "metamers": 0 })), "metamers"),
        (with(json!({ "metamers": 1_000_001 })), "metamers"),
        (with(json!({ "steps": 0 })), "steps"),
        (with(json!({ "options": { "points": 5 } })), "options.points"),
        (with(json!({ "options": { "lod": 7 } })), "options.lod"),
        (with(json!({ "options": { "ticket": "0123456789abcdef" } })), "options.ticket"),
        (with(json!({ "parameters": { "leaf_size": 99 } })), "parameters.leaf_size"),
        (json!({ "steps": 1, "format": "glb", "parameters": { "leaf_size": 99 } }), "parameters.leaf_size"),
        (with(json!({ "appearance": { "leaves": { "season": 9 } } })), "appearance.leaves.season"),
        (with(json!({ "colour": "red" })), "colour"),
    ] {
        let answer = post(server.port(), &order);
        let problem = answer.json();
        assert!(answer.status == 400 || answer.status == 404, "{order}: {problem}");
        assert_eq!(problem["field"], field, "{order}: {problem}");
        assert!(problem["allowed"].is_string(), "{order}: {problem}");
    }
}
