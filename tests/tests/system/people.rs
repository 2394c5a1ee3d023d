//! Who is let in, by the program's own means: invitations, devices, tokens.

use std::{
    fs,
    io::{Read, Write},
    net::{Ipv6Addr, TcpListener, TcpStream},
    path::Path,
    thread,
    time::{Duration, Instant},
};

use espalier_proto::version::PROTOCOL_VERSION;
use espalier_tests::{
    client,
    http::{self, Answer},
    program,
    scratch::Scratch,
    server::{GUARD, Server},
};
use futures_util::SinkExt;
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

/// A server that trusts nobody at its machine, as if all came from elsewhere.
fn guarded(database: &Path) -> Server {
    Server::start_with(database, 0, &["--no-local"])
}

/// All that a server prints when it starts.
pub(super) fn printed_by(server: &Server) -> String {
    let started = Instant::now();
    loop {
        let printed = server.printed();
        if printed.contains("Ctrl+C") {
            return printed;
        }
        assert!(started.elapsed() < GUARD, "the server says no more than {printed}");
        thread::sleep(Duration::from_millis(20));
    }
}

/// The secret of the first invitation in what was printed.
pub(super) fn secret_in(printed: &str) -> &str {
    let (_, rest) = printed.split_once("/pair#").unwrap_or_else(|| panic!("no link in {printed}"));
    rest.split_whitespace().next().expect("a secret stands behind the hash")
}

pub(super) fn name(database: &Path) -> &str {
    database.to_str().expect("a plain name")
}

fn espalier(arguments: &[&str], database: &Path) -> String {
    let done = program::run(&[arguments, &["--database", name(database)]].concat());
    assert_eq!(done.code, 0, "{arguments:?}: {}", done.stderr);
    done.stdout
}

fn redeem(server: &Server, secret: &str) -> Answer {
    http::send(server.port(), "POST", "/api/v1/redeem", Some(&json!({ "secret": secret })))
        .expect("the server answers")
}

/// The cookie of whoever has redeemed an invitation, as a header.
pub(super) fn cookie(server: &Server, secret: &str) -> String {
    let answer = redeem(server, secret);
    assert_eq!(answer.status, 200, "{}", answer.text());
    let cookie = answer.header("set-cookie").expect("a device has a cookie");
    cookie.split(';').next().expect("it has a value").to_owned()
}

/// The secret in a cookie.
fn value_of(cookie: &str) -> &str {
    cookie.split_once('=').expect("a cookie has a value").1
}

pub(super) fn ask(server: &Server, method: &str, path: &str, header: &str, body: &str) -> Answer {
    let headers = format!("{header}\r\ncontent-type: application/json\r\n");
    http::send_with(server.port(), method, path, &headers, body.as_bytes()).expect("the server answers")
}

#[test]
fn localhost_is_the_server_at_both_of_its_addresses() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    if TcpListener::bind((Ipv6Addr::LOCALHOST, 0)).is_err() {
        assert!(
            TcpStream::connect((Ipv6Addr::LOCALHOST, server.port())).is_err(),
            "there is no such address"
        );
        return;
    }
    let mut stream =
        TcpStream::connect((Ipv6Addr::LOCALHOST, server.port())).expect("the server listens there");
    let request = format!(
        "GET /api/v1/trees HTTP/1.1\r\nhost: localhost:{}\r\nconnection: close\r\n\r\n",
        server.port()
    );
    stream.write_all(request.as_bytes()).expect("it is sent");
    stream.set_read_timeout(Some(GUARD)).expect("it can be set");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("the server answers");
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
}

#[tokio::test]
async fn ac3_a_tablet_comes_in_by_the_printed_link_once() {
    let scratch = Scratch::new();
    let server = guarded(&scratch.path("trees.db"));
    let printed = printed_by(&server);
    let list = || http::get(server.port(), "/api/v1/trees").expect("the server answers");
    assert_eq!(list().json()["reason"], "not-let-in");
    assert_eq!(list().header("www-authenticate"), Some("Bearer"));
    assert_eq!(http::get(server.port(), "/pair").expect("the server answers").status, 200);

    let cookie = cookie(&server, secret_in(&printed));
    let again = redeem(&server, secret_in(&printed));
    assert_eq!((again.status, again.json()["reason"].as_str()), (404, Some("no-invitation")));
    let header = format!("cookie: {cookie}");
    assert_eq!(ask(&server, "GET", "/api/v1/trees", &header, "").status, 200);
    let begun = ask(&server, "POST", "/api/v1/sessions", &header, r#"{"seed":7}"#);
    assert_eq!(begun.status, 201, "{}", begun.text());
    let session = begun.json()["session"].as_str().expect("it has a name").to_owned();
    // A page without the cookie is told why by the close of its socket.
    let mut stranger = client::open(server.port(), &session).await;
    let Some(Message::Close(Some(close))) = client::next(&mut stranger).await else { panic!("it is closed") };
    assert_eq!(u16::from(close.code), 4007);
    assert!(close.reason.starts_with("not-let-in: "), "{}", close.reason);
    // What the database holds lets nobody in.
    for file in ["trees.db", "trees.db-wal"] {
        let bytes = fs::read(scratch.path(file)).expect("it is there");
        for secret in [secret_in(&printed), value_of(&cookie)] {
            let found = bytes.windows(secret.len()).any(|window| window == secret.as_bytes());
            assert!(!found, "a secret is in {file}");
        }
    }
}

#[tokio::test]
async fn ac4_a_viewer_looks_until_let_out() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = guarded(&database);
    let owner = format!("cookie: {}", cookie(&server, secret_in(&printed_by(&server))));
    let begun = ask(&server, "POST", "/api/v1/sessions", &owner, r#"{"seed":7}"#);
    let session = begun.json()["session"].as_str().expect("it has a name").to_owned();

    let printed =
        espalier(&["invite", "--role", "viewer", "--name", "Bo's tablet", "--port", "7700"], &database);
    let viewer = cookie(&server, secret_in(&printed));
    let header = format!("cookie: {viewer}");
    assert_eq!(ask(&server, "GET", "/api/v1/trees", &header, "").status, 200);
    let save = json!({ "session": session, "name": "Oak" }).to_string();
    let refused = ask(&server, "POST", "/api/v1/trees", &header, &save);
    assert_eq!((refused.status, refused.json()["reason"].as_str()), (403, Some("forbidden")));

    let mut socket = client::open_with(server.port(), &session, &[("cookie", &viewer)]).await;
    for message in [
        json!({ "type": "hello", "protocol": PROTOCOL_VERSION, "client": "viewer-1" }),
        json!({ "type": "command", "id": 1, "command": { "kind": "grow", "steps": 1 } }),
    ] {
        socket.send(client::text(&message)).await.expect("it is sent");
    }
    loop {
        let Some(Message::Text(text)) = client::next(&mut socket).await else { continue };
        let message: Value = serde_json::from_str(&text).expect("control messages are JSON");
        if message["type"] == "refused" {
            assert_eq!(message["problem"]["reason"], "forbidden");
            break;
        }
        assert_ne!(message["type"], "acknowledged");
    }

    let listed = espalier(&["device", "ls"], &database);
    assert!(listed.contains("Bo's tablet: viewer") && listed.contains("device: owner"), "{listed}");
    espalier(&["device", "revoke", "Bo's tablet"], &database);
    assert_eq!(client::close_code(&mut socket).await, Some(4007));
    assert_eq!(ask(&server, "GET", "/api/v1/trees", &header, "").status, 401);
    assert_eq!(ask(&server, "GET", "/api/v1/trees", &owner, "").status, 200, "the other device stays");
    let again = program::run(&["device", "revoke", "Bo's tablet", "--database", name(&database)]);
    assert!(again.code == 1 && again.stderr.contains("no device Bo's tablet"), "{}", again.stderr);
}

#[test]
fn ac5_a_guest_is_invited_to_a_tree() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = guarded(&database);
    let owner = format!("cookie: {}", cookie(&server, secret_in(&printed_by(&server))));
    let begun = ask(&server, "POST", "/api/v1/sessions", &owner, r#"{"seed":7}"#);
    let save = |tree: &str| json!({ "session": begun.json()["session"], "name": tree }).to_string();
    let saved = |name: &str| {
        let saved = ask(&server, "POST", "/api/v1/trees", &owner, &save(name));
        saved.json()["id"].as_str().expect("it has an identifier").to_owned()
    };
    let (oak, elm) = (saved("Oak"), saved("Elm"));
    let printed = espalier(
        &["invite", "--role", "editor", "--tree", &oak, "--for", "7d", "--url", "https://trees.example"],
        &database,
    );
    assert!(printed.contains("https://trees.example/pair#") && printed.contains("7days"), "{printed}");
    let answer = redeem(&server, secret_in(&printed));
    assert_eq!(answer.json(), json!({ "role": "editor", "tree": oak }));
    let cookie = answer.header("set-cookie").and_then(|cookie| cookie.split(';').next()).expect("a cookie");
    let guest = format!("cookie: {cookie}");
    for (path, expected) in [
        (format!("/api/v1/trees/{oak}"), 200),
        (format!("/api/v1/trees/{elm}"), 403),
        ("/api/v1/tags".into(), 403),
    ] {
        assert_eq!(ask(&server, "GET", &path, &guest, "").status, expected, "{path}");
    }
    let missing = program::run(&["invite", "--tree", "none", "--database", name(&database)]);
    assert!(missing.code == 1 && missing.stderr.contains("no tree none"), "{}", missing.stderr);
}

#[test]
fn ac6_a_token_is_good_until_it_is_revoked() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    // Before any server has run: the database is made for it.
    let made = espalier(&["token", "create", "nightly", "--scope", "write"], &database);
    let bearer = format!("authorization: Bearer {}", made.trim());
    assert!(made.starts_with("esp_"), "{made}");
    let server = Server::start(&database);
    let read = espalier(&["token", "create", "reader"], &database);
    let reader = format!("authorization: Bearer {}", read.trim());
    let begin = |header: &str| ask(&server, "POST", "/api/v1/sessions", header, r#"{"seed":7}"#);
    let session = begin(&bearer).json()["session"].clone();
    let save = json!({ "session": session, "name": "Oak" }).to_string();
    assert_eq!(ask(&server, "POST", "/api/v1/trees", &bearer, &save).status, 201);
    assert_eq!(
        ask(&server, "POST", "/api/v1/trees", &reader, &save).status,
        403,
        "also at the machine itself"
    );
    let both = format!("{bearer}\r\ncookie: espalier-{}=x", server.port());
    assert_eq!(ask(&server, "GET", "/api/v1/trees", &both, "").status, 400);
    let listed = espalier(&["token", "ls"], &database);
    assert!(listed.contains("nightly: editor") && listed.contains("reader: viewer"), "{listed}");
    assert!(!listed.contains(made.trim()), "a token is shown once");
    espalier(&["token", "revoke", "nightly"], &database);
    assert_eq!(ask(&server, "GET", "/api/v1/trees", &bearer, "").status, 401);
}
