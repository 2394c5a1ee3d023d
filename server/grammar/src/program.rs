//! A grammar with values for its sliders, compiled.

use std::fmt::{self, Display};

use crate::{
    code::{Code, calls, compile, unsteady},
    derivation::Place,
    diagnostic::{Values, written},
    expression::Expr,
    functions::Function,
    grammar::{Ahead, Buds, Curve, Grammar, Leaves, Module, Neighbour, Radii, Rule, Slider, SliderRow},
    review::are_alternatives,
    source::Span,
    symbols::{Action, CUT, POP, SURFACE, Symbol, is_surface, turtle},
    word::Columns,
    wording::{self, Wording, filled},
};

/// What turns without parameter turn by, in degrees, where the file says nothing.
pub(crate) const ANGLE: f64 = 45.0;
/// Steps that a file may ask for.
const MOST_STEPS: f64 = 1000.0;

/// Values that a grammar cannot be set to.
#[derive(Clone, Debug, PartialEq)]
pub struct BadValue {
    pub(crate) wording: &'static Wording,
    pub(crate) values: Values,
}

impl BadValue {
    fn new<const N: usize>(wording: &'static Wording, values: [(&'static str, &dyn Display); N]) -> Self {
        Self { wording, values: written(&values) }
    }

    /// The name of its sentence among [all](crate::WORDINGS).
    pub fn id(&self) -> &'static str {
        self.wording.id
    }
}

impl Display for BadValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&filled(self.wording.message, &self.values))
    }
}

impl std::error::Error for BadValue {}

/// A module of a successor.
#[derive(Clone, Debug)]
pub(crate) struct Product {
    pub symbol: Symbol,
    pub arguments: Box<[Code]>,
}

/// A compiled rule.
#[derive(Clone, Debug)]
pub(crate) struct Production {
    pub arity: u8,
    pub left: Vec<Neighbour>,
    pub right: Vec<Ahead>,
    pub own: u8,
    /// Numbers that it gives names, where in the frame the first of them lies, and how many come before the condition.
    pub locals: Box<[Code]>,
    pub first_local: u8,
    pub locals_before: usize,
    pub condition: Option<Code>,
    pub weight: Option<Code>,
    /// This rule and its alternatives; empty for one without probability, and for all alternatives but the first.
    pub draw: Vec<u32>,
    /// Whether an alternative before it decides for it.
    pub is_later: bool,
    pub products: Vec<Product>,
    /// The products in columns, where all of them are appended as they are.
    pub plain: Option<Plain>,
    /// The product that is the module itself, gone on.
    pub heir: Option<usize>,
    pub at: (u32, u32),
}

/// Modules in columns, without the values of their parameters.
#[derive(Clone, Debug)]
pub(crate) struct Plain {
    pub symbols: Box<[Symbol]>,
    /// Where the parameters of each begin.
    pub first: Box<[u32]>,
    pub parameters: usize,
    /// Which of them are brackets.
    pub brackets: Box<[u32]>,
}

impl Plain {
    fn new(products: &[Product]) -> Self {
        let mut parameters = 0;
        let mut begin = |product: &Product| {
            let first = parameters as u32;
            parameters += product.arguments.len();
            first
        };
        let first = products.iter().map(&mut begin).collect();
        let brackets = (0..).zip(products).filter(|(_, product)| product.symbol <= POP);
        Self {
            symbols: products.iter().map(|product| product.symbol).collect(),
            first,
            parameters,
            brackets: brackets.map(|(number, _)| number).collect(),
        }
    }
}

/// The rules of a section, found by symbol.
#[derive(Clone, Debug, Default)]
pub(crate) struct RuleSet {
    pub rules: Vec<Production>,
    by_symbol: Vec<Vec<u32>>,
}

impl RuleSet {
    pub fn of(&self, symbol: Symbol) -> &[u32] {
        self.by_symbol.get(symbol as usize).map_or(&[], Vec::as_slice)
    }
}

/// A grammar ready to be derived.
#[derive(Clone, Debug)]
pub struct Program {
    pub(crate) axiom: Vec<Product>,
    /// Line and column of what the axiom begins with.
    pub(crate) axiom_at: Place,
    pub(crate) rules: RuleSet,
    pub(crate) homomorphism: RuleSet,
    pub(crate) decomposition: RuleSet,
    pub(crate) homomorphism_depth: u32,
    pub(crate) decomposition_depth: u32,
    pub(crate) curves: Vec<Curve>,
    pub(crate) passed_over: Vec<bool>,
    /// By symbol: whether rules may act on it, or it acts on what follows it.
    pub(crate) active: Vec<bool>,
    /// Lifespans by symbol; empty where no rule waits.
    pub(crate) lifespans: Vec<Option<f64>>,
    pub(crate) columns: Columns,
    pub(crate) asks_places: bool,
    pub(crate) scale: f64,
    pub(crate) angle: f64,
    pub(crate) time_step: f64,
    depth: u32,
    seed: Option<u32>,
    pub(crate) buds: Buds,
    pub(crate) radii: Radii,
    /// By symbol: whether it is a surface that the turtle does not know by its name.
    surfaces: Vec<bool>,
    /// Whether it says itself where organs are.
    pub(crate) has_organs: bool,
}

/// Whether a grammar asks where its modules stand.
pub(crate) fn asks_places(grammar: &Grammar) -> bool {
    let is_question = |action| {
        use Action::{AskHeading, AskLeft, AskLight, AskPlace, AskUp};
        matches!(action, AskPlace | AskHeading | AskUp | AskLeft | AskLight)
    };
    asks(grammar, is_question, Function::asks_place)
}

/// Whether it asks for what depends on the wood around.
pub(crate) fn asks_of_wood(grammar: &Grammar) -> bool {
    asks(grammar, |action| action == Action::AskLight, Function::asks_of_wood)
}

/// Whether it asks for vigor, to be derived or drawn.
pub(crate) fn asks_of_vigor(grammar: &Grammar) -> bool {
    let is_vigor = |function| function == Function::Vigor;
    let of_rule = |rule: &Rule| {
        let arguments = rule.successor.iter().flat_map(|module| &module.arguments);
        let questions = rule.condition.iter().chain(&rule.weight).chain(&rule.locals.values);
        questions.chain(arguments).any(|expr| calls(expr, is_vigor))
    };
    asks(grammar, |_| false, is_vigor) || grammar.homomorphism.iter().any(of_rule)
}

fn asks(grammar: &Grammar, is_question: fn(Action) -> bool, which: fn(Function) -> bool) -> bool {
    let of_modules = |modules: &[Module]| {
        modules.iter().any(|module| {
            let is_asked = turtle(module.symbol).is_some_and(|row| is_question(row.action));
            is_asked || module.arguments.iter().any(|argument| calls(argument, which))
        })
    };
    let of_rule = |rule: &Rule| {
        let questions = rule.condition.iter().chain(&rule.weight);
        questions.into_iter().chain(&rule.locals.values).any(|expr| calls(expr, which))
            || of_modules(&rule.successor)
    };
    of_modules(&grammar.axiom) || grammar.rules.iter().chain(&grammar.decomposition).any(of_rule)
}

impl Grammar {
    /// What users may set, with the values of the file.
    pub fn sliders(&self) -> Vec<Slider> {
        let values = self.values(&[]).unwrap_or_default();
        let slider = |row: &SliderRow| Slider {
            name: self.defines[row.define as usize].name.clone(),
            value: values.get(row.define as usize).copied().unwrap_or_default(),
            from: row.from,
            to: row.to,
        };
        self.sliders.iter().map(slider).collect()
    }

    /// Compiles it with values for some sliders.
    ///
    /// # Errors
    /// Where a slider is not there or does not reach so far, or what follows from it is impossible.
    pub fn program(&self, values: &[(&str, f64)]) -> Result<Program, BadValue> {
        Program::build(self, values).map_err(|(_, error)| error)
    }

    /// The values of all definitions.
    fn values(&self, set: &[(&str, f64)]) -> Result<Vec<f64>, (Span, BadValue)> {
        for &(name, value) in set {
            let row = self.sliders.iter().find(|row| self.defines[row.define as usize].name == name);
            let Some(row) = row else {
                return Err((Span::default(), BadValue::new(wording::NO_SLIDER, [("name", &name)])));
            };
            if !(row.from..=row.to).contains(&value) {
                return Err((Span::default(), beyond(name, row)));
            }
        }
        let mut values: Vec<f64> = Vec::with_capacity(self.defines.len());
        for (at, define) in self.defines.iter().enumerate() {
            let given = set.iter().find(|(name, _)| *name == define.name);
            let value = match given {
                Some(&(_, value)) => value,
                None => constant(&define.value, &values, &self.curves, &define.name, define.place)?,
            };
            if !value.is_finite() {
                return Err((define.place, impossible(wording::NOT_FINITE, &define.name, value)));
            }
            let slider = self.sliders.iter().find(|row| usize::from(row.define) == at);
            if let Some(row) = slider.filter(|row| !(row.from..=row.to).contains(&value)) {
                return Err((define.place, beyond(&define.name, row)));
            }
            values.push(value);
        }
        Ok(values)
    }
}

fn impossible(wording: &'static Wording, name: &str, value: f64) -> BadValue {
    match name {
        "" => BadValue::new(wording, [("value", &value)]),
        _ => BadValue::new(wording, [("name", &name), ("value", &value)]),
    }
}

fn beyond(name: &str, row: &SliderRow) -> BadValue {
    BadValue::new(wording::BEYOND_SLIDER, [("name", &name), ("from", &row.from), ("to", &row.to)])
}

fn constant(
    expr: &Expr,
    values: &[f64],
    curves: &[Curve],
    name: &str,
    place: Span,
) -> Result<f64, (Span, BadValue)> {
    if let Some(function) = unsteady(expr) {
        let values: [(_, &dyn Display); 2] = [("name", &name), ("function", &function)];
        return Err((place, BadValue::new(wording::UNSTEADY, values)));
    }
    match compile(expr, values, curves) {
        Code::Constant(value) => Ok(value),
        // Without parameters and chance all is constant.
        Code::Parameter(_) | Code::Steps(_) => Ok(f64::NAN),
    }
}

impl Program {
    /// How many steps the file asks for.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// The seed of chance that the file asks for.
    pub fn seed(&self) -> Option<u32> {
        self.seed
    }

    /// Whether wood gets its radii from the widths that the grammar sets.
    pub fn sets_radii(&self) -> bool {
        self.radii == Radii::Grammar
    }

    pub(crate) fn build(grammar: &Grammar, set: &[(&str, f64)]) -> Result<Self, (Span, BadValue)> {
        let values = grammar.values(set)?;
        let curves = &grammar.curves;
        let heading = &grammar.heading;
        let number = |row: &Option<(Expr, Span)>, name: &str, default: f64| match row {
            Some((expr, place)) => Ok((constant(expr, &values, curves, name, *place)?, *place)),
            None => Ok((default, Span::default())),
        };
        let within = |(value, place): (f64, Span), holds: bool, wording| match holds {
            true => Ok(value),
            false => Err((place, impossible(wording, "", value))),
        };
        let scale = number(&heading.scale, "scale", 1.0)?;
        let scale = within(scale, scale.0 > 0.0 && scale.0.is_finite(), wording::SCALE_RANGE)?;
        let angle = number(&heading.angle, "angle", ANGLE)?;
        let angle = within(angle, angle.0.is_finite(), wording::ANGLE_RANGE)?;
        let step = number(&heading.time_step, "dt", 1.0)?;
        let time_step = within(step, (0.001..=1000.0).contains(&step.0), wording::TIME_STEP_RANGE)?;
        let depth = number(&heading.depth, "derivation length", 1.0)?;
        let is_depth = depth.0.fract() == 0.0 && (0.0..=MOST_STEPS).contains(&depth.0);
        let depth = within(depth, is_depth, wording::DEPTH_RANGE)?;
        let seed = number(&heading.seed, "seed", 0.0)?;
        let is_seed = seed.0.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&seed.0);
        let seed = within(seed, is_seed, wording::SEED_RANGE)?;
        let compiling = Compiling { grammar, values: &values };
        let mut lifespans = Vec::new();
        for (symbol, expr, span) in &grammar.timing {
            let name = grammar.symbols.name(*symbol);
            let value = constant(expr, &values, curves, name, *span)?;
            if !(0.001..=1e6).contains(&value) {
                return Err((*span, impossible(wording::LIFESPAN_RANGE, name, value)));
            }
            lifespans.resize(grammar.symbols.len(), None);
            lifespans[*symbol as usize] = Some(value);
        }
        let has_contexts = grammar.rules.iter().any(|rule| !rule.left.is_empty() || !rule.right.is_empty());
        Ok(Self {
            axiom: compiling.products(&grammar.axiom),
            axiom_at: grammar.axiom_at,
            rules: compiling.set(&grammar.rules),
            homomorphism: compiling.set(&grammar.homomorphism),
            decomposition: compiling.set(&grammar.decomposition),
            homomorphism_depth: grammar.homomorphism_depth.into(),
            decomposition_depth: grammar.decomposition_depth.into(),
            curves: curves.clone(),
            passed_over: passed_over(grammar),
            active: active(grammar),
            columns: Columns { mates: has_contexts, times: !lifespans.is_empty() },
            lifespans,
            asks_places: asks_places(grammar),
            scale,
            angle,
            time_step,
            depth: depth as u32,
            seed: heading.seed.is_some().then_some(seed as u32),
            surfaces: (0..grammar.symbols.len() as Symbol)
                .map(|symbol| is_foreign_surface(grammar, symbol))
                .collect(),
            has_organs: match heading.leaves {
                Some(leaves) => leaves == Leaves::Grammar,
                None => has_organs(grammar),
            },
            buds: heading.buds.unwrap_or(Buds::Fill),
            radii: heading
                .widths
                .unwrap_or_else(|| if sets_widths(grammar) { Radii::Grammar } else { Radii::Pipe }),
        })
    }

    /// Whether a symbol is a bud: a module that rules rewrite and the turtle does not know.
    pub(crate) fn is_apex(&self, symbol: Symbol) -> bool {
        self.action(symbol).is_none() && !self.rules.of(symbol).is_empty()
    }

    /// What the turtle does with a symbol.
    pub(crate) fn action(&self, symbol: Symbol) -> Option<Action> {
        match turtle(symbol) {
            Some(row) => Some(row.action),
            None => self.surfaces[symbol as usize].then_some(SURFACE),
        }
    }
}

/// Which symbols contexts do not see.
fn passed_over(grammar: &Grammar) -> Vec<bool> {
    let is_passed = |symbol: Symbol| {
        let is_seen = grammar.considered.as_ref().is_none_or(|seen| seen.contains(&symbol));
        !is_seen || grammar.ignored.contains(&symbol)
    };
    (0..grammar.symbols.len() as Symbol).map(is_passed).collect()
}

fn active(grammar: &Grammar) -> Vec<bool> {
    let mut active = vec![false; grammar.symbols.len()];
    active[CUT as usize] = true;
    for rule in grammar.rules.iter().chain(&grammar.decomposition) {
        active[rule.symbol as usize] = true;
    }
    active
}

fn is_foreign_surface(grammar: &Grammar, symbol: Symbol) -> bool {
    turtle(symbol).is_none() && is_surface(grammar.symbols.name(symbol))
}

/// All modules that a word can hold or be read as.
fn modules(grammar: &Grammar) -> impl Iterator<Item = &Module> {
    let rules = grammar.rules.iter().chain(&grammar.homomorphism).chain(&grammar.decomposition);
    grammar.axiom.iter().chain(rules.flat_map(|rule| &rule.successor))
}

fn sets_widths(grammar: &Grammar) -> bool {
    modules(grammar).any(|module| {
        matches!(turtle(module.symbol).map(|row| row.action), Some(Action::Thinner | Action::Thicker))
    })
}

fn has_organs(grammar: &Grammar) -> bool {
    modules(grammar).any(|module| {
        let action = turtle(module.symbol).map(|row| row.action);
        matches!(action, Some(Action::Organ(..) | Action::EndPolygon))
            || is_foreign_surface(grammar, module.symbol)
    })
}

struct Compiling<'a> {
    grammar: &'a Grammar,
    values: &'a [f64],
}

impl Compiling<'_> {
    fn code(&self, expr: &Expr) -> Code {
        compile(expr, self.values, &self.grammar.curves)
    }

    fn products(&self, modules: &[Module]) -> Vec<Product> {
        let product = |module: &Module| {
            let mut arguments: Vec<Code> = module.arguments.iter().map(|expr| self.code(expr)).collect();
            // What the turtle fills in needs room for it.
            let row = turtle(module.symbol).filter(|row| row.name.starts_with('?'));
            arguments.resize(arguments.len().max(row.map_or(0, |row| row.least.into())), Code::Constant(0.0));
            Product { symbol: module.symbol, arguments: arguments.into() }
        };
        modules.iter().map(product).collect()
    }

    /// Whether a new module with this symbol is appended as it is.
    fn is_plain(&self, symbol: Symbol) -> bool {
        let waits = self.grammar.timing.iter().any(|row| row.0 == symbol);
        !waits && !self.grammar.decomposition.iter().any(|rule| rule.symbol == symbol)
    }

    fn set(&self, rules: &[Rule]) -> RuleSet {
        let mut by_symbol = vec![Vec::new(); self.grammar.symbols.len()];
        for (rule, number) in rules.iter().zip(0..) {
            by_symbol[rule.symbol as usize].push(number);
        }
        let compiled = |(number, rule): (usize, &Rule)| {
            let is_alternative = |other: &(usize, &Rule)| are_alternatives(rule, other.1);
            let draw: Vec<u32> =
                rules.iter().enumerate().filter(is_alternative).map(|(number, _)| number as u32).collect();
            let is_later = draw.first().is_some_and(|&first| first as usize != number);
            let mut own =
                rule.successor.iter().enumerate().filter(|(_, module)| module.symbol == rule.symbol);
            let heir = own.next().map(|(at, _)| at).filter(|_| own.next().is_none());
            let products = self.products(&rule.successor);
            let is_plain = products.iter().all(|product| self.is_plain(product.symbol));
            Production {
                plain: is_plain.then(|| Plain::new(&products)),
                arity: rule.arity,
                left: rule.left.clone(),
                right: rule.right.clone(),
                own: rule.own,
                locals: rule.locals.values.iter().map(|expr| self.code(expr)).collect(),
                first_local: rule.locals.first,
                locals_before: rule.locals.before,
                condition: rule.condition.as_ref().map(|expr| self.code(expr)),
                weight: rule.weight.as_ref().map(|expr| self.code(expr)),
                draw,
                is_later,
                products,
                heir,
                at: rule.at,
            }
        };
        RuleSet { rules: rules.iter().enumerate().map(compiled).collect(), by_symbol }
    }
}
