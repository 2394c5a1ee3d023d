//! A part of the memory that is taken, until it is dropped.

use std::sync::{Arc, Mutex, PoisonError};

use espalier_session::Urgency;

use super::{Full, Memory, Need, Use, weights};

/// So many bytes that are taken for something.
#[derive(Debug)]
pub struct Claim {
    memory: Memory,
    what: Use,
    bytes: u64,
}

impl Claim {
    pub(super) fn new(memory: Memory, what: Use, bytes: u64) -> Self {
        Self { memory, what, bytes }
    }

    /// How many.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Takes more, to this many, or says that there are not so many left; gives back what is beyond.
    pub fn become_of(&mut self, need: Need, bytes: u64) -> Result<(), Full> {
        if let Some(more) = bytes.checked_sub(self.bytes).filter(|&more| more > 0) {
            let taken = self.memory.sums().take(self.what, need, more);
            if let Err(full) = taken {
                self.memory.0.short.notify_waiters();
                return Err(full);
            }
        } else {
            self.give_back(self.bytes - bytes);
        }
        self.bytes = bytes;
        Ok(())
    }

    /// As many as are in use, whether or not there are so many left.
    pub fn own_up(&mut self, bytes: u64) {
        if bytes > self.bytes {
            self.memory.sums().own_up(self.what, bytes - self.bytes);
        } else {
            self.give_back(self.bytes - bytes);
        }
        self.bytes = bytes;
    }

    fn give_back(&self, bytes: u64) {
        if bytes > 0 {
            self.memory.sums().give_back(self.what, bytes);
            self.memory.0.freed.notify_waiters();
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        self.give_back(self.bytes);
    }
}

/// What is taken for a session, which grows; its work asks on any thread.
#[derive(Clone, Debug)]
pub struct Growing(Arc<Mutex<Room>>);

#[derive(Debug)]
struct Room {
    claim: Claim,
    /// Rows that there is room for.
    rows: u64,
}

impl Growing {
    /// Room for what is restored, which is not known yet.
    pub fn new(claim: Claim) -> Self {
        Self(Arc::new(Mutex::new(Room { claim, rows: 0 })))
    }

    /// Whether the document may come to hold so many rows.
    pub fn has_room(&self, rows: u64, urgency: Urgency) -> bool {
        let mut room = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if rows <= room.rows {
            return true;
        }
        let need = if urgency == Urgency::Drawing { Need::Drawing } else { Need::Other };
        // Where there is no room for more at once there may be for what is needed.
        for wanted in [rows + rows / 8 + weights::STRIDE, rows] {
            // A document that was restored may take less than was taken for it.
            let bytes = weights::session(wanted).max(room.claim.bytes());
            if room.claim.become_of(need, bytes).is_ok() {
                room.rows = wanted;
                return true;
            }
        }
        false
    }

    /// The document holds so many rows now: what was taken far beyond is given back.
    pub fn settle(&self, rows: u64) {
        let mut room = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let needed = weights::session(rows);
        if room.claim.bytes() < needed {
            room.claim.own_up(needed);
            room.rows = rows;
        } else if room.claim.bytes() > weights::session(rows + rows / 4 + 2 * weights::STRIDE) {
            let kept = rows + rows / 8 + weights::STRIDE;
            room.claim.own_up(weights::session(kept));
            room.rows = kept;
        }
    }

    /// Bytes that are taken.
    pub fn bytes(&self) -> u64 {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).claim.bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lm19_a_session_takes_room_before_it_grows_and_gives_back_what_it_does_not_need() {
        let memory = Memory::of(weights::session(200_000));
        let claim = memory.take(Use::Session, Need::Other, weights::session(0)).unwrap();
        let room = Growing::new(claim);
        assert!(room.has_room(50_000, Urgency::Growing));
        assert!(room.bytes() >= weights::session(50_000));
        let before = room.bytes();
        assert!(room.has_room(50_001, Urgency::Growing), "more was taken at once");
        assert_eq!(room.bytes(), before);
        assert!(!room.has_room(180_000, Urgency::Growing));
        assert_eq!(room.bytes(), before, "what is not given leaves what there was");
        assert!(room.has_room(180_000, Urgency::Drawing), "a part is kept for those who draw");
        room.settle(1000);
        assert!(room.bytes() < weights::session(10_000), "{}", room.bytes());
        drop(room);
        assert_eq!(memory.look().taken(), 0);
    }
}
