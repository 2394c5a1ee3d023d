//! Jointed bodies: they swing as beams do, make no energy, and settle where the closed form has them.

use std::f64::consts::{PI, TAU};

use espalier_mesh::leaves::hash;
use espalier_motion::{
    Pose, Row, Rows, Scale,
    bodies::{AHEAD, Bodies, Joinery},
    statics::in_even_wind,
};
use glam::DVec3;

use crate::trees::{SEED, Tree, grown, pole};

const FREE: Joinery = Joinery { softness: 1.0, damping: 0.0, ahead: AHEAD };
/// Settles at once, so to speak.
const SETTLING: Joinery = Joinery { softness: 1.0, damping: 0.5, ahead: 1.0 };

fn settled(tree: &Tree, joinery: Joinery, forces: &[DVec3], seconds: u32) -> Bodies {
    let mut bodies = Bodies::of(&tree.wood, joinery);
    for _ in 0..60 * seconds {
        bodies.step(1.0 / 60.0, forces);
    }
    bodies
}

#[test]
fn a_cantilever_bends_as_theory_has_it() {
    for (pieces, tolerance) in [(10, 6e-3), (20, 2e-3), (40, 1e-3)] {
        let tree = pole(pieces, [0, (20 * 256 / pieces) as i32, 0], |_| 0.2);
        let radius = 0.1 * f64::from(espalier_mesh::radius_code::decode(crate::trees::code(0.2)));
        let rigidity = 7e9 * 0.25 * PI * radius * radius * radius * radius;
        let forces = vec![DVec3::X * 2.0 / f64::from(pieces); tree.rows.len()];
        let bodies = settled(&tree, SETTLING, &forces, 10);
        let found = bodies.node(pieces).expect("wood").x;
        let exact = 2.0 / 2.0 * 16.0 / (8.0 * rigidity);
        assert!((found / exact - 1.0).abs() < tolerance, "{pieces}: {found} for {exact}");
    }
}

#[test]
fn a_cantilever_swings_as_theory_has_it() {
    let tree = pole(20, [0, 256, 0], |_| 0.2);
    let radius = 0.1 * f64::from(espalier_mesh::radius_code::decode(crate::trees::code(0.2)));
    let exact = 3.516 * (7e9 * 0.25 * radius * radius / 950.0).sqrt() / 4.0 / TAU;
    let pushed = vec![DVec3::X * 2.0; tree.rows.len()];
    for (steps, tolerance) in [(60.0, 0.015), (240.0, 0.002)] {
        let mut bodies = settled(&tree, SETTLING, &pushed, 5);
        bodies.let_go(FREE);
        let still = vec![DVec3::ZERO; tree.rows.len()];
        let mut crossings = Vec::new();
        let mut before = bodies.node(20).expect("wood").x;
        for step in 1..=(4.0 * steps) as u32 {
            bodies.step(1.0 / steps, &still);
            let now = bodies.node(20).expect("wood").x;
            if before < 0.0 && now >= 0.0 {
                crossings.push((f64::from(step) - now / (now - before)) / steps);
            }
            before = now;
        }
        let turns = crossings.len() - 1;
        let found = turns as f64 / (crossings[turns] - crossings[0]);
        println!("{steps} steps a second: {found} Hz for {exact}");
        assert!((found / exact - 1.0).abs() < tolerance, "{steps} steps a second: {found} Hz for {exact}");
    }
}

/// A small tree of some rows, each on one of the last few before it.
fn random(seed: u32) -> Tree {
    let draw = |row: u32, what: u32| f64::from(hash(hash(seed) ^ (8 * row + what))) / (1u64 << 32) as f64;
    let mut rows = vec![SEED];
    for row in 1..8 + seed % 17 {
        let parent = row - 1 - (draw(row, 0) * draw(row, 1) * f64::from(row)) as u32;
        let from = rows[parent as usize].position;
        let to = |axis: usize, rise: f64| from[axis] + (256.0 * (draw(row, 2 + axis as u32) - rise)) as i32;
        rows.push(Row {
            parent: Some(parent),
            starts_axis: parent + 1 != row,
            position: [to(0, 0.5), to(1, 0.0), to(2, 0.5)],
            radius: crate::trees::code(0.02 + 0.2 * draw(row, 5)),
            leaves: (4.0 * draw(row, 6)) as u8,
        });
    }
    let rows = Rows::new(rows).expect("parents stand below");
    Tree::of("random", rows, Scale { internode_length: 0.3, leaf_size: 1.0 })
}

/// What becomes of a thrown tree: the most energy it has on its way, and what had to be taken from it, as shares of that
/// at the start.
fn thrown(seed: u32, rate: f64, joinery: Joinery, steps: u32, seconds: u32) -> [f64; 2] {
    let tree = random(seed);
    let mut bodies = Bodies::of(&tree.wood, joinery);
    let draw =
        |row: u32, what: u32| f64::from(hash(hash(!seed) ^ (4 * row + what))) / f64::from(u32::MAX) - 0.5;
    bodies.throw(|row| 2.0 * rate * DVec3::new(draw(row, 0), draw(row, 1), draw(row, 2)));
    let (start, still) = (bodies.energy(), vec![DVec3::ZERO; tree.rows.len()]);
    let [mut most, mut taken] = [0.0f64; 2];
    for _ in 0..steps * seconds {
        taken += bodies.step(1.0 / f64::from(steps), &still);
        most = most.max(bodies.energy());
    }
    [most / start, taken / start]
}

#[test]
fn thrown_trees_make_no_energy() {
    for seed in 0..50 {
        for (rate, steps, seconds) in [(1.0, 30, 8), (1.0, 240, 1), (3.0, 60, 4)] {
            let [most, _] = thrown(seed, rate, FREE, steps, seconds);
            assert!(most <= 1.0 + 1e-12, "tree {seed} at {steps} steps a second: {most}");
        }
    }
}

#[test]
fn hardly_any_energy_has_to_be_taken_but_with_springs_of_half_a_step_ahead() {
    let most = |trees, joinery| {
        let taken = (0..trees).map(|seed| thrown(seed, 1.0, joinery, 60, 20)[1]);
        taken.fold(0.0, f64::max)
    };
    let [usual, half] = [most(30, FREE), most(8, Joinery { ahead: 0.5, ..FREE })];
    assert!(usual < 0.02 && half > 1.0, "{usual} and {half}");
}

#[test]
fn bodies_settle_where_statics_and_the_closed_form_have_them() {
    let tree = grown("default", 600);
    let softness = tree.joints.all()[0].softness;
    let pressure = DVec3::new(0.8, 0.0, 0.6) * 0.4;
    let forces: Vec<DVec3> =
        (0..tree.rows.len() as u32).map(|row| pressure * tree.wood.drag_area(row)).collect();
    let bodies = settled(&tree, Joinery { softness, ..SETTLING }, &forces, 15);
    let exact = in_even_wind(&tree.wood, pressure);
    let bends: Vec<DVec3> = tree.joints.all().iter().map(|joint| joint.compliance * pressure).collect();
    assert!(bends.iter().all(|bend| bend.length() < 0.2));
    let pose = Pose::of(&tree.joints, &tree.wood, &bends);
    let [mut from_statics, mut from_pose, mut size] = [0.0; 3];
    for row in 0..tree.rows.len() as u32 {
        let Some(node) = bodies.node(row) else { continue };
        let rest = tree.wood.place(row);
        from_statics += (node - rest).distance_squared(softness * exact[row as usize].shift);
        from_pose += node.distance_squared(pose.node(&tree.joints, &tree.wood, row).place);
        size += node.distance_squared(rest);
    }
    let [from_statics, from_pose] = [from_statics, from_pose].map(|error| (error / size).sqrt());
    println!(
        "moved by {:.4} m rms; statics {from_statics:.4}, closed form {from_pose:.4} off",
        (size / bodies.count() as f64).sqrt()
    );
    assert!(from_statics < 0.02, "{from_statics}");
    assert!(from_pose < 0.08, "{from_pose}");
}
