use std::{fs, path::Path};

use espalier_tests::{
    program::{self, Finished},
    scratch::Scratch,
    server::Server,
};
use sqlx::{ConnectOptions, Executor, sqlite::SqliteConnectOptions};

fn serve(database: &Path, port: u16) -> Finished {
    let database = database.to_str().expect("the scratch folder has a plain name");
    program::run(&["serve", "--host", "127.0.0.1", "--port", &port.to_string(), "--database", database])
}

/// Stopped with exit code 1 and a sentence, not with a panic or a list of causes.
fn is_sentence(finished: &Finished, words: &[&str]) {
    let said = finished.stderr.trim();
    assert_eq!(finished.code, 1, "{said}");
    assert!(!said.contains("panicked") && !said.contains("RUST_BACKTRACE"), "{said}");
    assert!(said.lines().count() <= 2 && said.len() > 20, "{said}");
    for word in words {
        assert!(said.contains(word), "{word:?} in {said:?}");
    }
}

#[test]
fn a_folder_is_not_a_database() {
    let scratch = Scratch::new();
    is_sentence(&serve(scratch.folder(), 0), &[scratch.folder().to_str().expect("a plain name")]);
}

#[test]
fn a_path_through_a_file_is_not_a_database() {
    let scratch = Scratch::new();
    fs::write(scratch.path("file"), "text").expect("the scratch folder can be written");
    is_sentence(&serve(&scratch.path("file").join("trees.db"), 0), &["trees.db"]);
}

#[test]
fn a_file_of_something_else_is_left_alone() {
    let scratch = Scratch::new();
    let path = scratch.path("trees.db");
    let garbage: Vec<u8> = (0..100_000u32).map(|i| (i.wrapping_mul(2654435761) >> 13) as u8).collect();
    fs::write(&path, &garbage).expect("the scratch folder can be written");
    is_sentence(&serve(&path, 0), &["trees.db"]);
    assert!(fs::read(&path).expect("it is still there") == garbage, "the file is as it was");
}

#[tokio::test]
async fn a_database_of_another_program_is_left_alone() {
    let scratch = Scratch::new();
    let path = scratch.path("photos.db");
    let mut connection = SqliteConnectOptions::new()
        .filename(&path)
        .create_if_missing(true)
        .connect()
        .await
        .expect("a database is made");
    connection.execute("CREATE TABLE photos (id INTEGER PRIMARY KEY)").await.expect("it takes a table");
    drop(connection);
    let before = fs::read(&path).expect("it is there");
    is_sentence(&serve(&path, 0), &["photos.db", "belongs to another program"]);
    assert!(fs::read(&path).expect("it is still there") == before, "the file is as it was");
    assert!(!scratch.path("photos.db.lock").exists(), "nothing is left beside it");
}

#[tokio::test]
async fn a_newer_schema_stops_the_server() {
    let scratch = Scratch::new();
    let path = scratch.path("trees.db");
    let server = Server::start(&path);
    assert!(server.terminate().success());
    let mut connection =
        SqliteConnectOptions::new().filename(&path).connect().await.expect("it is a database");
    let newer = "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time) \
                 VALUES (9999, 'from the future', TRUE, x'00', 0)";
    connection.execute(newer).await.expect("the table of migrations takes one more");
    drop(connection);
    is_sentence(&serve(&path, 0), &["trees.db", "newer"]);
}

#[test]
fn a_port_in_use_is_a_sentence() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("one.db"));
    is_sentence(&serve(&scratch.path("two.db"), server.port()), &[&server.port().to_string()]);
}

#[test]
fn two_servers_do_not_share_a_database() {
    let scratch = Scratch::new();
    let path = scratch.path("trees.db");
    let _server = Server::start(&path);
    is_sentence(&serve(&path, 0), &["trees.db"]);
}

#[test]
fn help_is_worth_reading() {
    let help = program::run(&["--help"]);
    assert_eq!(help.code, 0);
    for word in ["serve", "replay", "grow"] {
        assert!(help.stdout.contains(word), "{word} in {}", help.stdout);
    }
    let serve = program::run(&["serve", "--help"]);
    assert_eq!(serve.code, 0);
    for word in ["--host", "--port", "--database", "--log", "ESPALIER_"] {
        assert!(serve.stdout.contains(word), "{word} in {}", serve.stdout);
    }
}
