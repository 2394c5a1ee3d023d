//! `DS`: what clients are told of designs.

use espalier_proto::{DesignInForce, Reason, ServerMessage};
use serde_json::{Value, json};

use crate::world::{Peer, World, grow};

/// What was told last of the design, if anything was.
fn told(peer: &Peer) -> Option<Option<DesignInForce>> {
    peer.texts.iter().rev().find_map(|text| match text {
        ServerMessage::Design { design } => Some(design.clone().map(|design| *design)),
        _ => None,
    })
}

fn refusal(peer: &Peer, command: u32) -> Option<Reason> {
    peer.texts.iter().find_map(|text| match text {
        ServerMessage::Refused { id, problem } if *id == command => Some(problem.reason),
        _ => None,
    })
}

fn small() -> Value {
    json!({ "version": 1, "nodes": { "/": { "values": { "height": { "own": 12 }, "orders": { "own": 1 } } } } })
}

fn begin() -> Value {
    json!({ "kind": "new_design", "position": [6, 0, 0], "graph": small() })
}

fn roll(of: &str, roll: f32) -> Value {
    let edit = json!({ "edit": "set", "of": of, "key": "roll", "value": { "own": roll } });
    json!({ "kind": "edit_design", "edits": [edit] })
}

#[test]
fn ds4_all_are_told_the_design_and_each_change_of_it() {
    let mut world = World::new();
    let (ann, bob) = (world.join("birch-01"), world.join("maple-01"));
    world.settle();
    assert_eq!(told(world.peer(ann)), None, "there is none");
    world.command(ann, 1, begin());
    world.settle();
    let first = told(world.peer(bob)).flatten().expect("it is told");
    assert_eq!((first.at.get().x, first.values, first.steps_on_top), (6.0, 2, 0));
    assert!(first.branches > 3 && first.asleep.is_empty());
    let limbs = &first.laterals["/"];
    assert_eq!(limbs.len() as u32, first.branches - 1, "it has limbs alone");
    assert_eq!(first.laterals.len(), limbs.len() + 1);
    world.command(bob, 1, roll("/1", 40.0));
    world.settle();
    let second = told(world.peer(ann)).flatten().expect("it is told");
    assert_eq!(second.values, 3);
    assert_eq!(second.graph.get()["nodes"]["/1"]["values"]["roll"]["own"], json!(40.0));
    // Who comes later is told as well.
    let cy = world.join("rowan-01");
    world.settle();
    assert_eq!(told(world.peer(cy)).flatten(), Some(second.clone()));
    // What grows on top is told, and seals it.
    world.command(ann, 2, grow(2));
    world.command(ann, 3, roll("/1", 50.0));
    world.settle();
    let sealed = told(world.peer(bob)).flatten().expect("it is told");
    assert_eq!((sealed.steps_on_top, &sealed.graph), (2, &second.graph));
    assert_eq!(refusal(world.peer(ann), 3), Some(Reason::DesignSealed));
    world.command(ann, 4, json!({ "kind": "release_design" }));
    world.settle();
    assert_eq!(told(world.peer(bob)), Some(None));
}

#[test]
fn ds5_a_design_lives_through_a_restart() {
    let mut world = World::new();
    let ann = world.join("birch-01");
    world.command(ann, 1, begin());
    world.command(ann, 2, roll("/1", 40.0));
    world.settle();
    let before = (told(world.peer(ann)), world.document().hash());
    world.crash();
    let ann = world.join("birch-01");
    world.settle();
    assert_eq!((told(world.peer(ann)), world.document().hash()), before);
}
