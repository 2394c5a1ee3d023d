//! Peers that keep no rule: sockets that say nonsense, and connections that read nothing.

use std::{
    io::{ErrorKind, Read, Write},
    net::TcpStream,
};

use espalier_tests::{
    client::Client,
    http,
    scratch::Scratch,
    server::{GUARD, Server},
};
use serde_json::json;

/// A WebSocket, byte by byte.
struct Raw(TcpStream);

const TEXT: u8 = 1;
const CONTINUED: u8 = 0;
const CLOSE: u8 = 8;
const PING: u8 = 9;
const PONG: u8 = 10;
/// The bit of the last frame of a message.
const LAST: u8 = 0x80;
const HELLO: &str = r#"{"type":"hello","protocol":4,"client":"raw-client"}"#;

impl Raw {
    fn open(server: &Server, session: &str) -> Self {
        let mut stream = TcpStream::connect(("127.0.0.1", server.port())).expect("the port is open");
        stream.set_read_timeout(Some(GUARD)).expect("a socket has a time-out");
        let request = format!(
            "GET /api/v1/sessions/{session}/socket HTTP/1.1\r\nhost: 127.0.0.1:{}\r\nconnection: upgrade\r\n\
             upgrade: websocket\r\nsec-websocket-version: 13\r\nsec-websocket-key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
            server.port()
        );
        stream.write_all(request.as_bytes()).expect("the request is sent");
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).expect("the server answers");
            head.push(byte[0]);
        }
        assert!(head.starts_with(b"HTTP/1.1 101"), "{}", String::from_utf8_lossy(&head));
        Self(stream)
    }

    /// A socket that has said hello.
    fn greeted(server: &Server, session: &str) -> Self {
        let mut raw = Self::open(server, session);
        raw.send(LAST | TEXT, HELLO.as_bytes());
        raw
    }

    /// The head of a frame whose mask changes nothing.
    fn head(first: u8, length: usize) -> Vec<u8> {
        let mut head = vec![first];
        match length {
            0..=125 => head.push(0x80 | length as u8),
            126..=0xffff => {
                head.push(0x80 | 126);
                head.extend_from_slice(&(length as u16).to_be_bytes());
            }
            _ => {
                head.push(0x80 | 127);
                head.extend_from_slice(&(length as u64).to_be_bytes());
            }
        }
        head.extend_from_slice(&[0; 4]);
        head
    }

    fn send(&mut self, first: u8, payload: &[u8]) {
        let mut frame = Self::head(first, payload.len());
        frame.extend_from_slice(payload);
        self.0.write_all(&frame).expect("the frame is sent");
    }

    /// The next frame: its first byte and its payload; nothing where the connection has ended.
    fn next(&mut self) -> Option<(u8, Vec<u8>)> {
        let mut head = [0; 2];
        match self.0.read_exact(&mut head) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => return None,
            Err(error) => panic!("the connection was not closed in order: {error}"),
        }
        let length = match head[1] {
            126 => {
                let mut length = [0; 2];
                self.0.read_exact(&mut length).expect("a whole head");
                usize::from(u16::from_be_bytes(length))
            }
            127 => {
                let mut length = [0; 8];
                self.0.read_exact(&mut length).expect("a whole head");
                u64::from_be_bytes(length) as usize
            }
            length => usize::from(length),
        };
        let mut payload = vec![0; length];
        self.0.read_exact(&mut payload).expect("a whole frame");
        Some((head[0], payload))
    }

    /// The code that the socket is closed with; then the server closes the connection, too.
    fn close_code(mut self) -> Option<u16> {
        while let Some((first, payload)) = self.next() {
            if first == LAST | CLOSE {
                let code = payload.first_chunk().map(|code| u16::from_be_bytes(*code));
                assert_eq!(self.next(), None, "nothing follows a close");
                return code;
            }
        }
        panic!("the connection ended without a close");
    }
}

/// A server with a session.
fn house() -> (Server, String, Scratch) {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(3);
    (server, session, scratch)
}

#[test]
fn hs7_a_goodbye_is_answered() {
    let (server, session, _scratch) = house();
    for (said, answered) in [(1000u16, 1000), (1001, 1001), (4999, 4999), (999, 1002), (1005, 1002)] {
        let mut raw = Raw::greeted(&server, &session);
        raw.send(LAST | CLOSE, &said.to_be_bytes());
        assert_eq!(raw.close_code(), Some(answered), "{said}");
    }
    let mut raw = Raw::greeted(&server, &session);
    raw.send(LAST | CLOSE, &[]);
    assert_eq!(raw.close_code(), None, "a close without a code has an answer without one");
}

#[test]
fn hs7_what_is_no_websocket_closes_1002_and_what_is_no_text_1007() {
    let (server, session, _scratch) = house();
    type Said = fn(&mut Raw);
    let cases: [(&str, u16, Said); 12] = [
        ("reserved bits", 1002, |raw| raw.send(LAST | 0x40 | TEXT, b"{}")),
        ("an unknown kind of data", 1002, |raw| raw.send(LAST | 3, b"{}")),
        ("an unknown kind of control", 1002, |raw| raw.send(LAST | 11, b"")),
        ("a ping in pieces", 1002, |raw| raw.send(PING, b"x")),
        ("a large ping", 1002, |raw| raw.send(LAST | PING, &[0; 126])),
        ("a piece of nothing", 1002, |raw| raw.send(LAST | CONTINUED, b"x")),
        ("a message within a message", 1002, |raw| {
            raw.send(TEXT, b"{");
            raw.send(LAST | TEXT, b"}");
        }),
        ("half a code", 1002, |raw| raw.send(LAST | CLOSE, &[3])),
        ("no mask", 1002, |raw| raw.0.write_all(&[LAST | TEXT, 2, b'{', b'}']).expect("it is sent")),
        ("no UTF-8", 1007, |raw| raw.send(LAST | TEXT, b"\xff\xfe")),
        ("half a letter at the end of pieces", 1007, |raw| {
            raw.send(TEXT, b"\"");
            raw.send(LAST | CONTINUED, b"\xc3");
        }),
        ("a goodbye that is no UTF-8", 1007, |raw| raw.send(LAST | CLOSE, b"\x03\xe8\xff")),
    ];
    for (what, code, say) in cases {
        let mut raw = Raw::greeted(&server, &session);
        say(&mut raw);
        assert_eq!(raw.close_code(), Some(code), "{what}");
    }
}

#[tokio::test]
async fn lm1_what_is_too_large_closes_1009_before_it_is_taken_in() {
    let (server, session, _scratch) = house();
    // Its head alone is enough.
    let mut raw = Raw::greeted(&server, &session);
    raw.0.write_all(&Raw::head(LAST | TEXT, 256 * 1024 + 1)).expect("the head is sent");
    assert_eq!(raw.close_code(), Some(1009));
    // In pieces none of which is too large, and more of them than are read.
    let mut raw = Raw::greeted(&server, &session);
    raw.send(TEXT, &[b' '; 200 * 1024]);
    for _ in 0..20 {
        raw.send(CONTINUED, &[b' '; 100 * 1024]);
    }
    assert_eq!(raw.close_code(), Some(1009));
    // As large as may be, it is read.
    let mut raw = Raw::greeted(&server, &session);
    let mut ping = br#"{"type":"ping","nonce":7}"#.to_vec();
    ping.resize(256 * 1024, b' ');
    raw.send(TEXT, &ping[..1000]);
    raw.send(LAST | PING, b"between");
    raw.send(LAST | CONTINUED, &ping[1000..]);
    let (mut pong, mut answer) = (false, false);
    while !(pong && answer) {
        let (first, payload) = raw.next().expect("the socket is open");
        pong |= first == LAST | PONG && payload == b"between";
        answer |= first == LAST | TEXT && payload.starts_with(br#"{"type":"pong","nonce":7,"#);
    }
}

#[tokio::test]
async fn unfinished_messages_hold_little() {
    const SOCKETS: u64 = 100;
    let (server, session, _scratch) = house();
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    let before = server.resident_bytes();
    let unfinished: Vec<_> = (0..SOCKETS)
        .map(|_| {
            let mut raw = Raw::open(&server, &session);
            raw.send(TEXT, &[b' '; 120 * 1024]);
            raw.0.write_all(&Raw::head(CONTINUED, 900 * 1024)).expect("it is sent");
            // The server may have closed by now.
            let _ = raw.0.write_all(&[b' '; 800 * 1024]);
            raw
        })
        .collect();
    client.send(json!({ "kind": "grow", "steps": 1 })).await;
    client.until_settled().await;
    let grown = server.resident_bytes().saturating_sub(before);
    assert!(grown < SOCKETS * 512 * 1024, "{grown} bytes for {SOCKETS} unfinished messages");
    drop(unfinished);
}

#[test]
fn lm19_messages_that_are_not_whole_take_memory_until_there_is_none() {
    const SOCKETS: usize = 120;
    let scratch = Scratch::new();
    // 48 MiB may be taken, 85 in 100 of them by others than those who draw.
    let server = Server::start_with(&scratch.path("trees.db"), 0, &["--memory", "64M"]);
    let session = server.new_session(3);
    let taken = || {
        let figures = http::get(server.port(), "/metrics").expect("the server answers").text();
        let line =
            figures.lines().find(|line| line.starts_with(r#"espalier_memory_taken_bytes{for="sockets"}"#));
        line.and_then(|line| line.rsplit(' ').next()?.parse::<u64>().ok()).expect("it is told")
    };
    let begin = || {
        let mut raw = Raw::greeted(&server, &session);
        raw.0.write_all(&Raw::head(LAST | TEXT, 200 * 1024)).expect("it is sent");
        raw.0.write_all(&[b' '; 100 * 1024]).expect("it is sent");
        raw
    };
    let unfinished: Vec<Raw> = (0..SOCKETS).map(|_| begin()).collect();
    // No room for half of them: those are told so.
    let mut last = begin();
    let close = loop {
        let (first, payload) = last.next().expect("it is closed with a code");
        if first == LAST | CLOSE {
            break payload;
        }
    };
    assert_eq!(u16::from_be_bytes([close[0], close[1]]), 1013);
    let reason = String::from_utf8_lossy(&close[2..]);
    assert!(reason.starts_with("memory-full: "), "{reason}");
    assert!(taken() <= 48 << 20, "{} bytes for sockets", taken());
    drop((unfinished, last));
    while taken() > 0 {
        std::thread::yield_now();
    }
}

#[test]
fn a_flood_of_pings_is_held_back() {
    const FLOOD: usize = 64 << 20;
    let (server, session, _scratch) = house();
    let mut raw = Raw::greeted(&server, &session);
    raw.next().expect("a welcome");
    let before = server.resident_bytes();
    let mut ping = Raw::head(LAST | PING, 125);
    ping.extend_from_slice(&[b'x'; 125]);
    let pings = ping.repeat(1000);
    raw.0.set_write_timeout(Some(std::time::Duration::from_secs(1))).expect("a socket has a time-out");
    // Until the server takes no more, or has taken them all.
    let mut sent = 0;
    while sent < FLOOD && raw.0.write_all(&pings).is_ok() {
        sent += pings.len();
    }
    let grown = server.resident_bytes().saturating_sub(before);
    assert!(grown < 16 << 20, "{grown} bytes for pings");
    assert_eq!(http::get(server.port(), "/health").expect("the server answers").status, 200);
}

#[tokio::test]
async fn lm15_downloads_that_nobody_reads_end() {
    let (server, session, _scratch) = house();
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    client.send(json!({ "kind": "grow", "steps": 10 })).await;
    client.until_settled().await;
    let request = format!(
        "GET /api/v1/sessions/{session}/tree.glb HTTP/1.1\r\nhost: 127.0.0.1:{}\r\n\r\n",
        server.port()
    );
    // Many on one connection, and many connections: more than any buffer holds.
    let unread: Vec<_> = (0..3)
        .map(|_| {
            let mut stream = TcpStream::connect(("127.0.0.1", server.port())).expect("the port is open");
            stream.set_read_timeout(Some(GUARD)).expect("a socket has a time-out");
            stream.write_all(request.repeat(40).as_bytes()).expect("the requests are sent");
            stream
        })
        .collect();
    for stream in &unread {
        // The server resets it; until then the peer has bytes that it could read, and does not.
        let ended = std::iter::repeat_with(|| {
            std::thread::sleep(std::time::Duration::from_millis(50));
            stream.take_error().expect("a socket has a state")
        });
        let most = GUARD.as_millis() as usize / 50;
        let error = ended.take(2 * most).flatten().next().expect("the connection ends");
        assert_eq!(error.kind(), ErrorKind::ConnectionReset);
    }
    assert_eq!(http::get(server.port(), "/health").expect("the server answers").status, 200);
    assert!(server.terminate().success());
}
