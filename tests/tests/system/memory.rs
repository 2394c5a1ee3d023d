//! A server with little memory, and one that does not outlive a session.

use espalier_proto::Pause;
use espalier_tests::{
    client::{self, Client},
    http,
    scratch::Scratch,
    server::Server,
};
use futures_util::SinkExt;
use serde_json::json;
use tokio_tungstenite::tungstenite::Message;

const SEED: u32 = 3;

#[tokio::test]
async fn lm19_what_finds_no_memory_is_told_to_come_back_and_drawing_goes_on() {
    let scratch = Scratch::new();
    let server = Server::start_with(&scratch.path("trees.db"), 0, &["--memory", "64M"]);
    let session = server.new_session(SEED);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    // An export takes 64 MiB at least.
    let path = format!("/api/v1/sessions/{session}/tree.glb");
    let answer = http::get(server.port(), &path).expect("the server answers");
    assert_eq!((answer.status, answer.header("retry-after")), (503, Some("5")), "{}", answer.text());
    assert_eq!(answer.json()["reason"], "memory-full");
    assert!(server.printed().contains("by --memory"), "it says whose limit counts:\n{}", server.printed());
    client.send(json!({ "kind": "grow", "steps": 5 })).await;
    client.until_settled().await;
    assert_eq!((client.state.step, client.state.paused), (5, None));
}

#[tokio::test]
async fn op5_a_session_that_was_opened_twice_to_no_end_waits_for_an_owner() {
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(SEED);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    // More than any machine grows before it is killed.
    client.send(json!({ "kind": "grow", "steps": 1000 })).await;
    client.until("it is durable", |client| client.acknowledged == 1).await;
    server = server.kill_and_restart();
    for _ in 0..2 {
        let mut socket = client::open(server.port(), &session).await;
        let hello = json!({ "type": "hello", "protocol": 4, "client": "browser-2" });
        socket.send(Message::text(hello.to_string())).await.expect("the server reads");
        while !server.printed().contains("loading") {
            tokio::task::yield_now().await;
        }
        server = server.kill_and_restart();
    }
    client.reconnect(server.port()).await;
    assert_eq!((client.acknowledged, client.state.paused), (1, Some(Pause::Crashes)), "nothing is lost");
    assert_eq!((client.state.step, client.state.pending_steps), (0, 1000));
    client.send(json!({ "kind": "stop" })).await;
    client.until("the stop is durable", |client| client.acknowledged == 2).await;
    let path = format!("/api/v1/sessions/{session}/resume");
    let resume = || http::send(server.port(), "POST", &path, None).expect("the server answers");
    assert_eq!(resume().status, 204);
    client.until("it goes on", |client| client.state.paused.is_none() && client.done == 2).await;
    assert!(client.state.step <= 4, "{:?}", client.state);
    let again = resume();
    assert_eq!((again.status, again.json()["reason"].as_str()), (409, Some("nothing-waits")));
}

#[tokio::test]
async fn lm19_a_socket_for_which_there_is_no_memory_closes_with_1013() {
    let scratch = Scratch::new();
    let server = Server::start_with(&scratch.path("trees.db"), 0, &["--memory", "64M"]);
    let session = server.new_session(SEED);
    // 48 MiB may be taken, 85 in 100 of them by sockets of 64 KiB.
    let mut sockets = Vec::new();
    for _ in 0..660 {
        sockets.push(client::open(server.port(), &session).await);
    }
    let mut last = sockets.pop().expect("some were opened");
    let Some(Message::Close(Some(frame))) = client::next(&mut last).await else {
        panic!("it is not closed");
    };
    assert_eq!(u16::from(frame.code), 1013);
    assert!(frame.reason.starts_with("memory-full: "), "{}", frame.reason);
    drop(sockets);
    // What they took is given back.
    let mut client = loop {
        let mut socket = client::open(server.port(), &session).await;
        let hello = json!({ "type": "hello", "protocol": 4, "client": "browser-1" });
        socket.send(Message::text(hello.to_string())).await.expect("the server reads");
        if let Some(Message::Text(_)) = client::next(&mut socket).await {
            break socket;
        }
    };
    client.close(None).await.expect("it is open");
}
