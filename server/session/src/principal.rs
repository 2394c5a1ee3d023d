//! Who does something.

use std::{fmt, sync::Arc};

/// What a client key may have besides letters and digits.
const OF_KEYS: [u8; 2] = *b"-_";
/// The name of every principal without a client key. It is shorter than the shortest key, so no client can have it.
const VISITOR: &str = "outside";

/// What those are called who did something elsewhere, before a number. No client key has a space.
const ELSEWHERE: &str = "author ";

/// Who does something, in every request, socket and journal entry.
///
/// A page is known by the client key it made up (`HS1`), a request without one comes from a visitor. Who may do what is
/// asked elsewhere, before anything reaches a session; this is whom history names.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Principal(Arc<str>);

impl Principal {
    /// What a client key is.
    pub const KEYS: &str = "8 to 64 letters, digits, - and _";

    /// The client with this key, if that is one ([`Principal::KEYS`]).
    pub fn client(key: &str) -> Option<Self> {
        let allowed = |byte: u8| byte.is_ascii_alphanumeric() || OF_KEYS.contains(&byte);
        ((8..=64).contains(&key.len()) && key.bytes().all(allowed)).then(|| Self(key.into()))
    }

    /// Someone who sends requests and has no key.
    pub fn visitor() -> Self {
        Self(VISITOR.into())
    }

    /// The author with this number of a document that people took along: nobody who comes in here.
    pub(crate) fn elsewhere(number: u32) -> Self {
        Self(format!("{ELSEWHERE}{number}").into())
    }

    /// Whether it is nobody who comes in here.
    pub(crate) fn is_elsewhere(&self) -> bool {
        self.0.starts_with(ELSEWHERE)
    }

    /// Reads what a principal is written as (`Display`).
    pub fn parse(text: &str) -> Option<Self> {
        if text == VISITOR { Some(Self::visitor()) } else { Self::client(text) }
    }

    /// The name that documents and snapshots keep of a principal; no two share one.
    pub fn name(&self) -> &str {
        &self.0
    }

    /// The principal of whom a document or a snapshot keeps this name.
    pub(crate) fn named(name: &str) -> Self {
        Self(name.into())
    }
}

impl fmt::Display for Principal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hs1_a_client_key_has_8_to_64_plain_characters() {
        for key in ["browser-1", "ABCD_efgh", &"k".repeat(64)] {
            assert_eq!(Principal::client(key).map(|who| who.to_string()).as_deref(), Some(key));
        }
        for key in ["", "outside", "seven_7", &"k".repeat(65), "with space", "größer-als", "semi;colon"] {
            assert_eq!(Principal::client(key), None, "{key}");
        }
    }

    #[test]
    fn what_is_written_is_read_again() {
        for principal in [Principal::visitor(), Principal::client("browser-1").expect("a key")] {
            assert_eq!(Principal::parse(&principal.to_string()), Some(principal));
        }
        assert_eq!(Principal::parse("nobody"), None);
    }
}
