//! Words: modules in columns.

use std::ops::Range;

use crate::{
    grammar::Grammar,
    limits::{Limits, Stop},
    program::Plain,
    symbols::{POP, PUSH, Symbol},
};

/// Which columns beside symbols, keys, births and parameters a grammar needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Columns {
    /// For contexts, which jump over branches.
    pub mates: bool,
    /// For modules whose age is no whole number of steps.
    pub times: bool,
}

/// A string of modules.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Word {
    symbols: Vec<Symbol>,
    /// Where the parameters of each module begin.
    first: Vec<u32>,
    keys: Vec<u64>,
    /// The step in which each came to be.
    born: Vec<u32>,
    parameters: Vec<f64>,
    /// For each bracket its counterpart; empty where nobody asks.
    mates: Vec<u32>,
    /// The time at which each came to be; empty where that is its step.
    times: Vec<f64>,
    /// Brackets not yet closed.
    open: Vec<u32>,
    columns: Columns,
}

/// What a module carries beside its parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tag {
    pub symbol: Symbol,
    pub key: u64,
    pub born: u32,
    pub time: f64,
}

impl Word {
    pub(crate) fn new(columns: Columns) -> Self {
        Self { columns, ..Self::default() }
    }

    /// Modules, brackets included.
    pub fn len(&self) -> usize {
        self.symbols.len()
    }

    /// Whether there is no module.
    pub fn is_empty(&self) -> bool {
        self.symbols.is_empty()
    }

    /// Bytes that its modules take.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.symbols)
            + size_of_val(&*self.first)
            + size_of_val(&*self.keys)
            + size_of_val(&*self.born)
            + size_of_val(&*self.parameters)
            + size_of_val(&*self.mates)
            + size_of_val(&*self.times)
    }

    /// Parameters of a module.
    pub fn parameters(&self, at: usize) -> &[f64] {
        let end = self.first.get(at + 1).map_or(self.parameters.len(), |&end| end as usize);
        &self.parameters[self.first[at] as usize..end]
    }

    /// What a module is known by from step to step.
    pub fn key(&self, at: usize) -> u64 {
        self.keys[at]
    }

    /// The step in which a module came to be.
    pub fn born(&self, at: usize) -> u32 {
        self.born[at]
    }

    /// As it would be written, numbers in full.
    pub fn text(&self, grammar: &Grammar) -> String {
        let mut text = String::new();
        for at in 0..self.len() {
            text.push_str(grammar.symbols.name(self.symbols[at]));
            let parameters: Vec<_> = self.parameters(at).iter().map(f64::to_string).collect();
            if !parameters.is_empty() {
                text.push_str(&format!("({})", parameters.join(",")));
            }
        }
        text
    }

    pub(crate) fn symbol(&self, at: usize) -> Symbol {
        self.symbols[at]
    }

    pub(crate) fn tag(&self, at: usize) -> Tag {
        let time = self.times.get(at).copied().unwrap_or_default();
        Tag { symbol: self.symbols[at], key: self.keys[at], born: self.born[at], time }
    }

    /// The counterpart of a bracket.
    pub(crate) fn mate(&self, at: usize) -> usize {
        self.mates[at] as usize
    }

    /// Writes over the first parameters of a module.
    pub(crate) fn fill(&mut self, at: usize, values: &[f64]) {
        let first = self.first[at] as usize;
        let count = self.parameters(at).len().min(values.len());
        self.parameters[first..first + count].copy_from_slice(&values[..count]);
    }

    pub(crate) fn clear(&mut self) {
        self.symbols.clear();
        self.first.clear();
        self.keys.clear();
        self.born.clear();
        self.parameters.clear();
        self.mates.clear();
        self.times.clear();
        self.open.clear();
    }

    /// Begins a module; its parameters are pushed after it.
    pub(crate) fn push(&mut self, tag: Tag, limits: &Limits) -> Result<(), Stop> {
        let at = self.symbols.len();
        if at >= limits.modules {
            return Err(Stop::Modules(limits.modules));
        }
        if self.parameters.len() > limits.parameters {
            return Err(Stop::Parameters(limits.parameters));
        }
        self.symbols.push(tag.symbol);
        self.first.push(self.parameters.len() as u32);
        self.keys.push(tag.key);
        self.born.push(tag.born);
        if self.columns.times {
            self.times.push(tag.time);
        }
        if self.columns.mates {
            self.mates.push(at as u32);
        }
        if tag.symbol <= POP { self.pair(at, tag.symbol, limits) } else { Ok(()) }
    }

    /// Begins modules in columns; their parameters are pushed after them. All have the birth and time of a tag, but for an
    /// heir, whose birth is its own.
    pub(crate) fn extend_plain(
        &mut self,
        plain: &Plain,
        key: impl Fn(usize) -> u64,
        new: Tag,
        heir: Option<(usize, u32)>,
        limits: &Limits,
    ) -> Result<(), Stop> {
        let (begin, count) = (self.symbols.len(), plain.symbols.len());
        if begin + count > limits.modules {
            return Err(Stop::Modules(limits.modules));
        }
        if self.parameters.len() + plain.parameters > limits.parameters {
            return Err(Stop::Parameters(limits.parameters));
        }
        let from = self.parameters.len() as u32;
        self.symbols.extend_from_slice(&plain.symbols);
        self.first.extend(plain.first.iter().map(|first| from + first));
        self.parameters.reserve(plain.parameters);
        self.keys.extend((0..count).map(key));
        self.born.resize(begin + count, new.born);
        if let Some((number, born)) = heir {
            self.born[begin + number] = born;
        }
        if self.columns.times {
            self.times.resize(begin + count, new.time);
        }
        if self.columns.mates {
            self.mates.extend(begin as u32..(begin + count) as u32);
        }
        for &number in &plain.brackets {
            self.pair(begin + number as usize, plain.symbols[number as usize], limits)?;
        }
        Ok(())
    }

    /// How many modules from the first of some on are not among those that rules act on.
    pub(crate) fn run(&self, within: Range<usize>, active: &[bool]) -> usize {
        let symbols = &self.symbols[within];
        symbols.iter().position(|&symbol| active[symbol as usize]).unwrap_or(symbols.len())
    }

    /// Appends modules of another word as they are.
    pub(crate) fn extend_from(
        &mut self,
        other: &Self,
        run: Range<usize>,
        limits: &Limits,
    ) -> Result<(), Stop> {
        let begin = self.symbols.len();
        if begin + run.len() > limits.modules {
            return Err(Stop::Modules(limits.modules));
        }
        let from = other.first[run.start] as usize;
        let to = other.first.get(run.end).map_or(other.parameters.len(), |&end| end as usize);
        if self.parameters.len() + (to - from) > limits.parameters {
            return Err(Stop::Parameters(limits.parameters));
        }
        let moved = (self.parameters.len() as u32).wrapping_sub(from as u32);
        self.symbols.extend_from_slice(&other.symbols[run.clone()]);
        self.first.extend(other.first[run.clone()].iter().map(|first| first.wrapping_add(moved)));
        self.keys.extend_from_slice(&other.keys[run.clone()]);
        self.born.extend_from_slice(&other.born[run.clone()]);
        self.parameters.extend_from_slice(&other.parameters[from..to]);
        if self.columns.times {
            self.times.extend_from_slice(&other.times[run.clone()]);
        }
        if self.columns.mates {
            self.mates.extend(begin as u32..(begin + run.len()) as u32);
        }
        for (at, &symbol) in (begin..).zip(&other.symbols[run]) {
            if symbol <= POP {
                self.pair(at, symbol, limits)?;
            }
        }
        Ok(())
    }

    /// Notes a bracket.
    fn pair(&mut self, at: usize, symbol: Symbol, limits: &Limits) -> Result<(), Stop> {
        if symbol == PUSH {
            if self.open.len() >= limits.nesting {
                return Err(Stop::Nesting(limits.nesting));
            }
            self.open.push(at as u32);
            return Ok(());
        }
        // Strings are balanced when they are read, and so is what is put together from them.
        let begun = self.open.pop().unwrap_or(at as u32);
        if self.columns.mates {
            self.mates[at] = begun;
            self.mates[begun as usize] = at as u32;
        }
        Ok(())
    }

    pub(crate) fn push_parameter(&mut self, value: f64) {
        self.parameters.push(value);
    }

    pub(crate) fn push_parameters(&mut self, values: &[f64]) {
        self.parameters.extend_from_slice(values);
    }
}
