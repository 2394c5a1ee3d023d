//! Rules: contexts, predecessors, conditions, successors and weights.

use std::fmt::Display;

use crate::{
    expression::{Expr, Lost},
    grammar::{Ahead, Locals, Neighbour, Rule},
    parser::{Parser, Scope, Section},
    reading::{FRAME, MOST_PARAMETERS},
    source::{ARROW, Span},
    strings::DEEPEST,
    symbols::{POP, PUSH},
    wording,
};

/// The parts of a rule's text.
struct Parts {
    predecessor: Span,
    condition: Option<Span>,
    successor: Span,
    weight: Option<Span>,
}

impl Parser<'_> {
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
