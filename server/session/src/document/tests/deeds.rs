//! Deeds of several people, taken back and brought back among one another.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;
use crate::document::{history::Kind as Deed, parts::Run};

/// A stroke of somebody, sidewards at a height, so that it begins at wood that is there.
fn draw(document: &mut Document, name: &str, number: u32, x: f32, y: f32) {
    let mut apply = |action: Action| document.apply(&who(name), &plain(action)).expect("in good form");
    apply(Action::StrokeBegin { stroke: number, bud: None });
    let samples = list(vec![sample(0.0, y, 0.6), sample(x, y + 3.0, 0.6)]);
    apply(Action::StrokeMove { stroke: number, samples });
    apply(Action::StrokeEnd { stroke: number });
}

/// Strokes of several people that begin before any of them ends, each a piece at a time.
fn draw_at_once<const N: usize>(document: &mut Document, strokes: [(&str, u32, f32); N]) {
    let mut act =
        |name: &str, action: Action| document.apply(&who(name), &plain(action)).expect("in good form");
    for (name, stroke, _) in strokes {
        act(name, Action::StrokeBegin { stroke, bud: None });
    }
    for part in 0..4 {
        for (name, stroke, x) in strokes {
            let [x, y] = [x * part as f32 / 3.0, 5.0 + 2.0 * part as f32 / 3.0];
            act(name, Action::StrokeMove { stroke, samples: list(vec![sample(x, y, 0.6)]) });
        }
    }
    for (name, stroke, _) in strokes {
        act(name, Action::StrokeEnd { stroke });
    }
}

/// Whether wood of a deed that is away stands since others' stands on it.
fn is_held(document: &Document, row: u32) -> bool {
    let mut plant = document.plant().clone();
    plant.stash_future();
    plant.settle(&document.history.claims(document.plant())).held.contains(&MetamerId::new(row as usize))
}

fn take_back(document: &mut Document, name: &str) -> Result<(), Problem> {
    document.apply(&who(name), &plain(take_back_by(&[])))
}

fn bring_back(document: &mut Document, name: &str) -> Result<(), Problem> {
    document.apply(&who(name), &plain(bring_back_by(&[])))
}

/// Living metamers and the bits of their places.
fn wood(document: &Document) -> BTreeMap<u32, [u32; 3]> {
    let plant = document.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    living.map(|id| (id.raw(), plant.metamers().end(id).to_array().map(f32::to_bits))).collect()
}

/// What some drew and nobody has cut.
fn drawn(document: &Document, by: impl Fn(&Principal) -> bool) -> Vec<u32> {
    let history = &document.history;
    let mut plant = document.plant().clone();
    plant.stash_future();
    let held = plant.settle(&history.claims(document.plant())).held;
    let mut drawn = Vec::new();
    for (operation, away) in history.operations[..history.done].iter().zip(history.parts_away()) {
        let born = operation.born(document.plant());
        let mut runs = operation.runs_of(born.clone());
        if runs.is_empty() {
            runs.push((born, Run { first: 0, part: 0, by_hand: operation.is_drawn() }));
        }
        runs.retain(|(_, run)| run.by_hand && !away.holds(run.part) && by(operation.author_of(run.part)));
        drawn
            .extend(wood(document).into_keys().filter(|row| runs.iter().any(|(rows, _)| rows.contains(row))));
    }
    drawn.retain(|&row| !held.contains(&MetamerId::new(row as usize)));
    drawn
}

#[test]
fn ud1_taking_back_leaves_what_others_drew_to_the_bit() {
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let without = wood(&document);
    draw(&mut document, "cy", 1, -9.0, 5.0);
    let cys = drawn(&document, |author| *author == who("cy"));
    assert!(!cys.is_empty(), "cy's stroke has grown");
    let before = wood(&document);
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    let after = wood(&document);
    assert!(after.len() < before.len() && cys.iter().all(|row| after.get(row) == before.get(row)));
    assert_eq!(bring_back(&mut document, "bo"), Ok(()));
    assert_eq!(wood(&document), before, "UD3: all of it is back");
    // Without both strokes the tree is that of before them.
    assert_eq!(take_back(&mut document, "cy"), Ok(()));
    assert_eq!(wood(&document), without);
}

#[test]
fn ud6_the_line_says_what_is_away() {
    use espalier_proto::OperationKind::{BroughtBack, TakenBack};
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let away = |document: &Document| {
        document.timeline().operations.iter().map(|operation| operation.away).collect::<Vec<_>>()
    };
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    assert_eq!(away(&document), [false, true, false]);
    assert_eq!(bring_back(&mut document, "bo"), Ok(()));
    assert_eq!(away(&document), [false; 4]);
    assert_eq!(kinds(&document)[2..], [TakenBack, BroughtBack]);
    // Before it was taken back it was not.
    let step = document.timeline().operations[1].last;
    apply(&mut document, &plain(Action::GoTo { step }));
    assert_eq!(away(&document), [false; 4]);
}

#[test]
fn ud7_what_is_passed_over_is_told() {
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let before = wood(&document);
    draw(&mut document, "bo", 2, -9.0, 5.0);
    let second: Vec<u32> = wood(&document).into_keys().filter(|row| !before.contains_key(row)).collect();
    let roots = second.iter().copied().filter(|&row| {
        let parent = document.plant().metamers().parent(MetamerId::new(row as usize));
        parent.is_some_and(|parent| !second.contains(&parent.raw()))
    });
    let rows = list(roots.collect());
    document.apply(&who("cy"), &plain(Action::Prune { rows })).expect("living wood");
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    let switched = document.take_switched().expect("the first stroke went");
    assert!(switched.passed == 1 && switched.fell > 0, "{switched:?}");
}

#[test]
fn ud2_a_stroke_of_somebody_else_goes_on() {
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let cy = |document: &mut Document, action: Action| {
        document.apply(&who("cy"), &plain(action)).expect("in good form");
    };
    cy(&mut document, Action::StrokeBegin { stroke: 7, bud: None });
    let samples = list(vec![sample(0.0, 5.0, 0.6), sample(-5.0, 7.0, 0.6)]);
    cy(&mut document, Action::StrokeMove { stroke: 7, samples });
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    assert_eq!(document.open_strokes(&who("cy")), [7]);
    let before = wood(&document).len();
    cy(&mut document, Action::StrokeMove { stroke: 7, samples: list(vec![sample(-12.0, 9.0, 0.6)]) });
    assert!(wood(&document).len() > before, "it grows on");
    cy(&mut document, Action::StrokeEnd { stroke: 7 });
}

/// Somebody takes hold of a path from its base on and moves its end.
fn take_hold(document: &mut Document, name: &str, number: u32, path: &[MetamerId]) -> Result<(), Problem> {
    let (base, end) = (path[path.len() - 1].raw(), path[0]);
    let touches = held(vec![end.raw()]);
    let begin = Action::BendBegin { bend: number, base, touches, stretch: Share::nearest(0.2) };
    document.apply(&who(name), &plain(begin))?;
    let place = document.plant().metamers().end(end) + Vec3::new(1.0, 0.5, 0.5);
    document.apply(&who(name), &plain(Action::BendMove { bend: number, targets: places(vec![place]) }))
}

fn let_go(document: &mut Document, name: &str, number: u32) -> Result<(), Problem> {
    document.apply(&who(name), &plain(Action::BendEnd { bend: number }))
}

/// The way from the newest metamer of somebody down to their first.
fn own_path(document: &Document, first: u32) -> Vec<MetamerId> {
    let end = wood(document).into_keys().next_back().expect("some wood");
    let below = |id: &MetamerId| document.plant().metamers().parent(*id).filter(|id| id.raw() >= first);
    std::iter::successors(Some(MetamerId::new(end as usize)), below).collect()
}

#[test]
fn ud2_a_bend_of_somebody_else_is_not_ended() {
    let mut document = tree();
    draw(&mut document, "bo", 1, -9.0, 4.0);
    let first = document.plant().metamer_count() as u32;
    draw(&mut document, "bo", 2, 9.0, 5.0);
    let path = own_path(&document, first);
    assert!(path.len() > 3);
    take_hold(&mut document, "ann", 1, &path).expect("it can bend");
    let before = document.hash();
    let problem = take_back(&mut document, "bo").expect_err("ann is bending what would fall");
    assert_eq!((problem.reason, document.hash()), (Reason::BeingBent, before));
    let_go(&mut document, "ann", 1).expect("it bends");
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    // Nor what would only move it.
    let row = long_path(&document, 6)[4].raw();
    let rotation = UnitRotation::nearest(Quat::from_xyzw(0.0, 0.0, 0.6, 0.8));
    document.apply(&who("bo"), &plain(Action::TurnBranch { row, rotation })).expect("it turns");
    let path = long_path(&document, 3);
    take_hold(&mut document, "ann", 2, &path).expect("it can bend");
    assert_eq!(take_back(&mut document, "bo").expect_err("it would move").reason, Reason::BeingBent);
}

#[test]
fn ud2_a_bend_elsewhere_is_in_nobodys_way() {
    let mut document = tree();
    let path = long_path(&document, 6);
    let first = document.plant().metamer_count() as u32;
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let drawn = wood(&document);
    take_hold(&mut document, "ann", 1, &path[..4]).expect("it can bend");
    for away in [true, false] {
        let done = if away { take_back(&mut document, "bo") } else { bring_back(&mut document, "bo") };
        assert_eq!((done, document.open_bends(&who("ann"))), (Ok(()), vec![1]));
        assert_eq!(wood(&document).into_keys().any(|row| row >= first), !away);
    }
    assert_eq!(wood(&document), drawn);
    let_go(&mut document, "ann", 1).expect("it bends");
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
}

#[test]
fn ud1_a_bend_among_others_work_goes_and_comes() {
    let mut document = tree();
    let path = long_path(&document, 8);
    let straight = wood(&document);
    take_hold(&mut document, "bo", 1, &path[..6]).expect("it can bend");
    let_go(&mut document, "bo", 1).expect("it bends");
    draw(&mut document, "cy", 1, -9.0, 5.0);
    let bent = wood(&document);
    assert_ne!(straight[&path[0].raw()], bent[&path[0].raw()]);
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    let place = |wood: &BTreeMap<u32, [u32; 3]>, row: u32| Vec3::from(wood[&row].map(f32::from_bits));
    let is_near = |one: &BTreeMap<u32, [u32; 3]>, other: &BTreeMap<u32, [u32; 3]>| {
        one.keys().all(|row| place(one, *row).distance(place(other, *row)) < 1e-5)
    };
    let after = wood(&document);
    assert!(is_near(&straight, &after), "what it bent is where it was");
    assert_eq!(bring_back(&mut document, "bo"), Ok(()));
    assert!(is_near(&bent, &wood(&document)) && wood(&document).len() == bent.len());
}

#[test]
fn ud1_what_cannot_go_bars_nothing_that_was_done_before() {
    let mut document = Document::new(5);
    document.apply(&who("ann"), &designing::begin(8.0)).expect("a design");
    let before = document.parameters();
    document.apply(&who("bo"), &patch(0.61)).expect("in range");
    document.apply(&who("bo"), &designing::say(1, 0.3, None)).expect("a branch of the design");
    grow(&mut document, 2, None);
    assert_eq!(take_back(&mut document, "bo"), Ok(()), "the design is sealed, the parameter is not");
    assert_eq!(document.parameters(), before);
    assert_eq!(document.take_switched().map(|switched| switched.passed), Some(1));
    let refused = take_back(&mut document, "bo").expect_err("nothing else is left");
    assert_eq!(refused.reason, Reason::DesignSealed, "and it says what keeps the newest");
}

#[test]
fn ud2_two_who_take_back_against_each_other_change_nothing_of_a_strokes_wood() {
    // Of somebody who draws meanwhile, the rows are those that they would be.
    let drawn = |with_others: bool| {
        let mut document = tree();
        draw(&mut document, "bo", 1, 9.0, 4.0);
        draw(&mut document, "cy", 1, -9.0, 4.0);
        let first = document.plant().metamer_count();
        let act = |document: &mut Document, name: &str, action: Action| {
            document.apply(&who(name), &plain(action)).expect("in good form");
        };
        act(&mut document, "ann", Action::StrokeBegin { stroke: 7, bud: None });
        for part in 0..10 {
            let [x, y] = [0.4 * part as f32, 9.0 + part as f32];
            act(
                &mut document,
                "ann",
                Action::StrokeMove { stroke: 7, samples: list(vec![sample(x, y, 0.6)]) },
            );
            for name in ["bo", "cy"].into_iter().cycle().take(if with_others { 100 } else { 0 }) {
                take_back(&mut document, name).expect("it is in force");
                bring_back(&mut document, name).expect("it was taken back");
            }
        }
        act(&mut document, "ann", Action::StrokeEnd { stroke: 7 });
        wood(&document).into_iter().filter(|(row, _)| *row as usize >= first).collect::<Vec<_>>()
    };
    let alone = drawn(false);
    assert!(alone.len() > 5);
    assert_eq!(drawn(true), alone);
}

#[test]
fn lm11_taking_back_leaves_the_futures() {
    let mut document = tree();
    for number in 0..espalier_proto::version::MAX_FUTURES as u32 {
        apply(&mut document, &plain(Action::Undo {}));
        grow(&mut document, 9 + number % 2, None);
    }
    let futures = document.timeline().futures.len();
    assert!(futures > 1, "{futures}");
    draw(&mut document, "bo", 1, 9.0, 4.0);
    for _ in 0..100 {
        take_back(&mut document, "bo").expect("it is in force");
        bring_back(&mut document, "bo").expect("it was taken back");
    }
    assert_eq!(document.timeline().futures.len(), futures);
}

#[test]
fn ps6_what_people_take_along_has_no_keys() {
    let mut document = tree();
    draw_at_once(&mut document, [("bo-browser", 1, 14.0), ("cy-browser", 1, -14.0)]);
    let path = long_path(&document, 4);
    take_hold(&mut document, "di-browser", 1, &path).expect("it can bend");
    document.apply(&who("ed-browser"), &plain(Action::StrokeBegin { stroke: 1, bud: None })).expect("room");
    let holds = |bytes: &[u8], key: &str| bytes.windows(key.len()).any(|found| found == key.as_bytes());
    let (kept, taken) = (document.to_saved_bytes(), document.to_bytes_for_people());
    for key in ["ann", "bo-browser", "cy-browser", "di-browser", "ed-browser"] {
        assert_eq!((holds(&kept, key), holds(&taken, key)), (true, false), "{key}");
    }
    // Otherwise it is the same, and taken along again no other.
    let mut again = Document::from_bytes(&taken).expect("it was just written");
    assert_eq!((again.to_bytes_for_people(), again.plant().hash()), (taken, document.plant().hash()));
    // Whoever is alone with it goes back in time past what others did elsewhere.
    again.apply(&who("fay"), &plain(Action::StrokeEnd { stroke: 1 })).expect_err("that is not theirs");
    let steps = again.plant().step();
    assert_eq!(take_back(&mut again, "fay"), Ok(()));
    assert!(again.plant().step() < steps);
}

#[test]
fn tt7_time_waits_for_the_strokes_and_bends_of_others() {
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::Redo {}));
    let journeys = [
        Action::Ungrow { steps: Steps::nearest(1) },
        Action::Undo {},
        Action::Redo {},
        Action::GoTo { step: 1 },
        Action::TakeFuture { future: 1 },
    ];
    let refused = |document: &mut Document, reason: Reason| {
        for journey in journeys.clone() {
            let before = document.hash();
            let problem = document.apply(&who("bo"), &plain(journey)).expect_err("somebody else is at work");
            assert_eq!((problem.reason, document.hash()), (reason, before));
        }
    };
    let cy = |document: &mut Document, action: Action| {
        document.apply(&who("cy"), &plain(action)).expect("in good form");
    };
    cy(&mut document, Action::StrokeBegin { stroke: 7, bud: None });
    refused(&mut document, Reason::BeingDrawn);
    cy(&mut document, Action::StrokeEnd { stroke: 7 });
    let path = long_path(&document, 6);
    let (base, touches) = (path[5].raw(), held(vec![path[0].raw()]));
    cy(&mut document, Action::BendBegin { bend: 1, base, touches, stretch: Share::nearest(0.2) });
    refused(&mut document, Reason::BeingBent);
    // One's own gestures end by one's own journey.
    cy(&mut document, Action::GoTo { step: 1 });
    assert_eq!((document.plant().step(), document.open_bends(&who("cy"))), (1, Vec::new()));
}

#[test]
fn ud3_only_what_was_taken_back_last_comes_back() {
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let refused = |result: Result<(), Problem>| result.map_err(|problem| problem.reason);
    assert_eq!(refused(bring_back(&mut document, "bo")), Err(Reason::NothingToRedo));
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    draw(&mut document, "bo", 2, -9.0, 4.0);
    assert_eq!(refused(bring_back(&mut document, "bo")), Err(Reason::NothingToRedo));
    assert_eq!(refused(take_back(&mut document, "cy")), Err(Reason::NothingOfYours));
}

#[test]
fn ud4_alone_they_are_undo_and_redo() {
    let (mut one, mut other) = (tree(), tree());
    for document in [&mut one, &mut other] {
        draw(document, "ann", 1, 9.0, 4.0);
    }
    apply(&mut one, &plain(take_back_by(&[])));
    apply(&mut other, &plain(Action::Undo {}));
    assert_eq!(one.hash(), other.hash());
    apply(&mut one, &plain(bring_back_by(&[])));
    apply(&mut other, &plain(Action::Redo {}));
    assert_eq!(one.hash(), other.hash());
}

#[test]
fn ud8_what_a_person_did_under_another_key_is_theirs() {
    let mut document = Document::new(5);
    let grow = plain(Action::Grow { steps: Steps::nearest(9), until: None, bud: None });
    document.apply(&who("bo"), &grow).expect("there is room");
    let before = wood(&document);
    draw(&mut document, "bo later", 1, 9.0, 4.0);
    let drawn = wood(&document);
    let act =
        |document: &mut Document, name: &str, action: Action| document.apply(&who(name), &plain(action));
    let refused = act(&mut document, "bo today", take_back_by(&[])).map_err(|problem| problem.reason);
    assert_eq!(refused, Err(Reason::NothingOfYours));
    // Alone on the line under all their keys they go back in time, as with `undo`.
    assert_eq!(act(&mut document, "bo today", take_back_by(&["bo", "bo later"])), Ok(()));
    assert_eq!((wood(&document), kinds(&document).len()), (before, 2));
    assert_eq!(act(&mut document, "bo today", bring_back_by(&["bo", "bo later"])), Ok(()));
    assert_eq!(wood(&document), drawn);
    // Where others have drawn, what goes is the newest of what they did under any of them.
    draw(&mut document, "cy", 1, -9.0, 5.0);
    let with_cys = wood(&document);
    assert_eq!(act(&mut document, "bo today", take_back_by(&["bo", "bo later"])), Ok(()));
    let away = document.timeline().operations.iter().map(|operation| operation.away).collect::<Vec<_>>();
    assert_eq!(away, [false, true, false, false]);
    assert_eq!(act(&mut document, "bo later", bring_back_by(&["bo", "bo today"])), Ok(()));
    assert_eq!(wood(&document), with_cys);
}

#[test]
fn ud8_a_bend_on_another_device_of_ones_own_is_in_nobodys_way() {
    let mut document = tree();
    draw(&mut document, "bo", 1, 9.0, 4.0);
    let path = long_path(&document, 6);
    let (base, touches) = (path[5].raw(), held(vec![path[0].raw()]));
    let begin = Action::BendBegin { bend: 1, base, touches, stretch: Share::nearest(0.2) };
    document.apply(&who("bo's phone"), &plain(begin)).expect("it can bend");
    assert_eq!(document.apply(&who("bo"), &plain(take_back_by(&["bo's phone"]))), Ok(()));
    assert!(document.open_bends(&who("bo's phone")).is_empty());
}

#[test]
fn ud4_of_what_several_drew_at_once_each_takes_back_their_own() {
    let (mut document, before) = (tree(), wood(&tree()));
    draw_at_once(&mut document, [("bo", 1, 14.0), ("cy", 1, -14.0)]);
    assert_eq!(kinds(&document)[1..], [espalier_proto::OperationKind::Stroke], "one operation");
    let of = |document: &Document, name: &str| drawn(document, |author| *author == who(name));
    let whole = wood(&document);
    let (bos, cys) = (of(&document, "bo"), of(&document, "cy"));
    assert!(bos.len() > 5 && cys.len() > 5, "{} and {}", bos.len(), cys.len());
    assert_eq!(bos.len() + cys.len(), whole.len() - before.len(), "all of it is of one of them");
    let sides = |rows: &[u32], sign: f32| {
        let place =
            |&&row: &&u32| document.plant().metamers().end(MetamerId::new(row as usize)).x * sign > 0.0;
        rows.iter().filter(place).count() as f32 / rows.len() as f32
    };
    assert!(sides(&bos, 1.0) > 0.9 && sides(&cys, -1.0) > 0.9, "each one's is where they drew");

    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    let after = wood(&document);
    assert!(cys.iter().all(|row| after.get(row) == whole.get(row)), "cy's stays to the bit");
    let left = bos.iter().filter(|row| after.contains_key(row)).count();
    assert!(left < bos.len() / 4, "{left} of {} stay", bos.len());
    assert!(bos.iter().all(|row| !after.contains_key(row) || is_held(&document, *row)), "only under cy's");
    let parts = |document: &Document| {
        let parts = &document.timeline().operations[1].parts;
        (document.timeline().operations[1].away, parts.iter().map(|part| part.away).collect::<Vec<_>>())
    };
    assert_eq!(parts(&document), (false, vec![true, false]));
    let refused = take_back(&mut document, "bo").map_err(|problem| problem.reason);
    assert_eq!(refused, Err(Reason::NothingOfYours));
    assert_eq!(bring_back(&mut document, "bo"), Ok(()));
    assert_eq!(wood(&document), whole);
    for name in ["cy", "bo"] {
        assert_eq!(take_back(&mut document, name), Ok(()));
    }
    assert_eq!((wood(&document), parts(&document)), (before, (true, vec![true, true])));
    let again = Document::from_bytes(&document.to_bytes()).expect("it was just written");
    assert_eq!(again.hash(), document.hash());
}

#[test]
fn ud4_what_one_sowed_and_grew_while_another_drew_is_the_sowers() {
    // Whoever moves later makes steps in which the other's markers still draw shoots.
    let mut document = tree();
    let mut act =
        |name: &str, action: Action| document.apply(&who(name), &plain(action)).expect("in good form");
    for name in ["bo", "cy"] {
        act(name, Action::StrokeBegin { stroke: 1, bud: None });
    }
    act(
        "bo",
        Action::StrokeMove { stroke: 1, samples: list(vec![sample(4.0, 6.0, 3.0), sample(9.0, 8.0, 3.0)]) },
    );
    for part in 0..12 {
        let samples = list(vec![sample(-4.0 - part as f32, 6.0, 0.6)]);
        act("cy", Action::StrokeMove { stroke: 1, samples });
    }
    for name in ["bo", "cy"] {
        act(name, Action::StrokeEnd { stroke: 1 });
    }
    let bos = drawn(&document, |author| *author == who("bo"));
    let born = |&row: &u32| document.plant().birth(MetamerId::new(row as usize));
    let steps: std::collections::BTreeSet<u32> = bos.iter().map(born).collect();
    assert!(steps.len() > 1, "it grew in cy's steps as well");
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    let left = wood(&document);
    let is_gone_or_held = |row: &u32| !left.contains_key(row) || is_held(&document, *row);
    assert!(bos.iter().all(is_gone_or_held));
}

#[test]
fn ud4_what_is_begun_beside_a_stroke_is_no_part_of_what_was_done_meanwhile() {
    type Happens = fn(&mut Document);
    let meanwhile: [(&str, Happens); 2] = [
        ("a setting", |document| document.apply(&who("cy"), &patch(0.61)).expect("in range")),
        ("an undo", |document| take_back(document, "cy").expect("cy has drawn")),
    ];
    let begins: [fn(u32) -> Action; 2] = [
        |_| Action::Grow { steps: Steps::nearest(2), until: None, bud: None },
        |stroke| Action::StrokeBegin { stroke, bud: None },
    ];
    for (what, happens) in meanwhile {
        for begin in begins {
            let mut document = tree();
            draw(&mut document, "cy", 1, -9.0, 4.0);
            let before = drawn(&document, |author| *author != who("cy"));
            document
                .apply(&who("bo"), &plain(Action::StrokeBegin { stroke: 7, bud: None }))
                .expect("it begins");
            happens(&mut document);
            document.apply(&who("bo"), &plain(begin(8))).expect("it begins as well");
            for stroke in document.open_strokes(&who("bo")) {
                let samples = list(vec![sample(0.0, 5.0, 0.6), sample(9.0, 8.0, 0.6)]);
                document
                    .apply(&who("bo"), &plain(Action::StrokeMove { stroke, samples }))
                    .expect("it is open");
                document.apply(&who("bo"), &plain(Action::StrokeEnd { stroke })).expect("it is open");
            }
            let author =
                document.history.operations.last().map(|last| (last.author.clone(), last.kind.grows()));
            assert_eq!(author, Some((who("bo"), true)), "beside {what}");
            while take_back(&mut document, "bo").is_ok() {}
            let after = drawn(&document, |author| *author != who("cy"));
            assert_eq!(after, before, "all of it goes, beside {what}");
        }
    }
}

#[test]
fn ud5_a_field_shows_what_the_last_deed_in_force_says() {
    let mut document = tree();
    let set = |document: &mut Document, name: &str, patch: ParametersPatch| {
        document.apply(&who(name), &plain(Action::SetParameters { parameters: patch })).expect("in range");
    };
    let control = |value| ParametersPatch { apical_control: Some(value), ..ParametersPatch::default() };
    let first = document.parameters();
    set(&mut document, "bo", control(0.5));
    set(&mut document, "bo", ParametersPatch { branching_angle: Some(70.0), ..ParametersPatch::default() });
    set(&mut document, "cy", control(0.55));
    let angle = |document: &Document| document.parameters().branching_angle;
    let of = |document: &Document| document.parameters().apical_control;
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    assert_eq!((angle(&document), of(&document)), (first.branching_angle, 0.55));
    assert_eq!(take_back(&mut document, "cy"), Ok(()));
    assert_eq!(of(&document), 0.5, "bo's is the last in force");
    assert_eq!(take_back(&mut document, "bo"), Ok(()));
    assert_eq!(document.parameters(), first);
    assert_eq!(bring_back(&mut document, "cy"), Ok(()));
    assert_eq!(of(&document), 0.55);
}

#[derive(Clone, Debug)]
pub(super) enum Event {
    Draw(i8, u8),
    DrawAtOnce(u8, i8),
    Grow(u8),
    Prune(u16),
    Turn(u16),
    Graft(u16, u16, bool),
    Widen(u16),
    Bend(u16),
    Hold(u16),
    Control(u8),
    Seed(i8),
    TakeBack,
    BringBack,
    Undo,
    GoTo(u16),
}

pub(super) fn events() -> impl Strategy<Value = Vec<(u8, Event)>> {
    let event = prop_oneof![
        6 => (-12i8..12, 1u8..12).prop_map(|(x, y)| Event::Draw(x, y)),
        3 => (0u8..5, 4i8..14).prop_map(|(other, x)| Event::DrawAtOnce(other, x)),
        1 => (1u8..3).prop_map(Event::Grow),
        1 => any::<u16>().prop_map(Event::Prune),
        1 => any::<u16>().prop_map(Event::Turn),
        1 => any::<(u16, u16, bool)>().prop_map(|(row, onto, keep)| Event::Graft(row, onto, keep)),
        1 => any::<u16>().prop_map(Event::Widen),
        2 => any::<u16>().prop_map(Event::Bend),
        1 => any::<u16>().prop_map(Event::Hold),
        1 => (45u8..60).prop_map(Event::Control),
        1 => (-9i8..9).prop_map(Event::Seed),
        8 => Just(Event::TakeBack),
        4 => Just(Event::BringBack),
        1 => Just(Event::Undo),
        1 => any::<u16>().prop_map(Event::GoTo),
    ];
    prop::collection::vec((0u8..5, event), 4..40)
}

/// Lets somebody do something, if it can be done.
pub(super) fn happen(document: &mut Document, number: u32, name: &str, event: &Event) -> Result<(), Problem> {
    let living: Vec<u32> = wood(document).into_keys().filter(|&row| row > 0).collect();
    let row = |pick: u16| living.get(usize::from(pick) % living.len().max(1)).copied().unwrap_or(0);
    let action = match *event {
        Event::Draw(x, y) => {
            draw(document, name, number, f32::from(x), f32::from(y));
            return Ok(());
        }
        Event::DrawAtOnce(other, x) => {
            let other = format!("person {other}");
            let x = f32::from(x);
            draw_at_once(document, [(name, number, x), (&other, number + 1000, -x)]);
            return Ok(());
        }
        Event::Grow(steps) => Action::Grow { steps: Steps::nearest(steps.into()), until: None, bud: None },
        Event::Prune(pick) => Action::Prune { rows: list(vec![row(pick)]) },
        Event::Turn(pick) => {
            let rotation = UnitRotation::nearest(Quat::from_xyzw(0.0, 0.6, 0.0, 0.8));
            Action::TurnBranch { row: row(pick), rotation }
        }
        Event::Graft(pick, onto, keep) => {
            let rotation = UnitRotation::nearest(Quat::from_xyzw(0.6, 0.0, 0.0, 0.8));
            Action::Graft { row: row(pick), onto: row(onto), rotation, keep }
        }
        Event::Widen(pick) => Action::SetWidth { row: row(pick), diameter: Some(Diameter::nearest(0.7)) },
        Event::Bend(pick) | Event::Hold(pick) => {
            let below = |id: &MetamerId| document.plant().metamers().parent(*id).filter(|id| id.raw() > 0);
            let path: Vec<_> =
                std::iter::successors(Some(MetamerId::new(row(pick) as usize)), below).take(5).collect();
            take_hold(document, name, number, &path)?;
            return if matches!(event, Event::Bend(_)) { let_go(document, name, number) } else { Ok(()) };
        }
        Event::Control(hundredths) => {
            return document.apply(&who(name), &patch(f32::from(hundredths) / 100.0));
        }
        Event::Seed(x) => Action::PlantSeed { position: Position::nearest(Vec3::X * f32::from(x) * 3.0) },
        Event::TakeBack => take_back_by(&[]),
        Event::BringBack => bring_back_by(&[]),
        Event::Undo => Action::Undo {},
        Event::GoTo(step) => Action::GoTo { step: u32::from(step) % (document.plant().last_step() + 1) },
    };
    document.apply(&who(name), &plain(action))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn ud1_five_people_take_back_their_own(events in events()) {
        let mut document = Document::new(5);
        document.set_metamer_budget(4000);
        for (number, (person, event)) in (1..).zip(&events) {
            let name = format!("person {person}");
            let before = wood(&document);
            let others = drawn(&document, |author| *author != who(&name));
            let done = happen(&mut document, number, &name, event);
            prop_assert_eq!(espalier_plant::checks::all(document.plant()), Ok(()));
            for bend in &document.bends.open {
                let is_whole = bend.path.iter().all(|&id| document.plant().is_alive(id));
                prop_assert!(is_whole, "{:?}", event);
            }
            if !matches!(event, Event::TakeBack) || done.is_err() {
                continue;
            }
            let history = &document.history;
            let moves = history.current().and_then(|last| last.deed).is_some_and(|deed| {
                matches!(history.operations[deed as usize].kind, Deed::Turn | Deed::Graft | Deed::Bend)
            });
            let after = wood(&document);
            for row in others {
                prop_assert!(after.contains_key(&row), "{} fell", row);
                prop_assert!(moves || before[&row] == after[&row], "{} moved", row);
            }
        }
        while let Some((author, number)) = document.bends.open.first().map(|bend| (bend.author.clone(), bend.number)) {
            // Refused or not, it ends.
            let _ = let_go(&mut document, author.name(), number);
        }
        // What is written is read again, and goes back and forth.
        let mut again = Document::from_bytes(&document.to_bytes()).expect("it was just written");
        prop_assert_eq!(again.hash(), document.hash());
        for step in [0, document.plant().last_step()] {
            for document in [&mut document, &mut again] {
                apply(document, &plain(Action::GoTo { step }));
            }
            prop_assert_eq!(again.hash(), document.hash());
        }
        // Once everybody has taken back everything there is the seedling.
        let mut people = (0..5).map(|person| format!("person {person}")).collect::<Vec<_>>();
        while !people.is_empty() {
            people.retain(|name| take_back(&mut document, name).is_ok());
        }
        let away = document.history.away();
        if document.history.operations[..document.history.done].iter().zip(away).all(|(one, away)| away || one.kind.is_switch()) {
            prop_assert_eq!(wood(&document).into_keys().collect::<Vec<_>>(), [0]);
            prop_assert_eq!(document.parameters(), Document::new(5).parameters());
        }
    }
}
