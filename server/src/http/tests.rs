mod audit;
mod comments;
mod files;
mod grammars;
mod jobs;
mod keys;
mod links;
mod login;
mod members;
mod paths;
mod people;
mod proxies;
mod refusals;
mod session_list;
mod standings;
mod status;

use std::collections::BTreeSet;

use axum::{
    body::Body,
    http::{HeaderName, Method, Request, StatusCode, header, request::Builder},
};
use espalier_proto::{access::Role, library::TreePage};
use serde_json::{Value, json};
use tokio_util::sync::CancellationToken;
use tower::ServiceExt;

use super::*;
use crate::{
    access::{Caller, Peer, Reach, Secret, admission::TOKEN},
    drawn::DrawnPictures,
    export_options::ExportOptions,
    formats::FORMATS,
    jobs::Order,
    name,
    recipe::Recipe,
    store::{Collection, Finding, Library, NewSession, Pass, PassKind, Passes, Store, tree},
};

async fn server() -> (Router, Arc<AnyStore>) {
    let shared = shared().await;
    let store = Arc::clone(&shared.store);
    (router(shared), store)
}

async fn shared() -> Shared {
    let store = Arc::new(AnyStore::Memory(Box::default()));
    let pool = SimulationPool::new(None).unwrap();
    for (id, at) in [("ash", "2026-05-01T09:00:00.000Z"), ("yew", "2026-05-01T09:00:00.001Z")] {
        store.add_tree(tree(id, at)).await.unwrap();
    }
    for (name, tree) in [("oak", None), ("ashen", Some(("ash".to_owned(), 1)))] {
        let name = name.to_owned();
        let new = NewSession { name, seed: 1, simulation_version: 1, tree, ..NewSession::default() };
        store.create_session(new).await.unwrap();
    }
    let wood = Collection { id: "wood".into(), name: "Wood".into(), parent: None, trees: 0 };
    store.add_collection(wood).await.unwrap();
    // Nobody does jobs here.
    let memory = Memory::of(1 << 40);
    let jobs = Jobs::new(pool.clone(), memory.clone(), CancellationToken::new());
    jobs.add_named(JOB.into(), order(Caller::local())).unwrap();
    Shared {
        jobs,
        sessions: Sessions::new(Arc::clone(&store), pool.clone(), memory.clone(), CancellationToken::new()),
        memory,
        requests: Requests::default(),
        store: Arc::clone(&store),
        pool,
        metamer_budget: 1000,
        portraits: Portraits::default(),
        drawn: DrawnPictures::default(),
        ahead: Ahead::default(),
        hosts: Hosts::new(&[]),
        addresses: Arc::new([AT.into()]),
        proxies: Proxies::new(&[IpAddr::from(PROXY).into()]),
        trusts_local: true,
        tries: Arc::default(),
        tries_for: Arc::default(),
        sessions_begun: Arc::default(),
        comments_written: Arc::default(),
        noted_done: Arc::default(),
        names_tried: Arc::default(),
        standings: watch::Sender::default(),
        logins: Arc::default(),
        passwords: Arc::default(),
        opening: Arc::default(),
        tidying: Arc::default(),
        progresses: Progresses::default(),
        rooms: rooms(),
        turns: Turns::default(),
        under_way: UnderWay::default(),
    }
}

/// Where other machines reach the server.
const AT: &str = "http://192.168.1.5:7700";

/// Where the proxy is.
const PROXY: [u8; 4] = [10, 0, 0, 1];

/// The name of a job.
const JOB: &str = "a-job";

fn order(by: Caller) -> Order {
    let recipe = Recipe::default();
    let (row, options) = (&FORMATS[0], ExportOptions::default());
    Order {
        by,
        recipe,
        seeds: vec![1],
        species: None,
        row,
        options,
        left_out: espalier_session::LeftOut::default(),
    }
}

/// A token of somebody with this role, for one tree or for all.
async fn token(store: &AnyStore, role: Role, tree: Option<&str>) -> String {
    let secret = Secret::long(TOKEN);
    let pass = Pass {
        id: name::unguessable(),
        kind: PassKind::Token,
        name: "script".into(),
        role,
        holder: None,
        most: None,
        tree: tree.map(str::to_owned),
        created_at: "2026".into(),
        expires_at: "9".into(),
        ends_at: "9".into(),
    };
    store.add_pass(secret.hash(), pass).await.unwrap();
    format!("Bearer {}", secret.text())
}

/// A request of somebody at this machine.
fn request(method: &Method, path: &str) -> Builder {
    let request = Request::builder().method(method).uri(path).header(header::HOST, "localhost:7700");
    request.extension(Peer([127, 0, 0, 1].into()))
}

/// The same of whoever has a token.
fn request_of(token: &str, method: &Method, path: &str) -> Builder {
    request(method, path).header(header::AUTHORIZATION, token)
}

async fn status(server: &Router, request: Builder, body: &'static str) -> StatusCode {
    let request = request.header(header::CONTENT_TYPE, "application/json");
    server.clone().oneshot(request.body(Body::from(body)).unwrap()).await.unwrap().status()
}

fn method_of(address: &str) -> Method {
    address.split(' ').next().unwrap().parse().unwrap()
}

fn filled(path: &str) -> String {
    path.replace("{session}", "oak")
        .replace("{tree}", "ash")
        .replace("{collection}", "wood")
        .replace("{obstacle}", "1")
        .replace("{ticket}", "a-ticket-of-nobody")
        .replace("{slug}", "of-no-species")
        .replace("{name}", "of-no-grammar")
        .replace("{version}", "1")
        .replace("{job}", JOB)
        .replace("{link}", "a-link")
        .replace("{person}", "1")
        .replace("{removal}", "a-removal")
        .replace("{thread}", "1")
        .replace("{comment}", "1")
        .replace("{seed}", "1")
        .replace("{user}", "a-user")
        .replace("{group}", "a-group")
        .replace("{token}", "a-token")
        .replace("{member}", "a-member")
}

#[tokio::test]
async fn ac2_whoever_is_not_let_in_gets_the_page_alone() {
    let (server, _) = server().await;
    let stranger =
        |method: &Method, path: &str| request(method, path).extension(Peer([192, 168, 1, 9].into()));
    let expected = (StatusCode::UNAUTHORIZED, Some("not-let-in".into()));
    for Route { address, action, .. } in routes().into_iter().chain(downloads()) {
        let asked = stranger(&method_of(&address), &filled(path_of(&address)));
        let found = reason(&server, asked).await;
        assert_eq!(found == expected, action.is_some(), "{address}: {found:?}");
    }
    for path in ["/", "/pair", "/s/oak", "/icon.svg", "/health"] {
        let found = reason(&server, stranger(&Method::GET, path)).await;
        assert_eq!(found.0, StatusCode::OK, "{path}");
    }
}

/// Each row of the table at each address, for people to whom all trees are open and for guests of one.
#[tokio::test]
async fn au1_every_role_may_at_every_address_what_the_table_says() {
    let (server, store) = server().await;
    for role in Role::ALL {
        for only in [None, Some("ash"), Some("yew")] {
            let token = token(&store, role, only).await;
            for Route { address, action, .. } in routes().into_iter().chain(downloads()) {
                let Some(action) = action else { continue };
                let reaches = match only {
                    None => true,
                    Some(_) if address.contains("{session}") => false,
                    Some(tree) if address.contains("{tree}") => tree == "ash",
                    Some(_) => action.reach() == Reach::Guests,
                };
                // What nobody can take back is for owners of the server.
                let is_for_all = only.is_none() || !address.ends_with("/for-good");
                let may = reaches && is_for_all && role >= action.least();
                // A moving picture as large as it is by default takes long to draw.
                let path = filled(path_of(&address)).replace(".sway.png", ".sway.png?size=40x40&frames=2");
                let mut asked = request_of(&token, &method_of(&address), &path);
                if address.ends_with("/for-good") {
                    // Others are still to ask for the tree.
                    asked = asked.header(header::IF_MATCH, "\"0\"");
                }
                let found = status(&server, asked, "").await;
                assert_eq!(found != StatusCode::FORBIDDEN, may, "{role:?} of {only:?}: {address} {found}");
                assert_ne!(found, StatusCode::UNAUTHORIZED, "{role:?} of {only:?}: {address}");
            }
        }
    }
}

#[tokio::test]
async fn au1_what_a_request_names_is_asked_for_as_well() {
    let (server, store) = server().await;
    let token = token(&store, Role::Owner, Some("ash")).await;
    for (path, body, may) in [
        ("/api/v1/sessions", r#"{"tree":"ash"}"#, true),
        ("/api/v1/sessions", r#"{"tree":"yew"}"#, false),
        ("/api/v1/sessions", r#"{"tree":"ash","template":true}"#, false),
        ("/api/v1/sessions", "{}", false),
        ("/api/v1/trees/ash/versions", r#"{"session":"ashen"}"#, true),
        ("/api/v1/trees/ash/versions", r#"{"session":"oak"}"#, false),
        ("/api/v1/trees/ash/copies", r#"{"name":"Oak"}"#, false),
    ] {
        let found = status(&server, request_of(&token, &Method::POST, path), body).await;
        assert_eq!(found != StatusCode::FORBIDDEN, may, "{path} {body}: {found}");
    }
    for (path, may) in [("/api/v1/sessions/ashen", true), ("/api/v1/sessions/oak", false)] {
        let found = status(&server, request_of(&token, &Method::GET, path), "").await;
        assert_eq!(found != StatusCode::FORBIDDEN, may, "{path}: {found}");
    }
}

#[tokio::test]
async fn lb3_whoever_opens_a_tree_waits_for_nobody_who_opens_another() {
    let shared = shared().await;
    let opening = shared.opening.of("ash").await;
    let begin = async |tree: &str| {
        let body = json!({ "tree": tree }).to_string();
        let asked =
            request(&Method::POST, "/api/v1/sessions").header(header::CONTENT_TYPE, "application/json");
        router(shared.clone()).oneshot(asked.body(Body::from(body)).unwrap()).await.unwrap().status()
    };
    // What is kept here is no plant; that is found out when it is opened.
    assert_eq!(begin("yew").await, StatusCode::CONFLICT);
    let same = begin("ash");
    tokio::pin!(same);
    for _ in 0..100 {
        assert!(futures_util::poll!(&mut same).is_pending(), "one at a time");
        tokio::task::yield_now().await;
    }
    drop(opening);
    same.await;
}

#[tokio::test]
async fn rg1_a_document_is_sent_in_parts() {
    let (server, _) = server().await;
    let import = request(&Method::POST, "/api/v1/trees/ash/versions/import?format=csv");
    let tree = include_str!("../../../tests/fuzz/seeds/rtwig.csv");
    assert_eq!(status(&server, import, tree).await, StatusCode::CREATED);
    let path = "/api/v1/trees/ash/versions/2/document";
    let ask = async |range: Option<&str>| {
        let asked = request(&Method::GET, path);
        let asked = range.into_iter().fold(asked, |asked, range| asked.header(header::RANGE, range));
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        let status = answer.status();
        (status, axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap())
    };
    let (status, whole) = ask(None).await;
    assert_eq!(status, StatusCode::OK);
    assert_eq!(ask(Some("bytes=1-")).await, (StatusCode::PARTIAL_CONTENT, whole.slice(1..)));
    assert_eq!(ask(Some("bytes=1000000-")).await.0, StatusCode::RANGE_NOT_SATISFIABLE);
}

/// What is downloaded has a tag, by which the rest of it is asked for, and which another file does not have.
#[tokio::test]
async fn rg1_every_download_goes_on_where_it_was_cut_off() {
    let (server, _) = server().await;
    let import = request(&Method::POST, "/api/v1/trees/ash/versions/import?format=csv");
    let tree = include_str!("../../../tests/fuzz/seeds/rtwig.csv");
    assert_eq!(status(&server, import, tree).await, StatusCode::CREATED);
    let get = async |path: &str, more: &[(HeaderName, &str)]| {
        let asked =
            more.iter().fold(request(&Method::GET, path), |asked, (name, value)| asked.header(name, *value));
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        let (head, body) = answer.into_parts();
        let tag = head.headers.get(header::ETAG).map(|tag| tag.to_str().unwrap().to_owned());
        (head.status, tag.unwrap_or_default(), axum::body::to_bytes(body, usize::MAX).await.unwrap())
    };
    let mut seen = BTreeSet::new();
    for path in [
        "/api/v1/trees/ash/versions/2/document",
        "/api/v1/trees/ash/versions/2/tree.csv",
        "/api/v1/trees/ash/versions/2/tree.glb",
        "/api/v1/trees/ash/versions/2/tree.glb?lod=2",
        "/api/v1/species/oak/picture",
        "/api/v1/grammars/koch/picture",
    ] {
        let (status, tag, whole) = get(path, &[]).await;
        assert_eq!(status, StatusCode::OK, "{path}");
        assert!(tag.len() > 2 && tag.starts_with('"') && seen.insert(tag.clone()), "{path}: {tag}");
        let range = (header::RANGE, "bytes=10-");
        let rest = get(path, &[range.clone(), (header::IF_RANGE, &tag)]).await;
        assert_eq!(rest, (StatusCode::PARTIAL_CONTENT, tag.clone(), whole.slice(10..)), "{path}");
        let other = get(path, &[range, (header::IF_RANGE, "\"of another\"")]).await;
        assert_eq!(other, (StatusCode::OK, tag, whole), "{path}");
    }
}

#[tokio::test]
async fn ac7_whoever_guesses_waits() {
    let (server, _) = server().await;
    let guess = || {
        let request = request(&Method::POST, "/api/v1/redeem").extension(Peer([192, 168, 1, 9].into()));
        let request = request.header(header::CONTENT_TYPE, "application/json");
        server.clone().oneshot(request.body(Body::from(r#"{"secret":"guess"}"#)).unwrap())
    };
    for _ in 0..5 {
        assert_eq!(guess().await.unwrap().status(), StatusCode::NOT_FOUND);
    }
    let refused = guess().await.unwrap();
    assert_eq!(refused.status(), StatusCode::TOO_MANY_REQUESTS);
    let wait: u64 = refused.headers()[header::RETRY_AFTER].to_str().unwrap().parse().unwrap();
    assert!((1..=30).contains(&wait), "{wait}");
    let others = request(&Method::POST, "/api/v1/redeem");
    assert_eq!(status(&server, others, r#"{"secret":"guess"}"#).await, StatusCode::NOT_FOUND);
}

#[tokio::test]
async fn ac5_a_guest_lists_their_tree_alone() {
    let (server, store) = server().await;
    let token = token(&store, Role::Viewer, Some("ash")).await;
    for (asked, expected) in [
        (request(&Method::GET, "/api/v1/trees"), vec!["yew", "ash"]),
        (request_of(&token, &Method::GET, "/api/v1/trees"), vec!["ash"]),
        (request_of(&token, &Method::GET, "/api/v1/trees?q=yew"), vec![]),
    ] {
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let page: TreePage = serde_json::from_slice(&bytes).unwrap();
        assert_eq!(page.trees.iter().map(|tree| &*tree.id).collect::<Vec<_>>(), expected);
    }
}

#[tokio::test]
async fn ac5_a_guest_whose_tree_is_deleted_is_told_of_no_other() {
    let (server, store) = server().await;
    let guest = token(&store, Role::Editor, Some("ash")).await;
    let renamed = status(&server, request(&Method::PATCH, "/api/v1/trees/yew"), r#"{"name":"Ashh"}"#).await;
    assert_eq!(renamed, StatusCode::OK);
    let deleted = status(&server, request(&Method::DELETE, "/api/v1/trees/ash"), "").await;
    assert_eq!(deleted, StatusCode::NO_CONTENT);
    for (asked, expected) in [
        (request(&Method::PATCH, "/api/v1/trees/ash"), "There is no such tree; did you mean yew"),
        (request_of(&guest, &Method::PATCH, "/api/v1/trees/ash"), "There is no such tree."),
    ] {
        let asked = asked.header(header::CONTENT_TYPE, "application/json");
        let asked = asked.body(Body::from(r#"{"name":"Oak"}"#)).unwrap();
        let answer = server.clone().oneshot(asked).await.unwrap();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let problem: Value = serde_json::from_slice(&bytes).unwrap();
        let message = problem["detail"].as_str().unwrap();
        assert!(message.starts_with(expected), "{message}");
    }
}

#[tokio::test]
async fn ac8_everybody_is_told_what_they_may() {
    let (server, store) = server().await;
    let guest = token(&store, Role::Viewer, Some("ash")).await;
    for (asked, expected) in [
        (request(&Method::GET, "/api/v1/me"), json!({ "role": "admin", "way": "machine" })),
        (
            request_of(&guest, &Method::GET, "/api/v1/me"),
            json!({ "role": "viewer", "way": "token", "name": "script", "tree": "ash" }),
        ),
    ] {
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        assert_eq!(serde_json::from_slice::<Value>(&bytes).unwrap(), expected);
    }
}

#[tokio::test]
async fn ac6_a_token_decides_alone_and_never_beside_a_cookie() {
    let (server, store) = server().await;
    let token = token(&store, Role::Viewer, None).await;
    let delete = |token: &str| request_of(token, &Method::DELETE, "/api/v1/trees/ash");
    assert_eq!(
        status(&server, delete(&token), "").await,
        StatusCode::FORBIDDEN,
        "also at the machine itself"
    );
    let both = delete(&token).header(header::COOKIE, "espalier-7700=x");
    assert_eq!(status(&server, both, "").await, StatusCode::BAD_REQUEST);
    let wrong = delete("Bearer esp_of-nobody");
    assert_eq!(status(&server, wrong, "").await, StatusCode::UNAUTHORIZED);
}

#[tokio::test]
async fn lm17_whoever_begins_many_sessions_waits() {
    let (server, store) = server().await;
    let [one, other] = [token(&store, Role::Editor, None).await, token(&store, Role::Editor, None).await];
    let begin = |token: &str| {
        let begin = request_of(token, &Method::POST, "/api/v1/sessions");
        server
            .clone()
            .oneshot(begin.header(header::CONTENT_TYPE, "application/json").body(Body::from("{}")).unwrap())
    };
    let begun = async |token: &str| {
        let mut begun = 0;
        while begun < 1000 && begin(token).await.unwrap().status() == StatusCode::CREATED {
            begun += 1;
        }
        begun
    };
    assert!((20..1000).contains(&begun(&one).await));
    let refused = begin(&one).await.unwrap();
    assert_eq!(refused.status(), StatusCode::TOO_MANY_REQUESTS);
    assert!(refused.headers().contains_key(header::RETRY_AFTER));
    assert_eq!(begin(&other).await.unwrap().status(), StatusCode::CREATED, "others are free");
    for _ in 0..100 {
        let local = request(&Method::POST, "/api/v1/sessions");
        assert_eq!(status(&server, local, "{}").await, StatusCode::CREATED, "and so is the machine");
    }
}

async fn reason(server: &Router, request: Builder) -> (StatusCode, Option<String>) {
    let answer = server.clone().oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
    let status = answer.status();
    let kind = answer.headers().get(header::CONTENT_TYPE).cloned();
    assert!(status.is_success() || kind.is_some_and(|kind| kind == espalier_proto::PROBLEM_JSON), "{status}");
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    let problem: Value = serde_json::from_slice(&bytes).unwrap_or_default();
    (status, problem["reason"].as_str().map(str::to_owned))
}

#[tokio::test]
async fn gu1_nothing_is_answered_under_another_name() {
    let (server, _) = server().await;
    for path in ["/", "/s/oak", "/icon.svg", "/health", "/nothing", "/api/v1/trees"] {
        for host in [Some("evil.example:7700"), None] {
            let request = Request::builder().uri(path);
            let request = host.into_iter().fold(request, |request, host| request.header(header::HOST, host));
            let expected = (StatusCode::MISDIRECTED_REQUEST, Some("unknown-host".into()));
            assert_eq!(reason(&server, request).await, expected, "{path} at {host:?}");
        }
    }
}

#[tokio::test]
async fn gu2_pages_of_other_sites_get_nothing_of_the_api() {
    let (server, _) = server().await;
    let refused = (StatusCode::FORBIDDEN, Some("other-site".into()));
    let site = HeaderName::from_static("sec-fetch-site");
    for (name, value) in [(site.clone(), "cross-site"), (header::ORIGIN, "http://evil.example")] {
        for Route { address, .. } in routes().into_iter().chain(downloads()) {
            let request = request(&method_of(&address), &filled(path_of(&address))).header(&name, value);
            assert_eq!(reason(&server, request).await, refused, "{address}");
        }
        let socket =
            request(&Method::GET, "/api/v1/sessions/oak/socket").header(header::UPGRADE, "websocket");
        assert_eq!(reason(&server, socket.header(&name, value)).await, refused);
        assert_eq!(reason(&server, request(&Method::POST, "/").header(&name, value)).await, refused);
        // A link leads to the page.
        for path in ["/", "/s/oak", "/icon.svg", "/health"] {
            let found = reason(&server, request(&Method::GET, path).header(&name, value)).await;
            assert_eq!(found.0, StatusCode::OK, "{path}");
        }
    }
    let own = request(&Method::GET, "/api/v1/trees").header(site, "same-origin");
    assert_eq!(reason(&server, own).await.0, StatusCode::OK);
}

#[tokio::test]
async fn au1_a_key_that_is_none_is_refused() {
    let (server, _) = server().await;
    for (key, expected) in [
        (Some("browser-1"), StatusCode::OK),
        (None, StatusCode::OK),
        (Some("short"), StatusCode::BAD_REQUEST),
        (Some("outside"), StatusCode::BAD_REQUEST),
    ] {
        let asked = request(&Method::GET, "/api/v1/trees");
        let asked = key.into_iter().fold(asked, |asked, key| asked.header(guard::CLIENT, key));
        assert_eq!(status(&server, asked, "").await, expected, "{key:?}");
    }
}
