//! Jobs are for whoever ordered them.

use super::*;

#[tokio::test]
async fn jb5_a_job_is_there_for_whoever_ordered_it() {
    let (server, store) = server().await;
    let [own, other] = [token(&store, Role::Editor, None).await, token(&store, Role::Owner, None).await];
    let order = request_of(&own, &Method::POST, "/api/v1/grow");
    let order = order.header(header::CONTENT_TYPE, "application/json");
    let body = r#"{"template":"oak","format":"mtg"}"#;
    let answer = server.clone().oneshot(order.body(Body::from(body)).unwrap()).await.unwrap();
    assert_eq!(answer.status(), StatusCode::ACCEPTED);
    let address = answer.headers()[header::LOCATION].to_str().unwrap();
    let file = format!("{address}/results/1");
    let by = |token: &str, method, path: &str| status(&server, request_of(token, &method, path), "");
    for path in [address, &file] {
        let named = reason(&server, request_of(&other, &Method::GET, path)).await;
        assert_eq!(named, (StatusCode::NOT_FOUND, Some("none-such".into())), "{path}");
    }
    assert_eq!(by(&other, Method::DELETE, address).await, StatusCode::NOT_FOUND);
    assert_eq!(by(&own, Method::GET, address).await, StatusCode::OK);
    assert_eq!(status(&server, request(&Method::GET, address), "").await, StatusCode::OK);
    assert_eq!(by(&own, Method::DELETE, address).await, StatusCode::NO_CONTENT);
    assert_eq!(by(&own, Method::GET, address).await, StatusCode::NOT_FOUND);
}
