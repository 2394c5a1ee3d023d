//! Occupancy zones: what lets no branch grow through another (TreeSketch §3.2, Figure 8B).

use espalier_growth::{ParameterValues, Parameters};
use measure::{bearing_axis, wood};
use proptest::prelude::*;

use super::*;

/// Whether one axis bears the other, or one axis bears both: near their common node they must be close.
fn are_kin(plant: &Plant, a: AxisId, b: AxisId) -> bool {
    let (bearing_a, bearing_b) = (bearing_axis(plant, a), bearing_axis(plant, b));
    a == b || bearing_a == Some(b) || bearing_b == Some(a) || (bearing_a.is_some() && bearing_a == bearing_b)
}

/// The least distance between nodes of axes that are not kin, but for axes that led a stroke: they go where the finger
/// went.
fn least_distance(plant: &Plant, leaders: &BTreeSet<AxisId>) -> f32 {
    let nodes = wood(plant).map(|id| (plant.metamers().axis(id), plant.metamers().end(id)));
    let nodes: Vec<(AxisId, Vec3)> = nodes.filter(|(axis, _)| !leaders.contains(axis)).collect();
    let mut least = f32::INFINITY;
    for (i, &(axis, node)) in nodes.iter().enumerate() {
        for &(other, place) in &nodes[..i] {
            let distance_squared = node.distance_squared(place);
            if distance_squared < least && !are_kin(plant, axis, other) {
                least = distance_squared;
            }
        }
    }
    least.sqrt()
}

fn any_values() -> impl Strategy<Value = ParameterValues> {
    let angles = (20f32..360.0, 0f32..110.0, 0f32..180.0, 0f32..180.0);
    let shares = (0.42f32..0.6, 0f32..0.5, 0f32..0.5);
    (0.5f32..3.0, 0.5f32..5.0, angles, 1u32..=4, 1u32..10, shares).prop_map(
        |(r, d, (zeta, psi, theta, phi), buds, longest, (lambda, beta, gamma))| ParameterValues {
            occupancy_radius: r,
            perception_depth: d,
            perception_angle: zeta,
            branching_angle: psi,
            setpoint_angle: theta,
            phyllotactic_angle: phi,
            buds_per_node: buds,
            max_shoot_length: longest,
            apical_control: lambda,
            heading_weight: 1.0 - beta - gamma,
            tropism_weight: beta,
            space_weight: gamma,
            ..ParameterValues::default()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// No shoot grows into the zone of another branch: nodes of axes that are not kin keep the radius r apart.
    #[test]
    fn branches_keep_out_of_each_others_zones(seed: u32, values in any_values(), x in 6f32..12.0) {
        let radius = values.occupancy_radius;
        let mut scene = Simulation::new(seed, Parameters::new(values).expect("in range"));
        scene.set_metamer_budget(1200);
        scene.sow(Vec3::X * x);
        let leaders = brush(&mut scene, 1, &[(Vec3::Y * 4.0, radius + 2.0), (Vec3::new(0.5 * x, 9.0, 0.0), radius + 3.0)]);
        grow(&mut scene, 8);
        let least = least_distance(scene.plant(), &leaders);
        prop_assert!(least > radius - 1e-4, "{least} of {radius}");
    }
}
