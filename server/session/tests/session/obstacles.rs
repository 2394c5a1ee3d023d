//! `OB`: obstacles in the scene, sent to everybody and undone like anything else.

use espalier_proto::{Command, Mesh, PlacedObstacle, PlacedShape, ProblemCode, ServerMessage, access::Role};
use espalier_session::{ActId, Entrant, Input, Principal};
use glam::Vec3;
use serde_json::{Value, json};

use crate::world::{World, grow};

fn somebody() -> Entrant {
    Entrant::new("somebody", Role::Editor)
}

pub fn at(x: f32, y: f32, z: f32) -> Value {
    json!({ "position": [x, y, z], "rotation": [0.0, 0.0, 0.0, 1.0] })
}

pub fn place(shape: Value, pose: Value) -> Value {
    json!({ "kind": "place_obstacle", "obstacle": json!({ "shape": shape, "pose": pose }) })
}

fn ball(radius: f32, pose: Value) -> Value {
    place(json!({ "kind": "sphere", "radius": radius }), pose)
}

/// A tetrahedron around its origin.
pub fn tetrahedron() -> Mesh {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    Mesh {
        vertices: corners.map(Vec3::from_array).to_vec(),
        triangles: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    }
}

/// A command as the server reads it.
fn parsed(command: &Value) -> Box<Command> {
    Box::new(Command::from_json(&command.to_string()).expect("it is in good form"))
}

fn mesh(mesh: &Mesh) -> Value {
    place(json!({ "kind": "mesh", "mesh": mesh.to_base64(), "scale": 2.0 }), at(0.0, 8.0, 0.0))
}

/// What a client was notified of last, if anything.
fn notified(world: &World, client: u64) -> Option<Vec<PlacedObstacle>> {
    world.peer(client).texts.iter().rev().find_map(|text| match text {
        ServerMessage::Obstacles { obstacles } => Some(obstacles.clone()),
        _ => None,
    })
}

fn ids(world: &World, client: u64) -> Vec<u32> {
    notified(world, client).unwrap_or_default().iter().map(|obstacle| obstacle.id).collect()
}

#[test]
fn ob3_everybody_is_notified_and_newcomers_too() {
    let mut world = World::new();
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    world.settle();
    assert_eq!(notified(&world, birch), None, "a welcome alone means none");
    world.command(birch, 1, place(json!({ "kind": "box", "size": [2.0, 3.0, 4.0] }), at(5.0, 1.5, 0.0)));
    world.command(birch, 2, place(json!({ "kind": "plane" }), at(0.0, -1.0, 0.0)));
    world.command(birch, 3, mesh(&tetrahedron()));
    world.settle();
    let list = notified(&world, maple).unwrap();
    assert_eq!(list.iter().map(|obstacle| obstacle.id).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(list[0].shape, PlacedShape::Box { size: [2.0, 3.0, 4.0] });
    assert_eq!(json!(list[0].pose), at(5.0, 1.5, 0.0));
    assert_eq!(list[2].shape, PlacedShape::Mesh { vertices: 4, triangles: 4, scale: 2.0 });
    let aspen = world.join("aspen-01");
    assert_eq!(notified(&world, aspen), Some(list));
    assert!(matches!(
        world.peer(aspen).texts[..3],
        [ServerMessage::Welcome { .. }, ServerMessage::Appearance { .. }, ServerMessage::Obstacles { .. }]
    ));
    assert_eq!(*world.session.mesh(3).unwrap(), tetrahedron());
    assert!(world.session.mesh(1).is_none() && world.session.mesh(9).is_none());
}

#[test]
fn ob2_obstacles_are_undone_and_redone_like_growth() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, ball(3.0, at(9.0, 3.0, 0.0)));
    world.command(client, 2, grow(3));
    world.command(client, 3, json!({ "kind": "move_obstacle", "id": 1, "pose": at(-9.0, 3.0, 0.0) }));
    world.command(client, 4, json!({ "kind": "remove_obstacle", "id": 1 }));
    world.settle();
    assert_eq!(notified(&world, client), Some(vec![]));
    let grown = world.document().plant().hash();
    world.command(client, 5, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(json!(notified(&world, client).unwrap()[0].pose), at(-9.0, 3.0, 0.0));
    for id in 6..=8 {
        world.command(client, id, json!({ "kind": "undo" }));
    }
    world.settle();
    assert_eq!(ids(&world, client), [0; 0]);
    for id in 9..=10 {
        world.command(client, id, json!({ "kind": "redo" }));
    }
    world.settle();
    assert_eq!(world.document().plant().hash(), grown);
    assert_eq!(json!(notified(&world, client).unwrap()[0].pose), at(9.0, 3.0, 0.0));
    assert_eq!(world.peer(client).refused(), []);
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn ob2_a_number_is_never_used_again() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, ball(1.0, at(9.0, 3.0, 0.0)));
    world.command(client, 2, json!({ "kind": "undo" }));
    world.command(client, 3, ball(2.0, at(9.0, 3.0, 0.0)));
    world.settle();
    world.pass(40_000);
    assert!(world.snapshots > 0);
    world.crash();
    let client = world.join("birch-01");
    assert_eq!(ids(&world, client), [2]);
    world.command(client, 4, ball(3.0, at(-9.0, 3.0, 0.0)));
    world.settle();
    assert_eq!(ids(&world, client), [2, 3]);
}

#[test]
fn ob1_a_wall_changes_how_a_tree_grows() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let wall = json!({ "kind": "box", "size": [1.0, 80.0, 80.0] });
    world.command(client, 1, place(wall, at(2.0, 40.0, 0.0)));
    world.command(client, 2, grow(14));
    world.settle();
    let plant = world.document().plant();
    let ends = || {
        (0..plant.metamer_count()).map(|index| plant.metamers().end(espalier_plant::MetamerId::new(index)))
    };
    assert!(ends().all(|end| end.x < 1.5), "something grew into the wall");
    assert!(ends().any(|end| end.x < -2.0), "and nothing away from it");
    let walled = plant.hash();
    let hash = world.document().hash();
    assert_eq!(world.replayed_hash(), hash);
    world.pass(40_000);
    world.crash();
    assert_eq!(world.document().hash(), hash, "the snapshot holds the wall");
    // Both grow on alike: the one that was read from bytes, and the one replayed from the start.
    let client = world.join("birch-01");
    world.command(client, 3, grow(3));
    world.settle();
    assert_ne!(world.document().plant().hash(), walled);
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn ob2_who_is_not_there_is_refused() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, ball(1.0, at(9.0, 3.0, 0.0)));
    let before = |world: &mut World| {
        world.settle();
        world.document().hash()
    };
    let hash = before(&mut world);
    world.command(client, 2, json!({ "kind": "remove_obstacle", "id": 0 }));
    world.command(client, 3, json!({ "kind": "move_obstacle", "id": 2, "pose": at(0.0, 0.0, 0.0) }));
    assert_eq!(before(&mut world), hash);
    for (_, problem) in world.peer(client).refused() {
        assert_eq!((problem.code, problem.field.as_deref()), (ProblemCode::NotFound, Some("id")));
    }
    assert_eq!(world.peer(client).refused().len(), 2);
}

#[test]
fn lm6_the_scene_and_its_history_are_bounded() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for id in 1..=65 {
        world.command(client, id, ball(1.0, at(id as f32 * 10.0, 3.0, 0.0)));
    }
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [65]);
    // A mesh that was removed can come back by undo, so it still counts.
    let strip = Mesh {
        vertices: (0..65_536).map(|n| Vec3::new((n / 2) as f32 * 0.1, (n % 2) as f32, 0.0)).collect(),
        triangles: (0..65_534).flat_map(|n| [[n, n + 1, n + 2], [n, n + 2, n + 1]]).collect(),
    };
    let shape = json!({ "kind": "mesh", "mesh": strip.to_base64(), "scale": 1.0 });
    let obstacle = json!({ "shape": shape, "pose": at(0.0, 500.0, 0.0) });
    let mut world = World::new();
    let client = world.join("birch-01");
    for number in 1..=8 {
        let command = parsed(&json!({ "kind": "place_obstacle", "obstacle": obstacle.clone() }));
        world.handle(Input::Act(ActId(number), Principal::visitor(), somebody(), command));
        world.command(client, number as u32, json!({ "kind": "remove_obstacle", "id": number as u32 }));
        world.settle();
    }
    let outcomes: Vec<bool> = world.acts.iter().map(|(_, outcome)| outcome.is_ok()).collect();
    assert_eq!(outcomes, [true, true, true, true, true, true, true, false]);
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn ob6_an_upload_is_answered_when_it_is_durable() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.write_ms = 500;
    world.handle(Input::Act(ActId(7), Principal::visitor(), somebody(), parsed(&mesh(&tetrahedron()))));
    world.pass(400);
    assert!(world.acts.is_empty() && !world.session.is_idle());
    assert_eq!(ids(&world, client), [1], "it stands there already");
    world.pass(200);
    let (act, outcome) = world.acts.remove(0);
    assert_eq!((act, outcome.unwrap().unwrap().id), (ActId(7), 1));
    // What is no obstacle is refused at once, and nothing is written.
    let flat = Mesh { triangles: vec![[0, 0, 1]], ..tetrahedron() };
    world.handle(Input::Act(ActId(8), Principal::visitor(), somebody(), parsed(&mesh(&flat))));
    let (act, outcome) = world.acts.remove(0);
    assert_eq!((act, outcome.unwrap_err().field.as_deref()), (ActId(8), Some("obstacle.shape.mesh")));
    assert_eq!(world.disk.len(), 1);
    assert_eq!(world.document().hash(), world.replayed_hash());
}
