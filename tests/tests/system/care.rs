//! The care of the database: copies of it, what is damaged in it, and what happens when it goes away.

use std::{fs, path::Path};

use espalier_tests::{
    client::{self, Client},
    http,
    program::{self, Finished},
    scratch::Scratch,
    server::Server,
};
use futures_util::StreamExt;
use serde_json::json;
use sqlx::{ConnectOptions, Executor, sqlite::SqliteConnectOptions};

/// `espalier COMMAND … --database DATABASE`.
fn care(command: &[&str], database: &Path) -> Finished {
    let database = database.to_str().expect("a plain name");
    program::run(&[command, &["--database", database]].concat())
}

fn name(path: &Path) -> &str {
    path.to_str().expect("a plain name")
}

async fn grown(server: &Server, steps: u32) -> Client {
    let session = server.new_session(3);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    grow(&mut client, steps).await;
    client
}

async fn grow(client: &mut Client, steps: u32) {
    client.send(json!({ "kind": "grow", "steps": steps })).await;
    client.until_settled().await;
}

fn save(server: &Server, session: &str) {
    let body = json!({ "session": session, "name": "Pear" });
    let saved = http::send(server.port(), "POST", "/api/v1/trees", Some(&body)).expect("the server answers");
    assert_eq!(saved.status, 201, "{}", saved.text());
}

#[tokio::test]
async fn a_backup_made_while_people_draw_is_restored_as_it_was() {
    let scratch = Scratch::new();
    let (database, copy) = (scratch.path("trees.db"), scratch.path("copy.db"));
    let server = Server::start(&database);
    let mut client = grown(&server, 8).await;
    let before = client.form().await;
    save(&server, &client.session.clone());

    let made = care(&["backup", name(&copy)], &database);
    assert_eq!(made.code, 0, "{}", made.stderr);
    assert!(made.stdout.contains("copy.db"), "{}", made.stdout);
    let again = care(&["backup", name(&copy)], &database);
    assert!(again.code == 1 && again.stderr.contains("--replace"), "{}", again.stderr);
    assert_eq!(care(&["backup", name(&copy), "--replace"], &database).code, 0);
    let link = scratch.path("link.db");
    std::os::unix::fs::symlink(&database, &link).expect("a link");
    let log = scratch.path("trees.db-wal");
    for itself in [&database, &link, &log] {
        let refused = care(&["backup", name(itself), "--replace"], &database);
        assert!(refused.code == 1 && refused.stderr.contains("is the database itself"), "{}", refused.stderr);
    }

    grow(&mut client, 3).await;
    assert_ne!(client.form().await, before);
    let in_use = care(&["restore", name(&copy)], &database);
    assert!(in_use.code == 1 && in_use.stderr.contains("another Espalier server"), "{}", in_use.stderr);
    let later = client.form().await;
    server.kill();

    let restored = care(&["restore", name(&copy)], &database);
    assert_eq!(restored.code, 0, "{}", restored.stderr);
    let kept = restored.stdout.lines().last().expect("a sentence says where the old one is");
    let kept = kept.rsplit(" is in ").next().expect("a name").trim_end_matches('.').to_owned();
    let server = Server::start(&database);
    client = Client::connect(server.port(), &client.session, "browser-2").await;
    client.until_form(&before).await;
    let trees = http::get(server.port(), "/api/v1/trees").expect("the server answers").json();
    assert_eq!(trees["trees"][0]["name"], json!("Pear"));
    server.kill();

    // What was drawn after the backup is not lost, not even what stood in the write-ahead log alone.
    let server = Server::start(Path::new(&kept));
    client = Client::connect(server.port(), &client.session, "browser-3").await;
    client.until_form(&later).await;
}

#[tokio::test]
async fn a_restore_takes_nothing_but_a_whole_backup_of_ours() {
    let scratch = Scratch::new();
    let (database, copy, foreign) =
        (scratch.path("trees.db"), scratch.path("copy.db"), scratch.path("photos.db"));
    let server = Server::start(&database);
    grown(&server, 4).await;
    server.kill();
    assert_eq!(care(&["backup", name(&copy)], &database).code, 0);
    let bytes = fs::read(&copy).expect("the copy is there");
    let kept = fs::read(&database).expect("the database is there");

    let mut damaged = bytes.clone();
    damaged[4096..].fill(0xa5);
    fs::write(&copy, &damaged).expect("the scratch folder can be written");
    let mut connection =
        SqliteConnectOptions::new().filename(&foreign).create_if_missing(true).connect().await.expect("made");
    connection.execute("CREATE TABLE photos (id INTEGER PRIMARY KEY)").await.expect("it takes a table");
    drop(connection);
    for (bad, words) in [
        (name(&copy), "it is damaged"),
        (name(&foreign), "belongs to another program"),
        (name(&scratch.path("nowhere.db")), "there is no such file"),
    ] {
        let refused = care(&["restore", bad], &database);
        assert!(refused.code == 1 && refused.stderr.contains(words), "{bad}: {}", refused.stderr);
        assert_eq!(refused.stderr.trim().lines().count(), 1);
        assert!(fs::read(&database).expect("it is still there") == kept, "nothing was changed");
    }
    fs::write(&copy, &bytes).expect("the scratch folder can be written");
    let refused = care(&["restore", name(&copy)], &foreign);
    assert!(refused.code == 1 && refused.stderr.contains("another program"), "{}", refused.stderr);

    // A database that is damaged beyond reading is what backups are for.
    fs::write(&database, &damaged).expect("the scratch folder can be written");
    for command in [&["restore", name(&copy)] as &[&str], &["check"]] {
        let done = care(command, &database);
        assert_eq!(done.code, 0, "{command:?}: {}{}", done.stdout, done.stderr);
    }
    let nowhere = care(&["backup", name(&scratch.path("x.db"))], &scratch.path("nothing.db"));
    assert!(nowhere.code == 1 && nowhere.stderr.contains("there is no such file"), "{}", nowhere.stderr);
    assert!(!scratch.path("nothing.db").exists(), "looking makes nothing");
}

#[tokio::test]
async fn a_check_names_what_is_damaged() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let client = grown(&server, 6).await;
    save(&server, &client.session);
    let whole = care(&["check"], &database);
    assert_eq!(whole.code, 0, "while the server runs: {}{}", whole.stdout, whole.stderr);
    assert!(whole.stdout.contains("sessions 1, trees 1, versions of them 1"), "{}", whole.stdout);
    drop(client);
    assert!(server.terminate().success());
    assert_eq!(care(&["check"], &database).code, 0);

    let mut connection =
        SqliteConnectOptions::new().filename(&database).connect().await.expect("it is a database");
    for (spoil, words) in [
        ("UPDATE snapshots SET bytes = x'ff'", "no snapshot of session"),
        ("UPDATE documents SET bytes = x'ff'", "version 1 of the tree"),
    ] {
        connection.execute(spoil).await.expect("it can be written");
        let damaged = care(&["check"], &database);
        assert!(damaged.code == 1 && damaged.stdout.contains(words), "{}{}", damaged.stdout, damaged.stderr);
        assert!(damaged.stderr.contains("is damaged"), "{}", damaged.stderr);
    }
}

#[tokio::test]
async fn hs5_nothing_is_acknowledged_once_the_database_is_gone() {
    let scratch = Scratch::new();
    let (database, elsewhere) = (scratch.path("trees.db"), scratch.path("elsewhere.db"));
    let server = Server::start(&database);
    let mut client = grown(&server, 5).await;
    let form = client.form().await;
    fs::rename(&database, &elsewhere).expect("it can be moved");
    // Nobody draws, and all are told nevertheless.
    while client.take_in().await {}
    let closed = client.closed.clone().expect("the server says why");
    assert_eq!(u16::from(closed.code), 1011);
    // A reason has 123 bytes at most.
    assert!(closed.reason.contains("database file has been moved"), "{}", closed.reason);
    let health = http::get(server.port(), "/health").expect("the server answers");
    assert_eq!(health.status, 503, "{}", health.text());
    let refused = http::send(server.port(), "POST", "/api/v1/sessions", Some(&json!({ "seed": 1 })));
    let refused = refused.expect("the server answers");
    assert_eq!(refused.status, 503);
    assert!(refused.text().contains("moved, deleted or replaced"), "{}", refused.text());
    let mut socket = client::open(server.port(), &client.session).await;
    let code = client::close_code(&mut socket).await;
    assert!(code == Some(1011) && socket.next().await.is_none_or(|rest| rest.is_err()), "{code:?}");

    fs::rename(&elsewhere, &database).expect("it can be moved back");
    client.reconnect(server.port()).await;
    client.until_form(&form).await;
    grow(&mut client, 1).await;
}

#[cfg(unix)]
#[test]
fn a_hard_link_is_no_other_database() {
    let scratch = Scratch::new();
    let (database, link) = (scratch.path("trees.db"), scratch.path("link.db"));
    let _server = Server::start(&database);
    fs::hard_link(&database, &link).expect("a link can be made");
    let second = program::run(&["serve", "--host", "127.0.0.1", "--port", "0", "--database", name(&link)]);
    assert!(second.code == 1 && second.stderr.contains("another Espalier server"), "{}", second.stderr);
}

#[test]
fn a_restore_that_was_cut_short_is_no_empty_library() {
    let scratch = Scratch::new();
    let (database, part) = (scratch.path("trees.db"), scratch.path("trees.db.part"));
    fs::write(&part, "half of a copy").expect("it can be written");
    let refused =
        program::run(&["serve", "--host", "127.0.0.1", "--port", "0", "--database", name(&database)]);
    assert!(refused.code == 1 && refused.stderr.contains("restore it again"), "{}", refused.stderr);
    fs::remove_file(&part).expect("it can be removed");
    drop(Server::start(&database));
}
