//! Random lives of a scene: invariants hold, and what is derived is always what it would be if made afresh.

use espalier_growth::ParameterValues;
use espalier_plant::{Claim, Condition, checks};
use proptest::prelude::*;

use super::*;

#[derive(Clone, Debug)]
enum Event {
    Grow(u32),
    Brush(Vec<(Vec3, f32)>),
    GoTo(u16),
    Sow(Vec3),
    Shedding(f32),
    Shadow(f32),
    /// Settles which wood stands with these steps in force, and these drawn by a hand.
    Settle(u64, u64),
}

fn events() -> impl Strategy<Value = Vec<Event>> {
    let place = (-12f32..12.0, 0f32..25.0, -12f32..12.0).prop_map(Vec3::from);
    let event = prop_oneof![
        3 => (1u32..6).prop_map(Event::Grow),
        3 => prop::collection::vec((place, 0f32..6.0), 1..4).prop_map(Event::Brush),
        2 => any::<u16>().prop_map(Event::GoTo),
        1 => (-12f32..12.0, -12f32..12.0).prop_map(|(x, z)| Event::Sow(Vec3::new(x, 0.0, z))),
        1 => (0f32..0.3).prop_map(Event::Shedding),
        1 => (0f32..0.4).prop_map(Event::Shadow),
        2 => any::<(u64, u64)>().prop_map(|(force, hand)| Event::Settle(force, hand)),
    ];
    prop::collection::vec(event, 1..10)
}

fn set(simulation: &mut Simulation, change: impl FnOnce(&mut ParameterValues)) {
    let mut values = simulation.parameters().values().clone();
    change(&mut values);
    simulation.set_parameters(Parameters::new(values).expect("in range"));
}

fn happen(simulation: &mut Simulation, number: u32, event: &Event) {
    match event {
        Event::Grow(steps) => grow(simulation, *steps),
        Event::Brush(path) => {
            brush(simulation, number, path);
        }
        Event::GoTo(step) => simulation.go_to(u32::from(*step) % (simulation.plant().last_step() + 1)),
        Event::Sow(place) => simulation.sow(*place),
        Event::Shedding(threshold) => set(simulation, |values| values.shedding_threshold = *threshold),
        Event::Shadow(strength) => set(simulation, |values| values.shadow_strength = *strength),
        Event::Settle(force, hand) => {
            let bit = |bits: u64, step: u32| step == 0 || bits >> (step % 64) & 1 > 0;
            let claim = |step| Claim { in_force: bit(*force, step), by_hand: bit(*hand, step) };
            let claims: Vec<Claim> = (0..=simulation.plant().step()).map(claim).collect();
            simulation.stash_future();
            simulation.settle(&claims.into()).expect("nothing was moved");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn invariants_hold_and_nothing_drifts(seed: u32, events in events()) {
        let mut simulation = simulation(seed);
        simulation.set_metamer_budget(6000);
        for (number, event) in events.iter().enumerate() {
            happen(&mut simulation, number as u32, event);
            prop_assert_eq!(checks::all(simulation.plant()), Ok(()));
        }
        // Shadows and buds that were kept up incrementally grow the same shoots as ones made afresh.
        let mut afresh = Simulation::from_state(simulation.plant().clone(), simulation.state());
        grow(&mut simulation, 3);
        grow(&mut afresh, 3);
        prop_assert_eq!(simulation.plant().hash(), afresh.plant().hash());
        // Back at the seed everything is as if nothing had happened.
        simulation.go_to(0);
        let seedling = Simulation::from_state(espalier_plant::Plant::new(Vec3::ZERO), simulation.state());
        prop_assert_eq!(simulation.plant().hash(), seedling.plant().hash());
    }

    #[test]
    fn without_the_last_steps_light_and_vigor_are_those_of_before(seed: u32, events in events(), step: u16) {
        let mut simulation = simulation(seed);
        simulation.set_metamer_budget(6000);
        for (number, event) in events.iter().filter(|event| !matches!(event, Event::Settle(..))).enumerate() {
            happen(&mut simulation, number as u32, event);
        }
        simulation.stash_future();
        let step = u32::from(step) % (simulation.plant().step() + 1);
        let mut past = simulation.clone();
        past.go_to(step);
        let claims: Vec<Claim> =
            (0..=simulation.plant().step()).map(|at| Claim { in_force: at <= step, by_hand: true }).collect();
        simulation.settle(&claims.into()).expect("nothing was moved");
        prop_assert_eq!(looks(&mut simulation), looks(&mut past));
    }

    #[test]
    fn ungrown_steps_grow_again_alike(seed: u32, events in events(), back in 1u32..8) {
        let mut simulation = simulation(seed);
        simulation.set_metamer_budget(6000);
        for (number, event) in events.iter().enumerate() {
            happen(&mut simulation, number as u32, event);
        }
        let start = simulation.plant().step();
        grow(&mut simulation, back);
        let (end, hash) = (simulation.plant().step(), simulation.plant().hash());
        simulation.go_to(start);
        grow(&mut simulation, back);
        prop_assert_eq!(simulation.plant().hash(), hash);
        simulation.go_to(0);
        simulation.go_to(end);
        prop_assert_eq!(simulation.plant().hash(), hash);
    }
}

/// Living metamers with the bits of their places, their tips, their light and their vigor.
fn looks(simulation: &mut Simulation) -> Vec<(MetamerId, [u32; 3], u32, Condition)> {
    simulation.show();
    let plant = simulation.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    let of = |id: MetamerId| {
        let metamers = plant.metamers();
        (id, metamers.end(id).to_array().map(f32::to_bits), metamers.tips(id), metamers.condition(id))
    };
    living.map(of).collect()
}

#[test]
fn growth_stops_at_the_budget() {
    let mut simulation = simulation(1);
    simulation.set_metamer_budget(500);
    grow(&mut simulation, 30);
    assert!(simulation.is_out_of_budget());
    assert_eq!(simulation.plant().metamer_count(), 500);
    assert_eq!(checks::all(simulation.plant()), Ok(()));
}

#[test]
fn plants_stay_above_ground_and_in_the_world() {
    let mut simulation = simulation(4);
    set(&mut simulation, |values| {
        (values.setpoint_angle, values.tropism_weight) = (180.0, 0.5);
        (values.heading_weight, values.space_weight) = (0.3, 0.2);
    });
    grow(&mut simulation, 14);
    assert!(simulation.plant().living_count() > 200);
    assert!(nodes(&simulation).iter().all(|n| n.y >= 0.0));
}
