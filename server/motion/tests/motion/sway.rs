//! Winds that follow one another, and plucks.

use espalier_motion::{
    Answers, Exposure, LIVE_PERIOD, Pluck, Sway, Weather, Wind,
    clips::{Clip, Conditions, clips},
};
use glam::DVec3;

use crate::trees::{Tree, grown, unlike};

fn answers(tree: &Tree, speed: f64, seed: u32) -> Answers {
    let weather = Weather { velocity: DVec3::X * speed, turbulence: 0.5, seed };
    Answers::of(&tree.joints, &Wind::new(&weather, LIVE_PERIOD), &Exposure::even(&tree.joints))
}

fn apart(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

#[test]
fn one_wind_passes_into_another_without_a_jump() {
    let tree = grown("default", 1000);
    let [old, new] = [answers(&tree, 3.0, 1), answers(&tree, 7.0, 2)];
    let mut sway = Sway::new(old.clone());
    sway.change(new.clone(), 20.0);
    assert_eq!(sway.bends(20.0), Sway::new(old.clone()).bends(20.0));
    assert_eq!(sway.bends(21.5), Sway::new(new.clone()).bends(21.5));
    let steps: Vec<_> = (0..=300).map(|at| sway.bends(19.0 + f64::from(at) / 100.0)).collect();
    let jumps = steps.windows(2).map(|pair| apart(&pair[0], &pair[1])).fold(0.0, f64::max);
    assert!(jumps < 0.05, "{jumps} in a hundredth of a second");
    assert!(apart(&steps[0], &steps[300]) > 0.05);
}

#[test]
fn a_wind_that_changes_again_halfway_does_not_jump_either() {
    let tree = grown("default", 1000);
    let mut sway = Sway::new(answers(&tree, 1.0, 1));
    sway.change(answers(&tree, 6.0, 2), 20.0);
    let before = sway.bends(20.7);
    sway.change(answers(&tree, 2.0, 3), 20.7);
    assert_eq!(sway.bends(20.7), before);
    // Whoever forgets what is over sees the same as who does not.
    let whole = sway.clone();
    sway.forget(22.0);
    assert_eq!(sway.bends(22.0), whole.bends(22.0));
    sway.forget(23.0);
    assert_eq!(sway.bends(23.0), Sway::new(answers(&tree, 2.0, 3)).bends(23.0));
}

#[test]
fn a_pluck_swings_out() {
    let tree = grown("default", 1000);
    let calm = answers(&tree, 0.0, 1);
    let mut sway = Sway::new(calm.clone());
    let bend = DVec3::new(0.1, 0.0, 0.2);
    sway.pluck(Pluck { joint: 2, at: 5.0, bend });
    assert!(sway.bends(4.9).iter().all(|bend| *bend == DVec3::ZERO));
    assert!(sway.bends(5.0)[2].distance(bend) < 1e-12);
    let answer = calm.all()[2];
    let half_turn = std::f64::consts::PI / (answer.rate * (1.0 - answer.damping * answer.damping).sqrt());
    // Half a turn later it is on the other side, by as much less as its damping takes.
    let left = libm::exp(-answer.damping * answer.rate * half_turn);
    assert!(sway.bends(5.0 + half_turn)[2].distance(-left * bend) < 1e-9);
    sway.forget(5.5);
    assert_eq!(sway.plucks(), 1);
    sway.forget(5.0 + 8.0 / (answer.damping * answer.rate));
    assert_eq!(sway.plucks(), 0);
}

#[test]
fn no_joint_turns_further_than_wood_bends() {
    let tree = grown("default", 500);
    let mut sway = Sway::new(answers(&tree, 0.0, 1));
    for (size, least, most) in [(0.5, 0.5, 0.5), (1.0, 0.95, 1.0), (3.0, 1.09, 1.1)] {
        sway.pluck(Pluck { joint: 0, at: 2e9, bend: DVec3::Z * size });
        let turned = sway.bends(2e9)[0].z;
        assert!(turned >= least && turned <= most, "{turned} of {size}");
        sway = Sway::new(answers(&tree, 0.0, 1));
    }
}

#[test]
fn of_many_plucks_the_last_ones_are_kept() {
    let tree = grown("default", 500);
    let mut sway = Sway::new(answers(&tree, 0.0, 1));
    for at in 0..40 {
        sway.pluck(Pluck { joint: 0, at: f64::from(at), bend: DVec3::X });
    }
    assert_eq!(sway.plucks(), 32);
}

/// How a joint swings in a clip about its mean, along x and z together.
fn swings(clip: &Clip, joint: usize) -> Vec<f64> {
    let all: Vec<f64> = clip.keys.iter().map(|key| key[joint].x + key[joint].z).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    all.iter().map(|one| one - mean).collect()
}

fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

/// What tells a tree in wind from a rubber one: `cargo test -p espalier-motion --test motion trunks_swing -- --nocapture`.
#[test]
fn trunks_swing_slowly_and_limbs_of_one_bearer_each_in_their_own_time() {
    for tree in unlike() {
        let weather = Weather { velocity: DVec3::X * 8.0, turbulence: 0.7, seed: 7 };
        let [sway, _] = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, weather));
        let joints = tree.joints.all();
        let all: Vec<Vec<f64>> = (0..joints.len()).map(|joint| swings(&sway, joint)).collect();
        let turns = |swings: &Vec<f64>| swings.windows(2).filter(|two| two[0] * two[1] < 0.0).count();
        let mut counts: Vec<usize> = all.iter().map(turns).collect();
        let trunk = counts[0];
        counts.sort_unstable();
        let middle = counts[counts.len() / 2];
        let mut alike = Vec::new();
        for (one, joint) in joints.iter().enumerate().skip(1) {
            let siblings = (one + 1..joints.len()).filter(|&other| joints[other].parent == joint.parent);
            alike.extend(siblings.map(|other| {
                let lengths = product(&all[one], &all[one]) * product(&all[other], &all[other]);
                product(&all[one], &all[other]) / lengths.sqrt()
            }));
        }
        let mean = alike.iter().sum::<f64>() / alike.len() as f64;
        println!(
            "{}: in 8 s the trunk passes its middle {trunk} times, the limb in the middle of all {middle}; \
             {} pairs of limbs on one bearer are alike by {mean:.2}",
            tree.name,
            alike.len()
        );
        assert!(2 * trunk < middle, "{}: a trunk {trunk}, limbs {middle} times", tree.name);
        assert!(alike.len() > 50 && mean < 0.6, "{}: limbs are alike by {mean}", tree.name);
    }
}
