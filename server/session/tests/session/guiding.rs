//! `SG`, `LA`: growth of one branch, growth into an outline; and scenes with many plants.

use espalier_plant::{AxisId, MetamerId};
use espalier_proto::{ProblemCode, ServerMessage};
use serde_json::{Value, json};

use crate::world::{World, grow, person};

/// The x-y plane through the first seed.
fn plane() -> Value {
    json!({ "origin": [0.0, 0.0, 0.0], "right": [1.0, 0.0, 0.0], "up": [0.0, 1.0, 0.0] })
}

/// A rectangle that stands on the ground.
pub fn lasso(half_width: f32, height: f32, bud: Option<u32>) -> Value {
    let outline = vec![[-half_width, 0.0], [half_width, 0.0], [half_width, height], [-half_width, height]];
    json!({ "kind": "lasso", "outline": outline, "plane": plane(), "depth": 1.0, "bud": bud })
}

/// A living row whose metamer is on a lateral axis.
fn lateral_row(world: &World) -> u32 {
    let plant = world.document().plant();
    let on_lateral = |index: &u32| {
        let id = MetamerId::new(*index as usize);
        plant.is_alive(id) && plant.axes().bearer(plant.metamers().axis(id)).is_some()
    };
    let is_grown = |index: &u32| !plant.is_seed(MetamerId::new(*index as usize));
    (0..plant.metamer_count() as u32)
        .filter(is_grown)
        .filter(on_lateral)
        .find(|&row| {
            // The first seed bears the trunk, which is no lateral.
            let bearer = plant.axes().bearer(plant.metamers().axis(MetamerId::new(row as usize)));
            bearer.is_some_and(|bearer| !plant.is_seed(bearer))
        })
        .expect("the tree has branched")
}

/// Whether an axis is `root` or is borne, however far up, on it.
fn descends(world: &World, mut axis: AxisId, root: AxisId) -> bool {
    let plant = world.document().plant();
    while axis != root {
        let Some(bearer) = plant.axes().bearer(axis) else { return false };
        axis = plant.metamers().axis(bearer);
    }
    true
}

#[test]
fn la1_a_lasso_fills_its_outline_as_one_operation() {
    let mut world = World::new();
    world.work_ms = 70;
    let client = world.join("birch-01");
    world.command(client, 1, lasso(6.0, 14.0, None));
    world.pass(200);
    let under_way = world.peer(client).last_state().unwrap();
    assert_eq!(under_way.pending_steps, 1, "there is more to come");
    world.settle();
    let state = world.peer(client).last_state().unwrap();
    assert!(state.metamers > 100 && state.step > 2, "{state:?}");
    assert_eq!(state.pending_steps, 0);
    let plant = world.document().plant();
    let ends = (0..plant.metamer_count()).map(|index| plant.metamers().end(MetamerId::new(index)));
    for end in ends {
        assert!(end.x.abs() < 9.0 && end.y < 17.0 && end.z.abs() < 9.0, "{end} is far outside");
    }
    assert_eq!(world.document().hash(), world.replayed_hash());
    world.command(client, 2, json!({ "kind": "undo" }));
    world.settle();
    let state = world.peer(client).last_state().unwrap();
    assert_eq!((state.metamers, state.can_undo), (0, false));
    world.assert_mirrored(client);
}

#[test]
fn la1_lassos_of_one_gesture_are_one_operation() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let with = |mut command: Value, gesture: u32| {
        command["gesture"] = gesture.into();
        command
    };
    world.command(client, 1, with(lasso(6.0, 14.0, None), 1));
    world.command(client, 2, with(lasso(14.0, 6.0, None), 1));
    world.settle();
    let first = world.peer(client).last_state().unwrap().metamers;
    world.command(client, 3, with(lasso(16.0, 20.0, None), 2));
    world.settle();
    assert!(world.peer(client).last_state().unwrap().metamers > first, "another gesture grows as well");
    for (number, left) in [(4, first), (5, 0)] {
        world.command(client, number, json!({ "kind": "undo" }));
        world.settle();
        assert_eq!(world.peer(client).last_state().unwrap().metamers, left);
    }
    assert_eq!(world.document().hash(), world.replayed_hash());
    world.assert_mirrored(client);
}

#[test]
fn la1_a_lasso_leaves_no_markers_behind() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, lasso(6.0, 14.0, None));
    world.settle();
    let grown = world.document().metamers();
    // A stroke far away settles only while something grows; markers left behind would still be grown into.
    world.command(client, 2, json!({ "kind": "stroke_begin", "stroke": 1 }));
    let sample = json!({ "position": [900.0, 900.0, 0.0], "radius": 1.0 });
    world.command(client, 3, json!({ "kind": "stroke_move", "stroke": 1, "samples": vec![sample] }));
    world.command(client, 4, json!({ "kind": "stroke_end", "stroke": 1 }));
    world.settle();
    assert_eq!(world.document().metamers(), grown);
}

#[test]
fn la1_a_lasso_does_not_end_the_strokes_of_others() {
    let mut world = World::new();
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    let sample = |y: f32| json!({ "position": [0.0, y, 0.0], "radius": 0.0 });
    world.command(birch, 1, json!({ "kind": "stroke_begin", "stroke": 1 }));
    world.command(
        birch,
        2,
        json!({ "kind": "stroke_move", "stroke": 1, "samples": vec![sample(0.0), sample(6.0)] }),
    );
    world.command(maple, 1, lasso(3.0, 6.0, None));
    world.settle();
    let before = world.document().metamers();
    world.command(birch, 3, json!({ "kind": "stroke_move", "stroke": 1, "samples": vec![sample(30.0)] }));
    world.command(birch, 4, json!({ "kind": "stroke_end", "stroke": 1 }));
    world.settle();
    assert!(world.document().metamers() >= before + 10, "the pencil goes on where it was");
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn la1_what_encloses_nothing_is_refused() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.settle();
    let before = world.document().hash();
    for (id, outline) in [
        vec![[1.0, 1.0]; 3],
        vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]],
        vec![[5.0, 5.0], [5.0, 5.0], [6.0, 5.0]],
    ]
    .into_iter()
    .enumerate()
    {
        let command = json!({ "kind": "lasso", "outline": outline, "plane": plane(), "depth": 1.0 });
        world.command(client, id as u32 + 1, command);
    }
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.len(), 3);
    assert!(refused.iter().all(|(_, problem)| problem.field.as_deref() == Some("outline")), "{refused:?}");
    assert_eq!(world.document().hash(), before);
}

#[test]
fn sg1_only_the_chosen_branch_grows() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(8));
    world.settle();
    let (row, before) = (lateral_row(&world), world.document().plant().metamer_count());
    let chosen = world.document().plant().metamers().axis(MetamerId::new(row as usize));
    world.command(client, 2, json!({ "kind": "grow", "steps": 6, "bud": Some(row) }));
    world.command(client, 3, lasso(9.0, 20.0, Some(row)));
    world.command(client, 4, json!({ "kind": "stroke_begin", "stroke": 1, "bud": Some(row) }));
    let sample = |y: f32| json!({ "position": [0.0, y, 0.0], "radius": 6.0 });
    world.command(
        client,
        5,
        json!({ "kind": "stroke_move", "stroke": 1, "samples": vec![sample(5.0), sample(25.0)] }),
    );
    world.command(client, 6, json!({ "kind": "stroke_end", "stroke": 1 }));
    world.settle();
    assert_eq!(world.peer(client).refused(), []);
    let plant = world.document().plant();
    assert!(plant.metamer_count() > before + 5, "the branch grows");
    for index in before..plant.metamer_count() {
        let axis = plant.metamers().axis(MetamerId::new(index));
        assert!(descends(&world, axis, chosen), "row {index} grew elsewhere");
    }
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn sg1_a_row_that_is_not_there_is_refused() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(4));
    world.command(client, 2, json!({ "kind": "ungrow", "steps": 2 }));
    world.settle();
    let before = world.document().hash();
    let gone = world.document().plant().metamer_count() as u32;
    let bud = Some(gone);
    world.command(client, 3, json!({ "kind": "grow", "steps": 1, "bud": bud }));
    world.command(client, 4, json!({ "kind": "stroke_begin", "stroke": 1, "bud": bud }));
    world.command(client, 5, lasso(5.0, 5.0, Some(u32::MAX)));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [3, 4, 5]);
    for (_, problem) in &refused {
        assert_eq!((problem.code, problem.field.as_deref()), (ProblemCode::NotFound, Some("bud")));
    }
    assert_eq!(world.document().hash(), before);
    assert!(world.document().open_strokes(&person("birch-01")).is_empty());
}

#[test]
fn lm4_reaching_the_budget_is_told_to_all() {
    let mut world = World::seeded_with_budget(400);
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    world.command(birch, 1, grow(1000));
    world.settle();
    let state = world.peer(maple).last_state().unwrap();
    assert!(state.budget_reached && state.metamers > 0 && state.pending_steps == 0, "{state:?}");
    assert_eq!(state.metamer_budget, 400);
    world.command(birch, 2, lasso(9.0, 20.0, None));
    world.command(birch, 3, json!({ "kind": "ungrow", "steps": 1 }));
    world.settle();
    assert_eq!(world.peer(birch).refused().len(), 1);
    assert!(!world.peer(maple).last_state().unwrap().budget_reached, "there is room again");
    world.command(birch, 4, lasso(30.0, 60.0, None));
    world.settle();
    assert!(world.peer(maple).last_state().unwrap().budget_reached, "a lasso ends there as well");
    assert_eq!(world.document().plant().metamer_count(), 400);
    let hash = world.document().hash();
    assert_eq!(world.replayed_hash(), hash);
    world.crash();
    assert_eq!(world.document().hash(), hash);
}

#[test]
fn a_thousand_seeds_grow_in_one_scene() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for number in 0..1000u32 {
        let place = |n: u32| (n as f32 - 15.5) * 8.0;
        let position = [place(number % 32) + 4.0, 0.0, place(number / 32)];
        world.command(client, number + 1, json!({ "kind": "plant_seed", "position": position }));
        world.pass(1);
    }
    world.command(client, 1001, grow(4));
    world.settle();
    assert_eq!(world.peer(client).refused(), []);
    let plant = world.document().plant();
    let is_trunk = |id: MetamerId| plant.metamers().parent(id).is_some_and(|parent| plant.is_seed(parent));
    let grown = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| is_trunk(id)).count();
    assert!(grown > 900, "{grown} of 1001 seeds have grown");
    let hash = world.document().hash();
    world.crash();
    assert_eq!(world.document().hash(), hash);
    let acknowledged = world.join("birch-01");
    assert!(matches!(world.peer(acknowledged).texts[0], ServerMessage::Welcome { acknowledged: 1001, .. }));
}
