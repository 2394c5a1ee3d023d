use std::{
    io::{Read, Write},
    net::TcpStream,
    time::Duration,
};

use espalier_proto::ClientMessage;
use espalier_tests::{
    client::{self, Client},
    http,
    scratch::Scratch,
    server::{GUARD, Server},
};
use futures_util::{SinkExt, StreamExt};
use serde_json::json;
use tokio::time;
use tokio_tungstenite::tungstenite::Message;

/// Frames on the way (256 KiB), a thousand control messages, the socket's own buffers: all of it, with room to spare.
const BYTES_PER_CLIENT: u64 = 1024 * 1024;

async fn greeted(port: u16, session: &str, key: &str) -> client::Socket {
    let mut socket = client::open(port, session).await;
    let hello = ClientMessage::Hello {
        protocol: espalier_proto::version::PROTOCOL_VERSION,
        client: key.into(),
        resume: None,
    };
    socket.send(client::text(&hello)).await.expect("the hello is sent");
    socket
}

/// Grows and ungrows until so many bytes of frames have come.
async fn work(drawing: &mut Client, bytes: usize) {
    let enough = drawing.frame_bytes + bytes;
    while drawing.frame_bytes < enough {
        drawing.send(json!({ "kind": "ungrow", "steps": 2 })).await;
        drawing.send(json!({ "kind": "grow", "steps": 2 })).await;
        drawing.until_settled().await;
    }
}

#[tokio::test]
async fn slow_readers_cost_bounded_memory() {
    const SLOW: u64 = 40;
    const OWED: usize = 4 * 1024 * 1024;
    /// A round that adds no more than this adds nothing that the next would add again.
    const SETTLED: u64 = 4 * 1024 * 1024;
    const DEEPEST: u32 = 20;
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(3);
    let mut drawing = Client::connect(server.port(), &session, "the-drawing-one").await;
    // What the document itself keeps comes first, until it keeps no more.
    let mut before = server.resident_bytes();
    drawing.send(json!({ "kind": "grow", "steps": DEEPEST })).await;
    loop {
        work(&mut drawing, OWED).await;
        let now = server.resident_bytes();
        if now < before + SETTLED {
            break;
        }
        before = now;
    }
    let before = server.resident_bytes();
    let mut slow = Vec::new();
    for i in 0..SLOW {
        slow.push(greeted(server.port(), &session, &format!("slow-reader-{i}")).await);
    }
    work(&mut drawing, OWED).await;
    let grown = server.resident_bytes().saturating_sub(before);
    assert!(
        grown < SLOW * BYTES_PER_CLIENT,
        "{grown} bytes for {SLOW} readers who were owed {} bytes",
        SLOW * OWED as u64,
    );
    // Those who wake up get the same tree.
    let mut late = Client::connect(server.port(), &session, "just-arrived").await;
    client::until_equal(&mut drawing, &mut late).await;
}

#[tokio::test]
async fn fl3_unread_answers_are_bounded() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(3);
    let mut deaf = greeted(server.port(), &session, "never-reads").await;
    let before = server.resident_bytes();
    // Either the server stops reading, or it closes; it must not keep all the pongs.
    let flood = async {
        for nonce in 0..400_000 {
            if deaf.send(client::text(&ClientMessage::Ping { nonce })).await.is_err() {
                break;
            }
        }
    };
    // Being stuck because the server no longer reads is one of the two good ends.
    let _ = time::timeout(Duration::from_secs(20), flood).await;
    let grown = server.resident_bytes().saturating_sub(before);
    assert!(grown < 32 * 1024 * 1024, "{grown} bytes for one client that never reads");

    let mut other = Client::connect(server.port(), &session, "another-one").await;
    other.send(json!({ "kind": "grow", "steps": 3 })).await;
    other.until_settled().await;
}

#[tokio::test]
async fn lm1_a_larger_message_closes_1009() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(3);
    let mut socket = greeted(server.port(), &session, "browser-1").await;
    let samples = vec!["{\"position\":[0,1,0],\"radius\":1}"; 60_000].join(",");
    let huge = format!(
        r#"{{"type":"command","id":1,"command":{{"kind":"stroke_move","stroke":1,"samples":[{samples}]}}}}"#
    );
    // The server may close while it is still being sent.
    let (mut sink, mut stream) = (&mut socket).split();
    let (_, code) = tokio::join!(sink.send(Message::text(huge)), async {
        while let Some(Ok(message)) = stream.next().await {
            if let Message::Close(frame) = message {
                return frame.map(|frame| u16::from(frame.code));
            }
        }
        None
    });
    assert_eq!(code, Some(1009));
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    assert_eq!(client.acknowledged, 0);
    assert_eq!(client.state.step, 0);
    client.send(json!({ "kind": "grow", "steps": 1 })).await;
    client.until_settled().await;
}

#[tokio::test]
async fn half_a_request_does_not_hold_a_connection() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let mut lorises = Vec::new();
    for _ in 0..50 {
        let mut stream = TcpStream::connect(("127.0.0.1", server.port())).expect("the port is open");
        stream.write_all(b"GET / HTTP/1.1\r\nhost: sl").expect("half a request is sent");
        stream.set_read_timeout(Some(GUARD)).expect("a socket has a time-out");
        lorises.push(stream);
    }
    assert_eq!(http::get(server.port(), "/health").expect("the server answers others").status, 200);
    for mut stream in lorises {
        let mut rest = Vec::new();
        match stream.read_to_end(&mut rest) {
            Ok(_) => {}
            Err(error) => assert!(
                error.kind() == std::io::ErrorKind::ConnectionReset,
                "the connection is still open: {error}"
            ),
        }
    }
}
