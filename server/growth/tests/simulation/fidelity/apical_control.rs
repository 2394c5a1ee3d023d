//! Who leads: the trunk or its limbs (TreeSketch §3.2; Pałubicki et al. 2009, Figure 7).

use espalier_growth::VigorModel;
use measure::{height, largest_limb, leader_at, limbs, mean, spread, trunk_share};

use super::*;

/// Apical control λ swept from 0.46 to 0.54 turns a decurrent tree into an excurrent one: the trunk comes to reach
/// the top, the strongest limb carries less and less of the tree, and big limbs become fewer.
#[test]
fn apical_control_turns_decurrent_into_excurrent() {
    let forms = [0.46, 0.48, 0.5, 0.52, 0.54].map(|lambda| {
        let trees: Vec<Simulation> = (1..=4)
            .map(|seed| {
                let mut tree = seedling(seed, |values| values.apical_control = lambda);
                grow_to(&mut tree, 3000);
                tree
            })
            .collect();
        let over = |measure: &dyn Fn(&Plant) -> f32| mean(trees.iter().map(|tree| measure(tree.plant())));
        [over(&trunk_share), over(&largest_limb), over(&|plant| limbs(plant, 0.1).len() as f32)]
    });
    let column = |i: usize| forms.map(|form| form[i]);
    let [trunk, largest, big] = [column(0), column(1), column(2)];
    assert!(trunk[..2].iter().all(|&share| share < 0.65), "the trunk dissolves: {trunk:?}");
    assert!(trunk[2] > 0.95, "the trunk all but reaches the top: {trunk:?}");
    assert!(trunk[3..].iter().all(|&share| share > 0.99), "the trunk reaches the top: {trunk:?}");
    assert!(largest.is_sorted_by(|a, b| a > b), "the largest limb carries: {largest:?}");
    assert!(largest[0] > 2.5 * largest[4], "the largest limb carries: {largest:?}");
    assert!(big.is_sorted_by(|a, b| a > b), "limbs with a tenth of the tree: {big:?}");
}

/// Apical control that falls with age gives a clear trunk below and a spread crown above, which neither a high nor
/// a low one does throughout.
#[test]
fn ageing_apical_control_gives_a_trunk_and_a_crown() {
    for seed in [1, 2, 3] {
        let tree = |young, old| {
            let mut tree = seedling(seed, |values| {
                (values.apical_control, values.mature_apical_control) = (young, old);
                (values.maturity_start, values.maturity_steps) = (8, 3);
            });
            grow(&mut tree, 16);
            tree
        };
        let (always_young, ageing, always_old) = (tree(0.56, 0.56), tree(0.56, 0.44), tree(0.44, 0.44));
        let leader = |tree: &Simulation, share: f32| leader_at(tree.plant(), share * height(tree.plant()));
        let [young, aged, old] = [&always_young, &ageing, &always_old].map(|tree| leader(tree, 0.25));
        assert!(aged > 1.15 * old && young > aged, "stem at a quarter: {young}, {aged}, {old} (seed {seed})");
        let [young, aged, old] = [&always_young, &ageing, &always_old].map(|tree| leader(tree, 0.75));
        assert!(
            aged < 0.5 * young && aged > old,
            "stem at three quarters: {young}, {aged}, {old} (seed {seed})"
        );
        let [young, aged, old] = [&always_young, &ageing, &always_old].map(|tree| trunk_share(tree.plant()));
        assert!(young > 0.99 && aged > 0.8 && old < 0.4, "trunk: {young}, {aged}, {old} (seed {seed})");
        let (narrow, wide) = (spread(always_young.plant()), spread(ageing.plant()));
        assert!(wide > 1.5 * narrow, "crown: {wide} against {narrow} (seed {seed})");
    }
}

/// Under the priority model the least weight w_min goes from slender, conifer-like trees to broad ones.
#[test]
fn a_small_least_weight_gives_slender_trees() {
    for seed in [1, 2, 3] {
        let slenderness = |least| {
            let mut tree = seedling(seed, |values| {
                values.vigor_model = VigorModel::Priority;
                values.priority_least_weight = least;
            });
            grow_to(&mut tree, 1500);
            height(tree.plant()) / spread(tree.plant())
        };
        let (conifer, broad) = (slenderness(0.006), slenderness(1.0));
        assert!(conifer > 1.3 * broad, "height over spread: {conifer} against {broad} (seed {seed})");
    }
}

/// Under the priority model the terminal bud is put first while λ is not below 0.5. Without that the trunk
/// dissolves, the sooner the greater the least weight is.
#[test]
fn without_terminal_first_the_trunk_dissolves() {
    let trunk = |least, lambda| {
        mean((1..=6).map(|seed| {
            let mut tree = seedling(seed, |values| {
                values.vigor_model = VigorModel::Priority;
                (values.priority_least_weight, values.apical_control) = (least, lambda);
            });
            grow_to(&mut tree, 1500);
            trunk_share(tree.plant())
        }))
    };
    let [first, not_first] = [0.52, 0.48].map(|lambda| [0.006, 0.3, 0.5].map(|least| trunk(least, lambda)));
    assert!(first[0] > 0.99 && first[2] < 0.95 && first[2] > 0.8, "terminal first: {first:?}");
    assert!(not_first[0] < 0.85 && not_first[1] < 0.4 && not_first[2] < 0.4, "not first: {not_first:?}");
}
