//! `CM11`: how a client learns that all it asked for is done.

use serde_json::json;

use crate::{
    guiding::lasso,
    world::{World, grow},
};

#[test]
fn cm11_done_is_told_once_growth_has_ended_with_the_figures_before_it() {
    let mut world = World::new();
    world.work_ms = 40;
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    world.command(birch, 1, grow(20));
    world.command(birch, 2, lasso(9.0, 20.0, None));
    world.pass(150);
    assert_eq!(world.peer(birch).acknowledged().last(), Some(&2), "both are durable");
    assert_eq!(world.peer(birch).done(), [], "and growth goes on");
    world.settle();
    let done = world.peer(birch).done();
    assert_eq!(done.len(), 1);
    assert_eq!((done[0].0, done[0].1.pending_steps), (2, 0));
    assert_eq!(done[0].1.metamers, world.document().figures().metamers, "the newest figures come before it");
    assert_eq!(world.peer(maple).done(), [], "who asked for nothing hears nothing");
}

#[test]
fn cm11_who_is_done_hears_so_while_others_grow() {
    let mut world = World::new();
    world.work_ms = 40;
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    world.command(birch, 1, grow(2));
    world.command(maple, 1, grow(500));
    world.pass(500);
    let done = world.peer(birch).done();
    assert_eq!(done.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [1]);
    assert!(done[0].1.pending_steps > 0, "the other one is not");
    assert_eq!(world.peer(maple).done(), []);
}

#[test]
fn cm11_nothing_is_done_before_it_is_durable() {
    let mut world = World::new();
    world.write_ms = 5_000;
    let client = world.join("birch-01");
    world.command(client, 1, grow(1));
    world.pass(4_000);
    assert_eq!(world.document().figures().step, 1, "it has grown");
    assert_eq!(world.peer(client).done(), []);
    world.pass(2_000);
    assert_eq!(world.peer(client).done().len(), 1);
}

#[test]
fn cm11_refused_commands_are_done_as_well() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(0));
    assert_eq!(world.peer(client).refused().len(), 1);
    world.settle();
    world.command(client, 2, json!({ "kind": "redo" }));
    world.settle();
    let done: Vec<_> = world.peer(client).done().into_iter().map(|(id, _)| id).collect();
    assert_eq!((done, world.peer(client).refused().len()), (vec![1, 2], 2));
}

#[test]
fn cm11_who_comes_back_is_told_again() {
    let mut world = World::new();
    world.work_ms = 40;
    let client = world.join("birch-01");
    world.command(client, 1, grow(30));
    world.pass(60);
    world.leave(client);
    let back = world.join("birch-01");
    assert_eq!((world.peer(back).welcome_acknowledged(), world.peer(back).done()), (1, vec![]));
    world.settle();
    assert_eq!(world.peer(back).done().len(), 1);
    // What was told on a connection that was lost may never have arrived.
    world.leave(back);
    let again = world.join("birch-01");
    world.settle();
    assert_eq!(world.peer(again).done()[0].0, 1);
    // A restart takes nothing of it back.
    world.crash();
    let later = world.join("birch-01");
    world.settle();
    assert_eq!(world.peer(later).done()[0].0, 1);
}
