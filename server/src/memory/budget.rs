//! How much memory what for: the sums, without a clock, a thread or the system.

use std::fmt;

/// What memory is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Use {
    /// A session with its document.
    Session,
    /// A copy of a document that grows ahead.
    Prediction,
    /// A connection to a session.
    Socket,
    /// A file that is made of a document.
    Export,
    /// A file that is read.
    Upload,
    /// A tree that a job grows.
    Job,
}

impl Use {
    /// All of them, each with its name.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::Session, "sessions"),
        (Self::Prediction, "predictions"),
        (Self::Socket, "sockets"),
        (Self::Export, "exports"),
        (Self::Upload, "uploads"),
        (Self::Job, "jobs"),
    ];
}

/// For whom memory is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Somebody draws in a session that is open: a part is kept for them.
    Drawing,
    /// Anything else.
    Other,
}

/// This part of all, in hundredths, is kept for those who draw.
const KEPT_FOR_DRAWING: u64 = 15;

/// Bytes that may be taken, and those that are.
#[derive(Clone, Debug)]
pub struct Budget {
    all: u64,
    taken: [u64; Use::ALL.len()],
    /// How often there was none left.
    refused: u64,
}

/// There is not so much left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the server has no memory left for this")]
pub struct Full;

impl Budget {
    /// So many bytes, none of which are taken.
    pub fn new(all: u64) -> Self {
        Self { all, taken: [0; Use::ALL.len()], refused: 0 }
    }

    /// Bytes that may be taken.
    pub fn all(&self) -> u64 {
        self.all
    }

    /// Bytes that are taken for this.
    pub fn taken_for(&self, what: Use) -> u64 {
        self.taken[what as usize]
    }

    /// Bytes that are taken.
    pub fn taken(&self) -> u64 {
        self.taken.iter().fold(0, |sum, &bytes| sum.saturating_add(bytes))
    }

    /// Bytes that are left for anything but drawing.
    pub fn left(&self) -> u64 {
        self.most(Need::Other).saturating_sub(self.taken())
    }

    fn most(&self, need: Need) -> u64 {
        match need {
            Need::Drawing => self.all,
            Need::Other => self.all - self.all / 100 * KEPT_FOR_DRAWING,
        }
    }

    /// How often there was none left.
    pub fn refused(&self) -> u64 {
        self.refused
    }

    /// Takes more for this, or nothing.
    pub fn take(&mut self, what: Use, need: Need, bytes: u64) -> Result<(), Full> {
        if self.taken().saturating_add(bytes) > self.most(need) {
            self.refused += 1;
            return Err(Full);
        }
        self.taken[what as usize] += bytes;
        Ok(())
    }

    /// Takes it though there may be none left, for it is in use already.
    pub fn own_up(&mut self, what: Use, bytes: u64) {
        let taken = &mut self.taken[what as usize];
        *taken = taken.saturating_add(bytes);
    }

    /// Gives some back.
    pub fn give_back(&mut self, what: Use, bytes: u64) {
        let taken = &mut self.taken[what as usize];
        *taken = taken.saturating_sub(bytes);
    }
}

impl fmt::Display for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} MiB of {} MiB", self.taken() >> 20, self.all >> 20)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn lm19_what_is_kept_for_drawing_is_given_to_nothing_else() {
        let mut budget = Budget::new(1000);
        assert_eq!(budget.take(Use::Session, Need::Other, 850), Ok(()));
        assert_eq!(budget.take(Use::Export, Need::Other, 1), Err(Full));
        assert_eq!(budget.take(Use::Session, Need::Drawing, 150), Ok(()));
        assert_eq!(budget.take(Use::Session, Need::Drawing, 1), Err(Full));
        assert_eq!((budget.taken(), budget.refused()), (1000, 2));
        budget.give_back(Use::Session, 600);
        assert_eq!(budget.take(Use::Upload, Need::Other, 450), Ok(()));
        assert_eq!([Use::Session, Use::Upload].map(|what| budget.taken_for(what)), [400, 450]);
    }

    #[test]
    fn what_is_in_use_already_counts_beyond_the_end() {
        let mut budget = Budget::new(100);
        budget.own_up(Use::Session, 300);
        assert_eq!(budget.take(Use::Socket, Need::Drawing, 0), Err(Full));
        budget.give_back(Use::Session, 250);
        assert_eq!(budget.take(Use::Socket, Need::Drawing, 50), Ok(()));
    }

    proptest! {
        /// Whatever is asked for and given back, no more is taken than there is, and all of it comes back.
        #[test]
        fn lm19_no_more_is_taken_than_there_is(
            all in 0..1u64 << 40,
            asks in prop::collection::vec((0..6usize, any::<bool>(), 0..1u64 << 38, any::<bool>()), 0..60),
        ) {
            let mut budget = Budget::new(all);
            let mut held = Vec::new();
            for (what, draws, bytes, returns) in asks {
                let what = Use::ALL[what].0;
                let need = if draws { Need::Drawing } else { Need::Other };
                if budget.take(what, need, bytes).is_ok() {
                    held.push((what, bytes));
                }
                prop_assert!(budget.taken() <= all);
                if returns && let Some((what, bytes)) = held.pop() {
                    budget.give_back(what, bytes);
                }
                let sum: u64 = held.iter().map(|(_, bytes)| bytes).sum();
                prop_assert_eq!(budget.taken(), sum);
            }
        }
    }
}
