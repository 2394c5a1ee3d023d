//! What swaying costs on trees of 10,000 and of 100,000 metamers: joints made anew, a change of the wind, a frame, and a
//! step of bodies. `cargo bench -p espalier-motion -- 1000000` has a tree of so many metamers.

use std::{hint::black_box, sync::Arc, time::Instant};

use espalier_growth::{NoObserver, ParameterValues, Parameters, Simulation, StepInput};
use espalier_mesh::{RingTable, Style, StyleOptions};
use espalier_motion::{
    Answers, Exposure, Joints, LIVE_PERIOD, Limbs, Pose, Rows, Scale, Sway, Weather, Wind, Wood,
    bodies::{AHEAD, Bodies, Joinery},
    shelter::{Form, Solid, Triangles, behind_crowns, shares},
};
use glam::{DQuat, DVec3, Vec3};

const ROUNDS: usize = 15;
const USUAL: [u32; 2] = [10_000, 100_000];

/// Trees of so many metamers as the command line says; of [`USUAL`] where it says nothing.
fn main() {
    let asked: Vec<u32> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    for &metamers in if asked.is_empty() { &USUAL[..] } else { &asked } {
        sway(metamers);
    }
}

fn sway(metamers: u32) {
    let (table, scale) = tree(metamers);
    let rows = Rows::of(&table);
    let limbs = Limbs::of(&rows);
    let wood = Wood::of(&rows, &limbs, &scale);
    let joints = Joints::of(&rows, &limbs, &wood, 1.0);
    println!(
        "{} rows, {} limbs, {} joints                         best    median, ms",
        rows.len(),
        limbs.all().len(),
        joints.all().len()
    );
    measure("rows read from the table", || Rows::of(&table));
    measure("limbs", || Limbs::of(&rows));
    measure("wood", || Wood::of(&rows, &limbs, &scale));
    measure("joints and rides", || Joints::of(&rows, &limbs, &wood, 1.0));
    measure("all of it: joints made anew", || Joints::grown(&Rows::of(&table), &scale, 1.0));
    let weather = Weather { velocity: DVec3::new(6.0, 0.0, 2.0), turbulence: 0.5, seed: 1 };
    let wind = Wind::new(&weather, LIVE_PERIOD);
    measure("shelter by crowns", || behind_crowns(&wood, weather.velocity.normalize()));
    let model = rock(256, 256);
    measure("a model of 131,072 triangles put in order", || Triangles::new(model.iter().copied()));
    let form = Form::Mesh(Arc::new(Triangles::new(model.into_iter())));
    let place = DVec3::new(-60.0, 30.0, 0.0);
    let solids: Vec<Solid> =
        Solid::new(form, place, DQuat::IDENTITY, scale.internode_length).into_iter().collect();
    measure("shelter by crowns and that model", || shares(&wood, DVec3::X, &solids));
    let shares = behind_crowns(&wood, weather.velocity.normalize());
    let exposure = Exposure::of(&joints, &wood, &shares);
    measure("answers to a new wind", || {
        let exposure = Exposure::of(&joints, &wood, &shares);
        Answers::of(&joints, &Wind::new(&weather, LIVE_PERIOD), &exposure)
    });
    let sway = Sway::new(Answers::of(&joints, &wind, &exposure));
    let mut time = 0.0;
    let mut next = || {
        time += 1.0 / 60.0;
        time
    };
    measure("a frame: bends of joints", || sway.bends(next()));
    let bends = sway.bends(1.0);
    measure("a frame: how joints stand", || Pose::of(&joints, &wood, &bends));
    let pose = Pose::of(&joints, &wood, &bends);
    measure("a frame: all nodes", || {
        (0..rows.len() as u32).map(|row| pose.node(&joints, &wood, row).place).sum::<DVec3>()
    });
    let softness = joints.all()[0].softness;
    let mut bodies = Bodies::of(&wood, Joinery { softness, damping: 0.01, ahead: AHEAD });
    let forces: Vec<DVec3> = (0..rows.len() as u32).map(|row| wood.drag_area(row) * DVec3::X).collect();
    measure("a step of bodies", || bodies.step(1.0 / 240.0, &forces));
}

/// A rough rock as large as a tree.
fn rock(rings: u32, sides: u32) -> Vec<[Vec3; 3]> {
    let at = |ring: u32, side: u32| {
        let down = core::f32::consts::PI * ring as f32 / rings as f32;
        let around = core::f32::consts::TAU * side as f32 / sides as f32;
        let size = 40.0 + 3.0 * libm::sinf(9.0 * around) * libm::sinf(7.0 * down);
        let ((sin, cos), (z, x)) = (libm::sincosf(down), libm::sincosf(around));
        size * Vec3::new(sin * x, cos, sin * z)
    };
    let quads = (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side)));
    quads
        .flat_map(|(ring, side)| {
            let [a, b, c, d] =
                [at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1)];
            [[a, b, c], [b, d, c]]
        })
        .collect()
}

/// Prints how long something takes: the best round says what it costs rather than what else the machine was doing.
fn measure<T>(what: &str, mut work: impl FnMut() -> T) {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let begun = Instant::now();
            black_box(work());
            1e3 * begun.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    println!("  {what:<48} {:>10.3} {:>10.3}", times[0], times[ROUNDS / 2]);
}

/// A tree that has grown on its own, as clients have it.
fn tree(metamers: u32) -> (RingTable, Scale) {
    let values = ParameterValues::default();
    let mut simulation = Simulation::new(1, Parameters::new(values.clone()).expect("defaults are in range"));
    simulation.set_metamer_budget(u32::MAX);
    while simulation.plant().living_count() < metamers {
        simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
    }
    let style = Style::new(StyleOptions {
        girth_exponent: values.girth_exponent,
        twig_diameter: values.twig_diameter,
        leaves_per_node: values.leaves_per_node as u8,
        leaf_size: values.leaf_size,
    });
    let mut table = RingTable::new();
    table.sync(simulation.plant(), &style, 1);
    let scale = Scale {
        internode_length: f64::from(values.internode_length),
        leaf_size: f64::from(values.leaf_size),
    };
    (table, scale)
}
