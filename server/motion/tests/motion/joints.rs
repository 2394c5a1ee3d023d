//! Which limbs are joints, how they swing, and how rows ride on them.

use std::f64::consts::TAU;

use espalier_motion::{
    Joint, NONE,
    statics::{deflections, in_even_wind},
};
use glam::DVec3;

use crate::trees::{Tree, pole, unlike};

#[test]
fn a_pole_swings_as_theory_has_it_once_its_modulus_is_calibrated() {
    for radius in [0.3, 2.0] {
        let tree = pole(60, [0, 256, 0], |_| radius);
        let joint = tree.joints.all()[0];
        let radius = 0.1 * f64::from(espalier_mesh::radius_code::decode(crate::trees::code(radius)));
        let believed = 3.516 * (7e9 * 0.25 * radius * radius / 950.0).sqrt() / 36.0 / TAU;
        let observed = 2.4 / 6.0f64.sqrt();
        let expected = observed.clamp(believed / 3.0, believed * (11.0f64 / 7.0).sqrt());
        assert!((joint.frequency / expected - 1.0).abs() < 5e-3, "{} Hz for {expected}", joint.frequency);
    }
}

#[test]
fn calibration_makes_stout_trees_softer_and_slender_ones_no_stiffer_than_wood() {
    for tree in unlike() {
        let trunk = tree.joints.all()[0];
        let height = (0..tree.rows.len()).map(|row| tree.wood.place(row as u32).y).fold(0.0, f64::max);
        let observed = 2.4 / height.sqrt();
        println!(
            "{}: {height:.1} m, {} joints of {} limbs, trunk {:.2} Hz for {observed:.2}",
            tree.name,
            tree.joints.all().len(),
            tree.limbs.all().len(),
            trunk.frequency
        );
        assert_eq!((trunk.level, trunk.parent), (0, None));
        assert!((7.0 / 11.0 - 1e-9..9.0 + 1e-9).contains(&trunk.softness), "{}", tree.name);
        let is_softest = trunk.softness > 8.99;
        assert!(trunk.frequency < 1.001 * observed || is_softest, "{}", tree.name);
        let is_stiffest = trunk.softness < 7.0 / 11.0 + 1e-3;
        let is_slow_by_itself = trunk.frequency < 0.999 * observed && trunk.softness <= 1.0;
        assert!(trunk.frequency > 0.999 * observed || is_stiffest || is_slow_by_itself, "{}", tree.name);
    }
}

#[test]
fn wood_is_softened_until_the_whole_plant_swings_as_observed() {
    let trees = unlike();
    for tree in trees.iter().chain([&pole(60, [0, 256, 0], |_| 2.0)]) {
        let mass: Vec<f64> = (0..tree.rows.len() as u32).map(|row| tree.wood.mass(row)).collect();
        let slower = [DVec3::X, DVec3::Z].map(|pull| {
            let bent = deflections(&tree.wood, &mass, pull);
            let [mut pulled, mut moved] = [0.0; 2];
            for row in 0..tree.rows.len() {
                let Some(node) = tree.rows.row(row as u32).parent else { continue };
                let middle = 0.5 * (bent[node as usize].shift + bent[row].shift);
                pulled += mass[row] * middle.dot(pull);
                moved += mass[row] * middle.length_squared();
            }
            pulled / moved
        });
        let whole = slower[0].min(slower[1]).sqrt() / TAU;
        let height = (0..tree.rows.len()).map(|row| tree.wood.place(row as u32).y).fold(0.0, f64::max);
        let observed = 2.4 / height.sqrt();
        let Joint { softness, frequency, .. } = tree.joints.all()[0];
        let believed = frequency * softness.sqrt();
        println!(
            "{}: whole {whole:.2} Hz of trunk {believed:.2}, observed {observed:.2}, softness {softness:.2}",
            tree.name
        );
        assert!(whole < 1.01 * believed, "{}: what a trunk bears makes it no faster", tree.name);
        let expected = (whole / observed * (whole / observed)).clamp(7.0 / 11.0, 9.0);
        assert!((softness / expected - 1.0).abs() < 1e-9, "{}: {softness} for {expected}", tree.name);
    }
}

#[test]
fn suppleness_bends_further_and_swings_slower() {
    let tree = &unlike()[0];
    let supple = espalier_motion::Joints::of(&tree.rows, &tree.limbs, &tree.wood, 4.0);
    assert_eq!(supple.all().len(), tree.joints.all().len());
    for (supple, plain) in supple.all().iter().zip(tree.joints.all()) {
        assert!((2.0 * supple.frequency / plain.frequency - 1.0).abs() < 1e-12);
        assert!((supple.compliance - 4.0 * plain.compliance).to_cols_array().iter().all(|d| d.abs() < 1e-12));
    }
}

#[test]
fn slow_limbs_are_joints_and_each_hangs_on_the_nearest_below() {
    for Tree { name, limbs, joints, .. } in unlike() {
        let all = joints.all();
        assert!(all.len() > 10 && all.len() < limbs.all().len(), "{name} has {} joints", all.len());
        for (at, joint) in all.iter().enumerate() {
            let limb = limbs.all()[joint.limb as usize];
            assert_eq!((limb.first, limb.node), (joint.first, joint.node));
            let below = joints.rides()[joint.node as usize].joint;
            assert_eq!(joint.parent, (below != NONE).then_some(below), "{name} joint {at}");
            assert!(joint.parent.is_none_or(|parent| (parent as usize) < at));
            assert!(joint.frequency > 0.0 && joint.drag > 0.0 && joint.compliance.is_finite(), "{joint:?}");
            assert!(joint.damping >= 0.04 && joint.damping < 0.06);
        }
        for (limb, _) in limbs.all().iter().enumerate().filter(|(_, at)| at.bearer.is_some()) {
            if limbs.rows(limb as u32).len() == 1 {
                assert!(all.iter().all(|joint| joint.limb != limb as u32), "one row is no joint");
            }
        }
    }
}

#[test]
fn a_pole_turns_as_statics_does_from_foot_to_tip() {
    let pressure = DVec3::new(0.4, 0.1, -0.3);
    let tree = pole(40, [0, 256, 0], |at| 0.5 * (1.1 - at));
    let joint = tree.joints.all()[0];
    for (row, exact) in in_even_wind(&tree.wood, pressure).iter().enumerate().skip(1) {
        let ride = tree.joints.rides()[row];
        let turn = ride.weight * (joint.compliance * pressure);
        let exact = joint.softness * exact.turn;
        assert!(turn.distance(exact) < 1e-6 * exact.length(), "row {row}: {turn} for {exact}");
    }
}

#[test]
fn the_shape_of_a_joint_is_nearer_to_statics_than_that_of_its_tip() {
    for Tree { name, rows, limbs, wood, joints, .. } in unlike() {
        let exact = [DVec3::X, DVec3::Z].map(|wind| (wind, in_even_wind(&wood, wind)));
        let mut borne: Vec<f64> = (0..rows.len() as u32).map(|row| wood.drag_area(row)).collect();
        for row in (0..rows.len()).rev() {
            if let Some(parent) = rows.row(row as u32).parent {
                borne[parent as usize] += borne[row];
            }
        }
        let [mut errors, mut sizes] = [0.0; 2];
        for joint in joints.all() {
            let of_limb = limbs.rows(joint.limb);
            let tip = of_limb[of_limb.len() - 1] as usize;
            let [mut error, mut by_tip, mut size] = [0.0; 3];
            let whole: f64 = exact
                .iter()
                .map(|(_, at)| (at[tip].turn - at[joint.node as usize].turn).length_squared())
                .sum();
            for &row in of_limb {
                let length = wood.place(row).distance(wood.place(rows.row(row).parent.expect("wood")));
                let share = length * borne[row as usize];
                let along: f64 = exact
                    .iter()
                    .map(|(_, at)| {
                        let foot = at[joint.node as usize].turn;
                        (at[row as usize].turn - foot).dot(at[tip].turn - foot)
                    })
                    .sum();
                for (wind, at) in &exact {
                    let foot = at[joint.node as usize].turn;
                    let turn = at[row as usize].turn - foot;
                    let shape =
                        joints.rides()[row as usize].weight * (joint.compliance * *wind) / joint.softness;
                    error += share * turn.distance_squared(shape);
                    by_tip += share * turn.distance_squared(along / whole * (at[tip].turn - foot));
                    size += share * turn.length_squared();
                }
            }
            assert!(
                error <= by_tip * (1.0 + 1e-9) + 1e-12 * size,
                "{name} {joint:?}: {error} of {size}, {by_tip}"
            );
            errors += error;
            sizes += size;
        }
        println!("{name}: shapes miss {:.1} % of what turns", 100.0 * (errors / sizes).sqrt());
    }
}

#[test]
fn limbs_in_company_are_damped_more() {
    let damped = |tree: &Tree| tree.joints.all().iter().filter(|joint| joint.damping > 0.05).count();
    let trees = unlike();
    assert!(trees.iter().any(|tree| damped(tree) > 0));
    for tree in &trees {
        for joint in tree.joints.all() {
            let bearer = |limb: u32| tree.limbs.all()[limb as usize].bearer;
            let alike = tree.joints.all().iter().filter(|other| {
                let (a, b) = (joint.frequency, other.frequency);
                bearer(other.limb) == bearer(joint.limb) && a.max(b) <= 1.2 * a.min(b)
            });
            let is_crowded = bearer(joint.limb).is_some() && alike.count() >= 3;
            assert_eq!(joint.damping > 0.05, is_crowded, "{} {joint:?}", tree.name);
        }
    }
}

#[test]
fn a_straight_pole_rides_along_an_arc_of_its_own_length() {
    let tree = pole(40, [0, 256, 0], |at| 0.5 * (1.1 - at));
    let bend = DVec3::new(0.0, 0.0, -0.4);
    let mut below = DVec3::ZERO;
    for row in 1..=40u32 {
        let ride = tree.joints.rides()[row as usize];
        let place = tree.wood.place(row) + ride.shift(bend);
        assert!((place.distance(below) / 0.1 - 1.0).abs() < 1e-3, "row {row}");
        below = place;
    }
    // Bent towards +x, and lower for it.
    assert!(below.x > 0.1 && below.y < 4.0 && below.y > 3.5, "{below}");
}
