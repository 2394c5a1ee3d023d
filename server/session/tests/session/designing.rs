//! `DS`: what clients are told of designs.

use espalier_proto::{DesignInForce, DyedBlock, LimbOutline, PlacedBranch, Reason, ServerMessage};
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

/// What was told last of where branches stand, and of which one was asked.
fn branches(peer: &Peer) -> Option<(String, Vec<PlacedBranch>)> {
    peer.texts.iter().rev().find_map(|text| match text {
        ServerMessage::Branches { of, branches } => Some((of.as_str().to_owned(), branches.clone())),
        _ => None,
    })
}

fn look_at(of: Option<&str>) -> Value {
    let mut message = json!({ "type": "look_at_branch" });
    if let Some(of) = of {
        message["of"] = json!(of);
    }
    message
}

fn paths(branches: &[PlacedBranch]) -> Vec<&str> {
    branches.iter().map(|branch| branch.path.as_str()).collect()
}

#[test]
fn ds8_who_looks_at_a_branch_is_told_where_it_and_those_around_it_stand() {
    let mut world = World::new();
    let (ann, bob) = (world.join("birch-01"), world.join("maple-01"));
    let mut graph = small();
    graph["nodes"]["/"]["values"]["orders"] = json!({ "own": 2 });
    graph["nodes"]["/"]["values"]["height"] = json!({ "own": 40 });
    world.send(ann, &look_at(Some("/")));
    world.settle();
    assert_eq!(branches(world.peer(ann)).map(|(_, branches)| branches), Some(Vec::new()), "there is none");
    world.command(ann, 1, json!({ "kind": "new_design", "position": [6, 0, 0], "graph": graph }));
    world.settle();
    let (of, around) = branches(world.peer(ann)).expect("she is told");
    let limbs = told(world.peer(ann)).flatten().expect("it is told").laterals["/"].len();
    assert_eq!((of.as_str(), around.len()), ("/", 1 + limbs));
    let stem = &around[0];
    assert_eq!((stem.path.as_str(), stem.base, stem.length), ("/", [6.0, 0.0, 0.0], 40.0));
    assert_eq!((stem.frame, stem.bears), ([0.0, 0.0, 0.0, 1.0], limbs as u32));
    assert!(around[1..].iter().all(|limb| limb.base[1] > 1.0 && limb.length > 1.0 && !limb.outside));
    assert_eq!(branches(world.peer(bob)), None, "who does not look is told nothing");
    // A scale deeper: the limbs, and the branches of one.
    world.send(ann, &look_at(Some("/1")));
    world.settle();
    let (of, deeper) = branches(world.peer(ann)).expect("she is told");
    assert_eq!(of, "/1");
    assert_eq!(deeper[..around.len()], around[..]);
    assert!(deeper[around.len()..].iter().all(|branch| branch.path.as_str().starts_with("/1/")));
    assert_eq!(deeper.len() as u32, 1 + limbs as u32 + deeper[2].bears, "{:?}", paths(&deeper));
    // Whoever changes the design, and of a branch that sleeps: of the last one on the way to it that stands.
    world.command(bob, 1, roll("/1", 40.0));
    world.settle();
    let (_, rolled) = branches(world.peer(ann)).expect("she is told");
    assert_ne!(rolled[2].frame, deeper[2].frame);
    assert_eq!(rolled[1], deeper[1]);
    world.send(ann, &look_at(Some("/900/3")));
    world.settle();
    assert_eq!(paths(&branches(world.peer(ann)).expect("she is told").1), paths(&around));
    // Who looks away is told nothing more.
    world.send(ann, &look_at(None));
    world.command(bob, 2, roll("/1", 80.0));
    world.settle();
    assert_eq!(branches(world.peer(ann)).map(|(of, _)| of), Some("/900/3".to_owned()));
}

#[test]
fn ds9_a_branch_is_aimed_at_a_place() {
    let mut world = World::new();
    let ann = world.join("birch-01");
    world.send(ann, &look_at(Some("/")));
    world.command(ann, 1, begin());
    world.settle();
    let (_, before) = branches(world.peer(ann)).expect("she is told");
    let limb = before[1].clone();
    let tip = [limb.base[0] + 2.0, limb.base[1] + 1.0, limb.base[2] - 1.0];
    let aim = |node: &str, tip: [f32; 3], gesture: u32| {
        let edit = json!({ "edit": "aim", "node": node, "tip": tip });
        json!({ "kind": "edit_design", "edits": [edit], "gesture": gesture })
    };
    // A finger goes there by a detour: one operation.
    world.command(ann, 2, aim("/0", [tip[0] + 1.0, tip[1], tip[2]], 2));
    world.command(ann, 3, aim("/0", tip, 2));
    world.settle();
    let found = branches(world.peer(ann)).expect("she is told").1[1].clone();
    let length = (4.0f32 + 1.0 + 1.0).sqrt();
    assert!((found.length - length).abs() < 0.01, "{} for {length}", found.length);
    let along = glam::Quat::from_array(found.frame) * glam::Vec3::Y;
    let wanted = glam::Vec3::new(2.0, 1.0, -1.0).normalize();
    assert!(along.distance(wanted) < 0.01, "{along} for {wanted}");
    // Another gesture: back to where it began, all but on the outline, is on the outline.
    let along = glam::Quat::from_array(limb.frame) * glam::Vec3::Y * limb.length * 1.02;
    let end = [limb.base[0] + along.x, limb.base[1] + along.y, limb.base[2] + along.z];
    world.command(ann, 4, aim("/0", end, 4));
    world.settle();
    let back = branches(world.peer(ann)).expect("she is told").1[1].clone();
    assert!((back.length - limb.length).abs() < 0.01, "{} for {}", back.length, limb.length);
    world.command(ann, 5, json!({ "kind": "undo" }));
    world.settle();
    assert!((branches(world.peer(ann)).expect("she is told").1[1].length - length).abs() < 0.01);
    world.command(ann, 6, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(branches(world.peer(ann)).expect("she is told").1, before, "both places were one operation");
    // What cannot be aimed is refused, and nothing is done.
    for (command, (node, tip, reason)) in [
        ("/900", tip, Reason::DesignBranchGone),
        ("/0", limb.base, Reason::DesignRefused),
        ("/0", [5000.0, 0.0, 0.0], Reason::OutOfRange),
    ]
    .into_iter()
    .enumerate()
    {
        let command = 7 + command as u32;
        world.command(ann, command, aim(node, tip, command));
        world.settle();
        assert_eq!(refusal(world.peer(ann), command), Some(reason), "{node} {tip:?}");
    }
    assert_eq!(branches(world.peer(ann)).expect("she is told").1, before);
}

/// The limbs that a client was told of, with the rows that it asked for.
fn limbs(peer: &Peer) -> Vec<(u32, Option<LimbOutline>)> {
    let limb = |text: &ServerMessage| match text {
        ServerMessage::Limb { of, limb } => Some((*of, limb.clone().map(|limb| *limb))),
        _ => None,
    };
    peer.texts.iter().filter_map(limb).collect()
}

#[test]
fn ds13_who_looks_at_a_limb_is_told_it_once_and_alone() {
    let mut world = World::new();
    let (ann, bob) = (world.join("birch-01"), world.join("maple-01"));
    world.command(ann, 1, grow(9));
    world.settle();
    world.send(ann, &json!({ "type": "look_at_limb", "row": 1 }));
    world.settle();
    world.send(ann, &json!({ "type": "look_at_limb", "row": 99_999 }));
    world.settle();
    let told = limbs(world.peer(ann));
    let (of, limb) = told[0].clone();
    let limb = limb.expect("there is a trunk");
    assert_eq!((of, limb.row, limb.bearer, limb.base), (1, 1, None, [0.0; 3]));
    assert!(limb.length > 3.0 && limb.bears > 0, "{limb:?}");
    assert_eq!(told[1..], [(99_999, None)]);
    world.command(bob, 1, grow(1));
    world.settle();
    assert_eq!((limbs(world.peer(ann)).len(), limbs(world.peer(bob)).len()), (2, 0));
    // What is asked for while the tree grows is answered when it is at home again.
    world.work_ms = 40;
    world.command(bob, 2, grow(5));
    world.pass(20);
    world.send(ann, &json!({ "type": "look_at_limb", "row": limb.row }));
    world.settle();
    let later = limbs(world.peer(ann)).pop().and_then(|(_, limb)| limb).expect("it still stands");
    assert_eq!(later.row, limb.row);
    // What was told is what a refill asks for.
    world.command(
        ann,
        2,
        json!({
            "kind": "refill", "row": later.row, "envelope": later.envelope, "rotation": later.frame,
            "length": later.length, "anew": true,
        }),
    );
    world.pass(20);
    assert_eq!(world.peer(ann).refused().len(), 0);
    world.command(ann, 3, json!({ "kind": "stop" }));
    world.settle();
    assert_eq!(world.peer(ann).acknowledged().last(), Some(&3));
    assert_eq!(world.peer(ann).last_state().map(|state| state.pending_steps), Some(0));
    let hash = world.document().hash();
    assert_eq!(world.replayed_hash(), hash, "the journal alone gives the same document");
    world.crash();
    assert_eq!(world.document().hash(), hash, "snapshot and journal give the same document");
}

/// The colours of branches that were told last: how many, and of how many rows.
fn dyed(peer: &Peer) -> Option<(usize, u32)> {
    peer.texts.iter().rev().find_map(|text| match text {
        ServerMessage::Dyes { dyes, blocks } => {
            let of_block =
                |block: &DyedBlock| block.runs.iter().map(|[count, dye]| count * dye.min(&1)).sum::<u32>();
            Some((dyes.len(), blocks.iter().map(of_block).sum()))
        }
        _ => None,
    })
}

#[test]
fn ds14_all_are_told_the_colours_of_branches() {
    let mut world = World::new();
    let (ann, bob) = (world.join("birch-01"), world.join("maple-01"));
    world.command(ann, 1, begin());
    world.settle();
    assert_eq!(dyed(world.peer(bob)), None, "all are as the tree");
    let value = json!({ "own": { "bark": [1, 0.5, 0.5], "leaves": [2, 1, 0.5] } });
    let edit = json!({ "edit": "set", "of": "/1", "key": "material", "value": value });
    world.command(ann, 2, json!({ "kind": "edit_design", "edits": [edit] }));
    world.settle();
    let first = dyed(world.peer(bob)).expect("they are told");
    assert!(first.0 == 1 && first.1 > 2, "{first:?}");
    // Who comes later is told as well, also after a restart.
    let cy = world.join("rowan-01");
    world.settle();
    assert_eq!(dyed(world.peer(cy)), Some(first));
    world.crash();
    let ann = world.join("birch-01");
    world.settle();
    assert_eq!(dyed(world.peer(ann)), Some(first));
    world.command(ann, 3, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(dyed(world.peer(ann)), Some((0, 0)));
}
