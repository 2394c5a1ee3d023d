//! What a proxy says is believed from its address alone.

use serde_json::{Value, json};

use super::*;

/// A request that came over https to 192.168.1.50, as somebody at an address says.
fn passed_on(from: [u8; 4], method: &Method, path: &str) -> Builder {
    let request = Request::builder().method(method).uri(path).header(header::HOST, "localhost:7700");
    let request = request.extension(Peer(from.into())).header(header::CONTENT_TYPE, "application/json");
    let request = request.header("x-forwarded-for", "203.0.113.5");
    request.header("x-forwarded-proto", "https").header("x-forwarded-host", "192.168.1.50")
}

async fn send(server: &Router, asked: Builder, body: &str) -> axum::response::Response {
    server.clone().oneshot(asked.body(Body::from(body.to_owned())).unwrap()).await.unwrap()
}

async fn read(response: axum::response::Response) -> Value {
    let bytes = axum::body::to_bytes(response.into_body(), usize::MAX).await.unwrap();
    serde_json::from_slice(&bytes).unwrap_or_default()
}

#[tokio::test]
async fn ac14_only_a_trusted_proxy_says_who_asks_and_how() {
    let (server, store) = server().await;
    let owner = token(&store, Role::Owner, None).await;
    for (from, address, url, begins) in [
        (PROXY, "203.0.113.5", "https://192.168.1.50/pair#", "__Host-espalier="),
        ([10, 0, 0, 9], "10.0.0.9", "http://192.168.1.5:7700/pair#", "espalier-7700="),
    ] {
        let link =
            passed_on(from, &Method::POST, "/api/v1/trees/ash/links").header(header::AUTHORIZATION, &owner);
        let made = read(send(&server, link, r#"{"role":"viewer"}"#).await).await;
        let made = made["url"].as_str().unwrap();
        assert!(made.starts_with(url), "{made}");
        let secret = made.split('#').nth(1).unwrap();
        let redeem = passed_on(from, &Method::POST, "/api/v1/redeem");
        let come = send(&server, redeem, &json!({ "secret": secret }).to_string()).await;
        let cookie = come.headers()[header::SET_COOKIE].to_str().unwrap();
        assert!(cookie.starts_with(begins), "{cookie}");
        assert_eq!(cookie.contains("; Secure"), from == PROXY);
        let events = read(send(&server, request(&Method::GET, "/api/v1/audit"), "").await).await;
        assert_eq!((&events[0]["action"], &events[0]["address"]), (&json!("come-in"), &json!(address)));
    }
}

#[tokio::test]
async fn ac14_those_behind_a_proxy_are_counted_one_by_one() {
    let (server, _) = server().await;
    let guess = async |from: &'static str| {
        let asked = request(&Method::POST, "/api/v1/redeem").extension(Peer(PROXY.into()));
        let asked = asked.header("x-forwarded-for", from).header(header::CONTENT_TYPE, "application/json");
        send(&server, asked, r#"{"secret":"guess"}"#).await.status()
    };
    for _ in 0..5 {
        assert_eq!(guess("203.0.113.5").await, StatusCode::NOT_FOUND);
    }
    assert_eq!(guess("203.0.113.5").await, StatusCode::TOO_MANY_REQUESTS);
    assert_eq!(guess("198.51.100.1, 203.0.113.5").await, StatusCode::TOO_MANY_REQUESTS, "made up in front");
    assert_eq!(guess("203.0.113.6").await, StatusCode::NOT_FOUND);
}

#[tokio::test]
async fn ac14_whatever_is_passed_on_is_not_from_the_machine() {
    let (server, _) = server().await;
    for name in ["x-forwarded-for", "x-forwarded-proto", "x-forwarded-host"] {
        let asked = request(&Method::GET, "/api/v1/me").header(name, "localhost");
        assert_eq!(send(&server, asked, "").await.status(), StatusCode::UNAUTHORIZED, "{name}");
    }
}
