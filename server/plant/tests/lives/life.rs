//! Random lives of plants.

use espalier_plant::{
    AxisId, Carried, Claim, Internode, MetamerId, Motion, Organ, OrganKind, Plant, Settled,
};
use glam::{Quat, Vec3};
use proptest::prelude::*;

#[derive(Clone, Debug)]
pub enum Event {
    /// Buds (by a number that is folded into range) that grow one internode each, in one step.
    Grow(Vec<u16>),
    Shed(u16),
    Sow(i8, i8),
    Prune(u16),
    /// Turns a branch, and stretches the path up to some wood in it.
    Carry(u16, u16, i8),
    /// Copies a branch onto another node, and cuts the original off if the last is set.
    Graft(u16, u16, bool),
    Width(u16, Option<u8>),
    /// Scales a branch about its foot and turns it over, by whole columns.
    Place(u16, u8),
    /// Gives radii and organs to some wood and what follows it, or takes them away, and lets a bud grow with one.
    Give(u16, Option<u8>),
    GoTo(u16),
    /// Settles which wood stands with some steps in force, and some drawn by a hand.
    Settle(u64, u64),
}

pub fn events() -> impl Strategy<Value = Vec<Event>> {
    let event = prop_oneof![
        6 => prop::collection::vec(any::<u16>(), 1..12).prop_map(Event::Grow),
        1 => any::<u16>().prop_map(Event::Shed),
        1 => (any::<i8>(), any::<i8>()).prop_map(|(x, z)| Event::Sow(x, z)),
        1 => any::<u16>().prop_map(Event::Prune),
        2 => (any::<u16>(), any::<u16>(), any::<i8>()).prop_map(|(base, end, turn)| Event::Carry(base, end, turn)),
        1 => (any::<u16>(), any::<u16>(), any::<bool>()).prop_map(|(row, onto, cut)| Event::Graft(row, onto, cut)),
        1 => (any::<u16>(), any::<Option<u8>>()).prop_map(|(row, width)| Event::Width(row, width)),
        2 => (any::<u16>(), any::<u8>()).prop_map(|(row, thousandths)| Event::Place(row, thousandths)),
        1 => (any::<u16>(), any::<Option<u8>>()).prop_map(|(row, radius)| Event::Give(row, radius)),
        2 => any::<u16>().prop_map(Event::GoTo),
        2 => any::<(u64, u64)>().prop_map(|(force, hand)| Event::Settle(force, hand)),
    ];
    prop::collection::vec(event, 1..40)
}

fn grow(plant: &mut Plant, axis: AxisId) {
    let heading = plant.bud_direction(axis);
    let normal = heading.any_orthonormal_vector();
    let laterals = [(heading + normal).normalize()];
    let end = plant.bud_position(axis) + heading;
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
    let rows = (0..plant.metamer_count()).map(MetamerId::new);
    let living: Vec<MetamerId> = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).collect();
    living.get(usize::from(pick) % living.len().max(1)).copied()
}

/// The metamers from one up to another above it.
fn path(plant: &Plant, base: MetamerId, end: MetamerId) -> Vec<MetamerId> {
    let down = std::iter::successors(Some(end), |&id| plant.metamers().parent(id).filter(|&id| id >= base));
    let mut path: Vec<MetamerId> = down.collect();
    path.reverse();
    path
}

pub fn happen(plant: &mut Plant, event: &Event) {
    match event {
        Event::Grow(picks) => {
            plant.begin_step();
            for &pick in picks {
                if let Some(axis) = living_axis(plant, pick) {
                    grow(plant, axis);
                }
            }
            plant.end_step();
        }
        Event::Shed(pick) => {
            let axis = living_axis(plant, *pick).filter(|&axis| plant.axes().order(axis) > 0);
            if let Some(axis) = axis {
                plant.begin_step();
                plant.shed(&[axis]);
                plant.end_step();
            }
        }
        Event::Sow(x, z) => {
            plant.begin_edit();
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
        Event::Carry(base, end, turn) => {
            let Some(base) = wood(plant, *base) else { return };
            let above = plant.above(base);
            let path = path(plant, base, above[usize::from(*end) % above.len()]);
            let rotation =
                Quat::from_xyzw(0.0, 0.6, 0.0, 0.8).slerp(Quat::IDENTITY, f32::from(*turn) / 200.0);
            let foot = plant.metamers().parent(base).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
            let stretched = |(i, &id): (usize, &MetamerId)| {
                let from = plant.metamers().end(id);
                Motion { rotation, from, to: foot + rotation * (from - foot) + Vec3::Y * 0.25 * i as f32 }
            };
            let motions: Vec<Motion> = path.iter().enumerate().map(stretched).collect();
            plant.begin_edit();
            plant.carry(&path, &motions);
            plant.end_step();
        }
        Event::Graft(row, onto, cut) => {
            let (Some(row), Some(onto)) = (wood(plant, *row), wood(plant, *onto)) else { return };
            if plant.above(row).contains(&onto) || plant.metamer_count() > 300 {
                return;
            }
            let foot = plant.metamers().parent(row).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
            let rotation = Quat::from_xyzw(0.6, 0.0, 0.0, 0.8);
            plant.begin_edit();
            let motion = Motion { rotation, from: foot, to: plant.metamers().end(onto) };
            let tips = plant.metamers().tips(row);
            let copy = plant.graft(row, onto, &motion);
            if *cut {
                plant.prune(&[row]);
            }
            plant.end_step();
            let first = plant.axes().first(copy).expect("a graft has wood");
            assert_eq!(plant.metamers().tips(first), tips, "a copy is as thick, whatever was shed from it");
        }
        Event::Width(row, width) => {
            if let Some(id) = wood(plant, *row) {
                plant.begin_edit();
                plant.set_width(id, width.map(|width| 0.1 + f32::from(width) / 50.0));
                plant.end_step();
            }
        }
        Event::Place(row, thousandths) => {
            let Some(base) = wood(plant, *row) else { return };
            let foot = plant.metamers().parent(base).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
            let metamers = plant.above(base);
            let scale = 0.9 + f32::from(*thousandths) / 1000.0;
            let ends = metamers.iter().map(|&id| foot + scale * (plant.metamers().end(id) - foot)).collect();
            // Half a turn about each internode; every bud points the other way.
            let normals = metamers.iter().map(|&id| -plant.metamers().normal(id)).collect();
            let borne = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| {
                let bearer = plant.axes().bearer(axis);
                plant.is_standing(axis) && bearer.is_some_and(|bearer| metamers.contains(&bearer))
            });
            let axes: Vec<AxisId> = borne.collect();
            let directions = axes.iter().map(|&axis| -plant.axes().direction(axis)).collect();
            plant.begin_edit();
            let moved = plant.place(Carried { metamers: metamers.clone(), ends, normals, axes, directions });
            plant.end_step();
            assert_eq!(moved.map(|moved| moved.len()), Ok(metamers.len()));
        }
        Event::Give(row, radius) => {
            let Some(base) = wood(plant, *row) else { return };
            let radius = radius.map(|radius| 0.05 + f32::from(radius) / 100.0);
            let mut radii: Vec<_> = plant.above(base).into_iter().map(|id| (id, radius)).collect();
            plant.begin_step();
            if let Some(axis) = living_axis(plant, *row) {
                grow(plant, axis);
                radii.push((plant.axes().last(axis).expect("it has grown"), Some(0.5)));
            }
            plant.give_radii(&radii).expect("living wood");
            let leaf =
                |azimuth| Organ { kind: OrganKind::Leaf, azimuth, inclination: 90, roll: 0, length: 0 };
            let borne = |&(id, radius): &(MetamerId, Option<f32>)| {
                (id, radius.map(|_| (0..*row as u8 % 3).map(leaf).collect()))
            };
            plant.give_organs(&radii.iter().map(borne).collect::<Vec<_>>()).expect("living wood");
            plant.end_step();
        }
        Event::GoTo(step) => {
            plant.go_to(u32::from(*step) % (plant.last_step() + 1));
        }
        Event::Settle(force, hand) => {
            plant.stash_future();
            let claims = claims(plant, *force, *hand);
            settle(plant, &claims);
        }
    }
}

/// Claims to the steps of a plant: two in three are in force, and half are drawn by a hand. The seed always stands.
pub fn claims(plant: &Plant, force: u64, hand: u64) -> Vec<Claim> {
    let bits = |seed: u64, step: u32| seed.rotate_left(step * 7).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
    let claim = |step| Claim {
        in_force: step == 0 || bits(force, step) % 3 > 0,
        by_hand: step == 0 || bits(hand, step) % 2 > 0,
    };
    (0..=plant.step()).map(claim).collect()
}

/// Settles which wood stands, and goes there.
pub fn settle(plant: &mut Plant, claims: &[Claim]) -> Settled {
    let settled = plant.settle(&claims.to_vec().into());
    assert_eq!(settled.is_recorded, plant.last_step() > plant.step());
    plant.go_to(plant.last_step());
    settled
}
