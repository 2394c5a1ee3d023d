//! A grammar as it was written.

use crate::{
    derivation::Place,
    diagnostic::Diagnostic,
    expression::Expr,
    parser::Parser,
    source::{Source, Span},
    symbols::{Symbol, Symbols},
};

/// Longest text of a grammar, in bytes.
pub const MAX_TEXT: usize = 128 * 1024;

/// A grammar that has been read: whatever it says can be carried out.
#[derive(Clone, Debug)]
pub struct Grammar {
    pub(crate) symbols: Symbols,
    pub(crate) heading: Heading,
    pub(crate) defines: Vec<Define>,
    pub(crate) sliders: Vec<SliderRow>,
    pub(crate) curves: Vec<Curve>,
    pub(crate) axiom: Vec<Module>,
    /// Line and column of what the axiom begins with.
    pub(crate) axiom_at: Place,
    pub(crate) rules: Vec<Rule>,
    pub(crate) homomorphism: Vec<Rule>,
    pub(crate) decomposition: Vec<Rule>,
    pub(crate) homomorphism_depth: u8,
    pub(crate) decomposition_depth: u8,
    /// Symbols that contexts pass over.
    pub(crate) ignored: Vec<Symbol>,
    /// The only symbols that contexts see, where the file says so.
    pub(crate) considered: Option<Vec<Symbol>>,
    pub(crate) timing: Vec<(Symbol, Expr, Span)>,
}

/// What a file says once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Heading {
    pub name: Option<String>,
    pub title: Option<String>,
    pub about: Option<String>,
    pub author: Option<String>,
    pub scale: Option<(Expr, Span)>,
    pub angle: Option<(Expr, Span)>,
    pub depth: Option<(Expr, Span)>,
    pub time_step: Option<(Expr, Span)>,
    pub seed: Option<(Expr, Span)>,
    pub buds: Option<Buds>,
    pub leaves: Option<Leaves>,
    pub widths: Option<Radii>,
}

/// Which leaves a plant bears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// Those that the grammar puts there, and no others.
    Grammar,
    /// Those that grow on such wood.
    Fill,
}

/// Which buds a plant gets beside those that go on growing by the grammar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buds {
    /// Only modules that rules rewrite are buds.
    Grammar,
    /// Nodes without branches get buds as growth lays them down, and axes end in one.
    Fill,
}

/// Where radii come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Radii {
    /// From the twigs that wood carries.
    Pipe,
    /// From the widths that the grammar sets.
    Grammar,
}

/// A number with a name.
#[derive(Clone, Debug)]
pub(crate) struct Define {
    pub name: String,
    pub value: Expr,
    pub place: Span,
}

/// A definition that may be set between two numbers.
#[derive(Clone, Debug)]
pub(crate) struct SliderRow {
    pub define: u16,
    pub from: f64,
    pub to: f64,
}

/// A function that goes from point to point in straight lines.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub name: String,
    pub points: Vec<(f64, f64)>,
}

/// A module of an axiom or a successor.
#[derive(Clone, Debug)]
pub(crate) struct Module {
    pub symbol: Symbol,
    pub arguments: Vec<Expr>,
    pub place: Span,
}

/// A module of a context; its parameters begin at a place in the frame of the rule.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Neighbour {
    pub symbol: Symbol,
    pub arity: u8,
    pub first: u8,
}

/// A part of what must stand to the right.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Ahead {
    Module(Neighbour),
    Branch(Vec<Ahead>),
}

/// Numbers that a rule gives names; they lie in its frame behind its parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Locals {
    /// Where in the frame the first lies.
    pub first: u8,
    pub values: Vec<Expr>,
    /// So many are computed before the condition, the others where it holds.
    pub before: usize,
}

/// A rule.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    pub symbol: Symbol,
    pub arity: u8,
    /// What must stand to the left, the nearest last.
    pub left: Vec<Neighbour>,
    pub right: Vec<Ahead>,
    /// Where the parameters of the module itself begin in the frame.
    pub own: u8,
    pub locals: Locals,
    pub condition: Option<Expr>,
    pub weight: Option<Expr>,
    pub successor: Vec<Module>,
    pub place: Span,
    /// Line and column.
    pub at: (u32, u32),
}

/// What was read, and what was noticed.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The grammar, where nothing is wrong with it.
    pub grammar: Option<Grammar>,
    /// What is wrong with it, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// A definition that users may set.
#[derive(Clone, Debug, PartialEq)]
pub struct Slider {
    /// Its name in the grammar.
    pub name: String,
    /// What the file sets it to.
    pub value: f64,
    /// The least it may be set to.
    pub from: f64,
    /// The most.
    pub to: f64,
}

impl Grammar {
    /// Reads a grammar and says all that is wrong with it.
    pub fn check(text: &str) -> Checked {
        Parser::read(&Source::new(text))
    }

    /// Reads a grammar from bytes, which must be text.
    pub fn check_bytes(bytes: &[u8]) -> Checked {
        match std::str::from_utf8(bytes) {
            Ok(text) => Self::check(text.strip_prefix('\u{feff}').unwrap_or(text)),
            Err(error) => {
                let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]).into_owned();
                Checked { grammar: None, diagnostics: vec![Parser::no_text(&Source::new(&good))] }
            }
        }
    }

    /// Reads a grammar.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn read(text: &str) -> Result<Self, Vec<Diagnostic>> {
        let Checked { grammar, diagnostics } = Self::check(text);
        grammar.ok_or(diagnostics)
    }

    /// What it is called: its title, or else its name.
    pub fn title(&self) -> Option<&str> {
        self.heading.title.as_deref().or(self.heading.name.as_deref())
    }

    /// A sentence about it.
    pub fn about(&self) -> Option<&str> {
        self.heading.about.as_deref()
    }

    /// Who wrote it.
    pub fn author(&self) -> Option<&str> {
        self.heading.author.as_deref()
    }

    /// The line and column of its axiom.
    pub fn axiom_place(&self) -> Place {
        self.axiom_at
    }

    /// Whether it asks where modules stand, so that what grows depends on surroundings.
    pub fn asks_places(&self) -> bool {
        crate::program::asks_places(self)
    }

    /// Whether it asks for what depends on the wood around, its own and others': light, free space or vigor.
    pub fn asks_of_wood(&self) -> bool {
        crate::program::asks_of_wood(self)
    }

    /// Whether it asks for vigor, to be derived or drawn.
    pub fn asks_of_vigor(&self) -> bool {
        crate::program::asks_of_vigor(self)
    }
}
