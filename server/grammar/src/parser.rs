//! Reads a text line by line; what is wrong with one line does not hide what is wrong with the next.

use crate::{
    diagnostic::{Diagnostic, Report},
    expression::Lost,
    foreign::foreign,
    grammar::{Checked, Curve, Define, Grammar, Heading, MAX_TEXT, Module, Rule, SliderRow},
    headers::{Header, header, is_definition_line},
    review::review,
    source::{ARROW, Source, Span},
    symbols::{Symbol, Symbols},
};

/// Rules of a grammar at most.
const MOST_RULES: usize = 1000;
/// How often a decomposition goes on within a step, unless the file says otherwise.
const DECOMPOSITION_DEPTH: u8 = 10;

/// Names that an expression may use beside those of the file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scope {
    pub parameters: Vec<String>,
}

/// What rules belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Section {
    Production,
    Homomorphism,
    Decomposition,
}

/// A place in the text, and what has been read so far.
pub(crate) struct Parser<'a> {
    pub source: &'a Source,
    pub report: Report,
    pub at: usize,
    /// Nothing is read beyond this place.
    pub end: usize,
    /// Of the expression being read.
    pub depth: u32,
    pub symbols: Symbols,
    pub defines: Vec<Define>,
    pub curves: Vec<Curve>,
    pub section: Section,
    pub heading: Heading,
    pub sliders: Vec<SliderRow>,
    pub axiom: Option<Vec<Module>>,
    pub rules: [Vec<Rule>; 3],
    pub depths: [Option<u8>; 3],
    pub ignored: Vec<Symbol>,
    pub considered: Option<Vec<Symbol>>,
    pub timing: Vec<(Symbol, crate::expression::Expr)>,
    /// Names of rows of [`Heading`] that have been read.
    pub seen: Vec<Header>,
    /// The file has said that it is over.
    pub is_over: bool,
}

impl<'a> Parser<'a> {
    fn new(source: &'a Source) -> Self {
        Self {
            source,
            report: Report::default(),
            at: 0,
            end: source.text.len(),
            depth: 0,
            symbols: Symbols::new(),
            defines: Vec::new(),
            curves: Vec::new(),
            section: Section::Production,
            heading: Heading::default(),
            sliders: Vec::new(),
            axiom: None,
            rules: [const { Vec::new() }; 3],
            depths: [None; 3],
            ignored: Vec::new(),
            considered: None,
            timing: Vec::new(),
            seen: Vec::new(),
            is_over: false,
        }
    }

    /// The grammar of a text, or what is wrong with it.
    pub fn read(source: &'a Source) -> Checked {
        let mut parser = Self::new(source);
        if source.text.len() > MAX_TEXT {
            let message = format!("a grammar has at most {} KiB", MAX_TEXT / 1024);
            parser.report.error(Span::at(MAX_TEXT.min(source.text.len())), "too-long", message);
            return Checked { grammar: None, diagnostics: parser.report.finish(source) };
        }
        let lines = source.logical_lines();
        // Names first: strings are read by them, and definitions stand for numbers everywhere.
        for &line in &lines {
            if is_definition_line(source.slice(line)) {
                parser.read_line(line);
            }
        }
        for &line in &lines {
            if parser.is_over {
                break;
            }
            if !is_definition_line(source.slice(line)) {
                parser.read_line(line);
            }
        }
        parser.finish()
    }

    /// What is said of bytes that are no text, of which the beginning is.
    pub fn no_text(source: &Source) -> Diagnostic {
        let mut report = Report::default();
        report.error(Span::at(source.text.len()), "no-text", "it is not text in UTF-8 from here on");
        report.finish(source).remove(0)
    }

    fn read_line(&mut self, line: Span) {
        (self.at, self.end) = (line.start as usize, line.end as usize);
        // What is wrong has been reported.
        if let Err(Lost) = self.line() {
            self.depth = 0;
        }
    }

    fn line(&mut self) -> Result<(), Lost> {
        self.skip_blanks();
        if self.rest().is_empty() {
            return Ok(());
        }
        let rest = self.rest();
        if let Some(found) = foreign(rest) {
            let span = Span::new(self.at, self.at + found.length);
            self.report.error_with(span, found.code, found.message, found.hint);
            return Err(Lost);
        }
        if let Some((header, length)) = header(rest) {
            let start = self.at;
            self.at += length;
            self.read_header(header, Span::new(start, start + length))?;
            // Some headers share a line with what follows.
            return match header {
                Header::Section(_) | Header::Define => self.line(),
                _ => Ok(()),
            };
        }
        if rest.contains(ARROW) {
            let count: usize = self.rules.iter().map(Vec::len).sum();
            if count >= MOST_RULES {
                let message = format!("a grammar has at most {MOST_RULES} rules");
                self.report.error(Span::at(self.at), "too-many-rules", message);
                return Err(Lost);
            }
            let rule = self.rule()?;
            self.rules[self.section as usize].push(rule);
            return Ok(());
        }
        let span = Span::new(self.at, self.end);
        let message = "it is neither a rule nor a header";
        let has_arrow = ["->", "→", "⟶", "=>"].iter().any(|arrow| rest.contains(arrow));
        let hint = if has_arrow { "rules have the arrow -->" } else { "a rule is written A --> F" };
        self.report.error_with(span, "no-rule", message, hint);
        Err(Lost)
    }

    fn finish(mut self) -> Checked {
        let source = self.source;
        if !self.seen.contains(&Header::Axiom) {
            let here = Span::at(0);
            self.report.error_with(here, "no-axiom", "it has no axiom", "write axiom: F");
        }
        let [rules, homomorphism, decomposition] = std::mem::take(&mut self.rules);
        let [_, homomorphism_depth, decomposition_depth] = self.depths;
        let axiom = self.axiom.unwrap_or_default();
        let axiom_at = axiom.first().map_or((1, 1), |first| {
            let (line, column, _) = source.place(first.place);
            (line, column)
        });
        let grammar = Grammar {
            symbols: self.symbols,
            heading: self.heading,
            defines: self.defines,
            sliders: self.sliders,
            curves: self.curves,
            axiom,
            axiom_at,
            rules,
            homomorphism,
            decomposition,
            homomorphism_depth: homomorphism_depth.unwrap_or(1),
            decomposition_depth: decomposition_depth.unwrap_or(DECOMPOSITION_DEPTH),
            ignored: self.ignored,
            considered: self.considered,
            timing: self.timing,
        };
        let mut report = self.report;
        if !report.has_errors() {
            review(&grammar, &mut report);
        }
        let grammar = if report.has_errors() { None } else { Some(grammar) };
        Checked { grammar, diagnostics: report.finish(source) }
    }

    pub fn rest(&self) -> &'a str {
        &self.source.text[self.at..self.end]
    }

    pub fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub fn skip_blanks(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    pub fn eat(&mut self, wanted: char) -> bool {
        let is_next = self.rest().starts_with(wanted);
        if is_next {
            self.at += wanted.len_utf8();
        }
        is_next
    }

    pub fn expect(&mut self, wanted: char) -> Result<(), Lost> {
        self.skip_blanks();
        if self.eat(wanted) {
            return Ok(());
        }
        let message = match self.peek() {
            Some(found) => format!("`{wanted}` is missing before `{found}`"),
            None => format!("`{wanted}` is missing at the end"),
        };
        self.report.error(Span::at(self.at), "missing", message);
        Err(Lost)
    }

    /// Letters, digits and underscores from here; may be empty.
    pub fn word(&mut self) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    pub fn peeks_word(&self, word: &str) -> bool {
        let behind = self.rest().strip_prefix(word);
        behind.is_some_and(|behind| !behind.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    }

    /// A line holds no more than what has been read of it.
    pub fn expect_end(&mut self) -> Result<(), Lost> {
        self.skip_blanks();
        if self.at >= self.end {
            return Ok(());
        }
        let span = Span::new(self.at, self.end);
        self.report.error(span, "unexpected", "nothing more is expected on this line");
        Err(Lost)
    }

    /// Reads with another end.
    pub fn within<T>(&mut self, span: Span, read: impl FnOnce(&mut Self) -> T) -> T {
        let before = (self.at, self.end);
        (self.at, self.end) = (span.start as usize, span.end as usize);
        let read = read(self);
        (self.at, self.end) = before;
        read
    }
}
