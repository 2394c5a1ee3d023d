//! A grammar with values for its sliders, compiled.

use crate::{
    code::{Code, asks_place, compile, unsteady},
    expression::Expr,
    grammar::{Ahead, Buds, Curve, Grammar, Module, Neighbour, Radii, Rule, Slider},
    review::are_alternatives,
    source::Span,
    symbols::{Action, CUT, Symbol, turtle},
    word::Columns,
};

/// What turns without parameter turn by, in degrees, where the file says nothing.
pub(crate) const ANGLE: f64 = 45.0;
/// Steps that a file may ask for.
const MOST_STEPS: f64 = 10_000.0;

/// Values that a grammar cannot be set to.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BadValue {
    /// No slider has this name.
    #[error("there is no slider `{0}`")]
    Unknown(String),
    /// A slider does not reach so far.
    #[error("`{name}` goes from {from} to {to}")]
    OutOfRange {
        /// Its name.
        name: String,
        /// Its least value.
        from: f64,
        /// Its greatest.
        to: f64,
    },
    /// A definition or header is no number that it can be.
    #[error("{name} is {value}, and must be {allowed}")]
    Impossible {
        /// What it is called.
        name: String,
        /// What it comes to.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// It would be another number each time.
    #[error("{name} must be the same everywhere, and `{function}` is not")]
    Unsteady {
        /// What it is called.
        name: String,
        /// The function.
        function: &'static str,
    },
}

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
    pub condition: Option<Code>,
    pub weight: Option<Code>,
    /// This rule and its alternatives; empty for one without probability, and for all alternatives but the first.
    pub draw: Vec<u32>,
    /// Whether an alternative before it decides for it.
    pub is_later: bool,
    pub products: Vec<Product>,
    /// The product that is the module itself, gone on.
    pub heir: Option<usize>,
    pub at: (u32, u32),
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
    pub(crate) buds: Buds,
    pub(crate) radii: Radii,
}

/// Whether a grammar asks where its modules stand.
pub(crate) fn asks_places(grammar: &Grammar) -> bool {
    let of_modules = |modules: &[Module]| {
        modules.iter().any(|module| {
            let action = turtle(module.symbol).map(|row| row.action);
            let is_question = matches!(
                action,
                Some(
                    Action::AskPlace
                        | Action::AskHeading
                        | Action::AskUp
                        | Action::AskLeft
                        | Action::AskLight
                )
            );
            is_question || module.arguments.iter().any(asks_place)
        })
    };
    let of_rule = |rule: &Rule| {
        let questions = rule.condition.iter().chain(&rule.weight);
        questions.into_iter().any(asks_place) || of_modules(&rule.successor)
    };
    of_modules(&grammar.axiom) || grammar.rules.iter().chain(&grammar.decomposition).any(of_rule)
}

impl Grammar {
    /// What users may set, with the values of the file.
    pub fn sliders(&self) -> Vec<Slider> {
        let values = self.values(&[]).unwrap_or_default();
        let slider = |row: &crate::grammar::SliderRow| Slider {
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
                return Err((Span::default(), BadValue::Unknown(name.to_owned())));
            };
            if !(row.from..=row.to).contains(&value) {
                let (name, from, to) = (name.to_owned(), row.from, row.to);
                return Err((Span::default(), BadValue::OutOfRange { name, from, to }));
            }
        }
        let mut values: Vec<f64> = Vec::with_capacity(self.defines.len());
        for (at, define) in self.defines.iter().enumerate() {
            let name = || format!("`{}`", define.name);
            let given = set.iter().find(|(name, _)| *name == define.name);
            let value = match given {
                Some(&(_, value)) => value,
                None => constant(&define.value, &values, &self.curves, name, define.place)?,
            };
            if !value.is_finite() {
                return Err((define.place, impossible(name(), value, "a finite number")));
            }
            let slider = self.sliders.iter().find(|row| usize::from(row.define) == at);
            if let Some(row) = slider.filter(|row| !(row.from..=row.to).contains(&value)) {
                let (name, from, to) = (define.name.clone(), row.from, row.to);
                return Err((define.place, BadValue::OutOfRange { name, from, to }));
            }
            values.push(value);
        }
        Ok(values)
    }
}

fn impossible(name: String, value: f64, allowed: &'static str) -> BadValue {
    BadValue::Impossible { name, value, allowed }
}

fn constant(
    expr: &Expr,
    values: &[f64],
    curves: &[Curve],
    name: impl Fn() -> String,
    place: Span,
) -> Result<f64, (Span, BadValue)> {
    if let Some(function) = unsteady(expr) {
        return Err((place, BadValue::Unsteady { name: name(), function }));
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

    /// Whether wood gets its radii from the widths that the grammar sets.
    pub fn sets_radii(&self) -> bool {
        self.radii == Radii::Grammar
    }

    pub(crate) fn build(grammar: &Grammar, set: &[(&str, f64)]) -> Result<Self, (Span, BadValue)> {
        let values = grammar.values(set)?;
        let curves = &grammar.curves;
        let heading = &grammar.heading;
        let number = |row: &Option<(Expr, Span)>, name: &str, default: f64| match row {
            Some((expr, place)) => Ok((constant(expr, &values, curves, || name.to_owned(), *place)?, *place)),
            None => Ok((default, Span::default())),
        };
        let within = |(value, place): (f64, Span), name: &str, holds: bool, allowed| match holds {
            true => Ok(value),
            false => Err((place, impossible(name.to_owned(), value, allowed))),
        };
        let scale = number(&heading.scale, "scale", 1.0)?;
        let scale = within(scale, "scale", scale.0 > 0.0 && scale.0.is_finite(), "more than 0")?;
        let angle = number(&heading.angle, "angle", ANGLE)?;
        let angle = within(angle, "angle", angle.0.is_finite(), "a finite number of degrees")?;
        let step = number(&heading.time_step, "dt", 1.0)?;
        let time_step = within(step, "dt", (0.001..=1000.0).contains(&step.0), "from 0.001 to 1000")?;
        let depth = number(&heading.depth, "derivation length", 1.0)?;
        let is_depth = depth.0.fract() == 0.0 && (0.0..=MOST_STEPS).contains(&depth.0);
        let depth = within(depth, "derivation length", is_depth, "a whole number up to 10000")?;
        let compiling = Compiling { grammar, values: &values };
        let mut lifespans = Vec::new();
        for (symbol, expr) in &grammar.timing {
            let name = || format!("the lifespan of `{}`", grammar.symbols.name(*symbol));
            let value = constant(expr, &values, curves, name, Span::default())?;
            if !(0.001..=1e6).contains(&value) {
                return Err((Span::default(), impossible(name(), value, "from 0.001 to 1000000")));
            }
            lifespans.resize(grammar.symbols.len(), None);
            lifespans[*symbol as usize] = Some(value);
        }
        let has_contexts = grammar.rules.iter().any(|rule| !rule.left.is_empty() || !rule.right.is_empty());
        Ok(Self {
            axiom: compiling.products(&grammar.axiom),
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
            buds: heading.buds.unwrap_or(Buds::Fill),
            radii: heading
                .widths
                .unwrap_or_else(|| if sets_widths(grammar) { Radii::Grammar } else { Radii::Pipe }),
        })
    }

    /// Whether a symbol is a bud: a module that rules rewrite and the turtle does not know.
    pub(crate) fn is_apex(&self, symbol: Symbol) -> bool {
        turtle(symbol).is_none() && !self.rules.of(symbol).is_empty()
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

fn sets_widths(grammar: &Grammar) -> bool {
    let rules = grammar.rules.iter().chain(&grammar.homomorphism).chain(&grammar.decomposition);
    let mut modules = grammar.axiom.iter().chain(rules.flat_map(|rule| &rule.successor));
    modules.any(|module| {
        matches!(turtle(module.symbol).map(|row| row.action), Some(Action::Thinner | Action::Thicker))
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
            Production {
                arity: rule.arity,
                left: rule.left.clone(),
                right: rule.right.clone(),
                own: rule.own,
                condition: rule.condition.as_ref().map(|expr| self.code(expr)),
                weight: rule.weight.as_ref().map(|expr| self.code(expr)),
                draw,
                is_later,
                products: self.products(&rule.successor),
                heir,
                at: rule.at,
            }
        };
        RuleSet { rules: rules.iter().enumerate().map(compiled).collect(), by_symbol }
    }
}
