//! Small plants.

use espalier_plant::{AxisId, Internode, MetamerId, Plant};
use glam::Vec3;
use proptest::prelude::*;

/// Steps of buds (by a number that is folded into range) that grow, with the bud of a branch to shed after it.
pub type Growth = Vec<(Vec<(u16, i8, i8)>, Option<u16>)>;

pub fn growth() -> impl Strategy<Value = Growth> {
    let buds = prop::collection::vec(any::<(u16, i8, i8)>(), 1..12);
    prop::collection::vec((buds, prop::option::weighted(0.2, any::<u16>())), 0..20)
}

pub fn grown(growth: &Growth) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    for (buds, shed) in growth {
        plant.begin_step();
        for &(pick, x, z) in buds {
            let axis = living_axis(&plant, pick);
            let bend = Vec3::new(f32::from(x), 0.0, f32::from(z)) / 200.0;
            let heading = (plant.bud_direction(axis) + bend).normalize_or(Vec3::Y);
            extend(&mut plant, axis, heading, 1.0);
        }
        let branch = shed.map(|pick| living_axis(&plant, pick)).filter(|&axis| plant.axes().order(axis) > 0);
        if let Some(axis) = branch {
            plant.shed(axis);
        }
        plant.end_step();
    }
    plant
}

/// A trunk of so many internodes.
pub fn pole(internodes: u32) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    for _ in 0..internodes {
        extend(&mut plant, AxisId::new(0), Vec3::Y, 1.0);
    }
    plant.end_step();
    plant
}

/// Two metamers upright, and two branches half as long at the first node, of which the older is shed.
pub fn fork() -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    let trunk = AxisId::new(0);
    plant.begin_step();
    let laterals = [Vec3::X, Vec3::Z];
    plant.extend(trunk, &Internode { end: Vec3::Y, normal: Vec3::X, laterals: &laterals });
    plant.extend(trunk, &Internode { end: 2.0 * Vec3::Y, normal: Vec3::X, laterals: &[] });
    extend(&mut plant, AxisId::new(1), Vec3::X, 0.5);
    plant.end_step();
    plant.begin_step();
    plant.shed(AxisId::new(1));
    extend(&mut plant, AxisId::new(2), Vec3::Z, 0.5);
    plant.end_step();
    plant
}

pub fn living(plant: &Plant) -> Vec<MetamerId> {
    (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)).collect()
}

fn extend(plant: &mut Plant, axis: AxisId, heading: Vec3, length: f32) {
    let normal = heading.any_orthonormal_vector();
    let laterals = [(heading + normal).normalize()];
    let end = plant.bud_position(axis) + heading * length;
    plant.extend(axis, &Internode { end, normal, laterals: &laterals });
}

fn living_axis(plant: &Plant, pick: u16) -> AxisId {
    let living: Vec<AxisId> =
        (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis)).collect();
    living[usize::from(pick) % living.len()]
}
