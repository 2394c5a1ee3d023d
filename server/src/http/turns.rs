//! Whose turn it is to have a file made: one file of structure, one picture and one large or moving picture at a time, in
//! the order in which they were asked for. A moving picture may take minutes, and nothing else waits for it.

use std::{
    collections::BTreeSet,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::pool::Panicked;

/// The turns of a server.
#[derive(Clone, Debug, Default)]
pub struct Turns {
    files: Lane,
    pictures: Lane,
    large_pictures: Lane,
}

/// Pixels of a picture that is drawn within seconds.
const QUICK: u64 = 4_000_000;

impl Turns {
    /// Comes last among those who want such a picture, of so many pixels, or any other file, which has none.
    pub(super) fn come(&self, pixels: u64) -> Place {
        let lane = match pixels {
            0 => &self.files,
            1..=QUICK => &self.pictures,
            _ => &self.large_pictures,
        };
        let mut standing = lane.standing();
        let number = standing.last().map_or(0, |last| last + 1);
        standing.insert(number);
        drop(standing);
        Place { lane: lane.clone(), number }
    }
}

#[derive(Clone, Debug)]
struct Lane {
    turn: Arc<Semaphore>,
    standing: Arc<Mutex<BTreeSet<u64>>>,
}

impl Default for Lane {
    fn default() -> Self {
        Self { turn: Arc::new(Semaphore::new(1)), standing: Arc::default() }
    }
}

impl Lane {
    fn standing(&self) -> MutexGuard<'_, BTreeSet<u64>> {
        self.standing.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A place in a lane, given up when it is dropped.
#[derive(Debug)]
pub(super) struct Place {
    lane: Lane,
    number: u64,
}

impl Place {
    /// How many come before.
    pub(super) fn ahead(&self) -> usize {
        self.lane.standing().range(..self.number).count()
    }

    /// Waits until nobody does. What is given is held while the file is made.
    pub(super) async fn turn(&self) -> Result<OwnedSemaphorePermit, Panicked> {
        Arc::clone(&self.lane.turn).acquire_owned().await.map_err(|_| Panicked)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.lane.standing().remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn ex3_files_wait_for_files_and_pictures_for_pictures() {
        let turns = Turns::default();
        let [first, second, third] = [0; 3].map(|_| turns.come(0));
        let [still, moving] = [QUICK, QUICK + 1].map(|pixels| turns.come(pixels));
        let held = first.turn().await.unwrap();
        let drawn = moving.turn().await.unwrap();
        drop(still.turn().await.unwrap());
        drop(drawn);
        assert_eq!([&first, &second, &third].map(Place::ahead), [0, 1, 2]);
        // Whoever goes away is waited for no longer.
        drop(second);
        assert_eq!(third.ahead(), 1);
        let waits = third.turn();
        tokio::pin!(waits);
        assert!(futures_util::poll!(&mut waits).is_pending(), "one at a time");
        drop((held, first));
        drop(waits.await.unwrap());
        assert_eq!(third.ahead(), 0);
    }
}
