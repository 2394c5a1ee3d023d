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
    /// What to write instead, where that depends on the construct.
    pub sign: Option<&'static str>,
    /// Bytes before it, and of it.
    pub from: usize,
    pub length: usize,
}

impl<'a> Foreign<'a> {
    fn new(wording: &'static Wording, name: &'a str, from: usize, length: usize) -> Self {
        Self { wording, name, sign: None, from, length }
    }
}

/// Values of Python that are no numbers here, and the numbers that stand for them.
const CONSTANTS: &[(&str, &str)] = &[("True", "1"), ("False", "0"), ("None", "0")];

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
    ("lambda", wording::PYTHON_LAMBDA),
    ("with", wording::PYTHON_STATEMENT),
    ("try", wording::PYTHON_STATEMENT),
    ("except", wording::PYTHON_STATEMENT),
    ("assert", wording::PYTHON_STATEMENT),
    ("pass", wording::PYTHON_STATEMENT),
    ("del", wording::PYTHON_STATEMENT),
    ("raise", wording::PYTHON_STATEMENT),
    ("yield", wording::PYTHON_STATEMENT),
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
    ("char", wording::C_NUMBER),
    ("long", wording::C_NUMBER),
    ("short", wording::C_NUMBER),
    ("unsigned", wording::C_NUMBER),
    ("const", wording::C_NUMBER),
    ("static", wording::C_NUMBER),
    ("bool", wording::C_NUMBER),
    ("switch", wording::C_STATEMENT),
    ("case", wording::C_STATEMENT),
    ("do", wording::C_STATEMENT),
    ("typedef", wording::C_STRUCT),
    ("enum", wording::C_STRUCT),
    ("void", wording::C_FUNCTION),
    ("struct", wording::C_STRUCT),
    ("derivation", wording::HEADER),
];

/// Functions of Python and C that are none here: what is said of them, and what to write instead where that depends.
const FUNCTIONS: &[(&str, &Wording, Option<&str>)] = &[
    ("sum", wording::PYTHON_LISTS, None),
    ("range", wording::PYTHON_LISTS, None),
    ("xrange", wording::PYTHON_LISTS, None),
    ("len", wording::PYTHON_LISTS, None),
    ("list", wording::PYTHON_LISTS, None),
    ("dict", wording::PYTHON_LISTS, None),
    ("tuple", wording::PYTHON_LISTS, None),
    ("map", wording::PYTHON_LISTS, None),
    ("zip", wording::PYTHON_LISTS, None),
    ("enumerate", wording::PYTHON_LISTS, None),
    ("sorted", wording::PYTHON_LISTS, None),
    ("array", wording::PYTHON_LISTS, None),
    ("Vector2", wording::PYTHON_LISTS, None),
    ("Vector3", wording::PYTHON_LISTS, None),
    ("AxialTree", wording::PYTHON_STRING, None),
    ("Lstring", wording::PYTHON_STRING, None),
    ("Lsystem", wording::PYTHON_STRING, None),
    ("ParamModule", wording::PYTHON_STRING, None),
    ("str", wording::PYTHON_STRING, None),
    ("random", wording::PYTHON_CHANCE, Some("ran(1)")),
    ("rand", wording::PYTHON_CHANCE, Some("ran(1)")),
    ("uniform", wording::PYTHON_CHANCE, Some("a + ran(b-a)")),
    ("randint", wording::PYTHON_CHANCE, Some("a + floor(ran(b-a+1))")),
    ("gauss", wording::PYTHON_CHANCE, Some("nran(m, s)")),
    ("int", wording::C_CAST, None),
    ("float", wording::C_CAST, None),
    ("double", wording::C_CAST, None),
];

/// Words of L-Py for what the turtle does, and the signs that stand for them here.
const TURTLE_WORDS: &[(&str, &str)] = &[
    ("Left", "+"),
    ("Right", "-"),
    ("Up", "^"),
    ("Down", "&"),
    ("RollL", "\\"),
    ("RollR", "/"),
    ("TurnAround", "|"),
    ("RollToVert", "$"),
    ("MoveTo", "@M"),
    ("SetHead", "@R"),
    ("SetWidth", "_"),
    ("IncWidth", "_"),
    ("DecWidth", "!"),
    ("SetColor", ";"),
    ("IncColor", ";"),
    ("DecColor", ","),
    ("Sphere", "@O"),
    ("Cut", "%"),
    ("Tropism", "@Tp"),
    ("Elasticity", "@Ts"),
];

/// The word of L-Py that a string goes on with, if nobody has declared it as a name, and what to write instead.
pub(crate) fn turtle_word(rest: &str) -> Option<(&'static str, &'static str)> {
    let length = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
    TURTLE_WORDS.iter().find(|row| row.0 == &rest[..length]).copied()
}

/// What is said of a function of another language, and what to write instead where that depends on it.
pub(crate) fn function(name: &str) -> Option<(&'static Wording, Option<&'static str>)> {
    FUNCTIONS.iter().find(|row| row.0 == name).map(|&(_, wording, sign)| (wording, sign))
}

/// The construct of another language that a line begins with.
pub(crate) fn foreign(line: &str) -> Option<Foreign<'_>> {
    let word_length = line.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(line.len());
    let (word, behind) = line.split_at(word_length);
    if line.starts_with('#') && !line.starts_with("#define") {
        let length = 1 + line[1..].find(|c: char| !c.is_alphanumeric()).unwrap_or(line.len() - 1);
        return Some(Foreign::new(wording::C_DIRECTIVE, &line[..length], 0, length));
    }
    if let Some(name) =
        ["==>", "::>", "::=", "=>"].into_iter().find(|arrow| line.contains(arrow) && !line.contains(ARROW))
    {
        return Some(Foreign::new(
            wording::NO_RULE_XL,
            name,
            line.find(name).unwrap_or_default(),
            name.len(),
        ));
    }
    let is_label = word.len() > 1 && word.starts_with('p') && word[1..].bytes().all(|c| c.is_ascii_digit());
    if matches!(word, "ω" | "omega") || is_label && behind.trim_start().starts_with(':') {
        return Some(Foreign::new(wording::NO_RULE_BOOK, word, 0, word_length));
    }
    if word == "angle" && behind.trim_start().starts_with("factor") {
        return Some(Foreign::new(wording::ANGLE_FACTOR, "angle factor", 0, word_length));
    }
    if let Some((before, successor)) = line.split_once(ARROW) {
        let predecessor = before.split(':').next().unwrap_or(before);
        if let Some(at) = predecessor.find("<<").or_else(|| predecessor.find(">>")) {
            let name = &line[at..at + 2];
            return Some(Foreign::new(wording::NEW_CONTEXT, name, at, 2));
        }
        let from = before.len() + ARROW.len();
        return assignment(successor)
            .map(|at| Foreign::new(wording::STATEMENT_IN_SUCCESSOR, "=", from + at, 1));
    }
    // A line with a word and a colon that is no header, and a call without an arrow, are told apart by the word alone.
    if let Some(&(name, wording)) = WORDS.iter().find(|row| row.0 == word) {
        let is_statement = behind.is_empty() || behind.starts_with([' ', '\t', '(', ':', '\n', '[']);
        let is_length =
            name == "derivation" && behind.trim_start().to_ascii_lowercase().starts_with("length");
        let is_number = behind.trim_start().starts_with('=');
        if is_statement && !is_length && !is_number {
            return Some(Foreign::new(wording, name, 0, word_length));
        }
    }
    if let Some(at) =
        ["++", "--"].iter().find(|sign| !word.is_empty() && behind.trim_start().starts_with(**sign))
    {
        return Some(Foreign::new(wording::C_STEP, at, word_length, behind.len().min(2)));
    }
    if header(line).is_none() {
        if let Some(body) = python_rule(line) {
            return Some(body);
        }
        let is_call = behind.trim_start().starts_with('(') && !word.is_empty();
        let is_method = behind.starts_with('.') && behind.contains('(');
        if is_call && !line.contains("->") || is_method {
            return Some(Foreign::new(wording::PYTHON_CALL, word, 0, word_length));
        }
    }
    if is_definition(line) {
        let value = line.split_once('=').map_or("", |(_, value)| value.trim_start());
        if value.starts_with('[') && value.contains(" for ") {
            return Some(Foreign::new(wording::PYTHON_COMPREHENSION, word, 0, word_length));
        }
        if value.starts_with(['[', '{', '"', '\'']) {
            return Some(Foreign::new(wording::PYTHON_LIST, word, 0, word_length));
        }
        let from = line.len() - value.len();
        let called =
            &value[..value.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(value.len())];
        if called == "lambda" {
            return Some(Foreign::new(wording::PYTHON_LAMBDA, called, from, called.len()));
        }
        let is_call = value[called.len()..].trim_start().starts_with('(');
        if let Some((wording, sign)) = function(called).filter(|_| is_call) {
            return Some(Foreign { sign, ..Foreign::new(wording, called, from, called.len()) });
        }
        if let Some(&(name, sign)) = CONSTANTS.iter().find(|row| row.0 == value.trim_end()) {
            let found = Foreign::new(wording::PYTHON_CONSTANT, name, from, name.len());
            return Some(Foreign { sign: Some(sign), ..found });
        }
        if let Some(name) = method(value) {
            return Some(Foreign::new(wording::PYTHON_METHOD, name, from, name.len()));
        }
    }
    None
}

/// A rule as L-Py writes it: behind the colon comes Python, on the same line or on indented ones.
fn python_rule(line: &str) -> Option<Foreign<'_>> {
    let first = line.lines().next().unwrap_or_default().trim_end();
    if let Some(predecessor) = first.strip_suffix(':') {
        // A word alone may be the slip of a header; what follows it tells.
        let is_rule = predecessor.contains('(') || line.contains('\n');
        let length = first.len();
        return is_rule.then_some(Foreign::new(wording::PYTHON_BLOCK, predecessor, 0, length));
    }
    let colon = first.find(':')?;
    let behind = first[colon + 1..].trim_start();
    let length = behind.find(|c: char| !c.is_alphanumeric()).unwrap_or(behind.len());
    let &(name, wording) = WORDS.iter().find(|row| row.0 == &behind[..length])?;
    Some(Foreign::new(wording, name, first.len() - behind.len(), length))
}

/// The method that a value calls: `curve.deepcopy` of `curve.deepcopy()`.
fn method(value: &str) -> Option<&str> {
    let length = value.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'))?;
    let name = &value[..length];
    let is_call = value[length..].starts_with('(') && name.starts_with(char::is_alphabetic);
    (is_call && name.contains('.')).then_some(name)
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
