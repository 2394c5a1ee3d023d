//! What the rows of a table add to the JSON Schema of its struct.

use schemars::{Schema, transform::Transform};
use serde_json::{Map, Value, json};

use crate::setting::{Kind, Setting};

/// Adds ranges and units to the fields of a struct that these rows declare.
pub(crate) struct Rows(pub &'static [Setting]);

impl Transform for Rows {
    fn transform(&mut self, schema: &mut Schema) {
        without_null(schema);
        for row in self.0 {
            if let Some(property) = schema.get_mut("properties").and_then(|all| all.get_mut(row.name)) {
                if let Kind::Number { least, most, .. } = row.kind {
                    property["minimum"] = number(least);
                    property["maximum"] = number(most);
                }
                if let Some(unit) = row.unit {
                    property["x-unit"] = json!(unit);
                }
            }
        }
    }
}

/// Fields that need not be there are left out, and never null.
pub(crate) fn without_null(schema: &mut Schema) {
    let properties = schema.get_mut("properties").and_then(Value::as_object_mut);
    for property in properties.into_iter().flat_map(|all| all.values_mut()).filter_map(Value::as_object_mut) {
        drop_null(property);
    }
}

fn drop_null(property: &mut Map<String, Value>) {
    if let Some(Value::Array(types)) = property.get("type")
        && let Some(of_value) = types.iter().find(|name| *name != "null").cloned()
    {
        property.insert("type".into(), of_value);
    }
    if let Some(Value::Array(either)) = property.remove("anyOf")
        && let Some(Value::Object(of_value)) = either.into_iter().next()
    {
        property.extend(of_value);
    }
}

/// The shortest decimal number that is read as this one.
fn number(value: f32) -> Value {
    value.to_string().parse::<f64>().map_or(Value::Null, |number| match number {
        whole if whole.fract() == 0.0 && whole.abs() < 1e15 => json!(whole as i64),
        other => json!(other),
    })
}
