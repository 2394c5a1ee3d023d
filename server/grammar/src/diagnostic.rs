//! What is wrong with a grammar's text, and where.

use std::fmt::{self, Display, Formatter};

use crate::{
    source::{Source, Span},
    wording::{Wording, filled},
};

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
    /// The name of its sentence among [all](crate::WORDINGS).
    pub id: &'static str,
    /// What stands in the sentence's braces.
    pub values: Vec<(&'static str, String)>,
    /// A sentence without its full stop.
    pub message: String,
    /// What to write instead.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// A sentence with its values, and where it belongs: line, column, length.
    pub(crate) fn new(
        severity: Severity,
        (line, column, length): (u32, u32, u32),
        wording: &'static Wording,
        values: Values,
    ) -> Self {
        Self {
            severity,
            line,
            column,
            length,
            code: wording.kind(),
            id: wording.id,
            message: filled(wording.message, &values),
            hint: wording.hint.map(|hint| filled(hint, &values)),
            values,
        }
    }
}

impl Display for Diagnostic {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let kind = match self.severity {
            Severity::Error => "",
            Severity::Warning => "warning: ",
        };
        write!(f, "line {}, column {}: {kind}{}", self.line, self.column, self.message)?;
        self.hint.iter().try_for_each(|hint| write!(f, " ({hint})"))
    }
}

/// Values for the braces of a sentence.
pub(crate) type Values = Vec<(&'static str, String)>;

#[derive(Debug)]
struct Found {
    span: Span,
    severity: Severity,
    wording: &'static Wording,
    values: Values,
}

/// Collects diagnostics while a text is read.
#[derive(Debug, Default)]
pub(crate) struct Report {
    found: Vec<Found>,
    has_errors: bool,
}

impl Report {
    pub fn error<const N: usize>(
        &mut self,
        span: Span,
        wording: &'static Wording,
        values: [(&'static str, &dyn Display); N],
    ) {
        self.add(span, Severity::Error, wording, written(&values));
    }

    pub fn warn<const N: usize>(
        &mut self,
        span: Span,
        wording: &'static Wording,
        values: [(&'static str, &dyn Display); N],
    ) {
        self.add(span, Severity::Warning, wording, written(&values));
    }

    pub fn add(&mut self, span: Span, severity: Severity, wording: &'static Wording, values: Values) {
        self.has_errors |= severity == Severity::Error;
        let is_known =
            self.found.iter().any(|known| known.span == span && known.wording.kind() == wording.kind());
        if self.found.len() < MAX_DIAGNOSTICS && !is_known {
            self.found.push(Found { span, severity, wording, values });
        }
    }

    pub fn has_errors(&self) -> bool {
        self.has_errors
    }

    /// How much has been found, for [`Report::forget`].
    pub fn mark(&self) -> (usize, bool) {
        (self.found.len(), self.has_errors)
    }

    /// Takes back what has been found since: it was a guess how to read something.
    pub fn forget(&mut self, mark: (usize, bool)) {
        self.found.truncate(mark.0);
        self.has_errors = mark.1;
    }

    /// In the order of the text.
    pub fn finish(mut self, source: &Source) -> Vec<Diagnostic> {
        self.found.sort_by_key(|found| found.span.start);
        let place = |Found { span, severity, wording, values }: Found| {
            Diagnostic::new(severity, source.place(span), wording, values)
        };
        self.found.into_iter().map(place).collect()
    }
}

pub(crate) fn written(values: &[(&'static str, &dyn Display)]) -> Values {
    values.iter().map(|&(name, value)| (name, value.to_string())).collect()
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
