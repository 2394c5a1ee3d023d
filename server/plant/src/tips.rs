//! Tips told afresh, where wood falls and rises in many places at once.

use crate::{edits::Edit, id::MetamerId, plant::Plant};

/// For each of so many metamers whether it was cut off from the wood below, so that its tips do not count there.
pub(crate) fn severed(edits: &[Edit], count: usize) -> Vec<bool> {
    let mut severed = vec![false; count];
    for edit in edits {
        match edit {
            Edit::Pruned(cut) => severed[cut.index()] = true,
            Edit::Resettled(resettled) => {
                resettled.severed.iter().for_each(|id| severed[id.index()] ^= true);
            }
            _ => {}
        }
    }
    severed
}

/// Tips of shed twigs that metamers of grafts carry.
pub(crate) fn scars(edits: &[Edit]) -> impl Iterator<Item = (MetamerId, u32)> + '_ {
    edits.iter().filter_map(|edit| if let Edit::Scarred(id, tips) = edit { Some((*id, *tips)) } else { None })
}

impl Plant {
    /// Counts the tips of the first so many metamers anew; `edits` are those that have happened to them.
    ///
    /// A metamer carries the tips of all that grow from it and are not cut off, and one of its own where none of these
    /// continues its axis.
    pub(crate) fn recount_tips(&mut self, edits: &[Edit], count: usize) {
        let severed = severed(edits, count);
        let mut tips = vec![0u32; count];
        let mut goes_on = vec![false; count];
        for (id, shed) in scars(edits) {
            tips[id.index()] = tips[id.index()].wrapping_add(shed);
        }
        for index in (0..count).rev() {
            let id = MetamerId::new(index);
            if !goes_on[index] && !self.is_seed(id) {
                tips[index] = tips[index].wrapping_add(1);
            }
            self.metamers.tips[index] = tips[index];
            if let Some(parent) = self.metamers.parent(id).filter(|_| !severed[index]) {
                tips[parent.index()] = tips[parent.index()].wrapping_add(tips[index]);
                goes_on[parent.index()] |= self.metamers.axis(parent) == self.metamers.axis(id);
            }
        }
    }
}
