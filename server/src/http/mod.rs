//! The routes of `PROTOCOL.md`, and the client itself.

mod addresses;
mod client;
mod collections;
mod description;
mod exports;
mod failure;
mod guard;
mod imports;
mod obstacles;
mod revision;
mod schematic;
mod sessions;
mod species;
mod text;
mod time;
mod trees;
mod versions;

use std::sync::Arc;

use axum::{
    Router,
    extract::{DefaultBodyLimit, State},
    middleware::{from_fn, from_fn_with_state, map_response},
    routing::get,
};
use espalier_session::Principal;
use tokio::sync::Mutex;
use tower::ServiceBuilder;

pub use self::exports::Progresses;
use self::{
    addresses::{Route, SOCKET, downloads, path_of, routes},
    failure::Failure,
    guard::Asked,
};
use crate::{
    authority::{Action, Authority, Object},
    live::Sessions,
    pool::SimulationPool,
    portrait::Portraits,
    store::{AnyStore, Store},
};

/// A request for a session is tiny.
const MAX_SMALL_BODY: usize = 4 * 1024;

/// What the handlers work with.
#[derive(Clone, Debug)]
pub struct Shared {
    /// What is kept.
    pub store: Arc<AnyStore>,
    /// The sessions in memory.
    pub sessions: Sessions,
    /// For what takes long.
    pub pool: SimulationPool,
    /// Metamers that each session begun here may hold.
    pub metamer_budget: u32,
    /// Pictures of the species.
    pub portraits: Portraits,
    /// Who may do what.
    pub authority: Authority,
    /// Held by whoever opens a tree.
    pub opening: Arc<Mutex<()>>,
    /// How far exports are.
    pub progresses: Progresses,
}

impl Shared {
    /// Asks for what a request names in its body; its address has been asked for before.
    fn ask(&self, principal: &Principal, action: Action, object: Object<'_>) -> Result<(), Failure> {
        if (self.authority)(principal, action, object) {
            Ok(())
        } else {
            Err(espalier_session::forbidden().into())
        }
    }
}

/// Everything the server answers.
pub fn router(shared: Shared) -> Router {
    let authority = shared.authority;
    let asks = |action| from_fn_with_state(Asked { authority, action }, guard::ask);
    let api = |routes: Vec<Route>| {
        routes.into_iter().fold(Router::new(), |router, Route { address, action, answer, .. }| {
            router.route(path_of(&address), answer.layer(asks(action)))
        })
    };
    let requests = api(routes())
        .route("/api/{*unknown}", get(failure::unknown_route))
        .route("/health", get(health))
        .layer(DefaultBodyLimit::max(MAX_SMALL_BODY))
        .layer(from_fn(guard::time_limit));
    Router::new()
        .merge(requests)
        // Whoever no longer waits closes the connection, and that ends the work.
        .merge(api(downloads()))
        // A socket lasts as long as its drawing, so no time limit holds here. Who comes is known by its hello: the session
        // asks then.
        .route(path_of(SOCKET), get(sessions::socket))
        .route("/", get(client::page))
        .route("/s/{name}", get(client::page))
        .fallback(client::file)
        .layer(ServiceBuilder::new().layer(map_response(guard::headers)).layer(from_fn(guard::same_origin)))
        .with_state(shared)
}

/// Whether the server can serve: what is drawn gets where it is kept.
async fn health(State(shared): State<Shared>) -> Result<&'static str, Failure> {
    shared.store.check_place().await?;
    Ok("ok")
}

#[cfg(test)]
mod tests {
    mod refusals;

    use std::collections::BTreeSet;

    use axum::{
        body::Body,
        http::{Method, Request, StatusCode, header},
    };
    use tokio_util::sync::CancellationToken;
    use tower::ServiceExt;

    use super::*;
    use crate::{
        authority,
        store::{Library, MemoryStore, NewSession, Store, tree},
    };

    async fn server(authority: Authority) -> Router {
        let store = Arc::new(AnyStore::Memory(MemoryStore::default()));
        let pool = SimulationPool::new(None).unwrap();
        let oak = NewSession { name: "oak".into(), seed: 1, simulation_version: 1, ..NewSession::default() };
        store.create_session(oak).await.unwrap();
        store.add_tree(tree("ash", "2026-05-01T09:00:00.000Z")).await.unwrap();
        router(Shared {
            sessions: Sessions::new(Arc::clone(&store), pool.clone(), authority, CancellationToken::new()),
            store,
            pool,
            metamer_budget: 1000,
            portraits: Portraits::default(),
            authority,
            opening: Arc::default(),
            progresses: Progresses::default(),
        })
    }

    async fn status(server: &Router, method: &Method, path: &str, body: &'static str) -> StatusCode {
        let request =
            Request::builder().method(method).uri(path).header(header::CONTENT_TYPE, "application/json");
        server.clone().oneshot(request.body(Body::from(body)).unwrap()).await.unwrap().status()
    }

    fn method_of(address: &str) -> Method {
        address.split(' ').next().unwrap().parse().unwrap()
    }

    fn filled(path: &str) -> String {
        path.replace("{session}", "oak")
            .replace("{tree}", "ash")
            .replace("{id}", "1")
            .replace("{ticket}", "a-ticket-of-nobody")
            .replace("{slug}", "oak")
            .replace("{number}", "1")
    }

    #[tokio::test]
    async fn au1_every_address_asks_whether_one_may() {
        let (closed, open) = (server(|_, _, _| false).await, server(authority::may).await);
        for Route { address, .. } in routes().into_iter().chain(downloads()) {
            let (method, path) = (method_of(&address), filled(path_of(&address)));
            assert_eq!(status(&closed, &method, &path, "").await, StatusCode::FORBIDDEN, "{address}");
            assert_ne!(status(&open, &method, &path, "").await, StatusCode::FORBIDDEN, "{address}");
        }
    }

    #[tokio::test]
    async fn what_a_request_names_is_asked_for_as_well() {
        let server = server(|_, action, object| match object {
            Object::Session(name) => name != "oak" || action != Action::TakeTree,
            Object::Tree(id) => id != "ash" || action != Action::OpenTree,
            Object::Server => true,
        })
        .await;
        for (path, body) in [
            ("/api/v1/sessions", r#"{"tree":"ash"}"#),
            ("/api/v1/trees", r#"{"session":"oak","name":"Oak"}"#),
            ("/api/v1/trees/ash/versions", r#"{"session":"oak"}"#),
            ("/api/v1/trees/ash/copies", r#"{"name":"Oak"}"#),
            ("/api/v1/sessions/oak/tree.glb", ""),
            ("/api/v1/sessions/oak/tree.json", ""),
        ] {
            let method = if body.is_empty() { Method::GET } else { Method::POST };
            assert_eq!(status(&server, &method, path, body).await, StatusCode::FORBIDDEN, "{path}");
        }
        let new = status(&server, &Method::POST, "/api/v1/sessions", r#"{"seed":1}"#).await;
        assert_eq!(new, StatusCode::CREATED);
    }

    #[tokio::test]
    async fn what_is_not_there_is_told_from_what_it_was_to_lie_in() {
        let server = server(authority::may).await;
        for (method, path, body, reason, field) in [
            (
                Method::PATCH,
                "/api/v1/trees/ash",
                r#"{"collection":"none"}"#,
                "no-collection",
                Some("collection"),
            ),
            (Method::PATCH, "/api/v1/trees/elm", r#"{"note":"Old"}"#, "no-tree", None),
            (
                Method::POST,
                "/api/v1/collections",
                r#"{"name":"Woods","parent":"none"}"#,
                "no-collection",
                Some("parent"),
            ),
            (Method::PATCH, "/api/v1/collections/none", r#"{"name":"Woods"}"#, "no-collection", Some("id")),
            (Method::DELETE, "/api/v1/collections/none", "", "no-collection", Some("id")),
        ] {
            let request = Request::builder().method(&method).uri(path);
            let request =
                request.header(header::CONTENT_TYPE, "application/json").body(Body::from(body)).unwrap();
            let answer = server.clone().oneshot(request).await.unwrap();
            assert_eq!(answer.status(), StatusCode::NOT_FOUND, "{method} {path}");
            let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
            let problem: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
            assert_eq!(
                (problem["reason"].as_str(), problem["field"].as_str()),
                (Some(reason), field),
                "{method} {path}"
            );
        }
    }

    #[tokio::test]
    async fn au1_who_asks_is_known_by_a_key() {
        let server = server(|principal, _, _| principal.to_string() == "browser-1").await;
        for (key, expected) in [
            (Some("browser-1"), StatusCode::OK),
            (Some("browser-2"), StatusCode::FORBIDDEN),
            (None, StatusCode::FORBIDDEN),
            (Some("short"), StatusCode::BAD_REQUEST),
            (Some("outside"), StatusCode::BAD_REQUEST),
        ] {
            let mut request = Request::builder().uri("/api/v1/trees");
            if let Some(key) = key {
                request = request.header(guard::CLIENT, key);
            }
            let answer = server.clone().oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
            assert_eq!(answer.status(), expected, "{key:?}");
        }
    }
}
