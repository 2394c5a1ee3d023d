//! Expressions: a Pratt loop over the text.

use std::fmt::Display;

use crate::{
    diagnostic::nearest,
    foreign,
    functions::{FUNCTIONS, Function},
    parser::{Parser, Scope},
    source::Span,
    wording,
};

/// Parentheses, functions and operators lie at most so deep in each other.
const DEEPEST: u32 = 48;

/// An expression as it was written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expr {
    Number(f64),
    /// A definition of the file, by its row.
    Define(u16),
    /// A parameter of the modules of a rule's predecessor, counted from the left.
    Parameter(u8),
    Negative(Box<Expr>),
    Not(Box<Expr>),
    Binary(Binary, Box<Expr>, Box<Expr>),
    Choice(Box<[Expr; 3]>),
    Call(Function, Vec<Expr>),
    /// A curve of the file, by its row.
    Curve(u16, Box<Expr>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Binary {
    Or,
    And,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
}

/// Operators with their binding power: longer spellings first.
const OPERATORS: &[(&str, Binary, u8)] = &[
    ("||", Binary::Or, 2),
    ("&&", Binary::And, 3),
    ("==", Binary::Equal, 4),
    ("!=", Binary::NotEqual, 4),
    ("<=", Binary::LessOrEqual, 5),
    (">=", Binary::GreaterOrEqual, 5),
    ("<", Binary::Less, 5),
    (">", Binary::Greater, 5),
    ("+", Binary::Add, 6),
    ("-", Binary::Subtract, 6),
    ("**", Binary::Power, 9),
    ("*", Binary::Multiply, 7),
    ("/", Binary::Divide, 7),
    ("%", Binary::Remainder, 7),
    ("^", Binary::Power, 9),
];
/// Of a minus sign and a negation: -a^2 is -(a^2).
const PREFIX: u8 = 8;

/// The text cannot be read on from here; what is wrong has been reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Lost;

/// Functions of cpfg without a counterpart here, so that none of another name is taken for them.
const FUNCTIONS_OF_CPFG: [&str; 9] =
    ["bran", "biran", "curveX", "curveY", "curveZ", "srand", "stop", "printf", "fprintf"];

impl Parser<'_> {
    /// An expression up to where the text goes on otherwise.
    pub fn expression(&mut self, scope: &Scope) -> Result<Expr, Lost> {
        self.binding(scope, 0)
    }

    fn binding(&mut self, scope: &Scope, least: u8) -> Result<Expr, Lost> {
        self.depth += 1;
        let read = if self.depth > DEEPEST {
            let here = Span::at(self.at);
            self.report.error(here, wording::TOO_DEEP, [("most", &DEEPEST)]);
            Err(Lost)
        } else {
            self.binding_within(scope, least)
        };
        self.depth -= 1;
        read
    }

    fn binding_within(&mut self, scope: &Scope, least: u8) -> Result<Expr, Lost> {
        let mut left = self.operand(scope)?;
        let mut length = 0;
        loop {
            self.skip_blanks();
            let rest = self.rest();
            let is_assignment = rest.starts_with('=') && !rest.starts_with("==");
            if is_assignment {
                let here = Span::new(self.at, self.at + 1);
                self.report.error(here, wording::ASSIGNMENT, []);
                return Err(Lost);
            }
            for (word, sign) in [("and", "&&"), ("or", "||")] {
                if self.peeks_word(word) {
                    let here = Span::new(self.at, self.at + word.len());
                    let values: [(_, &dyn Display); 2] = [("name", &word), ("sign", &sign)];
                    self.report.error(here, wording::PYTHON_OPERATOR, values);
                    return Err(Lost);
                }
            }
            for (name, sign) in [("&", "&&"), ("|", "||")] {
                if rest.starts_with(name) && !rest.starts_with(sign) {
                    let values: [(_, &dyn Display); 2] = [("name", &name), ("sign", &sign)];
                    self.report.error(Span::new(self.at, self.at + 1), wording::BITS, values);
                    return Err(Lost);
                }
            }
            if least <= 1 && rest.starts_with('?') {
                self.at += 1;
                let yes = self.binding(scope, 1)?;
                self.expect(':')?;
                let no = self.binding(scope, 1)?;
                left = Expr::Choice(Box::new([left, yes, no]));
                continue;
            }
            let Some(&(sign, operator, power)) = OPERATORS.iter().find(|row| rest.starts_with(row.0)) else {
                return Ok(left);
            };
            if power < least {
                return Ok(left);
            }
            // Chains are trees that lean to the left; a tree must not be too deep to walk through.
            length += 1;
            if length > DEEPEST * 4 {
                let here = Span::new(self.at, self.at + sign.len());
                self.report.error(here, wording::CHAIN_TOO_LONG, []);
                return Err(Lost);
            }
            self.at += sign.len();
            let next = if operator == Binary::Power { power } else { power + 1 };
            let right = self.binding(scope, next)?;
            left = Expr::Binary(operator, Box::new(left), Box::new(right));
        }
    }

    /// A number, a name with or without parameters, or what stands in parentheses, with its signs.
    pub fn operand(&mut self, scope: &Scope) -> Result<Expr, Lost> {
        self.skip_blanks();
        let start = self.at;
        match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.binding(scope, 0)?;
                self.expect(')')?;
                Ok(inner)
            }
            Some('-') => {
                self.at += 1;
                Ok(Expr::Negative(Box::new(self.binding(scope, PREFIX)?)))
            }
            Some('+') => {
                self.at += 1;
                self.binding(scope, PREFIX)
            }
            Some('!') => {
                self.at += 1;
                Ok(Expr::Not(Box::new(self.binding(scope, PREFIX)?)))
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number().map(Expr::Number),
            Some(c) if c.is_alphabetic() || c == '_' => {
                let name = self.word().to_owned();
                self.named(scope, &name, start)
            }
            Some(c @ ('[' | '"' | '\'')) => Err(self.foreign_operand(start, c)),
            Some(c) => {
                let here = Span::new(start, start + c.len_utf8());
                self.report.error(here, wording::NO_EXPRESSION, [("found", &c)]);
                Err(Lost)
            }
            None => {
                self.report.error(Span::at(start), wording::MISSING_EXPRESSION, []);
                Err(Lost)
            }
        }
    }

    /// A number without sign.
    pub fn number(&mut self) -> Result<f64, Lost> {
        self.skip_blanks();
        let start = self.at;
        let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        self.at += digits(self.rest());
        if self.rest().starts_with('.') {
            self.at += 1;
            self.at += digits(self.rest());
        }
        let exponent = self.rest().strip_prefix(['e', 'E']).map(|rest| {
            let sign = usize::from(rest.starts_with(['+', '-']));
            (1 + sign, digits(&rest[sign..]))
        });
        if let Some((mark, digits)) = exponent.filter(|&(_, digits)| digits > 0) {
            self.at += mark + digits;
        }
        let span = Span::new(start, self.at);
        match self.source.slice(span).parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                self.report.error(span, wording::BAD_NUMBER, []);
                Err(Lost)
            }
        }
    }

    /// A function of Python or C, with what to write instead.
    fn foreign_function(&mut self, name: &str, span: Span) {
        let Some((wording, sign)) = foreign::function(name) else { return };
        match sign {
            Some(sign) => {
                let values: [(_, &dyn Display); 2] = [("name", &name), ("sign", &sign)];
                self.report.error(span, wording, values);
            }
            None => self.report.error(span, wording, [("name", &name)]),
        }
    }

    /// A list, a text or a function without a name, as other languages have them.
    fn foreign_operand(&mut self, start: usize, first: char) -> Lost {
        let here = Span::new(start, start + first.len_utf8());
        let within = self.rest().split(']').next().unwrap_or_default();
        let wording = match first {
            '[' if within.contains(" for ") => wording::PYTHON_COMPREHENSION,
            '[' => wording::PYTHON_LIST_HERE,
            _ => wording::PYTHON_TEXT,
        };
        self.report.error(here, wording, []);
        Lost
    }

    fn named(&mut self, scope: &Scope, name: &str, start: usize) -> Result<Expr, Lost> {
        let span = Span::new(start, self.at);
        self.skip_blanks();
        let function = FUNCTIONS.iter().find(|row| row.0 == name);
        if name == "lambda" {
            self.report.error(span, wording::PYTHON_LAMBDA, [("name", &name)]);
            return Err(Lost);
        }
        if self.peek() == Some('(') {
            self.at += 1;
            if name == "func" {
                return self.curve(scope);
            }
            let arguments = self.arguments(scope)?;
            let Some(&(_, wanted, function)) = function else {
                let names = FUNCTIONS.iter().map(|row| row.0).chain(["func"]);
                match nearest(name, names) {
                    _ if foreign::function(name).is_some() => self.foreign_function(name, span),
                    _ if FUNCTIONS_OF_CPFG.contains(&name) => {
                        self.report.error(span, wording::CPFG_FUNCTION, [("name", &name)]);
                    }
                    Some(near) => {
                        let values: [(_, &dyn Display); 2] = [("name", &name), ("near", &near)];
                        self.report.error(span, wording::UNKNOWN_FUNCTION_NEAR, values);
                    }
                    None => self.report.error(span, wording::UNKNOWN_FUNCTION, [("name", &name)]),
                }
                return Ok(Expr::Number(0.0));
            };
            if arguments.len() != usize::from(wanted) {
                let count = arguments.len();
                let values: [(_, &dyn Display); 3] =
                    [("name", &name), ("wanted", &wanted), ("count", &count)];
                self.report.error(span, wording::ARGUMENT_COUNT, values);
                return Ok(Expr::Number(0.0));
            }
            return Ok(Expr::Call(function, arguments));
        }
        if let Some(at) = scope.parameters.iter().rposition(|known| known == name) {
            return Ok(Expr::Parameter(at as u8));
        }
        if let Some(at) = self.defines.iter().position(|define| define.name == name) {
            return Ok(Expr::Define(at as u16));
        }
        if let Some(&(_, 0, function)) = function {
            return Ok(Expr::Call(function, Vec::new()));
        }
        if name == "not" {
            let values: [(_, &dyn Display); 2] = [("name", &name), ("sign", &'!')];
            self.report.error(span, wording::PYTHON_OPERATOR, values);
            return Err(Lost);
        }
        let known = scope.parameters.iter().chain(self.defines.iter().map(|define| &define.name));
        let values: [(_, &dyn Display); 1] = [("name", &name)];
        match (function, nearest(name, known.map(String::as_str))) {
            _ if self.macros.iter().any(|known| known.name == name) => {
                self.report.error(span, wording::NAME_OF_MODULES, values);
            }
            (Some(_), _) => self.report.error(span, wording::NAME_OF_FUNCTION, values),
            (None, Some(near)) => {
                let values: [(_, &dyn Display); 2] = [("name", &name), ("near", &near)];
                self.report.error(span, wording::UNKNOWN_NAME_NEAR, values);
            }
            (None, None) => self.report.error(span, wording::UNKNOWN_NAME, values),
        }
        Ok(Expr::Number(0.0))
    }

    /// What follows `func(`: the name of a curve, and where on it.
    fn curve(&mut self, scope: &Scope) -> Result<Expr, Lost> {
        self.skip_blanks();
        let start = self.at;
        let name = self.word().to_owned();
        let span = Span::new(start, self.at);
        let found = self.curves.iter().position(|curve| curve.name == name);
        if found.is_none() {
            let is_number = !name.is_empty() && name.bytes().all(|c| c.is_ascii_digit());
            let row = if is_number { wording::UNKNOWN_CURVE_NUMBER } else { wording::UNKNOWN_CURVE };
            self.report.error(span, row, [("name", &name)]);
        }
        self.expect(',')?;
        let at = self.binding(scope, 0)?;
        self.expect(')')?;
        Ok(Expr::Curve(found.unwrap_or(0) as u16, Box::new(at)))
    }

    /// Expressions up to a closing parenthesis.
    pub fn arguments(&mut self, scope: &Scope) -> Result<Vec<Expr>, Lost> {
        let mut arguments = Vec::new();
        self.skip_blanks();
        if self.eat(')') {
            return Ok(arguments);
        }
        loop {
            arguments.push(self.binding(scope, 0)?);
            self.skip_blanks();
            if self.eat(')') {
                return Ok(arguments);
            }
            // Where the text ends it is the end of the parameters that is missing.
            self.expect(if self.rest().is_empty() { ')' } else { ',' })?;
        }
    }
}
