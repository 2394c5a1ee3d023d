//! Plants under random lives: every invariant holds after each event, and time travel is exact.

use espalier_plant::{
    AxisId, Carried, Edit, Future, Given, GivenRadii, Internode, MetamerId, Motion, Plant, PlantParts, checks,
};
use glam::{Quat, Vec3};
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Event {
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
    /// Gives radii to some wood and what follows it, or takes them away, and lets a bud grow with one.
    Give(u16, Option<u8>),
    GoTo(u16),
}

fn events() -> impl Strategy<Value = Vec<Event>> {
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

fn happen(plant: &mut Plant, event: &Event) {
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
            plant.end_step();
        }
        Event::GoTo(step) => {
            plant.go_to(u32::from(*step) % (plant.last_step() + 1));
        }
    }
}

fn edit((kind, row): (u8, usize)) -> Edit {
    match kind {
        0 => Edit::Shed(AxisId::new(row)),
        1 => Edit::Pruned(MetamerId::new(row)),
        2 => Edit::Grafted(AxisId::new(row)),
        3 => Edit::Width(MetamerId::new(row), Some(0.5)),
        _ => {
            let (metamers, radii) = (vec![MetamerId::new(row)], GivenRadii(vec![0.5]));
            Edit::Given(Box::new(Given { metamers, radii }))
        }
    }
}

fn living(plant: &Plant) -> std::collections::BTreeMap<MetamerId, [f32; 3]> {
    let rows = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    rows.map(|id| (id, plant.metamers().end(id).to_array())).collect()
}

proptest! {
    #[test]
    fn invariants_hold_through_any_life(events in events()) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
            prop_assert_eq!(checks::all(&plant), Ok(()));
            let rows = (0..plant.metamer_count()).map(MetamerId::new);
            let living = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id));
            let axes: std::collections::BTreeSet<AxisId> = living.map(|id| plant.metamers().axis(id)).collect();
            prop_assert_eq!(plant.living_axes_count() as usize, axes.len());
        }
    }

    #[test]
    fn going_back_and_forth_is_exact(events in events()) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
        }
        plant.go_to(plant.last_step());
        let hashes: Vec<u64> = (0..=plant.last_step()).map(|step| { plant.go_to(step); plant.hash() }).collect();
        for step in (0..hashes.len()).rev() {
            let shift = plant.go_to(step as u32);
            prop_assert_eq!(plant.hash(), hashes[step]);
            prop_assert_eq!(checks::all(&plant), Ok(()));
            prop_assert!(shift.metamers_in.iter().all(|&id| plant.is_alive(id)));
        }
    }

    #[test]
    fn a_shift_tells_what_came_went_and_moved(events in events(), steps in prop::collection::vec(any::<u16>(), 1..6)) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
        }
        for step in steps {
            let before = living(&plant);
            let shift = plant.go_to(u32::from(step) % (plant.last_step() + 1));
            let after = living(&plant);
            let mut positions = before;
            for (id, was) in &shift.metamers_out {
                prop_assert_eq!(positions.remove(id), Some(was.to_array()));
            }
            for (id, was) in &shift.moved {
                prop_assert_eq!(positions.insert(*id, plant.metamers().end(*id).to_array()), Some(was.to_array()));
            }
            for &id in &shift.metamers_in {
                prop_assert_eq!(positions.insert(id, plant.metamers().end(id).to_array()), None);
            }
            prop_assert_eq!(positions, after);
        }
    }

    #[test]
    fn a_stashed_future_is_taken_up_exactly(events in events(), others in events(), step: u16) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
        }
        plant.go_to(u32::from(step) % (plant.last_step() + 1));
        let fork = plant.step();
        let first = plant.clone();
        let future = plant.stash_future();
        let parts = Future::from_parts(future.to_parts()).expect("a future fits together");
        prop_assert_eq!(parts.to_parts(), future.to_parts());
        for event in &others {
            happen(&mut plant, event);
        }
        if plant.last_step() < fork || plant.step() < fork {
            // The other life went back beyond the fork and began anew there.
            return Ok(());
        }
        plant.go_to(fork);
        let forked = plant.hash() == first.hash();
        plant.stash_future();
        if forked {
            plant.take_future(parts).expect("it is taken where it began");
            prop_assert_eq!(plant.to_parts(), first.to_parts());
            plant.go_to(plant.last_step());
            prop_assert_eq!(checks::all(&plant), Ok(()));
        }
    }

    #[test]
    fn a_new_future_equals_a_life_without_the_old(events in events(), pick: u16) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
        }
        let mut direct = Plant::from_parts(plant.to_parts()).expect("a plant fits together");
        prop_assert_eq!(&direct, &plant);
        let grown = |plant: &mut Plant| happen(plant, &Event::Grow(vec![pick]));
        let before = plant.step();
        grown(&mut plant);
        let after = plant.hash();
        plant.go_to(before);
        grown(&mut plant);
        prop_assert_eq!(plant.hash(), after);
        grown(&mut direct);
        prop_assert_eq!(direct.hash(), after);
    }

    #[test]
    fn random_parts_are_refused_without_panic(
        now in 0u32..4,
        ends in prop::collection::vec(prop::array::uniform4(0u32..6), 0..4),
        edits in prop::collection::vec((0u8..5, 0usize..6), 0..3),
        given_radii in prop::collection::vec((0u32..6, -0.1f32..1.0), 0..3),
        rows in prop::collection::vec((0u32..7, 0u32..4, 0u32..5), 0..6),
        axes in prop::collection::vec((0u32..7, 0u32..5), 0..5),
    ) {
        let none = |raw: u32| if raw == 6 { u32::MAX } else { raw };
        let parts = PlantParts {
            now,
            ends,
            edits: edits.into_iter().map(edit).collect(),
            widths: Vec::new(),
            given_radii,
            parent: rows.iter().map(|r| none(r.0)).collect(),
            axis: rows.iter().map(|r| r.1).collect(),
            death: rows.iter().map(|r| if r.2 == 4 { u32::MAX } else { r.2 }).collect(),
            end: rows.iter().enumerate().map(|(i, _)| Vec3::Y * i as f32).collect(),
            normal: vec![Vec3::X; rows.len()],
            bearer: axes.iter().map(|a| none(a.0)).collect(),
            direction: vec![Vec3::Y; axes.len()],
            axis_death: axes.iter().map(|a| if a.1 == 4 { u32::MAX } else { a.1 }).collect(),
        };
        if let Ok(plant) = Plant::from_parts(parts) {
            prop_assert_eq!(checks::all(&plant), Ok(()));
        }
    }
}
