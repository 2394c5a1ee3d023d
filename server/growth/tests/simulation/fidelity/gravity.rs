//! What gravity does to buds and axes: gravimorphism and the set-point angle (TreeSketch §3.2, Figures 10 to 12).

use measure::{bearing_axis, grown_axes, internodes, mean};

use super::*;

/// Of the laterals grown on level axes, the shares that sit on the upper side, to the sides and below: within 45°
/// of each.
fn polar_places(plant: &Plant) -> [f32; 3] {
    let mut counts = [0u32; 3];
    for axis in grown_axes(plant).filter(|&axis| plant.axes().order(axis) > 1) {
        let Some(bearer) = plant.axes().bearer(axis) else { continue };
        let heading = plant.heading(bearer);
        if heading.y.abs() > 0.5 {
            continue;
        }
        let vertical = (Vec3::Y - heading * heading.y).normalize();
        let direction = plant.axes().direction(axis);
        let across = (direction - heading * direction.dot(heading)).normalize();
        let cos_chi = across.dot(vertical);
        let side =
            if cos_chi.abs() < core::f32::consts::FRAC_1_SQRT_2 { 1 } else { usize::from(cos_chi < 0.0) * 2 };
        counts[side] += 1;
    }
    let all: u32 = counts.iter().sum();
    assert!(all > 300, "{all} laterals on level axes");
    counts.map(|count| count as f32 / all as f32)
}

/// The control ellipse decides on which side of plagiotropic axes laterals thrive: above under epitony, below under
/// hypotony, to the sides under amphitony, anywhere under none of them.
#[test]
fn gravimorphism_chooses_the_side_of_laterals() {
    for seed in [1, 2] {
        let places = |shift, vertical, horizontal| {
            let mut tree = seedling(seed, |values| {
                (values.setpoint_angle, values.branching_angle) = (90.0, 60.0);
                values.gravimorphism_shift = shift;
                values.gravimorphism_vertical = vertical;
                values.gravimorphism_horizontal = horizontal;
            });
            grow_to(&mut tree, 4000);
            polar_places(tree.plant())
        };
        let [above, beside, below] = places(0.0, 1.0, 1.0);
        let is_even = (above - 0.25).abs() < 0.08 && (below - 0.25).abs() < 0.08;
        assert!(is_even, "indifferent: {above}, {beside}, {below} (seed {seed})");
        let [above, beside, below] = places(0.7, 1.0, 1.0);
        assert!(above > 0.3 && below < 0.05, "epitony: {above}, {beside}, {below} (seed {seed})");
        let [above, beside, below] = places(-0.7, 1.0, 1.0);
        assert!(below > 0.26 && above < 0.05, "hypotony: {above}, {beside}, {below} (seed {seed})");
        let [above, beside, below] = places(0.0, 0.3, 1.5);
        assert!(beside > 0.8, "amphitony: {above}, {beside}, {below} (seed {seed})");
    }
}

/// A set-point angle of 0° gives axes that rise, 90° plagiotropic, 180° weeping ones, and each angle between them
/// what lies between.
#[test]
fn the_set_point_angle_raises_levels_or_weeps() {
    let forms = [0.0, 45.0, 90.0, 135.0, 180.0].map(|angle| {
        let trees = [1, 2].map(|seed| {
            let mut tree = seedling(seed, |values| values.setpoint_angle = angle);
            grow_to(&mut tree, 3000);
            tree
        });
        let (mut elevations, mut rises) = (Vec::new(), Vec::new());
        for plant in trees.iter().map(Simulation::plant) {
            let internodes = internodes(plant);
            for axis in grown_axes(plant).filter(|&axis| internodes[axis.index()] >= 8) {
                let Some(bearer) = plant.axes().bearer(axis) else { continue };
                elevations.push(libm::asinf(plant.bud_direction(axis).y.clamp(-1.0, 1.0)).to_degrees());
                let rise = plant.bud_position(axis).y - plant.metamers().end(bearer).y;
                rises.push(rise / internodes[axis.index()] as f32);
            }
        }
        assert!(elevations.len() > 100, "{} long laterals at {angle}°", elevations.len());
        (mean(elevations), mean(rises))
    });
    let (elevations, rises) = (forms.map(|form| form.0), forms.map(|form| form.1));
    assert!(elevations.is_sorted_by(|a, b| a > b), "elevation of tips: {elevations:?}");
    assert!(elevations[0] > 60.0 && elevations[2].abs() < 10.0 && elevations[4] < -50.0, "{elevations:?}");
    assert!(rises.is_sorted_by(|a, b| a > b), "rise per internode: {rises:?}");
    assert!(rises[0] > 0.7 && rises[2].abs() < 0.25 && rises[4] < -0.3, "{rises:?}");
}

/// The switch for the trunk keeps it upright whatever its limbs do (TreeSketch §3.4).
#[test]
fn a_trunk_stays_upright_over_weeping_limbs() {
    let mut tree = seedling(1, |values| values.setpoint_angle = 180.0);
    grow(&mut tree, 8);
    let plant = tree.plant();
    let trunk = measure::wood(plant).filter(|&id| {
        let axis = plant.metamers().axis(id);
        bearing_axis(plant, axis).is_none()
    });
    let upright: Vec<f32> = trunk.map(|id| plant.heading(id).y).collect();
    assert!(upright.len() > 20 && upright.iter().all(|&y| y > 0.9), "{upright:?}");
}
