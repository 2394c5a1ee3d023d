//! One row of a table: what is known of a setting.

use serde::Serialize;
use ts_rs::TS;

use crate::{choice::choices, value::Value};

choices! {
    /// What a number is counted in.
    Unit {
        /// Metres.
        Metres = "m",
        /// Metres in a second.
        MetresPerSecond = "m/s",
        /// Lengths of an internode.
        Internodes = "internodes",
        /// Degrees of an angle.
        Degrees = "°",
        /// Steps of the simulation.
        Steps = "steps",
    }
}

/// What a setting can be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Kind {
    /// A number.
    Number {
        /// The least value.
        least: f32,
        /// The greatest value.
        most: f32,
        /// By how much a control changes it; 1 for whole numbers.
        step: f32,
    },
    /// On or off.
    Switch,
    /// One of some names.
    Choice {
        /// The names.
        #[ts(type = "readonly string[]")]
        choices: &'static [&'static str],
    },
    /// Red, green and blue in sRGB, 0 to 255 each.
    Colour,
}

/// One row of a table. Its words in the client are `AREA.NAME` and `AREA.NAME.help`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct Setting {
    /// The name of the field.
    #[serde(skip)]
    #[ts(skip)]
    pub name: &'static str,
    /// What it is, in a sentence.
    #[serde(skip)]
    #[ts(skip)]
    pub sentence: &'static str,
    /// What it can be.
    #[serde(flatten)]
    pub kind: Kind,
    /// Its symbol in the papers.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(type = "string", optional)]
    pub symbol: Option<&'static str>,
    /// What it is counted in; none for plain numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub unit: Option<Unit>,
    /// The part of its range that gets most of a control's travel, because most happens there; none where the range
    /// is even.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(type = "readonly [number, number]", optional)]
    pub travel: Option<[f32; 2]>,
    /// The settings it stands with in a panel; none where a whole table stands together.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(type = "string", optional)]
    pub group: Option<&'static str>,
}

impl Setting {
    /// A row for values of type `V`.
    pub(crate) const fn new<V: Value>(name: &'static str, sentence: &'static str) -> Self {
        let sentence = sentence.trim_ascii();
        Self { name, sentence, kind: V::KIND, symbol: None, unit: None, travel: None, group: None }
    }

    /// The same for numbers from `least` to `most`, both included.
    pub(crate) const fn range(mut self, least: f32, most: f32) -> Self {
        let Kind::Number { step, .. } = self.kind else { panic!("only numbers have a range") };
        self.kind = Kind::Number { least, most, step };
        self
    }

    /// The same, changed in such steps by a control.
    pub(crate) const fn step(mut self, step: f32) -> Self {
        let Kind::Number { least, most, .. } = self.kind else { panic!("only numbers have steps") };
        self.kind = Kind::Number { least, most, step };
        self
    }

    /// The same with a symbol.
    pub(crate) const fn symbol(mut self, symbol: &'static str) -> Self {
        self.symbol = Some(symbol);
        self
    }

    /// The same, counted in this unit.
    pub(crate) const fn unit(mut self, unit: Unit) -> Self {
        self.unit = Some(unit);
        self
    }

    /// The same with most of a control's travel for a part of the range.
    pub(crate) const fn travel(mut self, from: f32, to: f32) -> Self {
        let Kind::Number { least, most, .. } = self.kind else { panic!("only numbers have a travel") };
        assert!(least <= from && from < to && to <= most, "a travel lies within the range");
        self.travel = Some([from, to]);
        self
    }

    /// The same in a group.
    pub(crate) const fn group(mut self, group: &'static str) -> Self {
        self.group = Some(group);
        self
    }

    /// What may stand here, in words: `0.4 to 0.7`.
    pub fn allowed(&self) -> String {
        match self.kind {
            Kind::Number { least, most, .. } => format!("{least} to {most}"),
            Kind::Switch => "true, false".to_owned(),
            Kind::Choice { choices } => choices.join(", "),
            Kind::Colour => "three whole numbers, 0 to 255".to_owned(),
        }
    }

    /// Whether a value is a number outside the range; what is not a number lies in none.
    pub(crate) fn check<V: Value>(&self, value: V) -> Result<(), OutOfRange> {
        match (self.kind, value.number()) {
            (Kind::Number { least, most, .. }, Some((number, text)))
                if !(f64::from(least)..=f64::from(most)).contains(&number) =>
            {
                Err(OutOfRange { field: self.name.to_owned(), value: text, allowed: self.allowed() })
            }
            _ => Ok(()),
        }
    }
}

/// A value outside its range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} is {value}; allowed: {allowed}")]
pub struct OutOfRange {
    /// The field, as a path.
    pub field: String,
    /// What it was to be.
    pub value: String,
    /// What it may be.
    pub allowed: String,
}

impl OutOfRange {
    /// The same with its field inside `outer`.
    #[must_use]
    pub fn within(self, outer: &str) -> Self {
        Self { field: format!("{outer}.{}", self.field), ..self }
    }
}
