//! How many entries of a list are asked for.

use std::borrow::Cow;

use espalier_reading::{Between, Bounded};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, de::DeserializeSeed};

/// How many entries an answer has at most: 1 to `MOST`, and `MOST` where nothing is said.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit<const MOST: u32>(u32);

impl<const MOST: u32> Limit<MOST> {
    /// The number.
    pub fn get(self) -> u32 {
        self.0
    }
}

impl<const MOST: u32> Default for Limit<MOST> {
    fn default() -> Self {
        Self(MOST)
    }
}

impl<'de, const MOST: u32> Deserialize<'de> for Limit<MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let range = Between(1, MOST);
        Bounded(range, &range).deserialize(deserializer).map(Self)
    }
}

impl<const MOST: u32> JsonSchema for Limit<MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Limit{MOST}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": 1, "maximum": MOST })
    }
}
