//! What is odd about a grammar that can be read.

use std::{collections::BTreeSet, fmt::Display};

use crate::{
    diagnostic::{Report, Severity},
    expression::Expr,
    grammar::{Ahead, Grammar, Module, Rule},
    program::{ANGLE, Program},
    symbols::{Action, Symbol, is_surface, turtle},
    wording,
};

/// Reports rules that never fire, modules that do nothing, and probabilities that leave no choice.
pub(crate) fn review(grammar: &Grammar, report: &mut Report) {
    for rules in [&grammar.rules, &grammar.homomorphism, &grammar.decomposition] {
        shadowed(rules, report);
        weights(rules, report);
    }
    modules(grammar, report);
    surfaces(grammar, report);
    stages(grammar, report);
    angles(grammar, report);
    if let Err((place, error)) = Program::build(grammar, &[]) {
        report.add(place, Severity::Error, error.wording, error.values);
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
        && (&one.left, &one.right, &one.locals) == (&other.left, &other.right, &other.locals)
        && one.condition == other.condition
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
            report.warn(rule.place, wording::NEVER_FIRES, [("line", &earlier.at.0)]);
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
            report.error(rule.place, wording::NO_PROBABILITY, []);
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
        let is_known = row.is_some() || is_surface(name);
        let is_used = rewritten.contains(&module.symbol) || in_contexts.contains(&module.symbol);
        let count = module.arguments.len();
        if rewritten.contains(&module.symbol)
            && !arities.contains(&(module.symbol, count))
            && !is_known
            && told.insert((module.symbol, count))
        {
            let values: [(_, &dyn Display); 2] = [("name", &name), ("count", &count)];
            report.warn(module.place, wording::NO_RULE_TAKES, values);
        }
        if is_used || !told.insert((module.symbol, usize::MAX)) {
            continue;
        }
        let wording = match row.map(|row| row.action) {
            Some(Action::Ignored(wording)) => wording,
            Some(_) => continue,
            None if is_surface(name) => wording::SURFACE_AS_LEAF,
            None if name == "T" => wording::OLD_ELASTICITY,
            None => wording::DOES_NOTHING,
        };
        report.warn(module.place, wording, [("name", &name)]);
    }
}

/// Strings in which surfaces begin that do not end.
fn surfaces(grammar: &Grammar, report: &mut Report) {
    let is = |module: &&Module, wanted| turtle(module.symbol).is_some_and(|row| row.action == wanted);
    let strings = all_rules(grammar).map(|rule| &rule.successor).chain([&grammar.axiom]);
    for string in strings {
        let begun = string.iter().filter(|module| is(module, Action::BeginPolygon)).count();
        let ended = string.iter().filter(|module| is(module, Action::EndPolygon)).count();
        let first =
            string.iter().find(|module| is(module, Action::BeginPolygon) || is(module, Action::EndPolygon));
        if let Some(first) = first.filter(|_| begun != ended) {
            report.warn(first.place, wording::OPEN_SURFACE, []);
        }
    }
}

/// What the homomorphism makes and has a rule for, which it does not come to.
fn stages(grammar: &Grammar, report: &mut Report) {
    if grammar.homomorphism_depth != 1 {
        return;
    }
    let has_rule = |module: &&Module| grammar.homomorphism.iter().any(|rule| rule.symbol == module.symbol);
    for rule in &grammar.homomorphism {
        // A module that is read as itself and more would go on for ever.
        let found = rule.successor.iter().filter(|module| module.symbol != rule.symbol).find(has_rule);
        if let Some(module) = found {
            let name = grammar.symbols.name(module.symbol);
            let values: [(_, &dyn Display); 3] =
                [("name", &name), ("depth", &grammar.homomorphism_depth), ("deeper", &2)];
            report.warn(module.place, wording::TOO_SHALLOW, values);
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
        report.warn(module.place, wording::NO_ANGLE, [("value", &ANGLE)]);
    }
}
