//! Memory as a whole: whoever begins something large takes its weight first, and is told where none is left (`LM19`).

mod budget;
mod claim;
mod limit;
mod weights;

use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use tokio::{
    sync::Notify,
    time::{Instant, timeout_at},
};

pub use self::{budget::Budget, weights::*};
pub use self::{
    budget::{Full, Need, Use},
    claim::{Claim, Growing},
    limit::{Bytes, of_container, of_machine},
};

/// How long somebody waits for memory that may become free: sessions in which nobody is leave when it is short.
const PATIENCE: Duration = Duration::from_secs(2);
/// When whoever finds none may try again.
pub const AGAIN: Duration = Duration::from_secs(5);

/// The memory of the server.
#[derive(Clone, Debug)]
pub struct Memory(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    budget: Mutex<Budget>,
    /// How long somebody waits for what may become free.
    patience: Duration,
    /// Somebody found none left.
    short: Notify,
    /// Somebody gave some back.
    freed: Notify,
}

impl Memory {
    /// So many bytes may be taken.
    pub fn of(bytes: u64) -> Self {
        Self::with_patience(bytes, PATIENCE)
    }

    /// The same where somebody waits so long for what may become free.
    pub fn with_patience(bytes: u64, patience: Duration) -> Self {
        let budget = Mutex::new(Budget::new(bytes));
        Self(Arc::new(Inner { budget, patience, short: Notify::new(), freed: Notify::new() }))
    }

    /// As much as was said, as the container may have and as the machine has; this is logged.
    pub fn found(said: Option<Bytes>) -> Self {
        let (limit, source) = limit::least(said, of_container(), of_machine());
        let bytes = limit::to_be_taken(limit);
        tracing::info!(
            mebibytes = bytes >> 20,
            "memory for sessions, exports, uploads and jobs, by {source} ({} MiB)",
            limit >> 20
        );
        Self::of(bytes)
    }

    /// Takes so much, or says that there is not so much left.
    pub fn take(&self, what: Use, need: Need, bytes: u64) -> Result<Claim, Full> {
        let taken = self.sums().take(what, need, bytes);
        match taken {
            Ok(()) => Ok(Claim::new(self.clone(), what, bytes)),
            Err(full) => {
                self.0.short.notify_waiters();
                Err(full)
            }
        }
    }

    /// The same, where somebody waits a little for what may become free.
    pub async fn take_soon(&self, what: Use, bytes: u64) -> Result<Claim, Full> {
        let until = Instant::now() + self.0.patience;
        loop {
            // Before it is asked, so that nothing that is given back meanwhile is missed.
            let freed = self.0.freed.notified();
            match self.take(what, Need::Other, bytes) {
                Err(full) if timeout_at(until, freed).await.is_err() => return Err(full),
                Err(_) => {}
                taken => return taken,
            }
        }
    }

    /// How long somebody waits for what may become free.
    pub fn patience(&self) -> Duration {
        self.0.patience
    }

    /// Waits until somebody finds none left.
    pub async fn short(&self) {
        self.0.short.notified().await;
    }

    /// What is taken at this moment: a copy, so that whoever looks keeps nobody from taking.
    pub fn look(&self) -> Budget {
        self.sums().clone()
    }

    /// What is taken, to change.
    fn sums(&self) -> MutexGuard<'_, Budget> {
        self.0.budget.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn lm19_who_waits_gets_what_is_given_back() {
        let hasty = Memory::with_patience(1000, Duration::from_millis(1));
        let _all = hasty.take(Use::Session, Need::Other, 800).unwrap();
        assert_eq!(hasty.take_soon(Use::Export, 100).await.map(drop), Err(Full));
        let memory = Memory::with_patience(1000, Duration::from_mins(1));
        let first = memory.take(Use::Session, Need::Other, 800).unwrap();
        let waiting = tokio::spawn({
            let memory = memory.clone();
            async move { memory.take_soon(Use::Export, 100).await.map(|claim| claim.bytes()) }
        });
        memory.short().await;
        drop(first);
        assert_eq!(waiting.await.unwrap(), Ok(100));
        assert_eq!(memory.look().taken(), 0, "all is given back");
    }
}
