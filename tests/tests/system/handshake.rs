use espalier_proto::ClientMessage;
use espalier_settings::ParameterValues;
use espalier_tests::{
    client::{self, Client},
    scratch::Scratch,
    server::Server,
};
use futures_util::SinkExt;
use serde_json::json;

use tokio_tungstenite::tungstenite::Message;

fn server() -> (Server, Scratch) {
    let scratch = Scratch::new();
    (Server::start(&scratch.path("trees.db")), scratch)
}

async fn code_after(server: &Server, session: &str, first: Message) -> Option<u16> {
    let mut socket = client::open(server.port(), session).await;
    // The server may close before the message is out; its code is what counts.
    let _ = socket.send(first).await;
    client::close_code(&mut socket).await
}

#[tokio::test]
async fn hs1_anything_but_a_hello_first_closes_4001() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    let hello = |key: &str| Message::text(json!({"type": "hello", "protocol": 4, "client": key}).to_string());
    let firsts = [
        Message::text(r#"{"type":"ping","nonce":1}"#),
        Message::text("hello"),
        Message::text(""),
        Message::binary(vec![1, 2, 3]),
        Message::text(r#"{"type":"command","id":1,"command":{"kind":"grow","steps":1}}"#),
        Message::text(r#"{"type":"hello","protocol":4}"#),
        hello("short"),
        hello(&"x".repeat(65)),
        hello("with spaces in it"),
        hello("mit-Umläuten"),
    ];
    for first in firsts {
        assert_eq!(code_after(&server, &session, first.clone()).await, Some(4001), "{first:?}");
    }
}

#[tokio::test]
async fn hs1_a_bad_hello_is_told_its_field() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    // As long as a reason can be, and longer.
    let [long, wide] = ["x".repeat(200), "ö".repeat(200)];
    for (key, more, reason) in [
        (
            "browser-1",
            json!({ "sap": 1 }),
            "malformed: sap is no known field; allowed: protocol, client, resume",
        ),
        ("short", json!({}), "malformed: client is short; allowed: 8 to 64 letters, digits, - and _"),
        (&long, json!({}), &format!("malformed: client is {}", "x".repeat(102))),
        (&wide, json!({}), &format!("malformed: client is {}", "ö".repeat(51))),
    ] {
        let mut hello = json!({ "type": "hello", "protocol": 4, "client": key });
        hello.as_object_mut().expect("an object").extend(more.as_object().expect("an object").clone());
        let mut socket = client::open(server.port(), &session).await;
        socket.send(Message::text(hello.to_string())).await.expect("it is short");
        assert_eq!(client::close(&mut socket).await, Some((4001, reason.to_owned())));
    }
}

#[tokio::test]
async fn hs1_silence_closes_4001() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    let mut socket = client::open(server.port(), &session).await;
    assert_eq!(client::close_code(&mut socket).await, Some(4001));
}

#[tokio::test]
async fn hs1_another_protocol_closes_4000() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    for protocol in [0, 1, u32::MAX] {
        let hello = json!({"type": "hello", "protocol": protocol, "client": "browser-1"}).to_string();
        assert_eq!(code_after(&server, &session, Message::text(hello)).await, Some(4000), "{protocol}");
    }
}

#[tokio::test]
async fn hs2_the_welcome_tells_all_of_a_new_session() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    assert_eq!(client.session, session);
    assert_eq!(client.acknowledged, 0);
    assert!(!client.resumed);
    assert_eq!(client.state.people, 1);
    assert_eq!(client.state.pending_steps, 0);
    assert!(client.state.metamer_budget > 0);
    assert!(!client.state.can_undo && !client.state.can_redo);
    assert_eq!(client.parameters, ParameterValues::default());
    client.until("the first seed arrives", |client| !client.table.rows.is_empty()).await;
    assert_eq!(client.table.rows[0].parent, 0, "FR5: the first row is a seed");
    assert_eq!(client.table.rows[0].position, [0; 3]);
}

#[tokio::test]
async fn hs2_the_welcome_says_what_is_durable() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    for _ in 0..3 {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
    }
    client.until("all three are durable", |client| client.acknowledged == 3).await;
    client.vanish();
    assert_eq!(Client::connect(server.port(), &session, "browser-1").await.acknowledged, 3);
    assert_eq!(Client::connect(server.port(), &session, "browser-2").await.acknowledged, 0);
}

#[tokio::test]
async fn hs3_an_unknown_session_closes_4003() {
    let (server, _scratch) = server();
    for session in ["nowhere", "%2e%2e", &"x".repeat(500)] {
        let hello = ClientMessage::Hello {
            protocol: espalier_proto::version::PROTOCOL_VERSION,
            client: "browser-1".into(),
            resume: None,
        };
        assert_eq!(code_after(&server, session, client::text(&hello)).await, Some(4003), "{session}");
    }
}

#[tokio::test]
async fn hs4_a_newer_socket_closes_the_older_with_4004() {
    let (server, _scratch) = server();
    let session = server.new_session(1);
    let mut older = Client::connect(server.port(), &session, "browser-1").await;
    let mut newer = Client::connect(server.port(), &session, "browser-1").await;
    while older.take_in().await {}
    assert_eq!(older.closed.map(|frame| u16::from(frame.code)), Some(4004));
    newer.send(json!({ "kind": "grow", "steps": 1 })).await;
    newer.until_settled().await;
    assert_eq!(newer.state.people, 1);
}
