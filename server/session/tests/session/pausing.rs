//! Growth that rests: for want of memory (`LM19`), and because the server did not outlive it (`OP5`).

use espalier_proto::{DocumentState, Pause, ServerMessage};
use espalier_session::{Input, ReadId, Tail};
use serde_json::{Value, json};

use crate::world::{World, grow};

/// The plants after these commands where there is room for everything.
fn grown(commands: &[Value]) -> u64 {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (command, id) in commands.iter().zip(1..) {
        world.command(client, id, command.clone());
    }
    world.settle();
    world.document().hash()
}

fn state(world: &World, client: u64) -> DocumentState {
    world.peer(client).last_state().unwrap()
}

fn stroke(number: u32) -> [Value; 3] {
    let samples: Vec<Value> = (1..6)
        .map(|step| json!({ "position": [0.5 * step as f32, 2.0 * step as f32, 0], "radius": 2 }))
        .collect();
    [
        json!({ "kind": "stroke_begin", "stroke": number }),
        json!({ "kind": "stroke_move", "stroke": number, "samples": samples }),
        json!({ "kind": "stroke_end", "stroke": number }),
    ]
}

#[test]
fn lm19_growth_rests_while_there_is_no_room_and_then_goes_on_as_if_it_had_not() {
    let mut world = World::new();
    let client = world.join("birch-01");
    // A step may add some 1,000 rows to few.
    world.room = [1500, 1500];
    world.command(client, 1, grow(40));
    world.command(client, 2, grow(3));
    world.settle();
    let resting = state(&world, client);
    assert_eq!(resting.paused, Some(Pause::Memory));
    assert!(resting.pending_steps > 3 && resting.metamers < 1500, "{resting:?}");
    assert_eq!(world.peer(client).acknowledged().last(), Some(&2), "what waits is durable all the same");
    // It asks again and again, and everybody who comes meanwhile sees what there is.
    world.pass(20_000);
    assert_eq!(state(&world, client), resting);
    let other = world.join("maple-01");
    world.settle();
    world.assert_mirrored(other);

    world.room = [u64::MAX; 2];
    world.pass(1100);
    world.settle();
    assert_eq!(state(&world, client).paused, None);
    assert_eq!(world.peer(client).done().last().map(|(id, _)| *id), Some(2));
    assert_eq!(world.document().hash(), grown(&[grow(40), grow(3)]));
    world.assert_mirrored(other);
}

#[test]
fn lm19_people_who_come_do_not_put_off_growth_that_rests() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.room = [1500, 1500];
    world.command(client, 1, grow(40));
    world.settle();
    assert_eq!(state(&world, client).paused, Some(Pause::Memory));
    world.room = [u64::MAX; 2];
    for key in ["maple-01", "maple-02", "maple-03", "maple-04"] {
        world.join(key);
        world.pass(400);
    }
    world.settle();
    assert_eq!((state(&world, client).paused, state(&world, client).step), (None, 40));
}

#[test]
fn lm19_who_draws_goes_on_where_growth_rests() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.room = [0, u64::MAX];
    for (command, id) in stroke(1).into_iter().zip(1..) {
        world.command(client, id, command);
    }
    world.settle();
    let drawn = state(&world, client);
    assert!(drawn.paused.is_none() && drawn.metamers > 5, "{drawn:?}");
    world.command(client, 4, grow(5));
    world.settle();
    let resting = state(&world, client);
    assert_eq!((resting.paused, resting.metamers), (Some(Pause::Memory), drawn.metamers));
}

#[test]
fn lm19_growth_that_rests_can_be_stopped_and_what_follows_is_done() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.room = [1500, 1500];
    world.command(client, 1, grow(1000));
    world.settle();
    let resting = state(&world, client);
    assert_eq!(resting.paused, Some(Pause::Memory));
    world.command(client, 2, json!({ "kind": "stop" }));
    world.settle();
    let stopped = state(&world, client);
    assert_eq!((stopped.paused, stopped.pending_steps), (None, 0));
    assert!(stopped.step <= resting.step + 4, "{} after {}", stopped.step, resting.step);
    world.command(client, 3, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(state(&world, client).step, 0);
    assert_eq!(world.replayed_hash(), world.document().hash());
}

#[test]
fn lm19_a_session_that_is_opened_again_grows_no_further_than_there_is_room() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(30));
    world.command(client, 2, json!({ "kind": "ungrow", "steps": 2 }));
    world.command(client, 3, grow(4));
    world.settle();
    let hash = world.document().hash();
    assert!(state(&world, client).metamers > 2000);
    world.room = [1500, 1500];
    world.crash();
    let client = world.join("birch-01");
    world.settle();
    let resting = state(&world, client);
    assert_eq!((resting.paused, world.peer(client).welcome_acknowledged()), (Some(Pause::Memory), 3));
    assert!(resting.metamers < 1500, "{resting:?}");
    world.room = [u64::MAX; 2];
    world.pass(1100);
    world.settle();
    assert_eq!(world.document().hash(), hash);
    assert_eq!(state(&world, client).paused, None);
}

#[test]
fn lm19_a_prediction_without_room_is_answered_with_a_problem() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(5));
    world.settle();
    world.room = [0, 0];
    world.send(client, &json!({ "type": "predict", "rows": [], "steps": 5 }));
    world.settle();
    let reasons: Vec<_> = world.peer(client).problems().into_iter().map(|problem| problem.reason).collect();
    assert_eq!(reasons, [espalier_proto::Reason::MemoryFull]);
    assert!(world.peer(client).ghosts.is_empty());
}

#[test]
fn op2_what_rests_for_want_of_memory_is_read_once_it_is_done() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(8));
    world.settle();
    world.pass(40_000);
    assert!(world.snapshot.is_some());
    let rotation = json!([0.0, 0.6, 0.0, 0.8]);
    let graft = json!({ "kind": "graft", "row": 4, "onto": 1, "rotation": rotation, "keep": true });
    world.command(client, 2, graft);
    world.settle();
    assert_eq!(world.peer(client).refused(), []);
    world.room = [0, 0];
    world.crash();
    assert_eq!(world.session.paused(), Some(Pause::Memory));
    world.handle(Input::Read(ReadId(1)));
    world.pass(3_000);
    assert!(world.documents.is_empty(), "what was acknowledged is not in it");
    world.room = [u64::MAX; 2];
    world.pass(3_000);
    let (_, read) = world.documents.pop().expect("it can be read");
    assert_eq!(read.through, 2);
}

#[test]
fn op5_what_the_server_did_not_outlive_waits_until_somebody_says_go_on() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(20));
    world.command(client, 2, grow(3));
    world.settle();
    let (hash, entries) = (world.document().hash(), world.disk.len());
    world.crash_to(Tail::Waits);
    assert_eq!(world.session.paused(), Some(Pause::Crashes));
    let client = world.join("birch-01");
    world.settle();
    let waiting = state(&world, client);
    assert_eq!((waiting.paused, waiting.step, waiting.pending_steps), (Some(Pause::Crashes), 0, 23));
    assert_eq!(world.peer(client).welcome_acknowledged(), 2, "nothing is lost");
    // What is done meanwhile waits behind it, and no clock sets it off.
    world.command(client, 3, grow(1));
    world.pass(120_000);
    assert_eq!((state(&world, client).step, world.disk.len()), (0, entries + 1));
    // A server that stops leaves it as it is.
    world.handle(Input::Stopping);
    world.pass(60_000);
    assert_eq!((world.disk.len(), world.session.paused()), (entries + 1, Some(Pause::Crashes)));

    world.handle(Input::GoOn);
    world.settle();
    let done = state(&world, client);
    assert_eq!((done.paused, done.step, done.pending_steps), (None, 24, 0));
    assert_ne!(world.document().hash(), hash, "a step more");
    assert_eq!(world.replayed_hash(), world.document().hash());
}

#[test]
fn op5_growth_that_waits_can_be_stopped_before_it_goes_on() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(20));
    world.settle();
    world.crash_to(Tail::Waits);
    let client = world.join("birch-01");
    world.command(client, 2, json!({ "kind": "stop" }));
    world.settle();
    assert_eq!(state(&world, client).step, 0);
    world.handle(Input::GoOn);
    world.settle();
    let stopped = state(&world, client);
    assert!(stopped.step <= 4 && stopped.paused.is_none(), "{stopped:?}");
    assert_eq!(world.replayed_hash(), world.document().hash());
}

#[test]
fn op5_without_anything_that_waits_a_session_opens_as_ever() {
    let mut world = World::new();
    world.crash_to(Tail::Waits);
    assert_eq!(world.session.paused(), None);
    let client = world.join("birch-01");
    world.command(client, 1, grow(2));
    world.settle();
    assert_eq!(state(&world, client).step, 2);
    // The key is absent where nothing rests.
    let texts = world.peer(client).texts.iter().filter(|text| matches!(text, ServerMessage::State { .. }));
    assert!(texts.map(|text| serde_json::to_string(text).unwrap()).all(|text| !text.contains("paused")));
}
