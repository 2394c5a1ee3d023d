//! `BE`, `WI`, `TT`, `PD`: what clients see of bends, widths, lines of time and predictions.

use espalier_plant::MetamerId;
use espalier_proto::{Frame, OperationKind, ProblemCode, ServerMessage, Timeline, WidthConstraint};
use serde_json::{Value, json};

use crate::{
    mirror::Mirror,
    world::{Peer, World, grow},
};

/// Some wood far from the foot of the tree, and wood six metamers below it.
pub fn limb(world: &World) -> (u32, u32) {
    let plant = world.document().plant();
    let down = |id: MetamerId| std::iter::successors(Some(id), |&id| plant.metamers().parent(id));
    let rows = (0..plant.metamer_count()).rev().map(MetamerId::new).filter(|&id| plant.is_alive(id));
    let mut tall = rows.filter(|&id| down(id).count() > 9);
    let top = tall.next().expect("the tree is tall enough");
    (top.raw(), down(top).nth(6).expect("it stands higher").raw())
}

fn begin(world: &World) -> Value {
    let (top, base) = limb(world);
    json!({ "kind": "bend_begin", "bend": 1, "base": base, "touches": vec![top], "stretch": 0.1 })
}

fn drag(x: f32) -> Value {
    json!({ "kind": "bend_move", "bend": 1, "targets": vec![[x, 6.0, 0.0]] })
}

/// The timeline as a client has it that was told it once, and then what changed (`TT6`).
pub fn timeline(peer: &Peer) -> Timeline {
    let notified = peer.texts.iter().fold(None, |timeline: Option<Timeline>, text| match text {
        ServerMessage::Timeline(whole) => Some(Timeline::clone(whole)),
        ServerMessage::TimelineChanged(change) => {
            let mut timeline = timeline.expect("TT1: the whole comes first");
            timeline.change(change.as_ref().clone());
            Some(timeline)
        }
        _ => timeline,
    });
    notified.expect("TT1: it follows the welcome")
}

fn widths(peer: &Peer) -> Option<Vec<WidthConstraint>> {
    peer.texts.iter().rev().find_map(|text| match text {
        ServerMessage::Widths { widths } => Some(widths.clone()),
        _ => None,
    })
}

/// A tree in a session, and two who look at it.
pub fn grown() -> (World, u64, u64) {
    let mut world = World::new();
    let (ann, bob) = (world.join("birch-01"), world.join("maple-01"));
    world.command(ann, 1, grow(9));
    world.settle();
    (world, ann, bob)
}

#[test]
fn be5_while_a_branch_is_dragged_only_its_frames_travel() {
    let (mut world, ann, bob) = grown();
    let frames = world.peer(bob).frames.len();
    let begun = begin(&world);
    world.command(ann, 2, begun);
    for part in 0..5 {
        world.command(ann, 3 + part, drag(part as f32));
        world.pass(20);
    }
    world.settle();
    let peer = world.peer(bob);
    assert_eq!(peer.frames.len(), frames, "no row changed");
    let last = peer.bend_frames.last().expect("frames came").clone();
    assert_eq!(peer.bend_frames.len(), 5);
    assert_eq!(last.motions.len(), 7, "one for each metamer of the path");
    assert_eq!(last.motions[0].rotation, [0.0, 0.0, 0.0, 1.0], "the base does not move");
    let carol = world.join("aspen-01");
    world.settle();
    assert_eq!(world.peer(carol).bend_frames.last().map(|frame| &frame.motions), Some(&last.motions));
    world.command(ann, 8, json!({ "kind": "bend_end", "bend": 1 }));
    world.settle();
    for client in [ann, bob, carol] {
        let over = world.peer(client).bend_frames.last().expect("it is over");
        assert_eq!((over.bend, over.motions.len()), (last.bend, 0));
        assert!(world.peer(client).frames.len() > usize::from(client == bob) * frames);
        world.assert_mirrored(client);
    }
    let kinds: Vec<_> = timeline(world.peer(bob)).operations.iter().map(|op| op.kind).collect();
    assert_eq!(kinds, [OperationKind::Growth, OperationKind::Bend]);
}

#[test]
fn be5_slow_clients_get_the_newest_frame_alone() {
    let (mut world, ann, bob) = grown();
    world.peer_mut(bob).slow = true;
    let begun = begin(&world);
    world.command(ann, 2, begun);
    for part in 0..20 {
        world.command(ann, 3 + part, drag(0.2 * part as f32));
        world.pass(20);
    }
    assert_eq!(world.peer(bob).bend_frames.len(), 1, "nothing is queued");
    let newest = world.peer(ann).bend_frames.last().cloned().expect("ann has all");
    world.answer_frames(bob);
    world.pass(5);
    assert_eq!(world.peer(bob).bend_frames.last(), Some(&newest));
    assert_eq!(world.peer(bob).bend_frames.len(), 2);
    // That it is over is said without waiting: its rows have moved.
    world.command(ann, 23, json!({ "kind": "bend_cancel", "bend": 1 }));
    world.pass(20);
    assert!(world.peer(bob).bend_frames.last().is_some_and(|frame| frame.motions.is_empty()));
}

#[test]
fn be4_the_bend_of_the_absent_ends_as_it_is() {
    let (mut world, ann, bob) = grown();
    let begun = begin(&world);
    world.command(ann, 2, begun);
    world.command(ann, 3, drag(3.0));
    world.settle();
    world.leave(ann);
    world.pass(29_000);
    assert_eq!(timeline(world.peer(bob)).operations.len(), 1);
    world.pass(2_000);
    world.settle();
    assert_eq!(timeline(world.peer(bob)).operations.len(), 2, "it is kept");
    assert_eq!(world.replayed_hash(), world.document().hash());
}

#[test]
fn be4_a_bend_goes_on_after_a_crash() {
    for with_snapshot in [false, true] {
        let (mut world, ann, _) = grown();
        let begun = begin(&world);
        world.command(ann, 2, begun);
        world.command(ann, 3, drag(1.0));
        world.command(ann, 4, drag(2.0));
        world.settle();
        if with_snapshot {
            // The absent would lose the bend, so somebody stays while the pause brings a snapshot about.
            world.pass(40_000);
            assert!(world.snapshots > 0);
        }
        let hash = world.document().hash();
        world.crash();
        assert_eq!(world.document().hash(), hash);
        let ann = world.join("birch-01");
        world.settle();
        assert_eq!(world.peer(ann).bend_frames.len(), 1, "the frame is sent again");
        world.command(ann, 5, drag(3.0));
        world.command(ann, 6, json!({ "kind": "bend_end", "bend": 1 }));
        world.settle();
        assert_eq!(world.peer(ann).refused(), []);
        assert_eq!(world.replayed_hash(), world.document().hash());
        world.assert_mirrored(ann);
    }
}

#[test]
fn wi2_constraints_are_sent_to_all_and_to_newcomers() {
    let (mut world, ann, bob) = grown();
    let (row, _) = limb(&world);
    assert_eq!(widths(world.peer(bob)), None);
    let set = |diameter| json!({ "kind": "set_width", "row": row, "diameter": diameter, "gesture": Some(1) });
    world.command(ann, 2, set(Some(0.8)));
    world.settle();
    let notified = widths(world.peer(bob)).expect("it changed");
    assert_eq!(notified.iter().map(|width| (width.row, width.diameter)).collect::<Vec<_>>(), [(row, 0.8)]);
    assert!((notified[0].effective - 0.8).abs() < 0.05);
    world.assert_mirrored(bob);
    let carol = world.join("aspen-01");
    assert_eq!(widths(world.peer(carol)), Some(notified));
    world.command(ann, 3, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(widths(world.peer(carol)), Some(Vec::new()));
    assert_eq!(widths(world.peer(bob)), Some(Vec::new()));
}

#[test]
fn tt6_what_is_told_of_the_timeline_does_not_grow_with_it() {
    let (mut world, ann, bob) = grown();
    let told = |world: &World| {
        let texts =
            world.peer(bob).texts.iter().filter(|text| matches!(text, ServerMessage::TimelineChanged(_)));
        texts.map(|text| serde_json::to_string(text).unwrap().len()).collect::<Vec<_>>()
    };
    for id in 1..=60 {
        let step = json!({ "kind": "grow", "steps": 1 });
        let cut =
            json!({ "kind": "set_parameters", "parameters": { "internode_length": f64::from(id) / 100.0 } });
        world.command(ann, id, if id % 2 == 0 { step } else { cut });
        world.settle();
    }
    let sizes = told(&world);
    assert!(sizes.len() >= 60 && sizes.iter().all(|&size| size < 400), "{sizes:?}");
    assert_eq!(timeline(world.peer(bob)), world.document().timeline());
    assert!(timeline(world.peer(bob)).operations.len() >= 60);
}

#[test]
fn tt1_the_timeline_names_no_keys() {
    let (mut world, ann, bob) = grown();
    world.command(bob, 1, grow(1));
    world.command(ann, 2, grow(1));
    world.settle();
    let notified = timeline(world.peer(ann));
    assert_eq!(notified.operations.iter().map(|op| op.author).collect::<Vec<_>>(), [1, 2, 1]);
    assert_eq!((notified.step, notified.last_step, notified.done), (11, 11, 3));
    world.command(ann, 3, json!({ "kind": "go_to", "step": 4 }));
    world.command(ann, 4, json!({ "kind": "plant_seed", "position": [5.0, 0.0, 0.0] }));
    world.settle();
    let notified = timeline(world.peer(bob));
    assert_eq!((notified.step, notified.futures.len(), notified.futures[0].steps), (5, 1, 7));
    let carol = world.join("aspen-01");
    assert_eq!(timeline(world.peer(carol)), notified);
    world.crash();
    let ann = world.join("birch-01");
    world.settle();
    assert_eq!(timeline(world.peer(ann)), notified, "TT3: futures survive a restart");
}

/// The rows of a ghost's table.
fn rows_of_ghost(peer: &Peer) -> Mirror {
    let ghost = peer.ghosts.last().expect("a ghost came");
    let mut mirror = Mirror { epoch: ghost.epoch, ..Mirror::default() };
    let changes = ghost.changes.clone();
    mirror.apply(&Frame { epoch: ghost.epoch, sequence: ghost.sequence, catch_up: true, changes });
    mirror
}

#[test]
fn pd3_the_ghost_is_what_comes_of_the_cut() {
    let (mut world, ann, bob) = grown();
    let (row, _) = limb(&world);
    let before = world.document().hash();
    world.send(ann, &json!({ "type": "predict", "rows": vec![row], "steps": 6 }));
    world.settle();
    assert_eq!(world.document().hash(), before, "PD1: nothing changes");
    assert_eq!((world.peer(ann).ghosts.len(), world.peer(bob).ghosts.len()), (1, 0), "PD2: for ann alone");
    let ghost = rows_of_ghost(world.peer(ann));
    world.command(ann, 2, json!({ "kind": "prune", "rows": vec![row], "gesture": Some(3) }));
    world.command(ann, 3, json!({ "kind": "grow", "steps": 6, "gesture": Some(3) }));
    world.settle();
    assert_eq!(world.peer(ann).ghosts.len(), 2);
    assert!(world.peer(ann).ghosts[1].changes.is_empty(), "PD2: a command ends it");
    let carol = world.join("aspen-01");
    world.settle();
    // FR7: what is sent of light and vigor may differ a little.
    let form = |mirror: &Mirror| -> Vec<_> {
        mirror.rows.iter().map(|row| (row.parent, row.begins_axis, row.position, row.radius)).collect()
    };
    assert_eq!(form(&world.peer(carol).mirror), form(&ghost));
    assert_eq!(timeline(world.peer(ann)).operations.len(), 2, "PR2: cut and growth are one operation");
    world.command(ann, 4, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(timeline(world.peer(ann)).done, 1);
}

#[test]
fn pd2_a_newer_prediction_takes_the_place_of_the_older() {
    let (mut world, ann, _) = grown();
    let (row, _) = limb(&world);
    for steps in [50, 40, 1] {
        world.send(ann, &json!({ "type": "predict", "rows": vec![row], "steps": steps }));
    }
    world.settle();
    let rows: Vec<_> =
        world.peer(ann).ghosts.iter().map(|_| rows_of_ghost(world.peer(ann)).rows.len()).collect();
    assert_eq!(rows.len(), 1, "the newest alone is answered");
    assert!(rows[0] < 2 * world.document().plant().metamer_count(), "one step, not fifty");
    world.send(ann, &json!({ "type": "predict", "rows": [], "steps": 0 }));
    world.settle();
    assert!(world.peer(ann).ghosts.last().is_some_and(|ghost| ghost.changes.is_empty()));
    world.send(ann, &json!({ "type": "predict", "rows": vec![row], "steps": 2 }));
    world.leave(ann);
    world.settle();
    world.pass(100_000);
    world.settle();
}

#[test]
fn pd1_impossible_predictions_are_answered() {
    let (mut world, ann, _) = grown();
    let predict = |rows: &[u32], steps| json!({ "type": "predict", "rows": rows.to_vec(), "steps": steps });
    for (message, code, field) in [
        (predict(&[1_000_000], 1), ProblemCode::NotFound, "rows[0]"),
        (predict(&[1], 1), ProblemCode::Refused, "rows[0]"),
        (predict(&[1], 101), ProblemCode::OutOfRange, "steps"),
        (predict(&[1; 1025], 1), ProblemCode::TooMany, "rows"),
    ] {
        world.send(ann, &message);
        world.settle();
        let problem = world.peer(ann).problems().pop().expect("it is answered");
        assert_eq!((problem.code, problem.field.as_deref()), (code, Some(field)));
    }
    assert!(world.peer(ann).ghosts.is_empty());
}
