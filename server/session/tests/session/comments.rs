//! `CT`: where comments are pinned, as clients are told of it.

use espalier_proto::{
    ServerMessage,
    comment::{Pin, PinState},
};
use espalier_session::{Anchor, AnchorId, Input, Place};
use serde_json::json;

use crate::world::{Peer, World, grow};

fn pins(peer: &Peer) -> Vec<Vec<Pin>> {
    let told = |text: &ServerMessage| match text {
        ServerMessage::Pins { pins } => Some(pins.clone()),
        _ => None,
    };
    peer.texts.iter().filter_map(told).collect()
}

fn anchor(world: &mut World, row: u32) -> Option<Anchor> {
    world.handle(Input::Anchor(AnchorId(1), row));
    world.settle();
    world.anchors.pop().expect("it is answered")
}

/// A thread pinned to a row.
fn place(world: &mut World, thread: u32, row: u32) -> Place {
    let at = world.document().plant().metamers().end(espalier_plant::MetamerId::new(row as usize));
    Place { thread, anchor: anchor(world, row).expect("it lives"), at }
}

#[test]
fn ct2_everybody_is_told_where_pins_are_and_later_what_changed() {
    let mut world = World::new();
    let ann = world.join("ann-tablet");
    world.command(ann, 1, grow(9));
    world.settle();
    let (low, high) = (place(&mut world, 1, 2), place(&mut world, 2, 6));
    world.handle(Input::Commented { places: vec![low, high], threads: vec![2] });
    world.settle();
    let standing =
        |thread, row| Pin { thread, state: PinState::Standing, row: Some(row), step: None, line: None };
    assert_eq!(pins(world.peer(ann)), [vec![standing(1, 2), standing(2, 6)]]);
    let changed = ServerMessage::ThreadsChanged { threads: vec![2] };
    assert!(world.peer(ann).texts.contains(&changed));

    let ben = world.join("ben-tablet");
    assert_eq!(pins(world.peer(ben)), [vec![standing(1, 2), standing(2, 6)]], "after the welcome");
    world.command(ann, 2, grow(2));
    world.settle();
    assert_eq!(pins(world.peer(ann)).len(), 1, "growth moves no pin");
    world.command(ann, 3, json!({ "kind": "go_to", "step": 0 }));
    world.settle();
    let told = pins(world.peer(ben)).pop().expect("they have changed");
    assert!(told.iter().all(|pin| pin.state == PinState::NotYet && pin.step.is_some()), "{told:?}");
    world.command(ann, 4, json!({ "kind": "go_to", "step": 11 }));
    world.settle();
    assert_eq!(pins(world.peer(ben)).pop(), Some(vec![standing(1, 2), standing(2, 6)]));
}

#[test]
fn ct2_threads_that_are_gone_are_told_no_longer_and_pins_outlive_a_crash() {
    let mut world = World::new();
    let ann = world.join("ann-tablet");
    world.command(ann, 1, grow(6));
    world.settle();
    assert_eq!(anchor(&mut world, 100_000), None, "no such row");
    let (one, two) = (place(&mut world, 1, 2), place(&mut world, 2, 3));
    world.handle(Input::Commented { places: vec![one.clone(), two.clone()], threads: vec![1, 2] });
    world.handle(Input::Commented { places: vec![two.clone()], threads: vec![1] });
    world.settle();
    let ben = world.join("ben-tablet");
    let threads: Vec<_> = pins(world.peer(ben)).concat().iter().map(|pin| pin.thread).collect();
    assert_eq!(threads, [2]);
    let journaled = world.disk.len();
    world.crash();
    // The shell reads them again from its store.
    world.handle(Input::Commented { places: vec![two], threads: Vec::new() });
    let cy = world.join("cy-tablet");
    world.settle();
    assert_eq!(pins(world.peer(cy)).concat()[0].state, PinState::Standing);
    assert_eq!(world.disk.len(), journaled, "nothing of it is journaled");
}
