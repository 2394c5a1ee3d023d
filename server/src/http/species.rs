//! The species a picker offers.

use axum::{Json, response::IntoResponse};
use espalier_growth::species;
use espalier_proto::species::Species;
use espalier_session::wire_species;

pub(super) async fn list() -> impl IntoResponse {
    let all: Vec<Species> = species::all().iter().map(wire_species).collect();
    Json(all)
}
