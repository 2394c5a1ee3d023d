//! Plants under random lives: every invariant holds after each event, and time travel is exact.

mod life;
mod rule;
mod settling;

use espalier_plant::{
    AxisEnds, AxisId, Edit, Future, Given, MetamerId, Organs, Plant, PlantParts, Resettled, checks,
    given::GivenColumn,
};
use glam::Vec3;
use proptest::prelude::*;

use self::life::{Event, events, happen};

fn edit((kind, row): (u8, usize)) -> Edit {
    match kind {
        0 => Edit::Shed(AxisId::new(row)),
        1 => Edit::Pruned(MetamerId::new(row)),
        2 => Edit::Grafted(AxisId::new(row)),
        3 => Edit::Width(MetamerId::new(row), Some(0.5)),
        4 => {
            let id = MetamerId::new(row);
            let ends = AxisEnds { axis: AxisId::new(row), before: None, after: Some((id, id)) };
            let metamers = vec![(id, u32::MAX)];
            Edit::Resettled(Box::new(Resettled { metamers, ends: vec![ends], ..Resettled::default() }))
        }
        _ => {
            let (metamers, values) = (vec![MetamerId::new(row)], GivenColumn(vec![0.5]));
            Edit::Given(Box::new(Given { metamers, values }))
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
        edits in prop::collection::vec((0u8..6, 0usize..6), 0..3),
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
            given_organs: given_radii.iter().map(|&(row, _)| (row, Organs::from([]))).collect(),
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
