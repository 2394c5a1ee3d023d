//! The lasso (TreeSketch §3.2, Figure 7): a crown grows into the drawn silhouette and fills it.

use espalier_growth::{Envelope, MarkerSource, Plane};
use glam::Vec2;

use super::*;

const FRONT: Plane = Plane { origin: Vec3::ZERO, right: Vec3::X, up: Vec3::Y };

fn ellipse(centre: Vec2, half: Vec2) -> Vec<Vec2> {
    (0..64)
        .map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * core::f32::consts::TAU / 64.0);
            centre + Vec2::new(cos, sin) * half
        })
        .collect()
}

fn envelope(outline: &[Vec2], simulation: &Simulation) -> Envelope {
    Envelope::inflate(outline, FRONT, 1.0, simulation.parameters().occupancy_radius).expect("a lasso")
}

#[test]
fn a_lasso_sows_lasting_markers_as_growth_comes_near() {
    let mut simulation = simulation(1);
    let ball = envelope(&ellipse(Vec2::new(0.0, 19.0), Vec2::splat(12.0)), &simulation);
    simulation.enclose(&ball);
    assert!(simulation.markers().is_empty(), "nobody perceives any");
    let step = |simulation: &mut Simulation| simulation.step(&StepInput::default(), &mut NoObserver);
    while simulation.markers().is_empty() {
        assert!(step(&mut simulation).metamers_grown > 0, "a limb comes to it");
    }
    let (sown, near) = (simulation.markers().to_vec(), nodes(&simulation));
    assert!(sown.iter().all(|marker| marker.source == MarkerSource::Lasso));
    assert!(sown.iter().all(|marker| ball.contains(marker.position)));
    assert!((sown.len() as f64) < 0.25 * ball.volume(), "{} are laid at once", sown.len());
    let away =
        |place: Vec3| near.iter().map(|node| node.truncate().distance(place.truncate())).fold(99.0, f32::min);
    assert!(sown.iter().all(|marker| away(marker.position) < 10.0));
    // Those that nobody has grown into are there when a brush's would be too old.
    let ticks = simulation.parameters().marker_max_age + 1;
    for _ in 0..ticks {
        step(&mut simulation);
    }
    assert!(simulation.markers().iter().any(|marker| sown.contains(marker)));
    simulation.drop_guidance();
    assert!(simulation.markers().is_empty());
}

#[test]
fn a_crown_fills_its_lasso() {
    let mut simulation = simulation(3);
    let crown = envelope(&ellipse(Vec2::new(0.0, 17.0), Vec2::new(14.0, 17.0)), &simulation);
    simulation.enclose(&crown);
    settle(&mut simulation);
    let left = simulation.markers().len();
    let sown = crown.volume() * 0.25;
    assert!((left as f64) * 8.0 < sown, "{left} of {sown} markers are left");
    let nodes = nodes(&simulation);
    let outside = nodes.iter().filter(|node| !crown.contains(**node)).count();
    assert!(nodes.len() > 300 && outside * 5 < nodes.len(), "{outside} of {} are outside", nodes.len());
}

#[test]
fn a_lasso_extends_a_crown_that_is_there() {
    let mut simulation = simulation(4);
    grow(&mut simulation, 12);
    let before = nodes(&simulation);
    let wing = envelope(&ellipse(Vec2::new(16.0, 16.0), Vec2::new(14.0, 5.0)), &simulation);
    let inside = |nodes: &[Vec3]| nodes.iter().filter(|node| wing.contains(**node)).count();
    simulation.enclose(&wing);
    settle(&mut simulation);
    let after = nodes(&simulation);
    assert_eq!(after[..before.len()], before, "what stood stays");
    let (grown, in_wing) = (after.len() - before.len(), inside(&after) - inside(&before));
    assert!(in_wing > 60 && in_wing * 10 > grown * 7, "{in_wing} of {grown} grew into the wing");
    let reach = |nodes: &[Vec3]| nodes.iter().fold(0.0, |reach: f32, node| reach.max(node.x));
    assert!(reach(&before) < 20.0 && reach(&after) > 26.0, "{} to {}", reach(&before), reach(&after));
}

/// Share of a front view's points that lie in both of outline and tree, among those in either.
fn overlap(outline: &[Vec2], nodes: &[Vec3]) -> f32 {
    let is_drawn = |p: Vec2| {
        let mut crossings = 0;
        for (i, &a) in outline.iter().enumerate() {
            let b = outline[(i + 1) % outline.len()];
            let is_level = (a.y > p.y) != (b.y > p.y);
            crossings += u32::from(is_level && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
        crossings % 2 == 1
    };
    // A node's leaves reach about so far to its sides.
    let is_grown = |p: Vec2| nodes.iter().any(|node| node.truncate().distance(p) < 0.75);
    let (mut both, mut either) = (0, 0);
    for i in 0..110 * 110 {
        let p = Vec2::new((i % 110) as f32 - 55.0, (i / 110) as f32) * 0.5;
        let (drawn, grown) = (is_drawn(p), is_grown(p));
        (both, either) = (both + u32::from(drawn && grown), either + u32::from(drawn || grown));
    }
    both as f32 / either as f32
}

/// Outlines that growth once left by the luck of the seed, or could not reach or fill.
const HARD: [(&str, &str, f32); 4] = [
    (
        "star above the seedling",
        "0,38 4.5,27.2 17.1,25.6 8.6,16.8 10.6,3.4 0,10 -10.6,3.4 -8.6,16.8 -17.1,25.6 -4.5,27.2",
        0.7,
    ),
    (
        "R with a hole",
        "-6,0 -2,0 -2,8 0,8 4,0 8,0 3,8.5 6,10 7,13 7,16 6,18 3,20 -6,20 -2,17 2,17 3.5,15.5 3.5,13 2,11 -2,11 \
         -2,17 -6,20",
        0.6,
    ),
    (
        "thin ring",
        "0,0 7,3 10,10 7,17 0,20 -7,17 -10,10 -7,3 0,0 0,2.2 -5.4,4.6 -7.8,10 -5.4,15.4 0,17.8 5.4,15.4 7.8,10 5.4,4.6 0,2.2",
        0.6,
    ),
    ("bar", "-2,0 2,0 10,36 6,36", 0.6),
];

fn polygon(corners: &str) -> Vec<Vec2> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        Vec2::new(x.parse().expect("a number"), y.parse().expect("a number"))
    };
    corners.split_whitespace().map(point).collect()
}

#[test]
fn no_seed_leaves_an_outline() {
    for (name, corners, least) in HARD {
        let outline = polygon(corners);
        for seed in 1..=12 {
            let mut simulation = simulation(seed);
            simulation.enclose(&envelope(&outline, &simulation));
            settle(&mut simulation);
            let share = overlap(&outline, &nodes(&simulation));
            assert!(share > least, "{name}, seed {seed}: {share}");
        }
    }
}

#[test]
fn growth_into_an_outline_comes_to_its_end() {
    let mut simulation = simulation(1);
    simulation.enclose(&envelope(
        &polygon("-10,0 12,0 12,5 -4,5 -4,15 9,15 9,20 -4,20 -4,31 12,31 12,36 -10,36"),
        &simulation,
    ));
    let step =
        |simulation: &mut Simulation| simulation.step(&StepInput::default(), &mut NoObserver).metamers_grown;
    let steps = (0..400).take_while(|_| step(&mut simulation) > 0).count();
    assert!(steps < 60, "{steps}");
}

#[test]
fn a_square_of_400_is_filled_by_what_the_scene_has_room_for() {
    const BUDGET: u32 = 400_000;
    let mut simulation = simulation(1);
    simulation.set_metamer_budget(BUDGET);
    simulation.enclose(&envelope(&polygon("-200,0 200,0 200,400 -200,400"), &simulation));
    settle(&mut simulation);
    let nodes = nodes(&simulation);
    assert!(nodes.len() < BUDGET as usize / 2, "{}", nodes.len());
    let mut is_filled = [[false; 80]; 80];
    for node in nodes {
        let cell = |along: f32| (along.clamp(0.0, 399.9) / 5.0) as usize;
        is_filled[cell(node.y)][cell(node.x + 200.0)] = true;
    }
    let filled = is_filled.iter().flatten().filter(|&&is_filled| is_filled).count();
    assert!(filled * 100 > 80 * 80 * 97, "{filled} of 6400");
}

#[test]
fn silhouettes_are_recognisable_from_the_front() {
    let swan = "-2,0 2,0 3,6 14,8 18,14 17,18 10,14 2,15 -4,20 -7,26 -5,31 -8,35 -13,34 -18,31 -13,30 -12,26 \
                -12,18 -10,11 -5,7";
    let bottle = "-9,0.5 9,0.5 9,22 3.5,28 3.5,40 -3.5,40 -3.5,28 -9,22";
    let cross = "-5,0.5 5,0.5 5,20 18,20 18,30 5,30 5,42 -5,42 -5,30 -18,30 -18,20 -5,20";
    let square = "-14,0.5 14,0.5 14,28 -14,28";
    for (name, text) in [("swan", swan), ("bottle", bottle), ("cross", cross), ("square", square)] {
        let outline = polygon(text);
        let mut simulation = simulation(3);
        let mut values = simulation.parameters().values().clone();
        // Buds that look around, turn to where there is room, and do not overshoot.
        (values.perception_angle, values.max_shoot_length) = (150.0, 3);
        (values.heading_weight, values.tropism_weight, values.space_weight) = (0.45, 0.05, 0.5);
        simulation.set_parameters(Parameters::new(values).expect("in range"));
        let body = envelope(&outline, &simulation);
        simulation.enclose(&body);
        settle(&mut simulation);
        let share = overlap(&outline, &nodes(&simulation));
        assert!(share > 0.85, "{name}: {share}");
    }
}

#[test]
fn a_lasso_underground_sows_above_it_only() {
    let mut simulation = simulation(1);
    let half_buried = envelope(&ellipse(Vec2::ZERO, Vec2::splat(10.0)), &simulation);
    simulation.enclose(&half_buried);
    assert!(simulation.markers().len() > 100);
    assert!(simulation.markers().iter().all(|marker| marker.position.y > 0.0));
}

#[test]
fn two_lassos_at_once_sow_different_places() {
    let mut simulation = simulation(1);
    let ball = envelope(&ellipse(Vec2::new(0.0, 6.0), Vec2::splat(8.0)), &simulation);
    simulation.enclose(&ball);
    let first = simulation.markers().to_vec();
    simulation.enclose(&ball);
    let second = &simulation.markers()[first.len()..];
    assert!(first.len() > 100 && second.len() > 100);
    assert!(second.iter().all(|marker| first.iter().all(|other| other.position != marker.position)));
}

#[test]
fn the_same_lasso_gives_the_same_plant() {
    let life = || {
        let mut simulation = simulation(6);
        let crown = envelope(&ellipse(Vec2::new(2.0, 12.0), Vec2::new(8.0, 12.0)), &simulation);
        simulation.enclose(&crown);
        settle(&mut simulation);
        simulation.plant().hash()
    };
    assert_eq!(life(), life());
}
