//! Designs as they travel: edits, and what everybody is told of the design in force (`DS`).
//!
//! Values of parameters are JSON by the kind of their parameter ([docs/design-graphs.md](../../docs/design-graphs.md)
//! has the kinds and ranges); the design itself says what it takes, so they are read there.

use std::collections::BTreeMap;

use schemars::{JsonSchema, json_schema};
use serde::{Deserialize, Deserializer, Serialize, de::Error};
use serde_json::Value;
use ts_rs::TS;

use crate::{NotAllowed, bounded::written_as, place::Position, reading::tagged_enum, schema::schemas};

/// The most edits in one `edit_design` (`LM21`).
pub const MAX_DESIGN_EDITS: usize = 64;
/// The longest text of one value or graph as JSON, in bytes (`LM21`).
pub const MAX_DESIGN_BYTES: usize = 128 * 1024;

/// JSON of at most [`MAX_DESIGN_BYTES`].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct DesignValue(Value);

impl DesignValue {
    /// The value.
    pub fn get(&self) -> &Value {
        &self.0
    }
}

impl From<Value> for DesignValue {
    fn from(value: Value) -> Self {
        Self(value)
    }
}

impl<'de> Deserialize<'de> for DesignValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        if value.is_null() {
            return Err(D::Error::custom(NotAllowed::new("null", "JSON by the kind of the parameter")));
        }
        let bytes = value.to_string().len();
        if bytes > MAX_DESIGN_BYTES {
            let fault =
                NotAllowed::new(format!("{bytes} bytes"), format!("{MAX_DESIGN_BYTES} bytes at most"));
            return Err(D::Error::custom(fault));
        }
        Ok(Self(value))
    }
}

/// A branch by the way to it: `/` is the plant's own axis, `/3/0` lateral 0 of lateral 3.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct BranchPath(String);

impl BranchPath {
    /// What is allowed.
    const ALLOWED: &'static str = "/, or the way to a branch, as /3 or /3/0";

    /// The way as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for BranchPath {
    type Error = NotAllowed;

    fn try_from(text: String) -> Result<Self, NotAllowed> {
        let is_number =
            |part: &str| (1..=4).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_digit());
        let is_way = text == "/"
            || text
                .strip_prefix('/')
                .is_some_and(|way| way.split('/').count() <= 4 && way.split('/').all(is_number));
        if is_way { Ok(Self(text)) } else { Err(NotAllowed::new(format!("\"{text}\""), Self::ALLOWED)) }
    }
}

impl<'de> Deserialize<'de> for BranchPath {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.try_into().map_err(D::Error::custom)
    }
}

written_as! {
    BranchPath as String;
}
schemas! {
    BranchPath = |_| json_schema!({ "type": "string", "pattern": "^/([0-9]{1,4}(/[0-9]{1,4}){0,3})?$" });
    DesignValue = |_| json_schema!({ "type": ["boolean", "number", "string", "array", "object"] });
}

impl TS for DesignValue {
    type WithoutGenerics = Self;
    type OptionInnerType = Self;

    fn name(_: &ts_rs::Config) -> String {
        "unknown".into()
    }

    fn inline(config: &ts_rs::Config) -> String {
        Self::name(config)
    }
}

/// What is said of a parameter: one of `own`, `add`, `multiply`, `shared` and `inherited`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with own, add, multiply, shared or inherited")]
pub struct DesignSetting {
    /// A value of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub own: Option<DesignValue>,
    /// What is added to the inherited value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub add: Option<DesignValue>,
    /// What the inherited value is multiplied by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub multiply: Option<DesignValue>,
    /// The number of a value that it shares.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub shared: Option<u32>,
    /// It is inherited: `true`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub inherited: Option<bool>,
    /// Nobody inherits it: `true`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub private: Option<bool>,
    /// It is inherited from the next branch beneath on the same axis: `true`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub below: Option<bool>,
}

tagged_enum! {
    "edit",

    /// An edit of a design. Each is done as a whole or refused.
    pub enum DesignEdit {
        /// Say something of a parameter.
        Set {
            /// A branch (`/3`), or all of an order (`level 1`).
            of: String,
            /// The parameter.
            key: String,
            /// What is said.
            value: DesignSetting,
        },
        /// Say nothing of a parameter any more, so that it is inherited.
        Clear {
            /// A branch, or all of an order.
            of: String,
            /// The parameter.
            key: String,
        },
        /// Name a branch, or take its name away.
        Name {
            /// The branch.
            node: BranchPath,
            /// 1 to 64 characters; `null` for none.
            name: Option<String>,
        },
        /// Give branches of one order a value that they share.
        Share {
            /// A number that no shared value has.
            share: u32,
            /// The parameter.
            key: String,
            /// The value.
            value: DesignValue,
            /// Who shares it.
            members: Vec<BranchPath>,
        },
        /// Change a shared value.
        SetShared {
            /// Its number.
            share: u32,
            /// The value.
            value: DesignValue,
        },
        /// Turn and stretch a branch about its base until its tip comes to lie at a place, as near as can be (`DS9`).
        Aim {
            /// The branch.
            node: BranchPath,
            /// Where its tip goes.
            tip: Position,
        },
        /// Let a lateral stand at a place of its bearer whatever stands beside it, or let it go.
        Anchor {
            /// The lateral.
            node: BranchPath,
            /// The share of the axis below it, 0 to 1; `null` lets it go.
            at: Option<f32>,
        },
        /// Give the bearer of a branch that sleeps as many more laterals as it takes.
        Wake {
            /// The branch.
            node: BranchPath,
        },
        /// Forget all that was said of a branch and of what it bears.
        Forget {
            /// The branch.
            node: BranchPath,
        },
        /// Say of a branch and of what it bears what is said of another.
        Copy {
            /// Which one.
            from: BranchPath,
            /// To which one.
            to: BranchPath,
        },
        /// Key chance otherwise.
        Seed {
            /// The key.
            seed: u32,
        },
    }
}

/// The design in force, and whether its wood still follows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct DesignInForce {
    /// Where its wood stands.
    pub at: Position,
    /// All that was said, as in files of designs.
    pub graph: DesignValue,
    /// Values that were said.
    pub values: u32,
    /// Branches that stand.
    pub branches: u32,
    /// The numbers of the laterals that stand on the plant's own axis and on its limbs, from base to tip, by the way to
    /// their bearer.
    pub laterals: BTreeMap<String, Vec<u16>>,
    /// Branches that sleep.
    pub asleep: Vec<BranchPath>,
    /// Steps that stand on its wood; while there are any, the design cannot be changed.
    pub steps_on_top: u32,
    /// The row of the seed that bears its wood.
    pub row: u32,
    /// Which share of their silhouettes the crown of a plant and that of the design have in common: area in both over
    /// area in either. Of a design that was fitted to a plant (`DS10`), until it changes or the session is opened again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub overlap: Option<f32>,
}

/// Colours of branches that a design says (`DS14`), as factors of those of the tree in linear light: red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct DyeColours {
    /// Of bark.
    pub bark: [f32; 3],
    /// Of leaves.
    pub leaves: [f32; 3],
}

/// Rows after one another and their dyes (`DS14`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct DyedBlock {
    /// The first row.
    pub first: u32,
    /// How many rows from there on have which dye, one run after another: the place of the dye counted from 1, or 0 for
    /// none.
    pub runs: Vec<[u32; 2]>,
}

/// A design for a session (`DS11`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct PutDesign {
    /// The graph, as in files of designs.
    pub graph: DesignValue,
    /// Where it stands; without one it takes the place of the design in force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub position: Option<Position>,
}

/// Where a branch of a design stands as wood, and how large it is. Numbers are rounded to ten thousandths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct PlacedBranch {
    /// The way to it.
    pub path: BranchPath,
    /// Where it begins, in the scene.
    pub base: [f32; 3],
    /// The rotation (x, y, z, w) of its own frame: Y from its base to its tip, X on the side that looks up.
    pub frame: [f32; 4],
    /// The rotation of the frame of its silhouette.
    pub outline: [f32; 4],
    /// From its base to its tip, in internodes.
    pub length: f32,
    /// Radius at its base, in internodes.
    pub radius: f32,
    /// Where it stands on its bearer, as a share of that one's axis.
    pub at: f32,
    /// Where its bearer goes at that place.
    pub heading: [f32; 3],
    /// Whether it begins outside its bearer's silhouette, and so has no size from it.
    pub outside: bool,
    /// How many laterals it bears.
    pub bears: u32,
}

/// A limb that grew, and the outline around it. Numbers are rounded to ten thousandths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct LimbOutline {
    /// The row that it begins with.
    pub row: u32,
    /// The metamer that bears it; none for a trunk.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub bearer: Option<u32>,
    /// Where it begins, in the scene.
    pub base: [f32; 3],
    /// The rotation (x, y, z, w) of its frame: Y from its base to its tip, X on the side that looks up.
    pub frame: [f32; 4],
    /// From its base to its tip, in internodes.
    pub length: f32,
    /// Radius at its base, in internodes.
    pub radius: f32,
    /// Where its bearer goes at that place.
    pub heading: [f32; 3],
    /// The outline in this frame, as designs write a `silhouette`; its T is the tip.
    pub envelope: DesignValue,
    /// How many branches stand on its own axis.
    pub bears: u32,
}
