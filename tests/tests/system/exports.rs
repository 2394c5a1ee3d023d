//! Downloads: their options, how far they are, and how they are given up.

use std::{io::Write, net::TcpStream};

use espalier_tests::{client::Client, http, scratch::Scratch, server::Server, strokes::upward};

/// A server with one session in which something has grown.
async fn grown() -> (Server, String, Scratch) {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(7);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    for command in upward(1, 8.0, 2.0) {
        client.send(command).await;
    }
    client.until_settled().await;
    (server, session, scratch)
}

fn get(server: &Server, path: &str) -> http::Answer {
    http::get(server.port(), path).expect("the server answers")
}

#[tokio::test]
async fn ex1_each_format_that_is_listed_can_be_downloaded() {
    let (server, session, _scratch) = grown().await;
    let formats = get(&server, "/api/v1/formats").json();
    let formats = formats.as_array().expect("a list");
    assert!(formats.len() >= 7);
    for format in formats {
        let ending = format["ending"].as_str().expect("an ending");
        // A moving picture as large as it is by default takes long to draw.
        let query = if ending == "sway.png" { "?size=40x40&frames=2" } else { "" };
        let path = format!("/api/v1/sessions/{session}/tree.{ending}{query}");
        let answer = get(&server, &path);
        assert_eq!(answer.status, 200, "{ending}: {}", answer.text());
        match answer.header("content-length") {
            Some(length) => assert_eq!(length, answer.body.len().to_string(), "{ending}"),
            // It was sent while it was made (EX2).
            None => {
                assert!(answer.body.len() >= 4 << 20, "{ending} has {} bytes", answer.body.len());
                let part = "range: bytes=0-\r\n";
                let whole = http::send_with(server.port(), "GET", &path, part, &[]).expect("an answer");
                assert_eq!(whole.header("content-length"), Some(whole.body.len().to_string().as_str()));
                assert!(whole.body == answer.body, "{ending} is the same file in both ways");
            }
        }
        let name = format!("attachment; filename=\"tree.{ending}\"");
        assert_eq!(answer.header("content-disposition"), Some(name.as_str()));
        // Of a small tree, little more than the least is expected.
        let least = format["bytes"][0].as_f64().expect("bytes");
        assert!((answer.body.len() as f64) < 3.0 * least + 1e6, "{ending} has {} bytes", answer.body.len());
    }
}

#[tokio::test]
async fn ex2_options_change_the_file_and_wrong_ones_are_named() {
    let (server, session, _scratch) = grown().await;
    let file = |query: &str| get(&server, &format!("/api/v1/sessions/{session}/tree.{query}"));
    let [plain, small, far] = ["glb", "glb?quantised=true&compressed=true", "glb?lod=3"].map(file);
    assert!(small.status == 200 && small.body.len() < plain.body.len());
    let text = |answer: &http::Answer| String::from_utf8_lossy(&answer.body).into_owned();
    assert!(text(&far).contains("Billboard") && !text(&plain).contains("Billboard"));
    assert!(text(&file("glb?author=Ada&licence=CC0-1.0")).contains("Ada, CC0-1.0"));
    assert_eq!(file("png?size=64x48&turn=90&rise=30").body[16..24], [0, 0, 0, 64, 0, 0, 0, 48]);
    // From 1 km away there is little of a tree to be seen.
    let [near, far] = [8, 1000].map(|metres| {
        let file = file(&format!("png?size=64x48&fov=40&target=0,2,0&distance={metres}"));
        assert_eq!(file.body[16..24], [0, 0, 0, 64, 0, 0, 0, 48], "{}", file.text());
        file.body.len()
    });
    assert!(far < near, "{far} and {near} bytes");
    for (query, field) in [
        ("csv?hull=true", "hull"),
        ("ply?points=0", "points"),
        ("png?rise=90", "rise"),
        ("png?distance=-1", "distance"),
        ("png?target=1,2", "target"),
        ("glb?fov=40", "fov"),
        ("glb?ticket=short", "ticket"),
        ("glb?lod=9", "lod"),
        ("png?size=99999x99999", "size"),
        ("glb?sap=1", "sap"),
        ("glb?hull=maybe", "hull"),
    ] {
        let answer = file(query);
        assert_eq!(
            (answer.status, answer.json()["field"].as_str()),
            (400, Some(field)),
            "{query}: {}",
            answer.text()
        );
    }
}

#[tokio::test]
async fn ex3_an_export_tells_how_far_it_is_and_can_be_given_up() {
    let (server, session, _scratch) = grown().await;
    let progress = format!("/api/v1/sessions/{session}/exports/0123456789abcdef");
    assert_eq!(get(&server, &progress).status, 404);
    let mut slow = TcpStream::connect(("127.0.0.1", server.port())).expect("the server listens");
    let path = format!("/api/v1/sessions/{session}/tree.png?frames=180&size=300x300&ticket=0123456789abcdef");
    write!(slow, "GET {path} HTTP/1.1\r\nhost: 127.0.0.1:{}\r\n\r\n", server.port())
        .expect("it takes the request");
    let far = loop {
        let answer = get(&server, &progress);
        if answer.status == 200 {
            break answer.json();
        }
    };
    assert!(far["written"].as_u64() <= far["expected"].as_u64(), "{far}");
    drop(slow);
    while get(&server, &progress).status != 404 {}
    assert_eq!(get(&server, &format!("/api/v1/sessions/{session}/tree.json")).status, 200);
}
