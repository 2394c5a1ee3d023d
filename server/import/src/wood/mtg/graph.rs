//! The code of a multiscale tree graph: which component is part of which, and which stands on which.

use std::collections::BTreeMap;

use super::bad_code;
use crate::wood::{Fault, Place, WoodOptions, excerpt, malformed, out_of_range, too_many};

/// How often, for each node that a file may have, runs may pass what is there already.
const PASSES: usize = 8;
/// Scales below that of the whole.
const MAX_SCALE: u32 = 64;

/// How a component stands on another one of its scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Relation {
    /// `<`: it goes on on the same axis.
    Follows,
    /// `+`: it branches off.
    Branches,
}

/// One component.
#[derive(Clone, Debug)]
pub(super) struct Component {
    pub class: u16,
    pub scale: u32,
    index: u32,
    /// What it stands on.
    pub parent: Option<(u32, Relation)>,
    /// What it is a part of.
    pub complex: Option<u32>,
    /// The line that it stands in.
    pub line: u64,
    /// The finer component that the code came from.
    left: Option<u32>,
    /// The latest component that is a part of it.
    part: Option<u32>,
}

/// A step of a code: decomposition, or a relation, and whom it leads to.
struct Step<'a> {
    relation: Option<Relation>,
    /// How many such: from the number before to this one, for `<<` and `++`.
    is_run: bool,
    /// Whether values are those of the whole run.
    is_shared: bool,
    class: &'a str,
    index: u32,
}

/// The components read so far; parents and wholes stand before what stands on them or is part of them.
pub(super) struct Graph {
    pub components: Vec<Component>,
    classes: BTreeMap<String, (u16, u32)>,
    names: Vec<String>,
    /// Where each step from a component leads, for codes that begin at the whole.
    known: BTreeMap<(u32, Option<Relation>, u16, u32), u32>,
    /// The last component of the code in each column.
    last: Vec<u32>,
    /// How many components runs have passed that were there already.
    passed: usize,
    options: WoodOptions,
}

impl Graph {
    pub(super) fn new(options: &WoodOptions) -> Self {
        Self {
            components: Vec::new(),
            classes: BTreeMap::new(),
            names: Vec::new(),
            known: BTreeMap::new(),
            last: Vec::new(),
            passed: 0,
            options: *options,
        }
    }

    /// A class and its scale.
    pub(super) fn declare(&mut self, symbol: &str, scale: &str, line: u64) -> Result<(), Fault> {
        let place = || Some(Place::Cell(line, 2));
        let read: u32 = scale.parse().map_err(|_| {
            malformed(place(), format!("the scale is `{}`, which is no number", excerpt(scale)))
        })?;
        if read > MAX_SCALE || self.names.len() >= usize::from(u16::MAX) {
            return Err(out_of_range(place(), format!("the scale is {read}"), format!("0 to {MAX_SCALE}")));
        }
        let class = self.names.len() as u16;
        self.names.push(symbol.to_owned());
        self.classes.insert(symbol.to_owned(), (class, read));
        Ok(())
    }

    /// The name of a class.
    pub(super) fn name_of(&self, class: u16) -> &str {
        self.names.get(usize::from(class)).map_or("", |name| name)
    }

    /// Follows the code in the cells of a line; returns the components that the line's values are of.
    pub(super) fn follow(&mut self, line: u64, cells: &[&str]) -> Result<std::ops::Range<usize>, Fault> {
        let nothing = self.components.len()..self.components.len();
        let Some(column) = cells.iter().position(|cell| !cell.is_empty()) else { return Ok(nothing) };
        let mut codes = cells[column..].iter().copied().filter(|cell| !cell.is_empty());
        let code = codes.next().unwrap_or_default();
        if let Some(beyond) = codes.next() {
            return Err(bad_code(line, column, beyond, "there are two codes in one line"));
        }
        if code == "*" {
            // The same component at another date.
            let at =
                *self.last.get(column).ok_or_else(|| bad_code(line, column, code, "nothing stands above"))?;
            return Ok(at as usize..at as usize + 1);
        }
        let (rest, from) = match code.strip_prefix('^') {
            Some(rest) => (rest, self.last.get(column).copied()),
            None if column > 0 => (code, self.last.get(column - 1).copied()),
            None => (code, None),
        };
        let is_relative = rest.len() < code.len() || column > 0;
        if is_relative && from.is_none() {
            return Err(bad_code(line, column, code, "nothing stands above or to the left of this"));
        }
        let (mut at, mut rest, mut values) = (from, rest, nothing);
        if rest.is_empty() {
            return Err(bad_code(line, column, code, "there is no code"));
        }
        while !rest.is_empty() {
            let (step, left) = step(rest).ok_or_else(|| bad_code(line, column, rest, "this is no code"))?;
            let first = self.components.len();
            let reached = self.take(at, &step, line, column, is_relative)?;
            let reached_at = reached as usize;
            values = if step.is_shared {
                first.min(reached_at)..reached_at + 1
            } else {
                reached_at..reached_at + 1
            };
            (at, rest) = (Some(reached), left);
        }
        self.last.truncate(column);
        // Columns that are empty above count as this one.
        self.last.resize(column + 1, at.unwrap_or(0));
        Ok(values)
    }

    /// Takes a step, with all that a run leaves out.
    fn take(
        &mut self,
        at: Option<u32>,
        step: &Step<'_>,
        line: u64,
        column: usize,
        is_relative: bool,
    ) -> Result<u32, Fault> {
        let Some(&(class, scale)) = self.classes.get(step.class) else {
            return Err(bad_code(line, column, step.class, "this is no class"));
        };
        let mut index = step.index;
        if step.is_run {
            let before = at.map(|at| &self.components[at as usize]).filter(|before| before.class == class);
            index =
                before.map(|before| before.index).filter(|before| *before < step.index).ok_or_else(|| {
                    bad_code(line, column, step.class, "a run must lead to a higher number of the same class")
                })? + 1;
        }
        let mut at = at;
        // Bounded by the limits, whatever number was written, and however often.
        for index in index..=step.index {
            let key = (at.unwrap_or(u32::MAX), step.relation, class, index);
            let place = Place::Cell(line, column as u64 + 1);
            let found = self.known.get(&key).copied().filter(|_| !is_relative);
            at = Some(match found {
                Some(found) => {
                    self.passed += usize::from(step.is_run);
                    if self.passed / PASSES > self.options.nodes {
                        return Err(too_many(Some(place), &self.options));
                    }
                    found
                }
                None => {
                    let component = self.component(at, step.relation, scale).ok_or_else(|| {
                        let what =
                            format!("`{}` cannot stand here: its scale does not fit", excerpt(step.class));
                        malformed(Some(place.clone()), what)
                    })?;
                    let made = self.push(Component { class, index, line, ..component }, place)?;
                    self.known.insert(key, made);
                    made
                }
            });
        }
        at.ok_or_else(|| bad_code(line, column, step.class, "this is no code"))
    }

    /// What a step leads to that was not there before; class, index and line are still to be said.
    fn component(&self, at: Option<u32>, relation: Option<Relation>, scale: u32) -> Option<Component> {
        let new = Component {
            class: 0,
            scale,
            index: 0,
            parent: None,
            complex: None,
            line: 0,
            left: None,
            part: None,
        };
        let component = |at: u32| &self.components[at as usize];
        let Some(relation) = relation else {
            let Some(complex) = at else { return Some(new) };
            let whole = component(complex);
            if whole.scale >= scale {
                return None;
            }
            // The first part stands on what the whole stands on; further ones on the one before.
            let first = || {
                let (below, relation) = whole.parent?;
                Some((self.at_scale(whole.left.unwrap_or(below), scale)?, relation))
            };
            let next = whole.part.filter(|&part| component(part).scale == scale);
            let parent = next.map(|part| (part, Relation::Branches)).or_else(first);
            return Some(Component { parent, complex: Some(complex), ..new });
        };
        let from = at?;
        let below = self.at_scale(from, scale)?;
        let left = (component(from).scale > scale).then_some(from);
        Some(Component { parent: Some((below, relation)), complex: component(below).complex, left, ..new })
    }

    /// The component of a scale that a component is part of, or its latest part of that scale.
    fn at_scale(&self, mut at: u32, scale: u32) -> Option<u32> {
        let scale_of = |at: u32| self.components[at as usize].scale;
        // Scales may be left out, so it goes either up or down, never back.
        if scale_of(at) > scale {
            while scale_of(at) > scale {
                at = self.components[at as usize].complex?;
            }
        } else {
            while scale_of(at) < scale {
                at = self.components[at as usize].part?;
            }
        }
        Some(at).filter(|&at| scale_of(at) == scale)
    }

    fn push(&mut self, component: Component, place: Place) -> Result<u32, Fault> {
        // Components of coarser scales come on top of the nodes.
        if self.components.len() / 2 >= self.options.nodes {
            return Err(too_many(Some(place), &self.options));
        }
        let at = self.components.len() as u32;
        if let Some(complex) = component.complex {
            self.components[complex as usize].part = Some(at);
        }
        self.components.push(component);
        Ok(at)
    }
}

/// The first step of a code, and the rest.
fn step(code: &str) -> Option<(Step<'_>, &str)> {
    const SIGNS: [(&str, Option<Relation>, bool, bool); 7] = [
        ("<.<", Some(Relation::Follows), true, true),
        ("<<", Some(Relation::Follows), true, false),
        ("<", Some(Relation::Follows), false, false),
        ("+.+", Some(Relation::Branches), true, true),
        ("++", Some(Relation::Branches), true, false),
        ("+", Some(Relation::Branches), false, false),
        ("/", None, false, false),
    ];
    let (rest, relation, is_run, is_shared) = SIGNS
        .iter()
        .find_map(|&(sign, relation, run, shared)| Some((code.strip_prefix(sign)?, relation, run, shared)))?;
    let is_name = |c: char| c.is_ascii_alphabetic() || c == '_';
    let (class, rest) = rest.split_at(rest.find(|c| !is_name(c)).unwrap_or(rest.len()));
    let (digits, rest) = rest.split_at(rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()));
    let index = if digits.is_empty() { 0 } else { digits.parse().ok()? };
    (!class.is_empty()).then_some((Step { relation, is_run, is_shared, class, index }, rest))
}
