//! Species as a picker offers them.

use espalier_settings::Appearance;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::programme::Programme;

/// A programme and an appearance with a name, from `GET /api/v1/species`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Species {
    /// Its short name, as the command line takes it.
    pub slug: String,
    /// Its name.
    pub name: String,
    /// Its botanical name, or that of the style.
    pub botanical: String,
    /// What tells it from others, in one sentence.
    pub sentence: String,
    /// What `set_programme` is given when it is picked.
    pub programme: Programme,
    /// What it looks like: all but the background and the wind is what `set_appearance` is given when it is picked.
    pub appearance: Appearance,
}
