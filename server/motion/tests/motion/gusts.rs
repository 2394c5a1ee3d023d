//! The closed form in gusts, beside bodies that are stepped through the same ones.

use std::f64::consts::TAU;

use espalier_motion::{
    Answers, Direction, Exposure, LIVE_PERIOD, Pose, Sway, Weather, Wind,
    answers::pressure,
    bodies::{AHEAD, Bodies, Joinery},
};
use glam::DVec3;

use crate::trees::{Tree, grown};

const SPEED: f64 = 3.0;
const STEPS: u32 = 60;
/// What bodies began with is forgotten after so many seconds; then they are watched for so many.
const FORGOTTEN: u32 = 12;
const WATCHED: u32 = 24;

/// Forces on all rows, each at its own place in the wind; proportional to the speed squared, to the first order.
fn forces(tree: &Tree, wind: &Wind, time: f64) -> Vec<DVec3> {
    let (pressure, exponent) = pressure(SPEED);
    let force = |row: u32| {
        let gusts = wind.lines().iter().map(|line| {
            let angle = TAU * line.frequency * time + line.phase - line.wave.dot(tree.wood.place(row));
            let grows = if line.direction == Direction::Along { exponent } else { 1.0 };
            grows * line.amplitude * libm::cos(angle) * wind.axis(line.direction)
        });
        pressure * tree.wood.drag_area(row) * gusts.fold(wind.axis(Direction::Along), |sum, gust| sum + gust)
    };
    (0..tree.rows.len() as u32).map(force).collect()
}

/// The mean of each node's places, and how they swing about it, time by time and node by node.
fn parted(places: &[Vec<DVec3>]) -> (Vec<DVec3>, Vec<DVec3>) {
    let mean = |node: usize| places.iter().map(|places| places[node]).sum::<DVec3>() / places.len() as f64;
    let means: Vec<DVec3> = (0..places[0].len()).map(mean).collect();
    let swings =
        places.iter().flat_map(|places| places.iter().zip(&means).map(|(place, mean)| *place - *mean));
    (means.clone(), swings.collect())
}

fn product(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

#[test]
fn gusts_sway_the_closed_form_much_as_they_sway_bodies() {
    let tree = grown("default", 300);
    let wind = Wind::new(&Weather { velocity: DVec3::X * SPEED, turbulence: 0.5, seed: 2 }, LIVE_PERIOD);
    let answers = Answers::of(&tree.joints, &wind, &Exposure::even(&tree.joints));
    // Damped as the trunk is.
    let damping = 2.0 * answers.all()[0].damping / answers.all()[0].rate;
    let softness = tree.joints.all()[0].softness;
    let mut bodies = Bodies::of(&tree.wood, Joinery { softness, damping, ahead: AHEAD });
    let sway = Sway::new(answers);
    let living: Vec<u32> = (0..tree.rows.len() as u32).filter(|&row| bodies.node(row).is_some()).collect();
    let [mut closed, mut stepped] = [Vec::new(), Vec::new()];
    for step in 0..STEPS * (FORGOTTEN + WATCHED) {
        let time = |step: u32| f64::from(step) / f64::from(STEPS);
        bodies.step(1.0 / f64::from(STEPS), &forces(&tree, &wind, time(step)));
        if step >= STEPS * FORGOTTEN && step % 6 == 0 {
            let pose = Pose::of(&tree.joints, &tree.wood, &sway.bends(time(step + 1)));
            let away = |place: DVec3, row: u32| place - tree.wood.place(row);
            closed.push(
                living.iter().map(|&row| away(pose.node(&tree.joints, &tree.wood, row).place, row)).collect(),
            );
            stepped.push(living.iter().filter_map(|&row| Some(away(bodies.node(row)?, row))).collect());
        }
    }
    let ((mean, swing), (exact_mean, exact_swing)) = (parted(&closed), parted(&stepped));
    let size = |of: &[DVec3]| product(of, of).sqrt();
    let [leans, swings] = [size(&mean) / size(&exact_mean), size(&swing) / size(&exact_swing)];
    let alike = product(&swing, &exact_swing) / (size(&swing) * size(&exact_swing));
    println!("leans by {leans:.2} of what bodies do, swings by {swings:.2}, correlated by {alike:.2}");
    assert!((0.8..1.25).contains(&leans), "leans by {leans}");
    assert!((0.6..1.5).contains(&swings), "swings by {swings}");
    assert!(alike > 0.65, "correlated by {alike}");
}
