//! Texts that came from anywhere, for lists that people read.

use espalier_proto::text::misleads;

/// The beginning of a text; what misleads is written as its number.
pub fn shown(text: &str, most: usize) -> String {
    let letters = text.chars().take(most);
    letters
        .flat_map(|letter| match misleads(letter) {
            true => letter.escape_unicode().collect::<Vec<_>>(),
            false => vec![letter],
        })
        .collect()
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
}
