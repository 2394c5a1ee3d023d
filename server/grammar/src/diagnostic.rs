//! What is wrong with a grammar's text, and where.

use std::fmt;

use crate::source::{Source, Span};

/// So many diagnostics of one text are kept; what comes after is most often a consequence.
pub const MAX_DIAGNOSTICS: usize = 50;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The grammar cannot be used.
    Error,
    /// It can be used, but something in it does nothing or not what may have been meant.
    Warning,
}

/// One thing that is wrong with a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Line, counted from 1.
    pub line: u32,
    /// Character of the line, counted from 1.
    pub column: u32,
    /// Characters that it concerns; 0 where something is missing.
    pub length: u32,
    /// What kind it is; programs branch on it.
    pub code: &'static str,
    /// A sentence without its full stop.
    pub message: String,
    /// What to write instead.
    pub hint: Option<String>,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = match self.severity {
            Severity::Error => "",
            Severity::Warning => "warning: ",
        };
        write!(f, "line {}, column {}: {kind}{}", self.line, self.column, self.message)?;
        self.hint.iter().try_for_each(|hint| write!(f, " ({hint})"))
    }
}

/// Collects diagnostics while a text is read.
#[derive(Debug, Default)]
pub(crate) struct Report {
    found: Vec<(Span, Severity, &'static str, String, Option<String>)>,
    has_errors: bool,
}

impl Report {
    pub fn error(&mut self, span: Span, code: &'static str, message: impl Into<String>) {
        self.add(span, Severity::Error, code, message.into(), None);
    }

    pub fn error_with(
        &mut self,
        span: Span,
        code: &'static str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.add(span, Severity::Error, code, message.into(), Some(hint.into()));
    }

    pub fn warn(&mut self, span: Span, code: &'static str, message: impl Into<String>, hint: Option<String>) {
        self.add(span, Severity::Warning, code, message.into(), hint);
    }

    fn add(
        &mut self,
        span: Span,
        severity: Severity,
        code: &'static str,
        message: String,
        hint: Option<String>,
    ) {
        self.has_errors |= severity == Severity::Error;
        let is_known = self.found.iter().any(|known| known.0 == span && known.2 == code);
        if self.found.len() < MAX_DIAGNOSTICS && !is_known {
            self.found.push((span, severity, code, message, hint));
        }
    }

    pub fn has_errors(&self) -> bool {
        self.has_errors
    }

    /// In the order of the text.
    pub fn finish(mut self, source: &Source) -> Vec<Diagnostic> {
        self.found.sort_by_key(|found| found.0.start);
        let place = |(span, severity, code, message, hint): (Span, _, _, _, _)| {
            let (line, column, length) = source.place(span);
            Diagnostic { severity, line, column, length, code, message, hint }
        };
        self.found.into_iter().map(place).collect()
    }
}

/// The name of some that is most like another, if any is: at most two letters differ.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const FARTHEST: usize = 2;
    let best = known.into_iter().map(|other| (distance(name, other), other)).min();
    best.filter(|&(far, other)| far <= FARTHEST.min(other.len().max(name.len()) - 1)).map(|(_, other)| other)
}

/// Letters to put in, take out, exchange or swap with the next one.
fn distance(one: &str, other: &str) -> usize {
    const LONGEST: usize = 32;
    let one: Vec<char> = one.chars().take(LONGEST).flat_map(char::to_lowercase).collect();
    let other: Vec<char> = other.chars().take(LONGEST).flat_map(char::to_lowercase).collect();
    let mut rows = vec![(0..=other.len()).collect::<Vec<_>>()];
    for (i, a) in one.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, b) in other.iter().enumerate() {
            let mut best = (rows[i][j] + usize::from(a != b)).min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && *a == other[j - 1] && one[i - 1] == *b {
                best = best.min(rows[i - 1][j - 1] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[one.len()][other.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_names_are_near() {
        assert_eq!(nearest("sni", ["sin", "cos", "sqrt"]), Some("sin"));
        assert_eq!(nearest("frobnicate", ["sin", "cos"]), None);
        assert_eq!(nearest("q", ["a", "bb"]), None, "a single letter is like no other");
    }
}
