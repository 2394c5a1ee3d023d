//! Where nodes stand.

use espalier_motion::{
    Answers, Exposure, LIVE_PERIOD, NONE, Pose, Row, Sway, Weather, Wind, shelter::behind_crowns,
    statics::in_even_wind,
};
use glam::{DQuat, DVec3};

use crate::trees::{Tree, grown, unlike};

fn nodes(tree: &Tree, bends: &[DVec3]) -> Vec<DVec3> {
    let pose = Pose::of(&tree.joints, &tree.wood, bends);
    (0..tree.rows.len() as u32).map(|row| pose.node(&tree.joints, &tree.wood, row).place).collect()
}

fn sway(tree: &Tree, speed: f64, period: f64) -> Sway {
    let weather = Weather { velocity: DVec3::new(0.6, 0.0, -0.8) * speed, turbulence: 0.6, seed: 5 };
    let wind = Wind::new(&weather, period);
    let shares = behind_crowns(&tree.wood, weather.velocity.normalize());
    Sway::new(Answers::of(&tree.joints, &wind, &Exposure::of(&tree.joints, &tree.wood, &shares)))
}

#[test]
fn in_a_calm_everything_is_at_rest() {
    let tree = grown("default", 500);
    let still = nodes(&tree, &vec![DVec3::ZERO; tree.joints.all().len()]);
    for (row, place) in still.iter().enumerate() {
        assert_eq!(*place, tree.wood.place(row as u32));
    }
}

#[test]
fn the_pose_in_an_even_wind_is_near_that_of_exact_statics() {
    // One shape a limb is less right for every direction where limbs are as crooked as the second and the fourth tree's.
    for (tree, most) in unlike().into_iter().zip([0.06, 0.11, 0.06, 0.11]) {
        let pressure = DVec3::new(0.7, 0.2, 0.6) * 1e-3;
        let exact = in_even_wind(&tree.wood, pressure);
        let trunk = tree.joints.all()[0];
        let softer = trunk.softness;
        let bends: Vec<DVec3> = tree.joints.all().iter().map(|joint| joint.compliance * pressure).collect();
        let [mut error, mut size] = [0.0; 2];
        for (row, place) in nodes(&tree, &bends).iter().enumerate() {
            if tree.rows.row(row as u32).radius == 0 {
                continue;
            }
            let shift = softer * exact[row].shift;
            error += (*place - tree.wood.place(row as u32) - shift).length_squared();
            size += shift.length_squared();
        }
        println!("{}: {:.1} % off", tree.name, 100.0 * (error / size).sqrt());
        assert!((error / size).sqrt() < most, "{}", tree.name);
    }
}

#[test]
fn internodes_keep_their_length_and_nodes_stay_above_the_ground() {
    for tree in unlike() {
        let sway = sway(&tree, 18.0, LIVE_PERIOD);
        let [mut worst, mut sum, mut count, mut deepest, mut furthest] = [0.0f64; 5];
        let mut lying = 0;
        for time in 0..20 {
            let bends = sway.bends(7.3 * f64::from(time));
            furthest = bends.iter().map(|bend| bend.length()).fold(furthest, f64::max);
            let nodes = nodes(&tree, &bends);
            for row in 0..tree.rows.len() {
                let Row { parent: Some(parent), radius: 1.., .. } = tree.rows.row(row as u32) else {
                    continue;
                };
                let rest = tree.wood.place(row as u32);
                let length = rest.distance(tree.wood.place(parent));
                let stretch = (nodes[row].distance(nodes[parent as usize]) / length - 1.0).abs();
                deepest = deepest.max(rest.y.min(0.0) - nodes[row].y);
                // What the ground has caught lies flat on it.
                let caught = |node: DVec3, rest: DVec3| rest.y > 0.0 && node.y == 0.0;
                if caught(nodes[row], rest) || caught(nodes[parent as usize], tree.wood.place(parent)) {
                    lying += 1;
                    continue;
                }
                worst = worst.max(stretch);
                sum += stretch;
                count += 1.0;
            }
        }
        println!(
            "{}: stretched by {:.2} % on average, {:.1} % at most; {deepest:.3} m deep; turned by {furthest:.2}; \
             {lying} of {count} lie on the ground",
            tree.name,
            100.0 * sum / count,
            100.0 * worst
        );
        assert!(sum / count < 0.002 && worst < 0.05, "{}", tree.name);
        assert!(deepest <= 0.0, "{} sinks by {deepest} m", tree.name);
        assert!(f64::from(lying) < 0.01 * count, "{}", tree.name);
    }
}

#[test]
fn a_loop_closes_to_the_bit() {
    let tree = grown("default", 1000);
    for period in [8.0, 5.0] {
        let sway = sway(&tree, 8.0, period);
        let at = |time| nodes(&tree, &sway.bends(time));
        assert_eq!(at(0.0), at(period));
        assert_eq!(at(0.0), at(3.0 * period));
        // And it arrives as fast as it leaves.
        let step = 1e-3;
        let [before, begin, after] = [at(period - step), at(0.0), at(step)];
        for ((before, begin), after) in before.iter().zip(&begin).zip(&after) {
            let (arrives, leaves) = (*begin - *before, *after - *begin);
            assert!(arrives.distance(leaves) < 0.05 * leaves.length() + 2e-5, "{arrives} and {leaves}");
        }
    }
}

#[test]
fn what_rides_on_a_joint_turns_with_what_bears_it() {
    // Barron's children are carried along and not turned, so that a crown shears. Here a turn at the trunk's foot turns
    // the angle between any two internodes that ride stiffly by nothing.
    let tree = grown("default", 2000);
    let mut bends = vec![DVec3::ZERO; tree.joints.all().len()];
    bends[0] = DVec3::new(0.0, 0.0, 0.3);
    let pose = Pose::of(&tree.joints, &tree.wood, &bends);
    let joint = tree.joints.all().iter().position(|joint| joint.parent == Some(0)).expect("a bough") as u32;
    let stand = pose.stands()[joint as usize];
    let weight = tree.joints.rides()[tree.joints.all()[joint as usize].node as usize].weight;
    let turn = DQuat::from_rotation_z(0.3 * weight);
    assert!(stand.turn.angle_between(turn) < 1e-6, "{} instead of {turn}", stand.turn);
    for (row, ride) in tree.joints.rides().iter().enumerate().filter(|(_, ride)| ride.joint == joint) {
        let parent = tree.rows.row(row as u32).parent.expect("wood grows from something");
        let below = pose.node(&tree.joints, &tree.wood, parent).place;
        let node = pose.node(&tree.joints, &tree.wood, row as u32);
        let rest = tree.wood.place(row as u32) - tree.wood.place(parent);
        assert!((node.place - below).distance(stand.turn * rest) < 1e-9, "row {row} of {ride:?}");
    }
}

#[test]
fn no_joint_is_left_out_of_a_pose() {
    for tree in unlike() {
        let sway = sway(&tree, 6.0, LIVE_PERIOD);
        let pose = Pose::of(&tree.joints, &tree.wood, &sway.bends(3.0));
        for (row, ride) in tree.joints.rides().iter().enumerate() {
            let place = pose.node(&tree.joints, &tree.wood, row as u32).place;
            let moves = place != tree.wood.place(row as u32);
            assert_eq!(moves, ride.joint != NONE, "{} row {row}", tree.name);
        }
    }
}
