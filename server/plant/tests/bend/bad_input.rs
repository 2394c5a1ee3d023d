//! Paths and touches that make no sense leave a branch that still does.

use espalier_plant::{Bend, Motion};
use glam::Vec3;

use crate::shapes::{Shape, places, settle};

fn assert_is_sound(bend: &Bend, name: &str) {
    for Motion { rotation, from, to } in bend.motions() {
        assert!(from.is_finite() && to.is_finite(), "{name}: from {from} to {to}");
        assert!((rotation.length() - 1.0).abs() < 1e-5, "{name}: {rotation}");
    }
}

#[test]
fn a_base_alone_cannot_be_bent() {
    let mut bend = Bend::new(&[Vec3::ZERO, Vec3::Y], &[0.1], 0.0);
    settle(&mut bend, &[(0, Vec3::X), (1, Vec3::X)]);
    assert_eq!(bend.motions().len(), 1);
    assert!(bend.motions()[0].is_rest());
}

#[test]
fn one_internode_turns_about_the_base() {
    let mut bend = Bend::new(&[Vec3::ZERO, Vec3::Y, 2.0 * Vec3::Y], &[0.1, 0.1], 0.0);
    settle(&mut bend, &[(1, Vec3::new(1.0, 1.0, 0.0))]);
    let end = places(&bend)[1];
    assert!((end - Vec3::new(1.0, 1.0, 0.0)).length() < 0.05, "{end}");
    assert_is_sound(&bend, "one internode");
}

#[test]
fn a_target_that_is_no_number_changes_nothing() {
    let shape = Shape::curved(20, 0.3);
    let target = shape.tip() + Vec3::new(3.0, -2.0, 1.0);
    for broken in [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NEG_INFINITY, 1.0)] {
        let (mut bend, mut asked) = (shape.bend(0.2), shape.bend(0.2));
        bend.drag(&[(shape.last(), broken)]);
        assert!(bend.motions().iter().all(Motion::is_rest));
        bend.drag(&[(shape.last(), target)]);
        bend.drag(&[(shape.last(), broken), (7, broken)]);
        asked.drag(&[(shape.last(), target)]);
        asked.drag(&[(shape.last(), target)]);
        assert_eq!(bend.state(), asked.state());
    }
}

#[test]
fn the_last_word_on_a_touch_counts() {
    let shape = Shape::curved(20, 0.3);
    let (mut twice, mut once) = (shape.bend(0.2), shape.bend(0.2));
    let (first, second) = (shape.tip() + Vec3::X, shape.tip() - Vec3::Y);
    twice.drag(&[(19, first), (9, shape.nodes[10]), (19, second), (20, first), (usize::MAX, first)]);
    once.drag(&[(9, shape.nodes[10]), (19, second)]);
    assert_eq!(twice.state(), once.state());
}

#[test]
fn far_targets_pull_but_do_not_break() {
    for shape in Shape::all(30).into_iter().chain(Shape::all(2)) {
        for stretch in [0.0, 0.5, 1.0, -3.0, 7.0, f32::NAN] {
            let mut bend = shape.bend(stretch);
            for far in [1e4, -1e9, 3e38] {
                settle(&mut bend, &[(shape.last(), far * Vec3::ONE), (shape.last() / 2, -far * Vec3::X)]);
                assert_is_sound(&bend, &shape.name);
            }
            settle(&mut bend, &[(shape.last(), shape.tip())]);
            assert!(shape.deviation(&bend.motions()) < 1e-6, "{}, stretch {stretch}", shape.name);
        }
    }
}

#[test]
fn coincident_nodes_and_no_radius_are_borne() {
    let coincident = Shape::new("all in one place", 12, |_, _| Vec3::ZERO, 0.5);
    let half = Shape::new("half in one place", 12, |_, i| if i < 6 { Vec3::Y } else { Vec3::ZERO }, 0.5);
    let every_other = Shape::new("every other", 13, |_, i| (i % 2) as f32 * Vec3::Y, 0.5);
    let mut without_radius = Shape::curved(12, 0.5);
    without_radius.radii.fill(0.0);
    let mut broken_radius = Shape::curved(12, 0.5);
    broken_radius.radii[5] = f32::NAN;
    for shape in [coincident, half, every_other, without_radius, broken_radius] {
        let mut bend = shape.bend(0.3);
        for target in [Vec3::ZERO, shape.tip() + Vec3::X, shape.tip()] {
            settle(&mut bend, &[(shape.last(), target), (shape.last() / 2, 0.5 * target)]);
            assert_is_sound(&bend, &shape.name);
        }
    }
}

#[test]
fn a_state_that_does_not_fit_is_refused() {
    let shape = Shape::curved(12, 0.5);
    let mut bend = shape.bend(0.3);
    bend.drag(&[(5, Vec3::ZERO), (11, Vec3::X)]);
    let state = bend.state();
    assert!(Bend::from_state(&state).is_some());
    let broken = |change: fn(&mut espalier_plant::BendState)| {
        let mut state = state.clone();
        change(&mut state);
        Bend::from_state(&state).is_none()
    };
    assert!(broken(|state| state.prisms.truncate(4)));
    assert!(broken(|state| state.prisms[3][5] = f64::NAN));
    assert!(broken(|state| state.prisms[3] = [0.0; 7]));
    assert!(broken(|state| state.nodes.truncate(4)));
    assert!(broken(|state| state.nodes[2].x = f32::INFINITY));
    assert!(broken(|state| (state.radii.clear(), state.nodes.truncate(1)).0));
    assert!(broken(|state| state.targets[0].0 = 0));
    assert!(broken(|state| state.targets[1].0 = 12));
    assert!(broken(|state| state.targets.reverse()));
    assert!(broken(|state| state.targets[0].1[2] = f64::INFINITY));
}
