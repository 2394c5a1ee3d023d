use std::time::Duration;

use espalier_tests::{
    client::{self, Client, Receipts},
    scratch::Scratch,
    server::Server,
    strokes::{line, stroke, upward},
};
use serde_json::json;

/// What may be on the way to one client (`FL1`).
const WINDOW: usize = 256 * 1024;

fn server() -> (Server, Scratch) {
    let scratch = Scratch::new();
    (Server::start(&scratch.path("trees.db")), scratch)
}

#[tokio::test]
async fn two_tablets_that_draw_see_the_same_tree() {
    let (server, _scratch) = server();
    let session = server.new_session(3);
    let mut first = Client::connect(server.port(), &session, "tablet-one").await;
    let mut second = Client::connect(server.port(), &session, "tablet-two").await;
    let trunk = upward(1, 14.0, 2.0);
    let bough = stroke(1, &line([0.0, 5.0, 0.0], [10.0, 9.0, 4.0], 20), 1.5, 4);
    for (one, two) in trunk.into_iter().zip(bough) {
        first.send(one).await;
        second.send(two).await;
        first.listen(Duration::from_millis(5)).await;
    }
    first.until_settled().await;
    second.until_settled().await;
    client::until_equal(&mut first, &mut second).await;
    assert!(first.state.metamers > 30, "the strokes grew {} metamers", first.state.metamers);
    assert_eq!(first.state.people, 2);
    assert!(first.frames > 3, "growth arrives while it happens, not as one frame");

    let mut late = Client::connect(server.port(), &session, "tablet-six").await;
    client::until_equal(&mut first, &mut late).await;
}

#[tokio::test]
async fn the_same_seed_and_commands_grow_the_same_tree() {
    let (server, _scratch) = server();
    let mut trees = Vec::new();
    for seed in [5, 5, 6] {
        let session = server.new_session(seed);
        let mut client = Client::connect(server.port(), &session, "tablet-one").await;
        for command in upward(1, 10.0, 3.0) {
            client.send(command).await;
        }
        client.send(json!({ "kind": "grow", "steps": 4 })).await;
        client.until_settled().await;
        trees.push(client);
    }
    let [first, again, other] = trees.as_mut_slice() else { panic!("there are three trees") };
    first.until_form(&again.form().await).await;
    assert_ne!(first.form().await, other.form().await);
}

#[tokio::test]
async fn rs1_a_returning_client_gets_only_what_is_stale() {
    let (server, _scratch) = server();
    let session = server.new_session(3);
    let mut away = Client::connect(server.port(), &session, "tablet-one").await;
    let mut here = Client::connect(server.port(), &session, "tablet-two").await;
    here.send(json!({ "kind": "grow", "steps": 14 })).await;
    here.until_settled().await;
    client::until_equal(&mut away, &mut here).await;
    // The last patches may still be on their way to both.
    away.listen(Duration::from_millis(300)).await;

    let received = away.frame_bytes;
    away.vanish();
    away.reconnect(server.port()).await;
    assert!(away.resumed, "RS1: the same epoch is resumed");
    away.listen(Duration::from_millis(500)).await;
    let unchanged = away.frame_bytes - received;
    assert!(unchanged < 200, "{unchanged} bytes for a tree that did not change");
    client::until_equal(&mut away, &mut here).await;

    away.vanish();
    here.send(json!({ "kind": "grow", "steps": 1 })).await;
    here.until_settled().await;
    away.reconnect(server.port()).await;
    assert!(away.resumed);
    client::until_equal(&mut away, &mut here).await;
}

#[tokio::test]
async fn rs2_another_epoch_is_not_resumed() {
    let (server, _scratch) = server();
    let session = server.new_session(3);
    let mut client = Client::connect(server.port(), &session, "tablet-one").await;
    client.send(json!({ "kind": "grow", "steps": 5 })).await;
    client.until_settled().await;
    let rows = client.form().await;
    let epoch = client.table.epoch;
    let server = server.kill_and_restart();
    client.reconnect(server.port()).await;
    assert!(!client.resumed);
    assert_ne!(client.table.epoch, epoch);
    client.until_form(&rows).await;
}

#[tokio::test]
async fn fl1_frames_stop_until_the_client_answers() {
    let (server, _scratch) = server();
    let session = server.new_session(3);
    let mut silent = Client::connect_with(server.port(), &session, "tablet-one", Receipts::Withheld).await;
    let mut drawing = Client::connect(server.port(), &session, "tablet-two").await;
    // Grow on until another client has been sent several windows' worth.
    while drawing.frame_bytes < 4 * WINDOW {
        drawing.send(json!({ "kind": "grow", "steps": 2 })).await;
        drawing.send(json!({ "kind": "ungrow", "steps": 1 })).await;
        drawing.until_settled().await;
    }
    silent.listen(Duration::from_secs(1)).await;
    assert!(silent.is_connected(), "a slow reader is not thrown out");
    assert!(silent.frame_bytes <= 2 * WINDOW, "{} bytes without an answer", silent.frame_bytes);
    assert!(silent.frame_bytes < drawing.frame_bytes / 2);

    let frames = silent.frames;
    silent.receipts = Receipts::Sent;
    let sequence = silent.table.sequence.expect("it has seen a frame");
    silent.send_message(&json!({ "type": "received", "sequence": sequence, "kind": 1 })).await;
    client::until_equal(&mut silent, &mut drawing).await;
    assert!(silent.frames - frames <= 3, "FL2: one catch-up frame, not {}", silent.frames - frames);
}
