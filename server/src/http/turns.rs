//! Whose turn it is to have a file made: one file of structure, one picture and one large or moving picture at a time.
//! People take turns, and what one asked for is made in its order. A moving picture may take minutes, and nothing else
//! waits for it.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use crate::queue::Queue;

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
    /// Somebody comes who wants such a picture, of so many pixels, or any other file, which has none.
    pub(super) fn come(&self, person: String, pixels: u64) -> Place {
        let lane = match pixels {
            0 => &self.files,
            1..=QUICK => &self.pictures,
            _ => &self.large_pictures,
        };
        let mut standing = lane.standing();
        standing.last += 1;
        let name = standing.last.to_string();
        standing.waiting.add(person, name.clone());
        drop(standing);
        Place { lane: lane.clone(), name }
    }
}

#[derive(Clone, Debug, Default)]
struct Lane(Arc<Inner>);

#[derive(Debug, Default)]
struct Inner {
    standing: Mutex<Standing>,
    /// Whoever waits looks again.
    changed: Notify,
}

#[derive(Debug, Default)]
struct Standing {
    waiting: Queue,
    /// Whether a file is being made.
    is_taken: bool,
    /// What was called so came last.
    last: u64,
}

impl Lane {
    fn standing(&self) -> MutexGuard<'_, Standing> {
        self.0.standing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self, change: impl FnOnce(&mut Standing)) {
        change(&mut self.standing());
        self.0.changed.notify_waiters();
    }
}

impl Standing {
    /// How many come before this one that waits.
    fn ahead(&self, name: &str) -> Option<usize> {
        let place = self.waiting.in_order(|_| 1).into_iter().position(|other| other == name)?;
        Some(place + usize::from(self.is_taken))
    }
}

/// A place in a lane, given up when it is dropped.
#[derive(Debug)]
pub(super) struct Place {
    lane: Lane,
    name: String,
}

impl Place {
    /// How many come before.
    pub(super) fn ahead(&self) -> usize {
        self.lane.standing().ahead(&self.name).unwrap_or(0)
    }

    /// Waits until nobody does. What is given is held while the file is made.
    pub(super) async fn turn(&self) -> Turn {
        loop {
            let changed = self.lane.0.changed.notified();
            if let Some(turn) = self.try_turn() {
                return turn;
            }
            changed.await;
        }
    }

    fn try_turn(&self) -> Option<Turn> {
        let mut standing = self.lane.standing();
        if standing.is_taken || !standing.waiting.is_next(&self.name) {
            return None;
        }
        // That it has its turn is remembered of its person.
        standing.waiting.next();
        standing.waiting.remove(&self.name);
        standing.is_taken = true;
        Some(Turn(self.lane.clone()))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.lane.change(|standing| standing.waiting.remove(&self.name));
    }
}

/// The turn of somebody, over when it is dropped.
#[derive(Debug)]
pub(super) struct Turn(Lane);

impl Drop for Turn {
    fn drop(&mut self) {
        self.0.change(|standing| standing.is_taken = false);
    }
}

#[cfg(test)]
mod tests {
    use futures_util::poll;
    use tokio::pin;

    use super::*;

    #[tokio::test]
    async fn ex3_files_wait_for_files_and_pictures_for_pictures() {
        let turns = Turns::default();
        let [first, second, third] = [0; 3].map(|_| turns.come("ann".into(), 0));
        let [still, moving] = [QUICK, QUICK + 1].map(|pixels| turns.come("ann".into(), pixels));
        let held = first.turn().await;
        let drawn = moving.turn().await;
        drop(still.turn().await);
        drop(drawn);
        assert_eq!([&first, &second, &third].map(Place::ahead), [0, 1, 2]);
        // Whoever goes away is waited for no longer.
        drop(second);
        assert_eq!(third.ahead(), 1);
        let waits = third.turn();
        pin!(waits);
        assert!(poll!(&mut waits).is_pending(), "one at a time");
        drop((held, first));
        drop(waits.await);
        assert_eq!(third.ahead(), 0);
    }

    #[tokio::test]
    async fn ex3_people_take_turns() {
        let turns = Turns::default();
        let [first, second, third] = [0; 3].map(|_| turns.come("ann".into(), 0));
        let held = first.turn().await;
        let other = turns.come("ben".into(), 0);
        assert_eq!(
            [&second, &third, &other].map(Place::ahead),
            [2, 3, 1],
            "nobody waits for all of another's"
        );
        let (waits, waits_longer) = (other.turn(), second.turn());
        pin!(waits, waits_longer);
        assert!(poll!(&mut waits_longer).is_pending() && poll!(&mut waits).is_pending());
        drop((held, first));
        assert!(poll!(&mut waits_longer).is_pending());
        drop(waits.await);
        drop(waits_longer.await);
        assert_eq!(third.ahead(), 0);
    }
}
