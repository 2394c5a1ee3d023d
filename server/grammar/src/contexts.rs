//! What stands beside a module in the tree: to the left the way to the root, to the right the axis and its branches.

use crate::{
    grammar::{Ahead, Neighbour},
    program::Program,
    symbols::{POP, PUSH},
    word::Word,
};

/// Looks for contexts in a word, and counts the modules looked at.
pub(crate) struct Contexts<'a> {
    pub word: &'a Word,
    pub program: &'a Program,
    /// The parameters of a predecessor with its contexts.
    pub frame: &'a mut [f64],
    pub work: &'a mut u64,
    /// Beyond so much work nothing is found any more; the derivation ends then.
    pub most: u64,
}

impl Contexts<'_> {
    /// Whether modules lie on the way from a module to the root, the last of them next to it.
    pub fn lie_below(&mut self, from: usize, wanted: &[Neighbour]) -> bool {
        let mut at = from;
        wanted.iter().rev().all(|neighbour| {
            loop {
                let Some(before) = at.checked_sub(1).filter(|_| *self.work < self.most) else { return false };
                *self.work += 1;
                at = before;
                match self.word.symbol(at) {
                    POP => at = self.word.mate(at),
                    PUSH => {}
                    symbol if self.program.passed_over[symbol as usize] => {}
                    _ => return self.is(at, neighbour),
                }
            }
        })
    }

    /// Whether modules and branches follow a place; returns where the text goes on.
    pub fn lie_above(&mut self, from: usize, wanted: &[Ahead]) -> Option<usize> {
        let mut at = from;
        for part in wanted {
            at = loop {
                if at >= self.word.len() || *self.work >= self.most {
                    return None;
                }
                *self.work += 1;
                match (self.word.symbol(at), part) {
                    (POP, _) => return None,
                    (PUSH, Ahead::Branch(inner)) => {
                        let end = self.word.mate(at) + 1;
                        if self.lie_above(at + 1, inner).is_some() {
                            break end;
                        }
                        at = end;
                    }
                    (PUSH, Ahead::Module(_)) => at = self.word.mate(at) + 1,
                    (symbol, _) if self.program.passed_over[symbol as usize] => at += 1,
                    (_, Ahead::Module(neighbour)) if self.is(at, neighbour) => break at + 1,
                    _ => return None,
                }
            };
        }
        Some(at)
    }

    fn is(&mut self, at: usize, neighbour: &Neighbour) -> bool {
        let parameters = self.word.parameters(at);
        let fits =
            self.word.symbol(at) == neighbour.symbol && parameters.len() == usize::from(neighbour.arity);
        if fits {
            let first = usize::from(neighbour.first);
            self.frame[first..first + parameters.len()].copy_from_slice(parameters);
        }
        fits
    }
}
