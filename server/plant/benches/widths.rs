//! Radii of a tree of 100,000 tips, by the tips alone and under constraints of each kind.

use criterion::{Criterion, criterion_group, criterion_main};
use espalier_plant::{AxisId, Girth, Internode, MetamerId, Plant, Widths};
use glam::Vec3;

const TIPS: u32 = 100_000;

/// A tree that grows as trees do, all around and in many steps, so that parents lie far from their children.
fn tree() -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    let mut draw = 1u32;
    let mut chance = || {
        draw = draw.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (draw >> 8) as f32 / (1 << 24) as f32
    };
    let trunk_tips = |plant: &Plant| plant.metamers().tips(MetamerId::new(0));
    while trunk_tips(&plant) < TIPS {
        plant.begin_step();
        let share = (2.0 * TIPS as f32 / plant.axis_count() as f32).min(0.5);
        for axis in (0..plant.axis_count()).map(AxisId::new) {
            if chance() < share {
                let turn = Vec3::new(chance() - 0.5, chance() - 0.3, chance() - 0.5);
                let heading = (plant.bud_direction(axis) + 0.5 * turn).normalize();
                let normal = heading.any_orthonormal_vector();
                let end = plant.bud_position(axis) + heading;
                plant.extend(axis, &Internode { end, normal, laterals: &[(heading + normal).normalize()] });
            }
        }
        plant.end_step();
    }
    plant
}

/// Living metamers at even distances by birth, and how much thicker than its tips make it each shall be.
fn every(plant: &Plant, girth: &Girth, count: usize, factor: f32) -> Vec<(MetamerId, f32)> {
    let rows = (1..plant.metamer_count()).step_by(plant.metamer_count() / count).map(MetamerId::new);
    rows.map(|id| (id, 2.0 * factor * girth.radius(plant.metamers().tips(id)))).collect()
}

fn widths(criterion: &mut Criterion) {
    let (plant, girth) = (tree(), Girth::new(2.5, 0.07));
    println!("{} metamers, {} tips", plant.living_count(), plant.metamers().tips(MetamerId::new(0)));
    let base = |factor| every(&plant, &girth, 1, factor);
    let mut group = criterion.benchmark_group("widths of 100,000 tips");
    for (name, wanted) in [
        ("without constraints", vec![]),
        ("with the trunk half as thick again", base(1.5)),
        ("with a trunk too thick for any exponent", base(30_000.0)),
        ("with a trunk too thin for any exponent", base(0.02)),
        ("with 100 constraints", every(&plant, &girth, 100, 1.2)),
        ("with 10,000 constraints", every(&plant, &girth, 10_000, 1.2)),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| Widths::solve(&plant, &wanted, &girth).radius(MetamerId::new(1)));
        });
    }
    group.finish();
}

criterion_group!(benches, widths);
criterion_main!(benches);
