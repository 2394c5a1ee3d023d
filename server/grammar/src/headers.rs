//! Headers: lines that say something of the whole file, or begin a part of it.

use std::fmt::Display;

use crate::{
    diagnostic::nearest,
    expression::{Expr, Lost},
    grammar::{Buds, Curve, Define, Leaves, Radii, SliderRow},
    parser::{Macro, Parser, Scope, Section},
    source::{ARROW, Span, is_definition},
    wording,
};

/// What a line begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Header {
    Name,
    Title,
    About,
    Author,
    Scale,
    Angle,
    Depth,
    TimeStep,
    Seed,
    Buds,
    Leaves,
    Widths,
    Define,
    CDefine,
    Assignment,
    Slider,
    Curve,
    Module,
    Ignore,
    Consider,
    Axiom,
    Timing,
    MaximumDepth,
    Section(Section),
    End,
}

/// Names of headers, and whether a colon must follow. Of names that begin alike the longer stands first.
pub(crate) const HEADERS: &[(&str, bool, Header)] = &[
    ("endlsystem", false, Header::End),
    ("lsystem", true, Header::Name),
    ("title", true, Header::Title),
    ("about", true, Header::About),
    ("author", true, Header::Author),
    ("scale", true, Header::Scale),
    // As pfg and older files of cpfg have it.
    ("angle increment", true, Header::Angle),
    ("angle", true, Header::Angle),
    ("derivation length", true, Header::Depth),
    ("depth", true, Header::Depth),
    ("dt", true, Header::TimeStep),
    ("seed", true, Header::Seed),
    ("buds", true, Header::Buds),
    ("leaves", true, Header::Leaves),
    ("widths", true, Header::Widths),
    ("define", true, Header::Define),
    ("#define", false, Header::CDefine),
    ("slider", true, Header::Slider),
    ("func", true, Header::Curve),
    ("module", false, Header::Module),
    ("ignore", true, Header::Ignore),
    ("consider", true, Header::Consider),
    ("axiom", true, Header::Axiom),
    ("timing", true, Header::Timing),
    ("maximum depth", true, Header::MaximumDepth),
    ("productions", true, Header::Section(Section::Production)),
    ("production", true, Header::Section(Section::Production)),
    ("homomorphism", false, Header::Section(Section::Homomorphism)),
    ("interpretation", false, Header::Section(Section::Homomorphism)),
    ("decomposition", false, Header::Section(Section::Decomposition)),
];

/// The header that a line begins with, and its length in bytes.
pub(crate) fn header(line: &str) -> Option<(Header, usize)> {
    for &(name, needs_colon, header) in HEADERS {
        let Some(length) = begins_with(line, name) else { continue };
        let behind = &line[length..];
        let colon = behind.len() - behind.trim_start().len();
        if behind.trim_start().starts_with(':') {
            return Some((header, length + colon + 1));
        }
        // Without its colon a name must stand alone, or before a blank.
        let stands = behind.is_empty() || behind.starts_with(char::is_whitespace);
        if !needs_colon && stands && !line.contains(ARROW) {
            return Some((header, length));
        }
    }
    (is_definition(line) && !line.contains(ARROW)).then_some((Header::Assignment, 0))
}

/// The name of the header that a line begins with but for its colon, and what would stand behind that.
pub(crate) fn header_without_colon(line: &str) -> Option<(Header, &str, &str)> {
    HEADERS.iter().find_map(|&(name, _, header)| {
        let (name, rest) = line.split_at(begins_with(line, name)?);
        rest.starts_with([' ', '\t']).then_some((header, name, rest.trim()))
    })
}

/// How many bytes of a line are a name, in small or capital letters, with any blanks between its words.
fn begins_with(line: &str, name: &str) -> Option<usize> {
    let mut at = 0;
    for (number, word) in name.split(' ').enumerate() {
        if number > 0 {
            let rest = &line[at..];
            let blanks = rest.len() - rest.trim_start().len();
            if blanks == 0 {
                return None;
            }
            at += blanks;
        }
        let found = line.get(at..at + word.len())?;
        if !found.eq_ignore_ascii_case(word) {
            return None;
        }
        at += word.len();
    }
    Some(at)
}

/// Whether a line is a header rather than the rest of a string.
pub(crate) fn begins_header(line: &str) -> bool {
    header(line).is_some()
}

/// Whether a line names what other lines use.
pub(crate) fn is_definition_line(line: &str) -> bool {
    use Header::{Assignment, CDefine, Curve, Define, Module};
    matches!(header(line), Some((Define | CDefine | Assignment | Curve | Module, _)))
}

impl Parser<'_> {
    /// Reads what follows the name of a header.
    pub fn read_header(&mut self, header: Header, span: Span) -> Result<(), Lost> {
        let may_repeat = matches!(
            header,
            Header::Define
                | Header::CDefine
                | Header::Assignment
                | Header::Slider
                | Header::Curve
                | Header::Module
                | Header::Ignore
                | Header::Timing
                | Header::MaximumDepth
                | Header::Section(_)
        );
        if !may_repeat && self.seen.contains(&header) {
            let name = self.source.slice(span).trim_end_matches([':', ' ']);
            self.report.error(span, wording::HEADER_TWICE, [("name", &name)]);
            return Err(Lost);
        }
        self.seen.push(header);
        match header {
            Header::Name => self.heading.name = self.text(),
            Header::Title => self.heading.title = self.text(),
            Header::About => self.heading.about = self.text(),
            Header::Author => self.heading.author = self.text(),
            Header::Scale => self.heading.scale = Some((self.value()?, span)),
            Header::Angle => self.heading.angle = Some((self.value()?, span)),
            Header::Depth => self.heading.depth = Some((self.value()?, span)),
            Header::TimeStep => self.heading.time_step = Some((self.value()?, span)),
            Header::Seed => self.heading.seed = Some((self.value()?, span)),
            Header::Leaves => {
                let choices = [("grammar", Leaves::Grammar), ("fill", Leaves::Fill)];
                self.heading.leaves = Some(self.choice(&choices)?);
            }
            Header::Buds => {
                self.heading.buds = Some(self.choice(&[("grammar", Buds::Grammar), ("fill", Buds::Fill)])?);
            }
            Header::Widths => {
                let choices = [("pipe", Radii::Pipe), ("grammar", Radii::Grammar)];
                self.heading.widths = Some(self.choice(&choices)?);
            }
            Header::Define => self.definitions()?,
            Header::CDefine => self.directive()?,
            Header::Assignment => {
                let (name, place) = self.name()?;
                self.expect('=')?;
                let value = self.value()?;
                self.define(name, place, value);
            }
            Header::Slider => self.slider()?,
            Header::Curve => self.curve_points()?,
            Header::Module => self.declarations()?,
            Header::Ignore => {
                let names = self.module_names()?;
                self.ignored.extend(names);
            }
            Header::Consider => self.considered = Some(self.module_names()?),
            Header::Axiom => {
                let scope = Scope::default();
                self.axiom = Some(self.string(&scope)?);
            }
            Header::Timing => self.lifespans()?,
            Header::MaximumDepth => self.maximum_depth(span)?,
            Header::Section(section) => self.section = section,
            Header::End => self.is_over = true,
        }
        Ok(())
    }

    fn text(&mut self) -> Option<String> {
        let text = self.rest().split_whitespace().collect::<Vec<_>>().join(" ");
        self.at = self.end;
        (!text.is_empty()).then_some(text)
    }

    fn value(&mut self) -> Result<Expr, Lost> {
        let value = self.expression(&Scope::default())?;
        self.expect_end()?;
        Ok(value)
    }

    fn choice<T: Copy>(&mut self, choices: &[(&str, T)]) -> Result<T, Lost> {
        self.skip_blanks();
        let start = self.at;
        let word = self.word();
        let span = Span::new(start, self.at);
        self.expect_end()?;
        if let Some(found) = choices.iter().find(|choice| choice.0 == word) {
            return Ok(found.1);
        }
        let names: Vec<_> = choices.iter().map(|choice| choice.0).collect();
        self.report.error(span, wording::NO_CHOICE, [("choices", &names.join(" / "))]);
        Err(Lost)
    }

    /// A name of a number.
    fn name(&mut self) -> Result<(String, Span), Lost> {
        self.skip_blanks();
        let start = self.at;
        let name = self.word().to_owned();
        let span = Span::new(start, self.at);
        if name.is_empty() || name.starts_with(|c: char| c.is_numeric()) {
            self.report.error(span, wording::NO_NAME, []);
            return Err(Lost);
        }
        Ok((name, span))
    }

    fn define(&mut self, name: String, place: Span, value: Expr) {
        if self.defines.iter().any(|define| define.name == name) {
            self.report.error(place, wording::DEFINED_TWICE, [("name", &name)]);
            return;
        }
        self.defines.push(Define { name, value, place });
    }

    /// `#define NAME VALUE`: a number, or modules that stand where the name stands.
    fn directive(&mut self) -> Result<(), Lost> {
        let (name, place) = self.name()?;
        if self.rest().starts_with('(') {
            self.report.error(place, wording::MACRO_PARAMETERS, [("name", &name)]);
            return Err(Lost);
        }
        self.skip_blanks();
        let (mark, start) = (self.report.mark(), self.at);
        let value = self.value();
        let is_number = value.is_ok() && self.report.mark() == mark;
        let body = Span::new(start, self.end);
        // A word that is no number is more likely a slip in writing than a name for its letters.
        let is_word = self.source.slice(body).chars().all(|c| c.is_alphanumeric() || c == '_');
        let is_letter = self.source.slice(body).chars().count() == 1;
        if is_number || (is_word && !is_letter) {
            self.define(name, place, value?);
            return Ok(());
        }
        self.report.forget(mark);
        self.depth = 0;
        let number = self.source.slice(body).trim_end().strip_suffix(';');
        if let Some(value) = number.filter(|value| value.trim_end().parse::<f64>().is_ok()) {
            let values: [(_, &dyn Display); 2] = [("name", &name), ("value", &value.trim_end())];
            self.report.error(
                Span::new(start + value.len(), start + value.len() + 1),
                wording::MACRO_SEMICOLON,
                values,
            );
            return Err(Lost);
        }
        if self.is_defined(&name) {
            self.report.error(place, wording::DEFINED_TWICE, [("name", &name)]);
            return Err(Lost);
        }
        self.macros.push(Macro { name, body });
        Ok(())
    }

    fn is_defined(&self, name: &str) -> bool {
        self.defines.iter().any(|define| define.name == name)
            || self.macros.iter().any(|known| known.name == name)
    }

    /// `{ a = 1  b = 2 }`, or the same without braces.
    fn definitions(&mut self) -> Result<(), Lost> {
        self.skip_blanks();
        let in_braces = self.eat('{');
        loop {
            self.skip_blanks();
            if in_braces && self.eat('}') {
                return Ok(());
            }
            if self.rest().is_empty() && !in_braces {
                return Ok(());
            }
            let (name, place) = self.name()?;
            self.expect('=')?;
            let value = self.expression(&Scope::default())?;
            self.define(name, place, value);
            self.skip_blanks();
            let _separated = self.eat(',') || self.eat(';');
        }
    }

    fn slider(&mut self) -> Result<(), Lost> {
        let (name, span) = self.name()?;
        let (from, to) = (self.signed()?, self.signed()?);
        self.expect_end()?;
        let Some(define) = self.defines.iter().position(|define| define.name == name) else {
            let names = self.defines.iter().map(|define| define.name.as_str());
            match nearest(&name, names) {
                Some(near) => {
                    let values: [(_, &dyn Display); 2] = [("name", &name), ("near", &near)];
                    self.report.error(span, wording::UNDEFINED_NEAR, values);
                }
                None => self.report.error(span, wording::UNDEFINED, [("name", &name)]),
            }
            return Err(Lost);
        };
        if from >= to {
            let values: [(_, &dyn Display); 2] = [("from", &from), ("to", &to)];
            self.report.error(span, wording::EMPTY_RANGE, values);
            return Err(Lost);
        }
        if self.sliders.iter().any(|slider| usize::from(slider.define) == define) {
            self.report.error(span, wording::SLIDER_TWICE, [("name", &name)]);
            return Err(Lost);
        }
        self.sliders.push(SliderRow { define: define as u16, from, to });
        Ok(())
    }

    fn signed(&mut self) -> Result<f64, Lost> {
        self.skip_blanks();
        let is_negative = self.eat('-');
        let number = self.number()?;
        Ok(if is_negative { -number } else { number })
    }

    fn curve_points(&mut self) -> Result<(), Lost> {
        // Curves of cpfg have numbers for names.
        self.skip_blanks();
        let start = self.at;
        let name = self.word().to_owned();
        let span = Span::new(start, self.at);
        if name.is_empty() {
            self.report.error(span, wording::NO_NAME, []);
            return Err(Lost);
        }
        let mut points = Vec::new();
        self.skip_blanks();
        while !self.rest().is_empty() {
            let point = (self.signed()?, self.signed()?);
            points.push(point);
            self.skip_blanks();
        }
        if points.is_empty() || !points.is_sorted_by(|a: &(f64, f64), b| a.0 < b.0) {
            self.report.error(span, wording::BAD_CURVE, []);
            return Err(Lost);
        }
        if self.curves.iter().any(|curve| curve.name == name) {
            self.report.error(span, wording::DEFINED_TWICE, [("name", &name)]);
            return Err(Lost);
        }
        self.curves.push(Curve { name, points });
        Ok(())
    }

    /// `A, B(2), Internode(1)`: numbers of parameters are for readers, as rules say them as well.
    fn declarations(&mut self) -> Result<(), Lost> {
        loop {
            let (name, span) = self.name()?;
            if self.symbols.enter(&name).is_none() {
                self.report.error(span, wording::TOO_MANY_SYMBOLS, []);
                return Err(Lost);
            }
            if name.chars().count() > 1 {
                self.symbols.declare(&name);
            }
            self.skip_blanks();
            if self.eat('(') {
                let _count = self.rest().find(')').map(|length| self.at += length);
                self.expect(')')?;
                self.skip_blanks();
            }
            if !self.eat(',') {
                return self.expect_end();
            }
        }
    }

    fn module_names(&mut self) -> Result<Vec<u16>, Lost> {
        let mut names = Vec::new();
        loop {
            self.skip_blanks();
            let _separated = self.eat(',');
            self.skip_blanks();
            if self.rest().is_empty() {
                return Ok(names);
            }
            names.push(self.symbol()?.0);
        }
    }

    fn lifespans(&mut self) -> Result<(), Lost> {
        self.skip_blanks();
        while !self.rest().is_empty() {
            let (symbol, span) = self.symbol()?;
            let lifespan = self.operand(&Scope::default())?;
            if self.timing.iter().any(|row| row.0 == symbol) {
                self.report.error(span, wording::LIFESPAN_TWICE, [("name", &self.symbols.name(symbol))]);
                return Err(Lost);
            }
            self.timing.push((symbol, lifespan, span));
            self.skip_blanks();
            let _separated = self.eat(',');
            self.skip_blanks();
        }
        Ok(())
    }

    fn maximum_depth(&mut self, span: Span) -> Result<(), Lost> {
        const DEEPEST: f64 = 100.0;
        let depth = self.number()?;
        self.expect_end()?;
        if self.section == Section::Production {
            self.report.error(span, wording::MISPLACED_DEPTH, []);
            return Err(Lost);
        }
        if depth.fract() != 0.0 || depth < 1.0 {
            self.report.error(span, wording::MAXIMUM_DEPTH, []);
            return Err(Lost);
        }
        // Files of cpfg ask for thousands; what goes on beyond the most ends with an error that names the rule.
        if depth > DEEPEST {
            let values: [(_, &dyn Display); 2] = [("value", &depth), ("most", &DEEPEST)];
            self.report.warn(span, wording::DEPTH_TAKEN, values);
        }
        self.depths[self.section as usize] = Some(depth.min(DEEPEST) as u8);
        Ok(())
    }
}
