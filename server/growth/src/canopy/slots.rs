//! Where each metamer of a plant stands in the canopy.

use espalier_plant::{MetamerId, reserve};

use super::NOWHERE;

/// A slot for each metamer. As long as none has been left out, that is the metamer's own number, and none is written
/// down.
#[derive(Clone, Debug, Default)]
pub(super) struct Slots {
    count: usize,
    /// Empty, or one for each.
    written: Vec<u32>,
}

impl Slots {
    /// How many metamers are known.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// The slot of a metamer, [`NOWHERE`] if it has none.
    #[inline(always)]
    pub(super) fn of(&self, id: MetamerId) -> u32 {
        let own = if id.index() < self.count { id.raw() } else { NOWHERE };
        if self.written.is_empty() { own } else { self.written.get(id.index()).copied().unwrap_or(NOWHERE) }
    }

    /// Reserves capacity for more.
    pub(super) fn reserve(&mut self, more: usize) {
        if !self.written.is_empty() {
            reserve(&mut self.written, more);
        }
    }

    /// Takes in the next metamer.
    pub(super) fn push(&mut self, slot: u32) {
        if !self.written.is_empty() || slot as usize != self.count {
            self.write_down();
            self.written.push(slot);
        }
        self.count += 1;
    }

    /// Gives a metamer another slot.
    pub(super) fn set(&mut self, id: MetamerId, slot: u32) {
        if self.of(id) != slot {
            self.write_down();
            self.written[id.index()] = slot;
        }
    }

    /// Forgets all metamers but the first so many.
    pub(super) fn truncate(&mut self, count: usize) {
        self.written.truncate(count);
        self.count = self.count.min(count);
    }

    fn write_down(&mut self) {
        if self.written.is_empty() {
            self.written = (0..self.count as u32).collect();
        }
    }
}
