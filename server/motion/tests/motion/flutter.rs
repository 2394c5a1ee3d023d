//! Twigs shiver and leaves flutter, and a loop of them closes.

use espalier_motion::{
    Pose, Weather,
    clips::{Conditions, LOOP, clips},
    flutter::{Blade, Stirring, noise, quiver, turn},
};
use glam::DVec3;

use crate::trees::grown;

fn blade(at: u32) -> Blade {
    let direction = DVec3::new(0.6, -0.3, 0.1 * f64::from(at % 7) - 0.3).normalize();
    let own = [0.31, 0.77, 0.13].map(|of| (f64::from(at + 1) * of).fract());
    let base = DVec3::new(f64::from(at), 30.0, -3.0);
    Blade { base, direction, side: direction.any_orthonormal_vector(), own }
}

const STORM: Stirring = Stirring { lee: DVec3::X, much: 1.0, covered: 0.0, wet: 0.0 };

#[test]
fn a_loop_of_leaves_and_twigs_closes_and_runs_smoothly() {
    for at in 0..50 {
        let of = |time: f64| turn(&STORM, &blade(at), 12.0, time, LOOP);
        assert!(of(0.0).angle_between(of(LOOP)) < 1e-6);
        let step = |time: f64| of(time).angle_between(of(time + 1.0 / 240.0));
        let furthest = (0..1920).map(|key| step(f64::from(key) / 240.0)).fold(0.0, f64::max);
        assert!(furthest < 0.06, "leaf {at} jumps by {furthest}");
        let number = f64::from(at) / 50.0;
        assert!((quiver(number, 3.0, 0.0, LOOP) - quiver(number, 3.0, LOOP, LOOP)).abs() < 1e-9);
    }
    assert_eq!(noise(-3.5, 0.4, 34), noise(30.5, 0.4, 34));
}

#[test]
fn blades_stream_to_lee_the_more_the_harder_it_blows_and_needles_hardly() {
    let lee = |much: f64, air: f64| -> f64 {
        let along = |at: u32| {
            let blade = Blade { direction: -DVec3::X, side: DVec3::Z, ..blade(at) };
            // Straight into the wind a blade stands as on a knife's edge; a little aside of it the wind takes it.
            let direction = DVec3::new(-0.2, -1.0, 0.1).normalize();
            let blade = Blade { direction, side: direction.any_orthonormal_vector(), ..blade };
            let turned = turn(&Stirring { much, ..STORM }, &blade, air, 0.1 * f64::from(at), 600.0);
            (turned * direction).x - direction.x
        };
        (0..200).map(along).sum::<f64>() / 200.0
    };
    let [calm, breeze, storm] = [0.0, 3.0, 15.0].map(|air| lee(1.0, air));
    assert!(calm.abs() < 1e-12 && breeze > 0.1 && storm > 3.0 * breeze, "{calm}, {breeze}, {storm}");
    assert!(lee(0.2, 15.0) < 0.3 * storm);
}

#[test]
fn wet_blades_and_those_under_snow_hang() {
    let level = Blade { direction: DVec3::X, side: DVec3::Z, ..blade(3) };
    let y = |covered, wet| (turn(&Stirring { covered, wet, ..STORM }, &level, 0.0, 1.0, 600.0) * DVec3::X).y;
    assert!(y(0.0, 0.0).abs() < 1e-12 && y(0.0, 1.0) < -0.25 && y(1.0, 0.0) < y(0.0, 1.0));
}

#[test]
fn twigs_that_are_no_joints_shiver_where_they_stand() {
    let tree = grown("oak", 3000);
    let weather = Weather::blowing([12.0, 30.0, 0.0], 0.6, 7);
    let conditions = Conditions::open(&tree.wood, weather);
    let air = conditions.air((&tree.joints, &tree.limbs, &tree.wood));
    let [sway, _] = clips(&tree.joints, &tree.wood, &conditions);
    let moved = |key: usize, row: u32| {
        let pose = Pose::of(&tree.joints, &tree.wood, &sway.keys[key]);
        let [stiff, shivering] = [
            pose.node(&tree.joints, &tree.wood, row),
            air.node(&pose, &tree.joints, &tree.wood, row, sway.time(key)),
        ];
        (shivering.place - stiff.place, shivering.turn.angle_between(stiff.turn))
    };
    let mut shivers = 0;
    for row in 1..tree.wood.len() as u32 {
        let (first, angle) = moved(0, row);
        assert!(angle < 0.15 && first.length() < 0.1, "row {row} by {first} and {angle}");
        let last = moved(sway.keys.len() - 1, row).0;
        assert!(first.distance(last) < 1e-9, "row {row} ends {last}, and began {first}");
        shivers += u32::from(angle > 1e-4);
    }
    assert!(shivers > 300, "{shivers} rows shiver");
}
