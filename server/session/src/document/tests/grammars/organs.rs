//! Leaves, flowers and fruits of grammars: they come and go with depth, deeds and time, and are written down.

use espalier_mesh::ring_table::told;
use espalier_plant::{Stance, organs::shortest_sides};

use super::*;

/// A bud keeps two leaves as long as it is the tip; each node bears a flower.
const TEXT: &str = "axiom: A\nA --> F~f[+(50)L][-(50)L]A\nL --> *\nhomomorphism:\nL --> ~l(0.5)\n";

/// How many organs each living row is given, or none.
fn organs(document: &Document) -> Vec<Option<usize>> {
    let plant = document.plant();
    let of = |row| plant.given_organs(MetamerId::new(row as usize)).map(|organs| organs.len());
    living(document).into_iter().map(of).collect()
}

#[test]
fn organs_come_and_go_with_depth_and_time() {
    let mut document = Document::new(7);
    apply(&mut document, &set(TEXT, 1));
    let mut known = vec![(document.plant().step(), document.plant().hash(), organs(&document))];
    assert_eq!(known[0].2, [Some(3)]);
    for _ in 0..2 {
        apply(&mut document, &derive(1));
        known.push((document.plant().step(), document.plant().hash(), organs(&document)));
    }
    assert_eq!(known[2].2, [Some(1), Some(1), Some(3)]);
    for (step, hash, organs_then) in known.iter().rev() {
        apply(&mut document, &plain(Action::GoTo { step: *step }));
        assert_eq!((document.plant().hash(), &organs(&document)), (*hash, organs_then), "step {step}");
        let read = Document::from_bytes(&document.to_bytes()).expect("it was written");
        assert_eq!((read.plant(), read.hash()), (document.plant(), document.hash()));
    }
    // Elsewhere in time it goes on to the same.
    apply(&mut document, &derive(2));
    assert_eq!(Some(document.plant().hash()), known.last().map(|last| last.1));
}

#[test]
fn what_one_person_derived_is_taken_back_with_its_organs() {
    let mut document = Document::new(7);
    apply(&mut document, &set(TEXT, 2));
    let seed = Action::PlantSeed { position: Position::nearest(Vec3::new(5.0, 0.0, 0.0)) };
    document.apply(&who("bob"), &plain(seed)).expect("there is room");
    let before = organs(&document);
    apply(&mut document, &derive(1));
    assert_ne!(organs(&document), before);
    apply(&mut document, &plain(take_back_by(&[])));
    assert_eq!(organs(&document), before, "the leaves of the bud are there again");
    let read = Document::from_bytes(&document.to_bytes()).expect("it was written");
    assert_eq!((read.plant(), read.hash()), (document.plant(), document.hash()));
    apply(&mut document, &plain(bring_back_by(&[])));
    assert_eq!(organs(&document), [Some(1), Some(1), Some(3)]);
    assert_eq!(checks::all(document.plant()), Ok(()));
}

#[test]
fn what_grows_on_bears_what_grows_on_such_wood() {
    let mut document = Document::new(7);
    apply(&mut document, &set(TEXT, 2));
    apply(&mut document, &plain(Action::Grow { steps: Steps::nearest(2), until: None, bud: None }));
    let grown = organs(&document);
    assert!(grown.len() > 4 && grown[..2] == [Some(1), Some(3)], "{grown:?}");
    assert!(grown[2..].iter().all(Option::is_none), "{grown:?}");
    // Another text, without organs, in its place.
    let mut document = Document::new(7);
    apply(&mut document, &set(TEXT, 2));
    apply(&mut document, &set("axiom: A\nA --> F[+(30)F]A\n", 2));
    assert!(organs(&document).iter().all(Option::is_none));
}

/// Where the only leaf of a document points, and its upper side, as clients place it.
fn stance(document: &Document) -> Stance {
    let plant = document.plant();
    let leaves = living(document).into_iter().filter_map(|row| {
        let id = MetamerId::new(row as usize);
        let organs = told(plant, id)?;
        let heading = plant.heading(id);
        organs.first().map(|leaf| leaf.stance(heading, shortest_sides(heading)))
    });
    let all: Vec<Stance> = leaves.collect();
    assert_eq!(all.len(), 1);
    all[0]
}

#[test]
fn organs_turn_with_their_wood() {
    let text = "axiom: F(2)[+(90)F(2)[-(90)~l(3)]]F(2)A\nA --> FA\n";
    let before = {
        let mut document = Document::new(7);
        apply(&mut document, &set(text, 1));
        stance(&document)
    };
    assert!(before.direction.dot(Vec3::Y) > 0.999, "{before:?}");
    // Half a turn about the trunk, one about the branch itself, and something between.
    for rotation in [
        Quat::from_xyzw(0.0, 1.0, 0.0, 0.0),
        Quat::from_xyzw(1.0, 0.0, 0.0, 0.0),
        Quat::from_xyzw(0.48, 0.36, 0.0, 0.8),
    ] {
        let mut document = Document::new(7);
        apply(&mut document, &set(text, 1));
        let branch = living(&document)
            .into_iter()
            .find(|&row| document.plant().heading(MetamerId::new(row as usize)).y.abs() < 0.1)
            .expect("the branch is level");
        let turn = Action::TurnBranch { row: branch, rotation: UnitRotation::nearest(rotation) };
        apply(&mut document, &in_gesture(1, turn));
        let wanted = [rotation * before.direction, rotation * before.normal];
        for _ in 0..2 {
            let found = stance(&document);
            assert!(found.direction.dot(wanted[0]) > 0.999, "{rotation} {found:?} {wanted:?}");
            assert!(found.normal.dot(wanted[1]) > 0.99, "{rotation} {found:?} {wanted:?}");
            // So it stays when the grammar goes on.
            apply(&mut document, &derive(1));
        }
    }
}

#[test]
fn organs_that_change_count_among_what_histories_keep() {
    // Nothing moves; each step gives all leaves another length.
    let text = "axiom: F(40)L(1)\nL(x) --> L(x+1)\nhomomorphism:\nL(x) --> ~l(x)\n";
    let mut document = Document::new(7);
    apply(&mut document, &set(text, 1));
    apply(&mut document, &derive(3));
    let kept: Vec<u32> = document.history.operations.iter().map(|operation| operation.places).collect();
    assert_eq!(kept, [1, 3]);
}
