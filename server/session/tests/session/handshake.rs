//! `HS` and `RS`.

use espalier_proto::{ServerMessage, version::CloseCode};
use espalier_session::Input;
use serde_json::json;

use crate::world::{World, grow};

#[test]
fn hs1_other_first_messages_close() {
    for text in [r#"{"type":"ping","nonce":1}"#, "growl", "", "[]", r#"{"type":"hello"}"#] {
        let mut world = World::new();
        let client = world.connect();
        world.text(client, text);
        assert_eq!(world.peer(client).closed, Some(CloseCode::HelloExpected), "{text}");
    }
}

#[test]
fn hs1_the_close_names_the_field_at_fault() {
    let long = "x".repeat(300);
    for (hello, reason) in [
        (
            json!({ "type": "hello", "protocol": 4, "client": "birch-01", "sap": 1 }),
            "malformed: sap is no known field; allowed: protocol, client, resume",
        ),
        (
            json!({ "type": "hello", "client": "birch-01" }),
            "malformed: protocol is missing; allowed: a whole number from 0 to 4294967295",
        ),
        (json!({ "type": "hello", "protocol": 4, "client": 5 }), "malformed: client "),
        (
            json!({ "type": "hello", "protocol": 4, "client": "birch-01", "resume": { "epoch": 1 } }),
            "malformed: resume.generations is missing; allowed: a list",
        ),
        (
            json!({ "type": "hello", "protocol": 4, "client": "short" }),
            "malformed: client is short; allowed: 8 to 64 letters, digits, - and _",
        ),
        (json!({ "type": "hello", "protocol": 4, "client": long }), "malformed: client is xxx"),
        (json!({ "type": "ping", "nonce": 1 }), "malformed: type is ping; allowed: hello"),
        (json!({ "type": "growl" }), "malformed: type is growl; allowed: hello"),
        (json!({ "nope": 1 }), "malformed: type is missing; allowed: hello"),
        (json!({ "type": 5 }), "malformed: type is 5; allowed: hello"),
        (json!("growl"), "malformed: message is no object; allowed: a hello"),
    ] {
        let mut world = World::new();
        let client = world.connect();
        world.text(client, &hello.to_string());
        let peer = world.peer(client);
        assert_eq!(peer.closed, Some(CloseCode::HelloExpected), "{hello}");
        assert!(peer.farewell.starts_with(reason), "{hello}: {}", peer.farewell);
    }
}

#[test]
fn hs1_a_binary_first_message_closes() {
    let mut world = World::new();
    let client = world.connect();
    world.handle(Input::Binary(espalier_session::ClientId(client)));
    assert_eq!(world.peer(client).closed, Some(CloseCode::HelloExpected));
}

#[test]
fn hs1_silence_closes_after_ten_seconds() {
    let mut world = World::new();
    let client = world.connect();
    world.pass(9_999);
    assert_eq!(world.peer(client).closed, None);
    world.pass(1);
    assert_eq!(world.peer(client).closed, Some(CloseCode::HelloExpected));
}

#[test]
fn hs1_a_hello_in_time_stays_open() {
    let mut world = World::new();
    let client = world.connect();
    world.pass(9_000);
    world.hello(client, "birch-01", None);
    world.pass(60_000);
    assert_eq!(world.peer(client).closed, None);
}

#[test]
fn hs1_client_keys_have_a_form() {
    let long = "x".repeat(64);
    let longer = "x".repeat(65);
    for (key, allowed) in [
        ("short-1", false),
        ("birch_-9", true),
        ("bir ch-01", false),
        (&long, true),
        (&longer, false),
        ("bïrch-01", false),
    ] {
        let mut world = World::new();
        let client = world.join(key);
        assert_eq!(world.peer(client).closed.is_none(), allowed, "{key}");
    }
}

#[test]
fn hs1_other_versions_close_with_4000() {
    for text in [
        r#"{"type":"hello","protocol":1,"client":"birch-01"}"#,
        r#"{"type":"hello","protocol":7,"user":{"shape":"unknown"}}"#,
    ] {
        let mut world = World::new();
        let client = world.connect();
        world.text(client, text);
        assert_eq!(world.peer(client).closed, Some(CloseCode::VersionMismatch), "{text}");
    }
}

#[test]
fn hs2_the_welcome_says_what_is_durable() {
    let mut world = World::new();
    let first = world.join("birch-01");
    world.command(first, 1, grow(1));
    world.command(first, 2, grow(1));
    world.settle();
    world.write_ms = 1_000_000;
    world.command(first, 3, grow(1));
    world.pass(100);
    world.leave(first);
    let again = world.join("birch-01");
    let Some(ServerMessage::Welcome { session, epoch, resumed, acknowledged, state, .. }) =
        world.peer(again).texts.first()
    else {
        panic!("the first answer is the welcome");
    };
    assert_eq!((session.as_str(), *epoch, *resumed, *acknowledged), ("plane-tree", 1, false, 2));
    assert_eq!(state.people, 1);
    assert!(state.step >= 2);
}

#[test]
fn hs2_each_knows_how_many_are_here() {
    let mut world = World::new();
    let first = world.join("birch-01");
    world.join("maple-01");
    let third = world.join("aspen-01");
    world.settle();
    assert_eq!(world.peer(first).last_state().unwrap().people, 3);
    world.leave(third);
    world.settle();
    assert_eq!(world.peer(first).last_state().unwrap().people, 2);
}

#[test]
fn hs4_a_newer_socket_replaces_the_older() {
    let mut world = World::new();
    let older = world.join("birch-01");
    let other = world.join("maple-01");
    let newer = world.join("birch-01");
    world.settle();
    assert_eq!(world.peer(older).closed, Some(CloseCode::Replaced));
    assert_eq!(world.peer(newer).closed, None);
    assert_eq!(world.peer(other).closed, None);
    assert_eq!(world.peer(other).last_state().unwrap().people, 2);
    // The shell notices the old socket's end late; the new one must not suffer.
    world.handle(Input::Disconnected(espalier_session::ClientId(older)));
    world.command(newer, 1, grow(1));
    world.settle();
    assert_eq!(world.peer(newer).acknowledged(), [1]);
}

#[test]
fn rs1_a_returning_client_gets_what_is_stale() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, grow(12));
    world.settle();
    let left = world.leave(birch);
    world.command(maple, 1, serde_json::json!({ "kind": "plant_seed", "position": [9.0, 0.0, 0.0] }));
    world.settle();
    let back = world.rejoin("birch-01", left.mirror);
    world.settle();
    assert!(world.peer(back).resumed());
    world.assert_mirrored(back);
    assert_eq!(world.peer(back).frames.len(), 1);
    assert!(world.peer(back).frames[0].catch_up);
    assert_eq!(world.peer(back).frames[0].changes.len(), 1, "a seed changes one chunk");
}

#[test]
fn rs1_nothing_stale_is_an_empty_catch_up() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    world.command(birch, 1, grow(12));
    world.settle();
    let left = world.leave(birch);
    let back = world.rejoin("birch-01", left.mirror);
    world.settle();
    assert_eq!(world.peer(back).frames.len(), 1);
    assert!(world.peer(back).frames[0].changes.is_empty());
    world.command(back, 2, grow(1));
    world.settle();
    world.assert_mirrored(back);
}

#[test]
fn rs1_rows_ungrown_meanwhile_are_forgotten() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, grow(12));
    world.settle();
    let left = world.leave(birch);
    world.command(maple, 1, serde_json::json!({ "kind": "ungrow", "steps": 8 }));
    world.settle();
    let back = world.rejoin("birch-01", left.mirror);
    world.settle();
    assert!(world.peer(back).resumed());
    world.assert_mirrored(back);
}

#[test]
fn rs2_another_epoch_starts_from_nothing() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    world.command(birch, 1, grow(6));
    world.settle();
    let mirror = world.peer(birch).mirror.clone();
    world.crash();
    let back = world.rejoin("birch-01", mirror);
    world.settle();
    assert!(!world.peer(back).resumed());
    world.assert_mirrored(back);
}

#[test]
fn rs1_an_inconsistent_resume_is_not_taken_up() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    world.command(birch, 1, grow(6));
    world.settle();
    let client = world.connect();
    let resume = espalier_proto::Resume { epoch: 1, generations: vec![1; 3], rows: 9 };
    world.hello(client, "maple-01", Some(resume));
    world.settle();
    assert!(!world.peer(client).resumed());
    world.assert_mirrored(client);
}
