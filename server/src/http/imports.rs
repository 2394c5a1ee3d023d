//! Files that become trees of the library.

use axum::{Extension, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::Problem;
use espalier_session::Principal;
use espalier_settings::{ParameterValues, ParametersPatch};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Failure, Query},
    trees,
    uploads::File,
    versions::{self, Said},
};
use crate::{
    import::{self, Import},
    store::{Contents, Saved},
    text,
};

/// What the address says of the file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Upload {
    /// The name of the tree.
    name: String,
    /// How the name of such a file ends.
    format: import::Format,
    /// Metres in one unit of the file.
    unit: Option<f64>,
    /// Metres in one internode.
    internode_length: Option<f32>,
}

pub(super) async fn upload(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Query(upload): Query<Upload>,
    File(file, _turn): File,
) -> Result<impl IntoResponse, Failure> {
    let name = text::name("name", &upload.name)?;
    let unit = upload.unit.unwrap_or(1.0);
    if !(unit.is_finite() && unit > 0.0) {
        return Err(Problem::out_of_range("unit", unit, "more than 0").into());
    }
    let internode_length = upload.internode_length;
    let patch = ParametersPatch { internode_length, ..ParametersPatch::default() };
    ParameterValues::default().patched(&patch).check().map_err(Problem::from)?;
    let parameters = vec![patch];
    let import = Import {
        format: upload.format,
        unit,
        seed: rand::random(),
        parameters,
        metamers: shared.metamer_budget,
    };
    let made = shared.pool.run(move || {
        let document = import::document(&file, &import).map_err(|error| import.refusal(&error))?;
        Ok::<_, Problem>(Saved::of(&document))
    });
    let saved = made.await??;
    let version = versions::new(&principal, Said::default(), Contents::New(Box::new(saved)));
    Ok((StatusCode::CREATED, trees::add(&shared, &principal, name, version).await?))
}
