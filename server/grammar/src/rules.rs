//! Strings of modules, and rules.

use std::fmt::Display;

use crate::{
    expression::{Expr, Lost},
    grammar::{Ahead, Locals, Module, Neighbour, Rule},
    parser::{Parser, Scope, Section},
    source::{ARROW, Span},
    symbols::{POP, PUSH, Symbol, turtle},
    wording,
};

/// Parameters of a module at most.
const MOST_PARAMETERS: usize = 16;
/// Parameters of a predecessor with its contexts at most.
const FRAME: usize = 64;
/// Brackets lie at most so deep in each other in one string.
const DEEPEST: usize = 64;
/// Macros lie at most so deep in each other.
const DEEPEST_MACRO: u32 = 16;
/// Modules of one string at most.
const LONGEST: usize = 10_000;

/// The parts of a rule's text.
struct Parts {
    predecessor: Span,
    condition: Option<Span>,
    successor: Span,
    weight: Option<Span>,
}

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
            Some(c) if c.is_alphabetic() => &rest[..c.len_utf8()],
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
    fn has_arguments(&mut self) -> bool {
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

    /// `left < module > right : condition --> successor : weight`.
    pub fn rule(&mut self) -> Result<Rule, Lost> {
        let place = Span::new(self.at, self.end);
        let parts = self.parts()?;
        let mut scope = Scope::default();
        let (left, strict, right) = self.sides(parts.predecessor)?;
        let left = match left {
            Some(span) => {
                let read = self.within(span, |parser| parser.context(&mut scope, 0))?;
                self.only_modules(read, span)?
            }
            None => Vec::new(),
        };
        let own = scope.parameters.len();
        let (symbol, arity) = self.within(strict, |parser| {
            parser.skip_blanks();
            let (symbol, span) = parser.symbol()?;
            let arity = parser.parameters(&mut scope)?;
            parser.expect_end_of_predecessor()?;
            if matches!(symbol, PUSH | POP) {
                parser.report.error(span, wording::REWRITTEN_BRACKET, []);
                return Err(Lost);
            }
            Ok((symbol, arity))
        })?;
        let right = match right {
            Some(span) => self.within(span, |parser| parser.context(&mut scope, 0))?,
            None => Vec::new(),
        };
        if self.section != Section::Production && !(left.is_empty() && right.is_empty()) {
            self.report.error(parts.predecessor, wording::MISPLACED_CONTEXT, []);
        }
        if scope.parameters.len() > FRAME {
            self.report.error(parts.predecessor, wording::FRAME_FULL, [("most", &FRAME)]);
            return Err(Lost);
        }
        let first_local = scope.parameters.len() as u8;
        let mut locals = Locals { first: first_local, ..Locals::default() };
        let condition = match parts.condition {
            Some(span) => self.within(span, |parser| parser.condition(&mut scope, &mut locals)),
            None => Ok(None),
        };
        let weight = parts.weight.map(|span| self.within(span, |parser| parser.whole(&scope)));
        let is_nothing = self.source.slice(parts.successor).trim() == "*";
        let successor = match is_nothing {
            true => Ok(Vec::new()),
            false => self.within(parts.successor, |parser| parser.string(&scope)),
        };
        let (line, column, _) = self.source.place(place);
        Ok(Rule {
            symbol,
            arity,
            left,
            right,
            own: own as u8,
            locals,
            condition: condition?,
            weight: weight.transpose()?,
            successor: successor?,
            place,
            at: (line, column),
        })
    }

    /// `{y = 2*x;} condition {z = y+1;}`: a condition, before and behind which numbers are given names. `*` or nothing
    /// holds always.
    fn condition(&mut self, scope: &mut Scope, locals: &mut Locals) -> Result<Option<Expr>, Lost> {
        self.statements(scope, locals)?;
        locals.before = locals.values.len();
        self.skip_blanks();
        let is_any = self.rest().is_empty() || self.rest().starts_with('{') || self.eat('*');
        let condition = if is_any { None } else { Some(self.expression(scope)?) };
        self.statements(scope, locals)?;
        self.expect_end()?;
        Ok(condition)
    }

    /// `{name = number; …}`, if it is there.
    fn statements(&mut self, scope: &mut Scope, locals: &mut Locals) -> Result<(), Lost> {
        self.skip_blanks();
        if !self.eat('{') {
            return Ok(());
        }
        loop {
            self.skip_blanks();
            if self.eat('}') {
                return Ok(());
            }
            let start = self.at;
            let name = self.word().to_owned();
            let span = Span::new(start, self.at.max(start + 1).min(self.end));
            self.skip_blanks();
            let assigns = self.rest().starts_with('=') && !self.rest().starts_with("==");
            if name.is_empty() || name.starts_with(|c: char| c.is_numeric()) || !assigns {
                let name = self.source.slice(span).to_owned();
                self.report.error(span, wording::STATEMENT_KIND, [("name", &name)]);
                return Err(Lost);
            }
            // A parameter or a name of before may be given another number: what follows means that.
            let is_new = !scope.parameters.contains(&name);
            if is_new && self.defines.iter().any(|define| define.name == name) {
                self.report.error(span, wording::STATEMENT_NAME, [("name", &name)]);
                return Err(Lost);
            }
            self.at += 1;
            locals.values.push(self.expression(scope)?);
            scope.parameters.push(name);
            if scope.parameters.len() > FRAME {
                self.report.error(span, wording::FRAME_FULL, [("most", &FRAME)]);
                return Err(Lost);
            }
            self.skip_blanks();
            if !self.eat(';') && !self.rest().starts_with('}') {
                self.expect('}')?;
            }
        }
    }

    fn whole(&mut self, scope: &Scope) -> Result<Expr, Lost> {
        let read = self.expression(scope)?;
        self.expect_end()?;
        Ok(read)
    }

    /// Cuts a rule into its parts.
    fn parts(&mut self) -> Result<Parts, Lost> {
        let (start, end) = (self.at, self.end);
        let arrow = start + self.rest().find(ARROW).unwrap_or(0);
        let before = &self.source.text[start..arrow];
        let colon = before.find(':').map(|at| start + at);
        let predecessor = Span::new(start, colon.unwrap_or(arrow));
        let condition = colon.map(|colon| Span::new(colon + 1, arrow));
        let mut from = arrow + ARROW.len();
        let second = self.source.text[from..end].find(ARROW);
        if let Some(second) = second {
            let here = Span::new(from + second, from + second + ARROW.len());
            self.report.error(here, wording::TWO_ARROWS, []);
            return Err(Lost);
        }
        let behind = &self.source.text[from..end];
        let blanks = behind.len() - behind.trim_start().len();
        let mut weight = None;
        if behind.trim_start().starts_with('(') {
            let Some(length) = closing(&behind[blanks..]) else {
                self.report.error(Span::at(from + blanks), wording::MISSING_AT_END, [("wanted", &')')]);
                return Err(Lost);
            };
            weight = Some(Span::new(from + blanks + 1, from + blanks + length));
            from += blanks + length + 1;
        }
        let mut to = end;
        if let Some(colon) = last_colon(&self.source.text[from..end]) {
            if weight.is_some() {
                let here = Span::new(from + colon, end);
                self.report.error(here, wording::PROBABILITY_TWICE, []);
                return Err(Lost);
            }
            weight = Some(Span::new(from + colon + 1, end));
            to = from + colon;
        }
        Ok(Parts { predecessor, condition, successor: Span::new(from, to), weight })
    }

    /// Cuts a predecessor at `<` and `>`.
    fn sides(&mut self, span: Span) -> Result<(Option<Span>, Span, Option<Span>), Lost> {
        let text = self.source.slice(span);
        let (start, end) = (span.start as usize, span.end as usize);
        let less = text.find('<').map(|at| start + at);
        let greater = text.find('>').map(|at| start + at);
        let is_odd = text.matches('<').count() > 1 || text.matches('>').count() > 1;
        if is_odd || less.zip(greater).is_some_and(|(less, greater)| greater < less) {
            self.report.error(span, wording::ODD_CONTEXTS, []);
            return Err(Lost);
        }
        let strict = Span::new(less.map_or(start, |at| at + 1), greater.unwrap_or(end));
        let (left, right) = (less.map(|at| Span::new(start, at)), greater.map(|at| Span::new(at + 1, end)));
        // `*` is any context, as in cpfg.
        let is_asked = |side: &Span| self.source.slice(*side).trim() != "*";
        Ok((left.filter(is_asked), strict, right.filter(is_asked)))
    }

    /// Names of parameters in parentheses, if there are any; returns how many.
    fn parameters(&mut self, scope: &mut Scope) -> Result<u8, Lost> {
        if !self.has_arguments() {
            return Ok(0);
        }
        let mut count = 0;
        self.skip_blanks();
        if self.eat(')') {
            return Ok(0);
        }
        loop {
            self.skip_blanks();
            let start = self.at;
            let name = self.word().to_owned();
            let span = Span::new(start, self.at.max(start + 1).min(self.end));
            if name.is_empty() || name.starts_with(|c: char| c.is_numeric()) {
                self.report.error(span, wording::NO_PARAMETER_NAME, []);
                return Err(Lost);
            }
            if scope.parameters.contains(&name) {
                self.report.error(span, wording::PARAMETER_TWICE, [("name", &name)]);
            }
            scope.parameters.push(name);
            count += 1;
            if usize::from(count) > MOST_PARAMETERS {
                self.report.error(span, wording::TOO_MANY_PARAMETERS, [("most", &MOST_PARAMETERS)]);
                return Err(Lost);
            }
            self.skip_blanks();
            if self.eat(')') {
                return Ok(count);
            }
            self.expect(',')?;
        }
    }

    fn expect_end_of_predecessor(&mut self) -> Result<(), Lost> {
        self.skip_blanks();
        if self.rest().is_empty() {
            return Ok(());
        }
        let span = Span::new(self.at, self.end);
        // A name of several letters that was not declared is read letter by letter.
        match self.name_around(span) {
            Some(word) => {
                let name = self.source.slice(word).to_owned();
                let count = name.chars().count();
                let values: [(_, &dyn Display); 2] = [("name", &name), ("count", &count)];
                self.report.error(word, wording::LONG_NAME, values);
            }
            None => self.report.error(span, wording::TWO_MODULES, []),
        }
        Err(Lost)
    }

    /// The word within which a place lies.
    fn name_around(&self, span: Span) -> Option<Span> {
        let is_letter = |c: char| c.is_alphanumeric() || c == '_';
        let text = &self.source.text[..span.end as usize];
        let start = text[..span.start as usize].trim_end_matches(is_letter).len();
        let rest = &text[start..];
        let name = &rest[..rest.find(|c| !is_letter(c)).unwrap_or(rest.len())];
        let word = Span::new(start, start + name.len());
        (word.start < span.start && span.start < word.end).then_some(word)
    }

    /// What must stand beside a module.
    fn context(&mut self, scope: &mut Scope, depth: usize) -> Result<Vec<Ahead>, Lost> {
        let mut parts = Vec::new();
        loop {
            self.skip_blanks();
            if self.rest().is_empty() {
                return Ok(parts);
            }
            let (symbol, span) = self.symbol()?;
            match symbol {
                PUSH => {
                    let Some(length) = branch_end(self.rest()).filter(|_| depth < DEEPEST) else {
                        self.report.error(span, wording::UNCLOSED, []);
                        return Err(Lost);
                    };
                    let inner = Span::new(self.at, self.at + length);
                    parts.push(Ahead::Branch(self.within(inner, |parser| parser.context(scope, depth + 1))?));
                    self.at += length + 1;
                }
                POP => {
                    self.report.error(span, wording::UNOPENED, []);
                    return Err(Lost);
                }
                _ => {
                    let first = scope.parameters.len() as u8;
                    let arity = self.parameters(scope)?;
                    if scope.parameters.len() > FRAME {
                        self.report.error(span, wording::FRAME_FULL, [("most", &FRAME)]);
                        return Err(Lost);
                    }
                    parts.push(Ahead::Module(Neighbour { symbol, arity, first }));
                }
            }
        }
    }

    fn only_modules(&mut self, parts: Vec<Ahead>, span: Span) -> Result<Vec<Neighbour>, Lost> {
        let module = |part| match part {
            Ahead::Module(module) => Some(module),
            Ahead::Branch(_) => None,
        };
        let modules: Option<Vec<_>> = parts.into_iter().map(module).collect();
        modules.ok_or_else(|| {
            self.report.error(span, wording::LEFT_BRACKETS, []);
            Lost
        })
    }
}

/// Bytes before the parenthesis that closes the first one.
fn closing(text: &str) -> Option<usize> {
    let mut open = 0;
    for (at, c) in text.char_indices() {
        match c {
            '(' => open += 1,
            ')' if open == 1 => return Some(at),
            ')' => open -= 1,
            _ => {}
        }
    }
    None
}

/// Bytes before the bracket that closes one which has just been opened.
fn branch_end(text: &str) -> Option<usize> {
    let mut open = 1;
    for (at, c) in text.char_indices() {
        match c {
            '[' => open += 1,
            ']' if open == 1 => return Some(at),
            ']' => open -= 1,
            _ => {}
        }
    }
    None
}

/// The last colon outside of parentheses.
fn last_colon(text: &str) -> Option<usize> {
    let mut open = 0i32;
    let mut found = None;
    for (at, c) in text.char_indices() {
        match c {
            '(' => open += 1,
            ')' => open -= 1,
            ':' if open == 0 => found = Some(at),
            _ => {}
        }
    }
    found
}
