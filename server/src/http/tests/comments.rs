//! What people say of trees.

use base64::{Engine, prelude::BASE64_STANDARD};
use serde_json::{Value, json};

use super::*;
use crate::{
    memory::{Need, Use},
    store::{self, Comments},
};

const THREADS: &str = "/api/v1/trees/ash/threads";

async fn asked(server: &Router, who: &str, method: &Method, path: &str, body: &Value) -> (u16, Value) {
    let asked = request_of(who, method, path).header(header::CONTENT_TYPE, "application/json");
    let body = if body.is_null() { String::new() } else { body.to_string() };
    let answer = server.clone().oneshot(asked.body(Body::from(body)).unwrap()).await.unwrap();
    let status = answer.status().as_u16();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    (status, serde_json::from_slice(&bytes).unwrap_or_default())
}

fn png() -> String {
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(b"\x89PNG\r\n\x1a\n..."))
}

fn said(text: &str) -> Value {
    json!({ "comment": { "text": text, "author": "Ann" } })
}

#[tokio::test]
async fn ct1_threads_are_begun_answered_and_read() {
    let (server, store) = server().await;
    let ann = token(&store, Role::Commenter, None).await;
    let ben = token(&store, Role::Viewer, None).await;
    let camera = json!({ "target": [0, 5, 0], "yaw": 10, "pitch": 5, "distance": 30 });
    let bookmark = json!({ "camera": camera, "step": 4, "line": 0, "mode": "lit" });
    let sketch = json!([[[0.25, 0.5], [0.5, 0.75]]]);
    let comment = json!({
        "text": " too <b>thin</b>\nhere ", "author": "Ann", "mentions": [{ "name": "Ben" }],
        "bookmark": bookmark, "sketch": sketch, "picture": png(),
    });
    let (status, begun) = asked(&server, &ann, &Method::POST, THREADS, &json!({ "comment": comment })).await;
    assert_eq!(status, 201, "{begun}");
    assert_eq!((&begun["thread"], &begun["seen"]), (&json!(1), &json!(1)), "who wrote it has seen it");
    let first = &begun["comments"][0];
    assert_eq!((&first["text"], &first["own"]), (&json!("too <b>thin</b>\nhere"), &json!(true)));
    assert_eq!(
        (&first["bookmark"]["step"], &first["sketch"], &first["picture"]),
        (&json!(4), &sketch, &json!(true))
    );
    assert_eq!(asked(&server, &ben, &Method::POST, THREADS, &said("?")).await.0, 403, "viewers read alone");

    let list = asked(&server, &ben, &Method::GET, THREADS, &Value::Null).await.1;
    assert_eq!((&list[0]["seen"], &list[0]["comments"][0]["own"]), (&json!(0), &json!(false)));
    assert_eq!(list[0]["comments"][0]["mentions"], json!([{ "name": "Ben", "you": false }]));
    let own = format!("{THREADS}/1");
    let answer = json!({ "text": "thicker then", "author": "Cy" });
    let (status, answered) = asked(&server, &ann, &Method::POST, &format!("{own}/comments"), &answer).await;
    assert_eq!((status, answered["comments"].as_array().map(Vec::len)), (201, Some(2)));
    assert_eq!(asked(&server, &ann, &Method::POST, &format!("{THREADS}/9/comments"), &answer).await.0, 404);
    assert_eq!(
        asked(&server, &ben, &Method::PUT, &format!("{own}/seen"), &json!({ "comment": 1 })).await.0,
        204
    );
    assert_eq!(asked(&server, &ben, &Method::GET, &own, &Value::Null).await.1["seen"], 1);
    let picture = request_of(&ben, &Method::GET, &format!("{own}/comments/1/picture"));
    let answer = server.clone().oneshot(picture.body(Body::empty()).unwrap()).await.unwrap();
    assert_eq!(answer.headers()[header::CONTENT_TYPE], "image/png");
    assert_eq!(
        asked(&server, &ben, &Method::GET, &format!("{own}/comments/2/picture"), &Value::Null).await.0,
        404
    );
}

#[tokio::test]
async fn lm22_what_cannot_be_said_is_named() {
    let (server, store) = server().await;
    let ann = token(&store, Role::Editor, None).await;
    let ashen = json!({ "row": 999_999, "along": 0.5, "offset": [0, 0, 0], "place": [0, 1, 0] });
    let pin =
        |session: &str| json!({ "pin": { "session": session, "at": ashen }, "comment": { "text": "?" } });
    for (body, status, field) in [
        (said(""), 400, "comment.text"),
        (said(&"x".repeat(4001)), 400, "comment.text"),
        (said("\u{3164}"), 400, "comment.text"),
        (
            json!({ "comment": { "text": "a", "mentions": vec![json!({ "name": "Bo" }); 17] } }),
            400,
            "comment.mentions",
        ),
        (json!({ "comment": { "text": "a", "sketch": [[[1.5, 0]]] } }), 400, "comment.sketch[0][0][0]"),
        (json!({ "comment": { "text": "a", "picture": "data:text/html;base64,AA" } }), 400, "picture"),
        (json!({ "comment": { "text": "a" }, "colour": 1 }), 400, "colour"),
        (pin("oak"), 404, "pin.session"),
        (pin("nobody"), 404, "pin.session"),
        (pin("ashen"), 404, "pin.at.row"),
    ] {
        let (found, problem) = asked(&server, &ann, &Method::POST, THREADS, &body).await;
        assert_eq!((found, problem["field"].as_str()), (status, Some(field)), "{body} {problem}");
    }
    assert_eq!(asked(&server, &ann, &Method::GET, THREADS, &Value::Null).await.1, json!([]));
}

#[tokio::test]
async fn ct4_threads_are_resolved_and_taken_up_again() {
    let (server, store) = server().await;
    let ann = token(&store, Role::Commenter, None).await;
    asked(&server, &ann, &Method::POST, THREADS, &said("done?")).await;
    let own = format!("{THREADS}/1");
    let resolve = async |resolved: bool| {
        asked(&server, &ann, &Method::PATCH, &own, &json!({ "resolved": resolved })).await
    };
    let (status, thread) = resolve(true).await;
    assert_eq!((status, &thread["resolved"]["by"]), (200, &json!("script")));
    assert_eq!(resolve(false).await.1["resolved"], Value::Null);
}

#[tokio::test]
async fn ct5_one_changes_and_deletes_what_one_wrote_and_owners_delete_all() {
    let (server, store) = server().await;
    let [ann, ben] = [token(&store, Role::Commenter, None).await, token(&store, Role::Editor, None).await];
    let owner = token(&store, Role::Owner, None).await;
    asked(&server, &ann, &Method::POST, THREADS, &said("one")).await;
    let own = format!("{THREADS}/1/comments/1");
    let other = json!({ "text": "ONE" });
    assert_eq!(asked(&server, &ben, &Method::PATCH, &own, &other).await.0, 403);
    assert_eq!(asked(&server, &ben, &Method::DELETE, &own, &Value::Null).await.0, 403);
    let (status, thread) = asked(&server, &ann, &Method::PATCH, &own, &other).await;
    assert_eq!((status, &thread["comments"][0]["text"]), (200, &json!("ONE")));
    assert!(thread["comments"][0]["edited_at"].is_string());
    let old = store::NewComment {
        person: Caller::local().person(),
        author: "Ann".into(),
        written_at: "2026-01-01T00:00:00.000Z".into(),
        said: json!({ "text": "old" }).to_string(),
        picture: None,
    };
    store.add_comment("ash", 1, old).await.unwrap();
    let body = Body::from(json!({ "text": "new" }).to_string());
    let late = request(&Method::PATCH, &format!("{THREADS}/1/comments/2"));
    let late = late.header(header::CONTENT_TYPE, "application/json").body(body).unwrap();
    assert_eq!(server.clone().oneshot(late).await.unwrap().status(), StatusCode::CONFLICT);
    assert_eq!(asked(&server, &owner, &Method::DELETE, &own, &Value::Null).await.0, 204);
    assert_eq!(asked(&server, &ann, &Method::DELETE, &own, &Value::Null).await.0, 404);
}

#[tokio::test]
async fn ct6_the_summary_is_one_page_that_runs_nothing() {
    let (server, store) = server().await;
    let ann = token(&store, Role::Commenter, None).await;
    let evil = "<script>alert(1)</script>";
    let body = json!({ "comment": { "text": evil, "author": evil, "picture": png() } });
    assert_eq!(asked(&server, &ann, &Method::POST, THREADS, &body).await.0, 201);
    let viewer = token(&store, Role::Viewer, Some("ash")).await;
    let page = request_of(&viewer, &Method::GET, "/api/v1/trees/ash/review.html?language=de");
    let answer = server.clone().oneshot(page.body(Body::empty()).unwrap()).await.unwrap();
    let policy = answer.headers()[header::CONTENT_SECURITY_POLICY].to_str().unwrap().to_owned();
    assert!(
        policy.starts_with("default-src 'none'; img-src data:;") && !policy.contains("script"),
        "{policy}"
    );
    assert_eq!(answer.headers()[header::CONTENT_TYPE], "text/html; charset=utf-8");
    assert_eq!(answer.headers()[header::X_CONTENT_TYPE_OPTIONS], "nosniff");
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    let html = String::from_utf8(bytes.to_vec()).unwrap();
    assert!(html.contains("&lt;script&gt;alert(1)") && !html.contains("<script"), "{html}");
    assert!(html.contains("data:image/png;base64,") && html.contains("Kommentare zu"), "{html}");
}

#[tokio::test]
async fn lm19_much_that_is_said_is_shown_where_there_is_memory_for_it() {
    let shared = shared().await;
    let server = router(shared.clone());
    let ann = token(&shared.store, Role::Commenter, None).await;
    let text = |letters: usize| json!({ "text": "x".repeat(letters) }).to_string();
    let said =
        |letters| store::NewComment { author: "Ann".into(), said: text(letters), ..Default::default() };
    shared.store.add_thread("ash", None, said(2 << 20)).await.unwrap();
    shared.store.add_thread("yew", None, said(1000)).await.unwrap();
    let left = shared.memory.look().left();
    let all = shared.memory.take(Use::Job, Need::Other, left).unwrap();
    let review = "/api/v1/trees/ash/review.html";
    for path in [THREADS, review] {
        let (status, problem) = asked(&server, &ann, &Method::GET, path, &Value::Null).await;
        assert_eq!((status, &problem["reason"]), (503, &json!("memory-full")), "{path}");
    }
    let little = asked(&server, &ann, &Method::GET, "/api/v1/trees/yew/threads", &Value::Null).await;
    assert_eq!(little.0, 200);
    drop(all);
    for path in [THREADS, review] {
        let request = request_of(&ann, &Method::GET, path).body(Body::empty()).unwrap();
        let answer = server.clone().oneshot(request).await.unwrap();
        assert_eq!(answer.status(), StatusCode::OK, "{path}");
        assert!(shared.memory.look().taken_for(Use::Export) >= 4 << 20, "until it is sent: {path}");
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        assert!(bytes.len() > 2 << 20);
        drop(bytes);
        assert_eq!(shared.memory.look().taken_for(Use::Export), 0, "{path}");
    }
}
