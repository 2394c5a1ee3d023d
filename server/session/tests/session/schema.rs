//! The JSON Schema of messages says what the readers take (`CM10`).

use boon::{Compiler, SchemaIndex, Schemas};
use espalier_proto::{ClientMessage, ServerMessage, schema};
use espalier_session::read_command;
use serde_json::{Value, json};

use crate::refusals::{commands, messages, mistakes};

/// What a schema cannot say, or a reader does not ask: fields at whose mistakes they may differ.
const BEYOND_SCHEMAS: [&str; 9] = [
    "mesh",       // base64
    "client",     // letters and digits
    "rotation",   // of length 1
    "right",      // of length 1
    "up",         // perpendicular to it
    "tick",       // written by the server alone, so in no schema
    "stages",     // in order of their ages
    "parameters", // ranges of settings are checked after reading
    "appearance", // the same
];

/// One definition of the schema, ready to be asked.
struct Validator(Schemas, SchemaIndex);

impl Validator {
    fn of(definition: &str) -> Self {
        let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
        let document = serde_json::from_str(&schema::document()).expect("it is JSON");
        compiler.add_resource("protocol.json", document).expect("it is a schema");
        let index = compiler.compile(&format!("protocol.json#/$defs/{definition}"), &mut schemas);
        Self(schemas, index.expect("it is a schema"))
    }

    fn fault(&self, value: &Value) -> Option<String> {
        self.0.validate(value, self.1).err().map(|error| format!("{error:#}"))
    }
}

fn agree(of: &str, samples: &[Value], reads: impl Fn(&Value) -> bool) -> usize {
    let validator = Validator::of(of);
    let (mut tried, mut differences) = (0, Vec::new());
    for sample in samples {
        let mut plain = sample.clone();
        if let Some(fields) = plain.as_object_mut() {
            fields.remove("tick");
        }
        assert_eq!(validator.fault(&plain), None, "{plain}");
        for (text, at) in mistakes(&plain) {
            let Ok(value) = serde_json::from_str::<Value>(&text) else { continue };
            // 1000000.0 is a whole number to a schema, and not to the reader.
            if text.contains("000000.0") {
                continue;
            }
            let (schema, reader) = (validator.fault(&value).is_none(), reads(&value));
            let is_beyond = BEYOND_SCHEMAS.iter().any(|field| at.contains(field));
            if schema != reader && !is_beyond {
                differences.push(format!("schema {schema}, reader {reader}: {at} in {text:.200}"));
            }
            tried += 1;
        }
    }
    assert!(differences.is_empty(), "{differences:#?}");
    tried
}

#[test]
fn cm10_the_schema_of_commands_takes_what_the_reader_takes() {
    let tried = agree("Command", &commands(), |value| read_command(&value.to_string()).is_ok());
    assert!(tried > 2000, "{tried}");
}

#[test]
fn cm10_the_schema_of_messages_takes_what_the_reader_takes() {
    let reads = |value: &Value| ClientMessage::from_json(&value.to_string()).is_ok();
    let tried = agree("ClientMessage", &messages(), reads);
    assert!(tried > 100, "{tried}");
}

#[test]
fn cm10_what_the_server_says_keeps_to_the_schema() {
    let validator = Validator::of("ServerMessage");
    for message in [
        json!({ "type": "acknowledged", "id": 3 }),
        json!({ "type": "done", "id": 3, "step": 12, "metamers": 400 }),
        json!({ "type": "role", "role": "viewer" }),
        json!({ "type": "people", "you": 1, "more": 0, "people": [{
            "person": 1,
            "name": "Ann",
            "role": "editor",
            "devices": [{ "device": 1, "state": "away", "tool": "brush", "follows": 2 }],
        }] }),
        json!({ "type": "refused", "id": 3, "problem": { "code": "refused", "reason": "no-room", "message": "no" } }),
        json!({ "type": "appearance", "appearance": espalier_settings::Appearance::default(), "wind_since": 0 }),
        json!({ "type": "parameters", "parameters": espalier_settings::ParameterValues::default() }),
        json!({ "type": "timeline", "line": 0, "step": 0, "last_step": 0, "done": 0, "operations": [], "futures": [] }),
        json!({ "type": "timeline_changed", "line": 0, "step": 0, "last_step": 0, "done": 0, "from": 0, "operations": [] }),
    ] {
        let read: ServerMessage = serde_json::from_value(message).expect("it is one");
        let written = serde_json::to_value(read).expect("plain values");
        assert_eq!(validator.fault(&written), None, "{written}");
    }
}
