//! Values as JSON, by the kind of their parameter.

use espalier_plant::wood::as_written;
use espalier_reading::{Kind as Reason, Refusal};
use glam::Vec3;
use serde_json::{Value as Text, json};

use super::json::Json;
use crate::{
    curve::Curve,
    envelope::Envelope,
    function::Function,
    value::{Held, Kind, Material, Value},
};

/// A number in the fewest digits that mean it.
pub(super) fn number(number: f32) -> Text {
    json!(as_written(number))
}

fn numbers(all: &[f32]) -> Text {
    all.iter().copied().map(number).collect()
}

/// A value as JSON.
pub(super) fn written(value: &Value) -> Text {
    match value {
        Value::Scalar(scalar) => number(*scalar),
        Value::Span(first, last) => numbers(&[*first, *last]),
        Value::Vector(vector) => numbers(&vector.to_array()),
        Value::Function(function) => {
            function.points().iter().map(|&(t, value)| numbers(&[t, value])).collect()
        }
        Value::Curve(curve) => curve.points().iter().map(|point| numbers(&point.to_array())).collect(),
        Value::Envelope(envelope) => json!({
            "top": numbers(&envelope.top.to_array()),
            "bottom": numbers(&envelope.bottom.to_array()),
            "radii": numbers(&envelope.radii),
            "heights": numbers(&envelope.heights),
            "upper": number(envelope.upper),
            "lower": number(envelope.lower),
            "tip": numbers(&envelope.tip.to_array()),
        }),
        Value::Material(Material { bark, leaves }) => {
            json!({ "bark": numbers(bark), "leaves": numbers(leaves) })
        }
    }
}

impl Envelope {
    /// Reads an envelope that is the value of no parameter.
    ///
    /// # Errors
    /// Where a field is missing, unknown or out of range, or the envelope is inside out.
    pub fn from_json(value: &Text) -> Result<Self, Refusal> {
        envelope(&Json::root(value))
    }

    /// The same as JSON.
    pub fn to_json(&self) -> Text {
        written(&Value::Envelope(self.clone()))
    }
}

/// A value of a kind; whether it lies in its range is for the graph to say.
pub(super) fn read(json: &Json<'_>, kind: Kind) -> Result<Held, Refusal> {
    let vector = |json: &Json<'_>| json.numbers::<3>().map(Vec3::from_array);
    let value = match kind {
        Kind::Scalar | Kind::Whole => Value::Scalar(json.number()?),
        Kind::Span => {
            let [first, last] = json.numbers()?;
            Value::Span(first, last)
        }
        Kind::Vector => Value::Vector(vector(json)?),
        Kind::Function => {
            let point = |point: &Json<'_>| point.numbers().map(|[t, value]| (t, value));
            let points = few(json, kind)?.iter().map(point).collect::<Result<Vec<_>, _>>()?;
            Value::Function(Function::new(&points).map_err(|fault| json.not_allowed(&fault))?)
        }
        Kind::Curve => {
            let points = few(json, kind)?.iter().map(vector).collect::<Result<Vec<_>, _>>()?;
            Value::Curve(Curve::new(&points).map_err(|fault| json.not_allowed(&fault))?)
        }
        Kind::Envelope => Value::Envelope(envelope(json)?),
        Kind::Material => {
            let object = json.object(&["bark", "leaves"])?;
            let field =
                |name| object.needed(name, "the fields bark, leaves").and_then(|field| field.numbers());
            Value::Material(Material { bark: field("bark")?, leaves: field("leaves")? })
        }
    };
    Ok(Held::new(value))
}

fn envelope(json: &Json<'_>) -> Result<Envelope, Refusal> {
    let vector = |json: &Json<'_>| json.numbers::<3>().map(Vec3::from_array);
    let object = json.object(&["top", "bottom", "radii", "heights", "upper", "lower", "tip"])?;
    let field = |name| object.needed(name, "the fields top, bottom, radii, heights, upper, lower, tip");
    let envelope = Envelope {
        top: vector(&field("top")?)?,
        bottom: vector(&field("bottom")?)?,
        radii: field("radii")?.numbers()?,
        heights: field("heights")?.numbers()?,
        upper: field("upper")?.number()?,
        lower: field("lower")?.number()?,
        tip: vector(&field("tip")?)?,
    };
    envelope.check().map_err(|fault| json.not_allowed(&fault))?;
    Ok(envelope)
}

/// The entries of a list that must be short, or it is not looked into.
fn few<'a>(json: &Json<'a>, kind: Kind) -> Result<Vec<Json<'a>>, Refusal> {
    let list = json.list(kind.described())?;
    if list.len() > crate::curve::MOST_POINTS {
        return Err(json.refused(Reason::TooMany, format!("has {} entries", list.len()), "24 at most"));
    }
    Ok(list)
}
