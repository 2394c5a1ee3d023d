//! Why something is done to a document.

/// Who does something, and the gesture that it is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cause<'a> {
    /// The key of the client it is done for.
    pub(crate) author: &'a str,
    /// What one author does with the same gesture, one after the other, can be one operation for undo.
    pub(crate) gesture: Option<u32>,
}

impl<'a> From<&'a str> for Cause<'a> {
    /// An author, and no gesture.
    fn from(author: &'a str) -> Self {
        Self { author, gesture: None }
    }
}
