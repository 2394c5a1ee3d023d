use espalier_tests::{
    client::Client,
    http,
    scratch::Scratch,
    server::{Readers, Server},
};
use serde_json::json;

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
