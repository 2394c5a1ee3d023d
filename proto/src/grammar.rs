//! Grammars: plants that are written (`GR1`).

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{
    bounded::{Depth, List},
    place::{DrawingPlane, PlanePoint, Position},
    version::{MAX_OUTLINE_POINTS, MIN_OUTLINE_POINTS},
};

/// Values that one command may set.
pub const MAX_GRAMMAR_VALUES: usize = 64;

/// What a slider of a grammar is set to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with name and value")]
pub struct GrammarValue {
    /// The name that the text gives it.
    pub name: String,
    /// A number that the text allows.
    pub value: f64,
}

/// A body drawn by hand that a grammar may ask for: what `lasso` would fill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with outline, plane and depth")]
pub struct GrammarBody {
    /// 3 to 4096 points on the plane, in internode lengths; the last is joined to the first.
    pub outline: List<PlanePoint, MIN_OUTLINE_POINTS, MAX_OUTLINE_POINTS>,
    /// Where the outline lies.
    pub plane: DrawingPlane,
    /// How deep the body is, 0.1 to 1: at 1 it is as deep as it is wide, everywhere.
    #[serde(default = "crate::command::whole_depth")]
    #[ts(as = "Option<f32>", optional)]
    pub depth: Depth,
}

/// A number of a grammar that may be set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarSlider {
    /// The name that the text gives it.
    pub name: String,
    /// The least it may be set to.
    pub from: f64,
    /// The most.
    pub to: f64,
    /// What the text sets it to.
    pub value: f64,
}

/// Why a grammar cannot be derived further.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarEnd {
    /// Which sentence it is, for programs that have words of their own for it: `ends.no-number`.
    pub id: String,
    /// What stands in the sentence where others of its name have something else, by name.
    pub values: BTreeMap<String, String>,
    /// A sentence in English without its full stop.
    pub message: String,
}

/// The grammar in force (`GR5`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarInForce {
    /// Its text.
    pub text: String,
    /// What the text calls it.
    pub title: Option<String>,
    /// Where its turtle began.
    pub at: Position,
    /// The seed of its chance.
    pub seed: u32,
    /// The sliders of the text.
    pub sliders: Vec<GrammarSlider>,
    /// What was set; other sliders have the values of the text.
    pub values: Vec<GrammarValue>,
    /// The body that it asks for as `inside(0)`; null where none was drawn.
    pub within: Option<GrammarBody>,
    /// Steps of derivation up to the present step of the plants.
    pub depth: u32,
    /// How many steps back on the line of time each lead to the depth before.
    pub earlier: u32,
    /// How many steps forth on it each lead to the next depth.
    pub later: u32,
    /// Whether hands have changed the plants since it was set.
    pub edited: bool,
    /// Why it could not be derived further, where that was tried last.
    pub ends: Option<GrammarEnd>,
}

/// A text to be looked at (`GR6`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with text")]
pub struct CheckGrammar {
    /// The text.
    pub text: String,
    /// What its sliders are set to; others have the values of the text.
    #[serde(default)]
    #[ts(as = "Option<List<GrammarValue, 0, MAX_GRAMMAR_VALUES>>", optional)]
    pub values: List<GrammarValue, 0, MAX_GRAMMAR_VALUES>,
    /// The seed of its chance; 1 if nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub seed: Option<u32>,
    /// Whether its sizes are wanted, which take longer than the rest.
    #[serde(default)]
    #[ts(as = "Option<bool>", optional)]
    pub sizes: bool,
}

/// How bad something in a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum GrammarSeverity {
    /// The grammar cannot be used.
    Error,
    /// It can be used, but something does nothing, or not what may have been meant.
    Warning,
}

/// Something that is wrong with a text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarDiagnostic {
    /// How bad it is.
    pub severity: GrammarSeverity,
    /// Line, counted from 1.
    pub line: u32,
    /// Character of the line, counted from 1; what `length` counts as well.
    pub column: u32,
    /// Characters that it concerns; 0 where something is missing.
    pub length: u32,
    /// What kind it is, as `unknown-function`; [docs/grammars.md](../docs/grammars.md#errors) has all.
    pub code: String,
    /// Which sentence of its kind it is, for programs that have words of their own for it: `unknown-function.near`.
    pub id: String,
    /// What stands in the sentence where others of its name have something else, by name.
    pub values: BTreeMap<String, String>,
    /// A sentence in English without its full stop.
    pub message: String,
    /// What to write instead.
    pub hint: Option<String>,
}

/// How large a plant is at a depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarSize {
    /// Modules of its word.
    pub modules: u32,
    /// Internodes that the turtle draws.
    pub internodes: u32,
}

/// What there is to say of a text (`GR6`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarReport {
    /// What is wrong with it, in the order of the text; 50 at most.
    pub diagnostics: Vec<GrammarDiagnostic>,
    /// What the text calls it. This and what follows says nothing where the text has errors.
    pub title: Option<String>,
    /// A sentence about it.
    pub about: Option<String>,
    /// Who wrote it.
    pub author: Option<String>,
    /// How deep the text would be derived.
    pub depth: Option<u32>,
    /// Its sliders.
    pub sliders: Vec<GrammarSlider>,
    /// How large it is at depth 0, 1, 2 and so on, as far as a bounded amount of work goes; under an open sky.
    pub sizes: Vec<GrammarSize>,
    /// Why it cannot be derived further than the sizes go, where a limit of documents ends it.
    pub ends: Option<GrammarEnd>,
}

/// A grammar that comes with the program (`GR7`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct ShippedGrammar {
    /// Its short name, as in addresses.
    pub name: String,
    /// What it is called.
    pub title: String,
    /// What it shows, in one sentence.
    pub about: String,
    /// How deep it is best derived at first.
    pub depth: u32,
    /// Its sliders.
    pub sliders: Vec<GrammarSlider>,
    /// Its text, for `set_grammar`.
    pub text: String,
    /// Where its picture is.
    pub picture: String,
}

/// A rule of a text, or its axiom.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarRule {
    /// Line, counted from 1.
    pub line: u32,
    /// Character of the line that it begins with, counted from 1.
    pub column: u32,
}

/// Which rule made each row of the grammar in force (`GR8`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct GrammarOrigins {
    /// The depth it is about.
    pub depth: u32,
    /// The axiom, then rules in the order of the text that have made something.
    pub rules: Vec<GrammarRule>,
    /// Living rows that the grammar wrote, ascending.
    pub rows: Vec<u32>,
    /// For each of them the number of the rule in `rules` that its module came from.
    pub by: Vec<u16>,
}
