//! Who may write to a session.

use std::{
    collections::BTreeMap,
    sync::{Mutex, MutexGuard, PoisonError},
};

use super::StoreError;

/// The right to write to one session. It ends when somebody acquires the session anew.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lease {
    /// The session's name.
    pub(super) session: String,
    epoch: u64,
}

/// The leases of a store that one process at a time has to itself.
#[derive(Debug, Default)]
pub(super) struct Leases(Mutex<Granted>);

#[derive(Debug, Default)]
struct Granted {
    last: u64,
    epochs: BTreeMap<String, u64>,
}

impl Leases {
    pub(super) fn acquire(&self, session: &str) -> Lease {
        let mut granted = self.granted();
        granted.last += 1;
        let epoch = granted.last;
        granted.epochs.insert(session.to_owned(), epoch);
        Lease { session: session.to_owned(), epoch }
    }

    pub(super) fn release(&self, lease: &Lease) {
        let mut granted = self.granted();
        if granted.epochs.get(&lease.session) == Some(&lease.epoch) {
            granted.epochs.remove(&lease.session);
        }
    }

    /// Whether somebody may write to a session now.
    pub(super) fn is_held(&self, session: &str) -> bool {
        self.granted().epochs.contains_key(session)
    }

    pub(super) fn check(&self, lease: &Lease) -> Result<(), StoreError> {
        if self.granted().epochs.get(&lease.session) == Some(&lease.epoch) {
            Ok(())
        } else {
            Err(StoreError::Fenced)
        }
    }

    fn granted(&self) -> MutexGuard<'_, Granted> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
