//! What an edit changes of a graph, in either direction.

use std::collections::{BTreeMap, btree_map::Entry};

use crate::{
    graph::{Graph, Owner, Record, Share, ShareId},
    node::NodeId,
    slots::Slot,
};

/// Parts of a graph to put in place of its own; none takes a part away. Putting a patch in place gives the one that
/// undoes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Patch {
    pub(crate) seed: Option<u32>,
    pub(crate) records: BTreeMap<Owner, Option<Record>>,
    pub(crate) shares: BTreeMap<ShareId, Option<Share>>,
    pub(crate) slots: BTreeMap<NodeId, Option<Vec<Slot>>>,
}

impl Patch {
    /// Whether it changes nothing.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Owners of which something else is said.
    pub fn owners(&self) -> impl Iterator<Item = Owner> {
        self.records.keys().copied()
    }

    /// Notes the slots of a branch before they change.
    pub(crate) fn note_slots(&mut self, graph: &Graph, node: NodeId) {
        self.slots.entry(node).or_insert_with(|| graph.slots.get(&node).cloned());
    }

    /// Takes in what undoes a later change; what is known of a part already is older, and stays.
    pub(crate) fn after(&mut self, later: Self) {
        self.seed = self.seed.or(later.seed);
        keep_older(&mut self.records, later.records);
        keep_older(&mut self.shares, later.shares);
        keep_older(&mut self.slots, later.slots);
    }

    /// Forgets parts that a graph has already.
    pub(crate) fn without_what_is(&mut self, graph: &Graph) {
        self.seed = self.seed.filter(|&seed| seed != graph.seed);
        self.records.retain(|owner, record| graph.records.get(owner) != record.as_ref());
        self.shares.retain(|id, share| graph.shares.get(id) != share.as_ref());
        self.slots.retain(|id, slots| graph.slots.get(id) != slots.as_ref());
    }
}

fn keep_older<K: Ord, V>(older: &mut BTreeMap<K, V>, later: BTreeMap<K, V>) {
    for (key, value) in later {
        if let Entry::Vacant(vacant) = older.entry(key) {
            vacant.insert(value);
        }
    }
}

impl Graph {
    /// Puts a patch in place; returns what undoes it.
    pub(crate) fn swap(&mut self, patch: Patch) -> Patch {
        Patch {
            seed: patch.seed.map(|seed| std::mem::replace(&mut self.seed, seed)),
            records: swap(&mut self.records, patch.records),
            shares: swap(&mut self.shares, patch.shares),
            slots: swap(&mut self.slots, patch.slots),
        }
    }
}

fn swap<K: Ord + Copy, V>(
    parts: &mut BTreeMap<K, V>,
    patch: BTreeMap<K, Option<V>>,
) -> BTreeMap<K, Option<V>> {
    let put = |(key, value): (K, Option<V>)| match value {
        Some(value) => (key, parts.insert(key, value)),
        None => (key, parts.remove(&key)),
    };
    patch.into_iter().map(put).collect()
}
