//! The simulation from outside: what a modeler does, and what must come of it.

mod brushing;
mod detours;
mod enclosing;
mod fidelity;
mod golden;
mod invariants;
mod obstructing;
mod selecting;
mod shaping;
mod summary;
mod together;

use std::collections::BTreeSet;

use espalier_growth::{
    BrushPiece, BrushSample, NoObserver, ParameterValues, Parameters, Simulation, StepInput, StrokeId,
};
use espalier_plant::{AxisId, MetamerId};
use glam::Vec3;

fn simulation(seed: u32) -> Simulation {
    Simulation::new(seed, Parameters::default())
}

fn grow(simulation: &mut Simulation, steps: u32) {
    for _ in 0..steps {
        simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
    }
    simulation.show();
}

/// Moves a brush along a path, in steps as long as a shoot, and lets the tree settle. Returns the axes that led.
fn brush(simulation: &mut Simulation, stroke: u32, path: &[(Vec3, f32)]) -> BTreeSet<AxisId> {
    let mut leaders = BTreeSet::new();
    for pair in path.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let longest = simulation.parameters().max_shoot_length as f32;
        let pieces = (from.0.distance(to.0) / longest).ceil().max(1.0) as u32;
        let at = |i: u32| {
            let t = i as f32 / pieces as f32;
            BrushSample { position: from.0.lerp(to.0, t), radius: from.1 + (to.1 - from.1) * t }
        };
        for i in 0..pieces {
            let piece = BrushPiece { stroke: StrokeId(stroke), samples: vec![at(i), at(i + 1)] };
            simulation.step(&StepInput { pieces: vec![piece], ..StepInput::default() }, &mut NoObserver);
            leaders.extend(simulation.state().guides.values().filter_map(|guide| guide.leader));
        }
    }
    settle(simulation);
    simulation.end_stroke(StrokeId(stroke));
    simulation.drop_guidance();
    leaders
}

/// Lets everything grow that finds something to grow into.
fn settle(simulation: &mut Simulation) {
    for _ in 0..400 {
        if simulation.step(&StepInput::default(), &mut NoObserver).metamers_grown == 0 {
            return;
        }
    }
}

fn nodes(simulation: &Simulation) -> Vec<Vec3> {
    let plant = simulation.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    living.map(|id| plant.metamers().end(id)).collect()
}

/// A trunk of ten internodes.
fn trunk(seed: u32, change: impl FnOnce(&mut ParameterValues)) -> Simulation {
    let mut values = ParameterValues::default();
    change(&mut values);
    let mut simulation = Simulation::new(seed, Parameters::new(values).expect("in range"));
    brush(&mut simulation, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * 10.0, 0.0)]);
    simulation
}

/// How near wood comes to a place.
fn nearness(simulation: &Simulation, place: Vec3) -> f32 {
    nodes(simulation).iter().map(|node| node.distance(place)).fold(f32::INFINITY, f32::min)
}

fn stroke(points: &[Vec3], radius: f32) -> Vec<(Vec3, f32)> {
    points.iter().map(|&point| (point, radius)).collect()
}
