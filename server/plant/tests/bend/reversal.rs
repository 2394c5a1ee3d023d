//! Touches brought back bring the branch back, and equal touches give equal branches.

use std::f32::consts::{PI, TAU};

use espalier_plant::{Bend, Motion};
use glam::Vec3;

use crate::shapes::Shape;

/// Deviation from rest that is allowed, as a share of the length. Positions are single precision.
fn allowed(shape: &Shape) -> f32 {
    if shape.radii.len() <= 300 { 1e-6 } else { 1e-4 }
}

/// Leads the end, and a touch between, around a closed way, and lifts them.
fn lead_around(shape: &Shape, stretch: f32, way: impl Fn(f32) -> Vec3) -> Bend {
    let mut bend = shape.bend(stretch);
    let middle = shape.last() / 2;
    for event in 1..=120 {
        let phase = if event == 120 { 0.0 } else { TAU * event as f32 / 120.0 };
        let way = shape.length() * way(phase);
        let mut targets = vec![(shape.last(), shape.tip() + way)];
        if middle > 0 {
            targets.push((middle, shape.nodes[middle + 1] + 0.4 * way));
        }
        bend.drag(&targets);
    }
    bend.relax();
    bend
}

fn check(shape: &Shape, stretch: f32, way: impl Fn(f32) -> Vec3) {
    let bend = lead_around(shape, stretch, way);
    let deviation = shape.deviation(&bend.motions());
    assert!(deviation <= allowed(shape), "{}, stretch {stretch}: {deviation}", shape.name);
    let turned = bend.motions().into_iter().map(|motion| motion.rotation.angle_between(glam::Quat::IDENTITY));
    assert!(turned.fold(0.0, f32::max) < 1e-3, "{}, stretch {stretch}", shape.name);
}

#[test]
fn a_branch_led_around_a_circle_comes_back() {
    for shape in [2, 5, 40, 300, 1000].into_iter().flat_map(Shape::all) {
        for stretch in [0.0, 0.5, 1.0] {
            let circle = |phase: f32| {
                0.4 * Vec3::new(libm::sinf(phase), libm::cosf(phase) - 1.0, 0.5 * libm::sinf(phase))
            };
            check(&shape, stretch, circle);
        }
    }
}

#[test]
fn a_branch_led_all_around_its_base_comes_back() {
    for shape in [5, 60, 1000].into_iter().flat_map(Shape::all) {
        let arm = (shape.tip() - shape.nodes[1]) / shape.length();
        let across = arm.cross(Vec3::new(0.3, 0.2, 1.0)).normalize() * arm.length();
        for stretch in [0.0, 1.0] {
            check(&shape, stretch, |phase| {
                0.8 * (libm::cosf(phase) * arm + libm::sinf(phase) * across) - 0.8 * arm
            });
        }
    }
}

#[test]
fn a_branch_that_was_crushed_comes_back() {
    for shape in [5, 60, 1000].into_iter().flat_map(Shape::all) {
        let arm = (shape.tip() - shape.nodes[1]) / shape.length();
        for stretch in [0.0, 0.5] {
            check(&shape, stretch, |phase| -0.7 * libm::fabsf(libm::sinf(0.5 * phase)) * arm);
        }
    }
}

#[test]
fn a_branch_pulled_far_away_comes_back() {
    for shape in [5, 60, 1000].into_iter().flat_map(Shape::all) {
        for stretch in [0.0, 1.0] {
            check(&shape, stretch, |phase| {
                5.0 * libm::sinf((0.5 * phase).min(PI)) * Vec3::new(1.0, 0.5, -0.5)
            });
        }
    }
}

#[test]
fn lifted_where_it_began_nothing_is_left() {
    let shape = Shape::uneven(80, 0.2);
    let bend = lead_around(&shape, 0.2, |phase| 0.2 * Vec3::new(libm::sinf(phase), -libm::sinf(phase), 0.0));
    assert!(bend.motions().iter().all(Motion::is_rest));
}

#[test]
fn equal_touches_bend_equally_to_the_bit() {
    for shape in Shape::all(60) {
        let around = || lead_around(&shape, 0.3, |phase| 0.3 * Vec3::new(libm::sinf(phase), phase, 0.2));
        assert_eq!(around().state(), around().state(), "{}", shape.name);
    }
}

#[test]
fn a_bend_goes_on_from_its_state_to_the_bit() {
    for shape in Shape::all(60).into_iter().chain(Shape::all(1)) {
        let mut bend = shape.bend(0.3);
        let target = |event: usize| shape.tip() + event as f32 * Vec3::new(0.5, -0.3, 0.2);
        (0..7).for_each(|event| bend.drag(&[(shape.last(), target(event))]));
        let mut again = Bend::from_state(&bend.state()).expect("a state that was taken fits");
        assert_eq!(again.state(), bend.state());
        for bend in [&mut bend, &mut again] {
            (7..12).for_each(|event| bend.drag(&[(shape.last(), target(event))]));
            bend.relax();
        }
        assert_eq!(again.state(), bend.state(), "{}", shape.name);
        assert_eq!(again.motions(), bend.motions(), "{}", shape.name);
    }
}
