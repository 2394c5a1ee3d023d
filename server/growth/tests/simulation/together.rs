//! Strokes at the same time: copies of one stroke mirrored or around the trunk, and two people who draw at once.

use super::*;

/// Strokes of which each goes on by two internodes in turn, as messages of their copies arrive; then growth settles.
fn brush_in_turn(simulation: &mut Simulation, paths: &[Vec<Vec3>], radius: f32) {
    let longest = simulation.parameters().max_shoot_length as f32;
    let drawn: Vec<Vec<Vec3>> = paths.iter().map(|path| points_along(path, 2.0)).collect();
    let moves = drawn.iter().map(Vec::len).max().unwrap_or(0);
    for at in 1..moves {
        for (stroke, path) in (0..).zip(&drawn) {
            let Some(&[from, to]) = path.get(at - 1..=at) else { continue };
            let pieces = (from.distance(to) / longest).ceil().max(1.0) as u32;
            for i in 0..pieces {
                let sample =
                    |i: u32| BrushSample { position: from.lerp(to, i as f32 / pieces as f32), radius };
                let piece =
                    BrushPiece { stroke: StrokeId(10 + stroke), samples: vec![sample(i), sample(i + 1)] };
                simulation.step(&StepInput { pieces: vec![piece], ..StepInput::default() }, &mut NoObserver);
            }
        }
    }
    for stroke in (0..).zip(&drawn).map(|(stroke, _)| StrokeId(10 + stroke)) {
        settle(simulation);
        simulation.end_stroke(stroke);
    }
    simulation.drop_guidance();
}

fn points_along(path: &[Vec3], spacing: f32) -> Vec<Vec3> {
    let mut points = vec![path[0]];
    for pair in path.windows(2) {
        let count = (pair[0].distance(pair[1]) / spacing).ceil().max(1.0) as u32;
        points.extend((1..=count).map(|i| pair[0].lerp(pair[1], i as f32 / count as f32)));
    }
    points
}

fn length(path: &[Vec3]) -> f32 {
    path.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// Two copies are mirrored, more stand around the trunk.
fn copies(path: &[Vec3], count: u8) -> Vec<Vec<Vec3>> {
    let copy = |i: u8| {
        let (sin, cos) = libm::sincosf(core::f32::consts::TAU * f32::from(i) / f32::from(count));
        let turned = |p: &Vec3| match count {
            2 => p.with_x(if i == 0 { p.x } else { -p.x }),
            _ => Vec3::new(p.x * cos + p.z * sin, p.y, p.z * cos - p.x * sin),
        };
        path.iter().map(turned).collect()
    };
    (0..count).map(copy).collect()
}

/// What is drawn, and from what: a trunk so tall.
fn forms() -> [(&'static str, f32, Vec<Vec3>); 6] {
    let path = |points: &[[f32; 2]]| points.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect::<Vec<_>>();
    [
        ("out", 0.0, path(&[[0.2, 0.0], [10.0, 6.0]])),
        ("up, then out", 0.0, path(&[[0.2, 0.0], [0.2, 8.0], [8.0, 14.0]])),
        ("goblet", 0.0, path(&[[0.3, 0.2], [3.0, 5.0], [4.0, 12.0], [9.0, 18.0]])),
        ("up", 0.0, path(&[[0.0, 0.0], [0.0, 16.0]])),
        ("from the top", 10.0, path(&[[0.2, 10.0], [12.0, 15.0]])),
        ("down from the top", 10.0, path(&[[0.2, 10.0], [6.0, 11.0], [12.0, 4.0]])),
    ]
}

fn grown(seed: u32, trunk: f32) -> Simulation {
    let mut simulation = simulation(seed);
    if trunk > 0.0 {
        brush(&mut simulation, 1, &[(Vec3::ZERO, 0.0), (Vec3::Y * trunk, 0.0)]);
    }
    simulation
}

fn nearness(simulation: &Simulation, place: Vec3) -> f32 {
    nodes(simulation).iter().map(|node| node.distance(place)).fold(f32::INFINITY, f32::min)
}

#[test]
fn all_copies_of_a_stroke_reach_their_ends() {
    for (name, trunk, path) in forms() {
        for radius in [0.0, 1.5, 2.0] {
            for seed in [1, 2, 3] {
                let born = grown(seed, trunk).plant().metamer_count();
                let grows = |count| {
                    let mut simulation = grown(seed, trunk);
                    let copies = copies(&path, count);
                    brush_in_turn(&mut simulation, if count == 1 { &copies[..1] } else { &copies }, radius);
                    for copy in copies {
                        let left = nearness(&simulation, copy[copy.len() - 1]);
                        assert!(
                            left <= 2.0,
                            "{name}, {count} of radius {radius}, seed {seed}: {left} from an end"
                        );
                    }
                    simulation.plant().metamer_count() - born
                };
                let single = grows(1) as f32;
                for count in [2, 4, 8] {
                    let all = grows(count) as f32;
                    // Each is led by a limb of its own, from a bud a few internodes away.
                    let most = f32::from(count) * (1.25 * single.max(length(&path)) + 6.0);
                    assert!(
                        all <= most,
                        "{name}, {count} of radius {radius}, seed {seed}: {all}, alone {single}"
                    );
                }
            }
        }
    }
}

#[test]
fn copies_share_the_wood_where_their_paths_run_together() {
    let [_, (_, _, path), _, (_, _, up), ..] = forms();
    for (path, apart) in [(path, 10.0), (up, 0.0)] {
        for count in [2, 4, 8] {
            let mut simulation = grown(1, 0.0);
            brush_in_turn(&mut simulation, &copies(&path, count), 0.0);
            let shared = length(&path) - apart;
            let most = shared + f32::from(count) * (apart + 3.0);
            let metamers = simulation.plant().living_count() as f32;
            assert!(metamers <= most, "{count}: {metamers}");
        }
    }
}

#[test]
fn two_who_draw_at_once_from_one_seedling_both_arrive() {
    let right = vec![Vec3::ZERO, Vec3::new(12.0, 6.0, 0.0), Vec3::new(18.0, 2.0, 0.0)];
    let back = vec![Vec3::ZERO, Vec3::new(0.0, 9.0, -2.0), Vec3::new(-3.0, 14.0, -9.0)];
    for radius in [0.0, 1.0, 2.0, 4.0] {
        for seed in 1..=4 {
            let paths = [right.clone(), back.clone()];
            let mut both = grown(seed, 0.0);
            brush_in_turn(&mut both, &paths, radius);
            let alone = paths.each_ref().map(|path| {
                let mut one = grown(seed, 0.0);
                brush_in_turn(&mut one, core::slice::from_ref(path), radius);
                one.plant().living_count()
            });
            let most = 1.25 * alone.iter().sum::<u32>() as f32 + 12.0;
            let count = both.plant().living_count();
            assert!(count as f32 <= most, "radius {radius}, seed {seed}: {count}, alone {alone:?}");
            for path in &paths {
                let left = nearness(&both, path[2]);
                assert!(left <= 2.0, "radius {radius}, seed {seed}: {left} from an end");
            }
        }
    }
}

#[test]
fn a_stroke_without_a_free_bud_waits_for_one() {
    let mut simulation = grown(1, 0.0);
    let paths = [[Vec3::ZERO, Vec3::new(4.0, 3.0, 0.0)], [Vec3::ZERO, Vec3::new(-4.0, 3.0, 0.0)]];
    let piece = |(stroke, path): (u32, &[Vec3; 2])| BrushPiece {
        stroke: StrokeId(stroke),
        samples: path.map(|position| BrushSample { position, radius: 0.0 }).to_vec(),
    };
    let pieces = (1..).zip(&paths).map(piece).collect();
    simulation.step(&StepInput { pieces, ..StepInput::default() }, &mut NoObserver);
    let guide = |simulation: &Simulation| simulation.guide(StrokeId(2)).expect("it is drawn").clone();
    let waits = guide(&simulation);
    assert!(waits.is_waiting() && waits.leader.is_none() && !waits.is_out_of_reach, "{waits:?}");
    settle(&mut simulation);
    assert!(!guide(&simulation).is_waiting() && nearness(&simulation, paths[1][1]) <= 0.5);
}
