//! What a hand does to a tree, and how the tree goes on from there (TreeSketch §3.3).

use espalier_plant::{Motion, Plant};
use glam::Quat;

use super::*;

/// The lateral of the trunk that bears the most.
fn limb(plant: &Plant) -> MetamerId {
    let trunk = plant.metamers().axis(MetamerId::new(0));
    let begins = |&id: &MetamerId| {
        let parent = plant.metamers().parent(id);
        plant.is_alive(id)
            && plant.metamers().axis(id) != trunk
            && parent.is_some_and(|parent| plant.metamers().axis(parent) == trunk)
    };
    let laterals = (0..plant.metamer_count()).map(MetamerId::new).filter(begins);
    laterals.max_by_key(|&id| plant.above(id).len()).expect("a tree has limbs")
}

/// How many of a tree's metamers from a row on have grown within a zone of some places.
fn grown_among(simulation: &Simulation, places: &[Vec3], from: usize) -> usize {
    let plant = simulation.plant();
    let radius = simulation.parameters().occupancy_radius;
    let new = (from..plant.metamer_count()).map(MetamerId::new).map(|id| plant.metamers().end(id));
    new.filter(|node| places.iter().any(|place| place.distance(*node) <= radius)).count()
}

#[test]
fn a_tree_answers_a_cut_when_it_grows_on() {
    for seed in 1..=5 {
        let mut cut = simulation(seed);
        grow(&mut cut, 14);
        let mut left = cut.clone();
        let limb = limb(cut.plant());
        let places: Vec<Vec3> =
            cut.plant().above(limb).into_iter().map(|id| cut.plant().metamers().end(id)).collect();
        cut.prune(&[limb]);
        let from = cut.plant().metamer_count();
        grow(&mut cut, 5);
        grow(&mut left, 5);
        let (answered, otherwise) = (grown_among(&cut, &places, from), grown_among(&left, &places, from));
        assert!(answered > 2 * otherwise, "seed {seed}: {answered} of {}, {otherwise} uncut", places.len());
    }
}

#[test]
fn growth_goes_on_from_where_a_limb_was_bent_to() {
    for seed in 1..=5 {
        let mut simulation = simulation(seed);
        grow(&mut simulation, 12);
        let limb = limb(simulation.plant());
        let foot = simulation.plant().metamers().parent(limb).expect("the trunk");
        let foot = simulation.plant().metamers().end(foot);
        let motion = Motion { rotation: Quat::from_rotation_y(core::f32::consts::PI), from: foot, to: foot };
        simulation.carry(&[limb], &[motion]).expect("it stays in the world");
        let from = simulation.plant().metamer_count();
        grow(&mut simulation, 3);
        let plant = simulation.plant();
        let rows = plant.above(limb);
        let new: Vec<MetamerId> = rows.iter().copied().filter(|id| id.index() >= from).collect();
        assert!(new.len() > 20, "seed {seed}: {} metamers", new.len());
        for id in new {
            let parent = plant.metamers().parent(id).expect("wood");
            let length = plant.metamers().end(id).distance(plant.metamers().end(parent));
            assert!(
                (length - 1.0).abs() < 1e-3,
                "seed {seed}: it grows from the wood as it stands, {length}"
            );
        }
    }
}
