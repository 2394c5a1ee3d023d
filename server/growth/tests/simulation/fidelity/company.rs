//! Plants in company: they keep apart, crowd and shade each other (TreeSketch §3.2; Pałubicki et al. 2009).

use espalier_plant::{AxisId, checks};
use measure::{mean, trunk_of, wood};

use super::*;

/// The living nodes of each plant of a scene, in the order they were sown.
fn nodes_by_plant(plant: &Plant) -> Vec<Vec<Vec3>> {
    let trunks: Vec<AxisId> =
        (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.axes().order(axis) == 0).collect();
    let mut nodes = vec![Vec::new(); trunks.len()];
    for id in wood(plant) {
        let trunk = trunk_of(plant, plant.metamers().axis(id));
        let number = trunks.binary_search(&trunk).expect("a trunk");
        nodes[number].push(plant.metamers().end(id));
    }
    nodes
}

fn mean_x(nodes: &[Vec3]) -> f32 {
    mean(nodes.iter().map(|node| node.x))
}

/// Two seeds near each other lean apart: each crown's centre of mass lies on its far side, and most of its wood.
#[test]
fn neighbours_grow_away_from_each_other() {
    const GAP: f32 = 10.0;
    for seed in [1, 2, 3] {
        let mut alone = simulation(seed);
        grow(&mut alone, 12);
        let upright = mean_x(&nodes(&alone));
        assert!(upright.abs() < 1.0, "alone: {upright} (seed {seed})");
        let mut pair = simulation(seed);
        pair.sow(Vec3::X * GAP);
        grow(&mut pair, 12);
        let both = nodes_by_plant(pair.plant());
        let (left, right) = (mean_x(&both[0]), mean_x(&both[1]) - GAP);
        assert!(left < upright - 1.0 && right > upright + 1.0, "lean: {left}, {right} (seed {seed})");
        let outward = |nodes: &[Vec3], side: f32, seed_x: f32| {
            mean(nodes.iter().map(|node| f32::from((node.x - seed_x) * side > 0.0)))
        };
        let (left, right) = (outward(&both[0], -1.0, 0.0), outward(&both[1], 1.0, GAP));
        assert!(left > 0.55 && right > 0.55, "wood on the far side: {left}, {right} (seed {seed})");
    }
}

/// In a stand of nine every plant grows less than one alone, and the one in the middle far less than those around
/// it.
#[test]
fn a_stand_crowds_its_plants() {
    const GAP: f32 = 6.0;
    for seed in [1, 2] {
        let mut alone = simulation(seed);
        grow(&mut alone, 12);
        let alone = nodes(&alone).len();
        let mut stand = simulation(seed);
        for (x, z) in [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)] {
            stand.sow(Vec3::new(x as f32, 0.0, z as f32) * GAP);
        }
        grow(&mut stand, 12);
        let sizes: Vec<usize> = nodes_by_plant(stand.plant()).iter().map(Vec::len).collect();
        assert!(sizes.iter().all(|&size| 3 * size < 2 * alone), "{sizes:?} against {alone} (seed {seed})");
        let around = mean(sizes[1..].iter().map(|&size| size as f32));
        assert!((sizes[0] as f32) < 0.75 * around, "the middle: {sizes:?} (seed {seed})");
    }
}

/// A thousand seeds share a scene. One or two may have no marker in sight; all others grow.
#[test]
fn a_thousand_seeds_grow_a_step() {
    let mut scene = simulation(1);
    for i in 1..1000u16 {
        scene.sow(Vec3::new(f32::from(i % 32), 0.0, f32::from(i / 32)) * 6.0 - Vec3::new(96.0, 0.0, 96.0));
    }
    grow(&mut scene, 1);
    let sizes: Vec<usize> = nodes_by_plant(scene.plant()).iter().map(Vec::len).collect();
    assert_eq!(sizes.len(), 1000);
    let grown = sizes.iter().filter(|&&size| size > 0).count();
    assert!(grown >= 990, "{grown} of 1000 have grown");
    assert_eq!(checks::all(scene.plant()), Ok(()));
}
