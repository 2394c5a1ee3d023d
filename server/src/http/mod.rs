//! The routes of `PROTOCOL.md`, and the client itself.

mod client;
mod collections;
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
mod trees;
mod versions;

use std::{borrow::Cow, sync::Arc};

use axum::{
    Router,
    extract::{DefaultBodyLimit, Path, State},
    middleware::{from_fn, from_fn_with_state, map_response},
    routing::{MethodRouter, delete, get, patch, post, put},
};
use espalier_proto::version::{MAX_GLB_BYTES, MAX_WOOD_BYTES};
use espalier_session::Principal;
use tokio::sync::Mutex;
use tower::{ServiceBuilder, limit::GlobalConcurrencyLimitLayer};

pub use self::exports::Progresses;
use self::{failure::Failure, guard::Asked};
use crate::{
    authority::{Action, Authority, Object},
    document::{FORMATS, FormatRow},
    live::Sessions,
    pool::SimulationPool,
    portrait::Portraits,
    store::{AnyStore, Store},
};

/// A request for a session is tiny.
const MAX_SMALL_BODY: usize = 4 * 1024;
/// A note of 2000 characters, with room for the rest of the request.
const MAX_SAID_BODY: usize = 32 * 1024;
/// A thumbnail of 192 KiB as base64, with room for the rest of the request.
const MAX_TREE_BODY: usize = 264 * 1024;
/// Uploads at once: each holds a file and its triangles.
const MAX_UPLOADS: usize = 2;
/// Exports made at once: each holds a scene of its own.
const MAX_EXPORTS: usize = 1;

/// Pictures of species made at once: sessions grow on the same threads.
const MAX_PICTURES: usize = 1;
/// Schematics grown at once; each takes some milliseconds.
const MAX_SCHEMATICS: usize = 4;

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
        if (self.authority)(principal, action, object) { Ok(()) } else { Err(Failure::forbidden()) }
    }
}

/// An address of the API, what is asked for there, and how it is answered.
struct Route {
    /// Method and path, in which `{session}` and `{tree}` name what is asked for.
    address: Cow<'static, str>,
    action: Action,
    answer: MethodRouter<Shared>,
}

/// Files of any format, each of which takes as long as it takes.
fn downloads() -> Vec<Route> {
    let exports = GlobalConcurrencyLimitLayer::new(MAX_EXPORTS);
    let take = |row: &'static FormatRow| {
        let answer = get(move |state: State<Shared>, path: Path<String>, query| {
            exports::take(state, path, query, row)
        });
        let address = format!("GET /api/sessions/{{session}}/tree.{}", row.ending).into();
        Route { address, action: Action::TakeTree, answer: answer.layer(exports.clone()) }
    };
    FORMATS.iter().map(take).collect()
}

/// The rest of the API, but for the socket.
fn routes() -> Vec<Route> {
    let route = |address: &'static str, action, answer| Route { address: address.into(), action, answer };
    let at_once = GlobalConcurrencyLimitLayer::new;
    let body = DefaultBodyLimit::max;
    vec![
        route("GET /api/formats", Action::SeeSpecies, get(exports::formats)),
        route("GET /api/sessions/{session}/exports/{ticket}", Action::TakeTree, get(exports::progress)),
        route("POST /api/sessions", Action::BeginSession, post(sessions::create)),
        route("GET /api/sessions/{session}", Action::SeeSession, get(sessions::find)),
        route(
            "POST /api/sessions/{session}/obstacles",
            Action::EditSession,
            post(obstacles::upload).layer((body(MAX_GLB_BYTES), at_once(MAX_UPLOADS))),
        ),
        route("GET /api/sessions/{session}/obstacles/{id}", Action::SeeObstacle, get(obstacles::mesh)),
        route("GET /api/species", Action::SeeSpecies, get(species::list)),
        route(
            "GET /api/species/{slug}/picture",
            Action::SeeSpecies,
            get(species::picture).layer(at_once(MAX_PICTURES)),
        ),
        route(
            "POST /api/schematic",
            Action::DrawSchematic,
            post(schematic::draw).layer(at_once(MAX_SCHEMATICS)),
        ),
        route("GET /api/trees", Action::ListTrees, get(trees::list)),
        route("POST /api/trees", Action::SaveTree, post(trees::save).layer(body(MAX_TREE_BODY))),
        route(
            "POST /api/trees/import",
            Action::SaveTree,
            post(imports::upload).layer((body(MAX_WOOD_BYTES), at_once(MAX_UPLOADS))),
        ),
        route("GET /api/trees/{tree}", Action::SeeTree, get(trees::find)),
        route("PATCH /api/trees/{tree}", Action::ChangeTree, patch(trees::change).layer(body(MAX_SAID_BODY))),
        route("DELETE /api/trees/{tree}", Action::DeleteTree, delete(trees::delete)),
        route("POST /api/trees/{tree}/undelete", Action::DeleteTree, post(trees::undelete)),
        route(
            "POST /api/trees/{tree}/copies",
            Action::OpenTree,
            post(trees::copy).layer(body(MAX_SAID_BODY)),
        ),
        route("PUT /api/trees/{tree}/favourite", Action::SeeTree, put(collections::like)),
        route("DELETE /api/trees/{tree}/favourite", Action::SeeTree, delete(collections::unlike)),
        route("GET /api/tags", Action::ListTrees, get(collections::tags)),
        route("GET /api/authors", Action::ListTrees, get(collections::authors)),
        route("GET /api/collections", Action::ListTrees, get(collections::list)),
        route("POST /api/collections", Action::ChangeCollections, post(collections::add)),
        route("PATCH /api/collections/{id}", Action::ChangeCollections, patch(collections::change)),
        route("DELETE /api/collections/{id}", Action::ChangeCollections, delete(collections::delete)),
        route("GET /api/trees/{tree}/versions", Action::SeeTree, get(versions::list)),
        route(
            "POST /api/trees/{tree}/versions",
            Action::ChangeTree,
            post(versions::save).layer(body(MAX_TREE_BODY)),
        ),
        route(
            "PATCH /api/trees/{tree}/versions/{number}",
            Action::ChangeTree,
            patch(versions::change).layer(body(MAX_SAID_BODY)),
        ),
        route(
            "POST /api/trees/{tree}/versions/{number}/restore",
            Action::ChangeTree,
            post(versions::restore),
        ),
        route("GET /api/trees/{tree}/versions/{number}/document", Action::OpenTree, get(versions::document)),
        route("GET /api/trees/{tree}/versions/{number}/thumbnail", Action::SeeTree, get(versions::thumbnail)),
    ]
}

const SOCKET: &str = "GET /api/sessions/{session}/socket";

fn path_of(address: &str) -> &str {
    address.split_once(' ').map_or(address, |(_, path)| path)
}

/// Everything the server answers.
pub fn router(shared: Shared) -> Router {
    let authority = shared.authority;
    let asks = |action| from_fn_with_state(Asked { authority, action }, guard::ask);
    let api = |routes: Vec<Route>| {
        routes.into_iter().fold(Router::new(), |router, Route { address, action, answer }| {
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
            ("/api/sessions", r#"{"tree":"ash"}"#),
            ("/api/trees", r#"{"session":"oak","name":"Oak"}"#),
            ("/api/trees/ash/versions", r#"{"session":"oak"}"#),
            ("/api/trees/ash/copies", r#"{"name":"Oak"}"#),
            ("/api/sessions/oak/tree.glb", ""),
            ("/api/sessions/oak/tree.json", ""),
        ] {
            let method = if body.is_empty() { Method::GET } else { Method::POST };
            assert_eq!(status(&server, &method, path, body).await, StatusCode::FORBIDDEN, "{path}");
        }
        let new = status(&server, &Method::POST, "/api/sessions", r#"{"seed":1}"#).await;
        assert_eq!(new, StatusCode::CREATED);
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
            let mut request = Request::builder().uri("/api/trees");
            if let Some(key) = key {
                request = request.header(guard::CLIENT, key);
            }
            let answer = server.clone().oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
            assert_eq!(answer.status(), expected, "{key:?}");
        }
    }

    #[test]
    fn the_protocol_lists_every_address() {
        let protocol = include_str!("../../../proto/PROTOCOL.md");
        let (_, table) = protocol.split_once("\n## HTTP\n").unwrap();
        let rows = table.split("\n## ").next().unwrap().lines().filter_map(|line| line.strip_prefix("| `"));
        let listed: BTreeSet<String> = rows
            .filter_map(|row| row.split('`').next())
            .filter(|row| row.contains("/api/"))
            .map(str::to_owned)
            .collect();
        let named = |address: &str| {
            let address = address.replace("{session}", "NAME").replace("{slug}", "SLUG");
            let address = address.replace("{tree}", "ID").replace("{id}", "ID").replace("{number}", "N");
            address.replace("{ticket}", "TICKET")
        };
        let all = routes().into_iter().chain(downloads()).map(|route| route.address);
        let answered = all.chain([SOCKET.into()]);
        assert_eq!(listed, answered.map(|address| named(&address)).collect());
    }
}
