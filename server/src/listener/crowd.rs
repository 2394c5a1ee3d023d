//! Connections for which there is no place: the newest of them are told so, and older ones make way.

use std::{
    collections::VecDeque,
    sync::{Mutex, MutexGuard, PoisonError},
};

use tokio_util::sync::CancellationToken;

/// The connections that are being told, the oldest first.
#[derive(Debug)]
pub(super) struct Crowd {
    most: usize,
    told: Mutex<Newest>,
}

#[derive(Debug, Default)]
struct Newest {
    /// How many have come.
    count: u64,
    /// Those who are here, by their numbers.
    here: VecDeque<(u64, CancellationToken)>,
}

/// One of them; it is told no longer when this is dropped.
#[derive(Debug)]
pub(super) struct Told<'a> {
    crowd: &'a Crowd,
    number: u64,
    /// It makes way for another one.
    pub(super) makes_way: CancellationToken,
}

impl Crowd {
    /// So many are told at a time.
    pub(super) fn new(most: usize) -> Self {
        Self { most: most.max(1), told: Mutex::default() }
    }

    /// One more has come. The oldest makes way where there are too many: whoever asks is told in a moment, so that one
    /// which is still here most likely says nothing.
    pub(super) fn enter(&self) -> Told<'_> {
        let mut told = self.told();
        told.count += 1;
        let (number, makes_way) = (told.count, CancellationToken::new());
        told.here.push_back((number, makes_way.clone()));
        if told.here.len() > self.most
            && let Some((_, oldest)) = told.here.pop_front()
        {
            oldest.cancel();
        }
        Told { crowd: self, number, makes_way }
    }

    fn told(&self) -> MutexGuard<'_, Newest> {
        self.told.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Told<'_> {
    fn drop(&mut self) {
        self.crowd.told().here.retain(|(number, _)| *number != self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_makes_way_and_whoever_was_told_leaves_room() {
        let crowd = Crowd::new(2);
        let (first, second) = (crowd.enter(), crowd.enter());
        drop(second);
        let third = crowd.enter();
        assert!(!first.makes_way.is_cancelled(), "there is room for two");
        let fourth = crowd.enter();
        let made_way = [&first, &third, &fourth].map(|told| told.makes_way.is_cancelled());
        assert_eq!(made_way, [true, false, false]);
        drop((first, third, fourth));
        assert!(crowd.told().here.is_empty());
    }
}
