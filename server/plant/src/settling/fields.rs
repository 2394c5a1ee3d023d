//! Which width constraints and given radii hold: of each metamer what the last edit in force says.

use std::collections::{BTreeMap, BTreeSet};

use super::{Claim, claim, edits};
use crate::{
    edits::Edit,
    given_radius::{Given, GivenRadii},
    id::MetamerId,
    plant::Plant,
};

/// Values that edits have changed, taken back from the last one on as far as they do not count.
struct Fold<T> {
    /// What holds, where it may be something else than now.
    values: BTreeMap<MetamerId, T>,
    /// Whose value an edit in force has set.
    kept: BTreeSet<MetamerId>,
}

impl<T> Fold<T> {
    fn take_back(&mut self, in_force: bool, id: MetamerId, before: T) {
        if in_force {
            self.kept.insert(id);
        } else if !self.kept.contains(&id) {
            self.values.insert(id, before);
        }
    }
}

/// The width constraints and given radii that change.
pub(super) fn resettled(plant: &Plant, claims: &[Claim]) -> (Vec<(MetamerId, Option<f32>)>, Given) {
    let mut widths = Fold { values: BTreeMap::new(), kept: BTreeSet::new() };
    let mut radii = Fold { values: BTreeMap::new(), kept: BTreeSet::new() };
    for (step, edit) in edits(plant).rev() {
        let in_force = claim(claims, step).in_force;
        let given_by = |given: &Given| {
            given.metamers.iter().copied().zip(given.radii.0.iter().copied()).collect::<Vec<_>>()
        };
        match edit {
            Edit::Width(id, before) => widths.take_back(in_force, *id, *before),
            Edit::Given(given) => {
                given_by(given).into_iter().for_each(|(id, before)| radii.take_back(in_force, id, before));
            }
            // What was settled before is settled anew.
            Edit::Resettled(edit) => {
                edit.widths.iter().for_each(|&(id, before)| widths.take_back(false, id, before));
                given_by(&edit.given).into_iter().for_each(|(id, before)| radii.take_back(false, id, before));
            }
            _ => {}
        }
    }
    let changes = |&(id, value): &(MetamerId, Option<f32>)| plant.widths.get(&id).copied() != value;
    let widths = widths.values.into_iter().filter(changes).collect();
    let mut given = Given::default();
    let radius = |id: MetamerId| plant.given_radius(id).unwrap_or(GivenRadii::NONE);
    for (id, value) in radii.values {
        if value.to_bits() != radius(id).to_bits() {
            given.metamers.push(id);
            given.radii.0.push(value);
        }
    }
    (widths, given)
}
