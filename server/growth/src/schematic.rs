//! A small flat tree that shows what parameters do, by the same simulation as any other.

use espalier_plant::Plant;

use crate::{NoObserver, Parameters, Simulation, StepInput};

/// The same for all, so that a tree changes only as its parameters do.
const SEED: u32 = 5;
/// The most metamers of such a tree, dead ones included.
pub const SCHEMATIC_METAMERS: u32 = 420;
/// Internodes that a trunk which always grows its longest shoot gets, roughly: what is shown is as old as it is tall.
const HEIGHT: u32 = 36;
/// The fewest and the most steps it grows.
const STEPS: (u32, u32) = (6, 18);

/// Grows the tree; all its nodes have z = 0.
pub fn schematic(parameters: Parameters) -> Plant {
    let steps = HEIGHT.div_ceil(parameters.max_shoot_length).clamp(STEPS.0, STEPS.1);
    let mut simulation = Simulation::new(SEED, parameters.flat());
    simulation.set_metamer_budget(SCHEMATIC_METAMERS);
    for _ in 0..steps {
        simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
        if simulation.is_out_of_budget() {
            break;
        }
    }
    simulation.show();
    simulation.plant().clone()
}

#[cfg(test)]
mod tests {
    use espalier_plant::MetamerId;
    use proptest::prelude::*;

    use super::*;
    use crate::{ParameterValues, species};

    fn is_flat(plant: &Plant) -> bool {
        (0..plant.metamer_count()).all(|id| plant.metamers().end(MetamerId::new(id)).z == 0.0)
    }

    #[test]
    fn every_species_has_a_flat_picture() {
        for species in species::all() {
            let plant = schematic(Parameters::new(species.parameters.clone()).expect("in range"));
            assert!(is_flat(&plant), "{} leaves the plane", species.slug);
            let metamers = plant.metamer_count();
            assert!((40..=SCHEMATIC_METAMERS as usize).contains(&metamers), "{}: {metamers}", species.slug);
        }
    }

    #[test]
    fn branching_angle_shows_in_the_plane() {
        let steepness = |branching_angle| {
            let values = ParameterValues {
                branching_angle,
                tropism_weight: 0.0,
                heading_weight: 1.0,
                space_weight: 0.0,
                ..ParameterValues::default()
            };
            let plant = schematic(Parameters::new(values).expect("in range"));
            let axes = plant.axes();
            let laterals = (0..plant.axis_count()).map(espalier_plant::AxisId::new);
            let first: Vec<f32> = laterals
                .filter(|&axis| axes.order(axis) == 1 && plant.has_grown(axis))
                .map(|axis| axes.direction(axis).y)
                .collect();
            first.iter().sum::<f32>() / first.len() as f32
        };
        assert!(steepness(20.0) > steepness(50.0) && steepness(50.0) > steepness(85.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn any_schematic_stays_in_its_plane(
            (zeta, psi, theta, phi, delta) in
                (20f32..360.0, 0f32..120.0, 0f32..180.0, 0f32..180.0, 0f32..45.0),
            (r, d, buds, longest, light) in (0.5f32..6.0, 0.5f32..10.0, 1u32..5, 1u32..21, 0f32..1.0),
        ) {
            let values = ParameterValues {
                perception_angle: zeta,
                branching_angle: psi,
                setpoint_angle: theta,
                phyllotactic_angle: phi,
                deflection_angle: delta,
                occupancy_radius: r,
                perception_depth: d,
                buds_per_node: buds,
                max_shoot_length: longest,
                phototropism: light,
                trunk_upward: theta < 90.0,
                ..ParameterValues::default()
            };
            let plant = schematic(Parameters::new(values).expect("in range"));
            prop_assert!(is_flat(&plant));
            prop_assert!(plant.metamer_count() as u32 <= SCHEMATIC_METAMERS);
        }
    }
}
