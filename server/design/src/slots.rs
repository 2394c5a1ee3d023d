//! Who a lateral is when the number of laterals changes.
//!
//! A lateral is a slot of its bearer, with a home on the axis where it first stood. When the number of places changes,
//! slots take the places nearest to their homes in one order. A personal slot, one of which something was said, sleeps
//! only if there is no room, and wakes when there is again.

use std::collections::BTreeSet;

use crate::node::MAX_ORDINAL;

/// One lateral of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// Its number among the laterals of the branch, which it keeps.
    pub ordinal: u16,
    /// Where it first stood, as a share of the branch's laterals.
    pub home: f32,
    /// Its angle around the axis in degrees, where it no longer follows from its place.
    pub azimuth: Option<f32>,
    /// Where along the axis it stands by hand.
    pub anchor: Option<f32>,
    /// Which place it stands at, in order along the axis; none while it sleeps.
    pub place: Option<u16>,
}

/// What it costs to let a personal slot sleep: more than all moves of an axis together.
const PERSONAL: f64 = 1000.0;
/// What it costs to drop an impersonal slot, in units of what a new one costs.
const IMPERSONAL: f64 = 0.02;

/// Slots for these places, which are shares of the branch's laterals in order. Personal slots keep their number and their
/// home; impersonal ones for which there is no room are gone; new ones take the least free numbers.
pub(crate) fn laid_out(slots: &[Slot], is_personal: impl Fn(&Slot) -> bool, places: &[f32]) -> Vec<Slot> {
    let mut slots: Vec<Slot> = slots.to_vec();
    slots.sort_by(|a, b| a.home.total_cmp(&b.home).then(a.ordinal.cmp(&b.ordinal)));
    let taken = matched(&slots, &is_personal, places);
    let mut laid: Vec<Slot> = slots
        .iter()
        .zip(&taken)
        .map(|(slot, &place)| Slot { place, ..*slot })
        .filter(|slot| slot.place.is_some() || is_personal(slot))
        .collect();
    let used: BTreeSet<u16> = laid.iter().map(|slot| slot.ordinal).collect();
    let stood: BTreeSet<u16> = taken.into_iter().flatten().collect();
    let mut free = (0..=MAX_ORDINAL).filter(|ordinal| !used.contains(ordinal));
    for (place, &home) in (0..).zip(places).filter(|(place, _)| !stood.contains(place)) {
        // There are fewer places and records than numbers.
        let Some(ordinal) = free.next() else { break };
        laid.push(Slot { ordinal, home, azimuth: None, anchor: None, place: Some(place) });
    }
    laid.sort_by_key(|slot| slot.ordinal);
    laid
}

/// The place of each slot, both in order, at the least cost of all.
fn matched(slots: &[Slot], is_personal: &impl Fn(&Slot) -> bool, places: &[f32]) -> Vec<Option<u16>> {
    if slots.is_empty() || places.is_empty() {
        return vec![None; slots.len()];
    }
    let new = 0.5 * (1.0 / slots.len() as f64 + 1.0 / places.len() as f64);
    let asleep: Vec<f64> =
        slots.iter().map(|slot| if is_personal(slot) { PERSONAL } else { IMPERSONAL * new }).collect();
    let width = places.len() + 1;
    let cost_of = |slot: usize, place: usize| f64::from((slots[slot].home - places[place]).abs());
    let mut costs = vec![0.0f64; (slots.len() + 1) * width];
    for place in 1..width {
        costs[place] = costs[place - 1] + new;
    }
    for slot in 1..=slots.len() {
        costs[slot * width] = costs[(slot - 1) * width] + asleep[slot - 1];
        for place in 1..width {
            let stands = costs[(slot - 1) * width + place - 1] + cost_of(slot - 1, place - 1);
            let sleeps = costs[(slot - 1) * width + place] + asleep[slot - 1];
            let is_new = costs[slot * width + place - 1] + new;
            costs[slot * width + place] = stands.min(sleeps).min(is_new);
        }
    }
    let mut taken = vec![None; slots.len()];
    let (mut slot, mut place) = (slots.len(), width - 1);
    while slot > 0 {
        let here = costs[slot * width + place];
        if place > 0 && here == costs[(slot - 1) * width + place - 1] + cost_of(slot - 1, place - 1) {
            (slot, place) = (slot - 1, place - 1);
            taken[slot] = Some(place as u16);
        } else if here == costs[(slot - 1) * width + place] + asleep[slot - 1] {
            slot -= 1;
        } else {
            place -= 1;
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn places(count: usize) -> Vec<f32> {
        (1..=count).map(|place| place as f32 / (count + 1) as f32).collect()
    }

    fn first(count: usize) -> Vec<Slot> {
        laid_out(&[], |_| false, &places(count))
    }

    fn standing(slots: &[Slot]) -> Vec<u16> {
        let mut standing: Vec<_> = slots.iter().filter(|slot| slot.place.is_some()).collect();
        standing.sort_by_key(|slot| slot.place);
        standing.iter().map(|slot| slot.ordinal).collect()
    }

    #[test]
    fn from_three_to_four_and_back_everybody_is_who_they_were() {
        let is_personal = |slot: &Slot| slot.ordinal == 0;
        let three = first(3);
        let four = laid_out(&three, is_personal, &places(4));
        assert_eq!(standing(&four), [0, 1, 3, 2]);
        let again = laid_out(&four, is_personal, &places(3));
        assert_eq!((standing(&again), &again), (vec![0, 1, 2], &three));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2_000))]

        #[test]
        fn a_personal_slot_sleeps_only_where_there_is_no_room(
            count in 1usize..20,
            marks in prop::collection::vec(any::<u16>(), 0..6),
            changes in prop::collection::vec(0usize..24, 1..=20),
        ) {
            let mut slots = first(count);
            let personal: BTreeSet<u16> = marks.iter().map(|mark| mark % count as u16).collect();
            for count in changes {
                slots = laid_out(&slots, |slot| personal.contains(&slot.ordinal), &places(count));
                let awake = standing(&slots);
                prop_assert_eq!(awake.len(), count);
                let there = personal.iter().filter(|ordinal| awake.contains(ordinal)).count();
                prop_assert_eq!(there, personal.len().min(count));
                prop_assert!(personal.iter().all(|ordinal| slots.iter().any(|slot| slot.ordinal == *ordinal)));
                prop_assert!(slots.len() <= count + personal.len());
                let places: Vec<_> = slots.iter().filter_map(|slot| slot.place).collect();
                prop_assert_eq!(places.iter().collect::<BTreeSet<_>>().len(), count);
                // The order along the axis is that of homes.
                let homes: Vec<_> = awake.iter().filter_map(|ordinal| slots.iter().find(|slot| slot.ordinal == *ordinal)).map(|slot| slot.home).collect();
                prop_assert!(homes.is_sorted());
            }
        }
    }
}
