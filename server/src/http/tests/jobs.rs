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

/// Whoever may grow no more trees still has what they ordered.
#[tokio::test]
async fn jb8_own_jobs_are_listed_taken_and_given_up_also_by_viewers() {
    let shared = shared().await;
    let token = token(&shared.store, Role::Viewer, None).await;
    let asked = request_of(&token, &Method::GET, "/").body(()).unwrap();
    let by = Caller::of(asked.headers(), None, false, &*shared.store).await.unwrap();
    for name in ["first", "second", "third"] {
        shared.jobs.add_named(name.into(), order(by.clone())).unwrap();
    }
    let server = router(shared);
    let list = async |asked: Builder| {
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        assert_eq!(answer.status(), StatusCode::OK);
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let page: Value = serde_json::from_slice(&bytes).unwrap();
        let ids = page["jobs"].as_array().unwrap().iter().map(|job| job["id"].as_str().unwrap().to_owned());
        (ids.collect::<Vec<_>>(), page["next"].as_u64(), page["jobs"][0].clone())
    };
    let own = |query: &str| request_of(&token, &Method::GET, &format!("/api/v1/jobs{query}"));
    let (ids, next, first) = list(own("?limit=2")).await;
    assert_eq!(ids, ["third", "second"]);
    assert_eq!(first["address"], "/api/v1/jobs/third");
    assert_eq!(
        (&first["state"], &first["all"], &first["format"]),
        (&json!("waiting"), &json!(1), &json!("glb"))
    );
    let (ids, next, _) = list(own(&format!("?limit=2&before={}", next.unwrap()))).await;
    assert_eq!((ids, next), (vec!["first".to_owned()], None));
    let (ids, ..) = list(request(&Method::GET, "/api/v1/jobs")).await;
    assert_eq!(ids, ["third", "second", "first", JOB], "administrators see all");

    let by = |method, path: &'static str| status(&server, request_of(&token, &method, path), "");
    assert_eq!(by(Method::GET, "/api/v1/jobs/first").await, StatusCode::OK);
    assert_eq!(by(Method::GET, "/api/v1/jobs/first/results/1").await, StatusCode::NOT_FOUND);
    assert_eq!(by(Method::DELETE, "/api/v1/jobs/first").await, StatusCode::NO_CONTENT);
    assert_eq!(by(Method::GET, "/api/v1/jobs/a-job").await, StatusCode::NOT_FOUND);
    let grow = request_of(&token, &Method::POST, "/api/v1/grow");
    assert_eq!(status(&server, grow, r#"{"template":"oak","format":"mtg"}"#).await, StatusCode::FORBIDDEN);
}

#[tokio::test]
async fn jb1_seeds_are_a_list_or_a_text() {
    let (server, _) = server().await;
    for (seeds, all) in [(json!([3, 9]), 2), (json!("2-4"), 3), (json!("7"), 1)] {
        let body = json!({ "template": "oak", "format": "mtg", "seeds": seeds }).to_string();
        let order = request(&Method::POST, "/api/v1/grow").header(header::CONTENT_TYPE, "application/json");
        let answer = server.clone().oneshot(order.body(Body::from(body)).unwrap()).await.unwrap();
        assert_eq!(answer.status(), StatusCode::ACCEPTED, "{seeds}");
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        assert_eq!(serde_json::from_slice::<Value>(&bytes).unwrap()["all"], all, "{seeds}");
    }
}

#[tokio::test]
async fn ex6_pictures_of_a_job_are_bounded_as_those_of_a_download() {
    let (server, _) = server().await;
    for (frames, status) in [(100, 400), (10, 202)] {
        let options = json!({ "size": "3840x2160", "frames": frames });
        let body = json!({ "template": "oak", "format": "sway.png", "options": options }).to_string();
        let order = request(&Method::POST, "/api/v1/grow").header(header::CONTENT_TYPE, "application/json");
        let answer = server.clone().oneshot(order.body(Body::from(body)).unwrap()).await.unwrap();
        let found = answer.status().as_u16();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let problem: Value = serde_json::from_slice(&bytes).unwrap();
        assert_eq!(found, status, "{problem}");
        if status == 400 {
            assert_eq!(problem["field"], "options.frames", "{problem}");
        }
    }
}
