//! How often somebody may do what is right.

use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
    time::{Duration, Instant},
};

/// Remembered at a time; of more, those that began first are forgotten.
const MOST: usize = 10_000;

/// Counts what is done, by whom it is done or where it comes from: so many in a time, then none until the time is over.
#[derive(Debug)]
pub struct Rate<By> {
    most: u32,
    time: Duration,
    /// Since when, and how often.
    counts: Mutex<BTreeMap<By, (Instant, u32)>>,
}

impl<By: Copy + Ord> Rate<By> {
    /// Up to `most` in this time.
    pub fn new(most: u32, time: Duration) -> Self {
        Self { most, time, counts: Mutex::default() }
    }

    /// Counts one more; where it is one too many, says how long to wait.
    pub fn count(&self, by: By, now: Instant) -> Result<(), Duration> {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        let since = |since: Instant| now.saturating_duration_since(since);
        if counts.len() >= MOST && !counts.contains_key(&by) {
            counts.retain(|_, (begun, _)| since(*begun) < self.time);
            let first = counts.iter().min_by_key(|(_, (begun, _))| *begun).map(|(by, _)| *by);
            first.filter(|_| counts.len() >= MOST).map(|first| counts.remove(&first));
        }
        let (begun, count) = counts.entry(by).or_insert((now, 0));
        if since(*begun) >= self.time {
            (*begun, *count) = (now, 0);
        }
        if *count >= self.most {
            return Err(self.time - since(*begun));
        }
        *count += 1;
        Ok(())
    }

    /// What was counted just now counts no longer.
    pub fn uncount(&self, by: By) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, count)) = counts.get_mut(&by) {
            *count = count.saturating_sub(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ac11_so_many_in_a_time_and_then_again() {
        let (rate, start) = (Rate::new(3, Duration::from_mins(10)), Instant::now());
        let at = |minute| start + Duration::from_mins(minute);
        for minute in 0..3 {
            assert_eq!(rate.count(1, at(minute)), Ok(()));
        }
        assert_eq!(rate.count(1, at(4)), Err(Duration::from_mins(6)));
        assert_eq!(rate.count(2, at(4)), Ok(()), "others are free");
        assert_eq!(rate.count(1, at(10)), Ok(()));
    }

    #[test]
    fn ac11_what_is_not_to_count_leaves_room() {
        let (rate, now) = (Rate::new(1, Duration::from_mins(10)), Instant::now());
        rate.uncount(1);
        assert_eq!(rate.count(1, now), Ok(()));
        rate.uncount(1);
        assert_eq!(rate.count(1, now), Ok(()));
        assert!(rate.count(1, now).is_err());
    }

    #[test]
    fn ac11_what_is_remembered_is_bounded() {
        let (rate, start) = (Rate::new(1, Duration::from_mins(10)), Instant::now());
        for by in 0..MOST + 50 {
            assert_eq!(rate.count(by, start + Duration::from_micros(by as u64)), Ok(()));
        }
        assert_eq!(rate.counts.lock().unwrap().len(), MOST);
    }
}
