//! Sentences for messages that cannot be read, naming the field at fault where it can be found.

use espalier_proto::{
    DrawingPlane, Obstacle, Pose, Problem, ProblemCode, Shape, StrokeSample,
    version::{MAX_BEND_TOUCHES, MAX_DIAMETER, MAX_PRUNED_ROWS, MAX_STEPS_PER_COMMAND, MIN_DIAMETER},
};
use espalier_settings::{Appearance, AppearancePatch, ParameterValues, ParametersPatch};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// A message that is no known control message.
pub(crate) fn message(error: &serde_json::Error) -> Problem {
    let text = without_place(&error.to_string());
    if error.is_syntax() || error.is_eof() {
        let place = match error.line() {
            1 => format!("column {}", error.column()),
            line => format!("line {line}, column {}", error.column()),
        };
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
    let value = readable(text)?;
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
    readable(text).map_or_else(|| message(error), |value| command_value(&value, error))
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
    if let Some(problem) = fields.get("kind").and_then(wrong_kind) {
        return Some(problem);
    }
    for (name, value) in fields {
        let found = match name.as_str() {
            "stroke" | "steps" | "id" | "bend" | "base" | "row" | "onto" | "step" | "future" => {
                wrong::<u32>(name, value)
            }
            "touches" | "rows" => locate_in_list::<u32>(name, value),
            "targets" => locate_in_list::<[f32; 3]>(name, value),
            "diameter" => wrong::<Option<f32>>(name, value),
            "stretch" | "exposure" => wrong::<f32>(name, value),
            "rotation" => wrong::<[f32; 4]>(name, value),
            "keep" => wrong::<bool>(name, value),
            "gesture" | "bud" => wrong::<Option<u32>>(name, value),
            "position" => wrong::<[f32; 3]>(name, value),
            "samples" => wrong::<Vec<Value>>(name, value).or_else(|| {
                let samples = value.as_array()?.iter().enumerate();
                samples.into_iter().find_map(|(index, sample)| locate_in_sample(index, sample))
            }),
            "parameters" => locate_in_parameters(value),
            "appearance" => locate_in_appearance(value),
            "outline" => locate_in_list::<[f32; 2]>(name, value),
            "plane" => locate_in_plane(value),
            "depth" => wrong::<f32>(name, value),
            "obstacle" => locate_in_obstacle(value),
            "pose" => locate_in_pose("pose", value),
            _ => None,
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

fn locate_in_list<T: DeserializeOwned>(name: &str, list: &Value) -> Option<Problem> {
    wrong::<Vec<Value>>(name, list).or_else(|| {
        let mut items = list.as_array()?.iter().enumerate();
        items.find_map(|(index, item)| wrong::<T>(&format!("{name}[{index}]"), item))
    })
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

fn locate_in_plane(plane: &Value) -> Option<Problem> {
    let part = plane.as_object().and_then(|fields| {
        fields.iter().find_map(|(name, value)| match name.as_str() {
            "origin" | "right" | "up" => wrong::<[f32; 3]>(&format!("plane.{name}"), value),
            _ => None,
        })
    });
    part.or_else(|| wrong::<DrawingPlane>("plane", plane))
}

fn locate_in_obstacle(obstacle: &Value) -> Option<Problem> {
    let part = obstacle.as_object().and_then(|fields| {
        fields.iter().find_map(|(name, value)| match name.as_str() {
            "shape" => wrong::<Shape>("obstacle.shape", value),
            "pose" => locate_in_pose("obstacle.pose", value),
            _ => None,
        })
    });
    part.or_else(|| wrong::<Obstacle>("obstacle", obstacle))
}

fn locate_in_pose(field: &str, pose: &Value) -> Option<Problem> {
    let part = pose.as_object().and_then(|fields| {
        fields.iter().find_map(|(name, value)| match name.as_str() {
            "position" => wrong::<[f32; 3]>(&format!("{field}.position"), value),
            "rotation" => wrong::<[f32; 4]>(&format!("{field}.rotation"), value),
            _ => None,
        })
    });
    part.or_else(|| wrong::<Pose>(field, pose))
}

fn locate_in_parameters(parameters: &Value) -> Option<Problem> {
    let mut fields = parameters.as_object().into_iter().flatten();
    let one = |(name, value): (&String, &Value)| {
        wrong::<ParametersPatch>(&format!("parameters.{name}"), &json!({ name: value }))
    };
    fields.find_map(one).or_else(|| wrong::<ParametersPatch>("parameters", parameters))
}

fn locate_in_appearance(appearance: &Value) -> Option<Problem> {
    let mut sections = appearance.as_object().into_iter().flatten();
    let one = |(section, value): (&String, &Value)| {
        let mut fields = value.as_object().into_iter().flatten();
        let field = fields.find_map(|(name, value)| {
            let alone = json!({ section: { name: value } });
            wrong::<AppearancePatch>(&format!("appearance.{section}.{name}"), &alone)
        });
        let alone = json!({ section: value });
        field.or_else(|| wrong::<AppearancePatch>(&format!("appearance.{section}"), &alone))
    };
    sections.find_map(one).or_else(|| wrong::<AppearancePatch>("appearance", appearance))
}

fn wrong<T: DeserializeOwned>(field: &str, value: &Value) -> Option<Problem> {
    let error = T::deserialize(value).err()?;
    let text = without_place(&error.to_string());
    let message = format!("{field} cannot be read: {text}");
    let allowed = allowed(field);
    let message =
        allowed.as_ref().map_or(message.clone(), |allowed| format!("{message}; allowed: {allowed}"));
    Some(Problem { code: ProblemCode::Malformed, field: Some(field.into()), allowed, message })
}

/// Every kind of command.
const KINDS: &str = "stroke_begin, stroke_move, stroke_end, grow, lasso, stop, ungrow, undo, redo, \
     set_parameters, plant_seed, place_obstacle, move_obstacle, reshape_obstacle, remove_obstacle, \
     bend_begin, bend_move, bend_end, bend_cancel, set_width, prune, prune_dim, turn_branch, graft, go_to, take_future, set_appearance";

fn wrong_kind(kind: &Value) -> Option<Problem> {
    let known = kind.as_str().is_some_and(|kind| KINDS.split(", ").any(|known| known == kind));
    (!known).then(|| Problem {
        code: ProblemCode::Malformed,
        field: Some("kind".into()),
        allowed: Some(KINDS.into()),
        message: format!("kind is {kind}; allowed: {KINDS}"),
    })
}

/// What may stand in a field, for values so wrong that they never come to the range checks.
fn allowed(field: &str) -> Option<String> {
    let (outer, name) = field.rsplit_once('.').unwrap_or(("", field));
    let table = match outer.split_once('.') {
        None if outer == "parameters" => Some(ParameterValues::ROWS),
        Some(("appearance", section)) => {
            Appearance::TABLES.iter().find(|(name, _)| *name == section).map(|(_, rows)| *rows)
        }
        _ => None,
    };
    if let Some(rows) = table {
        return rows.iter().find(|row| row.name == name).map(|row| row.allowed());
    }
    Some(match name {
        "stroke" | "gesture" | "bud" | "id" | "bend" | "base" | "row" | "onto" | "step" | "future" => {
            format!("a whole number from 0 to {}", u32::MAX)
        }
        "steps" => format!("1 to {MAX_STEPS_PER_COMMAND}"),
        "depth" => "0.1 to 1".into(),
        "right" | "up" => "three numbers of length 1".into(),
        "rotation" => "four numbers that make a quaternion of length 1".into(),
        name if name.starts_with("outline[") => "two numbers, -1000 to 1000".into(),
        name if name.starts_with("touches[") || name.starts_with("rows[") => {
            format!("a whole number from 0 to {}", u32::MAX)
        }
        "touches" => format!("1 to {MAX_BEND_TOUCHES} rows"),
        "rows" => format!("1 to {MAX_PRUNED_ROWS} rows"),
        "diameter" => format!("{MIN_DIAMETER} to {MAX_DIAMETER}, or null"),
        "stretch" | "exposure" => "0 to 1".into(),
        "keep" => "true, false".into(),
        name if name.starts_with("targets[") => "three numbers, x and z -1000 to 1000, y -10 to 1000".into(),
        "position" | "origin" => "three numbers, x and z -1000 to 1000, y -10 to 1000".into(),
        "radius" => "0 to 40".into(),
        _ => return None,
    })
}

/// The text as JSON; numbers that JSON does not have, such as NaN or 1e999, stand in it as texts, so that the
/// field that holds one can be named.
fn readable(text: &str) -> Option<Value> {
    serde_json::from_str(text).ok().or_else(|| serde_json::from_str(&quoted_non_numbers(text)).ok())
}

fn quoted_non_numbers(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
        let end = match first {
            '"' => string_end(rest),
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(end);
        let is_number = token.parse::<f64>().is_ok();
        if first != '"' && is_number && serde_json::from_str::<f64>(token).is_err() {
            out.push('"');
            out.push_str(token);
            out.push('"');
        } else {
            out.push_str(token);
        }
        rest = after;
    }
    out
}

/// Where the JSON string that `text` begins with ends.
fn string_end(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::action::Action;

    #[test]
    fn every_unreadable_value_names_field_and_range() {
        for (text, field, allowed) in [
            (r#"{"kind":"grow","steps":-1}"#, "steps", "1 to 1000"),
            (r#"{"kind":"grow","steps":1.5}"#, "steps", "1 to 1000"),
            (
                r#"{"kind":"stroke_move","stroke":1,"samples":[{"position":[0,1,0],"radius":NaN}]}"#,
                "samples[0].radius",
                "0 to 40",
            ),
            (
                r#"{"kind":"stroke_move","stroke":1,"samples":[{"position":[0,1e999,0],"radius":1}]}"#,
                "samples[0].position",
                "three numbers, x and z -1000 to 1000, y -10 to 1000",
            ),
            (
                r#"{"kind":"set_parameters","parameters":{"apical_control":null}}"#,
                "parameters.apical_control",
                "0.4 to 0.7",
            ),
            (
                r#"{"kind":"set_parameters","parameters":{"max_shoot_length":-3}}"#,
                "parameters.max_shoot_length",
                "1 to 20",
            ),
            (
                r#"{"kind":"set_parameters","parameters":{"vigor_model":"priory"}}"#,
                "parameters.vigor_model",
                "borchert_honda, priority",
            ),
            (
                r#"{"kind":"lasso","outline":[[0,1],[NaN,1]],"plane":{}}"#,
                "outline[1]",
                "two numbers, -1000 to 1000",
            ),
            (
                r#"{"kind":"lasso","outline":[],"plane":{"right":[1,0]}}"#,
                "plane.right",
                "three numbers of length 1",
            ),
            (
                r#"{"kind":"move_obstacle","id":1,"pose":{"position":[0,"x",0]}}"#,
                "pose.position",
                "three numbers, x and z -1000 to 1000, y -10 to 1000",
            ),
            (r#"{"kind":"fell"}"#, "kind", KINDS),
        ] {
            let problem = Action::from_json(text).expect_err(text);
            assert_eq!(
                (problem.field.as_deref(), problem.allowed.as_deref()),
                (Some(field), Some(allowed)),
                "{text}"
            );
            assert!(problem.message.contains(allowed), "{}", problem.message);
        }
    }

    #[test]
    fn kinds_are_those_of_the_wire() {
        let error = serde_json::from_str::<espalier_proto::Command>(r#"{"kind":"?"}"#).expect_err("unknown");
        for kind in KINDS.split(", ") {
            assert!(error.to_string().contains(&format!("`{kind}`")), "{kind} is not on the wire: {error}");
        }
        assert_eq!(error.to_string().matches('`').count() / 2, KINDS.split(", ").count() + 1, "{error}");
    }
}
