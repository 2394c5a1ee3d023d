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
fn a_lasso_sows_lasting_markers_by_volume() {
    let mut simulation = simulation(1);
    let ball = envelope(&ellipse(Vec2::new(0.0, 30.0), Vec2::splat(12.0)), &simulation);
    simulation.enclose(&ball);
    // Denser than the brush sows by default, so that narrow necks are found.
    let expected = ball.volume() * 0.25;
    let sown = simulation.markers().len();
    assert!((sown as f64 - expected).abs() <= 1.0, "{sown} of {expected}");
    assert!(simulation.markers().iter().all(|marker| marker.source == MarkerSource::Lasso));
    assert!(simulation.markers().iter().all(|marker| ball.contains(marker.position)));
    for _ in 0..=simulation.parameters().marker_max_age {
        simulation.step(&StepInput::default(), &mut NoObserver);
    }
    assert_eq!(simulation.markers().len(), sown, "nobody is near, and they do not age");
    assert!(simulation.has_guidance());
    simulation.drop_guidance();
    assert!(simulation.markers().is_empty());
}

#[test]
fn a_crown_fills_its_lasso() {
    let mut simulation = simulation(3);
    let crown = envelope(&ellipse(Vec2::new(0.0, 17.0), Vec2::new(14.0, 17.0)), &simulation);
    simulation.enclose(&crown);
    let sown = simulation.markers().len();
    settle(&mut simulation);
    let left = simulation.markers().len();
    assert!(left * 8 < sown, "{left} of {sown} markers are left");
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
    // A node's leaves reach a little farther than an internode.
    let is_grown = |p: Vec2| nodes.iter().any(|node| node.truncate().distance(p) < 1.25);
    let (mut both, mut either) = (0, 0);
    for i in 0..110 * 110 {
        let p = Vec2::new((i % 110) as f32 - 55.0, (i / 110) as f32) * 0.5;
        let (drawn, grown) = (is_drawn(p), is_grown(p));
        (both, either) = (both + u32::from(drawn && grown), either + u32::from(drawn || grown));
    }
    both as f32 / either as f32
}

#[test]
fn silhouettes_are_recognisable_from_the_front() {
    let swan = "-2,0 2,0 3,6 14,8 18,14 17,18 10,14 2,15 -4,20 -7,26 -5,31 -8,35 -13,34 -18,31 -13,30 -12,26 \
                -12,18 -10,11 -5,7";
    let bottle = "-9,0.5 9,0.5 9,22 3.5,28 3.5,40 -3.5,40 -3.5,28 -9,22";
    let cross = "-5,0.5 5,0.5 5,20 18,20 18,30 5,30 5,42 -5,42 -5,30 -18,30 -18,20 -5,20";
    let square = "-14,0.5 14,0.5 14,28 -14,28";
    for (name, text) in [("swan", swan), ("bottle", bottle), ("cross", cross), ("square", square)] {
        let point = |pair: &str| {
            let (x, y) = pair.split_once(',').expect("a pair");
            Vec2::new(x.parse().expect("a number"), y.parse().expect("a number"))
        };
        let outline: Vec<Vec2> = text.split_whitespace().map(point).collect();
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
fn lassos_together_sow_a_bounded_number() {
    let mut simulation = simulation(1);
    let huge = envelope(&ellipse(Vec2::new(0.0, 450.0), Vec2::splat(400.0)), &simulation);
    assert!(huge.volume() > 2e8);
    for _ in 0..3 {
        simulation.enclose(&huge);
        assert_eq!(simulation.markers().len(), 200_000);
    }
    // Thinned evenly: the lower half has as many as the upper one.
    let lower = simulation.markers().iter().filter(|marker| marker.position.y < 450.0).count();
    assert!((99_000..101_000).contains(&lower), "{lower}");
}

#[test]
fn two_lassos_at_once_sow_different_places() {
    let mut simulation = simulation(1);
    let ball = envelope(&ellipse(Vec2::new(0.0, 30.0), Vec2::splat(8.0)), &simulation);
    simulation.enclose(&ball);
    let first = simulation.markers().to_vec();
    simulation.enclose(&ball);
    let second = &simulation.markers()[first.len()..];
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
