//! The species a picker offers, with their pictures.

use std::io::Cursor;

use axum::{
    Json,
    extract::State,
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_growth::species;
use espalier_proto::{Reason, species::Species};
use espalier_session::wire_species;

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
    let print = shared.portraits.of(&slug, &shared.pool).await.map_err(|error| {
        tracing::error!(slug, %error, "a species cannot be drawn");
        Failure::new(Reason::NotDrawn, "The picture cannot be drawn.")
    })?;
    let print =
        print.ok_or_else(|| Failure::none_such("species", "slug", "the slug of one of /api/v1/species"))?;
    let headers = [(header::ETAG, print.tag.clone()), (header::CACHE_CONTROL, CACHE.to_owned())];
    let known = asked.get(header::IF_NONE_MATCH).and_then(|tags| tags.to_str().ok());
    let is_known = known.is_some_and(|tags| tags.split(',').any(|tag| tag.trim() == print.tag));
    if is_known {
        return Ok((StatusCode::NOT_MODIFIED, headers).into_response());
    }
    let said = [(header::CONTENT_TYPE, "image/png"), (header::CACHE_CONTROL, CACHE)];
    let (png, length) = (Cursor::new(print.png.to_vec()), print.png.len() as u64);
    ranges::answer(&asked, said, &print.tag, png, length)
}
