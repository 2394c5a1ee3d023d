//! Lists of sessions.

use axum::http::HeaderMap;
use espalier_proto::library::SessionPage;

use super::*;
use crate::store::Visits;

async fn listed(server: &Router, asked: Builder) -> (Vec<String>, Option<String>) {
    let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
    assert_eq!(answer.status(), StatusCode::OK);
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    let page: SessionPage = serde_json::from_slice(&bytes).unwrap();
    (page.sessions.into_iter().map(|session| session.session).collect(), page.next)
}

async fn names(server: &Router, asked: Builder) -> Vec<String> {
    let mut names = listed(server, asked).await.0;
    names.sort();
    names
}

async fn begin(server: &Router, token: &str) -> String {
    let begin = request_of(token, &Method::POST, "/api/v1/sessions");
    let begin = begin.header(header::CONTENT_TYPE, "application/json").body(Body::from("{}")).unwrap();
    let answer = server.clone().oneshot(begin).await.unwrap();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    let begun: Value = serde_json::from_slice(&bytes).unwrap();
    begun["session"].as_str().unwrap().to_owned()
}

#[tokio::test]
async fn lb11_a_stranger_sees_no_session_of_others() {
    let (server, store) = server().await;
    let [ann, bo] = [token(&store, Role::Editor, None).await, token(&store, Role::Editor, None).await];
    let owner = token(&store, Role::Owner, None).await;
    let guest = token(&store, Role::Owner, Some("ash")).await;
    let sketch = begin(&server, &ann).await;
    let path = "/api/v1/sessions";
    let of = |token: &str, path: &str| request_of(token, &Method::GET, path);
    assert_eq!(names(&server, of(&ann, path)).await, std::slice::from_ref(&sketch));
    for token in [&bo, &guest] {
        assert_eq!(names(&server, of(token, path)).await, [""; 0]);
    }
    let mut all = vec!["oak".to_owned(), "ashen".into(), sketch.clone()];
    all.sort();
    for asked in [request(&Method::GET, path), of(&owner, path)] {
        assert_eq!(names(&server, asked).await, all, "owners, and who sits at the machine, see all");
    }
    assert_eq!(names(&server, of(&owner, "/api/v1/sessions?mine=true")).await, [""; 0]);
    // Nothing was done in any of them.
    assert_eq!(names(&server, request(&Method::GET, "/api/v1/sessions?saved=false")).await, [""; 0]);

    let forget = |token: &str| request_of(token, &Method::DELETE, &format!("{path}/{sketch}"));
    assert_eq!(status(&server, forget(&bo), "").await, StatusCode::NOT_FOUND);
    assert_eq!(status(&server, forget(&ann), "").await, StatusCode::NO_CONTENT);
    assert_eq!(names(&server, of(&ann, path)).await, [""; 0]);
    assert_eq!(names(&server, of(&owner, path)).await, all);
    assert_eq!(status(&server, forget(&owner), "").await, StatusCode::NO_CONTENT);
    assert_eq!(names(&server, of(&owner, path)).await, ["ashen", "oak"]);
    let found = status(&server, of(&ann, &format!("{path}/{sketch}")), "").await;
    assert_eq!(found, StatusCode::OK, "its link leads to it still");
}

#[tokio::test]
async fn lb11_guests_see_those_of_their_tree_that_they_were_in() {
    let (server, store) = server().await;
    let guest = token(&store, Role::Viewer, Some("ash")).await;
    let headers = HeaderMap::from_iter([(header::AUTHORIZATION, guest.parse().unwrap())]);
    let person = Caller::of(&headers, None, false, &*store).await.unwrap().person();
    for session in ["ashen", "oak"] {
        store.visit(session, &person).await.unwrap();
    }
    let asked = request_of(&guest, &Method::GET, "/api/v1/sessions");
    assert_eq!(names(&server, asked).await, ["ashen"]);
}

#[tokio::test]
async fn lb11_pages_follow_one_another() {
    let (server, _) = server().await;
    let (first, next) = listed(&server, request(&Method::GET, "/api/v1/sessions?limit=1")).await;
    let path = format!("/api/v1/sessions?limit=1&after={}", next.unwrap());
    let (second, next) = listed(&server, request(&Method::GET, &path)).await;
    let mut both = [first, second].concat();
    both.sort();
    assert_eq!(both, ["ashen", "oak"]);
    let path = format!("/api/v1/sessions?limit=1&after={}", next.unwrap());
    assert_eq!(listed(&server, request(&Method::GET, &path)).await, (Vec::new(), None));
    let nonsense = request(&Method::GET, "/api/v1/sessions?after=x");
    assert_eq!(status(&server, nonsense, "").await, StatusCode::BAD_REQUEST);
}
