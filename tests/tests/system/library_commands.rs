//! The library on the command line, beside a server and without one.

use std::{fs, path::Path};

use espalier_tests::{client::Client, http, program, scratch::Scratch, server::Server, tls::TlsProxy};
use serde_json::{Value, json};

/// A trunk and a branch, as a scanner's program has them.
const SCAN: &str = include_str!("../../fuzz/seeds/rtwig.csv");

/// Runs `espalier library` on a database; what it printed.
fn library(database: &Path, arguments: &[&str]) -> String {
    let finished = run(database, arguments);
    assert_eq!(finished.code, 0, "{arguments:?}: {}", finished.stderr);
    finished.stdout
}

/// The same by a server.
fn asked(server: &Server, arguments: &[&str]) -> program::Finished {
    let url = format!("http://127.0.0.1:{}", server.port());
    program::run(&[&["library"], arguments, &["--url", &url]].concat())
}

fn run(database: &Path, arguments: &[&str]) -> program::Finished {
    let database = database.to_str().expect("a plain name");
    program::run(&[&["library"], arguments, &["--database", database]].concat())
}

fn lines(printed: &str) -> Vec<Value> {
    printed.lines().map(|line| serde_json::from_str(line).expect("an object on a line")).collect()
}

/// Saves what a session holds as a tree; its identifier.
async fn saved(port: u16, session: &str, name: &str) -> String {
    let save = json!({ "session": session, "name": name });
    let answer = http::send(port, "POST", "/api/v1/trees", Some(&save)).expect("the server answers");
    assert_eq!(answer.status, 201, "{}", answer.text());
    answer.json()["id"].as_str().expect("an identifier").to_owned()
}

#[tokio::test]
async fn trees_are_read_beside_a_server_and_changed_without_one() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let session = server.new_session(3);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    client.send(json!({ "kind": "grow", "steps": 6 })).await;
    client.until_settled().await;
    let oak = saved(server.port(), &session, "Old oak").await;
    saved(server.port(), &session, "Twin").await;
    saved(server.port(), &session, "Twin").await;
    let skeleton =
        http::get(server.port(), &format!("/api/v1/sessions/{session}/tree.json")).expect("a file");

    let listed = lines(&library(&database, &["ls", "--json", "--sort", "name"]));
    let names: Vec<_> = listed.iter().map(|line| line["name"].as_str().expect("a name")).collect();
    assert_eq!(names, ["Old oak", "Twin", "Twin"]);
    assert_eq!((&listed[0]["id"], &listed[0]["metamers"]), (&json!(oak), &json!(client.state.metamers)));
    let table = library(&database, &["find", "old", "OAK"]);
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows.len() == 2 && rows[0].starts_with("ID") && rows[1].starts_with(&oak), "{table}");
    let printed = library(&database, &["export", "Old oak", "-", "--format", "json"]);
    assert_eq!(printed.as_bytes(), skeleton.body, "the file is that of the server");
    let ply = scratch.path("oak.ply");
    library(&database, &["export", &oak, ply.to_str().expect("a plain name"), "--points", "500"]);
    assert!(fs::metadata(&ply).is_ok_and(|file| file.len() > 5000));
    let document = scratch.path("Kept oak.espalier");
    let document = document.to_str().expect("a plain name");
    library(&database, &["get", &oak, document]);
    let kept = http::get(server.port(), &format!("/api/v1/trees/{oak}/versions/1/document")).expect("a file");
    assert_eq!(fs::read(document).expect("it is there"), kept.body);

    for (arguments, code, said) in [
        (&["put", document][..], 1, "with --url"),
        (&["restore", &oak, "1"], 1, "A server is using the database"),
        (&["versions", "Twin"], 1, "2 trees are called"),
        (&["versions", "Elm"], 1, "no tree \"Elm\" in the library;"),
        (&["versions", "old oka"], 1, "no tree \"old oka\" in the library (did you mean Old oak?);"),
        (&["export", "Old oak", "oak.gltf"], 2, "unknown format `gltf`: did you mean `glb`?"),
        (&["get", &oak, "-", "--version", "9"], 1, "no version 9"),
        (&["export", &oak, "-"], 2, "--format"),
        (&["export", &oak, "a.mtg", "--hull"], 2, "no option `hull`"),
        (&["ls", "--species", "oka"], 2, "There is no species \"oka\" (did you mean oak?)."),
    ] {
        let finished = run(&database, arguments);
        assert_eq!(finished.code, code, "{arguments:?}: {}", finished.stderr);
        assert!(finished.stderr.contains(said), "{arguments:?}: {}", finished.stderr);
    }

    #[cfg(unix)]
    {
        let link = scratch.path("link.db");
        fs::hard_link(&database, &link).expect("a second name");
        let elsewhere = run(&link, &["ls"]);
        assert_eq!(elsewhere.code, 1);
        assert!(elsewhere.stderr.contains("a server is using it by another name"), "{}", elsewhere.stderr);
        fs::remove_file(&link).expect("it can be removed");
    }

    assert!(server.terminate().success());
    library(&database, &["put", document]);
    library(&database, &["put", document, "--to", "Old oak", "--note", "Again"]);
    library(&database, &["restore", &oak, "1"]);
    let versions = lines(&library(&database, &["versions", &oak, "--json"]));
    let told: Vec<_> = versions.iter().map(|version| (&version["number"], &version["note"])).collect();
    assert_eq!(told, [(&json!(3), &json!("")), (&json!(2), &json!("Again")), (&json!(1), &json!(""))]);
    assert_eq!(versions[0]["restored"], 1);
    let found = lines(&library(&database, &["find", "kept", "--json"]));
    assert_eq!((found.len(), &found[0]["name"]), (1, &json!("Kept oak")));
    let put = found[0]["id"].as_str().expect("an identifier");
    let server = Server::start(&database);
    for (tree, version) in [(put, 1), (oak.as_str(), 2)] {
        let path = format!("/api/v1/trees/{tree}/versions/{version}/thumbnail");
        let picture = http::get(server.port(), &path).expect("the server answers");
        assert_eq!((picture.status, picture.header("content-type")), (200, Some("image/png")));
        assert!(picture.body.starts_with(b"\x89PNG") && picture.body.len() > 2000, "{}", picture.body.len());
    }
    assert!(server.terminate().success());
    let missing = run(&database, &["restore", &oak, "7"]);
    assert!(missing.code == 1 && missing.stderr.contains("no version 7"), "{}", missing.stderr);
    let scan = scratch.path("scan.csv");
    fs::write(&scan, SCAN).expect("the scratch folder can be written");
    let scan = scan.to_str().expect("a plain name");
    library(&database, &["put", scan, "--name", "Scan"]);
    library(&database, &["put", scan, "--to", "Scan", "--internode-length", "0.05"]);
    library(&database, &["put", scan, "--to", "Scan", "--internode-length", "0.05", "--unit", "0.5"]);
    let versions = lines(&library(&database, &["versions", "Scan", "--json"]));
    let metamers: Vec<_> = versions.iter().map(|version| &version["metamers"]).collect();
    assert_eq!(metamers, [&json!(19), &json!(37), &json!(4)], "half the unit is half the size");
    let unseen = run(&database, &["put", document, "--name", "\u{202e}"]);
    assert_eq!(unseen.code, 2, "{}", unseen.stderr);
}

#[tokio::test]
async fn a_server_does_what_is_done_in_its_file() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let session = server.new_session(3);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    client.send(json!({ "kind": "grow", "steps": 6 })).await;
    client.until_settled().await;
    let oak = saved(server.port(), &session, "Old oak").await;
    saved(server.port(), &session, "Twin").await;
    saved(server.port(), &session, "Twin").await;
    let change = json!({ "tags": ["tall", "old"], "note": "Of the yard" });
    let tagged = http::send(server.port(), "PATCH", &format!("/api/v1/trees/{oak}"), Some(&change));
    assert_eq!(tagged.expect("the server answers").status, 200);
    let (one, other) = (scratch.path("one"), scratch.path("other"));
    let (one, other) = (one.to_str().expect("a plain name"), other.to_str().expect("a plain name"));

    // What is read is the same by both ways, and so is what is refused.
    for arguments in [
        &["ls"][..],
        &["ls", "--json", "--sort", "name"],
        &["ls", "--tag", "TALL", "--tag", "old"],
        &["ls", "--deleted"],
        &["ls", "--species", "oka"],
        &["find", "yard", "OAK", "--json"],
        &["versions", "Old oak", "--json"],
        &["versions", "Twin"],
        &["versions", "old oka"],
        &["export", "Old oak", "-", "--format", "mtg"],
        &["export", &oak, "-", "--format", "json", "--hull"],
        &["get", &oak, "-", "--version", "9"],
    ] {
        let (file, by_server) = (run(&database, arguments), asked(&server, arguments));
        assert_eq!((file.code, &file.stdout), (by_server.code, &by_server.stdout), "{arguments:?}");
        assert_eq!(file.stderr, by_server.stderr, "{arguments:?}");
    }
    for arguments in [["get", "Old oak"], ["review", "Old oak"]] {
        let both = [
            run(&database, &[&arguments[..], &[one]].concat()),
            asked(&server, &[&arguments[..], &[other]].concat()),
        ];
        assert!(both.iter().all(|finished| finished.code == 0), "{both:?}");
        // A page says when it was written.
        let [one, other] = [one, other].map(|path| fs::read(path).expect("it is written").len());
        assert_eq!(one, other, "{arguments:?}");
    }

    for told in [run(&database, &["sessions", "--json"]), asked(&server, &["sessions", "--json"])] {
        let told = lines(&told.stdout);
        let of = told.iter().find(|line| line["session"] == session.as_str()).expect("it is listed");
        assert_eq!((&of["tree_name"], &of["saved"]), (&json!("Twin"), &json!(true)));
    }

    // What is written needs no stopped server.
    let scan = scratch.path("scan.csv");
    fs::write(&scan, SCAN.trim_end()).expect("the scratch folder can be written");
    let scan = scan.to_str().expect("a plain name");
    let put = asked(
        &server,
        &["put", scan, "--name", "Scan", "--note", "From the yard", "--internode-length", "0.05"],
    );
    assert_eq!(put.code, 0, "{}", put.stderr);
    assert!(put.stderr.starts_with("Note: The last line has no line end"), "{}", put.stderr);
    let again =
        ["put", scan, "--to", "Scan", "--note", "Again", "--unit", "0.5", "--internode-length", "0.05"];
    let again = asked(&server, &again);
    assert!(
        again.code == 0 && again.stdout.ends_with(" has version 2.\n"),
        "{}{}",
        again.stdout,
        again.stderr
    );
    let restored = asked(&server, &["restore", "Scan", "1"]);
    assert!(restored.stdout.contains(" has version 3, which is as version 1."), "{}", restored.stderr);
    let versions = lines(&asked(&server, &["versions", "Scan", "--json"]).stdout);
    let told: Vec<_> =
        versions.iter().map(|version| (&version["number"], &version["note"], &version["metamers"])).collect();
    assert_eq!(
        told,
        [
            (&json!(3), &json!(""), &json!(37)),
            (&json!(2), &json!("Again"), &json!(19)),
            (&json!(1), &json!("From the yard"), &json!(37)),
        ]
    );
    for (arguments, code, said) in [
        (&["restore", "Scan", "7"][..], 1, "The tree has no version 7;"),
        (&["put", scan, "--to", "Elm"], 1, "no tree \"Elm\""),
        (&["put", scan, "--name", "\u{202e}"], 2, "name"),
        (&["put", scan, "--unit", "1e9"], 1, "refuses it: The file cannot become a tree: "),
    ] {
        let refused = asked(&server, arguments);
        assert_eq!(refused.code, code, "{arguments:?}: {}", refused.stderr);
        assert!(refused.stderr.contains(said), "{arguments:?}: {}", refused.stderr);
    }

    // The environment names it as well; the command line goes before it.
    let url = format!("http://127.0.0.1:{}", server.port());
    let mut command = program::command();
    command.args(["library", "ls"]).env("ESPALIER_URL", &url).env("ESPALIER_DATABASE", "nowhere.db");
    let listed = command.output().expect("the program starts");
    assert_eq!(String::from_utf8_lossy(&listed.stdout), asked(&server, &["ls"]).stdout);
    let mut command = program::command();
    command.args(["library", "ls", "--database", "nowhere.db"]).env("ESPALIER_URL", &url);
    let listed = command.output().expect("the program starts");
    assert!(String::from_utf8_lossy(&listed.stderr).contains("nowhere.db"));
    let twofold = program::run(&["library", "ls", "--url", &url, "--database", "nowhere.db"]);
    assert_eq!(twofold.code, 2);

    let port = server.port();
    assert!(server.terminate().success());
    let silent = program::run(&["library", "ls", "--url", &format!("http://127.0.0.1:{port}")]);
    assert!(silent.code == 1 && silent.stderr.contains("does not answer"), "{}", silent.stderr);
}

#[tokio::test]
async fn a_server_that_lets_nobody_in_asks_for_a_token() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start_with(&database, 0, &["--no-local"]);
    let refused = asked(&server, &["ls"]);
    assert!(refused.code == 1 && refused.stderr.contains("--token"), "{}", refused.stderr);
    let database = database.to_str().expect("a plain name");
    let made = program::run(&["token", "create", "script", "--database", database]);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let token = made.stdout.split_whitespace().max_by_key(|word| word.len()).expect("a token").to_owned();
    let listed = asked(&server, &["ls", "--token", &token]);
    assert_eq!(listed.code, 0, "{}", listed.stderr);
    assert!(listed.stdout.starts_with("ID"), "{}", listed.stdout);
}

/// A studio's proxy has a certificate of its own authority, of which its machines have been told.
#[tokio::test(flavor = "multi_thread")]
async fn a_server_behind_a_proxy_is_asked_over_tls() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let (certificate, stranger) = (scratch.path("proxy.pem"), scratch.path("stranger.pem"));
    TlsProxy::before(server.port(), &stranger).await;
    let proxy = TlsProxy::before(server.port(), &certificate).await;
    let scan = scratch.path("Old oak.csv");
    fs::write(&scan, SCAN).expect("the file is written");
    let ask = |arguments: &[&str], trusted: &Path| {
        let url = proxy.url();
        let mut command = program::command();
        command.arg("library").args(arguments).args(["--url", &url]).env("SSL_CERT_FILE", trusted);
        program::finished(&mut command, "")
    };
    let put = ask(&["put", scan.to_str().expect("a plain name")], &certificate);
    assert_eq!(put.code, 0, "{}", put.stderr);
    let listed = ask(&["ls", "--json"], &certificate);
    assert_eq!(lines(&listed.stdout)[0]["name"], "Old oak", "{}", listed.stderr);
    let refused = ask(&["ls"], &stranger);
    assert_ne!(refused.code, 0, "nothing is told to a proxy that nobody trusts");
    assert!(
        refused.stderr.contains("does not answer") && refused.stderr.contains("certificate"),
        "{}",
        refused.stderr
    );
}
