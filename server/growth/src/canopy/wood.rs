//! Which metamer stands in each slot of the canopy, and where its parent stands.

use espalier_plant::{MetamerId, Plant, reserve};

use super::NOWHERE;

/// The metamers of all slots. As long as each stands in the slot of its own number, the plant says all there is to
/// say, and none is written down.
#[derive(Clone, Debug, Default)]
pub(super) struct Wood {
    /// Empty, or one for each slot.
    written: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
struct Place {
    id: MetamerId,
    /// Slot of the parent.
    parent: u32,
}

impl Wood {
    /// What a plant makes of the slots.
    #[inline(always)]
    pub(super) fn of<'a>(&'a self, plant: &'a Plant) -> Slotted<'a> {
        Slotted { plant, written: &self.written }
    }

    /// Reserves capacity for more.
    pub(super) fn reserve(&mut self, more: usize) {
        if !self.written.is_empty() {
            reserve(&mut self.written, more);
        }
    }

    /// Puts a metamer into the next slot.
    pub(super) fn push(&mut self, slot: usize, id: MetamerId, parent: u32, plant: &Plant) {
        if self.written.is_empty() && id.index() != slot {
            self.write_down(slot, plant);
        }
        if !self.written.is_empty() || slot == 0 && id.index() != 0 {
            self.written.push(Place { id, parent });
        }
    }

    /// Writes the metamers of the first so many slots down, if that was not done yet.
    pub(super) fn write_down(&mut self, count: usize, plant: &Plant) {
        if self.written.is_empty() {
            let slots = self.of(plant);
            let places = (0..count).map(|slot| Place { id: slots.id(slot), parent: slots.parent(slot) });
            self.written = places.collect();
        }
    }

    /// Puts a metamer into another slot; all must have been written down.
    pub(super) fn set(&mut self, slot: usize, id: MetamerId, parent: u32) {
        self.written[slot] = Place { id, parent };
    }

    /// Forgets all slots but the first so many.
    pub(super) fn truncate(&mut self, count: usize) {
        self.written.truncate(count);
    }
}

/// The slots of a canopy, with the plant to look them up in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slotted<'a> {
    plant: &'a Plant,
    written: &'a [Place],
}

impl Slotted<'_> {
    /// The metamer in a slot.
    #[inline(always)]
    pub(super) fn id(self, slot: usize) -> MetamerId {
        if self.written.is_empty() { MetamerId::new(slot) } else { self.written[slot].id }
    }

    /// The slot of its parent, [`NOWHERE`] for a seed.
    #[inline(always)]
    pub(super) fn parent(self, slot: usize) -> u32 {
        if self.written.is_empty() {
            let parent = self.plant.metamers().parent(MetamerId::new(slot));
            parent.map_or(NOWHERE, MetamerId::raw)
        } else {
            self.written[slot].parent
        }
    }

    /// The first of so many slots whose metamer does not belong to those of which `belongs` holds: all older ones do.
    pub(super) fn partition(self, count: usize, belongs: impl Fn(MetamerId) -> bool) -> usize {
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = low.midpoint(high);
            if belongs(self.id(middle)) { low = middle + 1 } else { high = middle }
        }
        low
    }
}
