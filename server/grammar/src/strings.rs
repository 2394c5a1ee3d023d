//! Strings of modules, and the macros in them.

use std::fmt::Display;

use crate::{
    expression::{Expr, Lost},
    foreign::turtle_word,
    grammar::Module,
    parser::{Parser, Scope},
    reading::MOST_PARAMETERS,
    source::Span,
    symbols::{POP, PUSH, Symbol, turtle},
    wording,
};

/// Brackets lie at most so deep in each other in one string.
pub(crate) const DEEPEST: usize = 64;
/// Macros lie at most so deep in each other.
const DEEPEST_MACRO: u32 = 16;
/// Modules of one string at most.
const LONGEST: usize = 10_000;
/// Modules of all strings of a text at most, and macros that stand for some: those may stand for each other.
const LONGEST_OF_ALL: usize = 200_000;

impl Parser<'_> {
    /// The name of one module.
    pub fn symbol(&mut self) -> Result<(Symbol, Span), Lost> {
        let named = self.at;
        if let Some(body) = self.macro_here()? {
            let symbol = self.in_macro(body, |parser| {
                let symbol = parser.symbol()?.0;
                parser.expect_end()?;
                Ok(symbol)
            })?;
            return Ok((symbol, Span::new(named, self.at)));
        }
        let rest = self.rest();
        let start = self.at;
        let name = match rest.chars().next() {
            _ if rest.starts_with("nF(") => "nF",
            _ if self.symbols.longest(rest).is_some() => self.symbols.longest(rest).unwrap_or_default(),
            // A surface: the sign and the letter that names it.
            Some('~') => {
                let letter = rest[1..].chars().next().filter(|c| c.is_alphanumeric());
                let Some(letter) = letter else {
                    let here = Span::new(start, start + 1);
                    self.report.error(here, wording::NO_SURFACE, []);
                    return Err(Lost);
                };
                &rest[..1 + letter.len_utf8()]
            }
            Some(c) if c.is_alphabetic() => {
                if let Some((word, sign)) = turtle_word(rest) {
                    let values: [(_, &dyn Display); 2] = [("name", &word), ("sign", &sign)];
                    self.report.error(Span::new(start, start + word.len()), wording::TURTLE_WORD, values);
                    return Err(Lost);
                }
                &rest[..c.len_utf8()]
            }
            Some(c) if self.symbols.number(&rest[..c.len_utf8()]).is_some() => &rest[..c.len_utf8()],
            Some(c) => {
                let row = match c {
                    '0'..='9' => wording::NO_MODULE_NUMBER,
                    '=' | '*' => wording::NO_MODULE_OPERATOR,
                    '@' | '?' => wording::NO_TURTLE_SYMBOL,
                    _ => wording::NO_MODULE,
                };
                // Names of the turtle are a sign and up to two letters.
                let more =
                    rest[c.len_utf8()..].chars().take(2).take_while(|c| c.is_ascii_alphabetic()).count();
                let more = if row == wording::NO_TURTLE_SYMBOL { more } else { 0 };
                let name = &rest[..c.len_utf8() + more];
                self.report.error(Span::new(start, start + name.len()), row, [("name", &name)]);
                return Err(Lost);
            }
            None => {
                self.report.error(Span::at(start), wording::MISSING_MODULE, []);
                return Err(Lost);
            }
        };
        let length = name.len();
        let name = name.to_owned();
        self.at += length;
        let span = Span::new(start, self.at);
        let Some(symbol) = self.symbols.enter(&name) else {
            self.report.error(span, wording::TOO_MANY_SYMBOLS, []);
            return Err(Lost);
        };
        Ok((symbol, span))
    }

    /// A string of modules up to the end.
    pub fn string(&mut self, scope: &Scope) -> Result<Vec<Module>, Lost> {
        let mut modules = Vec::new();
        let mut open: Vec<Span> = Vec::new();
        self.modules(scope, &mut modules, &mut open)?;
        if let Some(&span) = open.last() {
            self.report.error(span, wording::UNCLOSED, []);
        }
        Ok(modules)
    }

    fn modules(
        &mut self,
        scope: &Scope,
        modules: &mut Vec<Module>,
        open: &mut Vec<Span>,
    ) -> Result<(), Lost> {
        loop {
            self.skip_blanks();
            if self.rest().is_empty() {
                return Ok(());
            }
            let start = self.at;
            self.written += 1;
            if self.written > LONGEST_OF_ALL {
                self.report.error(Span::at(start), wording::STRING_TOO_LONG, []);
                return Err(Lost);
            }
            if let Some(body) = self.macro_here()? {
                // With parameters behind it the name stands for one module.
                if !self.rest().starts_with('(') {
                    self.in_macro(body, |parser| parser.modules(scope, modules, open))?;
                    continue;
                }
                self.at = start;
            }
            let (symbol, span) = self.symbol()?;
            let arguments = if self.has_arguments() { self.arguments(scope)? } else { Vec::new() };
            match symbol {
                PUSH => open.push(span),
                POP if open.pop().is_none() => {
                    self.report.error(span, wording::UNOPENED, []);
                    return Err(Lost);
                }
                _ => {}
            }
            if open.len() > DEEPEST || modules.len() >= LONGEST {
                self.report.error(span, wording::STRING_TOO_LONG, []);
                return Err(Lost);
            }
            self.check_arguments(symbol, &arguments, span);
            modules.push(Module { symbol, arguments, place: span });
        }
    }

    /// What the name that is next stands for, if it is a macro; it is read then.
    fn macro_here(&mut self) -> Result<Option<Span>, Lost> {
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        if self.macros.is_empty() || self.source.text[..self.at].ends_with(is_name) {
            return Ok(None);
        }
        let start = self.at;
        let name = self.word();
        let Some(known) = self.macros.iter().find(|known| known.name == name) else {
            self.at = start;
            return Ok(None);
        };
        if self.macro_depth >= DEEPEST_MACRO {
            let span = Span::new(start, self.at);
            self.report.error(span, wording::MACRO_DEPTH, [("name", &name)]);
            return Err(Lost);
        }
        Ok(Some(known.body))
    }

    fn in_macro<T>(
        &mut self,
        body: Span,
        read: impl FnOnce(&mut Self) -> Result<T, Lost>,
    ) -> Result<T, Lost> {
        self.macro_depth += 1;
        let read = self.within(body, read);
        self.macro_depth -= 1;
        read
    }

    /// Whether parameters follow a module: their parenthesis stands behind it at once, or after a blank.
    pub fn has_arguments(&mut self) -> bool {
        let start = self.at;
        self.skip_blanks();
        if self.eat('(') {
            return true;
        }
        self.at = start;
        false
    }

    fn check_arguments(&mut self, symbol: Symbol, arguments: &[Expr], span: Span) {
        let name = self.symbols.name(symbol).to_owned();
        if arguments.len() > MOST_PARAMETERS {
            self.report.error(span, wording::TOO_MANY_PARAMETERS, [("most", &MOST_PARAMETERS)]);
        }
        let least = turtle(symbol).map_or(0, |row| usize::from(row.least));
        let is_question = name.starts_with('?');
        // What is asked for may be left out: it is filled in.
        if arguments.len() < least && !(is_question && arguments.is_empty()) {
            let count = arguments.len();
            let values: [(_, &dyn Display); 3] = [("name", &name), ("least", &least), ("count", &count)];
            self.report.error(span, wording::TOO_FEW_PARAMETERS, values);
        }
        if matches!(symbol, PUSH | POP) && !arguments.is_empty() {
            self.report.error(span, wording::BRACKET_PARAMETERS, []);
        }
    }
}
