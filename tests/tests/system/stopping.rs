//! What a server that is told to stop still does.

use std::{io::Write, net::TcpStream};

use espalier_tests::{http, scratch::Scratch, server::Server};
use serde_json::json;

const PATH: &str = "/api/v1/collections";
const BODY: &[u8] = br#"{"name":"Woods"}"#;

/// Makes a collection, with a key.
fn post(server: &Server) -> http::Answer {
    let headers = "content-type: application/json\r\nidempotency-key: one\r\n";
    http::send_with(server.port(), "POST", PATH, headers, BODY).expect("the server answers")
}

/// Begins the same, and does not end it.
fn begun(server: &Server) -> TcpStream {
    let port = server.port();
    let mut slow = TcpStream::connect(("127.0.0.1", port)).expect("the server listens");
    let head = format!(
        "POST {PATH} HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\ncontent-type: application/json\r\n\
         idempotency-key: one\r\ncontent-length: {}\r\n\r\n",
        BODY.len()
    );
    slow.write_all(&[head.as_bytes(), &BODY[..5]].concat()).expect("the server reads");
    slow
}

/// Whether the server is at it. What is too large is refused unread, and then the key is as free as before.
fn is_under_way(server: &Server) -> bool {
    let headers = "content-type: application/json\r\nidempotency-key: one\r\ncontent-length: 1000000000\r\n";
    let answer = http::send_with(server.port(), "POST", PATH, headers, b"").expect("the server answers");
    answer.json()["reason"] == "key-under-way"
}

#[test]
fn ik3_a_request_that_has_not_come_when_the_server_stops_is_done_by_the_next() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let _slow = loop {
        let slow = begun(&server);
        if is_under_way(&server) {
            break slow;
        }
    };
    assert!(server.terminate().success());
    let server = Server::start(&scratch.path("trees.db"));
    let answer = post(&server);
    assert_eq!((answer.status, &answer.json()["name"]), (201, &json!("Woods")), "{}", answer.text());
    assert_eq!(post(&server).json(), answer.json(), "it is done once");
}
