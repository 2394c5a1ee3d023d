//! Places that comments are pinned to, through everything that becomes of the wood.

use espalier_proto::comment::PinState;
use proptest::prelude::*;

use super::{
    deeds::{events, happen},
    *,
};

/// Where a place is that lay at the end of its metamer when it was noted.
fn whereabouts(document: &Document, anchor: &Anchor, place: Vec3) -> Whereabouts {
    found_by(document, anchor, place, Search::Everywhere)
}

fn found_by(document: &Document, anchor: &Anchor, place: Vec3, search: Search) -> Whereabouts {
    document.whereabouts([(anchor, place)], search)[0]
}

fn state(document: &Document, pin: &(Anchor, Vec3)) -> (PinState, Option<u32>) {
    let found = whereabouts(document, &pin.0, pin.1);
    (found.state, found.row)
}

/// Pins a comment to the end of a metamer.
fn pin(document: &Document, row: MetamerId) -> (Anchor, Vec3) {
    let anchor = document.anchor(row.raw()).expect("it lives");
    (anchor, document.plant().metamers().end(row))
}

/// A metamer in the middle of a lateral branch that can be cut, with the first one of that branch.
fn on_a_branch(document: &Document) -> (MetamerId, MetamerId) {
    let plant = document.plant();
    let length = |first: &MetamerId| plant.above(*first).len();
    let first = laterals(document).into_iter().max_by_key(length).expect("there are branches");
    let above = plant.above(first);
    (first, above[above.len() / 2])
}

#[test]
fn ct2_a_pin_stays_on_its_metamer_through_growth_turns_and_widths() {
    let mut document = tree();
    let (first, middle) = on_a_branch(&document);
    let pin = pin(&document, middle);
    let standing = (PinState::Standing, Some(middle.raw()));
    assert_eq!(state(&document, &pin), standing);
    grow(&mut document, 8, None);
    assert_eq!(state(&document, &pin), standing);
    let rotation = UnitRotation::nearest(Quat::from_xyzw(0.0, 0.6, 0.0, 0.8));
    apply(&mut document, &plain(Action::TurnBranch { row: first.raw(), rotation }));
    assert_ne!(document.plant().metamers().end(middle), pin.1, "it has moved");
    assert_eq!(state(&document, &pin), standing);
    let diameter = Some(Diameter::nearest(3.0));
    apply(&mut document, &plain(Action::SetWidth { row: middle.raw(), diameter }));
    assert_eq!(state(&document, &pin), standing);
    let read = Document::from_bytes(&document.to_saved_bytes()).expect("it is a document");
    assert_eq!(state(&read, &pin), standing, "also in what is saved");
}

#[test]
fn ct2_a_pin_on_wood_that_is_cut_is_detached_and_stands_again() {
    let mut document = tree();
    let (first, middle) = on_a_branch(&document);
    let bearer = document.plant().metamers().parent(first).expect("it is borne");
    let pin = pin(&document, middle);
    apply(&mut document, &plain(Action::Prune { rows: list(vec![first.raw()]) }));
    assert_eq!(state(&document, &pin), (PinState::Detached, Some(bearer.raw())), "the nearest that lives");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(state(&document, &pin), (PinState::Standing, Some(middle.raw())));
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(state(&document, &pin).0, PinState::Detached);
}

#[test]
fn ct2_a_pin_waits_for_its_time_and_says_on_which_line_it_is() {
    let mut document = tree();
    let (_, middle) = on_a_branch(&document);
    let pin = pin(&document, middle);
    let born = document.plant().birth(middle);
    apply(&mut document, &plain(Action::GoTo { step: born - 1 }));
    let found = whereabouts(&document, &pin.0, pin.1);
    assert_eq!((found.state, found.step, found.line), (PinState::NotYet, Some(born), None));
    assert!(found.row.is_some(), "what bears it is there");
    apply(&mut document, &plain(Action::GoTo { step: 9 }));
    assert_eq!(state(&document, &pin), (PinState::Standing, Some(middle.raw())));

    // Another line, on which that wood never was.
    apply(&mut document, &plain(Action::GoTo { step: born - 1 }));
    let cut = laterals(&document)[0].raw();
    apply(&mut document, &plain(Action::Prune { rows: list(vec![cut]) }));
    let other = document.timeline().line;
    let found = whereabouts(&document, &pin.0, pin.1);
    assert_eq!((found.state, found.step, found.line), (PinState::Elsewhere, Some(born), Some(0)));
    apply(&mut document, &plain(Action::TakeFuture { future: 0 }));
    apply(&mut document, &plain(Action::GoTo { step: 9 }));
    assert_eq!(state(&document, &pin), (PinState::Standing, Some(middle.raw())));
    assert_ne!(other, 0);
}

#[test]
fn ct2_like_wood_that_grew_on_another_line_is_regrown() {
    let mut document = tree();
    let (_, middle) = on_a_branch(&document);
    let pin = pin(&document, middle);
    apply(&mut document, &plain(Action::Undo {}));
    // The same growth once more, on another line.
    grow(&mut document, 1, None);
    grow(&mut document, 8, Some(1));
    let (state, row) = state(&document, &pin);
    assert_eq!(state, PinState::Regrown);
    let row = MetamerId::new(row.expect("it is there") as usize);
    assert!(document.plant().metamers().end(row).distance(pin.1) <= 3.0);
    let far = whereabouts(&document, &pin.0, pin.1 + Vec3::X * 50.0);
    assert_eq!(far.state, PinState::Elsewhere, "not where something else is");
    let quick = found_by(&document, &pin.0, pin.1, Search::KnownPlaces);
    assert_eq!(quick.state, PinState::Elsewhere, "not without looking");
}

#[test]
fn ct3_a_pin_goes_where_its_branch_is_moved_and_a_copy_has_none() {
    let mut document = tree();
    let (first, middle) = on_a_branch(&document);
    let below = document.plant().above(first);
    let onto = laterals(&document).into_iter().find(|row| !below.contains(row) && *row != first);
    let onto = onto.expect("there is another branch");
    let pin = pin(&document, middle);
    let place = document.plant().above(first).iter().position(|row| *row == middle).expect("it is above");
    let rotation = UnitRotation::nearest(Quat::IDENTITY);
    let graft = |keep| Action::Graft { row: first.raw(), onto: onto.raw(), rotation, keep };
    apply(&mut document, &plain(graft(true)));
    assert_eq!(state(&document, &pin), (PinState::Standing, Some(middle.raw())), "the copy has none");
    apply(&mut document, &plain(Action::Undo {}));
    let before = document.plant().metamer_count();
    apply(&mut document, &plain(graft(false)));
    let (state_there, row) = state(&document, &pin);
    assert_eq!(state_there, PinState::Standing);
    assert_eq!(row, Some((before + place) as u32), "it went along");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(state(&document, &pin), (PinState::Standing, Some(middle.raw())));
}

#[test]
fn ct3_pins_take_two_passes_over_the_tree_however_many_they_are() {
    let mut document = tree();
    let (first, _) = on_a_branch(&document);
    let above = document.plant().above(first);
    let onto = laterals(&document).into_iter().find(|row| !above.contains(row) && *row != first);
    let onto = onto.expect("there is another branch").raw();
    let moved: Vec<_> = above.iter().map(|row| pin(&document, *row)).collect();
    let rotation = UnitRotation::nearest(Quat::IDENTITY);
    apply(&mut document, &plain(Action::Graft { row: first.raw(), onto, rotation, keep: false }));
    let mut other = tree();
    let lost: Vec<_> = laterals(&other).iter().map(|row| pin(&other, *row)).collect();
    let all = |pins: &[(Anchor, Vec3)], document: &Document, search| {
        document.whereabouts_in_passes(pins.iter().map(|(anchor, place)| (anchor, *place)), search)
    };
    assert!(moved.len() > 2 && lost.len() > 2, "{} {}", moved.len(), lost.len());
    let (found, passes) = all(&moved, &document, Search::Everywhere);
    assert_eq!(passes, 1);
    assert!(found.iter().all(|found| found.state == PinState::Standing), "{found:?}");
    // The same growth once more, on another line.
    apply(&mut other, &plain(Action::Undo {}));
    grow(&mut other, 1, None);
    grow(&mut other, 8, Some(1));
    let (found, passes) = all(&lost, &other, Search::Everywhere);
    assert_eq!(passes, 1);
    assert!(found.iter().any(|found| found.state == PinState::Regrown), "{found:?}");
    let alone: Vec<_> = lost.iter().map(|pin| whereabouts(&other, &pin.0, pin.1)).collect();
    assert_eq!(found, alone, "each as if it were alone");
    assert_eq!(all(&lost, &other, Search::KnownPlaces).1, 0);
    let standing: Vec<_> = laterals(&other).iter().map(|row| pin(&other, *row)).collect();
    assert_eq!(all(&standing, &other, Search::Everywhere).1, 0, "where each is known there is none");
}

#[test]
fn ct1_nothing_is_pinned_to_what_is_not_there() {
    let mut document = tree();
    let count = document.plant().metamer_count() as u32;
    assert_eq!(document.anchor(count), None);
    assert_eq!(document.anchor(0), None, "a seed");
    let (first, middle) = on_a_branch(&document);
    apply(&mut document, &plain(Action::Prune { rows: list(vec![first.raw()]) }));
    assert_eq!(document.anchor(middle.raw()), None, "it is dead");
}

#[test]
fn ct1_a_place_of_another_tree_is_detached_and_harms_nothing() {
    let (document, mut other) = (tree(), Document::new(99));
    grow(&mut other, 3, None);
    for row in laterals(&document) {
        let pin = pin(&document, row);
        let found = whereabouts(&other, &pin.0, pin.1 + Vec3::Y * 90.0);
        assert!(found.row.is_none_or(|row| other.plant().is_alive(MetamerId::new(row as usize))));
    }
    let json = serde_json::to_string(&pin(&document, laterals(&document)[0]).0).expect("it has a form");
    let hostile =
        json.replace("\"row\":", "\"row\":4294967295,\"_\":").replace(",\"_\":", ",\"born\":0,\"x\":");
    if let Ok(anchor) = serde_json::from_str::<Anchor>(&hostile) {
        assert_ne!(whereabouts(&document, &anchor, Vec3::ZERO).state, PinState::Standing);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// On the line where a pin was made, it stands while its metamer lives and is detached while that is dead, unless a
    /// graft has moved it; whatever it says lives.
    #[test]
    fn ct5_pins_are_where_their_metamers_are_through_random_lives(events in events()) {
        let mut document = tree();
        let mut pins: Vec<(u32, u32, u32, Anchor, Vec3)> = Vec::new();
        for (number, (person, event)) in events.iter().enumerate() {
            let name = ["ann", "bo", "cy", "di", "ed"][usize::from(*person)];
            // What cannot be done is refused, and changes nothing.
            let _ = happen(&mut document, number as u32 + 1, name, event);
            let plant = document.plant();
            let line = document.timeline().line;
            for (of, row, born, anchor, place) in &pins {
                let found = found_by(&document, anchor, *place, Search::KnownPlaces);
                if let Some(told) = found.row {
                    prop_assert!(plant.is_alive(MetamerId::new(told as usize)), "what is told lives");
                }
                if *of != line {
                    continue;
                }
                if *born > plant.step() {
                    prop_assert_eq!(found.state, PinState::NotYet);
                } else if plant.is_alive(MetamerId::new(*row as usize)) {
                    prop_assert_eq!((found.state, found.row), (PinState::Standing, Some(*row)));
                } else if found.state == PinState::Standing {
                    prop_assert_ne!(found.row, Some(*row), "moved elsewhere");
                } else {
                    prop_assert_eq!(found.state, PinState::Detached);
                }
            }
            let living: Vec<_> = (1..plant.metamer_count()).map(MetamerId::new)
                .filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).collect();
            if let Some(&row) = living.get(number * 7919 % living.len().max(1)) {
                let (anchor, place) = pin(&document, row);
                pins.push((line, row.raw(), plant.birth(row), anchor, place));
            }
        }
        let read = Document::from_bytes(&document.to_saved_bytes()).expect("it is a document");
        for (.., anchor, place) in &pins {
            let (here, there) = (whereabouts(&document, anchor, *place), whereabouts(&read, anchor, *place));
            // Lines beside the present one may not be saved, and what is on them is known by its way alone.
            if !matches!(here.state, PinState::Regrown | PinState::Elsewhere) {
                prop_assert_eq!(here, there, "as it is saved");
            }
        }
    }
}
