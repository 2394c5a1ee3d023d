//! Names of modules: those that the turtle knows, and those of a grammar.

use std::collections::BTreeMap;

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
    AskPlace,
    AskHeading,
    AskUp,
    AskLeft,
    AskLight,
    /// Known, and without effect on wood.
    Ignored,
}

/// A symbol of the turtle: its name, what it does, the least number of parameters, and what it does in words.
pub(crate) struct TurtleSymbol {
    pub name: &'static str,
    pub action: Action,
    pub least: u8,
    pub sentence: &'static str,
}

const fn row(name: &'static str, action: Action, least: u8, sentence: &'static str) -> TurtleSymbol {
    TurtleSymbol { name, action, least, sentence }
}

/// All symbols that the turtle knows; the first rows are looked up by their numbers.
pub(crate) const TURTLE: &[TurtleSymbol] = &[
    row("[", Action::Push, 0, "a branch begins"),
    row("]", Action::Pop, 0, "the branch ends"),
    row("%", Action::Cut, 0, "cuts off the rest of the branch"),
    row("F", Action::Draw, 0, "one step forward that becomes wood, as long as its parameter says, else 1"),
    row("G", Action::Draw, 0, "as F"),
    row("nF", Action::DrawInPieces, 2, "forward as F, in pieces as long as the second parameter"),
    row("f", Action::Move, 0, "one step forward without wood; what is drawn next stands by itself"),
    row("g", Action::Move, 0, "as f"),
    row("+", Action::Turn(1.0), 0, "turns left, about the turtle's up"),
    row("-", Action::Turn(-1.0), 0, "turns right"),
    row("&", Action::Pitch(1.0), 0, "pitches down, about the turtle's left"),
    row("^", Action::Pitch(-1.0), 0, "pitches up"),
    row("\\", Action::Roll(-1.0), 0, "rolls left, about the heading"),
    row("/", Action::Roll(1.0), 0, "rolls right"),
    row("|", Action::TurnAbout, 0, "turns by 180°"),
    row("$", Action::Level, 0, "rolls until the turtle's left is level"),
    row("@v", Action::Level, 0, "as $"),
    row("@R", Action::SetHeading, 3, "sets the heading (3 parameters), and up (3 more)"),
    row("@M", Action::SetPlace, 3, "goes to a place"),
    row("!", Action::Thinner, 0, "sets the width, or without parameter multiplies it by 0.7"),
    row("#", Action::Thicker, 0, "sets the width, or without parameter divides it by 0.7"),
    row("_", Action::Thicker, 0, "as #"),
    row("@D", Action::SetScale, 1, "sets the scale of steps and widths"),
    row("@Di", Action::MultiplyScale, 1, "multiplies the scale"),
    row("@Dd", Action::DivideScale, 1, "divides the scale"),
    row("@Tp", Action::SetTropism, 3, "sets the direction that wood bends to"),
    row("@Ts", Action::SetElasticity, 1, "sets how far wood bends with each step, in radians"),
    row("{", Action::BeginPolygon, 0, "a surface begins: no wood grows until it ends"),
    row("}", Action::EndPolygon, 0, "the surface ends"),
    row("?P", Action::AskPlace, 3, "is given the turtle's place"),
    row("?H", Action::AskHeading, 3, "is given the turtle's heading"),
    row("?U", Action::AskUp, 3, "is given the turtle's up"),
    row("?L", Action::AskLeft, 3, "is given the turtle's left"),
    row("?E", Action::AskLight, 1, "is given the light at the turtle's place, 0 to 1"),
    row(".", Action::Ignored, 0, "a vertex of a surface: draws no wood"),
    row(";", Action::Ignored, 0, "the next colour: wood has the colour of its bark"),
    row(",", Action::Ignored, 0, "the colour before: wood has the colour of its bark"),
    row("'", Action::Ignored, 0, "the next colour: wood has the colour of its bark"),
    row("@O", Action::Ignored, 0, "a sphere: draws no wood"),
    row("@o", Action::Ignored, 0, "a circle: draws no wood"),
    row("@B", Action::Ignored, 0, "a box: draws no wood"),
    row("@b", Action::Ignored, 0, "a rectangle: draws no wood"),
    row("@Gs", Action::Ignored, 0, "a cylinder begins: all wood is one skin"),
    row("@Ge", Action::Ignored, 0, "a cylinder ends: all wood is one skin"),
    row("@Gc", Action::Ignored, 0, "a point of a cylinder: all wood is one skin"),
    row("@Gr", Action::Ignored, 0, "a tangent of a cylinder: all wood is one skin"),
    row("@Gt", Action::Ignored, 0, "a tangent of a cylinder: all wood is one skin"),
    row("@#", Action::Ignored, 0, "a contour: wood is round"),
    row("@C", Action::Ignored, 0, "a contour: wood is round"),
    row("@L", Action::Ignored, 0, "a label: is not drawn"),
    row("@S", Action::Ignored, 0, "a command for a screen: is not obeyed"),
    row("@I", Action::Ignored, 0, "a surface: leaves stand where Appearance puts them"),
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
