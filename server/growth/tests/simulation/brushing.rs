//! The feel of the brush (TreeSketch §3.2): it fills where it is wide and draws where it is narrow.

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
    let far = BrushSample { position: Vec3::new(60.0, 60.0, 0.0), radius: 6.0 };
    let piece = BrushPiece { stroke: StrokeId(1), samples: vec![far] };
    simulation.step(&StepInput { pieces: vec![piece], ..StepInput::default() }, &mut NoObserver);
    assert!(!simulation.markers().is_empty());
    for _ in 0..=simulation.parameters().marker_max_age {
        simulation.step(&StepInput::default(), &mut NoObserver);
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
