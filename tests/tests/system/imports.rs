use std::{
    fs,
    io::{Read, Write},
    net::{Shutdown, TcpStream},
};

use espalier_proto::version::MAX_WOOD_BYTES;
use espalier_tests::{
    client::Client,
    http::{self, Answer},
    program,
    scratch::Scratch,
    server::Server,
};
use serde_json::{Value, json};

/// A trunk and a branch, as a scanner's program has them.
pub const SCAN: &str = include_str!("../../fuzz/seeds/rtwig.csv");

fn post(server: &Server, query: &str, file: &str) -> Answer {
    let path = format!("/api/v1/trees/import?{query}");
    http::send_bytes(server.port(), "POST", &path, "text/csv", file.as_bytes()).expect("the server answers")
}

fn saved(server: &Server) -> usize {
    let list = http::get(server.port(), "/api/v1/trees").expect("the server answers").json();
    list["trees"].as_array().map_or(0, Vec::len)
}

#[tokio::test]
async fn im1_a_scan_becomes_a_tree_that_grows_on() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let answer = post(&server, "name=Old%20oak&format=csv", SCAN);
    assert_eq!(answer.status, 201, "{}", answer.text());
    let tree = answer.json();
    assert_eq!((&tree["name"], &tree["metamers"]), (&json!("Old oak"), &json!(4)));
    let server = server.kill_and_restart();
    let body = json!({ "tree": tree["id"] });
    let session =
        http::send(server.port(), "POST", "/api/v1/sessions", Some(&body)).expect("the server answers");
    let session = session.json()["session"].as_str().expect("a name").to_owned();
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    client.until_settled().await;
    assert_eq!((client.state.metamers, client.state.leaves), (4, 16));
    client.send(json!({ "kind": "grow", "steps": 3 })).await;
    client.until_settled().await;
    assert!(client.state.metamers > 4);
}

#[tokio::test]
async fn im1_what_cannot_be_read_is_refused_and_not_kept() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let good = "name=Oak&format=csv";
    let graph = include_str!("../../fuzz/seeds/own.mtg");
    let ring = SCAN.replacen("1,0,20", "1,3,20", 1);
    let cases = [
        (good, SCAN.replace("0.02,0.5", "NaN,0.5"), "out_of_range", json!("line 3, column 10")),
        (good, ring, "malformed", json!("line 2")),
        (good, SCAN.replace("0.02,0.5", "-0.02,0.5"), "out_of_range", json!("line 3, column 10")),
        (good, "name,height,dbh\noak,12,0.4\n".to_owned(), "malformed", json!("line 1")),
        (good, "../../etc/passwd".to_owned(), "malformed", json!("line 1")),
        ("name=Oak&format=mtg", graph[..graph.len() / 3].to_owned(), "malformed", json!("body")),
        ("name=Oak&format=mtg", SCAN.to_owned(), "malformed", json!("line 1")),
        ("name=Oak&format=exe", SCAN.to_owned(), "out_of_range", json!("format")),
        ("name=Oak&format=csv&unit=0", SCAN.to_owned(), "out_of_range", json!("unit")),
        ("name=%07&format=csv", SCAN.to_owned(), "out_of_range", json!("name")),
        ("name=Oak&format=csv&colour=red", SCAN.to_owned(), "malformed", json!("colour")),
        ("format=csv", SCAN.to_owned(), "malformed", json!("name")),
    ];
    for (query, file, code, field) in cases {
        let answer = post(&server, query, &file);
        assert_eq!(answer.status, 400, "{query}: {}", answer.text());
        let problem = answer.json();
        assert_eq!((&problem["code"], &problem["field"]), (&json!(code), &field), "{problem}");
    }
    assert_eq!(saved(&server), 0);
}

#[tokio::test]
async fn im1_of_a_file_that_breaks_off_nothing_is_kept() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    for cut in [0, 1, SCAN.len() / 2, SCAN.len() - 1] {
        let mut stream = TcpStream::connect(("127.0.0.1", server.port())).expect("the server listens");
        let head = format!(
            "POST /api/v1/trees/import?name=Oak&format=csv HTTP/1.1\r\nhost: 127.0.0.1:{}\r\n\
             content-type: text/csv\r\ncontent-length: {}\r\n\r\n{}",
            server.port(),
            SCAN.len(),
            &SCAN[..cut]
        );
        stream.write_all(head.as_bytes()).expect("it takes the request");
        stream.shutdown(Shutdown::Write).expect("it is open");
        let mut answer = String::new();
        // It may be told that the file is not whole, or nothing.
        let _ = stream.read_to_string(&mut answer);
        assert!(!answer.starts_with("HTTP/1.1 2"), "after {cut} bytes: {answer}");
    }
    assert_eq!(saved(&server), 0);
    assert_eq!(post(&server, "name=Oak&format=csv", SCAN).status, 201, "and the whole file is taken");
}

#[tokio::test]
async fn im1_a_name_is_no_path() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let answer = post(&server, "name=../../etc/passwd&format=csv", SCAN);
    assert_eq!(answer.status, 201, "{}", answer.text());
    let tree = answer.json();
    assert_eq!(tree["name"], "../../etc/passwd", "it is a name like any other");
    let id = tree["id"].as_str().expect("an identifier");
    let path = format!("/api/v1/trees/{id}/versions/1/tree.mtg");
    let file = http::get(server.port(), &path).expect("the server answers");
    let name = file.header("content-disposition").expect("it has a name").to_owned();
    assert!(
        file.status == 200 && !name.contains('/') && !name.contains("%2F") && !name.contains(".."),
        "{name}"
    );
    for id in ["..%2F..%2Fetc%2Fpasswd", "%2E%2E", "..%5C"] {
        let path = format!("/api/v1/trees/{id}/versions/1/tree.mtg");
        assert_eq!(http::get(server.port(), &path).expect("the server answers").status, 404, "{id}");
    }
}

#[tokio::test]
async fn lm14_a_file_is_bounded_in_bytes_and_metamers() {
    let scratch = Scratch::new();
    let server = Server::start_with(&scratch.path("trees.db"), 0, &["--metamer-budget", "12"]);
    let answer = post(&server, "name=Oak&format=csv&internode_length=0.1", SCAN);
    assert_eq!((answer.status, &answer.json()["code"]), (400, &json!("too_many")), "{}", answer.text());
    // It is refused before it comes, so none of it is sent.
    let large = format!("content-length: {}\r\n", MAX_WOOD_BYTES + 1);
    let path = "/api/v1/trees/import?name=Oak&format=csv";
    let answer = http::send_with(server.port(), "POST", path, &large, b"").expect("the server answers");
    assert_eq!(answer.status, 413, "{}", answer.text());
    assert_eq!(answer.json()["allowed"], json!("64 MiB"));
    assert_eq!(saved(&server), 0);
}

#[test]
fn files_of_structure_go_out_and_come_in_at_the_command_line() {
    let scratch = Scratch::new();
    let path = |name: &str| scratch.path(name).to_str().expect("a plain name").to_owned();
    let run = |arguments: &[&str]| -> Value {
        let finished = program::run(arguments);
        assert_eq!(finished.code, 0, "{}", finished.stderr);
        serde_json::from_str(&finished.stdout).expect("figures")
    };
    let grow = ["grow", "--metamers", "300", "--seed", "5", "--stats", "json", "--export"];
    for ending in ["json", "mtg", "csv", "espalier"] {
        let (out, again) = (path(&format!("tree.{ending}")), path(&format!("again.{ending}")));
        let grown = run(&[&grow[..], &[&out]].concat());
        let taken = run(&["import", &out, "--export", &again, "--stats", "json"]);
        assert_eq!(taken["metamers_alive"], grown["metamers_alive"], "{ending}");
        let lines =
            |path: &str| fs::read(path).map(|file| file.iter().filter(|&&byte| byte == b'\n').count()).ok();
        if ending != "espalier" {
            assert_eq!(lines(&out), lines(&again), "{ending}");
        }
        let on = run(&["import", &out, "--grow", "2", "--stats", "json"]);
        assert!(on["metamers_alive"].as_u64() > grown["metamers_alive"].as_u64(), "{ending}");
    }
    run(&[&grow[..], &[&path("tree.ply")]].concat());
    assert!(fs::read(path("tree.ply")).expect("points").starts_with(b"ply\n"));
}

#[test]
fn a_file_that_cannot_become_a_tree_is_named_with_its_place() {
    let scratch = Scratch::new();
    let bad = scratch.path("scan.csv");
    fs::write(&bad, SCAN.replace("0.02,0.5", "-0.02,0.5")).expect("the scratch folder can be written");
    let out = scratch.path("out.glb");
    let [bad, written] = [&bad, &out].map(|path| path.to_str().expect("a plain name"));
    let finished = program::run(&["import", bad, "--export", written]);
    assert_eq!(finished.code, 2, "{}", finished.stderr);
    assert!(finished.stderr.contains("line 3, column 10: radius is -0.02"), "{}", finished.stderr);
    assert!(!out.exists());
}

#[tokio::test]
async fn a_session_is_taken_in_every_format() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    client.send(json!({ "kind": "grow", "steps": 3 })).await;
    client.until_settled().await;
    for (ending, kind, start) in [
        ("json", "application/json", "{\"format\":\"espalier-skeleton\",\"version\":2"),
        ("mtg", "text/plain", "CODE:\tFORM-A"),
        ("csv", "text/csv", "radius,length,start.x"),
        ("ply", "application/octet-stream", "ply\nformat binary_little_endian"),
    ] {
        let address = format!("/api/v1/sessions/{}/tree.{ending}", client.session);
        let answer = http::get(server.port(), &address).expect("the server answers");
        assert_eq!((answer.status, answer.header("content-type")), (200, Some(kind)), "{ending}");
        assert!(
            answer.header("content-disposition").is_some_and(|name| name.contains(&format!("tree.{ending}")))
        );
        assert!(answer.body.starts_with(start.as_bytes()), "{ending}");
    }
}
