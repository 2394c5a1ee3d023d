//! Grammars over HTTP (`GR6` to `GR8`).

use espalier_session::{Principal, grammar_script};

use super::*;
use crate::access::Caller;

const TEXT: &str = "axiom: A\nA --> F[+(30)B]A\nB --> F\n";

async fn asked(server: &Router, method: Method, path: &str, body: Value) -> (StatusCode, Value) {
    let request = request(&method, path).header(header::CONTENT_TYPE, "application/json");
    let answer = server.clone().oneshot(request.body(Body::from(body.to_string())).unwrap()).await.unwrap();
    let (head, body) = answer.into_parts();
    let body = axum::body::to_bytes(body, usize::MAX).await.unwrap();
    (head.status, serde_json::from_slice(&body).unwrap_or_default())
}

#[tokio::test]
async fn gr6_a_text_is_checked_over_http() {
    let (server, _) = server().await;
    let check = async |body| asked(&server, Method::POST, "/api/v1/grammars/check", body).await;
    let (status, report) = check(json!({ "text": "axiom: A\nA --> F[+A\n" })).await;
    assert_eq!(status, StatusCode::OK, "what is wrong is what was asked for");
    assert_eq!(report["diagnostics"][0]["line"], 2);
    assert_eq!(report["diagnostics"][0]["severity"], "error");
    let (status, report) = check(json!({ "text": TEXT, "sizes": true })).await;
    assert_eq!((status, report["diagnostics"].as_array().map(Vec::len)), (StatusCode::OK, Some(0)));
    assert_eq!(report["sizes"][3]["internodes"], 5);
    let (status, problem) = check(json!({ "text": TEXT, "values": [{ "name": "a", "value": 1 }] })).await;
    assert_eq!((status, &problem["field"]), (StatusCode::BAD_REQUEST, &json!("values")));
}

#[tokio::test]
async fn gr7_grammars_are_listed_with_their_pictures() {
    let (server, _) = server().await;
    let (status, all) = asked(&server, Method::GET, "/api/v1/grammars", Value::Null).await;
    let all = all.as_array().cloned().unwrap_or_default();
    assert_eq!((status, all.len()), (StatusCode::OK, espalier_grammar::SHIPPED.len()));
    for listed in &all {
        let body = json!({ "text": listed["text"] });
        let (_, report) = asked(&server, Method::POST, "/api/v1/grammars/check", body).await;
        assert_eq!(report["sliders"], listed["sliders"], "{}", listed["name"]);
    }
    let picture = request(&Method::GET, all[0]["picture"].as_str().unwrap());
    let answer = server.clone().oneshot(picture.body(Body::empty()).unwrap()).await.unwrap();
    assert_eq!(answer.headers()[header::CONTENT_TYPE], "image/png");
    let none = "/api/v1/grammars/none/picture";
    assert_eq!(asked(&server, Method::GET, none, Value::Null).await.0, StatusCode::NOT_FOUND);
}

#[tokio::test]
async fn gr8_rules_of_a_session_are_told_row_by_row() {
    let shared = shared().await;
    let server = router(shared.clone());
    let path = "/api/v1/sessions/oak/grammar";
    let (status, problem) = asked(&server, Method::GET, path, Value::Null).await;
    assert_eq!((status, &problem["reason"]), (StatusCode::NOT_FOUND, &json!("no-grammar")));
    let session = sessions::open(&shared, "oak").await.unwrap();
    let action = grammar_script(TEXT, Some(espalier_proto::Steps::nearest(3))).unwrap();
    session.act(Principal::visitor(), Caller::local().entrant(), action.into()).await.unwrap().unwrap();
    let (status, origins) = asked(&server, Method::GET, path, Value::Null).await;
    assert_eq!(status, StatusCode::OK);
    assert_eq!(origins["rows"].as_array().map(Vec::len), Some(5));
    let lines = origins["rules"].as_array().unwrap().iter().map(|rule| rule["line"].as_u64().unwrap());
    assert_eq!(lines.collect::<Vec<_>>(), [1, 2, 3]);
}
