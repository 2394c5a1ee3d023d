//! Strings of modules, and rules.

use crate::{
    expression::{Expr, Lost},
    grammar::{Ahead, Module, Neighbour, Rule},
    parser::{Parser, Scope, Section},
    source::{ARROW, Span},
    symbols::{POP, PUSH, Symbol, turtle},
};

/// Parameters of a module at most.
const MOST_PARAMETERS: usize = 16;
/// Parameters of a predecessor with its contexts at most.
const FRAME: usize = 64;
/// Brackets lie at most so deep in each other in one string.
const DEEPEST: usize = 64;
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
                    self.report.error_with(here, "no-symbol", "`~` names no surface", "write ~l");
                    return Err(Lost);
                };
                &rest[..1 + letter.len_utf8()]
            }
            Some(c) if c.is_alphabetic() => &rest[..c.len_utf8()],
            Some(c) if self.symbols.number(&rest[..c.len_utf8()]).is_some() => &rest[..c.len_utf8()],
            Some(c) => {
                let here = Span::new(start, start + c.len_utf8());
                let hint = match c {
                    '0'..='9' => "numbers stand in parentheses: F(2)",
                    '=' | '*' => "only parameters are computed: F(2*x)",
                    '@' | '?' => "docs/grammars.md lists the names that begin so",
                    _ => "names are letters, or declared: module Leaf",
                };
                self.report.error_with(here, "no-symbol", format!("`{c}` is no module"), hint);
                return Err(Lost);
            }
            None => {
                self.report.error(Span::at(start), "no-symbol", "a module is missing here");
                return Err(Lost);
            }
        };
        let length = name.len();
        let name = name.to_owned();
        self.at += length;
        let span = Span::new(start, self.at);
        let Some(symbol) = self.symbols.enter(&name) else {
            self.report.error(span, "too-many-symbols", "there are too many names");
            return Err(Lost);
        };
        Ok((symbol, span))
    }

    /// A string of modules up to the end.
    pub fn string(&mut self, scope: &Scope) -> Result<Vec<Module>, Lost> {
        let mut modules = Vec::new();
        let mut open: Vec<Span> = Vec::new();
        loop {
            self.skip_blanks();
            if self.rest().is_empty() {
                break;
            }
            let (symbol, span) = self.symbol()?;
            let arguments = if self.has_arguments() { self.arguments(scope)? } else { Vec::new() };
            match symbol {
                PUSH => open.push(span),
                POP if open.pop().is_none() => {
                    self.report.error(span, "bracket", "`]` ends a branch that has not begun");
                    return Err(Lost);
                }
                _ => {}
            }
            if open.len() > DEEPEST || modules.len() >= LONGEST {
                let message = "the string is too long, or its brackets lie too deep in each other";
                self.report.error(span, "too-long", message);
                return Err(Lost);
            }
            self.check_arguments(symbol, &arguments, span);
            modules.push(Module { symbol, arguments, place: span });
        }
        if let Some(&span) = open.last() {
            self.report.error(span, "bracket", "this branch has no end: `]` is missing");
        }
        Ok(modules)
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
            let message = format!("a module has at most {MOST_PARAMETERS} parameters");
            self.report.error(span, "parameter-count", message);
        }
        let least = turtle(symbol).map_or(0, |row| usize::from(row.least));
        let is_question = name.starts_with('?');
        // What is asked for may be left out: it is filled in.
        if arguments.len() < least && !(is_question && arguments.is_empty()) {
            let message = format!("`{name}` needs {least} parameters, and {} are here", arguments.len());
            self.report.error(span, "parameter-count", message);
        }
        if matches!(symbol, PUSH | POP) && !arguments.is_empty() {
            self.report.error(span, "parameter-count", "brackets have no parameters");
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
                parser.report.error(span, "bracket", "brackets cannot be rewritten");
                return Err(Lost);
            }
            Ok((symbol, arity))
        })?;
        let right = match right {
            Some(span) => self.within(span, |parser| parser.context(&mut scope, 0))?,
            None => Vec::new(),
        };
        if self.section != Section::Production && !(left.is_empty() && right.is_empty()) {
            let message = "rules of homomorphism and decomposition have no contexts";
            self.report.error(parts.predecessor, "misplaced", message);
        }
        if scope.parameters.len() > FRAME {
            let message = format!("a predecessor has at most {FRAME} parameters with its contexts");
            self.report.error(parts.predecessor, "parameter-count", message);
            return Err(Lost);
        }
        let condition = parts.condition.map(|span| self.within(span, |parser| parser.whole(&scope)));
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
            condition: condition.transpose()?,
            weight: weight.transpose()?,
            successor: successor?,
            place,
            at: (line, column),
        })
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
        // As old files say that there is no condition.
        let is_any = |span: &Span| matches!(self.source.slice(*span).trim(), "*" | "");
        let condition = condition.filter(|span| !is_any(span));
        let mut from = arrow + ARROW.len();
        let second = self.source.text[from..end].find(ARROW);
        if let Some(second) = second {
            let here = Span::new(from + second, from + second + ARROW.len());
            self.report.error_with(
                here,
                "two-arrows",
                "a rule has one arrow",
                "begin each rule on its own line",
            );
            return Err(Lost);
        }
        let behind = &self.source.text[from..end];
        let blanks = behind.len() - behind.trim_start().len();
        let mut weight = None;
        if behind.trim_start().starts_with('(') {
            let Some(length) = closing(&behind[blanks..]) else {
                self.report.error(Span::at(from + blanks), "missing", "`)` is missing");
                return Err(Lost);
            };
            weight = Some(Span::new(from + blanks + 1, from + blanks + length));
            from += blanks + length + 1;
        }
        let mut to = end;
        if let Some(colon) = last_colon(&self.source.text[from..end]) {
            if weight.is_some() {
                let here = Span::new(from + colon, end);
                self.report.error(here, "twice", "the rule has two probabilities");
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
            let hint = "left < module > right";
            self.report.error_with(span, "bad-context", "the contexts cannot be told apart", hint);
            return Err(Lost);
        }
        let strict = Span::new(less.map_or(start, |at| at + 1), greater.unwrap_or(end));
        Ok((less.map(|at| Span::new(start, at)), strict, greater.map(|at| Span::new(at + 1, end))))
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
                let hint = "compare in the condition: A(x) : x == 1 --> F";
                self.report.error_with(span, "no-name", "a predecessor has names as parameters", hint);
                return Err(Lost);
            }
            if scope.parameters.contains(&name) {
                self.report.error(span, "twice", format!("`{name}` names two parameters"));
            }
            scope.parameters.push(name);
            count += 1;
            if usize::from(count) > MOST_PARAMETERS {
                let message = format!("a module has at most {MOST_PARAMETERS} parameters");
                self.report.error(span, "parameter-count", message);
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
        let hint = "what stands beside it is a context: A < B > C";
        self.report.error_with(span, "predecessor", "a rule rewrites one module", hint);
        Err(Lost)
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
                        self.report.error(span, "bracket", "this branch has no end: `]` is missing");
                        return Err(Lost);
                    };
                    let inner = Span::new(self.at, self.at + length);
                    parts.push(Ahead::Branch(self.within(inner, |parser| parser.context(scope, depth + 1))?));
                    self.at += length + 1;
                }
                POP => {
                    self.report.error(span, "bracket", "`]` ends a branch that has not begun");
                    return Err(Lost);
                }
                _ => {
                    let first = scope.parameters.len() as u8;
                    let arity = self.parameters(scope)?;
                    if scope.parameters.len() > FRAME {
                        self.report.error(span, "parameter-count", "the contexts have too many parameters");
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
            let hint = "to the left stands the way to the root, which has no side branches";
            self.report.error_with(span, "bad-context", "a left context has no brackets", hint);
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
