//! `OP`: databases of earlier programs, of later ones, and damaged ones.

use std::{
    fs,
    path::{Path, PathBuf},
    time::Duration,
};

use espalier_growth::SIMULATION_VERSION;
use espalier_proto::Notice;
use espalier_tests::{
    client::{self, Client},
    http,
    scratch::Scratch,
    server::Server,
};
use serde_json::{Value, json};
use sqlx::{
    AssertSqlSafe, ConnectOptions, Connection,
    sqlite::{SqliteConnectOptions, SqliteConnection},
};
use tokio::time::sleep;
use tokio_tungstenite::tungstenite::{Message, protocol::CloseFrame};

/// More than any kept session has operations.
const MANY: usize = 60;
pub(crate) const KEY: &str = "third-person-03";
/// The rules by which the kept databases were grown.
const KEPT_SIMULATION: u32 = 3;

fn kept(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("kept/0.1.0").join(name)
}

/// A copy of a kept database: what is kept stays as it is.
pub(crate) fn copy_of(scratch: &Scratch, name: &str) -> PathBuf {
    let path = scratch.path("trees.db");
    fs::copy(kept(name), &path).expect("the database is kept");
    path
}

async fn database(path: &Path) -> SqliteConnection {
    SqliteConnectOptions::new().filename(path).connect().await.expect("it is a database")
}

pub(crate) async fn change(path: &Path, sql: &str) -> u64 {
    let mut connection = database(path).await;
    let done = sqlx::query(AssertSqlSafe(sql)).execute(&mut connection).await.expect("it can be changed");
    connection.close().await.expect("it closes");
    done.rows_affected()
}

async fn number(path: &Path, sql: &'static str) -> i64 {
    let mut connection = database(path).await;
    let number = sqlx::query_scalar(sql).fetch_one(&mut connection).await.expect("there is a number");
    connection.close().await.expect("it closes");
    number
}

pub(crate) async fn sessions(path: &Path) -> Vec<String> {
    let mut connection = database(path).await;
    let names = sqlx::query_scalar("SELECT name FROM sessions ORDER BY seed");
    let names = names.fetch_all(&mut connection).await.expect("there are sessions");
    connection.close().await.expect("it closes");
    names
}

async fn many(client: &mut Client, command: Value) {
    for _ in 0..MANY {
        client.send(command.clone()).await;
    }
    client.until_settled().await;
    client.refused.clear();
}

/// Why the server closes a socket right after the hello, or before.
pub(crate) async fn refused_by(port: u16, session: &str) -> CloseFrame {
    let mut socket = client::open(port, session).await;
    loop {
        match client::next(&mut socket).await.expect("the server says why") {
            Message::Close(frame) => return frame.expect("a close has a reason"),
            Message::Text(loading) if client::is_loading(&loading) => {}
            other => panic!("{other:?} before the close"),
        }
    }
}

#[tokio::test]
async fn op1_kept_sessions_open_are_undone_redone_and_grown_on() {
    for name in ["clean-stop.db", "killed.db"] {
        let scratch = Scratch::new();
        let path = copy_of(&scratch, name);
        let session = sessions(&path).await.remove(0);
        let server = Server::start(&path);
        let mut client = Client::connect(server.port(), &session, KEY).await;
        client.until_settled().await;
        if name == "killed.db" {
            // Its tail was grown by the rules of then, and is grown anew by those of today.
            assert_eq!(client.notices, [Notice::Regrown { from: KEPT_SIMULATION, to: SIMULATION_VERSION }]);
            assert!(client.state.metamers > 100, "{}", client.state.metamers);
        } else {
            assert_eq!(client.notices, [], "every entry is in a snapshot");
        }
        // From the end of its line, so that redoing comes back here.
        many(&mut client, json!({ "kind": "redo" })).await;
        let (rows, state) = (client.form().await, client.state.clone());
        many(&mut client, json!({ "kind": "undo" })).await;
        assert_eq!((client.state.metamers, client.state.can_undo), (0, false), "{name}: the seedling");
        many(&mut client, json!({ "kind": "redo" })).await;
        assert_eq!(client.state, state, "{name}");
        client.until_form(&rows).await;
        client.send(json!({ "kind": "grow", "steps": 2 })).await;
        client.until_settled().await;
        assert_eq!(client.state.step, state.step + 2, "{name}");
        assert!(client.state.metamers > state.metamers, "{name}");
    }
}

#[tokio::test]
async fn op1_a_kept_tree_opens_under_this_and_any_later_simulation() {
    let scratch = Scratch::new();
    let path = copy_of(&scratch, "clean-stop.db");
    assert!(Server::start(&path).terminate().success(), "its schema is today's from here on");
    for version in [SIMULATION_VERSION, KEPT_SIMULATION, 2] {
        change(&path, &format!("UPDATE documents SET simulation_version = {version}")).await;
        let server = Server::start(&path);
        let trees = http::get(server.port(), "/api/v1/trees").expect("the server answers").json();
        let (id, metamers) = (trees["trees"][0]["id"].clone(), trees["trees"][0]["metamers"].clone());
        let open = json!({ "tree": id, "version": 1 });
        let opened = http::send(server.port(), "POST", "/api/v1/sessions", Some(&open));
        let opened = opened.expect("the server answers");
        assert_eq!(opened.status, 201, "{}", opened.text());
        let session = opened.json()["session"].as_str().expect("a name").to_owned();
        let client = Client::connect(server.port(), &session, KEY).await;
        assert_eq!(json!(client.state.metamers), metamers);
        assert!(server.terminate().success());
    }
}

#[tokio::test]
async fn op1_a_snapshot_of_an_older_simulation_opens_without_a_word() {
    let scratch = Scratch::new();
    let path = copy_of(&scratch, "clean-stop.db");
    let session = sessions(&path).await.remove(0);
    change(&path, "UPDATE sessions SET simulation_version = 2").await;
    let server = Server::start(&path);
    let mut client = Client::connect(server.port(), &session, KEY).await;
    client.until_settled().await;
    assert_eq!(client.notices, [], "every entry is in a snapshot");
    assert!(client.state.metamers > 100 && client.state.can_undo);
}

#[tokio::test]
async fn op2_op3_entries_of_an_older_simulation_are_done_again_and_said_once() {
    let scratch = Scratch::new();
    let path = copy_of(&scratch, "killed.db");
    let session = sessions(&path).await.remove(0);
    change(&path, "UPDATE sessions SET simulation_version = 2").await;
    let server = Server::start(&path);
    let regrown =
        |client: &Client| matches!(client.notices[..], [Notice::Regrown { from: 2, to: SIMULATION_VERSION }]);
    let mut first = Client::connect(server.port(), &session, KEY).await;
    first.until("a notice", |client| !client.notices.is_empty()).await;
    first.until_settled().await;
    let mut second = Client::connect(server.port(), &session, "fourth-person-4").await;
    second.until("a notice for everybody", |client| !client.notices.is_empty()).await;
    second.until_settled().await;
    first.vanish();
    first.reconnect(server.port()).await;
    first.until_settled().await;
    assert!(regrown(&first) && regrown(&second), "{:?} {:?}", first.notices, second.notices);
    let rows = first.form().await;

    // The snapshot is made at once, so that a kill from here on leaves nothing to say again.
    let unkept = "SELECT count(*) FROM sessions WHERE notices IS NOT NULL OR last_snapshot IS NOT last_entry";
    while number(&path, unkept).await > 0 {
        sleep(Duration::from_millis(10)).await;
    }
    let server = server.kill_and_restart();
    let mut third = Client::connect(server.port(), &session, "fifth-person-05").await;
    third.until_form(&rows).await;
    third.until_settled().await;
    assert_eq!(third.notices, []);
}

/// A database of this program with a session of four grown steps, one entry each, none of them in a snapshot.
async fn killed(scratch: &Scratch) -> (PathBuf, String) {
    let path = scratch.path("trees.db");
    let server = Server::start(&path);
    let session = server.new_session(7);
    let mut client = Client::connect(server.port(), &session, KEY).await;
    for id in 1..=4 {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until("it is durable", |client| client.acknowledged >= id).await;
    }
    server.kill();
    (path, session)
}

#[tokio::test]
async fn op4_a_damaged_journal_is_named_and_kept_aside() {
    let scratch = Scratch::new();
    let (path, session) = killed(&scratch).await;
    let forged =
        change(&path, "UPDATE journal SET entries = replace(entries, ':1}', ':9}') WHERE first = 3").await;
    assert_eq!(forged, 1, "still a command, but another one");
    let server = Server::start(&path);
    let mut client = Client::connect(server.port(), &session, "fourth-person-4").await;
    client.until("a notice", |client| !client.notices.is_empty()).await;
    assert_eq!(client.notices, [Notice::Damaged { entry: 3 }]);
    assert_eq!(client.state.step, 2, "what is whole is there");
    client.send(json!({ "kind": "grow", "steps": 5 })).await;
    client.until_settled().await;
    assert_eq!(client.state.step, 7);
    assert!(server.printed().contains("the journal is damaged from an entry on"), "{}", server.printed());
    let server = server.kill_and_restart();
    let mut client = Client::connect(server.port(), &session, "fifth-person-05").await;
    client.until_settled().await;
    assert_eq!((client.state.step, client.notices.len()), (7, 0));
    assert!(server.terminate().success());
    assert_eq!(
        number(&path, "SELECT count(*) FROM set_aside WHERE first >= 3").await,
        2,
        "nothing was deleted"
    );
}

#[tokio::test]
async fn op4_a_session_with_no_whole_snapshot_is_not_made_up() {
    let scratch = Scratch::new();
    let (path, session) = killed(&scratch).await;
    change(&path, "UPDATE parts SET packed = substr(packed, 1, length(packed) / 2)").await;
    let server = Server::start(&path);
    let frame = refused_by(server.port(), &session).await;
    assert_eq!(u16::from(frame.code), 4007, "HS6");
    assert!(frame.reason.contains("damaged"), "{}", frame.reason);
    assert!(http::get(server.port(), "/health").is_ok_and(|answer| answer.status == 200));
}

#[tokio::test]
async fn a_damaged_tree_is_said_to_be_damaged() {
    let scratch = Scratch::new();
    let path = scratch.path("trees.db");
    let server = Server::start(&path);
    let save = json!({ "session": server.new_session(7), "name": "Oak" });
    let saved = http::send(server.port(), "POST", "/api/v1/trees", Some(&save)).expect("the server answers");
    let tree = json!({ "tree": saved.json()["id"], "version": 1 });
    assert!(server.terminate().success());
    change(&path, "UPDATE parts SET packed = substr(packed, 2)").await;
    let server = Server::start(&path);
    let opened =
        http::send(server.port(), "POST", "/api/v1/sessions", Some(&tree)).expect("the server answers");
    assert_eq!(opened.status, 409, "{}", opened.text());
    assert!(opened.text().contains("damaged"), "{}", opened.text());
}

#[tokio::test]
async fn op2_a_clean_stop_leaves_no_tail() {
    let scratch = Scratch::new();
    let path = scratch.path("trees.db");
    let server = Server::start(&path);
    let session = server.new_session(7);
    let mut client = Client::connect(server.port(), &session, KEY).await;
    client.send(json!({ "kind": "grow", "steps": 3 })).await;
    client.until_settled().await;
    // Accepted, but not yet done when the server is told to stop.
    let last = client.send(json!({ "kind": "grow", "steps": 8 })).await;
    client.until("it is durable", |client| client.acknowledged >= last).await;
    let status = tokio::task::spawn_blocking(move || server.terminate()).await.expect("the wait ends");
    assert!(status.success());
    let newest = number(&path, "SELECT max(through) FROM snapshots").await;
    assert_eq!(newest, number(&path, "SELECT max(last) FROM journal").await);
    let server = Server::start(&path);
    let client = Client::connect(server.port(), &session, KEY).await;
    assert_eq!(client.state.step, 11);
}
