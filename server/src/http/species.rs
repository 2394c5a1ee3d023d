//! The species a picker offers, with their pictures.

use std::io::Cursor;

use axum::{
    Json,
    extract::State,
    http::{HeaderMap, header},
    response::{IntoResponse, Response},
};
use espalier_growth::species;
use espalier_proto::{Reason, species::Species};
use espalier_session::wire_species;

use crate::portrait::{Print, Sitter};

use super::{
    Shared,
    failure::{Failure, Path},
    ranges,
};

/// A picture changes only as the program does, and a client that asks again gets 304 at once.
const CACHE: &str = "public, max-age=3600";

pub(super) async fn list() -> impl IntoResponse {
    let all: Vec<Species> = species::all().iter().map(wire_species).collect();
    Json(all)
}

pub(super) async fn picture(
    State(shared): State<Shared>,
    Path(slug): Path<String>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    let print = print(&shared, Sitter::Species(&slug)).await?;
    let print =
        print.ok_or_else(|| Failure::none_such("species", "slug", "the slug of one of /api/v1/species"))?;
    answer(&print, &asked)
}

/// The picture of a species or a grammar.
pub(super) async fn print(shared: &Shared, sitter: Sitter<'_>) -> Result<Option<Print>, Failure> {
    shared.portraits.of(sitter, &shared.pool).await.map_err(|error| {
        tracing::error!(?sitter, %error, "a picture cannot be drawn");
        Failure::new(Reason::NotDrawn, "The picture cannot be drawn.")
    })
}

/// Sends a picture to whoever does not have it.
pub(super) fn answer(print: &Print, asked: &HeaderMap) -> Result<Response, Failure> {
    let said = [(header::CONTENT_TYPE, "image/png"), (header::CACHE_CONTROL, CACHE)];
    let (png, length) = (Cursor::new(print.png.to_vec()), print.png.len() as u64);
    ranges::answer(asked, said, &print.tag, png, length)
}
