//! Files that become trees of the library.

use std::borrow::Cow;

use axum::{Extension, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::{Problem, text::Name};
use espalier_reading::{Between, Bounded};
use espalier_session::Principal;
use espalier_settings::{Kind, ParameterValues, ParametersPatch, Setting};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, Error},
};
use serde_json::Value;

use super::{
    Shared,
    failure::{Failure, Query},
    trees,
    uploads::File,
    versions::{self, Said},
};
use crate::{
    import::{self, Import},
    pool::Class,
    store::{Contents, Saved},
};

/// What the address says of the file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Upload {
    /// The name of the tree.
    name: Name,
    /// How the name of such a file ends.
    format: import::Format,
    /// Metres in one unit of the file.
    unit: Option<Unit>,
    /// Metres in one internode.
    internode_length: Option<InternodeLength>,
}

/// Metres in a unit.
#[derive(Clone, Copy, Debug)]
struct Unit(f64);

impl<'de> Deserialize<'de> for Unit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Bounded(Between(f64::MIN_POSITIVE, f64::MAX), &"more than 0").deserialize(deserializer).map(Self)
    }
}

impl JsonSchema for Unit {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Unit".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "number", "exclusiveMinimum": 0 })
    }
}

/// The parameter of that name.
#[derive(Clone, Copy, Debug)]
struct InternodeLength(f32);

impl InternodeLength {
    fn row() -> Option<(&'static Setting, Between<f32>)> {
        let row = ParameterValues::ROWS.iter().find(|row| row.name == "internode_length")?;
        match row.kind {
            Kind::Number { least, most, .. } => Some((row, Between(least, most))),
            _ => None,
        }
    }
}

impl<'de> Deserialize<'de> for InternodeLength {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (row, range) = Self::row().ok_or_else(|| D::Error::custom("there is no such parameter"))?;
        Bounded(range, &row.allowed()).deserialize(deserializer).map(Self)
    }
}

impl JsonSchema for InternodeLength {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "InternodeLength".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let range = Self::row().map(|(_, Between(least, most))| {
            // As they are written, not as the nearest of twice as many digits.
            [least, most].map(|bound| serde_json::from_str::<Value>(&bound.to_string()).unwrap_or_default())
        });
        let [least, most] = range.unwrap_or_default();
        json_schema!({ "type": "number", "minimum": least, "maximum": most })
    }
}

pub(super) async fn upload(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Query(upload): Query<Upload>,
    File(file, _turn): File,
) -> Result<impl IntoResponse, Failure> {
    let unit = upload.unit.map_or(1.0, |Unit(metres)| metres);
    let internode_length = upload.internode_length.map(|InternodeLength(metres)| metres);
    let parameters = vec![ParametersPatch { internode_length, ..ParametersPatch::default() }];
    let import = Import {
        format: upload.format,
        unit,
        seed: rand::random(),
        parameters,
        metamers: shared.metamer_budget,
    };
    let made = shared.pool.run(Class::Whole, principal.name().into(), move |_| {
        let document = import::document(&file, &import).map_err(|error| import.refusal(&error))?;
        Ok::<_, Problem>(Saved::of(&document))
    });
    let saved = made.await??;
    let version = versions::new(&principal, Said::default(), Contents::New(Box::new(saved)));
    Ok((StatusCode::CREATED, trees::add(&shared, &principal, upload.name.into(), version).await?))
}
