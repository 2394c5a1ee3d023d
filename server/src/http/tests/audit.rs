//! What was done is listed for administrators.

use serde_json::{Value, json};

use super::*;

async fn events(server: &Router, query: &str) -> Vec<Value> {
    let asked = request(&Method::GET, &format!("/api/v1/audit{query}")).body(Body::empty()).unwrap();
    let answer = server.clone().oneshot(asked).await.unwrap();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

#[tokio::test]
async fn ac10_what_was_done_and_refused_is_listed_with_by_whom() {
    let (server, store) = server().await;
    let editor = token(&store, Role::Editor, None).await;
    let refused = request_of(&editor, &Method::DELETE, "/api/v1/trees/ash");
    assert_eq!(status(&server, refused, "").await, StatusCode::FORBIDDEN);
    let delete = request(&Method::DELETE, "/api/v1/trees/ash");
    assert_eq!(status(&server, delete, "").await, StatusCode::NO_CONTENT);
    let guess = request(&Method::POST, "/api/v1/login").extension(Peer([192, 168, 1, 9].into()));
    let body = r#"{"name":"Ada","password":"guess"}"#;
    assert_eq!(status(&server, guess, body).await, StatusCode::UNAUTHORIZED);
    let listed: Vec<Value> = events(&server, "")
        .await
        .into_iter()
        .map(|event| {
            json!([event["who"], event["address"], event["action"], event["object"], event["outcome"]])
        })
        .collect();
    let expected = [
        json!(["login Ada", "192.168.1.9", "log-in", null, "401"]),
        json!(["machine", "127.0.0.1", "delete", "ash", "done"]),
        json!(["token script", "127.0.0.1", "delete", "ash", "403"]),
    ];
    assert_eq!(listed, expected);
    for _ in 0..3 {
        let again = request_of(&editor, &Method::DELETE, "/api/v1/trees/ash");
        assert_eq!(status(&server, again, "").await, StatusCode::FORBIDDEN);
    }
    let counted = &events(&server, "").await[2];
    assert_eq!((&counted["times"], counted["last_at"].is_string()), (&json!(4), true));
    let all = events(&server, "?limit=1").await;
    assert_eq!(all.len(), 1);
    assert_eq!(
        events(&server, &format!("?limit=1&before={}", all[0]["number"])).await[0]["action"],
        "delete"
    );
}
