//! Long shoots (TreeSketch §3.2, "Shoot growth").

use measure::{grown_axes, mean};

use super::*;

/// A greater n_max gives wispy branches: longer axes, and fewer of them for the same wood.
#[test]
fn long_shoots_are_wispy() {
    for seed in [1, 2, 3] {
        let forms = [4, 8, 16].map(|longest| {
            let mut tree = seedling(seed, |values| values.max_shoot_length = longest);
            grow_to(&mut tree, 3000);
            let plant = tree.plant();
            let internodes = measure::internodes(plant);
            let laterals = grown_axes(plant).filter(|&axis| plant.axes().order(axis) > 0);
            let length = mean(laterals.map(|axis| internodes[axis.index()] as f32));
            (length, grown_axes(plant).count() as f32 / plant.living_count() as f32)
        });
        let (lengths, branchings) = (forms.map(|form| form.0), forms.map(|form| form.1));
        assert!(
            lengths.is_sorted_by(|a, b| 1.2 * a < *b),
            "internodes per lateral: {lengths:?} (seed {seed})"
        );
        assert!(
            branchings.is_sorted_by(|a, b| *a > 1.2 * b),
            "axes per internode: {branchings:?} (seed {seed})"
        );
    }
}
