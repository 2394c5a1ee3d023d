//! What is on the way to one client: frames in flight (`FL1`) and control messages unread (`FL3`).

use std::collections::VecDeque;

/// The most bytes of frames on the way to a client, unless a single frame is larger (`FL1`).
pub(crate) const WINDOW_BYTES: usize = 256 * 1024;
/// A client with this many unread control messages is closed (`FL3`).
pub(crate) const MAX_UNREAD: usize = 1024;
/// One with this many is sent no figures until it has read some, and then the newest (`FL4`).
pub(crate) const MAX_UNREAD_STATES: usize = 32;

/// Frames sent and not yet answered with `received`.
#[derive(Debug, Default)]
pub(crate) struct Window {
    frames: VecDeque<(u32, usize)>,
    bytes: usize,
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

    /// Notes a frame as sent.
    pub(crate) fn send(&mut self, sequence: u32, length: usize) {
        self.frames.push_back((sequence, length));
        self.bytes += length;
    }

    /// Everything up to `sequence` has arrived. An answer given before is no fault: answers may be cumulative.
    pub(crate) fn receive(&mut self, sequence: u32, newest: u32) -> Result<(), NeverSent> {
        if sequence > newest {
            return Err(NeverSent);
        }
        while let Some(&(first, length)) = self.frames.front() {
            if first > sequence {
                break;
            }
            self.frames.pop_front();
            self.bytes -= length;
        }
        Ok(())
    }
}
