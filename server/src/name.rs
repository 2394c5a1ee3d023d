//! Names that are keys: whoever knows one may come in.

use rand::RngExt;

/// Letters and digits that are not mistaken for each other when read aloud.
const ALPHABET: &[u8; 32] = b"abcdefghijkmnpqrstuvwxyz23456789";

const LENGTH: usize = 16;

/// A random name of 80 bits.
pub fn unguessable() -> String {
    let mut random = rand::rng();
    (0..LENGTH).map(|_| char::from(ALPHABET[random.random_range(0..ALPHABET.len())])).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn names_differ_and_fit_into_a_link() {
        let names: BTreeSet<String> = (0..1000).map(|_| unguessable()).collect();
        assert_eq!(names.len(), 1000);
        assert!(
            names
                .iter()
                .all(|name| name.len() == LENGTH && name.bytes().all(|byte| ALPHABET.contains(&byte)))
        );
        let used: BTreeSet<u8> = names.iter().flat_map(|name| name.bytes()).collect();
        assert_eq!(used.len(), ALPHABET.len());
    }
}
