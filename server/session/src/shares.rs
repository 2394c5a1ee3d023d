//! How much each of several people has of something.

use std::{collections::BTreeMap, sync::Arc};

/// What each has; nobody is kept who has nothing.
#[derive(Debug, Default)]
pub(crate) struct Shares(BTreeMap<Arc<str>, usize>);

impl Shares {
    /// Somebody has one more.
    pub(crate) fn add(&mut self, person: &Arc<str>) {
        *self.0.entry(Arc::clone(person)).or_default() += 1;
    }

    /// Somebody has one less.
    pub(crate) fn take(&mut self, person: &str) {
        if let Some(count) = self.0.get_mut(person) {
            *count -= 1;
            if *count == 0 {
                self.0.remove(person);
            }
        }
    }

    /// What somebody has.
    pub(crate) fn of(&self, person: &str) -> usize {
        self.0.get(person).copied().unwrap_or(0)
    }
}
