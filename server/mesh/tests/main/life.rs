//! Random events in the life of a plant.

use espalier_plant::{Appearance, AxisId, Internode, MetamerId, Plant};
use glam::Vec3;
use proptest::prelude::*;

#[derive(Clone, Debug)]
pub enum Event {
    /// Buds (by a number that is folded into range) that grow one internode each, in one step, and how they turn.
    Grow(Vec<(u16, i8, i8)>),
    /// Buds that grow straight up, and how many laterals they bear: another future can give the same wood to other
    /// axes.
    Stack(Vec<(u16, u8)>),
    Shed(u16),
    Sow(i8, i8),
    GoTo(u16),
    Look(u16, u8, u8),
}

pub fn events() -> impl Strategy<Value = Vec<Event>> {
    let event = prop_oneof![
        8 => prop::collection::vec(any::<(u16, i8, i8)>(), 1..20).prop_map(Event::Grow),
        4 => prop::collection::vec((any::<u16>(), 0u8..3), 1..12).prop_map(Event::Stack),
        1 => any::<u16>().prop_map(Event::Shed),
        1 => any::<(i8, i8)>().prop_map(|(x, z)| Event::Sow(x, z)),
        2 => any::<u16>().prop_map(Event::GoTo),
        2 => any::<(u16, u8, u8)>().prop_map(|(pick, light, vigor)| Event::Look(pick, light, vigor)),
    ];
    prop::collection::vec(event, 1..60)
}

pub fn happen(plant: &mut Plant, event: &Event) {
    match event {
        Event::Grow(picks) => {
            plant.begin_step();
            for &(pick, x, z) in picks {
                grow(plant, living_axis(plant, pick), x, z);
            }
            plant.end_step();
        }
        Event::Stack(picks) => {
            plant.begin_step();
            for &(pick, laterals) in picks {
                stack(plant, living_axis(plant, pick), laterals);
            }
            plant.end_step();
        }
        Event::Shed(pick) => {
            let axis = living_axis(plant, *pick);
            if plant.axes().order(axis) > 0 {
                plant.begin_step();
                plant.shed(axis);
                plant.end_step();
            }
        }
        Event::Sow(x, z) => {
            plant.begin_step();
            plant.sow(Vec3::new(f32::from(*x), 0.0, f32::from(*z)));
            plant.end_step();
        }
        Event::GoTo(step) => {
            plant.go_to(u32::from(*step) % (plant.last_step() + 1));
        }
        Event::Look(pick, light, vigor) => {
            look(plant, usize::from(*pick) % plant.metamer_count(), *light, *vigor)
        }
    }
}

pub fn look(plant: &mut Plant, row: usize, light: u8, vigor: u8) {
    plant.set_appearance(MetamerId::new(row), Appearance { light, vigor });
}

/// A seed and three upright metamers.
pub fn sapling() -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    for _ in 0..3 {
        grow(&mut plant, AxisId::new(0), 0, 0);
    }
    plant.end_step();
    plant
}

fn grow(plant: &mut Plant, axis: AxisId, x: i8, z: i8) {
    let bend = Vec3::new(f32::from(x), 0.0, f32::from(z)) / 200.0;
    let heading = (plant.bud_direction(axis) + bend).normalize_or(Vec3::Y);
    let normal = heading.any_orthonormal_vector();
    let laterals = [(heading + normal).normalize()];
    let end = plant.bud_position(axis) + heading * (1.0 + f32::from(x) / 300.0);
    plant.extend(axis, &Internode { end, normal, laterals: &laterals });
}

pub fn stack(plant: &mut Plant, axis: AxisId, laterals: u8) {
    let end = plant.bud_position(axis) + Vec3::Y;
    let laterals = vec![Vec3::X; usize::from(laterals)];
    plant.extend(axis, &Internode { end, normal: Vec3::X, laterals: &laterals });
}

fn living_axis(plant: &Plant, pick: u16) -> AxisId {
    let living: Vec<AxisId> =
        (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis)).collect();
    living[usize::from(pick) % living.len()]
}
