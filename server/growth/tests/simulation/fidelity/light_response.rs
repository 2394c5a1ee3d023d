//! What light does: sensitivity κ, shedding Th (TreeSketch §3.2), and phototropism (Pałubicki et al. 2009).

use espalier_growth::{Envelope, Plane};
use glam::Vec2;
use measure::{densities, light, limbs, mean};

use super::*;

/// Buds that answer to strong light only make a sparser crown with more light in it; it takes them longer, and its
/// limbs are as many and as strong as those of any tree of that size. `--nocapture` prints what is measured.
#[test]
fn sensitivity_to_light_makes_a_sparser_lighter_crown_of_the_same_limbs() {
    let forms = [1.0, 3.0, 6.0].map(|kappa| {
        let trees = grown_to_3000(kappa, 0.0);
        let over = |measure: &dyn Fn(&Plant) -> f32| mean(trees.iter().map(|tree| measure(tree.plant())));
        [
            over(&|plant| plant.growths() as f32),
            over(&|plant| densities(plant).0),
            over(&|plant| densities(plant).1),
            over(&light),
            over(&|plant| limbs(plant, 0.01).len() as f32),
            over(&|plant| mean(limbs(plant, 0.01))),
        ]
    });
    let column = |i: usize| forms.map(|form| form[i]);
    let [steps, inner, outer, light, number, strength] = [0, 1, 2, 3, 4, 5].map(column);
    println!("steps {steps:?}\nnodes inside {inner:?}, outside {outer:?}\nlight {light:?}");
    println!("limbs of a hundredth {number:?}, mean share of one {strength:?}");
    assert!(steps.is_sorted_by(|a, b| a + 1.0 < *b), "steps: {steps:?}");
    assert!(inner.is_sorted_by(|a, b| *a > 1.1 * b), "nodes inside: {inner:?}");
    assert!(outer.is_sorted_by(|a, b| *a > 1.3 * b), "nodes outside: {outer:?}");
    assert!(light.is_sorted_by(|a, b| a + 0.04 < *b), "light: {light:?}");
    for limbs in [number, strength] {
        let [one, other, another] = limbs;
        let (least, most) = (one.min(other).min(another), one.max(other).max(another));
        assert!(most < 1.2 * least, "limbs of trees of one size: {limbs:?}");
    }
}

/// Shedding judges vigor, which sensitivity takes from all that is not in full light: it grows and sheds more.
#[test]
fn sensitivity_to_light_sheds_more() {
    let shed = [1.0, 3.0, 6.0].map(|kappa| mean(grown_to_3000(kappa, 0.2).iter().map(shed_share)));
    println!("shed of what was grown {shed:?}");
    assert!(shed[0] < 0.01, "shed: {shed:?}");
    assert!(shed.is_sorted_by(|a, b| a + 0.1 < *b), "shed: {shed:?}");
}

/// Trees of four seeds with this sensitivity to light and this threshold of shedding.
fn grown_to_3000(kappa: f32, threshold: f32) -> [Simulation; 4] {
    [1, 2, 3, 4].map(|seed| {
        let mut tree = seedling(seed, |values| {
            (values.apical_control, values.light_sensitivity) = (0.5, kappa);
            values.shedding_threshold = threshold;
        });
        grow_to(&mut tree, 3000);
        tree.show();
        tree
    })
}

/// The share of all wood ever grown that was shed.
fn shed_share(tree: &Simulation) -> f32 {
    let seeds = 1.0;
    1.0 - tree.plant().living_count() as f32 / (tree.plant().metamer_count() as f32 - seeds)
}

/// The part of the threshold's range that its control gets most of its travel for is where most happens.
#[test]
fn shedding_does_most_where_its_control_is_widest() {
    let row = ParameterValues::ROWS.iter().find(|row| row.name == "shedding_threshold").expect("a row");
    let [from, to] = row.travel.expect("a part of the range");
    let living = |threshold| {
        mean([1, 2, 3, 4].map(|seed| {
            let mut tree = seedling(seed, |values| values.shedding_threshold = threshold);
            grow(&mut tree, 14);
            tree.plant().living_count() as f32
        }))
    };
    let course = [0.0, from, 0.4, 0.5, to, 0.8, 1.0].map(living);
    println!("metamers after 14 steps at Th = 0, {from}, 0.4, 0.5, {to}, 0.8, 1: {course:?}");
    let [none, begins, _, _, ends, _, all] = course;
    assert!(begins - ends > 0.7 * (none - all), "metamers: {course:?}");
    assert!(begins > 0.95 * none && ends < 0.3 * none, "metamers: {course:?}");
}

/// Shedding thins the inside of the crown and leaves its outside as it is.
#[test]
fn shedding_thins_the_inside_of_the_crown() {
    for seed in [1, 2, 3] {
        let parts = |threshold| {
            let mut tree = seedling(seed, |values| values.shedding_threshold = threshold);
            grow(&mut tree, 14);
            densities(tree.plant())
        };
        let ((inner, outer), (thinned, kept)) = (parts(0.0), parts(0.4));
        assert!(thinned < 0.95 * inner, "inside: {thinned} of {inner} (seed {seed})");
        assert!(kept > 0.95 * outer, "outside: {kept} of {outer} (seed {seed})");
    }
}

/// A dense, flat canopy over one side of the seed at the origin, out of reach of all but its shadow.
fn beside_a_canopy(seed: u32, side: f32) -> Simulation {
    let mut scene = seedling(seed, |values| {
        (values.perception_angle, values.max_shoot_length, values.occupancy_radius) = (150.0, 2, 1.0);
        (values.heading_weight, values.tropism_weight, values.space_weight) = (0.45, 0.05, 0.5);
        values.marker_density = 0.5;
    });
    let stem = [Vec3::X * 10.0 * side, Vec3::new(10.0 * side, 11.0, 0.0)];
    scene.sow(stem[0]);
    brush(&mut scene, 1, &stem.map(|place| (place, 0.0)));
    let outline = [(0.0, -10.0), (20.0, -10.0), (20.0, 10.0), (0.0, 10.0)];
    let outline = outline.map(|(x, z)| Vec2::new(x * side, z));
    let plane = Plane { origin: Vec3::Y * 11.0, right: Vec3::X, up: Vec3::Z };
    scene.enclose(&Envelope::inflate(&outline, plane, 0.2, 1.0).expect("a lasso"));
    for _ in 0..60 {
        scene.step(&StepInput::default(), &mut NoObserver);
    }
    scene.drop_guidance();
    scene
}

/// Phototropism turns axes under a one-sided canopy to the open side. Without it the same axes grow the same way on
/// either side: they do not touch the canopy, and vigor is made not to depend on light.
#[test]
fn axes_beside_a_canopy_turn_to_the_light() {
    for seed in [1, 2] {
        let [without, with] = [0.0, 0.3].map(|phototropism| {
            [-1.0, 1.0].map(|side| {
                let mut scene = beside_a_canopy(seed, side);
                let old = scene.plant().metamer_count();
                assert!(old > 250, "{old} metamers of canopy");
                scene.set_parameters(changed(|values| {
                    (values.phototropism, values.light_sensitivity) = (phototropism, 0.0);
                    (values.shadow_strength, values.shadow_decay, values.shadow_depth) = (0.5, 1.5, 8);
                    (values.occupancy_radius, values.perception_depth) = (0.8, 1.5);
                    (values.heading_weight, values.tropism_weight, values.space_weight) = (0.5, 0.0, 0.5);
                    (values.max_shoot_length, values.trunk_upward) = (2, false);
                }));
                let chosen = Some(MetamerId::new(0));
                for _ in 0..4 {
                    scene.step(
                        &StepInput { autonomous: true, chosen, ..StepInput::default() },
                        &mut NoObserver,
                    );
                }
                let plant = scene.plant();
                let new: Vec<MetamerId> = (old..plant.metamer_count()).map(MetamerId::new).collect();
                assert!(new.len() > 15, "{} new metamers", new.len());
                mean(new.iter().map(|&id| plant.heading(id).x))
            })
        });
        assert_eq!(without[0], without[1], "without phototropism (seed {seed})");
        let [shade_left, shade_right] = with;
        assert!(shade_left > shade_right + 0.2, "mean heading: {shade_left}, {shade_right} (seed {seed})");
    }
}
