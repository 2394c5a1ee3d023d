//! The feel of the brush (TreeSketch §3.2): it fills where it is wide and draws where it is narrow.

use proptest::prelude::*;

use super::*;

/// Points along a polyline, every tenth of an internode.
fn points(path: &[Vec3]) -> Vec<Vec3> {
    let mut points = Vec::new();
    for pair in path.windows(2) {
        let count = (pair[0].distance(pair[1]) * 10.0).ceil() as u32;
        points.extend((0..count).map(|i| pair[0].lerp(pair[1], i as f32 / count as f32)));
    }
    points
}

/// Share of a path that has wood within one internode: node or between two nodes of an axis.
fn followed(simulation: &Simulation, path: &[Vec3]) -> f32 {
    let nodes = nodes(simulation);
    let points = points(path);
    let near = points.iter().filter(|p| nodes.iter().any(|n| n.distance(**p) <= 1.0)).count();
    near as f32 / points.len() as f32
}

fn check_sketch(name: &str, path: &[Vec3]) {
    let mut simulation = simulation(5);
    let stroke: Vec<(Vec3, f32)> = path.iter().map(|&p| (p, 0.0)).collect();
    brush(&mut simulation, 1, &stroke);
    let share = followed(&simulation, path);
    assert!(share >= 0.95, "{name}: {share} of the stroke is followed");
    // One limb exactly: hardly more wood than the stroke is long, and no side branch.
    let length: f32 = path.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let grown = simulation.plant().living_count() as f32;
    assert!(grown <= 1.1 * length + 3.0, "{name}: {grown} metamers for a stroke of {length}");
    assert_eq!(simulation.plant().living_axes_count(), 1, "{name}: a sketch is one axis");
}

#[test]
fn a_sketch_follows_straight_and_bent_strokes() {
    check_sketch("straight", &[Vec3::ZERO, Vec3::Y * 40.0]);
    check_sketch("corner", &[Vec3::ZERO, Vec3::Y * 15.0, Vec3::new(15.0, 15.0, 0.0)]);
    check_sketch(
        "zigzag",
        &[Vec3::ZERO, Vec3::new(4.0, 6.0, 0.0), Vec3::new(-4.0, 12.0, 0.0), Vec3::new(6.0, 18.0, 0.0)],
    );
}

#[test]
fn a_sketch_follows_a_helix() {
    let helix: Vec<Vec3> = (0..300)
        .map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * 0.08);
            Vec3::new(5.0 * (cos - 1.0), 0.15 * i as f32, 5.0 * sin)
        })
        .collect();
    check_sketch("helix", &helix);
}

#[test]
fn a_sketch_follows_a_fast_stroke() {
    // Few and far samples, as from a flick of the finger.
    check_sketch("flick", &[Vec3::ZERO, Vec3::new(3.0, 25.0, 0.0), Vec3::new(20.0, 38.0, 0.0)]);
}

#[test]
fn a_sketch_from_a_branch_starts_there() {
    let mut simulation = simulation(5);
    brush(&mut simulation, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * 20.0, 0.0)]);
    let path = [Vec3::Y * 10.0, Vec3::new(12.0, 16.0, 0.0)];
    brush(&mut simulation, 2, &path.map(|p| (p, 0.0)));
    assert!(followed(&simulation, &path) >= 0.95);
    assert_eq!(simulation.plant().living_axes_count(), 2);
}

#[test]
fn a_wide_stroke_fills_its_swept_volume() {
    let (radius, bottom, top) = (8.0, 9.0, 42.0);
    let mut simulation = simulation(3);
    let path: Vec<(Vec3, f32)> = (0..=66).map(|i| (Vec3::Y * (bottom + 0.5 * i as f32), radius)).collect();
    brush(&mut simulation, 1, &[&[(Vec3::ZERO, 0.0), (Vec3::Y * bottom, 0.0)], &path[..]].concat());
    let nodes = nodes(&simulation);
    let reach = simulation.parameters().perception_radius();
    let (mut inside, mut near) = (0, 0);
    for i in 0..20_000u32 {
        // A low-discrepancy cover of the capsule's box.
        let u = |base: f32| (i as f32 * base).fract();
        let p = Vec3::new(u(0.754_877_7) * 2.0 - 1.0, 0.0, u(0.569_840_3) * 2.0 - 1.0) * radius
            + Vec3::Y * (bottom - radius + u(0.438_447_2) * (top - bottom + 2.0 * radius));
        let nearest = Vec3::Y * p.y.clamp(bottom, top);
        if p.distance(nearest) > radius {
            continue;
        }
        inside += 1;
        near += u32::from(nodes.iter().any(|n| n.distance_squared(p) <= reach * reach));
    }
    let share = near as f32 / inside as f32;
    assert!(share > 0.97, "{share} of the swept volume is within a bud's perception");
    let strays = nodes
        .iter()
        .filter(|n| n.y > 1.0 && n.distance(Vec3::Y * n.y.clamp(0.0, top)) > radius + reach)
        .count();
    assert_eq!(strays, 0, "nothing grows far outside the stroke");
    // Thick: at least one node per volume of an occupancy zone, over a third of the volume.
    assert!(
        nodes.len() as f32 > inside as f32 / 20_000.0 * 16.0 * 16.0 * 49.0 / 14.1 / 3.0,
        "{} nodes",
        nodes.len()
    );
}

#[test]
fn passing_from_brush_to_pencil_is_gradual() {
    let spread = |radius: f32| {
        let mut simulation = simulation(8);
        brush(&mut simulation, 1, &[(Vec3::ZERO, radius), (Vec3::Y * 30.0, radius)]);
        let nodes = nodes(&simulation);
        nodes.iter().map(|n| Vec3::new(n.x, 0.0, n.z).length()).sum::<f32>() / nodes.len() as f32
    };
    let widths = [0.0, 1.0, 2.5, 5.0].map(spread);
    assert!(widths[0] < 0.1, "a pencil draws a line: {widths:?}");
    assert!(widths.is_sorted(), "the wider the brush, the wider the tree: {widths:?}");
}

#[test]
fn narrow_strokes_of_every_width_go_their_way() {
    for radius in [0.0, 0.5, 0.9, 1.1, 1.2, 1.45] {
        let (mut strays, mut short) = (0, 0);
        for seed in [1, 2, 3] {
            let mut simulation = simulation(seed);
            brush(&mut simulation, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * 20.0, 0.0)]);
            let path: Vec<(Vec3, f32)> =
                (0..=60u8).map(|i| (Vec3::new(0.5 * f32::from(i), 20.0, 0.0), radius)).collect();
            brush(&mut simulation, 2, &path);
            let nodes = nodes(&simulation);
            let far = nodes.iter().map(|n| n.x).fold(0.0, f32::max);
            let high = nodes.iter().map(|n| n.y).fold(0.0, f32::max);
            strays += u32::from(high > 26.0 + radius);
            short += u32::from(far < 24.0);
        }
        assert_eq!((strays, short), (0, 0), "radius {radius}");
    }
}

#[test]
fn a_brush_may_narrow_to_a_pencil() {
    for seed in [1, 2, 3] {
        let mut simulation = simulation(seed);
        brush(&mut simulation, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * 20.0, 0.0)]);
        let path: Vec<(Vec3, f32)> = (0..=60u8)
            .map(|i| (Vec3::new(0.5 * f32::from(i), 20.0, 0.0), (5.0 - 0.15 * f32::from(i)).max(0.0)))
            .collect();
        brush(&mut simulation, 2, &path);
        let far = nodes(&simulation).iter().map(|n| n.x).fold(0.0, f32::max);
        assert!(far > 28.0, "the pencil goes to the end: {far}");
    }
}

#[test]
fn old_brush_markers_do_not_linger() {
    let mut simulation = simulation(2);
    let rest = |x: f32, radius: f32| {
        let place = BrushSample { position: Vec3::new(x, 60.0, 0.0), radius };
        let piece = BrushPiece { stroke: StrokeId(1), samples: vec![place] };
        StepInput { pieces: vec![piece], ..StepInput::default() }
    };
    simulation.step(&rest(60.0, 6.0), &mut NoObserver);
    assert!(simulation.markers().len() > 50);
    for _ in 0..=simulation.parameters().marker_max_age {
        simulation.step(&rest(90.0, 0.0), &mut NoObserver);
    }
    assert!(simulation.markers().is_empty());
}

/// Mean x of the directions in which wood grew while a wide brush swept from left to right over a young crown.
fn lean_under_a_sweep(seed: u32, tropism_from_stroke: bool) -> f32 {
    let values = ParameterValues { tropism_from_stroke, ..ParameterValues::default() };
    let mut simulation = Simulation::new(seed, Parameters::new(values).expect("in range"));
    grow(&mut simulation, 8);
    let before = simulation.plant().metamer_count();
    brush(&mut simulation, 1, &[(Vec3::new(-8.0, 14.0, 0.0), 7.0), (Vec3::new(8.0, 14.0, 0.0), 7.0)]);
    let plant = simulation.plant();
    let new: Vec<f32> =
        (before..plant.metamer_count()).map(|id| plant.heading(MetamerId::new(id)).x).collect();
    assert!(new.len() > 100, "{} metamers", new.len());
    new.iter().sum::<f32>() / new.len() as f32
}

#[test]
fn tropism_from_the_stroke_turns_shoots_its_way() {
    for seed in 1..=5 {
        let (along, upright) = (lean_under_a_sweep(seed, true), lean_under_a_sweep(seed, false));
        assert!(along > upright + 0.1, "seed {seed}: {along} along the stroke, {upright} without");
    }
}

#[test]
fn strokes_down_back_and_level_reach_their_ends() {
    let top = Vec3::Y * 10.0;
    let down = [top, Vec3::new(3.0, 10.0, 0.0), Vec3::new(12.0, 1.0, 0.0)];
    let back = [top, Vec3::new(14.0, 13.0, 0.0), Vec3::new(15.0, 17.0, 2.0), Vec3::new(-8.0, 19.0, 5.0)];
    let level = [top, Vec3::new(24.0, 10.0, 0.0)];
    for path in [&down[..], &back, &level] {
        for radius in [1.5, 2.0, 3.0, 6.0] {
            for seed in 1..=4 {
                let mut simulation = trunk(seed, |_| {});
                brush(&mut simulation, 2, &stroke(path, radius));
                let left = nearness(&simulation, path[path.len() - 1]);
                assert!(left <= 2.0, "radius {radius}, seed {seed}: {left} from the end of {path:?}");
            }
        }
    }
}

#[test]
fn narrow_brushes_grow_where_they_were_and_nowhere_else() {
    let path = [Vec3::Y * 10.0, Vec3::new(20.0, 10.0, 0.0)];
    for radius in [1.0, 2.0, 3.0] {
        for seed in 1..=6 {
            let mut simulation = trunk(seed, |_| {});
            let before = nodes(&simulation).len();
            brush(&mut simulation, 2, &stroke(&path, radius));
            let grown = &nodes(&simulation)[before..];
            let outside =
                |node: &&Vec3| node.distance(path[0].with_x(node.x.clamp(0.0, 20.0))) > radius + 1.0;
            let spilt = grown.iter().filter(outside).count();
            assert!(spilt * 20 <= grown.len(), "radius {radius}, seed {seed}: {spilt} of {}", grown.len());
        }
    }
}

#[test]
fn a_pencil_that_dips_below_ground_goes_on_along_it() {
    let path = [[0.0, 10.0], [8.0, 4.0], [12.0, -6.0], [24.0, -6.0], [30.0, 6.0]];
    let path = path.map(|[x, y]| Vec3::new(x, y, 0.0));
    for seed in 1..=4 {
        let mut simulation = trunk(seed, |_| {});
        brush(&mut simulation, 2, &stroke(&path, 0.0));
        let on_ground: Vec<Vec3> = path.iter().map(|p| p.with_y(p.y.max(0.2))).collect();
        assert!(followed(&simulation, &on_ground[2..4]) >= 0.95, "the ground is followed");
        assert!(nearness(&simulation, path[4]) <= 1.0, "and left again");
    }
}

#[test]
fn a_stroke_begun_away_from_all_buds_is_reached_by_a_limb() {
    let from = Vec3::new(18.0, 24.0, 0.0);
    for radius in [0.0, 1.0, 4.0] {
        let mut simulation = trunk(3, |_| {});
        let start = nearness(&simulation, from);
        assert!((20.0..25.0).contains(&start), "{start}");
        brush(&mut simulation, 2, &stroke(&[from, Vec3::new(30.0, 24.0, 0.0)], radius));
        assert!(nearness(&simulation, Vec3::new(30.0, 24.0, 0.0)) <= 2.0, "radius {radius}");
    }
}

#[test]
fn what_a_stroke_calls_for_is_not_shed_while_it_lasts() {
    let path = [Vec3::Y * 10.0, Vec3::new(24.0, 4.0, 0.0)];
    for radius in [0.0, 3.0] {
        let mut simulation = trunk(2, |values| values.shedding_threshold = 1.0);
        brush(&mut simulation, 2, &stroke(&path, radius));
        assert!(nearness(&simulation, path[1]) <= 2.0, "radius {radius}");
    }
}

#[test]
fn a_wide_brush_grows_from_the_crown_that_is_there() {
    // Through the crown and out of it: where wood stands, no new limb grows through it.
    let mut simulation = simulation(4);
    grow(&mut simulation, 9);
    let before = simulation.plant().metamer_count();
    let path = [Vec3::Y * 4.0, Vec3::new(0.0, 40.0, 0.0)];
    brush(&mut simulation, 1, &stroke(&path, 4.0));
    let plant = simulation.plant();
    let new = (before..plant.metamer_count()).map(MetamerId::new);
    let leader = new.clone().filter(|&id| plant.metamers().end(id).y > 38.0).count();
    assert!(leader > 0, "it goes on beyond the crown");
    let old: Vec<Vec3> = nodes(&simulation)[..before].to_vec();
    let crowded = |id: &MetamerId| {
        let end = plant.metamers().end(*id);
        old.iter().filter(|node| node.distance(end) < 1.0).count() > 1
    };
    let (crowd, all) = (new.clone().filter(crowded).count(), new.count());
    assert!(crowd * 10 <= all, "{crowd} of {all} metamers grow through others");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Whatever the direction, the radius, the speed and the seed, and whatever the plant's habit is.
    #[test]
    fn any_stroke_reaches_its_end(
        seed: u32,
        corners in prop::collection::vec((-14f32..14.0, 0.3f32..26.0, -14f32..14.0), 1..4),
        radius in 0f32..8.0,
        speed in 0.5f32..40.0,
        (theta, weights, branching) in (0f32..180.0, 0usize..3, 20f32..110.0),
        shedding in 0f32..1.0,
    ) {
        let mut simulation = trunk(seed, |values| {
            (values.setpoint_angle, values.branching_angle) = (theta, branching);
            (values.heading_weight, values.tropism_weight, values.space_weight) =
                [(0.5, 0.25, 0.25), (0.1, 0.8, 0.1), (0.9, 0.05, 0.05)][weights];
            values.shedding_threshold = shedding;
        });
        let path: Vec<Vec3> =
            core::iter::once(Vec3::Y * 10.0).chain(corners.into_iter().map(Vec3::from)).collect();
        // As a finger of that speed draws it, a message after the other.
        let mut drawn = vec![path[0]];
        for pair in path.windows(2) {
            let moves = (pair[0].distance(pair[1]) / speed).ceil().max(1.0);
            drawn.extend((1..=moves as u32).map(|i| pair[0].lerp(pair[1], i as f32 / moves)));
        }
        brush(&mut simulation, 2, &stroke(&drawn, radius));
        let left = nearness(&simulation, path[path.len() - 1]);
        prop_assert!(left <= 2.0, "{left} from the end");
    }
}
