//! Whole trees: grown from seed to so many living metamers by the full model, and the last step of that.

mod support;

use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, SamplingMode, criterion_group, criterion_main};
use espalier_growth::{NoObserver, ParameterValues, Parameters, Simulation, StepInput, use_clock};
use rayon::{ThreadPool, ThreadPoolBuilder};

const THREADS: [usize; 2] = [1, 2];
/// Sheds a fourteenth of what grows, and still lets the tree reach its size.
const SHEDDING_THRESHOLD: f32 = 0.4;

/// A tree to grow.
#[derive(Clone, Copy)]
struct Kind {
    name: &'static str,
    shedding_threshold: f32,
}

const KINDS: [Kind; 2] = [
    Kind { name: "keeping", shedding_threshold: 0.0 },
    Kind { name: "shedding", shedding_threshold: SHEDDING_THRESHOLD },
];

fn seedling(kind: Kind) -> Simulation {
    let values =
        ParameterValues { shedding_threshold: kind.shedding_threshold, ..ParameterValues::default() };
    let mut simulation = Simulation::new(1, Parameters::new(values).expect("the threshold is in range"));
    simulation.set_metamer_budget(u32::MAX);
    simulation
}

fn step(simulation: &mut Simulation) {
    let input = StepInput { autonomous: true, ..StepInput::default() };
    simulation.step(&input, &mut NoObserver);
}

fn grown(kind: Kind, metamers: u32) -> Simulation {
    let mut simulation = seedling(kind);
    while simulation.plant().living_count() < metamers {
        step(&mut simulation);
    }
    simulation
}

/// How long the step took with which a tree reached so many metamers. A copy of the tree would not do: a copy's
/// columns are full, and its memory is new.
fn last_step(kind: Kind, metamers: u32) -> Duration {
    let mut simulation = seedling(kind);
    loop {
        let begun = Instant::now();
        step(&mut simulation);
        let took = begun.elapsed();
        if simulation.plant().living_count() >= metamers {
            return took;
        }
    }
}

/// Calls `bench` with a name for each kind of tree on each number of threads, and the threads.
fn each_way(mut bench: impl FnMut(BenchmarkId, Kind, &ThreadPool)) {
    use_clock(support::passed);
    for threads in THREADS {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
        for kind in KINDS {
            bench(BenchmarkId::new(kind.name, format!("threads={threads}")), kind, &pool);
        }
    }
}

fn whole_trees(criterion: &mut Criterion) {
    for (name, metamers) in [("tree of 100k", 100_000), ("tree of 1M", 1_000_000)] {
        let mut group = criterion.benchmark_group(name);
        // No warm-up worth the name: each tree begins with a single seed.
        group.sampling_mode(SamplingMode::Flat).sample_size(10).warm_up_time(Duration::from_millis(1));
        each_way(|id, kind, pool| {
            group.bench_function(id, |bencher| {
                bencher.iter_with_large_drop(|| pool.install(|| grown(kind, metamers)));
            });
        });
        group.finish();
    }
}

fn last_steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("last step to 100k");
    group.sampling_mode(SamplingMode::Flat).sample_size(20).warm_up_time(Duration::from_millis(1));
    each_way(|id, kind, pool| {
        group.bench_function(id, |bencher| {
            bencher.iter_custom(|times| {
                pool.install(|| (0..times).map(|_| last_step(kind, 100_000)).sum::<Duration>())
            });
        });
    });
    group.finish();
}

criterion_group!(benches, whole_trees, last_steps);
criterion_main!(benches);
