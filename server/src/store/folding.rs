//! How texts are compared when trees are sorted and searched.

use espalier_growth::species;
use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

/// A text without the difference of large and small letters, and without accents.
pub fn folded(text: &str) -> String {
    let plain = |text: &str| -> String { text.nfkd().filter(|letter| !is_combining_mark(*letter)).collect() };
    // Some letters have their accents only once they are small.
    plain(&plain(text).to_lowercase())
}

/// A text without the difference of large and small letters, and of how accents are written.
pub(super) fn uncased(text: &str) -> String {
    text.nfc().collect::<String>().to_lowercase()
}

/// All that is searched of a tree, folded.
pub(super) fn searched(name: &str, tags: &[String], note: &str, species: Option<&str>) -> String {
    let parts = [name].into_iter().chain(tags.iter().map(String::as_str)).chain([note]).chain(species);
    folded(&parts.collect::<Vec<_>>().join("\n"))
}

/// What a searched word is found by, folded: itself, or any of its parts between bars; a part of a species' common or
/// botanical name by the species' short name as well.
pub(super) fn alternatives(word: &str) -> Vec<String> {
    let mut parts: Vec<String> = word.split('|').filter(|part| !part.is_empty()).map(folded).collect();
    if parts.is_empty() {
        parts.push(folded(word));
    }
    let is_named = |name: &str| {
        let name = folded(name);
        parts.iter().any(|part| part.chars().count() >= 3 && name.contains(part))
    };
    let named = species::all().iter().filter(|one| is_named(one.name) || is_named(one.botanical));
    let slugs: Vec<String> = named.map(|one| folded(one.slug)).collect();
    for slug in slugs {
        if !parts.contains(&slug) {
            parts.push(slug);
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_part_what_a_word_is_found_by() {
        for (word, expected) in [
            ("Oak", vec!["oak"]),
            ("querc", vec!["querc", "oak"]),
            ("Eiche|Öl|", vec!["eiche", "ol"]),
            ("|", vec!["|"]),
            ("||", vec!["||"]),
        ] {
            assert_eq!(alternatives(word), expected, "{word}");
        }
    }

    #[test]
    fn case_and_accents_make_no_difference() {
        for (text, expected) in
            [("Äpfel", "apfel"), ("ÉRABLE", "erable"), ("İris", "iris"), ("木", "木"), ("ﬁr", "fir")]
        {
            assert_eq!(folded(text), expected);
            assert_eq!(folded(expected), expected);
        }
    }
}
