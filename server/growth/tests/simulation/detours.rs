//! Strokes beside obstacles: what is led goes around them, and what has no way comes to an end.

use espalier_growth::{Obstacle, Shape, TriangleMesh};
use glam::Quat;
use proptest::prelude::*;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::{
    obstructing::{any_obstacle, cuboid, violations},
    *,
};

const RADII: [f32; 5] = [1.0, 1.5, 2.0, 3.0, 6.0];
const SEEDS: u32 = 12;

/// It stands on the ground, as high as the tree; a limb comes past it on both sides and above.
fn wall() -> Obstacle {
    cuboid(Vec3::new(7.0, 0.0, -6.0), Vec3::new(9.0, 16.0, 6.0))
}

/// What comes of a stroke from a trunk beside an obstacle.
struct Drawn {
    /// How near wood comes to its end.
    left: f32,
    /// Metamers that grew, and how many do without the obstacle.
    grown: usize,
    freely: usize,
    /// Whether none of them meets the obstacle.
    is_clean: bool,
}

fn drawn(obstacles: &[Obstacle], path: &[Vec3], radius: f32, seed: u32) -> Drawn {
    let grown = |obstacles: &[Obstacle]| {
        let mut simulation = trunk(seed, |_| {});
        simulation.set_metamer_budget(20_000);
        simulation.set_obstacles(obstacles.to_vec());
        let (before, standing) = (simulation.plant().metamer_count(), violations(&simulation));
        brush(&mut simulation, 2, &stroke(path, radius));
        let count = simulation.plant().metamer_count() - before;
        let is_clean = violations(&simulation) == standing;
        (simulation, count, is_clean)
    };
    let (simulation, count, is_clean) = grown(obstacles);
    Drawn { left: nearness(&simulation, path[path.len() - 1]), grown: count, freely: grown(&[]).1, is_clean }
}

/// What is wrong with strokes of all radii by so many seeds.
fn faults(
    obstacle: &Obstacle,
    path: &[Vec3],
    seeds: u32,
    is_wrong: impl Fn(&Drawn) -> bool + Sync,
) -> Vec<String> {
    let cases: Vec<(f32, u32)> =
        RADII.iter().flat_map(|&radius| (1..=seeds).map(move |seed| (radius, seed))).collect();
    let fault = |&(radius, seed): &(f32, u32)| {
        let drawn = drawn(core::slice::from_ref(obstacle), path, radius, seed);
        let Drawn { left, grown, freely, is_clean } = drawn;
        let says = || {
            format!(
                "radius {radius}, seed {seed}: {left} left, {grown} metamers ({freely} freely), {is_clean}"
            )
        };
        (!drawn.is_clean || is_wrong(&drawn)).then(says)
    };
    cases.par_iter().filter_map(fault).collect()
}

/// The end is reached, by little more wood than it takes without the obstacle.
fn check_reached(name: &str, obstacle: &Obstacle, path: &[Vec3]) {
    let faults = faults(obstacle, path, SEEDS, |drawn| drawn.left > 2.0 || drawn.grown > 3 * drawn.freely);
    assert!(faults.is_empty(), "{name}: {faults:#?}");
}

#[test]
fn a_stroke_through_a_wall_goes_around_it() {
    check_reached("wall", &wall(), &[Vec3::new(0.0, 4.0, 0.0), Vec3::new(20.0, 8.0, 0.0)]);
}

#[test]
fn a_stroke_behind_a_wall_is_reached_around_it() {
    check_reached("wall", &wall(), &[Vec3::new(15.0, 10.0, 0.0), Vec3::new(24.0, 12.0, 0.0)]);
}

#[test]
fn a_stroke_through_a_pillar_goes_around_it() {
    let path = [Vec3::Y * 8.0, Vec3::new(22.0, 10.0, 0.0)];
    let pillar = cuboid(Vec3::new(8.0, 0.0, -1.5), Vec3::new(11.0, 60.0, 1.5));
    check_reached("square", &pillar, &path);
    let ball = Shape::Sphere { centre: Vec3::new(10.0, 9.0, 0.0), radius: 5.0 };
    check_reached("ball", &Obstacle::new(ball).expect("a ball"), &path);
}

#[test]
fn a_stroke_that_no_way_leads_to_comes_to_an_end() {
    // From the ground far beyond the crown: nobody goes around it.
    let barrier = cuboid(Vec3::new(7.0, -9.0, -200.0), Vec3::new(7.5, 200.0, 200.0));
    let corners = [(-200.0, -200.0), (-200.0, 200.0), (200.0, 200.0), (200.0, -200.0)];
    let vertices = corners.map(|(y, z)| Vec3::new(7.0, y, z)).to_vec();
    let mesh = TriangleMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh").into();
    let sheet = Shape::Mesh { mesh, position: Vec3::ZERO, rotation: Quat::IDENTITY };
    let through = [Vec3::new(0.0, 4.0, 0.0), Vec3::new(20.0, 8.0, 0.0)];
    let behind = [Vec3::new(15.0, 10.0, 0.0), Vec3::new(24.0, 12.0, 0.0)];
    for obstacle in [barrier, Obstacle::new(sheet).expect("a sheet")] {
        for path in [through, behind] {
            let faults = faults(&obstacle, &path, 2, |drawn| drawn.grown > drawn.freely);
            assert!(faults.is_empty(), "{path:?}: {faults:#?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Whatever stands in the way of whatever stroke, no limb goes to and fro.
    #[test]
    fn no_obstacle_makes_a_stroke_wander(
        seed: u32,
        obstacles in prop::collection::vec(any_obstacle(), 1..5),
        corners in prop::collection::vec((-14f32..14.0, 0.3f32..26.0, -14f32..14.0), 1..4),
        radius in 0f32..4.0,
    ) {
        let path: Vec<Vec3> =
            core::iter::once(Vec3::Y * 10.0).chain(corners.into_iter().map(Vec3::from)).collect();
        let drawn = drawn(&obstacles, &path, radius, seed);
        let length: f32 = path.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let bound = 3 * drawn.freely + 2 * length as usize;
        prop_assert!(drawn.is_clean && drawn.grown <= bound, "{} metamers, {}", drawn.grown, drawn.freely);
    }
}
