//! What stands around a grammar's plant in a real document answers it: light, free space, walls, and a space drawn by
//! hand (`GR1`, `GR3`, `GR9`).

use espalier_growth::{Envelope, Plane};
use espalier_plant::MetamerId;
use espalier_proto::{Reason, ServerMessage};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use crate::world::World;

/// A shoot that turns to where more light comes from.
const SEEKER: &str = "axiom: F(1)A\nA --> F(1)@R(0.4*towards_light_x(), 0.6 + 0.4*towards_light_y(), 0.4*towards_light_z())A\n";

/// A bush that asks of each place whether it may grow there before it does.
fn asking(question: &str) -> String {
    format!(
        "axiom: f(1)Q(-1)\nQ(v) : v < 0 --> Q({question})\nf(l) > Q(v) : v == 1 --> F(l)\n\
         f(l) > Q(v) : v == 0 --> *\nQ(v) : v == 0 --> %\n\
         Q(v) : v == 1 --> [&(60)f(1)Q(-1)]/(137.5)[&(35)f(1)Q(-1)]f(1)Q(-1)\n"
    )
}

const OVAL: [[f32; 2]; 8] =
    [[-1.0, -0.5], [1.0, -0.5], [3.5, 3.0], [4.0, 6.0], [2.5, 9.5], [-2.5, 9.5], [-4.0, 6.0], [-3.5, 3.0]];

fn body(outline: &[[f32; 2]]) -> Value {
    json!({ "outline": outline, "plane": { "origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0] } })
}

fn envelope(outline: &[[f32; 2]]) -> Envelope {
    let outline: Vec<Vec2> = outline.iter().copied().map(Vec2::from_array).collect();
    let plane = Plane { origin: Vec3::ZERO, right: Vec3::X, up: Vec3::Y };
    Envelope::inflate(&outline, plane, 1.0, 0.0).expect("there is room in it")
}

fn wall(size: [f32; 3], position: [f32; 3]) -> Value {
    let obstacle = json!({ "shape": { "kind": "box", "size": size }, "pose": { "position": position } });
    json!({ "kind": "place_obstacle", "obstacle": obstacle })
}

fn plant(text: &str, depth: u32) -> Value {
    json!({ "kind": "set_grammar", "text": text, "depth": depth })
}

/// A session in which these commands were done; all of them, and the same again from its journal.
fn after(commands: &[Value]) -> World {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (id, command) in (1..).zip(commands) {
        world.command(client, id, command.clone());
        world.settle();
    }
    assert_eq!(world.peer(client).refused().len(), 0);
    assert_eq!(world.document().hash(), world.replayed_hash(), "the journal leads to the same tree");
    world
}

/// The ends of all living internodes born in a step or later.
fn ends_since(world: &World, step: u32) -> Vec<Vec3> {
    let plant = world.document().plant();
    let rows = (0..plant.metamer_count()).map(MetamerId::new);
    let living = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id) && plant.birth(id) > step);
    living.map(|id| plant.metamers().end(id)).collect()
}

fn ends(world: &World) -> Vec<Vec3> {
    ends_since(world, 0)
}

fn highest(ends: &[Vec3]) -> Vec3 {
    ends.iter().copied().max_by(|one, other| one.y.total_cmp(&other.y)).expect("there is wood")
}

#[test]
fn gr1_what_seeks_light_bends_away_from_what_shades_it() {
    let tip = |commands: &[Value]| highest(&ends(&after(commands)));
    let alone = tip(&[plant(SEEKER, 12)]);
    assert!(alone.x.abs() < 0.5 && alone.z.abs() < 0.5, "nothing draws it aside: {alone}");
    let right = tip(&[wall([1.0, 30.0, 30.0], [2.5, 15.0, 0.0]), plant(SEEKER, 12)]);
    assert!(right.x < -1.5, "it leans away from a wall on its right: {right}");
    let left = tip(&[wall([1.0, 30.0, 30.0], [-2.5, 15.0, 0.0]), plant(SEEKER, 12)]);
    assert!(left.x > 1.5, "and from one on its left: {left}");
}

#[test]
fn gr1_what_seeks_light_bends_away_from_another_tree() {
    let grow = json!({ "kind": "grow", "steps": 14 });
    let beside = |x: f32| {
        let mut set = plant(SEEKER, 12);
        set["position"] = json!([x, 0, 0]);
        let world = after(&[grow.clone(), set]);
        let born = world.document().plant().step() - 12;
        highest(&ends_since(&world, born)).x - x
    };
    let (right, left) = (beside(2.5), beside(-2.5));
    assert!(right > 1.0 && left < -1.0, "both lean outwards: {right} and {left}");
}

#[test]
fn gr1_what_asks_for_walls_stops_at_them() {
    let text = asking("!inside(1)");
    let depth = 14;
    let world = after(&[wall([2.0, 80.0, 80.0], [3.0, 0.0, 0.0]), plant(&text, depth)]);
    let stopped = ends(&world);
    assert!(stopped.iter().all(|end| end.x < 2.0), "nothing stands in the wall or behind it");
    let free = ends(&after(&[plant(&text, depth)]));
    assert!(free.iter().any(|end| end.x > 2.5), "without one it goes on");
    assert!(stopped.len() > 200 && free.len() > stopped.len(), "{} of {}", stopped.len(), free.len());
}

#[test]
fn gr9_a_drawn_space_is_filled_and_not_left() {
    let text = asking("inside(0)");
    let set = json!({ "kind": "set_grammar_body", "within": body(&OVAL) });
    let world = after(&[plant(&text, 18), set.clone()]);
    let (filled, space) = (ends(&world), envelope(&OVAL));
    assert!(filled.len() > 300, "{} internodes", filled.len());
    for &end in &filled {
        assert!(space.contains(end), "{end} is outside");
    }
    let (low, high) =
        filled.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), &end| (low.min(end), high.max(end)));
    assert!(
        high.x > 2.5 && low.x < -2.5 && high.y > 7.5,
        "it reaches the sides and the top: {low} to {high}"
    );
    assert!(high.z > 2.0 && low.z < -2.0, "and is as deep as it is wide");

    // Planted within it at once, the plant is the same.
    let mut at_once = plant(&text, 18);
    at_once["within"] = body(&OVAL);
    let mut planted = ends(&after(&[at_once]));
    let mut filled = filled;
    let order = |one: &Vec3, other: &Vec3| one.to_array().partial_cmp(&other.to_array()).expect("numbers");
    planted.sort_by(order);
    filled.sort_by(order);
    assert_eq!(planted, filled);

    // Without it all space is free again; taken back, the plant is what it was.
    let free = after(&[plant(&text, 18)]).document().metamers();
    let without = after(&[plant(&text, 18), set.clone(), json!({ "kind": "set_grammar_body" })]);
    assert_eq!(without.document().metamers(), free);
    let undone = after(&[plant(&text, 18), set, json!({ "kind": "undo" })]);
    assert_eq!(undone.document().metamers(), free);
}

#[test]
fn gr9_all_are_told_the_space_and_one_without_room_is_refused() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, json!({ "kind": "set_grammar_body", "within": body(&OVAL) }));
    world.command(client, 2, plant(&asking("inside(0)"), 4));
    world.command(
        client,
        3,
        json!({ "kind": "set_grammar_body", "within": body(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]) }),
    );
    world.command(client, 4, json!({ "kind": "set_grammar_body", "within": body(&OVAL) }));
    world.settle();
    let reasons: Vec<Reason> =
        world.peer(client).refused().iter().map(|(_, problem)| problem.reason).collect();
    assert_eq!(reasons, [Reason::NoGrammar, Reason::NoRoom]);
    let told = |world: &World| {
        world.peer(client).texts.iter().rev().find_map(|message| match message {
            ServerMessage::Grammar { grammar } => grammar.clone(),
            _ => None,
        })
    };
    let within = told(&world).expect("it is told").within.expect("it has a body");
    assert_eq!((within.outline.iter().count(), within.depth.get()), (OVAL.len(), 1.0));
    world.command(client, 5, json!({ "kind": "set_grammar_body" }));
    world.settle();
    assert!(told(&world).expect("it is told").within.is_none());
}

#[test]
fn gr1_vigor_is_less_where_branches_are_shaded() {
    let text = "axiom: F(2)[&(90)A][^(90)A]\nA --> F(0.5 + 2*vigor())A\n";
    let sides = |commands: &[Value]| {
        let ends = ends(&after(commands));
        let reach = |side: f32| ends.iter().map(|end| end.z * side).fold(0.0, f32::max);
        (reach(-1.0), reach(1.0))
    };
    let (north, south) = sides(&[plant(text, 6)]);
    assert!((north - south).abs() < 0.5 && north > 6.0, "both sides have as much: {north} and {south}");
    let (north, south) = sides(&[wall([60.0, 1.0, 30.0], [0.0, 4.0, 15.5]), plant(text, 6)]);
    assert!(south < 0.8 * north, "the side below the roof gets less: {south} of {north}");
}

#[test]
fn gr3_what_is_written_anew_is_asked_as_if_it_grew_there_first() {
    let text = "a = 60\nslider: a 20 80\naxiom: F(1)A(1)\nA(l) : light() < 0.5 --> %\n\
                A(l) : light() >= 0.5 --> F(l)[&(a)B(l*0.93)]/(137.5)A(l*0.93)\nB(l) --> A(l)\n";
    let set = json!({ "kind": "set_grammar_values", "values": [{ "name": "a", "value": 45 }] });
    let moved = ends(&after(&[plant(text, 10), set]));
    let mut planted = plant(text, 10);
    planted["values"] = json!([{ "name": "a", "value": 45 }]);
    let planted = ends(&after(&[planted]));
    assert!(planted.len() > 40, "{}", planted.len());
    assert_eq!(moved.len(), planted.len());
    for end in &moved {
        let nearest = planted.iter().map(|other| other.distance(*end)).fold(f32::MAX, f32::min);
        assert!(nearest < 1e-3, "{end} stands elsewhere than where it would have grown");
    }
}
