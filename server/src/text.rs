//! Names and notes that people give.

use std::{borrow::Cow, str::FromStr};

use espalier_proto::{
    NotAllowed, Problem, Reason,
    version::{MAX_NAME_CHARACTERS, MAX_NOTE_CHARACTERS},
};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// Letters and symbols that show nothing: the fillers of Hangul and the empty braille pattern.
const BLANKS: [char; 5] = ['\u{115f}', '\u{1160}', '\u{2800}', '\u{3164}', '\u{ffa0}'];

/// A name: one line of 1 to 80 characters of which some can be seen.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Name(String);

impl Name {
    /// Its text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl From<Name> for String {
    fn from(Name(name): Name) -> Self {
        name
    }
}

impl TryFrom<String> for Name {
    type Error = NotAllowed;

    fn try_from(text: String) -> Result<Self, NotAllowed> {
        read_name(&text).map(Self).map_err(|(_, fault)| fault)
    }
}

impl FromStr for Name {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::try_from(text.to_owned()).map_err(|fault| format!("allowed: {}", fault.allowed))
    }
}

impl JsonSchema for Name {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Name".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "minLength": 1, "maxLength": MAX_NAME_CHARACTERS })
    }
}

/// The [`Name`] that a field holds.
pub fn name(field: &str, text: &str) -> Result<String, Problem> {
    read_name(text).map_err(|fault| refused(field, fault))
}

/// What is said of something: up to 2000 characters on any number of lines, or nothing.
pub fn note(text: &str) -> Result<String, Problem> {
    let note = text.trim();
    let length = note.chars().count();
    if length > MAX_NOTE_CHARACTERS {
        return Err(refused("note", wrong_length(length, 0, MAX_NOTE_CHARACTERS)));
    }
    if note.chars().any(|letter| misleads(letter) && !matches!(letter, '\n' | '\r' | '\t')) {
        return Err(refused("note", unseen("characters one can see, and new lines")));
    }
    Ok(note.to_owned())
}

/// Why a text is refused.
type Fault = (Reason, NotAllowed);

fn read_name(text: &str) -> Result<String, Fault> {
    let name = text.trim();
    let length = name.chars().count();
    if !(1..=MAX_NAME_CHARACTERS).contains(&length) {
        return Err(wrong_length(length, 1, MAX_NAME_CHARACTERS));
    }
    if name.chars().any(misleads) || !name.chars().any(is_seen) {
        return Err(unseen("characters one can see"));
    }
    Ok(name.to_owned())
}

fn wrong_length(length: usize, least: usize, most: usize) -> Fault {
    let found = format!("{length} characters long");
    (Reason::TextLength, NotAllowed::new(found, format!("{least} to {most} characters")))
}

fn unseen(allowed: &str) -> Fault {
    (Reason::TextUnseen, NotAllowed::new("not plain text", allowed))
}

fn refused(field: &str, (reason, fault): Fault) -> Problem {
    Problem { reason, ..Problem::out_of_range(field, fault.found, fault.allowed) }
}

/// The beginning of a text that came from anywhere, for a list that people read: what misleads is written as its number.
pub fn shown(text: &str, most: usize) -> String {
    let letters = text.chars().take(most);
    letters
        .flat_map(|letter| match misleads(letter) {
            true => letter.escape_unicode().collect::<Vec<_>>(),
            false => vec![letter],
        })
        .collect()
}

/// Whether a character controls how others are shown: a new line, or the direction of writing.
fn misleads(letter: char) -> bool {
    matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        || matches!(
            letter.general_category(),
            GeneralCategory::Control | GeneralCategory::LineSeparator | GeneralCategory::ParagraphSeparator
        )
}

fn is_seen(letter: char) -> bool {
    use GeneralCategory as Category;
    !BLANKS.contains(&letter)
        && !matches!(
            letter.general_category(),
            Category::SpaceSeparator
                | Category::Format
                | Category::NonspacingMark
                | Category::EnclosingMark
                | Category::PrivateUse
                | Category::Unassigned
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_misleads_is_shown_as_its_number() {
        assert_eq!(shown("Älter", 9), "Älter");
        assert_eq!(shown("a\nb\u{1b}[2J\u{202e}c", 9), "a\\u{a}b\\u{1b}[2J\\u{202e}c");
        assert_eq!(shown(&"x".repeat(60_000), 200).len(), 200);
    }

    #[test]
    fn lb5_names_are_trimmed_and_counted_in_characters() {
        assert_eq!(name("name", "  Old oak ").as_deref(), Ok("Old oak"));
        for good in [&"ö".repeat(80), "عربي", "می\u{200c}خواهم", "👨\u{200d}🌾", "e\u{301}", "木", "🌳", "-"]
        {
            assert_eq!(name("name", good).as_deref(), Ok(good));
        }
        for bad in ["", "   ", "\u{3000}", &"ö".repeat(81), "two\nlines", "bell\u{7}", "two\u{2028}lines"] {
            assert_eq!(name("author", bad).unwrap_err().field.as_deref(), Some("author"), "{bad:?}");
        }
        let message = name("name", "").unwrap_err().message;
        assert_eq!(message, "name is 0 characters long; allowed: 1 to 80 characters");
    }

    #[test]
    fn lb5_names_neither_mislead_nor_hide() {
        for bad in [
            "oak\u{202e}gpj.exe",
            "\u{2066}oak",
            "oak\u{200f}elm",
            "\u{61c}oak",
            "\u{200b}",
            "\u{200d}\u{feff}",
            "\u{3164}",
            "\u{2800}\u{2800}",
            "\u{301}",
            "\u{fe0f}",
            "\u{e0041}",
            "\u{ad}",
        ] {
            let problem = name("name", bad).unwrap_err();
            assert_eq!(problem.allowed.as_deref(), Some("characters one can see"), "{bad:?}");
        }
    }

    #[test]
    fn lb5_notes_have_lines() {
        assert_eq!(note(" two\nlines\t. ").as_deref(), Ok("two\nlines\t."));
        assert_eq!(note("").as_deref(), Ok(""));
        assert!(note(&"ö".repeat(2000)).is_ok());
        for bad in [&"ö".repeat(2001), "bell\u{7}", "oak\u{202e}"] {
            assert_eq!(note(bad).unwrap_err().field.as_deref(), Some("note"), "{bad:?}");
        }
    }
}
