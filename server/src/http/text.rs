//! Names and notes that people give.

use espalier_proto::{
    Problem, Reason,
    version::{MAX_NAME_CHARACTERS, MAX_NOTE_CHARACTERS},
};
use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// Letters and symbols that show nothing: the fillers of Hangul and the empty braille pattern.
const BLANKS: [char; 5] = ['\u{115f}', '\u{1160}', '\u{2800}', '\u{3164}', '\u{ffa0}'];

/// A name: one line of 1 to 80 characters of which some can be seen.
pub(super) fn name(field: &str, text: &str) -> Result<String, Problem> {
    let name = text.trim();
    let length = name.chars().count();
    if !(1..=MAX_NAME_CHARACTERS).contains(&length) {
        let value = format!("{length} characters long");
        return Err(Problem {
            reason: Reason::TextLength,
            ..Problem::out_of_range(field, value, format!("1 to {MAX_NAME_CHARACTERS} characters"))
        });
    }
    if name.chars().any(misleads) || !name.chars().any(is_seen) {
        return Err(unseen(field, "characters one can see"));
    }
    Ok(name.to_owned())
}

/// What is said of something: up to 2000 characters on any number of lines, or nothing.
pub(super) fn note(text: &str) -> Result<String, Problem> {
    let note = text.trim();
    let length = note.chars().count();
    if length > MAX_NOTE_CHARACTERS {
        let value = format!("{length} characters long");
        return Err(Problem {
            reason: Reason::TextLength,
            ..Problem::out_of_range("note", value, format!("0 to {MAX_NOTE_CHARACTERS} characters"))
        });
    }
    if note.chars().any(|letter| misleads(letter) && !matches!(letter, '\n' | '\r' | '\t')) {
        return Err(unseen("note", "characters one can see, and new lines"));
    }
    Ok(note.to_owned())
}

fn unseen(field: &str, allowed: &str) -> Problem {
    Problem { reason: Reason::TextUnseen, ..Problem::out_of_range(field, "not plain text", allowed) }
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
