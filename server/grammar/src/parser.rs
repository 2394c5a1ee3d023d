//! Reads a text line by line; what is wrong with one line does not hide what is wrong with the next.

use std::fmt::Display;

use crate::{
    diagnostic::{Diagnostic, Report},
    expression::Lost,
    foreign::foreign,
    grammar::{Checked, Curve, Define, Grammar, Heading, MAX_TEXT, Module, Rule, SliderRow},
    headers::{Header, header, header_without_colon, is_definition_line},
    review::review,
    source::{ARROW, Source, Span},
    symbols::{Symbol, Symbols},
    wording,
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

/// A name that stands for modules, as the C preprocessor of cpfg has them.
#[derive(Clone, Debug)]
pub(crate) struct Macro {
    pub name: String,
    pub body: Span,
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
    pub macros: Vec<Macro>,
    /// How many macros are being read within each other.
    pub macro_depth: u32,
    /// Modules that strings have, and macros that were read in them.
    pub written: usize,
    pub section: Section,
    pub heading: Heading,
    pub sliders: Vec<SliderRow>,
    pub axiom: Option<Vec<Module>>,
    pub rules: [Vec<Rule>; 3],
    pub depths: [Option<u8>; 3],
    pub ignored: Vec<Symbol>,
    pub considered: Option<Vec<Symbol>>,
    pub timing: Vec<(Symbol, crate::expression::Expr, Span)>,
    /// Names of rows of [`Heading`] that have been read.
    pub seen: Vec<Header>,
    /// The file has said that it is over.
    pub is_over: bool,
}

/// Lines without the indented ones that belong to a block of another language: the line that begins it says all.
fn outside_of_blocks(source: &Source, lines: Vec<Span>) -> Vec<Span> {
    let mut is_in_block = false;
    let mut is_outside = |line: &Span| {
        let is_indented = source.text[..line.start as usize].ends_with([' ', '\t']);
        if is_in_block && is_indented {
            return false;
        }
        let first = source.slice(*line).lines().next().unwrap_or_default();
        is_in_block = first.trim_end().ends_with(':') && foreign(source.slice(*line)).is_some();
        true
    };
    lines.into_iter().filter(|line| is_outside(line)).collect()
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
            macros: Vec::new(),
            macro_depth: 0,
            written: 0,
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
            let most = MAX_TEXT / 1024;
            let end = Span::at(MAX_TEXT.min(source.text.len()));
            parser.report.error(end, wording::FILE_TOO_LONG, [("most", &most)]);
            return Checked { grammar: None, diagnostics: parser.report.finish(source) };
        }
        let lines = outside_of_blocks(source, source.logical_lines());
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
        report.error(Span::at(source.text.len()), wording::NO_TEXT, []);
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
            let start = self.at + found.from;
            let span = Span::new(start, start + found.length);
            match found.sign {
                Some(sign) => {
                    self.report.error(span, found.wording, [("name", &found.name), ("sign", &sign)])
                }
                None => self.report.error(span, found.wording, [("name", &found.name)]),
            }
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
                self.report.error(Span::at(self.at), wording::TOO_MANY_RULES, [("most", &MOST_RULES)]);
                return Err(Lost);
            }
            let rule = self.rule()?;
            self.rules[self.section as usize].push(rule);
            return Ok(());
        }
        let span = Span::new(self.at, self.end);
        if let Some((header, name, rest)) = header_without_colon(rest) {
            self.seen.push(header);
            let place = Span::new(self.at, self.at + name.len());
            self.report.error(place, wording::NO_COLON, [("name", &name as &dyn Display), ("rest", &rest)]);
            return Err(Lost);
        }
        let has_arrow = ["->", "→", "⟶", "=>"].iter().any(|arrow| rest.contains(arrow));
        self.report.error(span, if has_arrow { wording::NO_RULE_ARROW } else { wording::NO_RULE }, []);
        Err(Lost)
    }

    fn finish(mut self) -> Checked {
        let source = self.source;
        if !self.seen.contains(&Header::Axiom) {
            let here = Span::at(0);
            self.report.error(here, wording::NO_AXIOM, []);
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
        let here = Span::at(self.at);
        match self.peek() {
            Some(found) => {
                let values: [(_, &dyn Display); 2] = [("wanted", &wanted), ("found", &found)];
                self.report.error(here, wording::MISSING_BEFORE, values);
            }
            None => self.report.error(here, wording::MISSING_AT_END, [("wanted", &wanted)]),
        }
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
        self.report.error(span, wording::UNEXPECTED, []);
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
