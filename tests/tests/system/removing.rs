//! People who are removed from a session by an owner, and to whom a tree is handed over, over real sockets.

use std::path::Path;

use espalier_tests::{
    client::{self, Socket},
    http, program,
    scratch::Scratch,
    server::Server,
};
use futures_util::SinkExt;
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

use super::people::{ask, cookie, name, secret_in};

/// A server with users of these names and roles, and their cookies as headers.
pub(super) fn studio<const N: usize>(database: &Path, users: [(&str, &str); N]) -> (Server, [String; N]) {
    let server = Server::start_with(database, 0, &["--auth"]);
    let cookies = users.map(|(user, role)| {
        for arguments in [&["add", user][..], &["role", user, role]] {
            let whole = [&["user"], arguments, &["--database", name(database)]].concat();
            let done = program::run_with(&whole, "battery staple");
            assert_eq!(done.code, 0, "{arguments:?}: {}", done.stderr);
        }
        let body = json!({ "name": user, "password": "battery staple" });
        let answer = http::send(server.port(), "POST", "/api/v1/login", Some(&body)).expect("it answers");
        let cookie = answer.header("set-cookie").and_then(|cookie| cookie.split(';').next());
        format!("cookie: {}", cookie.expect("it sets a cookie"))
    });
    (server, cookies)
}

/// A saved tree and its session.
pub(super) fn tree(server: &Server, owner: &str) -> (String, String) {
    let begun = ask(server, "POST", "/api/v1/sessions", owner, r#"{"seed":7}"#).json();
    let session = begun["session"].as_str().expect("it has a name").to_owned();
    let save = json!({ "session": session, "name": "Oak" }).to_string();
    let saved = ask(server, "POST", "/api/v1/trees", owner, &save).json();
    (session, saved["id"].as_str().expect("it has an identifier").to_owned())
}

/// Somebody comes in and says that they are here, as this client.
pub(super) async fn come(server: &Server, session: &str, cookie: &str, client: &str) -> Socket {
    come_to(server, session, "socket", cookie, client).await
}

/// The same by another socket.
pub(super) async fn come_to(
    server: &Server,
    session: &str,
    door: &str,
    cookie: &str,
    client: &str,
) -> Socket {
    let value = cookie.strip_prefix("cookie: ").expect("it is a header");
    let mut socket = client::open_door(server.port(), session, door, &[("cookie", value)]).await;
    for message in [json!({ "type": "hello", "protocol": 4, "client": client }), json!({ "type": "here" })] {
        socket.send(client::text(&message)).await.expect("it is sent");
    }
    socket
}

/// Messages come until one is as wanted.
pub(super) async fn until(socket: &mut Socket, is_it: impl Fn(&Value) -> bool) -> Value {
    loop {
        match client::next(socket).await {
            Some(Message::Text(text)) => {
                let message: Value = serde_json::from_str(&text).expect("it is JSON");
                if is_it(&message) {
                    return message;
                }
            }
            Some(_) => {}
            None => panic!("the socket has ended"),
        }
    }
}

/// The number of somebody by their name, once they are told of.
pub(super) async fn number_of(socket: &mut Socket, name: &str) -> u64 {
    let named = |message: &Value| {
        let people = message["people"].as_array()?;
        people.iter().find(|person| person["name"] == name)?["person"].as_u64()
    };
    named(&until(socket, |message| named(message).is_some()).await).expect("they were found")
}

/// What somebody may do from now on, once they are told.
async fn role(socket: &mut Socket) -> Value {
    until(socket, |message| message["type"] == "role").await["role"].clone()
}

#[tokio::test]
async fn ac17_a_user_is_removed_and_comes_back_when_they_are_let() {
    let scratch = Scratch::new();
    let (server, [ann, bo]) = studio(&scratch.path("trees.db"), [("Ann", "owner"), ("Bo", "editor")]);
    let (session, _) = tree(&server, &ann);
    let mut anns = come(&server, &session, &ann, "client-of-ann").await;
    let mut bos = come(&server, &session, &bo, "client-of-bo-1").await;
    let mut bos_second = come(&server, &session, &bo, "client-of-bo-2").await;
    let number = number_of(&mut anns, "Bo").await;
    let own = number_of(&mut bos, "Ann").await;
    until(&mut bos_second, |message| message["type"] == "people").await;
    let remove = |who: &str, number: u64| {
        ask(&server, "DELETE", &format!("/api/v1/sessions/{session}/people/{number}"), who, "")
    };
    assert_eq!(remove(&bo, own).status, 403, "editors remove nobody");
    assert_eq!(remove(&ann, own).status, 403, "owners are not removed, nor is oneself");
    let removed = remove(&ann, number);
    assert_eq!(removed.status, 200, "{}", removed.text());
    assert_eq!(removed.json()["name"], "Bo");
    assert!(removed.json()["until"].is_string(), "they are kept out for a time");
    for socket in [&mut bos, &mut bos_second] {
        assert_eq!(client::close(socket).await, Some((4005, "removed: Ann".into())));
    }
    until(&mut anns, |message| message["people"].as_array().is_some_and(|people| people.len() == 1)).await;
    // They come back to nothing of this tree, and are who they are elsewhere.
    let mut again = come(&server, &session, &bo, "client-of-bo-1").await;
    assert_eq!(client::close(&mut again).await, Some((4005, "removed: Ann".into())));
    assert_eq!(ask(&server, "GET", "/api/v1/me", &bo, "").status, 200);
    assert_eq!(ask(&server, "POST", "/api/v1/sessions", &bo, r#"{"seed":8}"#).status, 201);

    let list = ask(&server, "GET", &format!("/api/v1/sessions/{session}/removals"), &ann, "").json();
    assert_eq!((&list[0]["name"], &list[0]["by"]), (&json!("Bo"), &json!("Ann")));
    let removal = list[0]["id"].as_str().expect("it has an identifier");
    let back = format!("/api/v1/sessions/{session}/removals/{removal}");
    assert_eq!(ask(&server, "DELETE", &back, &ann, "").status, 204);
    let mut back = come(&server, &session, &bo, "client-of-bo-1").await;
    until(&mut back, |message| message["type"] == "welcome").await;
}

#[tokio::test]
async fn ac17_a_guest_is_removed_for_good_and_hears_by_whom() {
    let scratch = Scratch::new();
    let (server, [ann]) = studio(&scratch.path("trees.db"), [("Ann", "owner")]);
    let (session, tree) = tree(&server, &ann);
    let body = r#"{"role":"editor","name":"Guest tablet"}"#;
    let made = ask(&server, "POST", &format!("/api/v1/trees/{tree}/links"), &ann, body).json();
    let guest = cookie(&server, secret_in(made["url"].as_str().expect("it has an address")));
    let guest = format!("cookie: {guest}");
    let mut anns = come(&server, &session, &ann, "client-of-ann").await;
    let mut guests = come(&server, &session, &guest, "client-of-guest").await;
    let number = number_of(&mut anns, "Guest tablet").await;
    let path = format!("/api/v1/sessions/{session}/people/{number}");
    let removed = ask(&server, "DELETE", &path, &ann, "").json();
    assert_eq!(removed, json!({ "name": "Guest tablet" }), "their link is gone, so nothing ends");
    assert_eq!(client::close(&mut guests).await, Some((4005, "removed-guest: Ann".into())));
    assert_eq!(ask(&server, "GET", "/api/v1/me", &guest, "").status, 401);
    let links = ask(&server, "GET", &format!("/api/v1/trees/{tree}/links"), &ann, "").json();
    assert_eq!(links, json!([]));
}

#[tokio::test]
async fn ac12_a_guest_who_is_here_may_do_more_or_less_by_their_link() {
    let scratch = Scratch::new();
    let (server, [ann, bo]) = studio(&scratch.path("trees.db"), [("Ann", "owner"), ("Bo", "editor")]);
    let (session, tree) = tree(&server, &ann);
    let links = format!("/api/v1/trees/{tree}/links");
    let made = ask(&server, "POST", &links, &ann, r#"{"role":"editor","name":"Guest tablet"}"#).json();
    let guest =
        format!("cookie: {}", cookie(&server, secret_in(made["url"].as_str().expect("it has an address"))));
    let mut anns = come(&server, &session, &ann, "client-of-ann").await;
    let _bos = come(&server, &session, &bo, "client-of-bo").await;
    let mut guests = come(&server, &session, &guest, "client-of-guest").await;
    until(&mut anns, |message| message["people"].as_array().is_some_and(|people| people.len() == 3)).await;
    let path = format!("/api/v1/sessions/{session}/guests");
    assert_eq!(ask(&server, "GET", &path, &bo, "").status, 403, "owners see who came how");
    let here = ask(&server, "GET", &path, &ann, "").json();
    assert_eq!(here.as_array().map(Vec::len), Some(1), "who logs in came by no link: {here}");
    let (link, number) = (&here[0]["link"], here[0]["person"].as_u64().expect("a number"));
    assert_eq!(
        (&link["name"], &link["role"], &link["id"]),
        (&json!("Guest tablet"), &json!("editor"), &made["id"])
    );
    assert_eq!(here[0]["tree"], json!(tree));
    let patch = format!("{links}/{}", link["id"].as_str().expect("it has an identifier"));
    for wanted in ["commenter", "viewer", "editor"] {
        let body = json!({ "role": wanted }).to_string();
        assert_eq!(ask(&server, "PATCH", &patch, &ann, &body).status, 200);
        assert_eq!(role(&mut guests).await, wanted, "it holds at once");
        let is_told = |message: &Value| {
            let people = message["people"].as_array().into_iter().flatten();
            people.into_iter().any(|one| one["person"] == number && one["role"] == wanted)
        };
        until(&mut anns, is_told).await;
        assert_eq!(ask(&server, "GET", &path, &ann, "").json()[0]["link"]["role"], wanted);
    }
}

#[tokio::test]
async fn ac18_a_tree_is_handed_on_while_people_are_connected() {
    let scratch = Scratch::new();
    let users = [("Ann", "owner"), ("Bo", "editor"), ("Cy", "viewer")];
    let (server, [ann, bo, cy]) = studio(&scratch.path("trees.db"), users);
    let (session, tree) = tree(&server, &ann);
    let mut anns = come(&server, &session, &ann, "client-of-ann").await;
    let mut bos = come(&server, &session, &bo, "client-of-bo").await;
    let mut cys = come(&server, &session, &cy, "client-of-cy").await;
    let owner = format!("/api/v1/sessions/{session}/owner");
    let hand =
        |who: &str, number: u64| ask(&server, "PUT", &owner, who, &json!({ "person": number }).to_string());
    let number = number_of(&mut anns, "Bo").await;
    assert_eq!(hand(&bo, number).status, 403, "who owns nothing hands nothing over");
    assert_eq!(hand(&ann, number).json(), json!({ "name": "Bo" }));
    assert_eq!(role(&mut bos).await, "owner");
    assert_eq!(ask(&server, "PUT", &format!("/api/v1/trees/{tree}/lock"), &bo, "").status, 200);
    assert_eq!(hand(&bo, number).json()["field"], "person", "nobody hands a tree over to themselves");
    let number = number_of(&mut bos, "Cy").await;
    assert_eq!(hand(&bo, number).json(), json!({ "name": "Cy" }));
    assert_eq!(role(&mut bos).await, "commenter", "what an editor may with a locked tree (AC16)");
    assert_eq!(hand(&bo, number).status, 403, "they have it no longer");
    assert_eq!(role(&mut cys).await, "owner");
    assert_eq!(ask(&server, "DELETE", &format!("/api/v1/trees/{tree}/lock"), &bo, "").status, 403);
    assert_eq!(ask(&server, "DELETE", &owner, &ann, "").json(), json!({}), "owners of all trees stay so");
    assert_eq!(role(&mut cys).await, "viewer");
}

#[tokio::test]
async fn ac16_who_draws_comments_on_a_locked_tree_and_draws_again_afterwards() {
    let scratch = Scratch::new();
    let users = [("Ann", "owner"), ("Bo", "editor"), ("Cy", "viewer")];
    let (server, [ann, bo, cy]) = studio(&scratch.path("trees.db"), users);
    let (session, tree) = tree(&server, &ann);
    let mut bos = come(&server, &session, &bo, "client-of-bo").await;
    // Only who is inside is told of another role.
    until(&mut bos, |message| message["type"] == "welcome").await;
    let lock = format!("/api/v1/trees/{tree}/lock");
    assert_eq!(ask(&server, "PUT", &lock, &ann, "").status, 200);
    assert_eq!(role(&mut bos).await, "commenter");
    let draw = |id: u32| json!({ "type": "command", "id": id, "command": { "kind": "grow", "steps": 1 } });
    bos.send(client::text(&draw(1))).await.expect("it is sent");
    until(&mut bos, |message| message["type"] == "refused").await;
    let threads = format!("/api/v1/trees/{tree}/threads");
    let comment = r#"{"comment":{"text":"Too dense here"}}"#;
    assert_eq!(ask(&server, "POST", &threads, &bo, comment).status, 201, "a review goes on");
    assert_eq!(ask(&server, "POST", &threads, &cy, comment).status, 403, "a lock gives nobody more");
    assert_eq!(ask(&server, "DELETE", &lock, &ann, "").status, 200);
    assert_eq!(role(&mut bos).await, "editor");
    bos.send(client::text(&draw(2))).await.expect("it is sent");
    until(&mut bos, |message| message["type"] == "acknowledged" && message["id"] == 2).await;
}
