//! What nothing can be faster than: one shadow cast, and one pass over all metamers.

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use espalier_growth::{NoObserver, Parameters, ShadowGrid, Simulation, StepInput};
use espalier_plant::{MetamerId, Plant};
use glam::Vec3;

const METAMERS: u32 = 100_000;

fn tree() -> Plant {
    let mut simulation = Simulation::new(1, Parameters::default());
    let input = StepInput { autonomous: true, ..StepInput::default() };
    while simulation.plant().living_count() < METAMERS {
        simulation.step(&input, &mut NoObserver);
    }
    simulation.plant().clone()
}

/// All nodes in birth order: neighbours in time, not in space, so the caches help less than in a step.
fn shadow_casts(criterion: &mut Criterion) {
    let plant = tree();
    let nodes: Vec<Vec3> =
        (0..plant.metamer_count()).map(|index| plant.metamers().end(MetamerId::new(index))).collect();
    let mut grid = ShadowGrid::new(&Parameters::default());
    // The voxels are there already: making them is a cost of new space, not of a cast.
    nodes.iter().for_each(|&node| grid.cast(node));
    let mut group = criterion.benchmark_group("floor");
    group.throughput(Throughput::Elements(nodes.len() as u64));
    group.bench_function("cast all shadows", |bencher| {
        bencher.iter(|| nodes.iter().for_each(|&node| grid.cast(black_box(node))));
    });
    group.bench_function("read all light", |bencher| {
        bencher.iter(|| nodes.iter().map(|&node| grid.exposure(black_box(node))).sum::<f32>());
    });
    group.finish();
}

/// What light and vigor are at least: a sum from the tips down, and a share from the bases up.
fn linear_passes(criterion: &mut Criterion) {
    let plant = tree();
    let rows = 0..plant.metamer_count();
    let parents: Vec<Option<usize>> = (rows.clone())
        .map(|index| plant.metamers().parent(MetamerId::new(index)).map(MetamerId::index))
        .collect();
    let own = vec![1.0f64; rows.len()];
    let mut group = criterion.benchmark_group("floor");
    group.throughput(Throughput::Elements(rows.len() as u64));
    group.bench_function("one pass down", |bencher| {
        let down = |sums: &mut Vec<f64>| {
            for index in rows.clone().rev() {
                if let Some(parent) = parents[index] {
                    sums[parent] += sums[index];
                }
            }
        };
        bencher.iter_batched_ref(|| own.clone(), down, BatchSize::SmallInput);
    });
    group.bench_function("one pass up", |bencher| {
        let up = |shares: &mut Vec<f64>| {
            for index in rows.clone() {
                if let Some(parent) = parents[index] {
                    shares[index] += 0.5 * shares[parent];
                }
            }
        };
        bencher.iter_batched_ref(|| own.clone(), up, BatchSize::SmallInput);
    });
    group.finish();
}

criterion_group!(benches, shadow_casts, linear_passes);
criterion_main!(benches);
