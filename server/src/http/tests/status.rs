//! Seeing inside (`SV`).

use espalier_proto::{Reason, status::ServerStatus};

use super::*;
use crate::memory::{Need, Use};

async fn asked(server: &Router, request: Builder) -> (StatusCode, String) {
    let response = server.clone().oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
    let status = response.status();
    let bytes = axum::body::to_bytes(response.into_body(), usize::MAX).await.unwrap();
    (status, String::from_utf8(bytes.to_vec()).unwrap())
}

#[tokio::test]
async fn sv1_a_server_lives_where_it_is_not_ready() {
    let shared = shared().await;
    let server = router(shared.clone());
    let get = |path| asked(&server, request(&Method::GET, path));
    for path in ["/live", "/ready", "/health"] {
        assert_eq!(get(path).await.0, StatusCode::OK, "{path}");
    }
    let left = shared.memory.look().left();
    let all = shared.memory.take(Use::Job, Need::Other, left).unwrap();
    let (status, problem) = get("/ready").await;
    assert_eq!(status, StatusCode::SERVICE_UNAVAILABLE);
    let problem: espalier_proto::HttpProblem = serde_json::from_str(&problem).unwrap();
    assert_eq!(problem.reason, Reason::MemoryFull);
    for path in ["/live", "/health"] {
        assert_eq!(get(path).await.0, StatusCode::OK, "{path}");
    }
    drop(all);
    assert_eq!(get("/ready").await.0, StatusCode::OK);
}

#[tokio::test]
async fn sv2_figures_name_nobody_and_owners_see_sessions() {
    let shared = shared().await;
    let server = router(shared.clone());
    shared.sessions.open("oak").await.unwrap().unwrap();
    let [viewer, editor, owner] = [Role::Viewer, Role::Editor, Role::Owner];
    for (role, path, expected) in [
        (viewer, "/metrics", StatusCode::OK),
        (editor, "/api/v1/status", StatusCode::FORBIDDEN),
        (owner, "/api/v1/status", StatusCode::OK),
    ] {
        let token = token(&shared.store, role, None).await;
        assert_eq!(asked(&server, request_of(&token, &Method::GET, path)).await.0, expected, "{path}");
    }
    let (_, text) = asked(&server, request(&Method::GET, "/metrics")).await;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let (name, value) = line.rsplit_once(' ').unwrap();
        assert!(value.parse::<f64>().is_ok() && !name.contains("oak"), "{line}");
    }
    for name in [
        "espalier_sessions 1",
        "espalier_slices_total{class=\"drawing\"} ",
        "espalier_memory_taken_bytes{for=\"sessions\"} ",
        "espalier_requests_total{status=\"4xx\"} 1",
        "espalier_commits_total ",
        "espalier_windows_bytes 0",
    ] {
        assert!(text.contains(name), "{name} in {text}");
    }
    let (_, status) = asked(&server, request(&Method::GET, "/api/v1/status")).await;
    let status: ServerStatus = serde_json::from_str(&status).unwrap();
    assert_eq!(status.sessions.iter().map(|session| &*session.name).collect::<Vec<_>>(), ["oak"]);
    assert!(status.sessions[0].answers && status.sessions[0].memory_bytes > 0);
    assert_eq!(status.used.iter().map(|used| used.bytes).sum::<u64>(), status.taken_bytes);
}

#[tokio::test]
async fn sv3_each_answer_has_the_number_of_its_request() {
    let server = router(shared().await);
    let mut numbers = Vec::new();
    for path in ["/live", "/nothing", "/api/v1/trees"] {
        let asked = request(&Method::GET, path).body(Body::empty()).unwrap();
        let response = server.clone().oneshot(asked).await.unwrap();
        numbers.push(response.headers()["x-request-id"].to_str().unwrap().to_owned());
    }
    assert_eq!(numbers, ["1", "2", "3"]);
}
