use std::time::Duration;

use espalier_tests::{
    client::Client,
    http,
    scratch::Scratch,
    server::{Readers, Server},
};
use serde_json::{Value, json};

/// People come, draw and go, and the server stops when it is told to, whoever reads its log.
async fn works_before(readers: Readers) {
    let scratch = Scratch::new();
    // So much is logged that any pipe is full.
    let server = Server::start_before(readers, &scratch.path("trees.db"), 0, &["--log", "trace"]);
    let session = server.new_session(1);
    for key in ["browser-1", "browser-2", "browser-3"] {
        let mut client = Client::connect(server.port(), &session, key).await;
        for _ in 0..30 {
            client.send(json!({ "kind": "grow", "steps": 1 })).await;
            client.until_settled().await;
        }
    }
    assert_eq!(http::get(server.port(), "/health").expect("the server answers").status, 200);
    assert!(server.terminate().success());
}

#[tokio::test]
async fn a_log_that_nobody_reads_stops_nobody() {
    works_before(Readers::Asleep).await;
}

#[tokio::test]
async fn a_log_whose_reader_has_gone_stops_nobody() {
    works_before(Readers::Gone).await;
}

/// Lines that a server has printed about sockets that ended, as JSON.
fn ended(server: &Server) -> Vec<Value> {
    let lines = server.printed();
    let lines = lines.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    lines.filter(|line| line["message"] == "socket ended").collect()
}

#[tokio::test]
async fn sv3_lines_of_a_socket_name_its_request_and_its_session() {
    let scratch = Scratch::new();
    let options = ["--log-format", "json", "--access-log"];
    let server = Server::start_with(&scratch.path("trees.db"), 0, &options);
    let session = server.new_session(1);
    let client = Client::connect(server.port(), &session, "browser-1").await;
    drop(client);
    while ended(&server).is_empty() {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    let [line] = &ended(&server)[..] else { panic!("one socket") };
    assert!(line["seconds"].is_f64(), "{line}");
    let spans = line["spans"].as_array().expect("its spans");
    assert!(spans.iter().any(|span| span["name"] == "request" && span["number"].is_u64()), "{line}");
    assert!(spans.iter().any(|span| span["name"] == "socket" && span["session"] == session), "{line}");
}
