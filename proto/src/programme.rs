//! Programmes: which parameters trees grow by at which age, and what guides them then (`PG1`).

use espalier_reading::NotAllowed;
use espalier_settings::{ParameterValues, ParametersPatch};
use schemars::{JsonSchema, json_schema};
use serde::{Deserialize, Deserializer, Serialize, de::Error};
use ts_rs::TS;

use crate::{
    bounded::{Age, List, written_as},
    command::StrokeSample,
    place::Position,
    reading::tagged_enum,
    schema::schemas,
    version::{MAX_STAGES, MAX_STROKE_SAMPLES},
};

/// What trees grow by over their age, stage by stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with parameters, stages and age")]
pub struct Programme {
    /// The species it is of, by its short name; for whoever shows it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub species: Option<Slug>,
    /// The parameters where no stage has others; those left out have their defaults.
    pub parameters: ParametersPatch,
    /// Up to 128 stages, in order of their ages.
    pub stages: List<Stage, 0, MAX_STAGES>,
    /// The age at which a tree is grown up.
    pub age: Age,
}

tagged_enum! {
    "kind",

    /// What happens at an age.
    pub enum Stage {
        /// From here to the next stage of this kind some parameters are others than the programme's.
        Change {
            /// The age at which it begins.
            age: Age,
            /// Those parameters.
            parameters: ParametersPatch,
        },
        /// Another seed is sown.
        Seed {
            /// The age at which it is.
            age: Age,
            /// Where, on the ground, in internode lengths.
            position: Position,
        },
        /// A stroke of the brush guides growth; it begins when the stroke before it has ended.
        Stroke {
            /// The age at which it begins.
            age: Age,
            /// 1 to 256 places, in the order the brush goes through them.
            samples: List<StrokeSample, 1, MAX_STROKE_SAMPLES>,
        },
    }
}

impl Stage {
    /// The age at which it begins.
    pub fn age(&self) -> u32 {
        match self {
            Self::Change { age, .. } | Self::Seed { age, .. } | Self::Stroke { age, .. } => age.get(),
        }
    }
}

/// A short name: 1 to 64 small letters, digits and hyphens.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Slug(String);

/// Characters of a short name.
const LONGEST_SLUG: usize = 64;

impl Slug {
    /// The name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for Slug {
    type Error = NotAllowed;

    fn try_from(name: String) -> Result<Self, NotAllowed> {
        let is_plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        let is_name = (1..=LONGEST_SLUG).contains(&name.len()) && name.bytes().all(is_plain);
        let allowed = "1 to 64 small letters, digits and hyphens";
        if is_name { Ok(Self(name)) } else { Err(NotAllowed::new(format!("\"{name}\""), allowed)) }
    }
}

impl From<Slug> for String {
    fn from(slug: Slug) -> Self {
        slug.0
    }
}

/// The name of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct ParameterName(&'static str);

impl ParameterName {
    /// The name as text.
    pub fn as_str(self) -> &'static str {
        self.0
    }
}

impl<'de> Deserialize<'de> for ParameterName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.try_into().map_err(D::Error::custom)
    }
}

impl TryFrom<String> for ParameterName {
    type Error = NotAllowed;

    fn try_from(name: String) -> Result<Self, NotAllowed> {
        let known = ParameterValues::NAMES.iter().find(|known| **known == name);
        known
            .map(|known| Self(known))
            .ok_or_else(|| NotAllowed::new(format!("\"{name}\""), ParameterValues::NAMES.join(", ")))
    }
}

written_as! {
    Slug as String;
    ParameterName as String;
}
schemas! {
    Slug = |_| json_schema!({ "type": "string", "pattern": format!("^[a-z0-9-]{{1,{LONGEST_SLUG}}}$") });
    ParameterName = |_| json_schema!({ "type": "string", "enum": ParameterValues::NAMES });
}
