//! Requests with keys are done once.

use std::{
    convert::Infallible,
    sync::atomic::{AtomicU32, Ordering},
};

use axum::{Extension, response::Response, routing::post};
use espalier_session::Principal;
use futures_util::{FutureExt, StreamExt, stream};
use tokio::sync::oneshot;

use super::*;
use crate::{
    http::keys::{KEY, Shown, answer_key, once},
    jobs::WAITING_OF_ONE,
    store::{Answers, MostAnswers},
};

const COPIES: &str = "/api/v1/trees/ash/copies";
const ELM: &str = r#"{"name":"Elm"}"#;

fn asked(path: &str, key: &str) -> Builder {
    let asked = request(&Method::POST, path).header(KEY, key);
    asked.header(header::CONTENT_TYPE, "application/json")
}

async fn send(server: &Router, asked: Builder, body: &str) -> Response {
    server.clone().oneshot(asked.body(Body::from(body.to_owned())).unwrap()).await.unwrap()
}

/// Status, reason or identifier, and the headers that count.
async fn told(response: Response) -> (u16, Value, Vec<String>) {
    let status = response.status().as_u16();
    let names = [header::CONTENT_TYPE, header::LOCATION, header::ETAG];
    let headers = names.iter().filter_map(|name| response.headers().get(name));
    let headers = headers.map(|value| value.to_str().unwrap().to_owned()).collect();
    let bytes = axum::body::to_bytes(response.into_body(), usize::MAX).await.unwrap();
    let body: Value = serde_json::from_slice(&bytes).unwrap_or_default();
    let told = body.get("reason").or(body.get("id")).cloned().unwrap_or_default();
    (status, told, headers)
}

/// Trees in the library.
async fn trees(server: &Router) -> usize {
    let asked = request(&Method::GET, "/api/v1/trees").body(Body::empty()).unwrap();
    let answer = server.clone().oneshot(asked).await.unwrap();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    serde_json::from_slice::<TreePage>(&bytes).unwrap().trees.len()
}

#[tokio::test]
async fn ik1_the_same_request_with_the_same_key_is_answered_again() {
    let (server, store) = server().await;
    let first = told(send(&server, asked(COPIES, "one"), ELM).await).await;
    assert_eq!((first.0, first.2.len()), (201, 2), "{first:?}");
    assert_eq!(told(send(&server, asked(COPIES, "\"one\""), ELM).await).await, first);
    assert_eq!(trees(&server).await, 3);

    // Other keys, other clients and other callers do not meet.
    let token = token(&store, Role::Editor, None).await;
    let by_key = asked(COPIES, "two");
    let by_client = asked(COPIES, "one").header(guard::CLIENT, "browser-1");
    let by_caller = asked(COPIES, "one").header(header::AUTHORIZATION, token);
    let mut all = BTreeSet::from([first.1.as_str().unwrap().to_owned()]);
    for (asked, count) in [(by_key, 2), (by_client, 3), (by_caller, 4)] {
        let other = told(send(&server, asked, ELM).await).await;
        assert_eq!(other.0, 201);
        all.insert(other.1.as_str().unwrap().to_owned());
        assert_eq!(all.len(), count);
    }
    assert_eq!(trees(&server).await, 6);
}

#[tokio::test]
async fn ik1_every_address_that_makes_something_takes_a_key() {
    let keyed = routes().into_iter().filter(Route::takes_keys).map(|route| route.address.into_owned());
    let without = ["redeem", "login", "logout", "grammars/check", "schematic"]
        .map(|name| format!("POST /api/v1/{name}"));
    let posts = routes().into_iter().map(|route| route.address.into_owned());
    let posts = posts.filter(|address| address.starts_with("POST ") && !without.contains(address));
    assert!(keyed.eq(posts));
    let (server, _) = server().await;
    for route in routes().into_iter().filter(Route::takes_keys) {
        let path = filled(path_of(&route.address));
        let refused = told(send(&server, asked(&path, "no key"), "").await).await;
        assert_eq!((refused.0, &refused.1), (400, &json!("malformed")), "{path}");
    }
}

#[tokio::test]
async fn ik1_what_was_asked_for_is_done_where_nobody_waits_for_it() {
    let (server, _) = server().await;
    let request = asked(COPIES, "one").body(Body::from(ELM)).unwrap();
    let gone = server.clone().oneshot(request).now_or_never();
    assert!(gone.is_none(), "it was given up while it was under way");
    let found = loop {
        let found = told(send(&server, asked(COPIES, "one"), ELM).await).await;
        if found.0 != 409 {
            break found;
        }
        tokio::task::yield_now().await;
    };
    assert_eq!((found.0, trees(&server).await), (201, 3));
}

#[tokio::test]
async fn ik2_another_request_with_the_key_is_refused() {
    let (server, _) = server().await;
    assert_eq!(send(&server, asked(COPIES, "one"), ELM).await.status(), StatusCode::CREATED);
    let revised = asked(COPIES, "one").header(header::IF_MATCH, "\"1\"");
    for (asked, body) in [
        (asked(COPIES, "one"), r#"{"name":"Yew"}"#),
        (asked("/api/v1/trees/yew/copies", "one"), ELM),
        (asked("/api/v1/collections", "one"), ELM),
        (revised, ELM),
    ] {
        let refused = told(send(&server, asked, body).await).await;
        assert_eq!((refused.0, refused.1), (422, json!("key-of-another")));
    }
    assert_eq!(trees(&server).await, 3);
    let large = format!(r#"{{"name":"{}"}}"#, "x".repeat(40_000));
    assert_eq!(send(&server, asked(COPIES, "one"), &large).await.status(), StatusCode::PAYLOAD_TOO_LARGE);
}

#[tokio::test]
async fn ik2_while_the_first_is_under_way_the_same_is_refused() {
    let (server, _) = server().await;
    let (rest, waiting) = oneshot::channel::<()>();
    let begun = stream::once(async { Ok::<_, Infallible>(r#"{"name":"#) });
    let end = stream::once(async move {
        waiting.await.unwrap();
        Ok(r#""Elm"}"#)
    });
    let slow = asked(COPIES, "one").body(Body::from_stream(begun.chain(end))).unwrap();
    let first = tokio::spawn(server.clone().oneshot(slow));
    tokio::task::yield_now().await;
    let refused = loop {
        let refused = told(send(&server, asked(COPIES, "one"), ELM).await).await;
        if refused.0 == 409 {
            break refused;
        }
    };
    assert_eq!(refused.1, json!("key-under-way"));
    rest.send(()).unwrap();
    let first = told(first.await.unwrap().unwrap()).await;
    assert_eq!(first.0, 201);
    assert_eq!(told(send(&server, asked(COPIES, "one"), ELM).await).await, first);
    assert_eq!(trees(&server).await, 3);
}

#[tokio::test]
async fn ik3_refusals_are_repeated_and_what_is_to_be_tried_again_is_not() {
    let (server, store) = server().await;
    let unnamed = || asked("/api/v1/collections", "one");
    let refused = told(send(&server, unnamed(), r#"{"name":""}"#).await).await;
    assert_eq!((refused.0, &refused.1), (400, &json!("text-length")));
    assert_eq!(told(send(&server, unnamed(), r#"{"name":""}"#).await).await, refused);
    assert_eq!(send(&server, unnamed(), r#"{"name":"Wood"}"#).await.status().as_u16(), 422);

    let grow = |key: &str| asked("/api/v1/grow", key);
    let body = r#"{"template":"oak","format":"mtg"}"#;
    // One job waits there from the start.
    let mut last = String::new();
    for number in 1..WAITING_OF_ONE {
        let key = number.to_string();
        let taken = told(send(&server, grow(&key), body).await).await;
        assert_eq!(taken.0, 202);
        last = taken.1.as_str().unwrap().to_owned();
    }
    let full = told(send(&server, grow("more"), body).await).await;
    assert_eq!((full.0, full.1), (503, json!("jobs-full")));
    let give_up = request(&Method::DELETE, &format!("/api/v1/jobs/{last}"));
    assert_eq!(status(&server, give_up, "").await, StatusCode::NO_CONTENT);
    let taken = told(send(&server, grow("more"), body).await).await;
    assert_eq!((taken.0, taken.2.len()), (202, 2));
    assert_eq!(told(send(&server, grow("more"), body).await).await, taken);

    // What a killed server leaves.
    let key = answer_key(&Caller::local(), &Principal::visitor(), "left");
    store.begin_answer(key, &crate::time::now(), "2026", MostAnswers::default()).await.unwrap();
    let left = told(send(&server, asked(COPIES, "left"), ELM).await).await;
    assert_eq!((left.0, left.1), (409, json!("outcome-unknown")));
    store
        .begin_answer(
            answer_key(&Caller::local(), &Principal::visitor(), "old"),
            "2026",
            "2026",
            MostAnswers::default(),
        )
        .await
        .unwrap();
    assert_eq!(send(&server, asked(COPIES, "old"), ELM).await.status(), StatusCode::CREATED, "after a day");
}

/// A server with one address, which takes keys.
fn alone<F: Future<Output = &'static str> + Send + 'static>(
    shared: &Shared,
    answer: impl Fn() -> F + Clone + Send + Sync + 'static,
) -> Router {
    let keyed = Keyed { shared: shared.clone(), shown: Shown::Again, time_limit: Duration::from_secs(30) };
    let answer = post(answer).layer::<_, Infallible>(from_fn_with_state(keyed, once));
    let caller =
        ServiceBuilder::new().layer(Extension(Caller::local())).layer(Extension(Principal::visitor()));
    Router::new().route("/", answer.layer(caller))
}

#[tokio::test]
async fn ik3_a_panic_frees_its_key() {
    let shared = shared().await;
    let times = Arc::new(AtomicU32::new(0));
    let counted = Arc::clone(&times);
    let server = alone(&shared, move || {
        let before = counted.fetch_add(1, Ordering::Relaxed);
        async move {
            assert_ne!(before, 0, "the first one fails");
            "done"
        }
    });
    let failed = told(send(&server, asked("/", "one"), "").await).await;
    assert_eq!((failed.0, failed.1), (503, json!("failed")));
    for _ in 0..2 {
        assert_eq!(send(&server, asked("/", "one"), "").await.status(), StatusCode::OK);
    }
    assert_eq!(times.load(Ordering::Relaxed), 2, "the third was answered with what the second was");
}

#[tokio::test]
async fn ik3_a_server_that_stops_waits_for_what_it_does_also_where_nobody_else_does() {
    let shared = shared().await;
    let go_on = Arc::new(Notify::new());
    let waiting = Arc::clone(&go_on);
    let server = alone(&shared, move || {
        let waiting = Arc::clone(&waiting);
        async move {
            waiting.notified().await;
            "done"
        }
    });
    let gone = server.clone().oneshot(asked("/", "one").body(Body::empty()).unwrap()).now_or_never();
    assert!(gone.is_none(), "it was given up while it was under way");
    let mut ended = std::pin::pin!(shared.under_way.ended());
    for _ in 0..100 {
        tokio::task::yield_now().await;
        assert!(ended.as_mut().now_or_never().is_none());
    }
    go_on.notify_one();
    ended.await;
    let again = alone(&shared, || async { "another" });
    let answer = send(&again, asked("/", "one"), "").await;
    assert_eq!(axum::body::to_bytes(answer.into_body(), 100).await.unwrap(), "done");
}

#[tokio::test]
async fn ik3_a_server_that_stops_frees_the_keys_of_what_has_not_come() {
    let stop = CancellationToken::new();
    let shared = Shared { under_way: UnderWay::new(stop.clone()), ..shared().await };
    let server = router(shared.clone());
    let begun = stream::once(async { Ok::<_, Infallible>(r#"{"name":"#) }).chain(stream::pending());
    let slow = asked(COPIES, "one").body(Body::from_stream(begun)).unwrap();
    let slow = tokio::spawn(server.clone().oneshot(slow));
    tokio::task::yield_now().await;
    while told(send(&server, asked(COPIES, "one"), ELM).await).await.1 != json!("key-under-way") {
        tokio::task::yield_now().await;
    }
    stop.cancel();
    shared.under_way.ended().await;
    let refused = told(slow.await.unwrap().unwrap()).await;
    assert_eq!((refused.0, refused.1), (503, json!("stopping")));
    let next = router(Shared { under_way: UnderWay::default(), ..shared });
    assert_eq!(send(&next, asked(COPIES, "one"), ELM).await.status(), StatusCode::CREATED);
    assert_eq!(trees(&next).await, 3);
}
