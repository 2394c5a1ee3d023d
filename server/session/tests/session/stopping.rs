//! `ST`: growth that somebody ends.

use espalier_proto::Reason;
use espalier_session::{Input, ReadId, Tail};
use serde_json::{Value, json};

use crate::{
    guiding::lasso,
    world::{World, grow, person},
};

fn stop() -> Value {
    json!({ "kind": "stop" })
}

fn check_replays(world: &mut World) {
    let hash = world.document().hash();
    assert_eq!(world.replayed_hash(), hash, "the journal alone gives the same document");
    world.crash();
    assert_eq!(world.document().hash(), hash, "snapshot and journal give the same document");
}

#[test]
fn st1_growth_ends_and_stays_as_it_is() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.work_ms = 40;
    world.command(client, 1, grow(1000));
    world.pass(130);
    let under_way = world.peer(client).last_state().unwrap();
    assert!(under_way.pending_steps > 900);
    world.command(client, 2, stop());
    world.settle();
    let state = world.peer(client).last_state().unwrap();
    assert!(state.step > 4 && state.step <= 20, "{state:?}");
    assert_eq!(state.pending_steps, 0);
    assert_eq!(world.peer(client).acknowledged().last(), Some(&2));
    // What comes later grows as ever, and what was grown is one operation.
    world.command(client, 3, grow(3));
    world.command(client, 4, json!({ "kind": "undo" }));
    world.command(client, 5, json!({ "kind": "undo" }));
    world.command(client, 6, json!({ "kind": "redo" }));
    world.settle();
    assert_eq!(world.document().figures().step, state.step);
    check_replays(&mut world);
}

#[test]
fn st1_growth_that_waits_does_not_begin() {
    let mut world = World::new();
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    world.command(birch, 1, grow(500));
    world.command(birch, 2, lasso(9.0, 20.0, None));
    world.command(birch, 3, grow(500));
    world.command(maple, 1, stop());
    world.command(birch, 4, grow(2));
    world.settle();
    let step = world.document().figures().step;
    assert!((2..=6).contains(&step), "{step} steps were run");
    check_replays(&mut world);
}

#[test]
fn st1_a_lasso_can_be_stopped() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, lasso(25.0, 40.0, None));
    world.pass(4);
    world.command(client, 2, stop());
    world.settle();
    let stopped = world.document().metamers();
    assert!(stopped > 0);
    world.command(client, 3, json!({ "kind": "undo" }));
    world.command(client, 4, lasso(25.0, 40.0, None));
    world.settle();
    assert!(world.document().metamers() > 2 * stopped, "unstopped it goes on");
    check_replays(&mut world);
}

#[test]
fn st1_with_nothing_to_stop_nothing_happens() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, stop());
    world.command(client, 2, grow(10));
    world.settle();
    // The count a client gives is not taken for true: what is done stays done, in a replay as well.
    world.text(client, r#"{"type":"command","id":3,"command":{"kind":"stop","tick":0}}"#);
    world.settle();
    assert_eq!(world.peer(client).refused(), []);
    assert_eq!(world.document().figures().step, 10);
    check_replays(&mut world);
}

#[test]
fn st1_a_stop_lost_in_a_crash_stops_nothing() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(30));
    world.pass(6);
    world.write_ms = 1_000_000;
    world.command(client, 2, stop());
    world.pass(50);
    world.crash();
    world.write_ms = 5;
    assert_eq!(world.document().figures().step, 30);
    check_replays(&mut world);
}

#[test]
fn st1_growth_that_a_crash_interrupted_goes_on_and_can_be_stopped() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(3));
    world.command(client, 2, json!({ "kind": "stroke_begin", "stroke": 1 }));
    world.command(client, 3, json!({ "kind": "stroke_end", "stroke": 1 }));
    world.command(client, 4, grow(1000));
    world.command(client, 5, grow(2));
    world.pass(30);
    world.crash_to(Tail::Follows);
    // What was asked for is all there to be seen as people come, and the growth that nobody stopped has hardly begun.
    let client = world.join("birch-01");
    assert_eq!(world.peer(client).welcome_acknowledged(), 5);
    world.handle(Input::Read(ReadId(1)));
    world.pass(10);
    let state = world.peer(client).last_state().unwrap();
    assert!(state.pending_steps > 900 && state.step < 100, "{state:?}");
    world.command(client, 6, stop());
    world.settle();
    let state = world.peer(client).last_state().unwrap();
    assert!(state.step < 120 && state.pending_steps == 0, "{state:?}");
    let (_, read) = world.documents.pop().expect("it was read");
    assert_eq!(read.through, 5, "all that was asked for before the crash is in what is read");
    check_replays(&mut world);
}

#[test]
fn cm5_what_a_crash_let_begin_again_ends_if_nobody_returns() {
    let mut world = World::new();
    let ann = world.join("birch-01");
    world.command(ann, 1, grow(1000));
    world.command(ann, 2, json!({ "kind": "stroke_begin", "stroke": 1 }));
    world.pass(30);
    // Growth that nobody stopped is what is done first, and the stroke begins only after the session was opened.
    world.crash_to(Tail::Follows);
    let maple = world.join("maple-01");
    assert!(!world.session.has_caught_up());
    world.command(maple, 1, stop());
    world.settle();
    assert!(world.session.has_caught_up());
    assert_eq!(world.document().open_strokes(&person("birch-01")), [1]);
    world.pass(31_000);
    world.settle();
    assert!(world.document().open_strokes(&person("birch-01")).is_empty());
}

#[test]
fn st1_a_long_step_of_a_grammar_can_be_stopped() {
    let large = "slider: a 1 9\na = 1\naxiom: F(a)B\nB --> BB\n";
    let set = |text: &str, depth: u32| json!({ "kind": "set_grammar", "text": text, "depth": depth });
    for passes in [1, 2, 3, 5, 8] {
        let mut world = World::new();
        let client = world.join("birch-01");
        world.command(client, 1, set("axiom: F(2)A\nA --> F\n", 1));
        world.settle();
        let before = world.document().plant().hash();
        world.work_ms = 40;
        world.command(client, 2, set(large, 20));
        world.pass(passes * 30);
        world.command(client, 3, stop());
        world.settle();
        assert_eq!(world.peer(client).acknowledged().last(), Some(&3));
        assert_eq!(world.peer(client).last_state().map(|state| state.pending_steps), Some(0));
        let stands = world.document().plant().hash();
        let depth = world.document().grammar_depth().map(|(depth, _)| depth);
        assert!(stands == before && depth == Some(1) || depth == Some(20), "all of it or nothing: {depth:?}");
        world.command(client, 4, json!({ "kind": "derive", "steps": 1 }));
        world.settle();
        check_replays(&mut world);
    }
}

#[test]
fn st1_a_design_that_is_fitted_can_be_stopped() {
    for passes in [2, 4, 9] {
        let mut world = World::new();
        let client = world.join("birch-01");
        world.command(client, 1, grow(8));
        world.settle();
        let before = world.document().plant().hash();
        world.work_ms = 40;
        world.command(client, 2, json!({ "kind": "fit_design" }));
        world.pass(passes * 60);
        let state = world.peer(client).last_state().unwrap();
        assert!(state.trials > 1 && state.pending_steps >= state.trials, "{state:?}");
        world.command(client, 3, stop());
        world.settle();
        assert_eq!(world.peer(client).acknowledged().last(), Some(&3));
        let state = world.peer(client).last_state().unwrap();
        assert!(state.trials == 0 && state.pending_steps == 0, "{state:?}");
        assert_eq!(world.document().plant().hash(), before, "nothing of it is there");
        let refused = world.peer(client).refused();
        let reasons: Vec<_> = refused.iter().map(|(id, problem)| (*id, problem.reason)).collect();
        assert_eq!(reasons, [(2, Reason::FitStopped)], "who asked for it is told");
        world.command(client, 4, grow(2));
        world.settle();
        check_replays(&mut world);
    }
}
