//! What can be said about a file that becomes a tree, on the command line and in a request alike.

use std::{borrow::Cow, str::FromStr};

use clap::Args;
use espalier_growth::species::{self, Species};
use espalier_import::Units;
use espalier_proto::NotAllowed;
use espalier_reading::{Between, Bounded};
use espalier_settings::{Kind, ParameterValues, ParametersPatch, Setting};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, Error},
};
use serde_json::Value;

use crate::{import::excerpt, similar::asked_for};

/// How lengths in a file are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Args)]
pub struct ImportOptions {
    /// Metres in one unit of the file, for .csv and .mtg: 0.001 for millimetres; 1 if not given.
    #[arg(long, value_name = "METRES")]
    pub unit: Option<Unit>,
    /// Metres in one unit of the file's diameters and radii, for .csv and .mtg, where they are not in that of its lengths.
    #[arg(long, value_name = "METRES")]
    pub diameter_unit: Option<Unit>,
    /// Metres in one internode, which a .espalier file knows itself; what a skeleton or graph says, or the median of a
    /// file's pieces, if not given.
    #[arg(long, value_name = "METRES")]
    pub internode_length: Option<InternodeLength>,
    /// The species whose looks and growth it gets, which a .espalier file knows itself; what a skeleton or graph says, or
    /// none, if not given.
    #[arg(long, value_name = "NAME")]
    pub species: Option<SpeciesName>,
}

impl ImportOptions {
    /// The units of the file, where it does not know.
    pub fn units(&self) -> Units {
        let length = self.unit.map_or(1.0, |Unit(metres)| metres);
        Units { length, diameter: self.diameter_unit.map_or(length, |Unit(metres)| metres) }
    }

    /// The same as a request says it.
    pub fn in_query(&self) -> impl Iterator<Item = (&'static str, String)> + use<> {
        let all = [
            ("unit", self.unit.map(|Unit(metres)| metres.to_string())),
            ("diameter_unit", self.diameter_unit.map(|Unit(metres)| metres.to_string())),
            ("internode_length", self.internode_length.map(|InternodeLength(metres)| metres.to_string())),
            ("species", self.species.map(|SpeciesName(slug)| slug.to_owned())),
        ];
        all.into_iter().filter_map(|(name, value)| value.map(|value| (name, value)))
    }

    /// The species that it gets whatever the file says.
    pub fn species(&self) -> Option<&'static Species> {
        self.species.and_then(SpeciesName::species)
    }

    /// The parameters that are set.
    pub fn parameters(&self) -> ParametersPatch {
        let internode_length = self.internode_length.map(|InternodeLength(metres)| metres);
        ParametersPatch { internode_length, ..ParametersPatch::default() }
    }
}

/// Metres in a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit(f64);

impl Unit {
    const RANGE: Between<f64> = Between(f64::MIN_POSITIVE, f64::MAX);
    const ALLOWED: &str = "more than 0";
}

impl FromStr for Unit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        from_text(text, Self::RANGE).map(Self).ok_or_else(|| format!("allowed: {}", Self::ALLOWED))
    }
}

impl<'de> Deserialize<'de> for Unit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Bounded(Self::RANGE, &Self::ALLOWED).deserialize(deserializer).map(Self)
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InternodeLength(f32);

impl InternodeLength {
    fn row() -> Option<(&'static Setting, Between<f32>)> {
        let row = ParameterValues::ROWS.iter().find(|row| row.name == "internode_length")?;
        match row.kind {
            Kind::Number { least, most, .. } => Some((row, Between(least, most))),
            _ => None,
        }
    }
}

impl FromStr for InternodeLength {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (row, range) = Self::row().ok_or("there is no such parameter")?;
        from_text(text, range).map(Self).ok_or_else(|| format!("allowed: {}", row.allowed()))
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

/// The short name of a species that there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpeciesName(&'static str);

impl SpeciesName {
    /// The species.
    pub fn species(self) -> Option<&'static Species> {
        species::find(self.0)
    }

    fn all() -> impl Iterator<Item = &'static str> + Clone {
        species::all().iter().map(|species| species.slug)
    }
}

impl FromStr for SpeciesName {
    type Err = String;

    fn from_str(slug: &str) -> Result<Self, String> {
        if let Some(species) = species::find(slug) {
            return Ok(Self(species.slug));
        }
        Err(format!(
            "there is no such species{}; `espalier species` lists them",
            asked_for(slug, Self::all())
        ))
    }
}

impl<'de> Deserialize<'de> for SpeciesName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let slug = String::deserialize(deserializer)?;
        slug.parse().map_err(|_| {
            let found = format!("{}{}", excerpt(&slug), asked_for(&slug, Self::all()));
            let allowed = "the short name of a species, as GET /api/v1/species lists them";
            D::Error::custom(NotAllowed::new(found, allowed.to_owned()))
        })
    }
}

impl JsonSchema for SpeciesName {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "SpeciesName".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "description": "The short name of a species." })
    }
}

/// A number between bounds that somebody has typed.
fn from_text<T: FromStr + PartialOrd>(text: &str, Between(least, most): Between<T>) -> Option<T> {
    text.parse().ok().filter(|number| (least..=most).contains(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The command line and a request take the same values, and say the same of others.
    #[test]
    fn what_is_typed_is_taken_as_what_is_sent() {
        fn both<T: FromStr<Err = String> + for<'de> Deserialize<'de> + PartialEq + std::fmt::Debug>(
            text: &str,
        ) -> Result<T, String> {
            let sent = serde_json::from_str::<Value>(text).map_err(|error| error.to_string());
            let sent = sent.and_then(|sent| serde_json::from_value(sent).map_err(|error| error.to_string()));
            match (text.parse(), sent) {
                (Ok(typed), sent) => {
                    assert_eq!(sent, Ok(typed), "{text}");
                    sent
                }
                (Err(typed), Err(sent)) => {
                    let allowed = typed.strip_prefix("allowed: ").unwrap();
                    assert!(sent.ends_with(&format!("expected {allowed}")), "{text}: {typed}; {sent}");
                    Err(typed)
                }
                (typed, sent) => panic!("{text}: {typed:?} and {sent:?}"),
            }
        }
        for (text, is_allowed) in [("0.001", true), ("12", true), ("0", false), ("-1", false)] {
            assert_eq!(both::<Unit>(text).is_ok(), is_allowed, "{text}");
        }
        for (text, is_allowed) in [("0.005", true), ("1", true), ("0", false), ("1.5", false)] {
            assert_eq!(both::<InternodeLength>(text).is_ok(), is_allowed, "{text}");
        }
        let typed = |slug: &str| slug.parse::<SpeciesName>();
        let sent = |slug: &str| serde_json::from_value::<SpeciesName>(slug.into());
        assert_eq!(sent("oak").ok(), typed("oak").ok());
        assert_eq!(typed("oak").ok().and_then(SpeciesName::species).map(|oak| oak.slug), Some("oak"));
        for slug in ["oka", "Oak", ""] {
            assert!(typed(slug).is_err() && sent(slug).is_err(), "{slug}");
        }
        assert!(typed("oka").is_err_and(|said| said.contains("did you mean oak?")));
        for text in ["NaN", "inf", "a metre", ""] {
            assert!(text.parse::<Unit>().is_err() && text.parse::<InternodeLength>().is_err(), "{text}");
        }
    }
}
