//! What is odd about a grammar that can be read.

use std::collections::BTreeSet;

use crate::{
    diagnostic::Report,
    expression::Expr,
    grammar::{Ahead, Grammar, Module, Rule},
    program::{ANGLE, Program},
    symbols::{Action, Symbol, turtle},
};

/// Reports rules that never fire, modules that do nothing, and probabilities that leave no choice.
pub(crate) fn review(grammar: &Grammar, report: &mut Report) {
    for rules in [&grammar.rules, &grammar.homomorphism, &grammar.decomposition] {
        shadowed(rules, report);
        weights(rules, report);
    }
    modules(grammar, report);
    angles(grammar, report);
    if let Err((place, error)) = Program::build(grammar, &[]) {
        report.error(place, "out-of-range", error.to_string());
    }
}

fn all_rules(grammar: &Grammar) -> impl Iterator<Item = &Rule> {
    grammar.rules.iter().chain(&grammar.homomorphism).chain(&grammar.decomposition)
}

/// All modules that are written down, those of axioms first.
fn written(grammar: &Grammar) -> impl Iterator<Item = &Module> {
    grammar.axiom.iter().chain(all_rules(grammar).flat_map(|rule| &rule.successor))
}

/// Whether two rules are alternatives of one draw.
pub(crate) fn are_alternatives(one: &Rule, other: &Rule) -> bool {
    (one.symbol, one.arity) == (other.symbol, other.arity)
        && one.weight.is_some()
        && other.weight.is_some()
        && (&one.left, &one.right, &one.condition) == (&other.left, &other.right, &other.condition)
}

fn shadowed(rules: &[Rule], report: &mut Report) {
    for (at, rule) in rules.iter().enumerate() {
        let takes_all = |earlier: &&Rule| {
            (earlier.symbol, earlier.arity) == (rule.symbol, rule.arity)
                && earlier.condition.is_none()
                && earlier.left.is_empty()
                && earlier.right.is_empty()
                && !are_alternatives(earlier, rule)
        };
        if let Some(earlier) = rules[..at].iter().find(takes_all) {
            let message =
                format!("this rule never fires: that of line {} takes every such module", earlier.at.0);
            let hint = "put the rule with a condition or context first, or give both a probability";
            report.warn(rule.place, "never-fires", message, Some(hint.to_owned()));
        }
    }
}

fn weights(rules: &[Rule], report: &mut Report) {
    let number = |rule: &Rule| match rule.weight {
        Some(Expr::Number(weight)) => Some(weight),
        _ => None,
    };
    for rule in rules.iter().filter(|rule| rule.weight.is_some()) {
        let weights: Option<Vec<f64>> =
            rules.iter().filter(|other| are_alternatives(rule, other)).map(number).collect();
        if weights.is_some_and(|weights| weights.iter().sum::<f64>() == 0.0) {
            let message = "the probabilities of this rule and its alternatives are all 0";
            report.error(rule.place, "no-probability", message);
        }
    }
}

fn neighbours(parts: &[Ahead], found: &mut BTreeSet<Symbol>) {
    for part in parts {
        match part {
            Ahead::Module(neighbour) => {
                found.insert(neighbour.symbol);
            }
            Ahead::Branch(inner) => neighbours(inner, found),
        }
    }
}

fn modules(grammar: &Grammar, report: &mut Report) {
    let mut in_contexts = BTreeSet::new();
    for rule in &grammar.rules {
        in_contexts.extend(rule.left.iter().map(|neighbour| neighbour.symbol));
        neighbours(&rule.right, &mut in_contexts);
    }
    let rewritten: BTreeSet<Symbol> = all_rules(grammar).map(|rule| rule.symbol).collect();
    let arities: BTreeSet<(Symbol, usize)> =
        all_rules(grammar).map(|rule| (rule.symbol, usize::from(rule.arity))).collect();
    let mut told = BTreeSet::new();
    for module in written(grammar) {
        let name = grammar.symbols.name(module.symbol);
        let row = turtle(module.symbol);
        let is_known = row.is_some() || name.starts_with('~');
        let is_used = rewritten.contains(&module.symbol) || in_contexts.contains(&module.symbol);
        let count = module.arguments.len();
        if rewritten.contains(&module.symbol)
            && !arities.contains(&(module.symbol, count))
            && !is_known
            && told.insert((module.symbol, count))
        {
            let message = format!("no rule takes `{name}` with {count} parameters");
            report.warn(module.place, "parameter-count", message, None);
        }
        if is_used || !told.insert((module.symbol, usize::MAX)) {
            continue;
        }
        match row {
            Some(row) if row.action == Action::Ignored => {
                report.warn(module.place, "not-drawn", format!("`{name}` is {}", row.sentence), None);
            }
            None if name.starts_with('~') => {
                let message = format!("`{name}` is a surface: leaves stand where Appearance puts them");
                report.warn(module.place, "not-drawn", message, None);
            }
            None => {
                let hint = match name {
                    "T" => Some("the elasticity of wood is set with @Ts".to_owned()),
                    _ => None,
                };
                let message = format!("`{name}` is never rewritten and draws nothing");
                report.warn(module.place, "does-nothing", message, hint);
            }
            Some(_) => {}
        }
    }
}

fn angles(grammar: &Grammar, report: &mut Report) {
    let turns = |module: &&Module| {
        let action = turtle(module.symbol).map(|row| row.action);
        module.arguments.is_empty()
            && matches!(action, Some(Action::Turn(_) | Action::Pitch(_) | Action::Roll(_)))
    };
    if grammar.heading.angle.is_none()
        && let Some(module) = written(grammar).find(turns)
    {
        let message = format!("it turns by {} degrees, for no angle is set", ANGLE);
        report.warn(module.place, "no-angle", message, Some("write angle: 30".to_owned()));
    }
}
