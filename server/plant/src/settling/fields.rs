//! Which width constraints, given radii and given organs hold: of each metamer what the last edit in force says.

use std::collections::{BTreeMap, BTreeSet};

use super::{Claim, claim, edits};
use crate::{
    edits::Edit,
    given::{Given, GivenColumn, GivenValue},
    id::MetamerId,
    organs::Organs,
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

/// The width constraints, given radii and given organs that change.
#[derive(Default)]
pub(super) struct Fields {
    pub widths: Vec<(MetamerId, Option<f32>)>,
    pub radii: Given,
    pub organs: Given<Option<Organs>>,
}

impl<T: GivenValue> Fold<T> {
    fn take_back_given(&mut self, in_force: bool, given: &Given<T>) {
        for (id, before) in given.metamers.iter().zip(&given.values.0) {
            self.take_back(in_force, *id, before.clone());
        }
    }

    /// What is given otherwise than it was last.
    fn given(self, now: &GivenColumn<T>) -> Given<T> {
        let is_other = |id: MetamerId, value: &T| !now.of(id.index()).unwrap_or(&T::NONE).is_same(value);
        let changed = self.values.into_iter().filter(|(id, value)| is_other(*id, value));
        let (metamers, values) = changed.unzip();
        Given { metamers, values: GivenColumn(values) }
    }
}

/// What changes of them.
pub(super) fn resettled(plant: &Plant, claims: &[Claim]) -> Fields {
    let mut widths = Fold { values: BTreeMap::new(), kept: BTreeSet::new() };
    let mut radii = Fold { values: BTreeMap::new(), kept: BTreeSet::new() };
    let mut organs = Fold { values: BTreeMap::new(), kept: BTreeSet::new() };
    for (step, edit) in edits(plant).rev() {
        let in_force = claim(claims, step).in_force;
        match edit {
            Edit::Width(id, before) => widths.take_back(in_force, *id, *before),
            Edit::Given(given) => radii.take_back_given(in_force, given),
            Edit::Borne(given) => organs.take_back_given(in_force, given),
            // What was settled before is settled anew.
            Edit::Resettled(edit) => {
                edit.widths.iter().for_each(|&(id, before)| widths.take_back(false, id, before));
                radii.take_back_given(false, &edit.given);
                organs.take_back_given(false, &edit.organs);
            }
            _ => {}
        }
    }
    let changes = |&(id, value): &(MetamerId, Option<f32>)| plant.widths.get(&id).copied() != value;
    Fields {
        widths: widths.values.into_iter().filter(changes).collect(),
        radii: radii.given(&plant.metamers.given_radius),
        organs: organs.given(&plant.metamers.given_organs),
    }
}
