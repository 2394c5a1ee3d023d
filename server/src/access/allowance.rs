//! How often somebody may do what costs the server something for long.

use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
    time::{Duration, Instant},
};

use super::SecretHash;

/// So many times at once,
const AT_ONCE: u32 = 20;
/// and then again after so long for each time.
const EACH: Duration = Duration::from_secs(6);
/// Remembered at a time; more are few, for all of them were let in.
const MOST: usize = 10_000;

/// Counts what is done by who does it (`LM17`).
#[derive(Debug, Default)]
pub struct Allowances(Mutex<BTreeMap<SecretHash, Instant>>);

impl Allowances {
    /// Counts that somebody does it once more; where that is too soon, says how long to wait.
    pub fn count(&self, by: SecretHash, now: Instant) -> Result<(), Duration> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if all.len() >= MOST {
            all.retain(|_, whole| *whole > now);
        }
        // When all that was used up is there again.
        let whole = all.get(&by).copied().unwrap_or(now).max(now);
        let wait = (whole + EACH).saturating_duration_since(now + EACH * AT_ONCE);
        if !wait.is_zero() {
            return Err(wait);
        }
        all.insert(by, whole + EACH);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::hash;

    #[test]
    fn lm17_some_times_are_free_and_then_one_after_another() {
        let (allowances, start) = (Allowances::default(), Instant::now());
        let count = |now| allowances.count(hash("ash"), now);
        for _ in 0..AT_ONCE {
            assert_eq!(count(start), Ok(()));
        }
        assert_eq!(count(start), Err(EACH));
        assert_eq!(allowances.count(hash("oak"), start), Ok(()), "others are free");
        let soon = start + EACH / 2;
        assert_eq!(count(soon), Err(EACH / 2), "what is refused counts for nothing");
        assert_eq!(count(start + EACH), Ok(()));
        assert_eq!(count(start + EACH), Err(EACH));
        let later = start + EACH * (AT_ONCE + 1);
        for _ in 0..AT_ONCE {
            assert_eq!(count(later), Ok(()));
        }
        assert!(count(later).is_err(), "what was not used is not kept for ever");
    }
}
