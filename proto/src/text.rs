//! Names and notes that people give.

use std::{fmt, str::FromStr};

use espalier_reading::NotAllowed;
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, SeqAccess, Visitor},
};
use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

use crate::{
    bounded::written_as,
    problem::Problem,
    reading::told,
    schema::{list, schemas, text},
    version::{MAX_COMMENT_CHARACTERS, MAX_NAME_CHARACTERS, MAX_NOTE_CHARACTERS, MAX_TAGS},
};

/// Letters and symbols that show nothing: the fillers of Hangul and the empty braille pattern.
const BLANKS: [char; 5] = ['\u{115f}', '\u{1160}', '\u{2800}', '\u{3164}', '\u{ffa0}'];

/// The most characters of an identifier.
const MAX_IDENTIFIER_CHARACTERS: usize = 64;

/// Declares texts by what reads them and what is said to be allowed.
macro_rules! texts {
    ($($(#[doc = $doc:literal])+ $name:ident: $least:expr, $most:expr, $allowed:expr, $read:expr;)+) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq, Eq, Serialize)]
        #[serde(transparent)]
        pub struct $name(String);

        impl $name {
            /// Its text.
            pub fn as_str(&self) -> &str {
                &self.0
            }
        }

        impl From<$name> for String {
            fn from($name(text): $name) -> Self {
                text
            }
        }

        impl TryFrom<&str> for $name {
            type Error = NotAllowed;

            fn try_from(text: &str) -> Result<Self, NotAllowed> {
                let read: fn(&str) -> Result<String, NotAllowed> = $read;
                read(text).map(Self)
            }
        }

        impl FromStr for $name {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                Self::try_from(text).map_err(|fault| format!("allowed: {}", fault.allowed))
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Reader;

                impl Visitor<'_> for Reader {
                    type Value = $name;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str(&$allowed)
                    }

                    fn visit_str<E: Error>(self, text: &str) -> Result<$name, E> {
                        $name::try_from(text).map_err(E::custom)
                    }
                }

                deserializer.deserialize_str(Reader)
            }
        }

        written_as! { $name as String; }
        schemas! { $name = |_| text($least, $most); }
    )+ };
}

texts! {
    /// A name: one line of 1 to 80 characters of which some can be seen (`LB5`).
    Name: 1, MAX_NAME_CHARACTERS, between(1, MAX_NAME_CHARACTERS), read_name;
    /// What is said of something: up to 2000 characters on any number of lines, or nothing (`LB5`).
    Note: 0, MAX_NOTE_CHARACTERS, between(0, MAX_NOTE_CHARACTERS), read_note;
    /// What somebody says: 1 to 4000 characters on any number of lines, of which some can be seen (`CT1`).
    Saying: 1, MAX_COMMENT_CHARACTERS, between(1, MAX_COMMENT_CHARACTERS), read_saying;
    /// A tag: a [`Name`] without a comma.
    Tag: 1, MAX_NAME_CHARACTERS, format!("{} without a comma", between(1, MAX_NAME_CHARACTERS)), read_tag;
    /// What a request calls something that may be there.
    Identifier: 0, MAX_IDENTIFIER_CHARACTERS, between(0, MAX_IDENTIFIER_CHARACTERS), read_identifier;
}

/// All tags of a tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Tags(Vec<Tag>);

impl Tags {
    fn allowed() -> String {
        format!("up to {MAX_TAGS} tags")
    }
}

impl From<Tags> for Vec<String> {
    fn from(Tags(tags): Tags) -> Self {
        tags.into_iter().map(String::from).collect()
    }
}

impl<'de> Deserialize<'de> for Tags {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl<'de> Visitor<'de> for Reader {
            type Value = Tags;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&Tags::allowed())
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Tags, A::Error> {
                let mut tags = Vec::new();
                while let Some(tag) = entries.next_element()? {
                    tags.push(tag);
                }
                if tags.len() <= MAX_TAGS {
                    return Ok(Tags(tags));
                }
                let fault = NotAllowed::new(format!("{} tags", tags.len()), Tags::allowed());
                Err(A::Error::custom(NotAllowed { kind: Some("many-tags"), ..fault }))
            }
        }

        deserializer.deserialize_seq(Reader)
    }
}

written_as! { Tags as Vec<String>; }
schemas! { Tags = |generator| list::<Tag>(generator, 0, MAX_TAGS); }

/// The [`Name`] that a field holds.
///
/// # Errors
///
/// The problem names the field and what is allowed there.
pub fn name(field: &str, text: &str) -> Result<String, Problem> {
    read_name(text).map_err(|fault| told(field, &fault))
}

/// The [`Note`] that a field called `note` holds.
///
/// # Errors
///
/// The problem names the field and what is allowed there.
pub fn note(text: &str) -> Result<String, Problem> {
    read_note(text).map_err(|fault| told("note", &fault))
}

fn between(least: usize, most: usize) -> String {
    format!("{least} to {most} characters")
}

fn read_name(text: &str) -> Result<String, NotAllowed> {
    let name = text.trim();
    check_length(name, 1, MAX_NAME_CHARACTERS)?;
    if name.chars().any(misleads) || !name.chars().any(is_seen) {
        return Err(unseen("characters one can see"));
    }
    Ok(name.to_owned())
}

fn read_tag(text: &str) -> Result<String, NotAllowed> {
    let tag = read_name(text)?;
    if tag.contains(',') {
        return Err(NotAllowed { kind: Some("tag-comma"), ..NotAllowed::new("two tags", "no comma") });
    }
    Ok(tag)
}

fn read_saying(text: &str) -> Result<String, NotAllowed> {
    let saying = read_lines(text, 1, MAX_COMMENT_CHARACTERS)?;
    if saying.chars().any(is_seen) { Ok(saying) } else { Err(unseen("characters one can see")) }
}

fn read_note(text: &str) -> Result<String, NotAllowed> {
    read_lines(text, 0, MAX_NOTE_CHARACTERS)
}

/// A text of several lines.
fn read_lines(text: &str, least: usize, most: usize) -> Result<String, NotAllowed> {
    let note = text.trim();
    check_length(note, least, most)?;
    if note.chars().any(|letter| misleads(letter) && !matches!(letter, '\n' | '\r' | '\t')) {
        return Err(unseen("characters one can see, and new lines"));
    }
    Ok(note.to_owned())
}

fn read_identifier(text: &str) -> Result<String, NotAllowed> {
    check_length(text, 0, MAX_IDENTIFIER_CHARACTERS).map(|()| text.to_owned())
}

fn check_length(text: &str, least: usize, most: usize) -> Result<(), NotAllowed> {
    let length = text.chars().count();
    if (least..=most).contains(&length) {
        return Ok(());
    }
    let fault = NotAllowed::new(format!("{length} characters long"), between(least, most));
    Err(NotAllowed { kind: Some("text-length"), ..fault })
}

fn unseen(allowed: &str) -> NotAllowed {
    NotAllowed { kind: Some("text-unseen"), ..NotAllowed::new("not plain text", allowed) }
}

/// Whether a character controls how others are shown: a new line, or the direction of writing.
pub fn misleads(letter: char) -> bool {
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
