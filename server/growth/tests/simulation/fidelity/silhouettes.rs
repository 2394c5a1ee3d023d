//! The lasso: trees take on the silhouettes drawn around them (TreeSketch §3.2, Figure 7).

use espalier_growth::{Envelope, Plane};
use glam::Vec2;
use measure::{Cover, is_inside};

use super::*;

const FRONT: Plane = Plane { origin: Vec3::ZERO, right: Vec3::X, up: Vec3::Y };
/// What a twig's leaves cover around its node: a little more than an internode.
const FOLIAGE: f32 = 0.75;

/// Grows a tree of default parameters into an outline. Where the outline begins far above the seed, a trunk is sketched up to it first.
fn grown_into(outline: &[Vec2], seed: u32) -> Simulation {
    let mut tree = simulation(seed);
    let above_seed = (0..60u8).map(|half| 0.5 * f32::from(half));
    let lowest =
        above_seed.into_iter().find(|&y| is_inside(outline, Vec2::new(0.0, y))).expect("above the seed");
    if lowest > 3.0 {
        brush(&mut tree, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * (lowest + 2.0), 0.0)]);
    }
    tree.enclose(
        &Envelope::inflate(outline, FRONT, 1.0, tree.parameters().occupancy_radius).expect("a lasso"),
    );
    for _ in 0..120 {
        if tree.step(&StepInput::default(), &mut NoObserver).metamers_grown == 0 {
            break;
        }
    }
    tree
}

/// Seen from the front the foliage covers what was drawn: of the area of both, more than 85 in 100 is common.
#[test]
fn silhouettes_are_those_that_were_drawn() {
    for (name, outline) in outlines::all() {
        for seed in [1, 2] {
            let cover = Cover::of(grown_into(&outline, seed).plant(), &outline, FOLIAGE);
            assert!(cover.overlap() > 0.85, "{name}, seed {seed}: {} of {cover:?}", cover.overlap());
        }
    }
}

/// A silhouette is not matched by just any tree of its height.
#[test]
fn other_silhouettes_do_not_match() {
    let all = outlines::all();
    for pair in all.windows(2) {
        let [(drawn, outline), (other, not_drawn)] = pair else { continue };
        let overlap = Cover::of(grown_into(outline, 1).plant(), not_drawn, FOLIAGE).overlap();
        assert!(overlap < 0.75, "a tree grown as a {drawn} against a {other}: {overlap}");
    }
}
