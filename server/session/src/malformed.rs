//! Sentences for messages that cannot be read, naming the field at fault where it can be found.

use espalier_proto::{ParametersPatch, Problem, ProblemCode, StrokeSample};
use serde::de::DeserializeOwned;
use serde_json::Value;

/// A message that is no known control message.
pub(crate) fn message(error: &serde_json::Error) -> Problem {
    let text = without_place(&error.to_string());
    if error.is_syntax() || error.is_eof() {
        let place = format!("line {}, column {}", error.line(), error.column());
        return Problem::new(ProblemCode::Malformed, format!("the message is not JSON ({place}): {text}"));
    }
    Problem {
        code: ProblemCode::Malformed,
        field: named_field(&text),
        allowed: None,
        message: format!("the message is not a known control message: {text}"),
    }
}

/// The number and the problem of a command message whose command cannot be read.
pub(crate) fn numbered_command(text: &str, error: &serde_json::Error) -> Option<(u32, Problem)> {
    let value = serde_json::from_str::<Value>(text).ok()?;
    if value.get("type")?.as_str()? != "command" {
        return None;
    }
    let id = u32::try_from(value.get("id")?.as_u64()?).ok()?;
    let problem =
        value.get("command").map_or_else(|| message(error), |command| command_value(command, error));
    Some((id, problem))
}

/// A command given as JSON text that is no known command.
pub(crate) fn command(text: &str, error: &serde_json::Error) -> Problem {
    serde_json::from_str(text).map_or_else(|_| message(error), |value| command_value(&value, error))
}

/// A command given as a JSON value that is no known command; `error` is what reading it said.
pub(crate) fn command_value(value: &Value, error: &serde_json::Error) -> Problem {
    locate(value).unwrap_or_else(|| {
        let text = without_place(&error.to_string());
        Problem {
            code: ProblemCode::Malformed,
            field: named_field(&text),
            allowed: None,
            message: format!("the command cannot be read: {text}"),
        }
    })
}

/// Serde loses the path of an error inside a tagged enum; this goes through the fields one by one again.
fn locate(command: &Value) -> Option<Problem> {
    let fields = command.as_object()?;
    for (name, value) in fields {
        let found = match name.as_str() {
            "stroke" | "steps" => wrong::<u32>(name, value),
            "gesture" => wrong::<Option<u32>>(name, value),
            "position" => wrong::<[f32; 3]>(name, value),
            "samples" => wrong::<Vec<Value>>(name, value).or_else(|| {
                let samples = value.as_array()?.iter().enumerate();
                samples.into_iter().find_map(|(index, sample)| locate_in_sample(index, sample))
            }),
            "parameters" => locate_in_parameters(value),
            _ => None,
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

fn locate_in_sample(index: usize, sample: &Value) -> Option<Problem> {
    let whole = format!("samples[{index}]");
    let part = sample.as_object().and_then(|fields| {
        fields.iter().find_map(|(name, value)| match name.as_str() {
            "position" => wrong::<[f32; 3]>(&format!("{whole}.position"), value),
            "radius" => wrong::<f32>(&format!("{whole}.radius"), value),
            _ => None,
        })
    });
    part.or_else(|| wrong::<StrokeSample>(&whole, sample))
}

fn locate_in_parameters(parameters: &Value) -> Option<Problem> {
    let Some(fields) = parameters.as_object() else {
        return wrong::<ParametersPatch>("parameters", parameters);
    };
    fields.iter().find_map(|(name, value)| {
        let alone = Value::Object([(name.clone(), value.clone())].into_iter().collect());
        wrong::<ParametersPatch>(&format!("parameters.{name}"), &alone)
    })
}

fn wrong<T: DeserializeOwned>(field: &str, value: &Value) -> Option<Problem> {
    let error = T::deserialize(value).err()?;
    let text = without_place(&error.to_string());
    let message = format!("{field} cannot be read: {text}");
    Some(Problem { code: ProblemCode::Malformed, field: Some(field.into()), allowed: None, message })
}

/// The field in "missing field `steps`" or "unknown field `x`, expected …".
fn named_field(text: &str) -> Option<String> {
    let rest = text.strip_prefix("missing field `").or_else(|| text.strip_prefix("unknown field `"))?;
    rest.split_once('`').map(|(field, _)| field.to_owned())
}

/// Serde's "at line 1 column 20" counts inside a message that people never see.
fn without_place(text: &str) -> String {
    text.rsplit_once(" at line ").map_or(text, |(sentence, _)| sentence).to_owned()
}
