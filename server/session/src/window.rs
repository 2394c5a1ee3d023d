//! What is on the way to one client: frames in flight (`FL1`) and control messages unread (`FL3`).

use std::collections::VecDeque;

/// The most bytes of frames on the way to a client, unless a single frame is larger (`FL1`).
pub(crate) const WINDOW_BYTES: usize = 256 * 1024;
/// A client with this many unread control messages is closed (`FL3`).
pub(crate) const MAX_UNREAD: usize = 1024;
/// One with this many is sent no figures until it has read some, and then the newest (`FL4`).
pub(crate) const MAX_UNREAD_STATES: usize = 32;
/// A client with so many of them is sent no designs: each may have a hundred thousand bytes.
pub(crate) const MAX_UNREAD_DESIGNS: usize = 4;

/// So many bytes are enough to tell how fast a client takes in what is sent to it.
const TELLING: usize = 16 * 1024;
/// Bytes that a client takes in a millisecond, as long as nothing is known of it; no client is held to be slower.
const SLOWEST: usize = 16;

/// A frame on its way.
#[derive(Debug)]
struct Sent {
    sequence: u32,
    length: usize,
    at: u64,
}

/// Frames sent and not yet answered with `received`.
#[derive(Debug)]
pub(crate) struct Window {
    frames: VecDeque<Sent>,
    bytes: usize,
    /// Bytes that the client took in a millisecond when it last took many.
    pace: usize,
    /// When it last took some.
    taken_at: u64,
}

impl Default for Window {
    fn default() -> Self {
        Self { frames: VecDeque::new(), bytes: 0, pace: SLOWEST, taken_at: 0 }
    }
}

/// A client claims to have received what was never sent.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct NeverSent;

impl Window {
    /// Whether a frame of this length may be sent now.
    pub(crate) fn admits(&self, length: usize) -> bool {
        self.frames.is_empty() || self.bytes + length <= WINDOW_BYTES
    }

    /// Bytes on the way.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Whether nothing is on the way.
    pub(crate) fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// How long the client needs for what is on the way to it, in milliseconds, if it is as fast as it was.
    pub(crate) fn takes(&self) -> u64 {
        (self.bytes / self.pace) as u64
    }

    /// Notes a frame as sent now.
    pub(crate) fn send(&mut self, sequence: u32, length: usize, now: u64) {
        self.frames.push_back(Sent { sequence, length, at: now });
        self.bytes += length;
    }

    /// Everything up to `sequence` has arrived. An answer given before is no fault: answers may be cumulative.
    pub(crate) fn receive(&mut self, sequence: u32, newest: u32, now: u64) -> Result<(), NeverSent> {
        if sequence > newest {
            return Err(NeverSent);
        }
        let begun = self.frames.front().map_or(now, |first| first.at.max(self.taken_at));
        let before = self.bytes;
        while let Some(Sent { length, .. }) = self.frames.pop_front_if(|first| first.sequence <= sequence) {
            self.bytes -= length;
        }
        let taken = before - self.bytes;
        if taken > 0 {
            self.taken_at = now;
        }
        let pace = taken / usize::try_from(now.saturating_sub(begun)).map_or(usize::MAX, |took| took.max(1));
        // Of few bytes most of the time is the way there and back, and who is faster than was thought shows it by few.
        if taken >= TELLING || pace > self.pace {
            self.pace = pace.max(SLOWEST);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ps3_the_pace_is_that_of_the_last_many_bytes() {
        let mut window = Window::default();
        window.send(1, 160_000, 0);
        assert_eq!(window.takes(), 10_000, "nothing is known of it yet");
        window.receive(1, 1, 100).unwrap();
        window.send(2, 160_000, 100);
        assert_eq!(window.takes(), 100);
        // Few bytes tell nothing against it, many do.
        window.receive(2, 2, 200).unwrap();
        window.send(3, 500, 1_000);
        window.receive(3, 3, 2_000).unwrap();
        window.send(4, 160_000, 2_000);
        assert_eq!(window.takes(), 100);
        window.receive(4, 4, 7_000).unwrap();
        window.send(5, 160_000, 7_000);
        assert_eq!(window.takes(), 5_000);
        // An answer to nothing is no measure, and no clock makes it infinite.
        window.receive(4, 5, 7_000).unwrap();
        assert_eq!(window.takes(), 5_000);
        window.receive(5, 5, 7_000).unwrap();
        assert_eq!((window.takes(), window.bytes()), (0, 0));
        assert_eq!(window.receive(6, 5, 7_000), Err(NeverSent));
    }
}
