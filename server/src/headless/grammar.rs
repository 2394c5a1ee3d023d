//! Plants of grammars, on the command line.

use std::{
    io::{self, Write},
    path::Path,
};

use espalier_proto::{Action, GrammarBody, Steps};
use espalier_session::{Document, grammar_notes, grammar_script};

use super::{HeadlessError, read};

/// The command that plants a grammar, and the depth that it leads to.
#[derive(Clone)]
pub(super) struct Planted {
    pub action: Action,
    pub depth: u32,
}

/// Reads a grammar; it is derived as deep as its text says, unless a depth is given. What there is to say of it goes to
/// stderr.
pub(super) fn planted(
    path: &Path,
    depth: Option<Steps>,
    space: Option<GrammarBody>,
) -> Result<Planted, HeadlessError> {
    let bytes = read(path).map_err(|cause| HeadlessError::Read { path: path.to_owned(), cause })?;
    let text = String::from_utf8_lossy(&bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut action = grammar_script(text, depth).map_err(|found| {
        let causes: Vec<String> = found.iter().map(ToString::to_string).collect();
        HeadlessError::Grammar { path: path.to_owned(), causes: causes.join("\n") }
    })?;
    let notes = grammar_notes(text);
    // A reader that has gone is no error of ours.
    let _ = notes.iter().try_for_each(|note| writeln!(io::stderr(), "Note: {}: {note}", path.display()));
    let depth = match &mut action {
        Action::SetGrammar { depth, within, .. } => {
            *within = space;
            depth.map_or(0, Steps::get)
        }
        _ => 0,
    };
    Ok(Planted { action, depth })
}

/// Whether a document's grammar came as deep as it should.
pub(super) fn check(document: &Document, wanted: u32) -> Result<(), HeadlessError> {
    match document.grammar_depth() {
        Some((reached, cause)) if reached < wanted => {
            let cause = cause.unwrap_or_else(|| "it holds as much as it may".to_owned());
            Err(HeadlessError::GrammarEnded { reached, wanted, cause })
        }
        _ => Ok(()),
    }
}
