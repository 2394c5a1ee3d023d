//! What belongs to other programs for grammars and is left out here: told by name, so that nobody looks for a slip.

use crate::{
    headers::header,
    source::{ARROW, is_definition},
    wording::{self, Wording},
};

/// A construct of another language.
pub(crate) struct Foreign<'a> {
    pub wording: &'static Wording,
    pub name: &'a str,
    /// Bytes before it, and of it.
    pub from: usize,
    pub length: usize,
}

/// Words that begin such a construct.
const WORDS: &[(&str, &Wording)] = &[
    ("def", wording::PYTHON_FUNCTION),
    ("import", wording::PYTHON_IMPORT),
    ("from", wording::PYTHON_IMPORT),
    ("lpyimport", wording::PYTHON_IMPORT),
    ("for", wording::PYTHON_LOOP),
    ("while", wording::PYTHON_LOOP),
    ("if", wording::PYTHON_IF),
    ("elif", wording::PYTHON_ELSE),
    ("else", wording::PYTHON_ELSE),
    ("return", wording::PYTHON_RETURN),
    ("class", wording::PYTHON_CLASS),
    ("print", wording::PYTHON_PRINT),
    ("global", wording::PYTHON_GLOBAL),
    ("produce", wording::PYTHON_PRODUCE),
    ("nproduce", wording::PYTHON_PRODUCE),
    ("nsproduce", wording::PYTHON_PRODUCE),
    ("context", wording::PYTHON_CONTEXT),
    ("extern", wording::PYTHON_GLOBAL),
    ("Start", wording::STATEMENT_START),
    ("StartEach", wording::STATEMENT_EACH),
    ("End", wording::STATEMENT_END),
    ("EndEach", wording::STATEMENT_END),
    ("group", wording::GROUPS),
    ("endgroup", wording::GROUPS),
    ("sublsystem", wording::SUB_L_SYSTEMS),
    ("array", wording::C_ARRAY),
    ("external", wording::C_NUMBER),
    ("float", wording::C_NUMBER),
    ("double", wording::C_NUMBER),
    ("int", wording::C_NUMBER),
    ("void", wording::C_FUNCTION),
    ("struct", wording::C_STRUCT),
    ("derivation", wording::HEADER),
];

/// The construct of another language that a line begins with.
pub(crate) fn foreign(line: &str) -> Option<Foreign<'_>> {
    let word_length = line.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(line.len());
    let (word, behind) = line.split_at(word_length);
    if line.starts_with('#') && !line.starts_with("#define") {
        let length = 1 + line[1..].find(|c: char| !c.is_alphanumeric()).unwrap_or(line.len() - 1);
        return Some(Foreign { wording: wording::C_DIRECTIVE, name: &line[..length], from: 0, length });
    }
    if let Some((before, successor)) = line.split_once(ARROW) {
        let predecessor = before.split(':').next().unwrap_or(before);
        if let Some(at) = predecessor.find("<<").or_else(|| predecessor.find(">>")) {
            let name = &line[at..at + 2];
            return Some(Foreign { wording: wording::NEW_CONTEXT, name, from: at, length: 2 });
        }
        let from = before.len() + ARROW.len();
        return assignment(successor).map(|at| Foreign {
            wording: wording::STATEMENT_IN_SUCCESSOR,
            name: "=",
            from: from + at,
            length: 1,
        });
    }
    // A line with a word and a colon that is no header, and a call without an arrow, are told apart by the word alone.
    if let Some(&(name, wording)) = WORDS.iter().find(|row| row.0 == word) {
        let is_statement = behind.is_empty() || behind.starts_with([' ', '\t', '(', ':', '\n', '[']);
        let is_length =
            name == "derivation" && behind.trim_start().to_ascii_lowercase().starts_with("length");
        if is_statement && !is_length {
            return Some(Foreign { wording, name, from: 0, length: word_length });
        }
    }
    if header(line).is_none() {
        let found = |wording, length| Some(Foreign { wording, name: word, from: 0, length });
        if line.trim_end().ends_with(':') && line.contains('(') {
            return found(wording::PYTHON_BLOCK, line.len());
        }
        let is_call = behind.trim_start().starts_with('(') && !word.is_empty();
        let is_method = behind.starts_with('.') && behind.contains('(');
        if is_call && !line.contains("->") || is_method {
            return found(wording::PYTHON_CALL, word_length);
        }
    }
    if is_definition(line) {
        let value = line.split_once('=').map_or("", |(_, value)| value.trim_start());
        if value.starts_with(['[', '{', '"', '\'']) {
            return Some(Foreign { wording: wording::PYTHON_LIST, name: word, from: 0, length: word_length });
        }
    }
    None
}

/// Where a successor assigns a number, as the statements of L+C do.
fn assignment(successor: &str) -> Option<usize> {
    let mut open = 0i32;
    let bytes = successor.as_bytes();
    let is_sign = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(|c| b"=<>!".contains(c));
    for (at, byte) in successor.bytes().enumerate() {
        match byte {
            b'(' => open += 1,
            b')' => open -= 1,
            b'=' if open == 0 && !is_sign(at.checked_sub(1)) && !is_sign(Some(at + 1)) => return Some(at),
            _ => {}
        }
    }
    None
}
