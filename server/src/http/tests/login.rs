//! Coming in with a password, and going out.

use serde_json::{Value, json};

use super::{
    files::SCAN,
    people::{group, user},
    *,
};
use crate::{
    access::password::Password,
    store::{GroupChange, Groups, Terms, User, UserChange, Users},
};

async fn with_ada(role: Role) -> (Router, Arc<AnyStore>) {
    let (server, store) = server().await;
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    store.add_user(user("Ada", role, password)).await.unwrap();
    (server, store)
}

/// A request of somebody on another machine.
fn from_afar(method: &Method, path: &str, from: [u8; 4]) -> Builder {
    let request = Request::builder().method(method).uri(path).header(header::HOST, "192.168.1.7:7700");
    request.extension(Peer(from.into())).header(header::CONTENT_TYPE, "application/json")
}

async fn log_in(server: &Router, name: &str, password: &str, from: [u8; 4]) -> axum::response::Response {
    let body = json!({ "name": name, "password": password }).to_string();
    let asked = from_afar(&Method::POST, "/api/v1/login", from).body(Body::from(body)).unwrap();
    server.clone().oneshot(asked).await.unwrap()
}

fn cookie_of(answer: &axum::response::Response) -> String {
    let set = answer.headers()[header::SET_COOKIE].to_str().unwrap();
    set.split(';').next().unwrap().to_owned()
}

async fn me(server: &Router, cookie: &str) -> Value {
    let asked = from_afar(&Method::GET, "/api/v1/me", [192, 168, 1, 9]).header(header::COOKIE, cookie);
    let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

const AFAR: [u8; 4] = [192, 168, 1, 9];

#[tokio::test]
async fn ac9_whoever_has_the_password_is_in_until_they_log_out() {
    let (server, store) = with_ada(Role::Editor).await;
    for (name, password) in [("Ada", "correct hors"), ("Ada", ""), ("Bo", "correct horse")] {
        let refused = log_in(&server, name, password, AFAR).await;
        assert_eq!(refused.status(), StatusCode::UNAUTHORIZED, "{name}");
        assert!(!refused.headers().contains_key(header::SET_COOKIE));
    }
    let answer = log_in(&server, " ada ", "correct horse", AFAR).await;
    assert_eq!(answer.status(), StatusCode::OK);
    let cookie = cookie_of(&answer);
    assert_eq!(me(&server, &cookie).await, json!({ "role": "editor", "way": "login", "name": "Ada" }));
    store.change_user("key of Ada", UserChange::role(Role::Viewer), Terms::default()).await.unwrap();
    assert_eq!(me(&server, &cookie).await["role"], "viewer", "at once");

    let out = from_afar(&Method::POST, "/api/v1/logout", AFAR).header(header::COOKIE, &cookie);
    let out = server.clone().oneshot(out.body(Body::empty()).unwrap()).await.unwrap();
    assert_eq!(out.status(), StatusCode::NO_CONTENT);
    let forgotten = out.headers()[header::SET_COOKIE].to_str().unwrap();
    assert!(forgotten.starts_with("espalier-7700=;") && forgotten.contains("Max-Age=0"), "{forgotten}");
    assert_eq!(me(&server, &cookie).await["reason"], "not-let-in");
}

#[tokio::test]
async fn ac9_another_password_or_none_ends_logins() {
    let (server, store) = with_ada(Role::Owner).await;
    let cookie = cookie_of(&log_in(&server, "Ada", "correct horse", AFAR).await);
    let another = Password::parse("battery staple").unwrap().kept().unwrap();
    store.change_user("key of Ada", UserChange::password(another), Terms::default()).await.unwrap();
    assert_eq!(me(&server, &cookie).await["reason"], "not-let-in");
    let cookie = cookie_of(&log_in(&server, "Ada", "battery staple", AFAR).await);
    assert_eq!(me(&server, &cookie).await["role"], "owner");
    store.remove_user("key of Ada", Terms::default()).await.unwrap();
    assert_eq!(me(&server, &cookie).await["reason"], "not-let-in");
}

/// Whoever has the name after somebody who was removed is somebody else.
#[tokio::test]
async fn ac9_a_login_is_that_of_a_user_and_not_of_a_name() {
    let shared = shared().await;
    let (server, store) = (router(shared.clone()), Arc::clone(&shared.store));
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    store.add_user(user("Ada", Role::Owner, password.clone())).await.unwrap();
    let cookie = cookie_of(&log_in(&server, "Ada", "correct horse", AFAR).await);
    let checked = store.user("Ada").await.unwrap().unwrap();
    store.remove_user("key of Ada", Terms::default()).await.unwrap();
    let namesake = User { id: "key of another".into(), ..user("Ada", Role::Admin, password) };
    store.add_user(namesake).await.unwrap();
    assert_eq!(me(&server, &cookie).await["reason"], "not-let-in");
    // Neither where the password was checked before that, and the login is kept after it.
    let late = entry::let_in(&shared, checked.clone()).await.map(drop).map_err(|failure| failure.status());
    assert_eq!(late, Err(StatusCode::UNAUTHORIZED));
    let login = Secret::long("").hash();
    let late = users::change_own(&shared, checked, login, "battery staple").await;
    assert_eq!(late.map_err(|failure| failure.status()), Err(StatusCode::UNAUTHORIZED));
    assert!(store.passes(PassKind::Login, "2026").await.unwrap().is_empty());
    assert_eq!(log_in(&server, "Ada", "correct horse", AFAR).await.status(), StatusCode::OK);
}

/// An administrator gives somebody another password, for the one until now is known to others: who has just typed that
/// comes in no longer, nor sets a third one.
#[tokio::test]
async fn ac19_another_password_counts_also_for_who_has_just_typed_the_one_before() {
    let shared = shared().await;
    let store = Arc::clone(&shared.store);
    let kept = |text: &str| Password::parse(text).unwrap().kept().unwrap();
    store.add_user(user("Ada", Role::Owner, kept("correct horse"))).await.unwrap();
    let (_, pass) = entry::let_in(&shared, store.user("Ada").await.unwrap().unwrap()).await.unwrap();
    assert_eq!(store.passes(PassKind::Login, "2026").await.unwrap()[0].id, pass.id);
    let checked = store.user("Ada").await.unwrap().unwrap();
    let reset = UserChange::password(kept("battery staple"));
    assert!(store.change_user("key of Ada", reset, Terms::default()).await.unwrap());
    let late = entry::let_in(&shared, checked.clone()).await.map(drop).map_err(|failure| failure.status());
    assert_eq!(late, Err(StatusCode::UNAUTHORIZED));
    assert!(store.passes(PassKind::Login, "2026").await.unwrap().is_empty(), "none is kept");
    let late = users::change_own(&shared, checked, Secret::long("").hash(), "a third one").await;
    assert_eq!(late.map_err(|failure| failure.status()), Err(StatusCode::PRECONDITION_FAILED));
    let now = store.user("Ada").await.unwrap();
    assert!(shared.passwords.is_right("battery staple", now.map(|user| user.password)).await);
}

#[tokio::test]
async fn ac9_passwords_are_guessed_slowly_from_an_address_and_for_a_name() {
    let (server, _) = with_ada(Role::Viewer).await;
    // Each guess from an address of its own.
    for host in 1..=5 {
        let refused = log_in(&server, "ADA", "guess", [10, 0, 0, host]).await;
        assert_eq!(refused.status(), StatusCode::UNAUTHORIZED);
    }
    let late = log_in(&server, "Ada", "correct horse", [10, 0, 0, 6]).await;
    assert_eq!(late.status(), StatusCode::TOO_MANY_REQUESTS);
    assert!(late.headers().contains_key(header::RETRY_AFTER));
    // Each guess for a name of its own.
    for name in ["a", "b", "c", "d", "e"] {
        assert_eq!(log_in(&server, name, "guess", AFAR).await.status(), StatusCode::UNAUTHORIZED);
    }
    let late = log_in(&server, "f", "guess", AFAR).await;
    assert_eq!(late.status(), StatusCode::TOO_MANY_REQUESTS);
}

#[tokio::test]
async fn ac11_right_logins_are_limited_for_a_user_and_an_address() {
    let (server, store) = with_ada(Role::Viewer).await;
    // Addresses of their own, so that the user is counted.
    for host in 1..=20 {
        let come = log_in(&server, "Ada", "correct horse", [10, 0, 0, host]).await;
        assert_eq!(come.status(), StatusCode::OK, "{host}");
    }
    let late = log_in(&server, "ADA", "correct horse", [10, 0, 0, 99]).await;
    assert_eq!(late.status(), StatusCode::TOO_MANY_REQUESTS);
    let wait: u64 = late.headers()[header::RETRY_AFTER].to_str().unwrap().parse().unwrap();
    assert!((1..=600).contains(&wait), "{wait}");
    assert_eq!(store.passes(PassKind::Login, "2026").await.unwrap().len(), 20, "none is kept of the last");
    // Users of their own, so that the address is counted. All have one password, for hashes take long.
    let password = store.user("Ada").await.unwrap().unwrap().password;
    for number in 0..5 {
        let name = format!("User {number}");
        store.add_user(user(&name, Role::Viewer, password.clone())).await.unwrap();
    }
    let mut come = 0;
    for number in (0..5).cycle().take(101) {
        let answer = log_in(&server, &format!("User {number}"), "correct horse", AFAR).await;
        come += u32::from(answer.status() == StatusCode::OK);
    }
    assert_eq!(come, 100);
}

#[tokio::test]
async fn ac9_the_page_is_told_whether_to_ask_for_a_password() {
    for (server, expected) in [(server().await.0, false), (with_ada(Role::Viewer).await.0, true)] {
        let asked = from_afar(&Method::GET, "/api/v1/entry", AFAR).body(Body::empty()).unwrap();
        let answer = server.oneshot(asked).await.unwrap();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        assert_eq!(serde_json::from_slice::<Value>(&bytes).unwrap(), json!({ "passwords": expected }));
    }
}

#[tokio::test]
async fn ac15_a_login_may_what_a_group_of_its_user_may() {
    let (server, store) = with_ada(Role::Viewer).await;
    let cookie = cookie_of(&log_in(&server, "Ada", "correct horse", AFAR).await);
    let delete = async |tree: &str| {
        let path = format!("/api/v1/trees/{tree}");
        let asked = from_afar(&Method::DELETE, &path, AFAR).header(header::COOKIE, &cookie);
        server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap().status()
    };
    assert_eq!(delete("oak").await, StatusCode::FORBIDDEN);
    store.add_group(group("Studio", Role::Owner)).await.unwrap();
    store.join_group("key of Studio", "key of Ada", None).await.unwrap();
    assert_eq!(me(&server, &cookie).await["role"], "owner", "at once");
    assert_eq!(delete("oak").await, StatusCode::NOT_FOUND, "they may, but there is none");
    store
        .change_group("key of Studio", GroupChange { role: Some(Role::Editor), name: None }, None)
        .await
        .unwrap();
    assert_eq!(delete("oak").await, StatusCode::FORBIDDEN);
    // Who comes in while in a group has its role as well.
    let again = cookie_of(&log_in(&server, "Ada", "correct horse", AFAR).await);
    assert_eq!(me(&server, &again).await["role"], "editor");
    store.leave_group("key of Studio", "key of Ada", None).await.unwrap();
    assert_eq!(me(&server, &cookie).await["role"], "viewer");
}

#[tokio::test]
async fn lb1_whoever_has_logged_in_saves_by_their_own_name() {
    let (server, _) = with_ada(Role::Editor).await;
    let cookie = cookie_of(&log_in(&server, "Ada", "correct horse", AFAR).await);
    for path in [
        "/api/v1/trees/import?name=Scan&format=csv",
        "/api/v1/trees/ash/versions/import?format=csv&author=Bo",
        "/api/v1/trees/ash/versions/1/restore",
        "/api/v1/trees/ash/copies",
    ] {
        let body = match path.rsplit_once('/').map(|(_, last)| last) {
            Some("restore") => json!({ "author": "Bo" }).to_string(),
            Some("copies") => json!({ "name": "Twin", "author": "Bo" }).to_string(),
            _ => SCAN.to_owned(),
        };
        let asked = from_afar(&Method::POST, path, AFAR).header(header::COOKIE, &cookie);
        let answer = server.clone().oneshot(asked.body(Body::from(body)).unwrap()).await.unwrap();
        let status = answer.status();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let saved: Value = serde_json::from_slice(&bytes).unwrap();
        assert_eq!((status, &saved["author"]), (StatusCode::CREATED, &json!("Ada")), "{path}: {saved}");
    }
}
