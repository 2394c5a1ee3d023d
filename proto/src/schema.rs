//! The JSON Schema of everything that travels as JSON (draft 2020-12): one document, made from the types.

use std::fmt::Display;

use espalier_reading::Between;
use schemars::{
    JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings, json_schema, transform::RecursiveTransform,
};
use serde_json::{Map, Value};

use crate::{
    command::Command,
    control::{ClientMessage, ServerMessage},
};

/// The schema's text; `proto/protocol.schema.json` must equal it.
pub fn document() -> String {
    let transform = RecursiveTransform(plain_numbers);
    let mut generator = SchemaSettings::draft2020_12().with_transform(transform).into_generator();
    for add in [
        SchemaGenerator::subschema_for::<ClientMessage>,
        SchemaGenerator::subschema_for::<ServerMessage>,
        SchemaGenerator::subschema_for::<Command>,
    ] {
        add(&mut generator);
    }
    let definitions: Map<String, Value> = generator.take_definitions(true);
    let document = json_schema!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Espalier's messages",
        "description": "Text messages over a session's WebSocket (PROTOCOL.md): ClientMessage to the server, ServerMessage from it. Command is also a line of a journal or a script. Generated from the program's types.",
        "anyOf": [{ "$ref": "#/$defs/ClientMessage" }, { "$ref": "#/$defs/ServerMessage" }],
        "$defs": definitions,
    });
    // Plain values always have a JSON form.
    serde_json::to_string_pretty(&document).unwrap_or_default() + "\n"
}

/// Says by bounds what the formats of numbers say, which not every validator knows.
fn plain_numbers(schema: &mut Schema) {
    let most = match schema.get("format").and_then(Value::as_str) {
        Some("uint8") => Some(u32::from(u8::MAX)),
        Some("uint32") => Some(u32::MAX),
        Some("uint64" | "int32" | "float" | "double") => None,
        _ => return,
    };
    schema.remove("format");
    if let (Some(most), None) = (most, schema.get("maximum")) {
        schema.insert("maximum".into(), most.into());
    }
}

/// Declares the schemas of types that have a form of their own as JSON. They stand wherever the type does.
macro_rules! schemas {
    ($($name:ty = |$generator:pat_param| $schema:expr;)+) => { $(
        impl schemars::JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema($generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $schema
            }
        }
    )+ };
}
pub(crate) use schemas;

/// A number between bounds, as a schema.
pub(crate) fn between<N: JsonSchema + Display>(Between(least, most): &Between<N>) -> Schema {
    let mut schema = SchemaGenerator::default().root_schema_for::<N>();
    for unneeded in ["$schema", "title", "format", "minimum"] {
        schema.remove(unneeded);
    }
    for (bound, value) in [("minimum", least), ("maximum", most)] {
        // JSON has no infinity, and no bound where a number has none.
        if let Ok(value @ Value::Number(_)) = serde_json::from_str(&value.to_string()) {
            schema.insert(bound.into(), value);
        }
    }
    schema
}

/// So many numbers, each between bounds of its own.
pub(crate) fn numbers(ranges: &[Between<f32>]) -> Schema {
    let items: Vec<Schema> = ranges.iter().map(between).collect();
    let count = ranges.len();
    json_schema!({ "type": "array", "prefixItems": items, "minItems": count, "maxItems": count })
}

/// A text of `least` to `most` characters.
pub(crate) fn text(least: usize, most: usize) -> Schema {
    json_schema!({ "type": "string", "minLength": least, "maxLength": most })
}

/// A list of `least` to `most` entries.
pub(crate) fn list<T: JsonSchema>(generator: &mut SchemaGenerator, least: usize, most: usize) -> Schema {
    let items = generator.subschema_for::<T>();
    json_schema!({ "type": "array", "items": items, "minItems": least, "maxItems": most })
}
