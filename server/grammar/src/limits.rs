//! What ends a derivation: budgets, checked while it goes on, and numbers that are none.

use std::fmt::{self, Display, Formatter};

use crate::{
    diagnostic::{Values, written},
    wording::{self, Wording, filled},
};

/// How much a derivation may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Modules of a word.
    pub modules: usize,
    /// Parameters of all modules of a word.
    pub parameters: usize,
    /// Brackets within each other.
    pub nesting: usize,
    /// Steps of expressions and of looking for contexts, in all.
    pub work: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { modules: 8_000_000, parameters: 16_000_000, nesting: 512, work: 2_000_000_000 }
    }
}

/// What one module may become at most within a step, by decomposition or for its lifespan, or be read as.
pub const MOST_OF_ONE: usize = 200_000;
/// A word may be read as so many times the modules that it may have.
pub(crate) const READ_FOR_EACH: usize = 4;
/// For each module that a slice of work is to take it ends after so many steps of computing as well,
pub(crate) const WORK_FOR_EACH: u64 = 8;
/// and after so many modules that came of it.
pub(crate) const MADE_FOR_EACH: usize = 2;

/// Why a derivation or a reading ended. What was derived before stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The word would have more modules than it may.
    Modules(usize),
    /// It would have more parameters than it may.
    Parameters(usize),
    /// Branches would lie deeper in each other than they may.
    Nesting(usize),
    /// It takes too long.
    Work(u64),
    /// A parameter, condition or probability is no number, or is infinite.
    NoNumber {
        /// The line of the rule or definition, counted from 1.
        line: u32,
        /// Its first character.
        column: u32,
    },
    /// No alternative of a rule has a probability above 0.
    NoProbability {
        /// The line of the first alternative.
        line: u32,
        /// Its first character.
        column: u32,
    },
    /// Rules go on acting within one step.
    Endless {
        /// The line of the rule.
        line: u32,
        /// Its first character.
        column: u32,
        /// How often it may.
        most: u32,
    },
    /// One module becomes more modules at once than it may, or is read as more.
    Single(usize),
    /// The word is read as more modules than it may.
    Read(usize),
    /// The wood would have more nodes than it may.
    Nodes(usize),
    /// The wood would reach farther than it may.
    Extent(u32),
    /// Where the wood is laid down there is no room for more of it.
    Full,
    /// There it would lie outside the world, which ends so far from its middle.
    World(u32),
    /// There it would not fit what stands already.
    Broken,
    /// Who only counts sizes counts no further.
    Counted,
}

impl Stop {
    /// The name of its sentence among [all](crate::WORDINGS), and what stands in the sentence's braces.
    pub fn sentence(&self) -> (&'static Wording, Vec<(&'static str, String)>) {
        let most = |wording, most: &dyn Display| (wording, written(&[("most", most)]));
        let at = |wording, line: &u32, column: &u32| {
            let values: Values = written(&[("line", line), ("column", column)]);
            (wording, values)
        };
        match self {
            Self::Modules(count) => most(wording::ENDS_MODULES, count),
            Self::Parameters(count) => most(wording::ENDS_PARAMETERS, count),
            Self::Nesting(count) => most(wording::ENDS_NESTING, count),
            Self::Work(steps) => most(wording::ENDS_WORK, steps),
            Self::NoNumber { line, column } => at(wording::ENDS_NO_NUMBER, line, column),
            Self::NoProbability { line, column } => at(wording::ENDS_NO_PROBABILITY, line, column),
            Self::Endless { line, column, most } => {
                let values = written(&[("line", line), ("column", column), ("most", most)]);
                (wording::ENDS_ENDLESS, values)
            }
            Self::Single(count) => most(wording::ENDS_SINGLE, count),
            Self::Read(count) => most(wording::ENDS_READ, count),
            Self::Nodes(count) => most(wording::ENDS_NODES, count),
            Self::Extent(extent) => most(wording::ENDS_EXTENT, extent),
            Self::Full => (wording::ENDS_FULL, Vec::new()),
            Self::World(extent) => most(wording::ENDS_WORLD, extent),
            Self::Broken => (wording::ENDS_BROKEN, Vec::new()),
            Self::Counted => (wording::ENDS_COUNTED, Vec::new()),
        }
    }
}

impl Display for Stop {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (wording, values) = self.sentence();
        f.write_str(&filled(wording.message, &values))
    }
}

impl std::error::Error for Stop {}
