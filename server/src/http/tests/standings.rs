//! People who are kept out of one tree, and those to whom one was handed over.

use serde_json::{Value, json};

use super::*;
use crate::store::{Heir, Removal, Room, Standings};

async fn asked(server: &Router, asked: Builder, body: &str) -> (u16, Value) {
    let asked = asked.header(header::CONTENT_TYPE, "application/json");
    let answer = server.clone().oneshot(asked.body(Body::from(body.to_owned())).unwrap()).await.unwrap();
    let status = answer.status().as_u16();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    (status, serde_json::from_slice(&bytes).unwrap_or_default())
}

/// Whoever has a token, as the server knows them.
async fn person_of(store: &AnyStore, token: &str) -> String {
    let mut headers = axum::http::HeaderMap::new();
    headers.insert(header::AUTHORIZATION, token.parse().unwrap());
    Caller::of(&headers, None, false, store).await.unwrap().person()
}

async fn keep_out(store: &AnyStore, token: &str, room: Room<'_>, is_revoked: bool) {
    let removal = Removal {
        id: "a-removal".into(),
        room: room.written(),
        person: person_of(store, token).await,
        name: "Bo".into(),
        by: "Ann".into(),
        until: "9".into(),
        is_revoked,
    };
    store.keep_out(removal, "2026").await.unwrap();
}

#[tokio::test]
async fn ac17_who_was_removed_gets_nothing_of_the_tree_until_they_are_let_back() {
    let (server, store) = server().await;
    let [owner, bo, cy] = [
        token(&store, Role::Owner, None).await,
        token(&store, Role::Editor, None).await,
        token(&store, Role::Editor, None).await,
    ];
    keep_out(&store, &bo, Room::Tree("ash"), false).await;
    let get = async |who: &str, path: &str| asked(&server, request_of(who, &Method::GET, path), "").await;
    for path in ["/api/v1/trees/ash", "/api/v1/trees/ash/threads", "/api/v1/sessions/ashen"] {
        let (status, problem) = get(&bo, path).await;
        assert_eq!((status, &problem["reason"], &problem["cause"]), (403, &json!("removed"), &json!("Ann")));
        assert_eq!(get(&cy, path).await.0, 200, "others stay: {path}");
    }
    let begun = asked(&server, request_of(&bo, &Method::POST, "/api/v1/sessions"), r#"{"tree":"ash"}"#).await;
    assert_eq!((begun.0, &begun.1["reason"]), (403, &json!("removed")), "nor another session of it");
    for path in ["/api/v1/trees/yew", "/api/v1/sessions/oak", "/api/v1/me"] {
        assert_eq!(get(&bo, path).await.0, 200, "they stay who they are elsewhere: {path}");
    }

    let removals = "/api/v1/sessions/ashen/removals";
    assert_eq!(get(&cy, removals).await.0, 403, "owners see who was removed");
    let (status, list) = get(&owner, removals).await;
    let expected = json!([{ "id": "a-removal", "name": "Bo", "by": "Ann", "until": "9" }]);
    assert_eq!((status, list), (200, expected));
    let back = |session: &str| format!("/api/v1/sessions/{session}/removals/a-removal");
    let delete =
        async |who: &str, path: &str| asked(&server, request_of(who, &Method::DELETE, path), "").await;
    assert_eq!(delete(&cy, &back("ashen")).await.0, 403);
    assert_eq!(delete(&owner, &back("oak")).await.0, 404, "it is of another session");
    assert_eq!(delete(&owner, &back("ashen")).await.0, 204);
    assert_eq!(delete(&owner, &back("ashen")).await.0, 404);
    assert_eq!(get(&bo, "/api/v1/trees/ash").await.0, 200);
    let events = asked(&server, request(&Method::GET, "/api/v1/audit"), "").await.1;
    assert_eq!(events[0]["action"], "let-back", "{events}");
}

#[tokio::test]
async fn ac17_of_a_session_of_no_tree_as_well_and_never_an_owner() {
    let (server, store) = server().await;
    let bo = token(&store, Role::Editor, None).await;
    keep_out(&store, &bo, Room::Session("oak"), true).await;
    let get = async |who: &str, path: &str| asked(&server, request_of(who, &Method::GET, path), "").await;
    let (status, problem) = get(&bo, "/api/v1/sessions/oak").await;
    assert_eq!((status, &problem["reason"]), (403, &json!("removed-guest")));
    assert_eq!(get(&bo, "/api/v1/sessions/ashen").await.0, 200);
    let owner = token(&store, Role::Owner, None).await;
    keep_out(&store, &owner, Room::Tree("ash"), false).await;
    assert_eq!(get(&owner, "/api/v1/trees/ash").await.0, 200);
    assert_eq!(get(&owner, "/api/v1/sessions/oak/removals").await.1, json!([]), "a revoked link stays so");
    // Nobody is in these sessions.
    let remove = request_of(&owner, &Method::DELETE, "/api/v1/sessions/oak/people/1");
    let (status, problem) = asked(&server, remove, "").await;
    assert_eq!((status, problem["field"].as_str()), (404, Some("person")));
}

#[tokio::test]
async fn ac18_to_whom_a_tree_was_handed_over_owns_it_and_no_other() {
    let (server, store) = server().await;
    for (bo, where_else) in [
        (token(&store, Role::Viewer, None).await, 403),
        (token(&store, Role::Commenter, Some("ash")).await, 403),
    ] {
        let ask = async |method: &Method, path: &str, body: &str| {
            asked(&server, request_of(&bo, method, path), body).await.0
        };
        let [put, post] = [&Method::PUT, &Method::POST];
        assert_eq!(ask(put, "/api/v1/trees/ash/lock", "").await, 403);
        let heir = Heir { person: person_of(&store, &bo).await, name: "Bo".into() };
        assert!(store.hand_over("ash", Some(heir), None).await.unwrap());
        assert_eq!(ask(put, "/api/v1/trees/ash/lock", "").await, 200);
        let named = ask(&Method::PATCH, "/api/v1/trees/ash", r#"{"name":"Ash"}"#).await;
        assert_eq!(named, 200, "the lock of their own tree shuts them not out");
        assert_eq!(ask(post, "/api/v1/trees/ash/links", r#"{"role":"viewer"}"#).await, 201);
        assert_eq!(ask(&Method::GET, "/api/v1/sessions/ashen/removals", "").await, 200);
        assert_eq!(ask(put, "/api/v1/trees/yew/lock", "").await, where_else);
        assert_eq!(ask(&Method::GET, "/api/v1/status", "").await, 403, "nor the server");
        assert_eq!(ask(post, "/api/v1/collections", r#"{"name":"Wood"}"#).await, 403);
        // They delete it, and take that back; that it cannot be taken back is for owners of the server.
        let delete = &Method::DELETE;
        assert_eq!(ask(delete, "/api/v1/trees/ash", "").await, 204);
        let for_good = request_of(&bo, delete, "/api/v1/trees/ash/for-good");
        let (status, problem) = asked(&server, for_good, "").await;
        assert_eq!((status, &problem["reason"]), (403, &json!("forbidden")), "{problem}");
        assert_eq!(ask(post, "/api/v1/trees/ash/undelete", "").await, 200);
        let owner = "/api/v1/sessions/ashen/owner";
        let found = asked(&server, request_of(&bo, &Method::GET, owner), "").await;
        assert_eq!(found, (200, json!({ "name": "Bo" })));
        // Who owns it may give that up.
        assert_eq!(ask(&Method::DELETE, owner, "").await, 200);
        assert_eq!(ask(&Method::DELETE, "/api/v1/trees/ash/lock", "").await, 403);
        let unlock = request(&Method::DELETE, "/api/v1/trees/ash/lock");
        assert_eq!(asked(&server, unlock, "").await.0, 200);
    }
}

#[tokio::test]
async fn ac18_a_tree_is_handed_over_to_somebody_in_its_session() {
    let (server, store) = server().await;
    let owner = token(&store, Role::Owner, None).await;
    let hand = async |session: &str, body: &str| {
        let path = format!("/api/v1/sessions/{session}/owner");
        asked(&server, request_of(&owner, &Method::PUT, &path), body).await
    };
    for (session, body, status, field) in [
        ("ashen", r#"{"person":7}"#, 404, "person"),
        ("ashen", r#"{"person":"Bo"}"#, 400, "person"),
        ("oak", r#"{"person":7}"#, 404, "session"),
        ("gone", r#"{"person":7}"#, 404, "session"),
    ] {
        let (found, problem) = hand(session, body).await;
        assert_eq!((found, problem["field"].as_str()), (status, Some(field)), "{session} {body}: {problem}");
    }
}
