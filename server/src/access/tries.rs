//! How often somebody may try a secret.

use std::{
    collections::BTreeMap,
    net::{IpAddr, Ipv6Addr},
    sync::{Mutex, PoisonError},
    time::{Duration, Instant},
};

/// So many tries are free,
const FREE: u32 = 5;
/// in so long; the next one waits as long, and each after it twice as long as the one before,
const WINDOW: Duration = Duration::from_secs(30);
/// but no longer than this.
const LONGEST: Duration = Duration::from_mins(15);
/// Whoever has not tried for so long begins anew; it is longer than any pause.
const FORGOTTEN: Duration = Duration::from_mins(30);
/// Remembered at a time; of more, those that tried first are forgotten.
const MOST: usize = 10_000;

/// Counts tries by where they come from, or by the name that they are for (`AC7`).
#[derive(Debug)]
pub struct Tries<By>(Mutex<BTreeMap<By, Tried>>);

#[derive(Clone, Copy, Debug)]
struct Tried {
    count: u32,
    /// When the first of them was.
    since: Instant,
    last: Instant,
    /// Before this none is allowed; it is never further off than the longest pause.
    until: Instant,
}

impl<By> Default for Tries<By> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<By: Copy + Ord> Tries<By> {
    /// Counts a try; where it comes too soon, says how long to wait.
    pub fn count(&self, by: By, now: Instant) -> Result<(), Duration> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_over = |tried: &Tried| now.saturating_duration_since(tried.last) >= FORGOTTEN;
        if all.get(&by).is_some_and(is_over) {
            all.remove(&by);
        }
        if all.len() >= MOST && !all.contains_key(&by) {
            all.retain(|_, tried| !is_over(tried));
            let first = all.iter().min_by_key(|(_, tried)| tried.last).map(|(by, _)| *by);
            if let Some(first) = first.filter(|_| all.len() >= MOST) {
                all.remove(&first);
            }
        }
        let tried = all.entry(by).or_insert(Tried { count: 0, since: now, last: now, until: now });
        if now < tried.until {
            return Err(tried.until - now);
        }
        if tried.count < FREE && now.duration_since(tried.since) >= WINDOW {
            (tried.count, tried.since) = (0, now);
        }
        tried.count += 1;
        tried.last = now;
        if let Some(doublings) = tried.count.checked_sub(FREE) {
            let pause = WINDOW.saturating_mul(2u32.saturating_pow(doublings));
            tried.until = now + pause.min(LONGEST);
        }
        Ok(())
    }

    /// Forgets the tries of whoever had the right secret.
    pub fn forget(&self, by: By) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).remove(&by);
    }
}

/// What one household or machine has: an IPv4 address, or the first half of an IPv6 address.
pub fn network(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V6(v6) => IpAddr::V6(Ipv6Addr::from_bits(v6.to_bits() & !u128::from(u64::MAX))),
        v4 => v4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> IpAddr {
        network(text.parse().unwrap())
    }

    #[test]
    fn ac7_five_tries_are_free_and_pauses_double() {
        let (tries, start) = (Tries::default(), Instant::now());
        let mut now = start;
        let one = at("192.168.1.9");
        for _ in 0..FREE {
            assert_eq!(tries.count(one, now), Ok(()));
        }
        for pause in [30, 60, 120, 240, 480, 900, 900] {
            let pause = Duration::from_secs(pause);
            assert_eq!(tries.count(one, now), Err(pause));
            now += pause - Duration::from_secs(1);
            assert_eq!(
                tries.count(one, now),
                Err(Duration::from_secs(1)),
                "what is refused counts for nothing"
            );
            now += Duration::from_secs(1);
            assert_eq!(tries.count(at("192.168.1.8"), start), Ok(()), "others are free");
            tries.forget(at("192.168.1.8"));
            assert_eq!(tries.count(one, now), Ok(()));
        }
        tries.forget(one);
        assert_eq!(tries.count(one, now), Ok(()));
    }

    #[test]
    fn ac7_slow_tries_are_free_and_a_network_is_one() {
        let (tries, start) = (Tries::default(), Instant::now());
        for minute in 0..20 {
            for _ in 0..FREE - 1 {
                assert_eq!(tries.count(at("10.0.0.1"), start + Duration::from_mins(minute)), Ok(()));
            }
        }
        for host in 1..=FREE {
            assert_eq!(tries.count(at(&format!("2001:db8::{host}")), start), Ok(()));
        }
        assert!(tries.count(at("2001:db8::9"), start).is_err());
        assert!(tries.count(at("2001:db8:0:1::9"), start).is_ok());
    }

    #[test]
    fn ac7_what_is_remembered_is_bounded() {
        let (tries, start) = (Tries::default(), Instant::now());
        for host in 0..MOST as u32 + 50 {
            let from = IpAddr::V4(host.into());
            assert_eq!(tries.count(from, start + Duration::from_millis(u64::from(host))), Ok(()));
        }
        assert_eq!(tries.0.lock().unwrap().len(), MOST);
    }
}
