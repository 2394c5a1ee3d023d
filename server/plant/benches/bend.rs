//! What a bend costs for each event of a pointer, and at the end.

use std::f32::consts::TAU;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use espalier_plant::Bend;
use glam::Vec3;

/// Events once around a circle.
const EVENTS: usize = 120;

/// A path that leans over as branches do, with radii that fall to a fifth.
fn branch(internodes: usize) -> (Vec<Vec3>, Vec<f32>) {
    let share = |i: usize| i as f32 / internodes as f32;
    let step =
        |i: usize| Vec3::new(libm::sinf(1.2 * share(i)), libm::cosf(1.2 * share(i)), 0.1 * (i % 2) as f32);
    let nodes = (0..=internodes).scan(Vec3::ZERO, |node, i| Some(std::mem::replace(node, *node + step(i))));
    (nodes.collect(), (0..internodes).map(|i| 1.0 - 0.8 * share(i)).collect())
}

fn bend(criterion: &mut Criterion) {
    for (name, touches) in [("end", 1), ("end and two touches between", 3)] {
        let mut group = criterion.benchmark_group(format!("event, {name}"));
        for internodes in [50, 100, 300, 1000] {
            let (nodes, radii) = branch(internodes);
            let mut bend = Bend::new(&nodes, &radii, 0.2);
            let mut event = 0;
            group.bench_function(BenchmarkId::from_parameter(internodes), |bencher| {
                bencher.iter(|| {
                    event = (event + 1) % EVENTS;
                    let angle = TAU * event as f32 / EVENTS as f32;
                    let way = 0.3 * Vec3::new(libm::sinf(angle), libm::cosf(angle) - 1.0, libm::sinf(angle));
                    let targets: Vec<_> = (1..=touches)
                        .map(|touch| {
                            let at = (internodes - 1) * touch / touches;
                            (at, nodes[at + 1] + at as f32 * way)
                        })
                        .collect();
                    bend.drag(&targets);
                    bend.motions().len()
                });
            });
        }
        group.finish();
    }
    let mut group = criterion.benchmark_group("release right after a leap");
    for internodes in [50, 100, 300, 1000] {
        let (nodes, radii) = branch(internodes);
        let end = nodes[internodes] + 0.3 * internodes as f32 * Vec3::new(0.5, -1.0, 0.5);
        let mut bend = Bend::new(&nodes, &radii, 0.2);
        bend.drag(&[(internodes - 1, end)]);
        group.bench_function(BenchmarkId::from_parameter(internodes), |bencher| {
            bencher.iter_batched_ref(|| bend.clone(), Bend::relax, BatchSize::SmallInput);
        });
    }
    group.finish();
}

criterion_group!(benches, bend);
criterion_main!(benches);
