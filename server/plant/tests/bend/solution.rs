//! Where a branch goes.

use espalier_plant::{Bend, Motion};
use glam::{EulerRot, Quat, Vec3};

use crate::shapes::{Shape, places, settle};

/// Angle in radians by which each internode has turned against the one before.
fn bends(motions: &[Motion]) -> Vec<f32> {
    motions.windows(2).map(|pair| pair[0].rotation.angle_between(pair[1].rotation)).collect()
}

#[test]
fn nothing_moves_until_it_is_pulled() {
    for shape in Shape::all(400) {
        let mut bend = shape.bend(0.5);
        assert!(bend.motions().iter().all(Motion::is_rest), "{}", shape.name);
        bend.drag(&[(shape.last(), shape.tip())]);
        bend.relax();
        assert!(bend.motions().iter().all(Motion::is_rest), "{}", shape.name);
        assert!(bend.energy() < 1e-20, "{}", shape.name);
    }
}

#[test]
fn the_base_stays_where_it_is() {
    for shape in Shape::all(9) {
        let mut bend = shape.bend(0.5);
        settle(&mut bend, &[(shape.last(), shape.tip() + 3.0 * Vec3::X), (0, 7.0 * Vec3::Z)]);
        assert!(bend.motions()[0].is_rest() && !bend.motions()[1].is_rest(), "{}", shape.name);
    }
}

#[test]
fn touches_within_reach_are_met() {
    for shape in Shape::all(60).into_iter().chain([Shape::curved(700, 0.3)]) {
        // Where its nodes would be if every internode turned a little more than the one below.
        let mut place = shape.nodes[1];
        let wound = shape.nodes.windows(2).enumerate().skip(1).map(|(i, pair)| {
            let share = i as f32 / shape.last() as f32;
            place += Quat::from_euler(EulerRot::XYZ, 0.7 * share, 0.0, 0.4 * share) * (pair[1] - pair[0]);
            place
        });
        let wound: Vec<Vec3> = wound.collect();
        let touched = [shape.last() / 3, 2 * shape.last() / 3, shape.last()];
        let targets = touched.map(|at| (at, wound[at - 1]));
        for stretch in [0.0, 0.5, 1.0] {
            let mut bend = shape.bend(stretch);
            settle(&mut bend, &targets);
            for &(at, target) in &targets {
                let missed = bend.motions()[at].to.distance(target) / shape.length();
                assert!(missed < 0.01, "{}, stretch {stretch}: missed by {missed}", shape.name);
            }
        }
    }
}

#[test]
fn a_stiff_branch_keeps_its_length() {
    for shape in Shape::all(50) {
        for way in [Vec3::new(0.4, -0.3, 0.2), Vec3::new(-0.3, -0.6, 0.0), Vec3::new(0.0, -0.5, 0.0)] {
            let mut bend = shape.bend(0.0);
            settle(&mut bend, &[(shape.last(), shape.tip() + shape.length() * way)]);
            let longer = shape.length_in(&bend.motions()) / shape.length() - 1.0;
            assert!(longer.abs() < 0.06, "{}: {longer}", shape.name);
        }
    }
}

#[test]
fn pulled_beyond_reach_only_rubber_follows() {
    let shape = Shape::straight(40, 0.5);
    let target = shape.tip() + shape.length() * Vec3::Y;
    let longer = [0.0, 0.25, 0.5, 0.75, 1.0].map(|stretch| {
        let mut bend = shape.bend(stretch);
        settle(&mut bend, &[(shape.last(), target)]);
        shape.length_in(&bend.motions()) / shape.length() - 1.0
    });
    assert!(longer.windows(2).all(|pair| pair[0] < pair[1]), "{longer:?}");
    assert!(longer[0] < 0.025 && longer[4] > 0.95, "{longer:?}");
}

#[test]
fn rubber_shrinks_where_stiff_wood_bends() {
    let shape = Shape::straight(40, 0.5);
    let target = shape.tip() - 0.25 * shape.length() * Vec3::Y;
    let [stiff, rubber] = [0.0, 1.0].map(|stretch| {
        let mut bend = shape.bend(stretch);
        for _ in 0..20 {
            bend.drag(&[(shape.last(), target)]);
        }
        let aside =
            places(&bend).into_iter().map(|place| (place - shape.nodes[0]).reject_from(Vec3::Y).length());
        (shape.length_in(&bend.motions()) / shape.length(), aside.fold(0.0, f32::max))
    });
    assert!(stiff.0 > 0.98 && stiff.1 > 0.2 * shape.length(), "{stiff:?}");
    assert!(rubber.0 < 0.85 && rubber.1 < stiff.1, "{rubber:?}");
}

#[test]
fn thick_wood_bends_less_than_thin() {
    let target = |shape: &Shape| shape.tip() + shape.length() * Vec3::new(0.4, -0.2, 0.0);
    let [even, tapered] = [1.0, 0.15].map(|tip| {
        let shape = Shape::straight(40, tip);
        let mut bend = shape.bend(0.0);
        settle(&mut bend, &[(shape.last(), target(&shape))]);
        let bends = bends(&bend.motions());
        bends[..10].iter().sum::<f32>() / bends.iter().sum::<f32>()
    });
    assert!(tapered < 0.6 * even, "the lowest quarter bends by {tapered} of the whole, evenly {even}");
}

#[test]
fn a_turn_of_the_whole_bends_nothing_above_the_first_joint() {
    let shape = Shape::zigzag(30, 0.4);
    let turn = Quat::from_axis_angle(Vec3::Z, 0.1);
    let pivot = shape.nodes[1];
    let targets: Vec<_> =
        (1..=shape.last()).map(|at| (at, pivot + turn * (shape.nodes[at + 1] - pivot))).collect();
    let mut bend = shape.bend(0.0);
    settle(&mut bend, &targets);
    let bends = bends(&bend.motions());
    assert!(bends[3..].iter().all(|&angle| angle < 0.01), "{bends:?}");
    for motion in &bend.motions()[8..] {
        assert!(motion.rotation.angle_between(turn) < 0.01, "{motion:?}");
    }
}

#[test]
fn mirrored_touches_give_a_mirrored_bend() {
    let shape = Shape::straight(30, 0.4);
    let pulled = |x: f32| {
        let mut bend = shape.bend(0.3);
        settle(
            &mut bend,
            &[(12, shape.nodes[13] + x * Vec3::X), (29, shape.tip() - Vec3::new(2.0 * x, 3.0, 0.0))],
        );
        places(&bend)
    };
    for (left, right) in pulled(-4.0).into_iter().zip(pulled(4.0)) {
        let mirrored = Vec3::new(2.0 * shape.nodes[0].x - left.x, left.y, left.z);
        assert!(mirrored.distance(right) < 1e-3, "{left} {right}");
    }
}

#[test]
fn the_scene_may_be_turned_and_scaled() {
    let shape = Shape::uneven(25, 0.3);
    let (turn, scale) = (Quat::from_rotation_x(1.0) * Quat::from_rotation_y(2.0), 0.01);
    let moved = |place: &Vec3| turn * (scale * *place);
    let nodes: Vec<Vec3> = shape.nodes.iter().map(moved).collect();
    let target = shape.tip() + 0.3 * shape.length() * Vec3::new(1.0, -0.6, 0.5);
    let (mut here, mut there) = (shape.bend(0.3), Bend::new(&nodes, &shape.radii, 0.3));
    settle(&mut here, &[(shape.last(), target)]);
    settle(&mut there, &[(shape.last(), moved(&target))]);
    for (here, there) in places(&here).iter().zip(places(&there)) {
        assert!(moved(here).distance(there) < 1e-4 * scale * shape.length(), "{here} {there}");
    }
}

#[test]
fn energy_never_rises_while_touches_rest() {
    for shape in Shape::all(40).into_iter().chain([Shape::uneven(900, 0.2)]) {
        for stretch in [0.0, 0.4, 1.0] {
            let mut bend = shape.bend(stretch);
            let ways = [Vec3::X, -2.0 * Vec3::Y, Vec3::new(-1.0, -1.0, 0.3), Vec3::new(0.2, 0.3, 0.1)];
            for way in ways {
                let targets = [(shape.last(), shape.tip() + shape.length() * way)];
                bend.drag(&targets);
                let mut before = bend.energy();
                for _ in 0..10 {
                    bend.drag(&targets);
                    let after = bend.energy();
                    // Sums of energies are rounded.
                    assert!(
                        after <= before * (1.0 + 1e-12),
                        "{}, {stretch}, {way}: {before} to {after}",
                        shape.name
                    );
                    before = after;
                }
            }
        }
    }
}

#[test]
fn grouped_prisms_bend_as_single_ones_do() {
    // Beyond 300 prisms several internodes share one; halves of the same curve must agree.
    let [single, grouped] = [300, 900].map(|internodes| {
        let shape = Shape::curved(internodes, 0.2);
        let mut bend = shape.bend(0.2);
        let end = shape.tip() + shape.length() * Vec3::new(-0.4, -0.2, 0.3);
        settle(&mut bend, &[(shape.last(), end)]);
        (1..10)
            .map(|tenth| {
                let place = bend.motions()[tenth * internodes / 10 - 1].to - shape.nodes[1];
                place / shape.length()
            })
            .collect::<Vec<_>>()
    });
    for (single, grouped) in single.into_iter().zip(grouped) {
        assert!(single.distance(grouped) < 0.01, "{single} {grouped}");
    }
}
