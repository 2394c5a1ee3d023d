//! From an outline to an envelope that is grown into, through a mask of 512².

use core::f32::consts::TAU;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use espalier_growth::{Envelope, Parameters, Plane, Simulation};
use glam::{Vec2, Vec3};

const RESOLUTION: usize = 512;
/// Markers to sow: as many as a wide crown takes.
const MARKERS: usize = 10_000;

/// A closed curve of 720 points with so many lobes, `radius` internodes wide.
fn outline(lobes: f32, depth: f32, radius: f32) -> Vec<Vec2> {
    (0..720)
        .map(|i| {
            let angle = i as f32 / 720.0 * TAU;
            let (sin, cos) = libm::sincosf(angle);
            Vec2::new(cos, sin) * (radius * (1.0 + depth * libm::cosf(lobes * angle)))
        })
        .collect()
}

fn lasso(criterion: &mut Criterion) {
    let parameters = Parameters::default();
    let plane = Plane { origin: Vec3::Y * 60.0, right: Vec3::X, up: Vec3::Y };
    let inflate = |outline: &[Vec2]| {
        Envelope::inflate_at(RESOLUTION, outline, plane, 1.0, parameters.occupancy_radius)
            .expect("the outline encloses an area")
    };
    let mut group = criterion.benchmark_group("lasso of 512²");
    for (name, lobes, depth) in [("disc", 0.0, 0.0), ("star", 5.0, 0.4), ("comb", 31.0, 0.6)] {
        // All shapes have the same volume, so that they differ in shape alone.
        let trial = inflate(&outline(lobes, depth, 20.0)).volume() * f64::from(parameters.marker_density);
        let radius = 20.0 * libm::cbrt(MARKERS as f64 / trial) as f32;
        let outline = outline(lobes, depth, radius);
        let simulation = Simulation::new(1, parameters.clone());
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(
                || simulation.clone(),
                |simulation| simulation.enclose(&inflate(&outline)),
                BatchSize::LargeInput,
            );
        });
        println!("{name}: radius {radius:.1}");
    }
    group.finish();
}

criterion_group!(benches, lasso);
criterion_main!(benches);
