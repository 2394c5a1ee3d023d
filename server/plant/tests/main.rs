//! Plants under random lives: every invariant holds after each event, and time travel is exact.

use espalier_plant::{AxisId, Internode, Plant, PlantParts, checks};
use glam::Vec3;
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Event {
    /// Buds (by a number that is folded into range) that grow one internode each, in one step.
    Grow(Vec<u16>),
    Shed(u16),
    Sow(i8, i8),
    GoTo(u16),
}

fn events() -> impl Strategy<Value = Vec<Event>> {
    let event = prop_oneof![
        6 => prop::collection::vec(any::<u16>(), 1..12).prop_map(Event::Grow),
        1 => any::<u16>().prop_map(Event::Shed),
        1 => (any::<i8>(), any::<i8>()).prop_map(|(x, z)| Event::Sow(x, z)),
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

fn living_axis(plant: &Plant, pick: u16) -> AxisId {
    let living: Vec<AxisId> =
        (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis)).collect();
    living[usize::from(pick) % living.len()]
}

fn happen(plant: &mut Plant, event: &Event) {
    match event {
        Event::Grow(picks) => {
            plant.begin_step();
            for &pick in picks {
                grow(plant, living_axis(plant, pick));
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
    }
}

proptest! {
    #[test]
    fn invariants_hold_through_any_life(events in events()) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
            prop_assert_eq!(checks::all(&plant), Ok(()));
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
    fn a_new_future_equals_a_life_without_the_old(events in events(), pick: u16) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
        }
        let mut direct = Plant::from_parts(plant.to_parts()).expect("a plant fits together");
        prop_assert_eq!(&direct, &plant);
        let grown = |plant: &mut Plant| happen(plant, &Event::Grow(vec![pick]));
        grown(&mut plant);
        let (before, after) = (plant.step() - 1, plant.hash());
        plant.go_to(before);
        grown(&mut plant);
        prop_assert_eq!(plant.hash(), after);
        grown(&mut direct);
        prop_assert_eq!(direct.hash(), after);
    }

    #[test]
    fn random_parts_are_refused_without_panic(
        now in 0u32..4,
        ends in prop::collection::vec(prop::array::uniform3(0u32..6), 0..4),
        losses in prop::collection::vec(0u32..6, 0..3),
        rows in prop::collection::vec((0u32..7, 0u32..4, 0u32..5), 0..6),
        axes in prop::collection::vec((0u32..7, 0u32..5), 0..5),
    ) {
        let none = |raw: u32| if raw == 6 { u32::MAX } else { raw };
        let parts = PlantParts {
            now,
            ends,
            losses,
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
