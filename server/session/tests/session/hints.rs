//! `SG2`: who draws in vain is told.

use espalier_growth::REACH;
use espalier_proto::{Hint, HintReason, ServerMessage};
use serde_json::{Value, json};

use crate::{
    obstacles::{at, place},
    world::{World, grow},
};

fn hints(world: &World, client: u64) -> Vec<Hint> {
    let hint = |message: &ServerMessage| match message {
        ServerMessage::Hint { hint } => Some(hint.clone()),
        _ => None,
    };
    world.peer(client).texts.iter().filter_map(hint).collect()
}

/// Draws a stroke through these places as two moves; the number of the next command.
fn stroke(world: &mut World, client: u64, id: u32, places: [[f32; 3]; 2]) -> u32 {
    world.command(client, id, json!({ "kind": "stroke_begin", "stroke": 5 }));
    for (at, place) in (1..).zip(places) {
        let samples = vec![json!({ "position": place, "radius": 0.5 })];
        world.command(client, id + at, json!({ "kind": "stroke_move", "stroke": 5, "samples": samples }));
    }
    world.command(client, id + 3, json!({ "kind": "stroke_end", "stroke": 5 }));
    world.settle();
    id + 4
}

/// A square whose lower left corner is here.
fn square(x: f32, y: f32, side: f32) -> Value {
    let outline = vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
    let plane = json!({ "origin": [0.0, 0.0, 0.0], "right": [1.0, 0.0, 0.0], "up": [0.0, 1.0, 0.0] });
    json!({ "kind": "lasso", "outline": outline, "plane": plane, "depth": 1.0 })
}

#[test]
fn sg2_a_stroke_out_of_reach_is_hinted_at_once() {
    let mut world = World::new();
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    stroke(&mut world, birch, 1, [[0.0, 60.0, 0.0], [0.0, 70.0, 0.0]]);
    assert_eq!(world.document().metamers(), 0);
    let [hint] = &hints(&world, birch)[..] else { panic!("one hint for one stroke") };
    assert_eq!((hint.id, hint.stroke, hint.reason), (3, Some(5), HintReason::OutOfReach));
    assert_eq!(json!(hint.position), json!([0.0, 70.0, 0.0]));
    assert_eq!(hints(&world, maple), [], "others did not draw it");
}

#[test]
fn sg2_the_protocol_says_how_far_a_limb_comes() {
    let protocol = include_str!("../../../../proto/PROTOCOL.md");
    assert!(protocol.contains(&format!("no bud is within {REACH} internodes of where a stroke begins")));
}

#[test]
fn sg2_a_replay_hints_at_nothing() {
    let mut world = World::new();
    let client = world.join("birch-01");
    stroke(&mut world, client, 1, [[0.0, 60.0, 0.0], [0.0, 70.0, 0.0]]);
    world.crash();
    let client = world.join("birch-01");
    world.settle();
    assert_eq!(hints(&world, client), []);
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn sg2_what_grows_needs_no_hint() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let next = stroke(&mut world, client, 1, [[0.0, 1.0, 0.0], [0.0, 12.0, 0.0]]);
    // A limb connects to where this one begins.
    let next = stroke(&mut world, client, next, [[20.0, 10.0, 0.0], [24.0, 14.0, 0.0]]);
    world.command(client, next, square(-4.0, 8.0, 9.0));
    world.settle();
    assert!(world.document().metamers() > 40);
    assert_eq!(hints(&world, client), []);
}

#[test]
fn sg2_a_stroke_in_which_nothing_grew_is_hinted_at() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let block = json!({ "kind": "box", "size": [18.0, 18.0, 18.0] });
    world.command(client, 1, place(block, at(0.0, 12.0, 0.0)));
    world.command(client, 2, grow(1));
    world.settle();
    stroke(&mut world, client, 3, [[0.0, 12.0, 0.0], [0.0, 12.0, 0.0]]);
    let reasons: Vec<_> = hints(&world, client).iter().map(|hint| (hint.stroke, hint.reason)).collect();
    assert_eq!(reasons, [(Some(5), HintReason::NothingGrew)]);
}

#[test]
fn sg2_a_lasso_in_which_nothing_grows_says_why() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, square(60.0, 0.0, 10.0));
    world.settle();
    let [far] = &hints(&world, client)[..] else { panic!("one hint for one lasso") };
    assert_eq!((far.id, far.stroke, far.reason), (1, None, HintReason::OutOfReach));
    assert_eq!(json!(far.position), json!([60.0, 10.0, 0.0]));
}

#[test]
fn sg2_a_lasso_in_the_ground_is_not_out_of_reach() {
    let mut world = World::new();
    let client = world.join("birch-01");
    // An edge passes the seed; its corners are far.
    world.command(client, 1, square(-90.0, -181.0, 180.0));
    world.settle();
    let reasons: Vec<_> = hints(&world, client).iter().map(|hint| hint.reason).collect();
    assert_eq!(reasons, [HintReason::NothingGrew]);
}

#[test]
fn sg2_a_stroke_that_is_stopped_on_its_way_did_not_reach() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let ceiling = json!({ "kind": "box", "size": [120.0, 2.0, 120.0] });
    world.command(client, 1, place(ceiling, at(0.0, 9.0, 0.0)));
    world.settle();
    stroke(&mut world, client, 2, [[0.0, 1.0, 0.0], [0.0, 20.0, 0.0]]);
    assert!(world.document().metamers() > 0);
    let reasons: Vec<_> = hints(&world, client).iter().map(|hint| (hint.stroke, hint.reason)).collect();
    assert_eq!(reasons, [(Some(5), HintReason::DidNotReach)]);
}

#[test]
fn sg2_what_another_grows_hides_no_hint() {
    let mut world = World::new();
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    let block = json!({ "kind": "box", "size": [120.0, 2.0, 120.0] });
    world.command(birch, 1, place(block, at(0.0, 9.0, 0.0)));
    world.command(birch, 2, json!({ "kind": "stroke_begin", "stroke": 1 }));
    let sample = json!([{ "position": [0.0, 14.0, 0.0], "radius": 0.5 }]);
    world.command(birch, 3, json!({ "kind": "stroke_move", "stroke": 1, "samples": sample }));
    world.settle();
    stroke(&mut world, maple, 1, [[0.0, 1.0, 0.0], [4.0, 3.0, 0.0]]);
    world.command(birch, 4, json!({ "kind": "stroke_end", "stroke": 1 }));
    world.settle();
    let reasons: Vec<_> = hints(&world, birch).iter().map(|hint| (hint.stroke, hint.reason)).collect();
    assert_eq!(reasons, [(Some(1), HintReason::DidNotReach)]);
    assert_eq!(hints(&world, maple), []);
}

/// A wall far wider and higher than the plant, between it and x = 8.
fn barrier() -> Value {
    place(json!({ "kind": "box", "size": [1.0, 300.0, 300.0] }), at(7.5, 0.0, 0.0))
}

#[test]
fn sg2_a_stroke_or_lasso_that_no_way_leads_to_is_hinted_at() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, barrier());
    world.command(client, 2, grow(6));
    world.settle();
    let before = world.document().metamers();
    let next = stroke(&mut world, client, 3, [[4.0, 5.0, 0.0], [20.0, 8.0, 0.0]]);
    let next = stroke(&mut world, client, next, [[15.0, 5.0, 0.0], [24.0, 8.0, 0.0]]);
    world.command(client, next, square(12.0, 2.0, 10.0));
    world.settle();
    let reasons: Vec<_> = hints(&world, client).iter().map(|hint| (hint.stroke, hint.reason)).collect();
    let stuck = |stroke| (stroke, HintReason::DidNotReach);
    assert_eq!(
        reasons,
        [stuck(Some(5)), (Some(5), HintReason::NothingGrew), (None, HintReason::NothingGrew)]
    );
    let grown = world.document().metamers() - before;
    assert!(grown < 40, "no limb goes to and fro: {grown}");
}

#[test]
fn sg2_a_lasso_that_growth_only_comes_near_to_was_not_reached() {
    let mut world = World::new();
    let client = world.join("birch-01");
    // A slit that is seen through, too narrow for wood.
    for (id, z) in [(1, -150.15), (2, 150.15)] {
        let half = json!({ "kind": "box", "size": [1.0, 300.0, 300.0] });
        world.command(client, id, place(half, at(7.5, 0.0, z)));
    }
    world.settle();
    world.command(client, 3, square(12.0, 2.0, 10.0));
    world.settle();
    assert!((1..40).contains(&world.document().metamers()), "{}", world.document().metamers());
    let reasons: Vec<_> = hints(&world, client).iter().map(|hint| hint.reason).collect();
    assert_eq!(reasons, [HintReason::DidNotReach]);
}

#[test]
fn sg2_a_lasso_behind_a_wall_is_reached_around_it() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, place(json!({ "kind": "box", "size": [2.0, 16.0, 12.0] }), at(8.0, 8.0, 0.0)));
    world.command(client, 2, grow(4));
    world.settle();
    world.command(client, 3, square(12.0, 2.0, 10.0));
    world.settle();
    assert_eq!(hints(&world, client), []);
    assert!(world.document().metamers() > 100, "{}", world.document().metamers());
}

#[test]
fn sg2_a_speck_of_an_outline_is_reached() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (id, side) in [(1, 0.05), (2, 0.5), (3, 1.0)] {
        world.command(client, id, square(f32::from(id as u8) * 4.0 - 8.0, 9.0, side));
        world.settle();
    }
    assert_eq!(hints(&world, client), []);
}
