//! `BE`: whose wood moves, and where it goes.

use espalier_plant::MetamerId;
use espalier_proto::{ProblemCode, RowMotion};
use serde_json::{Value, json};

use crate::{
    shaping::{grown, limb, timeline},
    world::{World, grow},
};

const NO_TURN: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

fn begin(bend: u32, base: u32, touches: &[u32]) -> Value {
    json!({ "kind": "bend_begin", "bend": bend, "base": base, "touches": touches.to_vec(), "stretch": 0.1 })
}

/// A row and those below it, down to the seed.
fn down(world: &World, row: u32) -> Vec<u32> {
    let plant = world.document().plant();
    std::iter::successors(Some(MetamerId::new(row as usize)), |&id| plant.metamers().parent(id))
        .map(MetamerId::raw)
        .collect()
}

/// Some wood and its base three metamers below, neither of which bears the wood from `row` upwards or is borne by it.
fn elsewhere(world: &World, row: u32) -> (u32, u32) {
    let plant = world.document().plant();
    let under = down(world, row);
    let found = (0..plant.metamer_count() as u32).rev().find_map(|top| {
        let path = down(world, top);
        let base = *path.get(3)?;
        let is_apart = !path.contains(&row) && !under.contains(&base);
        (plant.is_alive(MetamerId::new(top as usize)) && is_apart).then_some((top, base))
    });
    found.expect("the tree has more than one branch")
}

fn where_it_ends(world: &World, row: u32) -> [f32; 3] {
    world.document().plant().metamers().end(MetamerId::new(row as usize)).to_array()
}

#[test]
fn be2_wood_that_one_bend_moves_is_closed_to_another() {
    let (mut world, ann, bob) = grown();
    let (top, base) = limb(&world);
    let path = down(&world, top);
    let other = elsewhere(&world, base);
    world.command(ann, 2, begin(1, base, &[top]));
    world.settle();
    let graft =
        |keep| json!({ "kind": "graft", "row": path[2], "onto": other.0, "rotation": NO_TURN, "keep": keep });
    for (id, (command, field)) in (1..).zip([
        (begin(1, base, &[top]), "base"),
        (begin(1, path[4], &[path[1]]), "base"),
        // The wood of the bend would ride along.
        (begin(1, path[8], &[path[7]]), "base"),
        (json!({ "kind": "turn_branch", "row": path[2], "rotation": NO_TURN }), "row"),
        (graft(false), "row"),
    ]) {
        world.command(bob, id, command.clone());
        world.settle();
        let (refused, problem) = world.peer(bob).refused().pop().unwrap_or_else(|| panic!("{command:?}"));
        assert_eq!(refused, id, "{command:?}");
        assert_eq!(
            (problem.code, problem.field.as_deref()),
            (ProblemCode::Refused, Some(field)),
            "{command:?}"
        );
    }
    // Everything else goes on meanwhile: growth, copies, and bends of other branches.
    let refused = world.peer(bob).refused().len();
    world.command(bob, 6, grow(1));
    world.command(bob, 7, graft(true));
    world.command(bob, 8, begin(2, other.1, &[other.0]));
    world.command(bob, 9, json!({ "kind": "bend_end", "bend": 2 }));
    world.command(ann, 3, json!({ "kind": "bend_end", "bend": 1 }));
    world.command(bob, 10, begin(3, base, &[top]));
    world.command(bob, 11, json!({ "kind": "bend_cancel", "bend": 3 }));
    world.settle();
    assert_eq!(world.peer(bob).refused().len(), refused, "{:?}", world.peer(bob).refused());
    assert_eq!(world.replayed_hash(), world.document().hash());
}

#[test]
fn be2_what_grows_on_a_bent_branch_rides_along() {
    let (mut world, ann, bob) = grown();
    let (top, base) = limb(&world);
    let before = where_it_ends(&world, top);
    let rows = world.document().plant().metamer_count() as u32;
    world.command(ann, 2, begin(1, base, &[top]));
    world.command(bob, 1, grow(1));
    world.settle();
    let young = (rows..world.document().plant().metamer_count() as u32)
        .find(|&row| down(&world, row).contains(&top))
        .expect("the branch grows on");
    let moved = |row, from: [f32; 3], world: &World| {
        let to = where_it_ends(world, row);
        (0..3).map(|i| (to[i] - from[i]).abs()).fold(0.0, f32::max)
    };
    let young_before = where_it_ends(&world, young);
    for round in 0..8 {
        let [x, y, z] = before;
        world.command(
            ann,
            3 + round,
            json!({ "kind": "bend_move", "bend": 1, "targets": vec![[x + 2.0, y, z]] }),
        );
    }
    world.command(ann, 11, json!({ "kind": "bend_end", "bend": 1 }));
    world.settle();
    assert!(moved(top, before, &world) > 0.5);
    assert!(moved(young, young_before, &world) > 0.5);
    let kinds = timeline(world.peer(bob)).operations.len();
    assert_eq!(kinds, 3, "growth, the growth amid the bend, and the bend");
    world.assert_mirrored(ann);
}

/// The pose after some rounds towards targets, one for each touch.
fn pose(touches: &[u32], base: u32, rounds: &[Vec<[f32; 3]>]) -> Vec<RowMotion> {
    let (mut world, ann, _) = grown();
    world.command(ann, 2, begin(1, base, touches));
    for (id, targets) in (3..).zip(rounds) {
        world.command(ann, id, json!({ "kind": "bend_move", "bend": 1, "targets": targets.clone() }));
    }
    world.settle();
    assert_eq!(world.peer(ann).refused(), []);
    world.peer(ann).bend_frames.last().expect("a frame came").motions.clone()
}

/// The longest way between where two poses put the same metamer.
fn apart(one: &[RowMotion], other: &[RowMotion]) -> f32 {
    assert_eq!(one.len(), other.len());
    let pairs = one.iter().zip(other).flat_map(|(a, b)| a.to.into_iter().zip(b.to));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn be3_targets_are_as_many_as_touches() {
    let (mut world, ann, _) = grown();
    let (top, base) = limb(&world);
    let middle = down(&world, top)[3];
    world.command(ann, 2, begin(1, base, &[top, middle]));
    world.settle();
    let hash = world.document().hash();
    for (id, count) in [(3, 1), (4, 3)] {
        world.command(
            ann,
            id,
            json!({ "kind": "bend_move", "bend": 1, "targets": vec![[1.0, 6.0, 0.0]; count] }),
        );
        world.settle();
        let (refused, problem) = world.peer(ann).refused().pop().expect("it is refused");
        assert_eq!((refused, problem.code), (id, ProblemCode::OutOfRange));
        assert_eq!(problem.field.as_deref(), Some("targets"));
    }
    assert_eq!(world.document().hash(), hash);
}

#[test]
fn be3_the_same_moves_lead_to_the_same_pose() {
    let (world, ..) = grown();
    let (top, base) = limb(&world);
    let middle = down(&world, top)[3];
    let [x, y, z] = where_it_ends(&world, top);
    let [u, v, w] = where_it_ends(&world, middle);
    let (at_top, at_middle) = ([x + 1.5, y - 0.5, z], [u - 0.5, v, w + 0.5]);
    let there = vec![vec![at_top, at_middle]; 6];
    let bent = pose(&[top, middle], base, &there);
    assert_eq!(pose(&[top, middle], base, &there), bent, "bit for bit");
    // Targets belong to the touches in the order in which these were named.
    let named_otherwise = pose(&[middle, top], base, &vec![vec![at_middle, at_top]; 6]);
    assert!(apart(&named_otherwise, &bent) < 0.01, "{}", apart(&named_otherwise, &bent));
    let exchanged = pose(&[middle, top], base, &there);
    assert!(apart(&exchanged, &bent) > 0.3, "{}", apart(&exchanged, &bent));
    // Targets that come back bring the branch back.
    let home = vec![[x, y, z], [u, v, w]];
    let rest = pose(&[top, middle], base, std::slice::from_ref(&home));
    assert!(apart(&bent, &rest) > 0.3, "{}", apart(&bent, &rest));
    let back = pose(&[top, middle], base, &[there, vec![home; 60]].concat());
    assert!(apart(&back, &rest) < 0.02, "{}", apart(&back, &rest));
}
