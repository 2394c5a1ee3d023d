//! Small plants.

use espalier_plant::{AxisId, Claim, Internode, MetamerId, Plant};
use glam::Vec3;
use proptest::prelude::*;

/// What is done to a plant after a step of growth; wood is picked by a number that is folded into range.
#[derive(Clone, Copy, Debug)]
pub enum Edit {
    Shed(u16),
    Prune(u16),
    /// Eighths of an internode across.
    Widen(u16, u8),
    /// Eighths of an internode that a branch is given as its radii.
    Give(u16, u8),
    /// Settles which wood stands with these steps in force, and these drawn by a hand.
    Settle(u64, u64),
}

/// Steps of buds (by a number that is folded into range) that grow, with what is done after it.
pub type Growth = Vec<(Vec<(u16, i8, i8)>, Option<Edit>)>;

pub fn growth() -> impl Strategy<Value = Growth> {
    let buds = prop::collection::vec(any::<(u16, i8, i8)>(), 1..12);
    let edit = prop_oneof![
        any::<u16>().prop_map(Edit::Shed),
        any::<u16>().prop_map(Edit::Prune),
        (any::<u16>(), 1u8..).prop_map(|(pick, eighths)| Edit::Widen(pick, eighths)),
        (any::<u16>(), 1u8..).prop_map(|(pick, eighths)| Edit::Give(pick, eighths)),
        any::<(u64, u64)>().prop_map(|(force, hand)| Edit::Settle(force, hand)),
    ];
    prop::collection::vec((buds, prop::option::weighted(0.4, edit)), 0..20)
}

pub fn grown(growth: &Growth) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    for (buds, edit) in growth {
        plant.begin_step();
        for &(pick, x, z) in buds {
            let Some(axis) = living_axis(&plant, pick) else { continue };
            let bend = Vec3::new(f32::from(x), 0.0, f32::from(z)) / 200.0;
            let heading = (plant.bud_direction(axis) + bend).normalize_or(Vec3::Y);
            extend(&mut plant, axis, heading, 1.0);
        }
        plant.end_step();
        match edit {
            None => {}
            Some(Edit::Settle(force, hand)) => settle(&mut plant, *force, *hand),
            Some(edit) => {
                plant.begin_edit();
                happen(&mut plant, *edit);
                plant.end_step();
            }
        }
    }
    plant
}

fn settle(plant: &mut Plant, force: u64, hand: u64) {
    let bit = |bits: u64, step: u32| step == 0 || bits >> (step % 64) & 1 > 0;
    let claim = |step| Claim { in_force: bit(force, step), by_hand: bit(hand, step) };
    let claims: Vec<Claim> = (0..=plant.step()).map(claim).collect();
    plant.settle(&claims.into());
    plant.go_to(plant.last_step());
}

fn happen(plant: &mut Plant, edit: Edit) {
    match edit {
        // It is a step of its own.
        Edit::Settle(..) => {}
        Edit::Shed(pick) => {
            if let Some(axis) = living_axis(plant, pick).filter(|&axis| plant.axes().order(axis) > 0) {
                plant.shed(&[axis]);
            }
        }
        Edit::Prune(pick) => {
            if let Some(cut) = wood(plant, pick) {
                plant.prune(&[cut]);
            }
        }
        Edit::Give(pick, eighths) => {
            let Some(base) = wood(plant, pick) else { return };
            let radius = Some(f32::from(eighths) / 8.0);
            let radii: Vec<_> = plant.above(base).into_iter().map(|id| (id, radius)).collect();
            plant.give_radii(&radii).expect("living wood");
        }
        Edit::Widen(pick, eighths) => {
            if let Some(id) = wood(plant, pick) {
                plant.set_width(id, Some(f32::from(eighths) / 8.0));
            }
        }
    }
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
    plant.shed(&[AxisId::new(1)]);
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

/// A living bud, if there is any: a plant may have been cut down to a stump.
fn living_axis(plant: &Plant, pick: u16) -> Option<AxisId> {
    let living: Vec<AxisId> =
        (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis)).collect();
    living.get(usize::from(pick) % living.len().max(1)).copied()
}

/// A living metamer that is no seed.
fn wood(plant: &Plant, pick: u16) -> Option<MetamerId> {
    let mut living = living(plant);
    living.retain(|&id| !plant.is_seed(id));
    living.get(usize::from(pick) % living.len().max(1)).copied()
}
