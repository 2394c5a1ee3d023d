//! What several people said of one design, where one of them takes something back.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    design::Design,
    edit::{Standing, standing},
    graph::{Graph, Owner, Record, Source},
    refusal::Refusal,
    resolution::Branch,
};

impl Graph {
    /// This graph with what another one changed of that before it, value by value.
    #[must_use]
    pub fn with_changes(&self, before: &Self, after: &Self) -> Self {
        let mut merged = self.clone();
        if before.seed != after.seed {
            merged.seed = after.seed;
        }
        let owners: BTreeSet<Owner> = before.records.keys().chain(after.records.keys()).copied().collect();
        for owner in owners {
            let (was, is) = (before.records.get(&owner), after.records.get(&owner));
            if was == is {
                continue;
            }
            let record = merged.records.entry(owner).or_default();
            merge_record(record, was.unwrap_or(&Record::default()), is.unwrap_or(&Record::default()));
            if record.is_empty() {
                merged.records.remove(&owner);
            }
        }
        merge(&mut merged.shares, &before.shares, &after.shares);
        merge(&mut merged.slots, &before.slots, &after.slots);
        merged
    }

    /// Takes off what is said of branches that are not known, and of shared values that are gone.
    fn without_lost(&mut self, root: &Branch) {
        let lost = |owner: &Owner| matches!(owner, Owner::Node(node) if standing(self, root, *node) == Standing::Unknown);
        let lost: Vec<Owner> = self.records.keys().copied().filter(lost).collect();
        for owner in lost {
            self.records.remove(&owner);
        }
        let shares = &self.shares;
        for record in self.records.values_mut() {
            record.settings.retain(|_, setting| match setting.source {
                Source::Shared(share) => shares.contains_key(&share),
                _ => true,
            });
        }
        self.records.retain(|_, record| !record.is_empty());
        let members: BTreeSet<_> = self
            .records
            .values()
            .flat_map(|record| record.settings.values())
            .filter_map(|setting| if let Source::Shared(share) = setting.source { Some(share) } else { None })
            .collect();
        self.shares.retain(|share, _| members.contains(share));
        let bearers: Vec<_> = self.slots.keys().copied().collect();
        for bearer in bearers {
            let is_lost = standing(self, root, bearer) == Standing::Unknown;
            let is_needed = self
                .slots
                .get(&bearer)
                .into_iter()
                .flatten()
                .any(|slot| bearer.child(slot.ordinal).is_some_and(|child| self.is_personal(child)));
            if is_lost || !is_needed {
                self.slots.remove(&bearer);
            }
        }
    }
}

fn merge_record(record: &mut Record, was: &Record, is: &Record) {
    if was.name != is.name {
        record.name.clone_from(&is.name);
    }
    merge(&mut record.settings, &was.settings, &is.settings);
}

fn merge<K: Ord + Copy, V: Clone + PartialEq>(
    merged: &mut BTreeMap<K, V>,
    before: &BTreeMap<K, V>,
    after: &BTreeMap<K, V>,
) {
    for key in before.keys().chain(after.keys()) {
        match (before.get(key), after.get(key)) {
            (was, is) if was == is => {}
            (_, Some(is)) => drop(merged.insert(*key, is.clone())),
            (_, None) => drop(merged.remove(key)),
        }
    }
}

impl Design {
    /// The design of a graph that was merged: what it says of branches that nobody bears any more is dropped.
    ///
    /// # Errors
    /// Where the plant would have too many branches.
    pub fn of_merged(graph: Graph) -> Result<Self, Refusal> {
        let mut design = Self::of(graph)?;
        let (graph, root) = design.parts();
        graph.without_lost(root);
        Self::of(std::mem::take(graph))
    }
}
