//! Who logs in with a password, added at the command line.

use std::path::Path;

use espalier_tests::{
    client,
    http::{self, Answer},
    program::{self, Finished},
    scratch::Scratch,
    server::Server,
};
use futures_util::SinkExt;
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

use super::people::{ask, name, printed_by};

fn user(arguments: &[&str], database: &Path, password: &str) -> Finished {
    program::run_with(&[&["user"], arguments, &["--database", name(database)]].concat(), password)
}

fn log_in(server: &Server, name: &str, password: &str) -> Answer {
    let body = json!({ "name": name, "password": password });
    http::send(server.port(), "POST", "/api/v1/login", Some(&body)).expect("the server answers")
}

/// The cookie of whoever logs in, as a header.
fn cookie(server: &Server, name: &str, password: &str) -> String {
    let answer = log_in(server, name, password);
    assert_eq!(answer.status, 200, "{}", answer.text());
    let cookie = answer.header("set-cookie").and_then(|cookie| cookie.split(';').next());
    format!("cookie: {}", cookie.expect("it sets a cookie"))
}

fn me(server: &Server, header: &str) -> Value {
    ask(server, "GET", "/api/v1/me", header, "").json()
}

#[test]
fn ac9_the_first_administrator_comes_by_one_command() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start_with(&database, 0, &["--auth"]);
    let printed = printed_by(&server);
    assert!(printed.contains("user add --admin NAME") && !printed.contains("/pair#"), "{printed}");
    // Who sits at the machine is nobody.
    let list = http::get(server.port(), "/api/v1/trees").expect("the server answers");
    assert_eq!((list.status, list.json()["reason"].as_str()), (401, Some("not-let-in")));

    let added = user(&["add", "--admin", "Ada"], &database, "correct horse\n");
    assert_eq!((added.code, &*added.stdout), (0, "Ada can log in: admin.\n"), "{}", added.stderr);
    let ada = cookie(&server, "ada", "correct horse");
    assert_eq!(me(&server, &ada), json!({ "role": "admin", "way": "login", "name": "Ada" }));
    let users = ask(&server, "GET", "/api/v1/users", &ada, "").json();
    assert_eq!((&users[0]["name"], &users[0]["role"]), (&json!("Ada"), &json!("admin")));
    assert_eq!(ask(&server, "POST", "/api/v1/sessions", &ada, r#"{"seed":7}"#).status, 201);
}

#[test]
fn ac9_users_are_listed_changed_and_removed_while_the_server_runs() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start_with(&database, 0, &["--auth"]);
    let said = |arguments: &[&str], password: &str| {
        let done = user(arguments, &database, password);
        assert_eq!(done.code, 0, "{arguments:?}: {}", done.stderr);
        done.stdout
    };
    said(&["add", "Bo"], "battery staple");
    let bo = cookie(&server, "Bo", "battery staple");
    assert_eq!(me(&server, &bo)["role"], "editor");
    assert_eq!(ask(&server, "GET", "/api/v1/users", &bo, "").status, 403);
    said(&["role", "Bo", "viewer"], "");
    assert_eq!(me(&server, &bo)["role"], "viewer");
    assert!(said(&["ls"], "").contains("Bo: viewer, since "));
    said(&["passwd", "bo"], "another password\n");
    assert_eq!(me(&server, &bo)["reason"], "not-let-in", "they are logged in nowhere");
    assert_eq!(log_in(&server, "Bo", "battery staple").json()["reason"], "wrong-password");
    let bo = cookie(&server, "Bo", "another password");
    said(&["remove", "Bo"], "");
    assert_eq!(me(&server, &bo)["reason"], "not-let-in");
    let audited = program::run(&["audit", "--json", "--database", name(&database)]);
    let events: Vec<Value> =
        audited.stdout.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect();
    let actions: Vec<&str> = events.iter().rev().filter_map(|event| event["action"].as_str()).collect();
    let expected = ["user-add", "log-in", "user-role", "user-passwd", "log-in", "log-in", "user-remove"];
    assert_eq!(actions, expected);
    assert_eq!((&events[1]["who"], &events[2]["outcome"]), (&json!("login Bo"), &json!("401")));
    assert_eq!(said(&["ls"], ""), "");
}

#[tokio::test]
async fn au3_a_role_changes_while_its_user_is_connected() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start_with(&database, 0, &["--auth"]);
    assert_eq!(user(&["add", "Bo"], &database, "battery staple").code, 0);
    let bo = cookie(&server, "Bo", "battery staple");
    let created = ask(&server, "POST", "/api/v1/sessions", &bo, r#"{"seed":7}"#).json();
    let session = created["session"].as_str().expect("it has a name").to_owned();
    let value = bo.strip_prefix("cookie: ").expect("it is a header");
    let mut socket = client::open_with(server.port(), &session, &[("cookie", value)]).await;
    let hello = json!({ "type": "hello", "protocol": 4, "client": "browser-1" });
    socket.send(client::text(&hello)).await.expect("it is sent");
    // With the role of now; what changes from now on is told.
    until(&mut socket, "welcome").await;
    for (role, expected) in [("viewer", "refused"), ("owner", "acknowledged")] {
        assert_eq!(user(&["role", "Bo", role], &database, "").code, 0);
        let told = until(&mut socket, "role").await;
        assert_eq!(told["role"], role);
        let id = if role == "viewer" { 1 } else { 2 };
        let command = json!({ "type": "command", "id": id, "command": { "kind": "grow", "steps": 1 } });
        socket.send(client::text(&command)).await.expect("it is sent");
        assert_eq!(until(&mut socket, expected).await["id"], id);
    }
}

#[tokio::test]
async fn ac22_what_was_given_is_told_and_taken_while_somebody_is_connected() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start_with(&database, 0, &["--auth"]);
    assert_eq!(user(&["add", "--admin", "Ada"], &database, "correct horse").code, 0);
    assert_eq!(user(&["add", "Bo", "--role", "none"], &database, "battery staple").code, 0);
    let (ada, bo) = (cookie(&server, "Ada", "correct horse"), cookie(&server, "Bo", "battery staple"));
    let created = ask(&server, "POST", "/api/v1/sessions", &ada, r#"{"seed":7}"#).json();
    let session = created["session"].as_str().expect("it has a name").to_owned();
    let saved = json!({ "session": session, "name": "Old ash" }).to_string();
    let tree = ask(&server, "POST", "/api/v1/trees", &ada, &saved).json();
    let path = format!("/api/v1/trees/{}", tree["id"].as_str().expect("it has an identifier"));
    assert_eq!(ask(&server, "GET", &path, &bo, "").status, 404);
    let member = |arguments: &[&str]| {
        program::run(&[&["member"], arguments, &["--database", name(&database)]].concat())
    };
    let mistyped = member(&["add", "Old ahs", "Bo"]);
    assert!(mistyped.stderr.contains("did you mean Old ash?"), "{}", mistyped.stderr);
    let mistyped = member(&["add", "Old ash", "Aad"]);
    assert!(mistyped.stderr.contains("There is no user Aad (did you mean Ada?)"), "{}", mistyped.stderr);
    let given = member(&["add", "Old ash", "Bo", "--role", "editor"]);
    assert_eq!(
        (given.code, &*given.stdout),
        (0, "Bo is editor of Old ash from now on.\n"),
        "{}",
        given.stderr
    );
    assert_eq!(member(&["ls", "Old ash"]).stdout, "Bo: editor\n");

    let value = bo.strip_prefix("cookie: ").expect("it is a header");
    let mut socket = client::open_with(server.port(), &session, &[("cookie", value)]).await;
    let hello = json!({ "type": "hello", "protocol": 4, "client": "browser-1" });
    socket.send(client::text(&hello)).await.expect("it is sent");
    // With what was given so far; what changes from now on is told.
    until(&mut socket, "welcome").await;
    for (role, expected, id) in [("viewer", "refused", 1), ("owner", "acknowledged", 2)] {
        let new = json!({ "name": "Bo", "role": role }).to_string();
        assert_eq!(ask(&server, "POST", &format!("{path}/members"), &ada, &new).status, 201);
        assert_eq!(until(&mut socket, "role").await["role"], role);
        let command = json!({ "type": "command", "id": id, "command": { "kind": "grow", "steps": 1 } });
        socket.send(client::text(&command)).await.expect("it is sent");
        assert_eq!(until(&mut socket, expected).await["id"], id);
    }
    // What is deleted is nobody's whom it was given to, until it is taken back (LB6).
    assert_eq!(ask(&server, "DELETE", &path, &ada, "").status, 204);
    let (code, reason) = client::close(&mut socket).await.expect("it is said why");
    assert!(code == 4007 && reason.starts_with("no-session: "), "{code} {reason}");
    assert_eq!(ask(&server, "POST", &format!("{path}/undelete"), &bo, "").status, 200);
    let mut socket = client::open_with(server.port(), &session, &[("cookie", value)]).await;
    socket.send(client::text(&hello)).await.expect("it is sent");
    until(&mut socket, "welcome").await;
    assert_eq!(member(&["remove", "Old ash", "Bo"]).code, 0);
    let (code, reason) = client::close(&mut socket).await.expect("it is said why");
    assert!(code == 4007 && reason.starts_with("no-session: "), "{code} {reason}");
    assert_eq!(ask(&server, "GET", &path, &bo, "").status, 404);
    let audit = program::run(&["audit", "--database", name(&database)]).stdout;
    assert!(
        audit.contains("give Old ash Bo editor: done") && audit.contains("take-back Old ash Bo: done"),
        "{audit}"
    );
}

/// The next message of a type.
async fn until(socket: &mut client::Socket, kind: &str) -> Value {
    loop {
        match client::next(socket).await {
            Some(Message::Text(text)) => {
                let message: Value = serde_json::from_str(&text).expect("it is JSON");
                if message["type"] == kind {
                    return message;
                }
            }
            Some(Message::Binary(_)) => {}
            other => panic!("{other:?} instead of {kind}"),
        }
    }
}

#[test]
fn ac9_a_name_that_is_taken_or_of_nobody_and_a_short_password_are_refused() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    assert_eq!(user(&["add", "Ada"], &database, "correct horse").code, 0);
    for (arguments, password, expected) in [
        (&["add", "ADA"][..], "correct horse", "There is a user ADA already"),
        (&["add", "Bo"], "short", "8 to 200 characters"),
        (&["add", "Bo"], "", "8 to 200 characters"),
        (&["passwd", "Bo"], "correct horse", "There is no user Bo"),
        (&["role", "Bo", "viewer"], "", "There is no user Bo"),
        (&["remove", "Bo"], "", "There is no user Bo"),
    ] {
        let refused = user(arguments, &database, password);
        assert_eq!(refused.code, 1, "{arguments:?}");
        assert!(refused.stderr.contains(expected), "{arguments:?}: {}", refused.stderr);
    }
}

#[test]
fn ac13_the_last_administrator_stays_unless_it_is_forced() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    assert_eq!(user(&["add", "--admin", "Ada"], &database, "correct horse").code, 0);
    assert_eq!(user(&["add", "Bo"], &database, "battery staple").code, 0);
    for arguments in [&["remove", "ADA"][..], &["role", "ada", "owner"]] {
        let refused = user(arguments, &database, "");
        assert_eq!(refused.code, 1, "{arguments:?}");
        assert!(refused.stderr.contains("Ada is the last administrator"), "{}", refused.stderr);
    }
    assert!(user(&["ls"], &database, "").stdout.contains("Ada: admin"), "nothing has changed");
    assert_eq!(user(&["role", "Ada", "admin"], &database, "").code, 0);
    assert_eq!(user(&["remove", "Bo"], &database, "").code, 0, "others may go");
    // With another one she is not the last.
    assert_eq!(user(&["add", "--admin", "Cy"], &database, "battery staple").code, 0);
    assert_eq!(user(&["role", "Ada", "owner"], &database, "").code, 0);
    assert_eq!(user(&["remove", "--force", "Cy"], &database, "").code, 0);
}

#[test]
fn ac15_groups_give_their_members_a_role_while_the_server_runs() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start_with(&database, 0, &["--auth"]);
    let group = |arguments: &[&str]| {
        program::run(&[&["group"], arguments, &["--database", name(&database)]].concat())
    };
    let said = |arguments: &[&str]| {
        let done = group(arguments);
        assert_eq!(done.code, 0, "{arguments:?}: {}", done.stderr);
        done.stdout
    };
    for person in ["Ada", "Bo"] {
        assert_eq!(user(&["add", person, "--role", "viewer"], &database, "battery staple").code, 0);
    }
    let bo = cookie(&server, "Bo", "battery staple");
    assert_eq!(said(&["ls"]), "");
    said(&["add", "Studio", "--role", "owner"]);
    assert_eq!(said(&["join", "studio", "bo", "Ada"]), "bo, Ada are in studio from now on.\n");
    assert_eq!(me(&server, &bo)["role"], "owner", "at once");
    assert!(user(&["ls"], &database, "").stdout.contains("Bo: owner by a group, since "));
    said(&["role", "Studio", "editor"]);
    assert_eq!(me(&server, &bo)["role"], "editor");
    assert_eq!(said(&["leave", "Studio", "Bo"]), "Bo is in Studio no longer.\n");
    assert_eq!(me(&server, &bo)["role"], "viewer");
    assert_eq!(said(&["ls"]), "Studio: editor: Ada\n");
    for (arguments, sentence) in [
        (&["add", "STUDIO"][..], "There is a group STUDIO already"),
        (&["add", "Choir", "--role", "admin"], "invalid value 'admin'"),
        (&["join", "Studio", "Cy"], "There is no user Cy"),
        (&["join", "Choir", "Bo"], "There is no group Choir"),
        (&["leave", "Studio", "Bo"], "Bo is not in a group Studio"),
        (&["role", "Choir", "editor"], "There is no group Choir"),
        (&["remove", "Choir"], "There is no group Choir"),
    ] {
        let refused = group(arguments);
        assert_ne!(refused.code, 0, "{arguments:?}");
        assert!(refused.stderr.contains(sentence), "{arguments:?}: {}", refused.stderr);
    }
    said(&["remove", "Studio"]);
    assert_eq!(said(&["ls"]), "");
    let audit = program::run(&["audit", "--database", name(&database)]).stdout;
    for action in ["group-add Studio", "group-join studio bo", "group-role Studio", "group-remove Studio"] {
        assert!(audit.contains(action), "{action}: {audit}");
    }
}
