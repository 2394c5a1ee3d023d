//! The routes of `PROTOCOL.md`, and the client itself.

mod client;
mod failure;
mod guard;
mod obstacles;
mod schematic;
mod sessions;
mod species;
mod thumbnail;
mod trees;

use std::sync::Arc;

use axum::{
    Router,
    extract::DefaultBodyLimit,
    middleware::{from_fn, map_response},
    routing::{get, patch, post},
};
use espalier_proto::version::MAX_GLB_BYTES;
use tower::{ServiceBuilder, limit::GlobalConcurrencyLimitLayer};

use crate::{database::Database, live::Sessions, pool::SimulationPool, portrait::Portraits};

/// A request for a session or a name is tiny.
const MAX_SMALL_BODY: usize = 4 * 1024;
/// A thumbnail of 192 KiB as base64, with room for the rest of the request.
const MAX_TREE_BODY: usize = 264 * 1024;
/// Uploads at once: each holds a file and its triangles.
const MAX_UPLOADS: usize = 2;
/// Exports at once: each holds the triangles of a whole scene, hundreds of megabytes at worst.
const MAX_EXPORTS: usize = 1;

/// Pictures of species made at once: sessions grow on the same threads.
const MAX_PICTURES: usize = 1;
/// Schematics grown at once; each takes some milliseconds.
const MAX_SCHEMATICS: usize = 4;

/// What the handlers work with.
#[derive(Clone, Debug)]
pub struct Shared {
    /// The library.
    pub database: Arc<Database>,
    /// The sessions in memory.
    pub sessions: Sessions,
    /// For what takes long.
    pub pool: SimulationPool,
    /// Metamers that each session begun here may hold.
    pub metamer_budget: u32,
    /// Pictures of the species.
    pub portraits: Portraits,
}

/// Everything the server answers.
pub fn router(shared: Shared) -> Router {
    let requests = Router::new()
        .route("/api/sessions", post(sessions::create))
        .route("/api/sessions/{name}", get(sessions::find))
        .route(
            "/api/sessions/{name}/tree.glb",
            get(sessions::export).layer(GlobalConcurrencyLimitLayer::new(MAX_EXPORTS)),
        )
        .route("/api/sessions/{name}/obstacles/{id}", get(obstacles::mesh))
        .route("/api/species", get(species::list))
        .route(
            "/api/species/{slug}/picture",
            get(species::picture).layer(GlobalConcurrencyLimitLayer::new(MAX_PICTURES)),
        )
        .route(
            "/api/schematic",
            post(schematic::draw).layer(GlobalConcurrencyLimitLayer::new(MAX_SCHEMATICS)),
        )
        .route("/api/trees/{id}", patch(trees::rename).delete(trees::delete))
        .route("/api/trees/{id}/thumbnail", get(trees::thumbnail))
        .layer(DefaultBodyLimit::max(MAX_SMALL_BODY))
        .merge(
            Router::new()
                .route("/api/trees", get(trees::list).post(trees::save))
                .layer(DefaultBodyLimit::max(MAX_TREE_BODY)),
        )
        .merge(
            Router::new()
                .route("/api/sessions/{name}/obstacles", post(obstacles::upload))
                .layer(GlobalConcurrencyLimitLayer::new(MAX_UPLOADS))
                .layer(DefaultBodyLimit::max(MAX_GLB_BYTES)),
        )
        .route("/api/{*unknown}", get(failure::unknown_route))
        .route("/health", get("ok"))
        .layer(from_fn(guard::time_limit));
    Router::new()
        .merge(requests)
        // A socket lasts as long as its drawing, so no time limit holds here.
        .route("/api/sessions/{name}/socket", get(sessions::socket))
        .route("/", get(client::page))
        .route("/s/{name}", get(client::page))
        .fallback(client::file)
        .layer(ServiceBuilder::new().layer(map_response(guard::headers)).layer(from_fn(guard::same_origin)))
        .with_state(shared)
}
