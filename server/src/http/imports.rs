//! Files that become trees of the library.

use axum::{
    Extension,
    body::Bytes,
    extract::{State, rejection::BytesRejection},
    http::StatusCode,
    response::IntoResponse,
};
use espalier_proto::{Problem, version::MAX_WOOD_BYTES};
use espalier_session::Principal;
use espalier_settings::ParametersPatch;
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Failure, Query},
    text, trees,
    versions::{self, Said},
};
use crate::{
    SIMULATION_VERSION,
    import::{self, Import},
    store::{Contents, Saved, TreeDocument},
};

/// What the address says of the file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Upload {
    /// The name of the tree.
    name: String,
    /// How the name of such a file ends.
    format: String,
    /// Metres in one unit of the file.
    unit: Option<f64>,
    /// Metres in one internode.
    internode_length: Option<f32>,
}

pub(super) async fn upload(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Query(upload): Query<Upload>,
    body: Result<Bytes, BytesRejection>,
) -> Result<impl IntoResponse, Failure> {
    let name = text::name("name", &upload.name)?;
    let format = import::format_of(&upload.format).map_err(|_| {
        let endings = import::FORMATS.iter().map(|(_, ending, _)| *ending).collect::<Vec<_>>().join(", ");
        Problem::out_of_range("format", &upload.format, endings)
    })?;
    let unit = upload.unit.unwrap_or(1.0);
    if !(unit.is_finite() && unit > 0.0) {
        return Err(Problem::out_of_range("unit", unit, "more than 0").into());
    }
    let internode_length = upload.internode_length;
    let parameters = vec![ParametersPatch { internode_length, ..ParametersPatch::default() }];
    let import = Import { format, unit, seed: rand::random(), parameters, metamers: shared.metamer_budget };
    let file = body.map_err(|rejection| Failure::unread(&rejection, MAX_WOOD_BYTES))?;
    let made = shared.pool.run(move || {
        let document = import::document(&file, &import)?;
        Ok::<_, import::ImportError>(Saved {
            metamers: document.metamers(),
            species: document.species(),
            document: TreeDocument {
                simulation_version: SIMULATION_VERSION,
                bytes: document.to_saved_bytes(),
            },
            thumbnail: None,
        })
    });
    let saved = made.await?.map_err(|error| Problem::from(&error))?;
    let version = versions::new(&principal, Said::default(), Contents::New(Box::new(saved)));
    Ok((StatusCode::CREATED, trees::add(&shared, &principal, name, version).await?))
}
