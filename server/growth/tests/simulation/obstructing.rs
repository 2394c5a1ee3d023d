//! Obstacles: a tree grows around them, keeps out of them, and lives in their shade.

use std::sync::Arc;

use espalier_growth::{Envelope, Obstacle, Obstacles, Plane, Shape, TriangleMesh};
use espalier_plant::checks;
use glam::{Quat, Vec2};
use proptest::prelude::*;

use super::*;

fn obstacle(shape: Shape) -> Obstacle {
    Obstacle::new(shape).expect("a valid obstacle")
}

pub(super) fn cuboid(low: Vec3, high: Vec3) -> Obstacle {
    let (centre, half_extents) = (0.5 * (low + high), 0.5 * (high - low));
    obstacle(Shape::Box { centre, half_extents, rotation: Quat::IDENTITY })
}

fn standing(mesh: TriangleMesh) -> Obstacle {
    let mesh = Arc::new(mesh);
    obstacle(Shape::Mesh { mesh, position: Vec3::ZERO, rotation: Quat::IDENTITY })
}

/// A wall of two triangles, without thickness, in the plane x = `x`.
fn sheet(x: f32) -> Obstacle {
    let corners = [(-40.0, -40.0), (-40.0, 40.0), (80.0, 40.0), (80.0, -40.0)];
    let vertices = corners.map(|(y, z)| Vec3::new(x, y, z)).to_vec();
    let mesh = TriangleMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    standing(mesh)
}

fn grown_among(seed: u32, obstacles: Vec<Obstacle>, steps: u32) -> Simulation {
    let mut simulation = simulation(seed);
    simulation.set_obstacles(obstacles);
    grow(&mut simulation, steps);
    simulation
}

/// How many living metamers meet an obstacle or end within it.
pub(super) fn violations(simulation: &Simulation) -> usize {
    let obstacles = Obstacles::new(simulation.scene().obstacles().to_vec());
    let plant = simulation.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    living
        .filter(|&id| {
            let end = plant.metamers().end(id);
            let start = plant.metamers().parent(id).map_or(end, |parent| plant.metamers().end(parent));
            obstacles.contains(end) || obstacles.hides(start, end)
        })
        .count()
}

fn mean_light(simulation: &Simulation) -> f32 {
    let mut shown = simulation.clone();
    shown.show();
    let plant = shown.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    let light: Vec<f32> = living.map(|id| f32::from(plant.metamers().condition(id).light)).collect();
    light.iter().sum::<f32>() / light.len() as f32 / 255.0
}

#[test]
fn a_tree_keeps_to_its_side_of_a_wall() {
    let freely = grown_among(4, Vec::new(), 14);
    let beyond = nodes(&freely).iter().filter(|node| node.x > 3.0).count();
    assert!(beyond > 100, "without a wall {beyond} nodes lie there");
    let plane = obstacle(Shape::Plane { point: Vec3::X * 3.0, normal: Vec3::NEG_X });
    let thin = cuboid(Vec3::new(3.0, -9.0, -200.0), Vec3::new(3.1, 200.0, 200.0));
    for (name, wall) in [("plane", plane), ("thin box", thin), ("sheet", sheet(3.0))] {
        let simulation = grown_among(4, vec![wall], 14);
        assert!(simulation.plant().living_count() > 300, "{name}: it grows");
        assert_eq!(violations(&simulation), 0, "{name}");
        assert_eq!(checks::all(simulation.plant()), Ok(()), "{name}");
        let farthest = nodes(&simulation).iter().fold(f32::MIN, |far, node| far.max(node.x));
        assert!((2.0..3.0).contains(&farthest), "{name}: it reaches the wall, {farthest}");
    }
}

#[test]
fn a_tree_under_a_box_grows_out_sideways() {
    let roof = cuboid(Vec3::new(-6.0, 8.0, -6.0), Vec3::new(6.0, 10.0, 6.0));
    let simulation = grown_among(3, vec![roof], 26);
    assert_eq!(violations(&simulation), 0);
    let nodes = nodes(&simulation);
    assert!(nodes.iter().any(|node| node.x.abs().max(node.z.abs()) > 6.0), "it comes out from below");
    assert!(nodes.iter().any(|node| node.y > 11.0), "and on top of it");
}

#[test]
fn a_roof_shades_the_tree_under_it() {
    let roof = cuboid(Vec3::new(-200.0, 35.0, -200.0), Vec3::new(200.0, 36.0, 200.0));
    let (open, shaded) = (grown_among(5, Vec::new(), 8), grown_among(5, vec![roof], 8));
    let (open, shaded) = (mean_light(&open), mean_light(&shaded));
    assert!(shaded < 0.5 * open, "{shaded} under the roof, {open} without");
}

#[test]
fn a_tree_leans_away_from_a_shading_wall() {
    // Far enough not to be touched: only light tells of it.
    let wall = cuboid(Vec3::new(9.0, 0.0, -90.0), Vec3::new(10.0, 90.0, 90.0));
    let lean = |obstacles: Vec<Obstacle>| {
        let mut simulation = simulation(6);
        let mut values = simulation.parameters().values().clone();
        values.light_sensitivity = 3.0;
        simulation.set_parameters(Parameters::new(values).expect("in range"));
        simulation.set_obstacles(obstacles);
        grow(&mut simulation, 16);
        let nodes = nodes(&simulation);
        nodes.iter().map(|node| node.x).sum::<f32>() / nodes.len() as f32
    };
    let (open, walled) = (lean(Vec::new()), lean(vec![wall]));
    assert!(walled < open - 0.5, "{walled} beside the wall, {open} in the open");
}

#[test]
fn markers_in_and_behind_obstacles_are_not_claimed() {
    let mut simulation = simulation(2);
    grow(&mut simulation, 3);
    let ball = obstacle(Shape::Sphere { centre: Vec3::new(0.0, 20.0, 0.0), radius: 5.0 });
    simulation.set_obstacles(vec![ball.clone(), sheet(4.0)]);
    let circle: Vec<Vec2> = (0..32)
        .map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * core::f32::consts::TAU / 32.0);
            Vec2::new(10.0 * cos, 16.0 + 14.0 * sin)
        })
        .collect();
    let plane = Plane { origin: Vec3::ZERO, right: Vec3::X, up: Vec3::Y };
    simulation.enclose(&Envelope::inflate(&circle, plane, 1.0, 1.5).expect("a lasso"));
    let solid = Obstacles::new(vec![ball]);
    assert!(!simulation.markers().is_empty());
    assert!(simulation.markers().iter().all(|marker| !solid.contains(marker.position)));
    for _ in 0..30 {
        simulation.step(&StepInput::default(), &mut NoObserver);
    }
    assert_eq!(violations(&simulation), 0);
    assert!(nodes(&simulation).iter().all(|node| node.x < 4.0), "nobody reaches through the sheet");
    assert!(simulation.markers().iter().any(|marker| marker.position.x > 5.0), "its markers stay");
}

/// A sheet over the seed, so low that it hides all the bud perceives, and so small that it leaves some light.
fn lid() -> Obstacle {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let vertices = corners.map(|(x, z)| Vec3::new(x, 0.5, z)).to_vec();
    let mesh = TriangleMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    standing(mesh)
}

#[test]
fn a_bud_does_not_see_through_a_lid() {
    let above = BrushSample { position: Vec3::Y * 4.0, radius: 2.0 };
    let brushed = || StepInput {
        pieces: vec![BrushPiece { stroke: StrokeId(1), samples: vec![above] }],
        ..StepInput::default()
    };
    let autonomous = || StepInput { autonomous: true, ..StepInput::default() };
    for input in [brushed(), autonomous()] {
        let enabled = |obstacles: Vec<Obstacle>| {
            let mut simulation = simulation(1);
            simulation.set_obstacles(obstacles);
            simulation.step(&input, &mut NoObserver).buds_enabled
        };
        assert_eq!((enabled(Vec::new()), enabled(vec![lid()])), (1, 0), "{input:?}");
    }
}

#[test]
fn a_brush_sows_nothing_in_solids() {
    let mut simulation = simulation(1);
    let (centre, radius) = (Vec3::Y * 40.0, 6.0);
    simulation.set_obstacles(vec![obstacle(Shape::Sphere { centre, radius })]);
    let sample = BrushSample { position: centre, radius: 8.0 };
    let piece = BrushPiece { stroke: StrokeId(1), samples: vec![sample] };
    simulation.step(&StepInput { pieces: vec![piece], ..StepInput::default() }, &mut NoObserver);
    assert!(simulation.markers().len() > 50);
    assert!(simulation.markers().iter().all(|marker| marker.position.distance(centre) >= radius));
}

#[test]
fn a_brush_does_not_pass_a_wall() {
    let mut simulation = simulation(2);
    simulation.set_obstacles(vec![sheet(6.0)]);
    brush(&mut simulation, 1, &[(Vec3::ZERO, 2.5), (Vec3::Y * 12.0, 2.5), (Vec3::new(14.0, 14.0, 0.0), 2.5)]);
    assert_eq!(violations(&simulation), 0);
    assert!(simulation.plant().living_count() > 20);
}

#[test]
fn a_sketch_stops_at_a_wall_and_goes_around_a_ball() {
    let mut walled = simulation(5);
    walled.set_obstacles(vec![sheet(6.0)]);
    let across = [(Vec3::ZERO, 0.0), (Vec3::Y * 10.0, 0.0), (Vec3::new(16.0, 10.0, 0.0), 0.0)];
    brush(&mut walled, 1, &across);
    assert_eq!(violations(&walled), 0);
    assert!(walled.plant().living_count() < 24, "it does not wander: {}", walled.plant().living_count());

    let mut rounded = simulation(5);
    rounded.set_obstacles(vec![obstacle(Shape::Sphere { centre: Vec3::new(1.0, 14.0, 0.0), radius: 4.0 })]);
    brush(&mut rounded, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * 30.0, 0.0)]);
    assert_eq!(violations(&rounded), 0);
    let top = nodes(&rounded).iter().fold(0.0f32, |top, node| top.max(node.y));
    assert!(top > 29.0, "it comes out above, at {top}");
}

#[test]
fn wood_inside_an_obstacle_stays_but_does_not_grow() {
    let mut simulation = simulation(1);
    grow(&mut simulation, 5);
    let before = simulation.plant().living_count();
    simulation.set_obstacles(vec![obstacle(Shape::Sphere { centre: Vec3::Y * 10.0, radius: 60.0 })]);
    grow(&mut simulation, 3);
    assert_eq!(simulation.plant().living_count(), before);
    simulation.set_obstacles(Vec::new());
    grow(&mut simulation, 3);
    assert!(simulation.plant().living_count() > before);
}

pub(super) fn any_obstacle() -> impl Strategy<Value = Obstacle> {
    let place = || (-12f32..12.0, 0f32..25.0, -12f32..12.0).prop_map(Vec3::from);
    let far_from_seed = |p: &Vec3| p.length() > 5.0;
    prop_oneof![
        (place().prop_filter("not on the seed", far_from_seed), 0.3f32..3.0)
            .prop_map(|(centre, radius)| obstacle(Shape::Sphere { centre, radius })),
        (place().prop_filter("not on the seed", far_from_seed), 0.2f32..2.5)
            .prop_map(|(centre, half)| cuboid(centre - half, centre + half)),
        (3f32..9.0).prop_map(sheet),
        (4f32..20.0).prop_map(|z| obstacle(Shape::Plane { point: Vec3::Z * -z, normal: Vec3::Z })),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn growth_among_obstacles_is_clean_and_repeatable(
        seed: u32,
        before in 0u32..6,
        obstacles in prop::collection::vec(any_obstacle(), 1..5),
    ) {
        let mut simulation = simulation(seed);
        simulation.set_metamer_budget(4000);
        simulation.set_obstacles(obstacles.clone());
        grow(&mut simulation, before + 6);
        prop_assert_eq!(violations(&simulation), 0);
        prop_assert_eq!(checks::all(simulation.plant()), Ok(()));
        // What is known of the sky and of closed markers changes nothing but the time it takes.
        let mut afresh = Simulation::from_state(simulation.plant().clone(), simulation.state());
        let back = simulation.plant().step().saturating_sub(3);
        let end = simulation.plant().step();
        simulation.go_to(back);
        simulation.go_to(end);
        simulation.set_obstacles(obstacles);
        grow(&mut simulation, 2);
        grow(&mut afresh, 2);
        prop_assert_eq!(simulation.plant().hash(), afresh.plant().hash());
    }
}
