//! Why something is done to a document.

use crate::principal::Principal;

/// Who does something, and the gesture that it is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cause<'a> {
    /// For whom it is done.
    pub(crate) author: &'a Principal,
    /// What one author does with the same gesture, one after the other, can be one operation for undo.
    pub(crate) gesture: Option<u32>,
}

impl<'a> From<&'a Principal> for Cause<'a> {
    /// An author, and no gesture.
    fn from(author: &'a Principal) -> Self {
        Self { author, gesture: None }
    }
}
