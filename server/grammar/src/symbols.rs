//! Names of modules: those that the turtle knows, and those of a grammar.

use std::collections::BTreeMap;

use espalier_plant::OrganKind;

use crate::wording::{self, Wording};

/// What the turtle does with a module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Action {
    Push,
    Pop,
    Draw,
    DrawInPieces,
    Move,
    Turn(f64),
    Pitch(f64),
    Roll(f64),
    TurnAbout,
    Level,
    SetHeading,
    SetPlace,
    Cut,
    Thinner,
    Thicker,
    SetScale,
    MultiplyScale,
    DivideScale,
    SetTropism,
    SetElasticity,
    BeginPolygon,
    EndPolygon,
    Vertex,
    /// An organ, as long as its parameter says times so much.
    Organ(OrganKind, f64),
    AskPlace,
    AskHeading,
    AskUp,
    AskLeft,
    AskLight,
    /// Known, and without effect on wood; why is said.
    Ignored(&'static Wording),
}

/// A symbol of the turtle: its name, what it does, and the least number of parameters.
pub(crate) struct TurtleSymbol {
    pub name: &'static str,
    pub action: Action,
    pub least: u8,
}

const fn row(name: &'static str, action: Action, least: u8) -> TurtleSymbol {
    TurtleSymbol { name, action, least }
}

/// All symbols that the turtle knows; the first rows are looked up by their numbers.
pub(crate) const TURTLE: &[TurtleSymbol] = &[
    // A branch begins.
    row("[", Action::Push, 0),
    // The branch ends.
    row("]", Action::Pop, 0),
    // Cuts off the rest of the branch.
    row("%", Action::Cut, 0),
    // One step forward that becomes wood, as long as its parameter says, else 1.
    row("F", Action::Draw, 0),
    // As F.
    row("G", Action::Draw, 0),
    // Forward as F, in pieces as long as the second parameter.
    row("nF", Action::DrawInPieces, 2),
    // One step forward without wood; what is drawn next stands by itself.
    row("f", Action::Move, 0),
    // As f.
    row("g", Action::Move, 0),
    // Turns left, about the turtle's up.
    row("+", Action::Turn(1.0), 0),
    // Turns right.
    row("-", Action::Turn(-1.0), 0),
    // Pitches down, about the turtle's left.
    row("&", Action::Pitch(1.0), 0),
    // Pitches up.
    row("^", Action::Pitch(-1.0), 0),
    // Rolls left, about the heading.
    row("\\", Action::Roll(-1.0), 0),
    // Rolls right.
    row("/", Action::Roll(1.0), 0),
    // Turns by 180°.
    row("|", Action::TurnAbout, 0),
    // Rolls until the turtle's left is level.
    row("$", Action::Level, 0),
    // As $.
    row("@v", Action::Level, 0),
    // Sets the heading (3 parameters), and up (3 more).
    row("@R", Action::SetHeading, 3),
    // Goes to a place.
    row("@M", Action::SetPlace, 3),
    // Sets the width, or without parameter multiplies it by 0.7.
    row("!", Action::Thinner, 0),
    // Sets the width, or without parameter divides it by 0.7.
    row("#", Action::Thicker, 0),
    // As #.
    row("_", Action::Thicker, 0),
    // Sets the scale of steps and widths.
    row("@D", Action::SetScale, 1),
    // Multiplies the scale.
    row("@Di", Action::MultiplyScale, 1),
    // Divides the scale.
    row("@Dd", Action::DivideScale, 1),
    // Sets the direction that wood bends to.
    row("@Tp", Action::SetTropism, 3),
    // Sets how far wood bends with each step, in radians.
    row("@Ts", Action::SetElasticity, 1),
    // A surface begins: no wood grows until it ends.
    row("{", Action::BeginPolygon, 0),
    // The surface ends, and is a leaf as long as its farthest vertex is away.
    row("}", Action::EndPolygon, 0),
    // A vertex of a surface.
    row(".", Action::Vertex, 0),
    // A leaf, as long as its parameter says, else as the look of the plant says.
    row("~l", Action::Organ(OrganKind::Leaf, 1.0), 0),
    // A flower.
    row("~f", Action::Organ(OrganKind::Flower, 1.0), 0),
    // A fruit.
    row("~k", Action::Organ(OrganKind::Fruit, 1.0), 0),
    // A sphere of a radius, which is a fruit.
    row("@O", Action::Organ(OrganKind::Fruit, 2.0), 0),
    // Is given the turtle's place.
    row("?P", Action::AskPlace, 3),
    // Is given the turtle's heading.
    row("?H", Action::AskHeading, 3),
    // Is given the turtle's up.
    row("?U", Action::AskUp, 3),
    // Is given the turtle's left.
    row("?L", Action::AskLeft, 3),
    // Is given the light at the turtle's place, 0 to 1.
    row("?E", Action::AskLight, 1),
    row(";", Action::Ignored(wording::NOT_DRAWN_COLOUR), 0),
    row(",", Action::Ignored(wording::NOT_DRAWN_COLOUR), 0),
    row("'", Action::Ignored(wording::NOT_DRAWN_COLOUR), 0),
    row("@o", Action::Ignored(wording::NOT_DRAWN_SOLID), 0),
    row("@B", Action::Ignored(wording::NOT_DRAWN_SOLID), 0),
    row("@b", Action::Ignored(wording::NOT_DRAWN_SOLID), 0),
    row("@Gs", Action::Ignored(wording::NOT_DRAWN_CYLINDER), 0),
    row("@Ge", Action::Ignored(wording::NOT_DRAWN_CYLINDER), 0),
    row("@Gc", Action::Ignored(wording::NOT_DRAWN_CYLINDER), 0),
    row("@Gr", Action::Ignored(wording::NOT_DRAWN_CYLINDER), 0),
    row("@Gt", Action::Ignored(wording::NOT_DRAWN_CYLINDER), 0),
    row("@#", Action::Ignored(wording::NOT_DRAWN_CONTOUR), 0),
    row("@c", Action::Ignored(wording::NOT_DRAWN_SOLID), 0),
    row("@PS", Action::Ignored(wording::NOT_DRAWN_SURFACE), 0),
    row("@PL", Action::Ignored(wording::NOT_DRAWN_SURFACE), 0),
    row("@PD", Action::Ignored(wording::NOT_DRAWN_SURFACE), 0),
    row("@Ti", Action::Ignored(wording::NOT_DRAWN_TROPISM), 0),
    row("@Tf", Action::Ignored(wording::NOT_DRAWN_TROPISM), 0),
    row("@Td", Action::Ignored(wording::NOT_DRAWN_TROPISM), 0),
    row("@C", Action::Ignored(wording::NOT_DRAWN_CONTOUR), 0),
    row("@L", Action::Ignored(wording::NOT_DRAWN_LABEL), 0),
    row("@S", Action::Ignored(wording::NOT_DRAWN_SCREEN), 0),
    row("@I", Action::Ignored(wording::NOT_DRAWN_SURFACE), 0),
];

/// The number of a symbol, in words and rules.
pub(crate) type Symbol = u16;
pub(crate) const PUSH: Symbol = 0;
pub(crate) const POP: Symbol = 1;
pub(crate) const CUT: Symbol = 2;

/// Most symbols of a grammar: single letters of any script, and declared names.
const MOST: usize = 4096;

/// The symbols of a grammar, those of the turtle first.
#[derive(Clone, Debug)]
pub(crate) struct Symbols {
    names: Vec<String>,
    numbers: BTreeMap<String, Symbol>,
    /// Names of more than one character, the longest first.
    long: Vec<String>,
}

impl Symbols {
    pub fn new() -> Self {
        let mut symbols = Self { names: Vec::new(), numbers: BTreeMap::new(), long: Vec::new() };
        for row in TURTLE {
            let _fits = symbols.enter(row.name);
            // `nF` is one only before a parenthesis, which whoever reads a string looks for.
            if row.name.len() > 1 && row.name != "nF" {
                symbols.declare(row.name);
            }
        }
        symbols
    }

    /// The number of a name, a new one if it has none; none when there are too many.
    pub fn enter(&mut self, name: &str) -> Option<Symbol> {
        if let Some(&number) = self.numbers.get(name) {
            return Some(number);
        }
        if self.names.len() >= MOST {
            return None;
        }
        let number = self.names.len() as Symbol;
        self.names.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        Some(number)
    }

    /// A name of several letters is one module from here on.
    pub fn declare(&mut self, name: &str) {
        if !self.long.iter().any(|known| known == name) {
            self.long.push(name.to_owned());
            self.long.sort_by_key(|name| std::cmp::Reverse(name.len()));
        }
    }

    /// The longest declared name that a text begins with.
    pub fn longest(&self, text: &str) -> Option<&str> {
        self.long.iter().find(|name| text.starts_with(name.as_str())).map(String::as_str)
    }

    pub fn name(&self, symbol: Symbol) -> &str {
        &self.names[symbol as usize]
    }

    pub fn len(&self) -> usize {
        self.names.len()
    }

    pub fn number(&self, name: &str) -> Option<Symbol> {
        self.numbers.get(name).copied()
    }
}

/// What a surface from a file stands for: any name behind `~` that the turtle does not know.
pub(crate) const SURFACE: Action = Action::Organ(OrganKind::Leaf, 1.0);

/// Whether a name is that of a surface.
pub(crate) fn is_surface(name: &str) -> bool {
    name.starts_with('~')
}

/// What the turtle does with a symbol.
pub(crate) fn turtle(symbol: Symbol) -> Option<&'static TurtleSymbol> {
    TURTLE.get(symbol as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::functions::FUNCTIONS;

    const PAGE: &str = include_str!("../../../docs/grammars.md");

    #[test]
    fn each_symbol_and_function_is_on_the_page() {
        for row in TURTLE {
            let name = if row.name == "|" { "\\|" } else { row.name };
            let is_there = PAGE.contains(&format!("`{name}`")) || PAGE.contains(&format!("`{name}("));
            assert!(is_there, "{} is not on the page", row.name);
        }
        for &(name, count, _) in FUNCTIONS {
            let is_there =
                PAGE.contains(&format!("`{name}(")) || (count == 0 && PAGE.contains(&format!("`{name}`")));
            assert!(is_there, "{name} is not on the page");
        }
    }

    #[test]
    fn the_longest_name_wins() {
        let mut symbols = Symbols::new();
        symbols.declare("Apex");
        symbols.declare("ApexB");
        assert_eq!(symbols.longest("ApexBud"), Some("ApexB"));
        assert_eq!(symbols.longest("@Dd(2)"), Some("@Dd"));
        assert_eq!(
            (symbols.number("["), symbols.number("]"), symbols.number("%")),
            (Some(PUSH), Some(POP), Some(CUT))
        );
    }
}
