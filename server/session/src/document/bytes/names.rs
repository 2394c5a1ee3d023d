//! What authors are called in a document.

use std::{borrow::Cow, collections::BTreeMap};

use crate::{
    document::{bending::OpenBends, history::History, history::Operation, strokes::OpenStrokes},
    principal::Principal,
};

/// The names of authors as they are written.
#[derive(Debug, Default)]
pub(super) enum Names {
    /// By their keys, for the store of the server.
    #[default]
    Keys,
    /// By a number, for files that people take along: keys leave the server to nobody (`PS6`).
    Numbers(BTreeMap<Principal, Principal>),
}

impl Names {
    /// Numbers for all authors of a line of time, in the order in which they first did something.
    pub(super) fn numbered(history: &History, strokes: &OpenStrokes, bends: &OpenBends) -> Self {
        let mut numbers = BTreeMap::new();
        let done = history.operations.iter().flat_map(Operation::authors);
        let open = strokes.open.iter().map(|open| &open.author);
        for author in done.chain(open).chain(bends.open.iter().map(|open| &open.author)) {
            let next = numbers.len() as u32 + 1;
            numbers.entry(author.clone()).or_insert_with(|| Principal::elsewhere(next));
        }
        Self::Numbers(numbers)
    }

    pub(super) fn of<'a>(&'a self, author: &'a Principal) -> Cow<'a, str> {
        match self {
            Self::Keys => author.name().into(),
            // Everybody is numbered; nobody's key is written where that should fail.
            Self::Numbers(numbers) => match numbers.get(author) {
                Some(number) => number.name().into(),
                None => Principal::elsewhere(0).name().to_owned().into(),
            },
        }
    }
}
