//! Lines of time: going along them, leaving them, and what they keep.

use super::{
    arranging::{place_in, sphere},
    *,
};
use crate::document::history::MAX_SETS;

#[test]
fn tt3_what_lay_ahead_becomes_a_future() {
    let mut document = tree();
    let first = document.plant().hash();
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(4) }));
    apply(&mut document, &plain(Action::PlantSeed { position: Position::nearest(Vec3::X * 5.0) }));
    grow(&mut document, 2, None);
    let timeline = document.timeline();
    assert_eq!((timeline.line, timeline.step, timeline.last_step, timeline.done), (1, 8, 8, 3));
    let [future] = timeline.futures.as_slice() else { panic!("one future, not {:?}", timeline.futures) };
    assert_eq!((future.future, future.from, future.steps, future.on), (0, 5, 4, None));
    assert_eq!(future.operations.len(), 1, "the growth that was cut in two");
    let second = document.plant().hash();
    // A future of what is now a future.
    apply(&mut document, &plain(Action::GoTo { step: 7 }));
    grow(&mut document, 1, None);
    apply(&mut document, &plain(Action::GoTo { step: 3 }));
    grow(&mut document, 1, None);
    let futures = document.timeline().futures;
    let hangs: Vec<_> = futures.iter().map(|future| (future.future, future.on, future.from)).collect();
    assert_eq!(hangs, [(0, Some(2), 5), (1, Some(2), 7), (2, None, 3)]);
    for (line, hash) in [(0, first), (1, second), (0, first)] {
        apply(&mut document, &plain(Action::TakeFuture { future: line }));
        assert_eq!((document.plant().hash(), document.timeline().line), (hash, line));
    }
    let unknown = plain(Action::TakeFuture { future: 0 });
    assert_eq!(refusal(&mut document, &unknown), (ProblemCode::NotFound, "future".into()));
    assert_eq!(document.timeline().futures.len(), 3);
}

#[test]
fn tt2_scrubbing_follows_the_settings_of_the_line() {
    let mut document = tree();
    let seedling = document.parameters();
    apply(&mut document, &patch(0.6));
    let changed = document.parameters();
    grow(&mut document, 2, None);
    apply(&mut document, &plain(Action::GoTo { step: 4 }));
    assert_eq!(document.parameters(), seedling);
    apply(&mut document, &plain(Action::GoTo { step: 10 }));
    assert_eq!(document.parameters(), changed);
    assert_eq!(
        refusal(&mut document, &plain(Action::GoTo { step: 12 })),
        (ProblemCode::OutOfRange, "step".into())
    );
    // CM7: ungrowing keeps them, and what is done then begins with that difference.
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(8) }));
    assert_eq!((document.parameters(), document.plant().step()), (changed.clone(), 2));
    grow(&mut document, 1, None);
    use espalier_proto::OperationKind::{Growth, Parameters};
    assert_eq!(kinds(&document), [Growth, Parameters, Growth]);
    while document.apply(&who("ann"), &plain(Action::Undo {})).is_ok() {}
    assert_eq!((document.parameters(), document.plant().step()), (seedling.clone(), 0));
    let nothing = problem(&mut document, &plain(Action::Undo {}));
    assert_eq!((nothing.code, nothing.message.as_str()), (ProblemCode::Refused, "there is nothing to undo"));
    while document.apply(&who("ann"), &plain(Action::Redo {})).is_ok() {}
    assert_eq!((document.parameters(), document.plant().step()), (changed.clone(), 3));
    // Undoing takes a difference back that nothing was done with.
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(3) }));
    assert_eq!(document.parameters(), changed);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.parameters(), seedling);
}

#[test]
fn lm11_the_oldest_futures_are_forgotten() {
    let mut document = tree();
    for round in 0..70 {
        apply(&mut document, &plain(Action::GoTo { step: round % 3 }));
        grow(&mut document, 3, None);
    }
    let futures = document.timeline().futures;
    assert_eq!(futures.len(), espalier_proto::version::MAX_FUTURES);
    for future in &futures {
        if let Some(on) = future.on {
            assert!(futures.iter().any(|other| other.future == on), "what others hang on stays");
        }
    }
    let saved = Document::from_bytes(&document.to_saved_bytes()).expect("our own bytes");
    assert_eq!((saved.timeline().futures.len(), saved.plant().hash()), (0, document.plant().hash()));
}

#[test]
fn lm11_changes_of_settings_are_counted() {
    let mut document = tree();
    apply(&mut document, &patch(0.46));
    let change = document.history.operations.last().expect("it was recorded").clone();
    let others = document.history.operations.len() - 1;
    document.history.operations.resize(others + MAX_SETS - 1, change);
    document.history.done = document.history.operations.len();
    apply(&mut document, &patch(0.47));
    let full = (ProblemCode::Refused, "kind".to_owned());
    assert_eq!(refusal(&mut document, &patch(0.48)), full);
    assert_eq!(refusal(&mut document, &place_in(None, &sphere(2.0), 30.0)), full);
    grow(&mut document, 1, None);
    let read = Document::from_bytes(&document.to_bytes()).expect("as much can be read");
    assert_eq!(read.hash(), document.hash());
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &patch(0.48));
}

#[test]
fn lm11_what_dies_in_a_future_counts_as_what_is_born() {
    let mut document = tree();
    let (living, branch) = (document.metamers() as usize, laterals(&document)[0]);
    apply(&mut document, &plain(Action::Prune { rows: list(vec![branch.raw()]) }));
    let cut = living - document.metamers() as usize;
    assert!(cut > 0);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::PlantSeed { position: Position::nearest(Vec3::X * 5.0) }));
    assert_eq!(document.futures.metamers(), cut);
}

#[test]
fn cm5_a_stroke_that_goes_on_after_a_cut_is_another_operation() {
    let mut document = tree();
    let stroke = |x: f32| {
        plain(Action::StrokeMove {
            stroke: 7,
            samples: list(vec![sample(x, 12.0, 4.0), sample(x, 16.0, 4.0)]),
        })
    };
    apply(&mut document, &plain(Action::StrokeBegin { stroke: 7, bud: None }));
    let lateral = laterals(&document)[0];
    document
        .apply(&who("bob"), &plain(Action::Prune { rows: list(vec![lateral.raw()]) }))
        .expect("it is a lateral");
    let cut = document.plant().hash();
    apply(&mut document, &stroke(3.0));
    apply(&mut document, &plain(Action::StrokeEnd { stroke: 7 }));
    let grown = document.plant().hash();
    assert_ne!(grown, cut, "the stroke grows something");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), cut, "undo takes back the stroke alone");
    apply(&mut document, &plain(Action::Undo {}));
    assert!(document.plant().is_alive(lateral), "and then the cut");
    let before = document.plant().hash();
    apply(&mut document, &plain(Action::Undo {}));
    assert_ne!(document.plant().hash(), before, "a stroke without growth is passed over");
    for _ in 0..3 {
        apply(&mut document, &plain(Action::Redo {}));
    }
    assert_eq!(document.plant().hash(), grown);
}

#[test]
fn tt2_scrubbing_to_where_one_is_ends_strokes() {
    let mut document = tree();
    apply(&mut document, &plain(Action::StrokeBegin { stroke: 7, bud: None }));
    let step = document.plant().step();
    apply(&mut document, &plain(Action::GoTo { step }));
    assert!(document.open_strokes(&who("ann")).is_empty());
}
