//! Users, groups and tokens over HTTP.

use serde_json::{Value, json};

use super::*;
use crate::{
    access::password::Password,
    store::{Group, Heir, Standings, User, Users},
};

pub(super) fn user(name: &str, role: Role, password: String) -> User {
    let (id, name, created_at) = (format!("key of {name}"), name.to_owned(), "2026".into());
    User { id, name, role, group_role: None, password, created_at, revision: 1 }
}

pub(super) fn group(name: &str, role: Role) -> Group {
    let (id, name, created_at) = (format!("key of {name}"), name.to_owned(), "2026".into());
    Group { id, name, role, created_at, members: Vec::new(), revision: 1 }
}

/// A server on which somebody at its machine asks.
pub(super) struct Asking(pub(super) Router);

/// Status, body and tag of an answer.
pub(super) type Answered = (u16, Value, Option<String>);

impl Asking {
    pub(super) async fn ask(&self, asked: Builder, body: &Value) -> Answered {
        let asked = asked.header(header::CONTENT_TYPE, "application/json");
        let body = if body.is_null() { Body::empty() } else { Body::from(body.to_string()) };
        let answer = self.0.clone().oneshot(asked.body(body).unwrap()).await.unwrap();
        let tag = answer.headers().get(header::ETAG).map(|tag| tag.to_str().unwrap().to_owned());
        let status = answer.status().as_u16();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        (status, serde_json::from_slice(&bytes).unwrap_or_default(), tag)
    }

    pub(super) async fn get(&self, path: &str) -> Value {
        self.ask(request(&Method::GET, path), &Value::Null).await.1
    }

    pub(super) async fn send(&self, method: Method, path: &str, body: Value) -> Answered {
        self.ask(request(&method, path), &body).await
    }

    async fn send_at(&self, method: Method, path: &str, revision: &str, body: Value) -> Answered {
        self.ask(request(&method, path).header(header::IF_MATCH, revision), &body).await
    }

    /// The same of whoever has logged in, from another machine.
    pub(super) async fn as_user(&self, cookie: &str, method: Method, path: &str, body: Value) -> Answered {
        self.ask(from_afar(&method, path).header(header::COOKIE, cookie), &body).await
    }

    pub(super) async fn log_in(&self, name: &str, password: &str) -> Option<String> {
        let body = json!({ "name": name, "password": password }).to_string();
        let asked =
            from_afar(&Method::POST, "/api/v1/login").header(header::CONTENT_TYPE, "application/json");
        let answer = self.0.clone().oneshot(asked.body(Body::from(body)).unwrap()).await.unwrap();
        let set = answer.headers().get(header::SET_COOKIE)?.to_str().unwrap();
        set.split(';').next().map(str::to_owned)
    }

    /// The newest event on the list of what was done.
    pub(super) async fn noted(&self) -> [Value; 2] {
        let events = self.get("/api/v1/audit?limit=1").await;
        ["action", "object"].map(|field| events[0][field].clone())
    }
}

fn from_afar(method: &Method, path: &str) -> Builder {
    let request = Request::builder().method(method).uri(path).header(header::HOST, "192.168.1.7:7700");
    request.extension(Peer([192, 168, 1, 9].into()))
}

#[tokio::test]
async fn ac19_users_are_made_changed_and_removed() {
    let (server, _) = server().await;
    let server = Asking(server);
    let users = "/api/v1/users";
    let new = json!({ "name": "Ada", "role": "editor", "password": "correct horse" });
    let (status, ada, tag) = server.send(Method::POST, users, new.clone()).await;
    assert_eq!((status, tag.as_deref()), (201, Some("\"1\"")));
    assert_eq!(
        (&ada["name"], &ada["role"], &ada["own_role"]),
        (&json!("Ada"), &json!("editor"), &json!("editor"))
    );
    assert!(!ada.to_string().contains("argon2"), "{ada}");
    assert_eq!(server.noted().await, [json!("user-add"), json!("/Ada editor")]);
    let (status, problem, _) = server
        .send(Method::POST, users, json!({ "name": "ÁDA", "role": "viewer", "password": "correct horse" }))
        .await;
    assert_eq!((status, &problem["reason"], &problem["field"]), (409, &json!("name-taken"), &json!("name")));
    for (field, value) in [("password", "short"), ("name", ""), ("role", "king")] {
        let mut wrong = new.clone();
        wrong[field] = value.into();
        let (status, problem, _) = server.send(Method::POST, users, wrong).await;
        assert_eq!((status, problem["field"].as_str()), (400, Some(field)), "{problem}");
    }
    assert_eq!(server.get(users).await, json!([ada]));
    assert!(server.log_in("Ada", "correct horse").await.is_some());

    let path = format!("{users}/{}", ada["id"].as_str().unwrap());
    assert_eq!(server.get(&path).await, ada);
    let (status, problem, _) =
        server.send_at(Method::PATCH, &path, "\"2\"", json!({ "role": "owner" })).await;
    assert_eq!((status, &problem["reason"]), (412, &json!("stale")));
    let change = json!({ "name": "Ada L.", "role": "admin", "password": "battery staple" });
    let (status, changed, tag) = server.send_at(Method::PATCH, &path, "\"1\"", change).await;
    assert_eq!((status, tag.as_deref(), &changed["name"]), (200, Some("\"2\""), &json!("Ada L.")));
    let noted = format!("{}/Ada: name Ada L., role admin, password", ada["id"].as_str().unwrap());
    assert_eq!(server.noted().await, [json!("user-change"), json!(noted)]);
    assert_eq!(server.send(Method::PATCH, &path, json!({})).await, (200, changed, tag), "nothing changes");
    assert!(server.log_in("Ada", "correct horse").await.is_none());
    assert!(server.log_in("ada l.", "battery staple").await.is_some());
    for (method, body) in [(Method::PATCH, json!({ "role": "owner" })), (Method::DELETE, Value::Null)] {
        let (status, problem, _) = server.send(method, &path, body).await;
        assert_eq!((status, &problem["reason"]), (409, &json!("last-admin")), "the last administrator stays");
    }
    let bo = json!({ "name": "Bo", "role": "admin", "password": "correct horse" });
    assert_eq!(server.send(Method::POST, users, bo).await.0, 201);
    assert_eq!(server.send_at(Method::DELETE, &path, "\"1\"", Value::Null).await.0, 412);
    assert_eq!(server.send_at(Method::DELETE, &path, "\"2\"", Value::Null).await.0, 204);
    assert_eq!(server.noted().await[0], json!("user-remove"));
    for method in [Method::GET, Method::PATCH, Method::DELETE] {
        let body = if method == Method::PATCH { json!({}) } else { Value::Null };
        let (status, problem, _) = server.send(method, &path, body).await;
        assert_eq!((status, &problem["field"]), (404, &json!("user")));
    }
}

#[tokio::test]
async fn ac19_what_changes_holds_at_once_for_whoever_is_logged_in() {
    let (server, store) = server().await;
    let server = Asking(server);
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    store.add_user(user("Ada", Role::Editor, password)).await.unwrap();
    let [one, other] = [(); 2].map(|()| server.log_in("Ada", "correct horse"));
    let (one, other) = (one.await.unwrap(), other.await.unwrap());
    let me = async |cookie: &str| server.as_user(cookie, Method::GET, "/api/v1/me", Value::Null).await;
    let path = format!("/api/v1/users/{}", "key%20of%20Ada");
    let changed = server.send(Method::PATCH, &path, json!({ "name": "Cy", "role": "viewer" })).await;
    assert_eq!(changed.0, 200, "{}", changed.1);
    let expected = json!({ "role": "viewer", "way": "login", "name": "Cy" });
    assert_eq!(me(&one).await.1, expected, "they stay logged in");

    // One's own password, by the one until now.
    let own = async |cookie: &str, old: &str, new: &str| {
        let body = json!({ "old": old, "new": new });
        server.as_user(cookie, Method::PUT, "/api/v1/me/password", body).await
    };
    let (status, problem, _) = own(&one, "guess", "battery staple").await;
    assert_eq!(
        (status, &problem["reason"], &problem["field"]),
        (401, &json!("wrong-password"), &json!("old"))
    );
    let (status, problem, _) = own(&one, "correct horse", "short").await;
    assert_eq!((status, &problem["field"]), (400, &json!("new")));
    assert_eq!(own(&one, "correct horse", "battery staple").await.0, 204);
    assert_eq!(server.noted().await[0], json!("password"));
    assert_eq!((me(&one).await.0, me(&other).await.0), (200, 401), "the others end");
    assert!(server.log_in("Cy", "correct horse").await.is_none());
    for _ in 0..4 {
        assert_eq!(own(&one, "guess", "battery staple").await.0, 401);
    }
    assert_eq!(own(&one, "battery staple", "correct horse").await.0, 429, "guesses are counted");
    let machine = json!({ "old": "battery staple", "new": "correct horse" });
    assert_eq!(server.send(Method::PUT, "/api/v1/me/password", machine).await.0, 403);
}

#[tokio::test]
async fn ac20_groups_are_made_changed_and_joined() {
    let (server, store) = server().await;
    let server = Asking(server);
    store.add_user(user("Ada", Role::Viewer, String::new())).await.unwrap();
    let groups = "/api/v1/groups";
    let new = json!({ "name": "Studio", "role": "editor" });
    let (status, studio, tag) = server.send(Method::POST, groups, new.clone()).await;
    assert_eq!((status, tag.as_deref(), &studio["members"]), (201, Some("\"1\""), &json!([])));
    assert_eq!(server.send(Method::POST, groups, new).await.1["reason"], "name-taken");
    let admins = json!({ "name": "Kings", "role": "admin" });
    let (status, problem, _) = server.send(Method::POST, groups, admins).await;
    assert_eq!((status, &problem["field"]), (400, &json!("role")));
    let path = format!("{groups}/{}", studio["id"].as_str().unwrap());
    let ada = format!("{path}/members/key%20of%20Ada");
    let (status, joined, tag) = server.send_at(Method::PUT, &ada, "\"1\"", Value::Null).await;
    assert_eq!((status, tag.as_deref()), (200, Some("\"2\"")));
    assert_eq!(joined["members"], json!([{ "id": "key of Ada", "name": "Ada" }]));
    assert_eq!(server.noted().await[0], json!("group-join"));
    assert_eq!(server.send(Method::PUT, &ada, Value::Null).await.2.as_deref(), Some("\"2\""), "once");
    let told = server.get("/api/v1/users").await;
    assert_eq!(
        (&told[0]["role"], &told[0]["own_role"], &told[0]["groups"]),
        (&json!("editor"), &json!("viewer"), &json!(["Studio"]))
    );
    assert_eq!(server.send_at(Method::PATCH, &path, "\"1\"", json!({ "role": "owner" })).await.0, 412);
    let (status, changed, _) =
        server.send_at(Method::PATCH, &path, "\"2\"", json!({ "name": "Nursery", "role": "owner" })).await;
    assert_eq!((status, &changed["name"], &changed["role"]), (200, &json!("Nursery"), &json!("owner")));
    assert_eq!(server.get(groups).await, json!([changed]));
    for (member, field) in [("members/nobody", "user"), ("members/key%20of%20Bo", "user")] {
        let (status, problem, _) = server.send(Method::PUT, &format!("{path}/{member}"), Value::Null).await;
        assert_eq!((status, &problem["field"]), (404, &json!(field)));
    }
    assert_eq!(server.send(Method::DELETE, &ada, Value::Null).await.1["members"], json!([]));
    assert_eq!(server.send(Method::DELETE, &ada, Value::Null).await.1["field"], "user");
    assert_eq!(server.send(Method::DELETE, &path, Value::Null).await.0, 204);
    let (status, problem, _) = server.send(Method::GET, &path, Value::Null).await;
    assert_eq!((status, &problem["field"]), (404, &json!("group")));
}

#[tokio::test]
async fn ac21_a_program_acts_as_whoever_made_its_token() {
    let (server, store) = server().await;
    let server = Asking(server);
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    for (name, role) in [("Ada", Role::Editor), ("Bo", Role::Admin)] {
        store.add_user(user(name, role, password.clone())).await.unwrap();
    }
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let bo = server.log_in("Bo", "correct horse").await.unwrap();
    let tokens = "/api/v1/tokens";
    let make = async |cookie: &str, role: &str| {
        let new = json!({ "name": "farm", "role": role, "hours": 24 });
        server.as_user(cookie, Method::POST, tokens, new).await
    };
    let (status, made, _) = make(&ada, "editor").await;
    assert_eq!(status, 201);
    let (id, secret) = (made["id"].as_str().unwrap(), made["token"].as_str().unwrap());
    assert!(secret.starts_with(TOKEN));
    let as_program = async |method: Method, path: &str, body: Value| {
        let asked = from_afar(&method, path).header(header::AUTHORIZATION, format!("Bearer {secret}"));
        server.ask(asked, &body).await
    };
    let (status, favourite, _) = as_program(Method::PUT, "/api/v1/trees/ash/favourite", Value::Null).await;
    assert_eq!((status, favourite), (204, Value::Null));
    let of_ada = server.as_user(&ada, Method::GET, "/api/v1/trees?favourite=true", Value::Null).await.1;
    assert_eq!(of_ada["trees"][0]["id"], "ash", "what it does is done by Ada: {of_ada}");
    let (status, problem, _) =
        as_program(Method::POST, tokens, json!({ "name": "another", "role": "viewer" })).await;
    assert_eq!((status, &problem["reason"]), (403, &json!("forbidden")), "programs make none");

    // No more than it was made for, also where she may do more than elsewhere.
    let heir = Heir { person: "login ada".into(), name: "Ada".into() };
    store.hand_over("yew", Some(heir), None).await.unwrap();
    let lock = "/api/v1/trees/yew/lock";
    assert_eq!(as_program(Method::PUT, lock, Value::Null).await.0, 403);
    assert_eq!(server.as_user(&ada, Method::PUT, lock, Value::Null).await.0, 200);

    let listed = server.as_user(&ada, Method::GET, tokens, Value::Null).await.1;
    assert_eq!(
        (&listed[0]["name"], &listed[0]["of"], &listed[0]["role"]),
        (&json!("farm"), &json!("Ada"), &json!("editor"))
    );
    assert!(!listed.to_string().contains(secret), "it is told once");
    assert_eq!(server.as_user(&bo, Method::GET, tokens, Value::Null).await.1, json!([]));
    let all = format!("{tokens}/all");
    assert_eq!(server.as_user(&bo, Method::GET, &all, Value::Null).await.1, listed);
    assert_eq!(server.as_user(&ada, Method::GET, &all, Value::Null).await.0, 403);

    // Never more than she may now.
    let path = "/api/v1/users/key%20of%20Ada";
    assert_eq!(server.send(Method::PATCH, path, json!({ "role": "viewer" })).await.0, 200);
    assert_eq!(as_program(Method::GET, "/api/v1/me", Value::Null).await.1["role"], "viewer");
    assert_eq!(make(&ada, "editor").await.1["field"], "role");
    let other = make(&bo, "viewer").await.1;
    let other = format!("{tokens}/{}", other["id"].as_str().unwrap());
    assert_eq!(server.as_user(&ada, Method::DELETE, &other, Value::Null).await.0, 404, "it is not hers");
    assert_eq!(server.as_user(&bo, Method::DELETE, &other, Value::Null).await.0, 204);
    assert_eq!(server.noted().await[0], json!("token-revoke"));
    let own = format!("{tokens}/{id}");
    assert_eq!(
        server.as_user(&bo, Method::DELETE, &own, Value::Null).await.0,
        204,
        "administrators revoke any"
    );
    assert_eq!(as_program(Method::GET, "/api/v1/me", Value::Null).await.0, 401);
}

#[tokio::test]
async fn ac21_a_token_is_gone_with_whoever_made_it() {
    let (server, store) = server().await;
    let server = Asking(server);
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    store.add_user(user("Ada", Role::Editor, password)).await.unwrap();
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let new = json!({ "name": "farm", "role": "viewer" });
    let made = server.as_user(&ada, Method::POST, "/api/v1/tokens", new.clone()).await.1;
    let program = format!("Bearer {}", made["token"].as_str().unwrap());
    let me = async || {
        let asked = from_afar(&Method::GET, "/api/v1/me").header(header::AUTHORIZATION, &program);
        server.ask(asked, &Value::Null).await.0
    };
    assert_eq!(me().await, 200);
    assert_eq!(server.send(Method::DELETE, "/api/v1/users/key%20of%20Ada", Value::Null).await.0, 204);
    assert_eq!(me().await, 401);
    // Whoever sits at the machine makes tokens of nobody, and has those.
    let made = server.send(Method::POST, "/api/v1/tokens", new).await.1;
    let listed = server.get("/api/v1/tokens").await;
    assert_eq!((&listed[0]["id"], listed[0].get("of")), (&made["id"], None));
}

#[tokio::test]
async fn ik3_a_secret_is_given_once() {
    let (server, _) = server().await;
    let server = Asking(server);
    let new = json!({ "name": "farm", "role": "viewer" });
    let keyed = || request(&Method::POST, "/api/v1/tokens").header("idempotency-key", "a-key");
    assert_eq!(server.ask(keyed(), &new).await.0, 201);
    let (status, problem, _) = server.ask(keyed(), &new).await;
    assert_eq!((status, &problem["reason"]), (409, &json!("answer-not-kept")));
    let user = json!({ "name": "Ada", "role": "viewer", "password": "correct horse" });
    let keyed = || request(&Method::POST, "/api/v1/users").header("idempotency-key", "another");
    let made = server.ask(keyed(), &user).await;
    assert_eq!(server.ask(keyed(), &user).await, made);
    assert_eq!(server.get("/api/v1/users").await.as_array().unwrap().len(), 1);
}

/// Whoever may do nothing any more still ends what lets others in as them.
#[tokio::test]
async fn ac21_who_has_no_role_any_more_revokes_their_tokens_and_has_another_password() {
    let (server, store) = server().await;
    let server = Asking(server);
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    store.add_user(user("Ada", Role::Editor, password)).await.unwrap();
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let tokens = "/api/v1/tokens";
    let new = json!({ "name": "farm", "role": "viewer" });
    let made = server.as_user(&ada, Method::POST, tokens, new.clone()).await.1;
    let none = json!({ "role": "none" });
    assert_eq!(server.send(Method::PATCH, "/api/v1/users/key%20of%20Ada", none).await.0, 200);
    let listed = server.as_user(&ada, Method::GET, tokens, Value::Null).await.1;
    assert_eq!(listed[0]["id"], made["id"], "{listed}");
    let own = format!("{tokens}/{}", made["id"].as_str().unwrap());
    assert_eq!(server.as_user(&ada, Method::DELETE, &own, Value::Null).await.0, 204);
    assert_eq!(server.as_user(&ada, Method::POST, tokens, new).await.0, 403);
    let change = json!({ "old": "correct horse", "new": "battery staple" });
    assert_eq!(server.as_user(&ada, Method::PUT, "/api/v1/me/password", change).await.0, 204);
}

#[tokio::test]
async fn ac21_somebody_has_a_hundred_tokens_at_most() {
    let (server, _) = server().await;
    let server = Asking(server);
    let new = json!({ "name": "farm", "role": "viewer" });
    for _ in 0..100 {
        assert_eq!(server.send(Method::POST, "/api/v1/tokens", new.clone()).await.0, 201);
    }
    let (_, problem, _) = server.send(Method::POST, "/api/v1/tokens", new).await;
    assert_eq!((&problem["reason"], &problem["field"]), (&json!("too-many"), &json!("name")));
}

#[tokio::test]
async fn ac10_nobody_fills_the_list_of_what_was_done_alone() {
    let (server, store) = server().await;
    let server = Asking(server);
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    for (name, role) in [("Ada", Role::Editor), ("Bo", Role::Owner)] {
        store.add_user(user(name, role, password.clone())).await.unwrap();
    }
    let [ada, bo] = ["Ada", "Bo"].map(|name| server.log_in(name, "correct horse"));
    let (ada, bo) = (ada.await.unwrap(), bo.await.unwrap());
    let make = async |who: &str| {
        let asked = from_afar(&Method::POST, "/api/v1/tokens").header(header::COOKIE, who);
        let new = json!({ "name": "farm", "role": "viewer" });
        server.ask(asked, &new).await
    };
    let revoke = async |who: &str, made: Value| {
        let own = format!("/api/v1/tokens/{}", made["id"].as_str().unwrap());
        server.as_user(who, Method::DELETE, &own, Value::Null).await.0
    };
    for who in [&ada, &bo] {
        let mut last = None;
        for _ in 0..60 {
            let (status, made, _) = make(who).await;
            assert_eq!(status, 201);
            if let Some(before) = last.replace(made) {
                assert_eq!(revoke(who, before).await, 204);
            }
        }
        let (status, problem, _) = make(who).await;
        assert_eq!(
            (status, &problem["reason"], &problem["field"]),
            (429, &json!("too-often"), &json!("path"))
        );
        assert_eq!(server.as_user(who, Method::GET, "/api/v1/tokens", Value::Null).await.0, 200);
        assert_eq!(revoke(who, last.unwrap()).await, 204, "what protects is always let through");
    }
    let asked = from_afar(&Method::POST, "/api/v1/tokens").header(header::COOKIE, &ada);
    let asked = asked.header(header::CONTENT_TYPE, "application/json");
    let new = Body::from(r#"{"name":"farm","role":"viewer"}"#);
    let answer = server.0.clone().oneshot(asked.body(new).unwrap()).await.unwrap();
    let wait: u64 = answer.headers()[header::RETRY_AFTER].to_str().unwrap().parse().unwrap();
    assert!((1..=600).contains(&wait), "{wait}");
    // All of it counts together, but for whoever owns all trees.
    let restore = "/api/v1/trees/ash/versions/1/restore";
    assert_eq!(server.as_user(&ada, Method::POST, restore, json!({})).await.0, 429);
    assert_eq!(server.as_user(&bo, Method::POST, restore, json!({})).await.0, 201);
    // What was refused again is one entry.
    let events = server.get("/api/v1/audit").await;
    let refused = events.as_array().unwrap().iter().filter(|event| event["outcome"] == "429");
    let counted: Vec<_> = refused.map(|event| (&event["action"], &event["times"])).collect();
    assert_eq!(counted.len(), 3, "{events}");
}
