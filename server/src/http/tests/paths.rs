//! At every address: a path that cannot be read, a method that is not taken, and what is not there are each a problem
//! that names the field and what is allowed.

use std::collections::BTreeMap;

use axum::http::HeaderMap;
use espalier_proto::PROBLEM_JSON;
use serde_json::{Value, json};

use super::{
    people::{group, user},
    refusals::bodies,
    *,
};
use crate::store::{Comments, Gift, Gifts, Group, Groups, NewComment, Receiver, User, Users};

/// Parts of paths that are whole numbers.
const NUMBERS: [&str; 6] = ["version", "obstacle", "seed", "thread", "comment", "person"];

struct Answer {
    status: StatusCode,
    headers: HeaderMap,
    problem: Value,
}

impl Answer {
    fn assert(&self, status: StatusCode, field: &str, asked: &str) {
        let Self { status: found, headers, problem } = self;
        assert_eq!((*found, problem["field"].as_str()), (status, Some(field)), "{asked}: {problem}");
        assert_eq!(headers[header::CONTENT_TYPE], PROBLEM_JSON, "{asked}");
        assert_eq!(problem["status"], status.as_u16(), "{asked}");
        let said = |name: &str| problem[name].as_str().is_some_and(|text| !text.is_empty());
        let reason = problem["reason"].as_str().unwrap();
        assert_eq!(problem["type"], format!("/api#{reason}"), "{asked}");
        assert!(said("allowed") && said("detail") && said("title"), "{asked}: {problem}");
    }
}

async fn ask(server: &Router, method: &Method, path: &str, body: &Value, revision: Option<&str>) -> Answer {
    let mut request = request(method, path).header(header::CONTENT_TYPE, "application/json");
    if let Some(revision) = revision {
        request = request.header(header::IF_MATCH, revision);
    }
    let body = if body.is_null() { Body::empty() } else { Body::from(body.to_string()) };
    let answer = server.clone().oneshot(request.body(body).unwrap()).await.unwrap();
    let (status, headers) = (answer.status(), answer.headers().clone());
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    Answer { status, headers, problem: serde_json::from_slice(&bytes).unwrap_or_default() }
}

/// All addresses but that of the socket.
fn addresses() -> Vec<String> {
    routes().into_iter().chain(downloads()).map(|route| route.address.into_owned()).collect()
}

/// What can be filled into a path.
fn parts(path: &str) -> Vec<&str> {
    path.split(['{', '}']).skip(1).step_by(2).collect()
}

/// What somebody has said.
fn comment() -> NewComment {
    let said = json!({ "text": "Thinner" }).to_string();
    let (person, author) = ("machine".into(), "Ann".into());
    NewComment { person, author, written_at: "2026".into(), said, picture: None }
}

/// The path with this instead of one of its parts.
fn filled_with(path: &str, part: &str, text: &str) -> String {
    filled(&path.replace(&format!("{{{part}}}"), text))
}

#[tokio::test]
async fn er1_a_path_that_cannot_be_read_is_a_problem() {
    let (server, _) = server().await;
    for address in addresses().into_iter().chain(sockets().map(|socket| socket.address.to_owned())) {
        let (method, path) = (method_of(&address), path_of(&address));
        for part in parts(path) {
            let numbers: &[&str] = if NUMBERS.contains(&part) { &["x", "-1", "4294967296"] } else { &[] };
            for wrong in [&["%ff"], numbers].concat() {
                let asked = filled_with(path, part, wrong);
                let answer = ask(&server, &method, &asked, &Value::Null, None).await;
                answer.assert(StatusCode::BAD_REQUEST, part, &asked);
            }
        }
    }
}

#[tokio::test]
async fn er1_a_wrong_method_is_a_problem_that_names_the_right_ones() {
    let (server, _) = server().await;
    let mut taken: BTreeMap<String, Vec<Method>> = BTreeMap::new();
    for address in addresses().into_iter().chain(sockets().map(|socket| socket.address.to_owned())) {
        taken.entry(filled(path_of(&address))).or_default().push(method_of(&address));
    }
    for path in ["/", "/api", "/pair", "/s/oak", "/health"] {
        taken.entry(path.to_owned()).or_default().push(Method::GET);
    }
    for (path, methods) in &taken {
        let all = [Method::GET, Method::PUT, Method::POST, Method::PATCH, Method::DELETE];
        for method in all.iter().filter(|method| !methods.contains(method)) {
            let asked = format!("{method} {path}");
            let answer = ask(&server, method, path, &Value::Null, None).await;
            answer.assert(StatusCode::METHOD_NOT_ALLOWED, "method", &asked);
            let allowed = answer.problem["allowed"].as_str().unwrap();
            let named: BTreeSet<&str> = allowed.split(", ").filter(|&method| method != "HEAD").collect();
            assert_eq!(named, methods.iter().map(Method::as_str).collect(), "{asked}");
            assert_eq!(
                answer.headers[header::ALLOW].to_str().unwrap().replace(',', ", "),
                allowed,
                "{asked}"
            );
        }
    }
}

#[tokio::test]
async fn er1_an_address_that_is_none_says_so_to_every_method() {
    let (server, _) = server().await;
    for method in [Method::GET, Method::POST, Method::PUT, Method::DELETE] {
        for path in ["/api/v1/shrubs", "/api/", "/nowhere.html"] {
            let answer = ask(&server, &method, path, &Value::Null, None).await;
            answer.assert(StatusCode::NOT_FOUND, "path", path);
        }
    }
}

#[tokio::test]
async fn what_was_mistyped_is_told_what_may_have_been_meant() {
    let (server, _) = server().await;
    let grow = |body: Value| ("POST", "/api/v1/grow", body);
    for ((method, path, body), said) in [
        (("GET", "/api/v1/sessions/oak/tree.gltf", Value::Null), "(did you mean glb?)"),
        (("GET", "/api/v1/trees/ash/versions/1/tree.mgt", Value::Null), "(did you mean mtg?)"),
        (("GET", "/api/v1/sessions/oak/tree.fbx", Value::Null), "There is no such format."),
        (("POST", "/api/v1/trees/import?name=Oak&format=cvs", Value::Null), "cvs (did you mean csv?)"),
        (("GET", "/api/v1/trees?species=oka", Value::Null), "no species \"oka\" (did you mean oak?)"),
        (("GET", "/api/v1/trees?species=triffid", Value::Null), "no species \"triffid\"."),
        (grow(json!({ "template": "oak", "format": "gltf" })), "format is gltf (did you mean glb?)"),
        (grow(json!({ "template": "scots-pien", "format": "glb" })), "; did you mean scots-pine?"),
        (grow(json!({ "template": "ywe", "format": "glb" })), "; did you mean yew, which is called"),
        (
            ("GET", "/api/v1/trees/ywe", Value::Null),
            "There is no such tree; did you mean yew, which is called",
        ),
        (("PATCH", "/api/v1/trees/Yeww", json!({ "name": "Oak" })), "; did you mean yew, which is called"),
        (("GET", "/api/v1/trees/ywe/versions/1/thumbnail", Value::Null), "; did you mean yew"),
        (("GET", "/api/v1/trees/triffid", Value::Null), "There is no such tree."),
        (grow(json!({ "template": "triffid", "format": "glb" })), "There is no such species or saved tree."),
    ] {
        let answer = ask(&server, &method.parse().unwrap(), path, &body, None).await;
        let message = answer.problem["detail"].as_str().unwrap();
        assert!(message.contains(said), "{method} {path} {body}: {message}");
    }
}

#[tokio::test]
async fn what_is_not_there_is_named_by_the_part_of_the_path() {
    let bodies: BTreeMap<&str, Value> =
        bodies().into_iter().map(|(address, _, body)| (address, body)).collect();
    for address in addresses() {
        let (method, path) = (method_of(&address), path_of(&address));
        for part in parts(path) {
            // Each on a server of its own, for some of them change what is there.
            let (server, store) = server().await;
            store.add_thread("ash", None, comment()).await.unwrap();
            let ada = user("Ada", Role::Viewer, String::new());
            store.add_user(User { id: "a-user".into(), ..ada }).await.unwrap();
            let studio = Group { id: "a-group".into(), ..group("Studio", Role::Viewer) };
            store.add_group(studio).await.unwrap();
            for gift in [Gift::Tree("ash"), Gift::Collection("wood")] {
                store.give(gift, &Receiver::User("Ada".into()), Role::Viewer).await.unwrap();
            }
            let unknown = if NUMBERS.contains(&part) { "77" } else { "no-such-thing-there" };
            let query = if path.ends_with("/versions/import") { "?format=csv" } else { "" };
            let asked = filled_with(path, part, unknown) + query;
            let mut body = bodies.get(&*address).cloned().unwrap_or_default();
            if let Some(parent) = body.get_mut("parent") {
                *parent = json!("");
            }
            let answer = ask(&server, &method, &asked, &body, None).await;
            // A ticket says enough; nobody has the one that stands in the path.
            let named = if path.ends_with("{ticket}") { "ticket" } else { part };
            answer.assert(StatusCode::NOT_FOUND, named, &format!("{method} {asked}"));
        }
    }
}

#[tokio::test]
async fn what_is_not_there_is_named_by_the_field_of_the_body() {
    let (server, _) = server().await;
    let not_found = StatusCode::NOT_FOUND;
    for (address, body, status, field) in [
        ("POST /api/v1/sessions", json!({ "tree": "elm" }), not_found, "tree"),
        ("POST /api/v1/sessions", json!({ "tree": "ash", "version": 7 }), not_found, "version"),
        ("POST /api/v1/trees", json!({ "session": "yew", "name": "Yew" }), not_found, "session"),
        ("POST /api/v1/trees/ash/versions", json!({ "session": "yew" }), not_found, "session"),
        ("POST /api/v1/trees/ash/copies", json!({ "name": "Copy", "version": 7 }), not_found, "version"),
        ("PATCH /api/v1/trees/ash", json!({ "collection": "none" }), not_found, "collection"),
        ("POST /api/v1/collections", json!({ "name": "Woods", "parent": "none" }), not_found, "parent"),
        ("PATCH /api/v1/collections/wood", json!({ "parent": "none" }), not_found, "parent"),
        ("PATCH /api/v1/collections/wood", json!({ "parent": "wood" }), StatusCode::CONFLICT, "parent"),
    ] {
        let answer = ask(&server, &method_of(address), path_of(address), &body, None).await;
        answer.assert(status, field, address);
    }
    let change =
        ask(&server, &Method::PATCH, "/api/v1/trees/ash", &json!({ "note": "" }), Some("\"9\"")).await;
    change.assert(StatusCode::PRECONDITION_FAILED, "if-match", "an old revision");
}

#[tokio::test]
async fn lb2_what_has_no_revision_refuses_if_match() {
    let (server, _) = server().await;
    let change = json!({ "name": "Forest" });
    for (expected, status) in [(Some("\"9\""), StatusCode::BAD_REQUEST), (Some("*"), StatusCode::OK)] {
        let answer = ask(&server, &Method::PATCH, "/api/v1/collections/wood", &change, expected).await;
        if status == StatusCode::OK {
            assert_eq!(answer.status, status);
        } else {
            answer.assert(status, "if-match", "a collection");
        }
    }
}

#[tokio::test]
async fn the_address_of_a_socket_says_that_it_is_one() {
    let (server, _) = server().await;
    for socket in sockets() {
        let answer = ask(&server, &Method::GET, &filled(path_of(socket.address)), &Value::Null, None).await;
        answer.assert(StatusCode::BAD_REQUEST, "upgrade", socket.address);
    }
}
