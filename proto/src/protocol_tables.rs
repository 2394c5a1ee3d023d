//! The tables of `PROTOCOL.md` that are written from those of this crate and of the settings.

use std::fmt::Write;

use espalier_settings::{Appearance, Kind, ParameterValues, Setting};
use serde::Serialize;
use serde_json::Value;

use crate::{
    packing::{Field, LEVELS, Shape},
    reason::Reason,
};

/// A table has no place in the document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("PROTOCOL.md has no line `{0}`, or no line `{END}` after it")]
pub struct MissingMarker(String);

const END: &str = "<!-- end of the table -->";

/// The document with every table between its markers written anew.
pub fn with_tables(document: &str) -> Result<String, MissingMarker> {
    let document = with_table(document, "fields", &fields())?;
    let document = with_table(&document, "parameters", &parameters())?;
    let document = with_table(&document, "looks", &looks())?;
    with_table(&document, "reasons", &reasons())
}

fn with_table(document: &str, name: &str, table: &str) -> Result<String, MissingMarker> {
    let begin = format!("<!-- table of {name}, written by generate-types -->");
    let parts = document.split_once(&begin).and_then(|(before, rest)| Some((before, rest.split_once(END)?)));
    let (before, (_, after)) = parts.ok_or_else(|| MissingMarker(begin.clone()))?;
    Ok(format!("{before}{begin}\n\n{table}\n{END}{after}"))
}

fn fields() -> String {
    let rows = Field::ALL.iter().enumerate().map(|(number, field)| {
        let shape = match field.shape() {
            Shape::Number => "number",
            Shape::Byte => "byte",
        };
        format!("| {number} | {} | {shape} |\n", field.name())
    });
    let levels: Vec<_> = LEVELS.iter().map(u16::to_string).collect();
    let rows: String = rows.collect();
    format!("Levels: {}.\n\n| line | field | told as |\n|---|---|---|\n{rows}", levels.join(", "))
}

fn parameters() -> String {
    let mut table = String::from("| name | symbol | default | allowed | |\n|---|---|---|---|---|\n");
    add_rows(&mut table, "", ParameterValues::ROWS, &json(&ParameterValues::default()), |row| {
        format!("| {} ", row.symbol.unwrap_or_default())
    });
    table
}

fn looks() -> String {
    let mut table = String::from("| field | default | allowed | |\n|---|---|---|---|\n");
    let defaults = json(&Appearance::default());
    for (section, rows) in Appearance::TABLES {
        add_rows(&mut table, &format!("{section}."), rows, &defaults[section], |_| String::new());
    }
    table
}

fn reasons() -> String {
    let rows = Reason::ALL.iter().map(|(reason, sentence)| {
        format!("| {} | {} | {sentence} |\n", in_words(&json(reason)), in_words(&json(&reason.code())))
    });
    format!("| reason | code | |\n|---|---|---|\n{}", rows.collect::<String>())
}

fn add_rows(
    table: &mut String,
    path: &str,
    rows: &[Setting],
    defaults: &Value,
    more: impl Fn(&Setting) -> String,
) {
    for row in rows {
        let unit = row.unit.map(|unit| format!(" {}", unit.name())).unwrap_or_default();
        let allowed = match row.kind {
            Kind::Choice { choices } => {
                choices.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
            }
            Kind::Number { .. } | Kind::Switch | Kind::Colour => row.allowed() + &unit,
        };
        let default = in_words(&defaults[row.name]);
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| `{path}{}` {}| {default} | {allowed} | {} |",
            row.name,
            more(row),
            row.sentence
        );
    }
}

fn in_words(value: &Value) -> String {
    match value {
        Value::String(name) => format!("`{name}`"),
        Value::Array(parts) => parts.iter().map(in_words).collect::<Vec<_>>().join(", "),
        number => number.to_string().trim_end_matches(".0").to_owned(),
    }
}

/// Plain values as JSON, by their names.
fn json(settings: &impl Serialize) -> Value {
    // Through text: a value of its own would show the numbers as 64 bits have them.
    let text = serde_json::to_string(settings).unwrap_or_default();
    serde_json::from_str(&text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_written_between_their_markers_again_and_again() {
        let marked =
            |name: &str| format!("<!-- table of {name}, written by generate-types -->\nformer rows\n{END}");
        let document = format!("before\n{}\nbetween\n{}\nafter", marked("parameters"), marked("looks"));
        let document = format!("{document}\n{}\n{}", marked("reasons"), marked("fields"));
        let written = with_tables(&document).expect("all have a place");
        assert!(written.starts_with("before\n<!--") && written.contains("-->\nafter\n<!--"));
        assert!(!written.contains("former rows") && written.contains("\nbetween\n"));
        assert!(written.contains("| `apical_control` | λ | 0.52 | 0.4 to 0.7 | Share of vigor"));
        assert!(
            written.contains("| `background.backdrop` | 226, 222, 214 | three whole numbers, 0 to 255 |")
        );
        assert!(written.contains("| `nothing-to-undo` | `refused` | There is nothing to undo. |"));
        assert!(written.contains("| 0 | code of a change, the first | number |"));
        assert_eq!(with_tables(&written), Ok(written.clone()));
    }

    #[test]
    fn a_missing_marker_is_named() {
        let error = with_tables("nothing").expect_err("no marker");
        assert!(error.to_string().contains("table of fields"), "{error}");
    }
}
