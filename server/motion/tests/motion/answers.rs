//! The closed form is what an integration finds.

use espalier_motion::{
    Answers, Direction, Exposure, Joint, LIVE_PERIOD, Weather, Wind,
    answers::{admittance, pressure},
};
use glam::DVec3;

use crate::trees::{Tree, unlike};

fn wind(speed: f64, turbulence: f64) -> Wind {
    let velocity = DVec3::new(0.8, 0.0, 0.6) * speed;
    Wind::new(&Weather { velocity, turbulence, seed: 3 }, LIVE_PERIOD)
}

/// How much each row turns from its lower end to its upper under a pressure of 1 Pa along `wind`, with the wood as it is
/// before calibration: from the moments of all that lies beyond it, one by one, and not from sums that go down the tree.
fn turns_one_by_one(tree: &Tree, wind: DVec3) -> Vec<DVec3> {
    let Tree { rows, wood, .. } = tree;
    let parent = |row: u32| rows.row(row).parent;
    let way = |row: u32| parent(row).map_or(DVec3::ZERO, |below| wood.place(row) - wood.place(below));
    let middle = |row: u32| wood.place(row) - 0.5 * way(row);
    let mut moments = vec![DVec3::ZERO; wood.len()];
    for row in 0..wood.len() as u32 {
        let force = wood.drag_area(row) * wind;
        // What presses on a row evenly has a third of the moment on average that it has at the row's foot.
        moments[row as usize] += (0.5 * way(row)).cross(force) / 3.0;
        let mut below = parent(row);
        while let Some(bearer) = below {
            moments[bearer as usize] += (middle(row) - middle(bearer)).cross(force);
            below = parent(bearer);
        }
    }
    let turn = |(row, moment): (u32, DVec3)| {
        // Wood is six times softer when it is twisted.
        let twist = moment.project_onto(way(row).normalize_or(DVec3::Y));
        wood.softness_of(row) * ((moment - twist) + 6.0 * twist)
    };
    (0..).zip(moments).map(turn).collect()
}

/// The rotation that describes all nodes of a joint's limb best, each by its weight: where statics turns node a by θ_a,
/// that is Σ s w θ / Σ s w², with what a node counts, s, its length times the drag of what it bears.
fn best(tree: &Tree, joint: &Joint, turns: &[DVec3], borne: &[f64]) -> DVec3 {
    let Tree { limbs, joints, wood, rows, .. } = tree;
    let (mut turned, mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for &row in limbs.rows(joint.limb) {
        turned += turns[row as usize];
        let weight = joints.rides()[row as usize].weight;
        let below = rows.row(row).parent.expect("it grows on something");
        let counts = wood.place(row).distance(wood.place(below)) * borne[row as usize];
        sum += counts * weight * turned;
        squares += counts * weight * weight;
    }
    joint.softness * sum / squares
}

#[test]
fn the_mean_answer_to_an_even_wind_is_that_of_statics_for_every_joint() {
    for tree in unlike() {
        let speed = 0.001;
        let (wind, pressure) = (wind(speed, 0.5), 0.6125 * speed * speed);
        let mut borne: Vec<f64> = (0..tree.wood.len() as u32).map(|row| tree.wood.drag_area(row)).collect();
        for row in (0..tree.wood.len()).rev() {
            if let Some(below) = tree.rows.row(row as u32).parent {
                borne[below as usize] += borne[row];
            }
        }
        let axes = [Direction::Along, Direction::Across, Direction::Upward].map(|of| wind.axis(of));
        let [along, across, upward] = axes.map(|axis| turns_one_by_one(&tree, axis));
        let answers = Answers::of(&tree.joints, &wind, &Exposure::even(&tree.joints));
        for (joint, answer) in tree.joints.all().iter().zip(answers.all()) {
            let swing = answer.swing;
            // A fluctuation along the wind counts twice, for pressure grows with the square of the speed.
            for (found, turns, times) in [
                (answer.mean, &along, 1.0),
                (swing.x_axis, &along, 2.0),
                (swing.y_axis, &across, 1.0),
                (swing.z_axis, &upward, 1.0),
            ] {
                let exact = times * pressure * best(&tree, joint, turns, &borne);
                let size =
                    pressure * joint.compliance.to_cols_array().iter().fold(0.0f64, |m, c| m.max(c.abs()));
                assert!(
                    found.distance(exact) <= 1e-6 * size,
                    "{}: {found} and {exact} of {joint:?}",
                    tree.name
                );
            }
        }
    }
}

/// One step of a damped oscillator of frequency `w` and damping `z` under a force that stays; exact for any length.
fn step([x, v]: [f64; 2], force: f64, w: f64, z: f64, time: f64) -> [f64; 2] {
    let damped = w * (1.0 - z * z).sqrt();
    let (sin, cos) = libm::sincos(damped * time);
    let (away, fade) = (x - force, libm::exp(-z * w * time));
    [
        force + fade * (away * cos + (v + z * w * away) / damped * sin),
        fade * (v * cos - (z * w * v + w * w * away) / damped * sin),
    ]
}

#[test]
fn joints_swing_as_integration_step_by_step_has_it() {
    const STEP: f64 = 1.0 / 240.0;
    let wind = wind(5.0, 0.6);
    for tree in unlike() {
        let answers = Answers::of(&tree.joints, &wind, &Exposure::even(&tree.joints));
        let every = tree.joints.all().len() / 10;
        for (at, joint) in tree.joints.all().iter().enumerate().step_by(every).take(10) {
            let answer = answers.all()[at];
            let mut states = [[0.0; 2]; 3];
            let [mut error, mut signal] = [0.0; 2];
            for count in 0..110 * 240 {
                let middle = (f64::from(count) + 0.5) * STEP;
                let mut forces = [0.0; 3];
                for line in wind.lines() {
                    let angle = std::f64::consts::TAU * line.frequency * middle + line.phase
                        - line.wave.dot(joint.centre);
                    let size = line.amplitude * admittance(line.frequency, joint.area, 5.0);
                    forces[line.direction as usize] += size * libm::cos(angle);
                }
                for (state, force) in states.iter_mut().zip(forces) {
                    *state = step(*state, force, answer.rate, answer.damping, STEP);
                }
                // What it began with is forgotten by now.
                if count > 90 * 240 && count % 240 == 0 {
                    let mut bends = Vec::new();
                    answers.bends(f64::from(count + 1) * STEP, &mut bends);
                    let swung = answer.swing * DVec3::from_array(states.map(|[x, _]| x));
                    error += (bends[at] - answer.mean - swung).length_squared();
                    signal += swung.length_squared();
                }
            }
            assert!(
                error.sqrt() < 1e-3 * signal.sqrt(),
                "{} joint {at}: {}",
                tree.name,
                (error / signal).sqrt()
            );
        }
    }
}

#[test]
fn pressure_grows_less_where_crowns_streamline() {
    assert_eq!(pressure(2.0), (0.6125 * 4.0, 2.0));
    let [(below, _), (above, exponent)] = [pressure(4.0), pressure(4.0 + 1e-9)];
    assert!((above / below - 1.0).abs() < 1e-8 && exponent == 1.3);
    let ratio = pressure(16.0).0 / pressure(8.0).0;
    assert!((ratio - libm::pow(2.0, 1.3)).abs() < 1e-12);
}

#[test]
fn a_storm_turns_no_joint_too_far_and_freezes_none() {
    for tree in unlike() {
        let [breeze, storm] = [3.0, 18.0]
            .map(|speed| Answers::of(&tree.joints, &wind(speed, 0.6), &Exposure::even(&tree.joints)));
        for (breeze, storm) in breeze.all().iter().zip(storm.all()) {
            assert!(storm.mean.length() <= 0.8 && storm.mean.length() >= breeze.mean.length());
            let size = |answer: &espalier_motion::Answer| answer.swing.x_axis.length();
            assert!(
                size(storm) > 0.9 * size(breeze),
                "{} swings by {} and {}",
                tree.name,
                size(breeze),
                size(storm)
            );
        }
    }
}

#[test]
fn air_damps_and_the_more_the_harder_it_blows() {
    for tree in unlike() {
        let damping = |speed| -> Vec<f64> {
            let answers = Answers::of(&tree.joints, &wind(speed, 0.5), &Exposure::even(&tree.joints));
            answers.all().iter().map(|answer| answer.damping).collect()
        };
        let [calm, breeze, gale] = [0.0, 3.0, 15.0].map(damping);
        for ((calm, breeze), gale) in calm.iter().zip(&breeze).zip(&gale) {
            assert!(*calm < 0.06 && breeze > calm && gale >= breeze && *gale < 1.0);
        }
        println!("{}: trunk {:.3}, {:.3}, {:.3}", tree.name, calm[0], breeze[0], gale[0]);
    }
}
