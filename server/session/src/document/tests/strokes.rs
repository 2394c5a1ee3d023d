//! Strokes that are saved while they are drawn: snapshots are made at any time, and journals go on behind them.

use proptest::prelude::*;

use super::{
    arranging::{place, sphere},
    *,
};

/// A place of the brush: beside, up, radius.
fn moves() -> impl Strategy<Value = Vec<(f32, f32, f32)>> {
    prop::collection::vec((-6f32..6.0, 0.3f32..14.0, 0f32..3.0), 3..7)
}

fn draw(document: &mut Document, stroke: u32, &(x, y, radius): &(f32, f32, f32)) {
    let samples = list(vec![sample(x, y, radius)]);
    apply(document, &plain(Action::StrokeMove { stroke, samples }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_stroke_saved_anywhere_goes_on_as_if_it_had_not_been(
        one in moves(),
        other in moves(),
        ball in (-5f32..5.0, 0.5f32..3.0),
    ) {
        let mut document = tree();
        apply(&mut document, &place(&sphere(ball.1), ball.0));
        for stroke in [1, 2] {
            apply(&mut document, &plain(Action::StrokeBegin { stroke, bud: None }));
        }
        let mut opened: Vec<Document> = Vec::new();
        let turns = one.iter().map(|place| (1, place)).zip(other.iter().map(|place| (2, place)));
        for (stroke, place) in turns.flat_map(|(one, other)| [one, other]) {
            let again = Document::from_bytes(&document.to_bytes()).expect("our own bytes");
            prop_assert_eq!(again.simulation.state(), document.simulation.state());
            opened.push(again);
            opened.iter_mut().chain([&mut document]).for_each(|each| draw(each, stroke, place));
        }
        for each in opened.iter_mut().chain([&mut document]) {
            apply(each, &plain(Action::StrokeEnd { stroke: 2 }));
            apply(each, &plain(Action::StrokeEnd { stroke: 1 }));
        }
        for (turn, each) in opened.iter().enumerate() {
            prop_assert_eq!(each.hash(), document.hash(), "saved before move {}", turn);
        }
    }
}

#[test]
fn st1_a_stroke_that_settles_is_pending_until_it_is_done_or_stopped() {
    let settle = |stopped: bool| {
        let mut document = tree();
        apply(&mut document, &plain(Action::StrokeBegin { stroke: 1, bud: None }));
        draw(&mut document, 1, &(0.0, 8.0, 8.0));
        let drawn = document.metamers();
        document.begin(&who("ann"), &plain(Action::StrokeEnd { stroke: 1 })).expect("it was begun");
        let mut pending = vec![document.pending_steps()];
        document.stop_at(stopped.then(|| document.steps_begun() + 1));
        while document.advance() {
            pending.push(document.pending_steps());
        }
        (drawn, document.metamers(), pending)
    };
    let (drawn, whole, pending) = settle(false);
    let (_, stopped, briefly) = settle(true);
    assert!(drawn < stopped && stopped < whole, "{drawn} drawn, {stopped} when stopped, {whole} in all");
    for (pending, least) in [(pending, 3), (briefly, 2)] {
        let (last, before) = pending.split_last().expect("it was begun");
        assert!(*last == 0 && before.len() >= least && before.iter().all(|&steps| steps == 1), "{pending:?}");
    }
}
