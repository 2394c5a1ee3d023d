//! Random events in the life of a plant.

use espalier_plant::{AxisId, Claim, Condition, Internode, MetamerId, Motion, Plant};
use glam::{Quat, Vec3};
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
    /// Living wood, where it is cut.
    Prune(u16),
    /// Living wood, and by how much the branch that begins with it turns.
    Turn(u16, i8),
    /// A branch, and the wood onto whose node a copy of it is grafted.
    Graft(u16, u16),
    /// Wood, and how much wider than a hundredth of an internode it shall be, in logarithms; or as it likes.
    Widen(u16, Option<u8>),
    /// A branch, and radii that its wood is given, or none.
    Give(u16, Option<u8>),
    GoTo(u16),
    /// Settles which wood stands with these steps in force, and these drawn by a hand.
    Settle(u64, u64),
    Look(u16, u8, u8),
}

pub fn events() -> impl Strategy<Value = Vec<Event>> {
    let event = prop_oneof![
        8 => prop::collection::vec(any::<(u16, i8, i8)>(), 1..20).prop_map(Event::Grow),
        4 => prop::collection::vec((any::<u16>(), 0u8..3), 1..12).prop_map(Event::Stack),
        1 => any::<u16>().prop_map(Event::Shed),
        1 => any::<(i8, i8)>().prop_map(|(x, z)| Event::Sow(x, z)),
        1 => any::<u16>().prop_map(Event::Prune),
        1 => any::<(u16, i8)>().prop_map(|(pick, turn)| Event::Turn(pick, turn)),
        1 => any::<(u16, u16)>().prop_map(|(source, onto)| Event::Graft(source, onto)),
        3 => any::<(u16, Option<u8>)>().prop_map(|(pick, width)| Event::Widen(pick, width)),
        1 => any::<(u16, Option<u8>)>().prop_map(|(pick, radius)| Event::Give(pick, radius)),
        2 => any::<u16>().prop_map(Event::GoTo),
        2 => any::<(u64, u64)>().prop_map(|(force, hand)| Event::Settle(force, hand)),
        2 => any::<(u16, u8, u8)>().prop_map(|(pick, light, vigor)| Event::Look(pick, light, vigor)),
    ];
    prop::collection::vec(event, 1..60)
}

pub fn happen(plant: &mut Plant, event: &Event) {
    match event {
        Event::Grow(picks) => {
            plant.begin_step();
            for &(pick, x, z) in picks {
                if let Some(axis) = living_axis(plant, pick) {
                    grow(plant, axis, x, z);
                }
            }
            plant.end_step();
        }
        Event::Stack(picks) => {
            plant.begin_step();
            for &(pick, laterals) in picks {
                if let Some(axis) = living_axis(plant, pick) {
                    stack(plant, axis, laterals);
                }
            }
            plant.end_step();
        }
        Event::Shed(pick) => {
            if let Some(axis) = living_axis(plant, *pick).filter(|&axis| plant.axes().order(axis) > 0) {
                plant.begin_step();
                plant.shed(&[axis]);
                plant.end_step();
            }
        }
        Event::Sow(x, z) => {
            plant.begin_step();
            plant.sow(Vec3::new(f32::from(*x), 0.0, f32::from(*z)));
            plant.end_step();
        }
        Event::Prune(pick) => {
            if let Some(cut) = wood(plant, *pick) {
                plant.begin_edit();
                plant.prune(&[cut]);
                plant.end_step();
            }
        }
        Event::Turn(pick, turn) => {
            if let Some(id) = wood(plant, *pick) {
                let foot = plant.metamers().parent(id).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
                let rotation =
                    Quat::IDENTITY.slerp(Quat::from_xyzw(0.6, 0.0, 0.8, 0.0), f32::from(*turn) / 200.0);
                plant.begin_edit();
                plant.carry(&[id], &[Motion { rotation, from: foot, to: foot }]);
                plant.end_step();
            }
        }
        Event::Graft(source, onto) => {
            let (Some(source), Some(onto)) = (wood(plant, *source), wood(plant, *onto)) else { return };
            if plant.above(source).contains(&onto) || plant.metamer_count() > 600 {
                return;
            }
            let foot = plant.metamers().parent(source).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
            let rotation = Quat::from_xyzw(0.0, 0.6, 0.0, 0.8);
            plant.begin_edit();
            let motion = Motion { rotation, from: foot, to: plant.metamers().end(onto) };
            plant.graft(source, onto, &motion);
            plant.end_step();
        }
        Event::Settle(force, hand) => {
            let bit = |bits: u64, step: u32| step == 0 || bits >> (step % 64) & 1 > 0;
            let claim = |step| Claim { in_force: bit(*force, step), by_hand: bit(*hand, step) };
            let claims: Vec<Claim> = (0..=plant.step()).map(claim).collect();
            plant.stash_future();
            plant.settle(&claims.into());
            plant.go_to(plant.last_step());
        }
        Event::Widen(pick, width) => {
            if let Some(id) = wood(plant, *pick) {
                plant.begin_edit();
                plant.set_width(id, width.map(|width| 0.01 * libm::expf(f32::from(width) / 32.0)));
                plant.end_step();
            }
        }
        Event::Give(pick, radius) => {
            let Some(base) = wood(plant, *pick) else { return };
            let radius = radius.map(|radius| 0.005 * libm::expf(f32::from(radius) / 32.0));
            let radii: Vec<_> = plant.above(base).into_iter().map(|id| (id, radius)).collect();
            plant.begin_edit();
            plant.give_radii(&radii).expect("living wood");
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
    plant.set_condition(MetamerId::new(row), Condition { light, vigor });
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

/// A living bud, if there is any: a plant may have been cut down to a stump.
fn living_axis(plant: &Plant, pick: u16) -> Option<AxisId> {
    let living: Vec<AxisId> =
        (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis)).collect();
    living.get(usize::from(pick) % living.len().max(1)).copied()
}

/// A living metamer that is no seed.
fn wood(plant: &Plant, pick: u16) -> Option<MetamerId> {
    let rows = (0..plant.metamer_count()).map(MetamerId::new);
    let living: Vec<MetamerId> = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).collect();
    living.get(usize::from(pick) % living.len().max(1)).copied()
}
