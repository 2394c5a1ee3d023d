//! What ends a derivation: budgets, checked while it goes on, and numbers that are none.

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

/// Why a derivation or a reading ended. What was derived before stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// The word would have more modules than it may.
    #[error("the next step has more than {0} modules")]
    Modules(usize),
    /// It would have more parameters than it may.
    #[error("the modules of the next step have more than {0} parameters in all")]
    Parameters(usize),
    /// Branches would lie deeper in each other than they may.
    #[error("branches lie more than {0} deep in each other")]
    Nesting(usize),
    /// It takes too long.
    #[error("it takes more than {0} steps of computing")]
    Work(u64),
    /// A parameter, condition or probability is no number, or is infinite.
    #[error("line {line}, column {column}: a number is infinite or undefined (a division by 0, say)")]
    NoNumber {
        /// The line of the rule or definition, counted from 1.
        line: u32,
        /// Its first character.
        column: u32,
    },
    /// No alternative of a rule has a probability above 0.
    #[error(
        "line {line}, column {column}: the probabilities of the alternatives are not all 0 or more, or add up to 0"
    )]
    NoProbability {
        /// The line of the first alternative.
        line: u32,
        /// Its first character.
        column: u32,
    },
    /// Rules go on acting within one step.
    #[error("line {line}, column {column}: the rule goes on for more than {most} times within one step")]
    Endless {
        /// The line of the rule.
        line: u32,
        /// Its first character.
        column: u32,
        /// How often it may.
        most: u32,
    },
    /// The wood would have more nodes than it may.
    #[error("the word draws more than {0} internodes")]
    Nodes(usize),
    /// The wood would reach farther than it may.
    #[error("the wood reaches farther than {0} internodes; a smaller scale: shrinks it")]
    Extent(u32),
}
