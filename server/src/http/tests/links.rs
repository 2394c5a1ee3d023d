//! Links for one tree.

use serde_json::{Value, json};

use super::*;

const LINKS: &str = "/api/v1/trees/ash/links";

async fn asked(server: &Router, asked: Builder, body: &str) -> (u16, Value) {
    let asked = asked.header(header::CONTENT_TYPE, "application/json");
    let answer = server.clone().oneshot(asked.body(Body::from(body.to_owned())).unwrap()).await.unwrap();
    let status = answer.status().as_u16();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    (status, serde_json::from_slice(&bytes).unwrap_or_default())
}

/// A cookie of whoever comes by a link, as a header.
async fn come(server: &Router, url: &str) -> Option<String> {
    let (_, secret) = url.split_once("/pair#").unwrap();
    let body = json!({ "secret": secret }).to_string();
    let asked = request(&Method::POST, "/api/v1/redeem").extension(Peer([192, 168, 1, 9].into()));
    let asked = asked.header(header::CONTENT_TYPE, "application/json").body(Body::from(body)).unwrap();
    let answer = server.clone().oneshot(asked).await.unwrap();
    let set = answer.headers().get(header::SET_COOKIE)?.to_str().unwrap().to_owned();
    set.split(';').next().map(str::to_owned)
}

/// What somebody with a cookie is answered from afar.
async fn by(server: &Router, cookie: &str, method: &Method, path: &str) -> (u16, Value) {
    let from_afar = request(method, path).extension(Peer([192, 168, 1, 9].into()));
    asked(server, from_afar.header(header::COOKIE, cookie), "{}").await
}

#[tokio::test]
async fn ac12_owners_invite_to_a_tree_and_take_that_back() {
    let (server, store) = server().await;
    let owner = token(&store, Role::Owner, None).await;
    let of_owner = |method: &Method, path: &str| request_of(&owner, method, path);
    let body = r#"{"role":"editor","hours":1,"name":"Bo"}"#;
    let (status, made) = asked(&server, of_owner(&Method::POST, LINKS), body).await;
    assert_eq!(status, 201, "{made}");
    let (id, url) = (made["id"].as_str().unwrap(), made["url"].as_str().unwrap());
    assert!(url.starts_with(&format!("{AT}/pair#")), "{url}");

    let list = async || asked(&server, of_owner(&Method::GET, LINKS), "").await.1;
    let waiting = list().await;
    assert_eq!(
        [&waiting[0]["id"], &waiting[0]["name"], &waiting[0]["role"], &waiting[0]["used"]],
        [&json!(id), &json!("Bo"), &json!("editor"), &json!(false)]
    );
    assert!(!waiting.to_string().contains(url.split('#').nth(1).unwrap()), "the secret is shown once");
    let cookie = come(&server, url).await.expect("the link lets in");
    assert_eq!(come(&server, url).await, None, "one device");
    let me = by(&server, &cookie, &Method::GET, "/api/v1/me").await.1;
    assert_eq!((&me["role"], &me["tree"]), (&json!("editor"), &json!("ash")));
    let used = list().await;
    assert_eq!((&used[0]["id"], &used[0]["used"]), (&json!(id), &json!(true)));
    assert_eq!(used[0]["until"], waiting[0]["until"], "the hour is that of the link");

    let own = format!("{LINKS}/{id}");
    let elsewhere = format!("/api/v1/trees/yew/links/{id}");
    assert_eq!(asked(&server, of_owner(&Method::DELETE, &elsewhere), "").await.0, 404);
    assert_eq!(by(&server, &cookie, &Method::DELETE, &own).await.0, 403, "editors invite nobody");
    assert_eq!(asked(&server, of_owner(&Method::DELETE, &own), "").await.0, 204);
    assert_eq!(by(&server, &cookie, &Method::GET, "/api/v1/me").await.0, 401);
    assert_eq!(list().await, json!([]));

    let events = asked(&server, request(&Method::GET, "/api/v1/audit"), "").await.1;
    let noted = events.as_array().unwrap();
    let events: Vec<_> = noted.iter().map(|event| event["action"].clone()).collect();
    assert_eq!(events, ["unlink", "unlink", "unlink", "come-in", "come-in", "link"]);
    for event in [&noted[0], &noted[4], &noted[5]] {
        assert_eq!(event["object"], format!("ash/{id}"), "{event}");
    }
}

#[tokio::test]
async fn ac12_who_was_invited_may_do_more_or_less_from_then_on() {
    let (server, store) = server().await;
    let owner = token(&store, Role::Owner, None).await;
    let of_owner = |method: &Method, path: &str| request_of(&owner, method, path);
    let (_, made) = asked(&server, of_owner(&Method::POST, LINKS), r#"{"role":"editor"}"#).await;
    let own = format!("{LINKS}/{}", made["id"].as_str().unwrap());
    let change = async |role: &str| {
        asked(&server, of_owner(&Method::PATCH, &own), &json!({ "role": role }).to_string()).await
    };
    let (status, link) = change("viewer").await;
    assert_eq!((status, &link["role"], &link["used"]), (200, &json!("viewer"), &json!(false)));
    let cookie = come(&server, made["url"].as_str().unwrap()).await.expect("the link lets in");
    let role = async || by(&server, &cookie, &Method::GET, "/api/v1/me").await.1["role"].clone();
    assert_eq!(role().await, "viewer", "as it was when they came");
    for more in ["commenter", "editor"] {
        assert_eq!(change(more).await.0, 200);
        assert_eq!(role().await, more);
    }
    assert_eq!(change("owner").await.1["field"], "role");
    assert_eq!(by(&server, &cookie, &Method::PATCH, &own).await.0, 403, "editors do not say who may what");
    let elsewhere = own.replace("/ash/", "/yew/");
    assert_eq!(asked(&server, of_owner(&Method::PATCH, &elsewhere), r#"{"role":"viewer"}"#).await.0, 404);
    let events = asked(&server, request(&Method::GET, "/api/v1/audit"), "").await.1;
    assert!(events.as_array().unwrap().iter().any(|event| event["action"] == "link-role"), "{events}");
}

#[tokio::test]
async fn ac12_a_link_is_for_viewers_commenters_or_editors_from_an_hour_to_a_year() {
    let (server, _) = server().await;
    let add = async |body: &str| asked(&server, request(&Method::POST, LINKS), body).await;
    for body in [r#"{"role":"viewer"}"#, r#"{"role":"commenter","hours":8760}"#] {
        assert_eq!(add(body).await.0, 201, "{body}");
    }
    for (body, field) in [
        (r#"{"role":"owner"}"#, "role"),
        (r#"{"role":"viewer","hours":0}"#, "hours"),
        (r#"{"role":"viewer","hours":8761}"#, "hours"),
        (r#"{"role":"viewer","name":""}"#, "name"),
    ] {
        let (status, problem) = add(body).await;
        assert_eq!((status, problem["field"].as_str()), (400, Some(field)), "{body}");
    }
    for _ in 2..100 {
        assert_eq!(add(r#"{"role":"viewer"}"#).await.0, 201);
    }
    assert_eq!(add(r#"{"role":"viewer"}"#).await.1["reason"], "too-many");
    let gone = asked(&server, request(&Method::DELETE, "/api/v1/trees/ash"), "").await;
    assert_eq!(gone.0, 204);
    assert_eq!(add(r#"{"role":"viewer"}"#).await.0, 404);
}

#[tokio::test]
async fn ik3_a_link_is_shown_once_also_to_whoever_has_its_key() {
    let (server, _) = server().await;
    let add = async || {
        let keyed = request(&Method::POST, LINKS).header("idempotency-key", "one");
        asked(&server, keyed, r#"{"role":"viewer"}"#).await
    };
    assert_eq!(add().await.0, 201);
    let (status, problem) = add().await;
    assert_eq!((status, &problem["reason"]), (409, &json!("answer-not-kept")));
    let links = asked(&server, request(&Method::GET, LINKS), "").await.1;
    assert_eq!(links.as_array().unwrap().len(), 1);
}

#[tokio::test]
async fn ac16_a_locked_tree_is_changed_by_owners_alone() {
    let (server, store) = server().await;
    let [owner, editor] = [token(&store, Role::Owner, None).await, token(&store, Role::Editor, None).await];
    let lock = "/api/v1/trees/ash/lock";
    let of = |who: &str, method: &Method, path: &str| request_of(who, method, path);
    assert_eq!(asked(&server, of(&editor, &Method::PUT, lock), "").await.0, 403, "editors lock nothing");
    assert_eq!(asked(&server, of(&editor, &Method::GET, lock), "").await, (200, json!({})));
    assert_eq!(asked(&server, of(&owner, &Method::PUT, lock), "").await, (200, json!({ "by": "script" })));
    let body = r#"{"name":"Ash"}"#;
    let change = async |who: &str, tree: &str| {
        asked(&server, of(who, &Method::PATCH, &format!("/api/v1/trees/{tree}")), body).await
    };
    let (status, problem) = change(&editor, "ash").await;
    assert_eq!((status, &problem["reason"]), (403, &json!("tree-locked")));
    assert_eq!(change(&editor, "yew").await.0, 200, "another tree");
    assert_eq!(change(&owner, "ash").await.0, 200);
    let comment = r#"{"comment":{"text":"why?"}}"#;
    let threads = "/api/v1/trees/ash/threads";
    assert_eq!(asked(&server, of(&editor, &Method::POST, threads), comment).await.0, 201, "they comment");
    let upload = of(&editor, &Method::POST, "/api/v1/sessions/ashen/obstacles");
    assert_eq!(asked(&server, upload, "").await.1["reason"], "tree-locked", "nor its session");
    assert_eq!(asked(&server, of(&owner, &Method::DELETE, lock), "").await, (200, json!({})));
    assert_eq!(change(&editor, "ash").await.0, 200);
    assert_eq!(asked(&server, of(&owner, &Method::PUT, "/api/v1/trees/elm/lock"), "").await.0, 404);
}

#[tokio::test]
async fn lb6_a_deleted_tree_is_closed_to_links_and_gifts_until_it_is_taken_back() {
    let (server, store) = server().await;
    let owner = token(&store, Role::Owner, None).await;
    let link = async || {
        let made = asked(&server, request_of(&owner, &Method::POST, LINKS), r#"{"role":"editor"}"#).await.1;
        made["url"].as_str().unwrap().to_owned()
    };
    let (used, waiting) = (link().await, link().await);
    let cookie = come(&server, &used).await.expect("the link lets in");
    let viewer = token(&store, Role::Viewer, None).await;
    let [document, file] = ["document", "tree.mtg"].map(|of| format!("/api/v1/trees/ash/versions/1/{of}"));
    let seen = "/api/v1/trees/ash/versions";
    let session = "/api/v1/sessions/ashen";
    let found = async |method: &Method, path: &str| by(&server, &cookie, method, path).await.0;
    assert_eq!(found(&Method::GET, session).await, 200);
    // What is kept here is no plant: it is damaged, not missing.
    assert_eq!((found(&Method::GET, &document).await, found(&Method::GET, &file).await), (409, 409));

    let delete = request_of(&owner, &Method::DELETE, "/api/v1/trees/ash");
    assert_eq!(asked(&server, delete, "").await.0, 204);
    for path in [&*document, &file] {
        let (status, problem) = by(&server, &cookie, &Method::GET, path).await;
        assert_eq!((status, &problem["reason"]), (404, &json!("no-tree")), "{path}");
        let (status, _) = asked(&server, request_of(&owner, &Method::GET, path), "").await;
        assert_eq!(status, 404, "to nobody: {path}");
    }
    assert_eq!(found(&Method::GET, seen).await, 200, "its versions can be seen");
    assert_eq!(found(&Method::GET, session).await, 404);
    let read = asked(&server, request_of(&viewer, &Method::GET, session), "").await.0;
    assert_eq!(read, 200, "whoever has a role on the server keeps that");
    assert_eq!(come(&server, &waiting).await, None);

    let back = request_of(&owner, &Method::POST, "/api/v1/trees/ash/undelete");
    assert_eq!(asked(&server, back, "").await.0, 200);
    for (path, status) in [(&*document, 409), (&file, 409), (session, 200)] {
        assert_eq!(found(&Method::GET, path).await, status, "{path}");
    }
    assert!(come(&server, &waiting).await.is_some(), "the link waited");
}
