//! Settling anew which wood stands: exact where time travel would do the same, and by the rule everywhere else.

use std::collections::{BTreeMap, BTreeSet};

use espalier_plant::{AxisId, Claim, Edit, Girth, MetamerId, Plant, PlantParts, Widths, checks};
use glam::Vec3;
use proptest::prelude::*;

use crate::{
    life::{Event, claims, events, happen, settle},
    rule::Rule,
};

/// What is seen of a plant, to the bit: living metamers with places, normals, tips and radii, and living buds.
#[derive(Debug, PartialEq)]
struct Seen {
    metamers: BTreeMap<MetamerId, ([u32; 6], u32, u32)>,
    buds: BTreeMap<AxisId, (MetamerId, [u32; 3])>,
    widths: Vec<(MetamerId, f32)>,
}

fn bits(v: Vec3) -> [u32; 3] {
    v.to_array().map(f32::to_bits)
}

fn seen(plant: &Plant) -> Seen {
    let girth = Girth::new(2.5, 0.1);
    let radii = Widths::of(plant, &girth);
    let metamer = |id: MetamerId| {
        let ([a, b, c], [d, e, f]) = (bits(plant.metamers().end(id)), bits(plant.metamers().normal(id)));
        (id, ([a, b, c, d, e, f], plant.metamers().tips(id), radii.radius(id).to_bits()))
    };
    let bud = |axis| (axis, (plant.bud_node(axis), bits(plant.axes().direction(axis))));
    let rows = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    let axes = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis));
    Seen {
        metamers: rows.map(metamer).collect(),
        buds: axes.map(bud).collect(),
        widths: plant.widths().collect(),
    }
}

/// A plant at the end of a life.
fn lived(events: &[Event]) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    events.iter().for_each(|event| happen(&mut plant, event));
    plant.go_to(plant.last_step());
    plant
}

/// Claims under which the steps up to one count.
fn up_to(plant: &Plant, step: u32, hand: u64) -> Vec<Claim> {
    let mut claims = claims(plant, 0, hand);
    for (claim, at) in claims.iter_mut().zip(0..) {
        claim.in_force = at <= step;
    }
    claims
}

/// A life without settling, in which places are never contested.
fn plain(events: Vec<Event>) -> Vec<Event> {
    events.into_iter().filter(|event| !matches!(event, Event::Settle(..))).collect()
}

/// Everything in every order.
fn orders(steps: &[usize]) -> Vec<Vec<usize>> {
    let Some((first, rest)) = steps.split_first() else { return vec![Vec::new()] };
    let with_first = |order: Vec<usize>| {
        (0..=order.len()).map(move |place| [&order[..place], &[*first], &order[place..]].concat())
    };
    orders(rest).into_iter().flat_map(with_first).collect()
}

proptest! {
    // Each tries up to 120 orders.
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_order_of_switching_does_not_matter(
        events in events(),
        hand: u64,
        switches in prop::collection::vec(any::<u16>(), 1..6),
    ) {
        let plant = lived(&plain(events));
        let steps = plant.step() + 1;
        let switch = |plant: &mut Plant, claims: &mut Vec<Claim>, step: usize| {
            claims[step].in_force ^= true;
            claims.resize(plant.step() as usize + 1, Claim::HAND);
            settle(plant, claims)
        };
        let steps: BTreeSet<usize> =
            switches.iter().map(|&step| usize::from(step) % steps as usize).filter(|&step| step > 0).collect();
        let steps: Vec<usize> = steps.into_iter().collect();
        let run = |steps: &[usize]| {
            let (mut plant, mut claims) = (plant.clone(), up_to(&plant, u32::MAX, hand));
            for &step in steps {
                let settled = switch(&mut plant, &mut claims, step);
                assert_eq!(settled.waiting, [], "nobody grew in the place of another");
            }
            (seen(&plant), checks::all(&plant))
        };
        let one = run(&steps);
        for order in orders(&steps) {
            prop_assert_eq!(&one, &run(&order), "{:?}", order);
        }
    }
}

proptest! {
    #[test]
    fn without_the_last_steps_a_plant_is_that_of_before(events in events(), step: u16, hand: u64) {
        let plant = lived(&plain(events));
        let step = u32::from(step) % (plant.last_step() + 1);
        let mut past = plant.clone();
        past.go_to(step);
        let mut settled = plant.clone();
        settle(&mut settled, &up_to(&plant, step, hand));
        prop_assert_eq!(checks::all(&settled), Ok(()));
        prop_assert_eq!(seen(&settled), seen(&past));
        // And all of it comes back.
        let all = up_to(&settled, u32::MAX, hand);
        settle(&mut settled, &all);
        prop_assert_eq!(checks::all(&settled), Ok(()));
        prop_assert_eq!(seen(&settled), seen(&plant));
    }

    #[test]
    fn what_counts_altogether_is_what_stands(events in events(), hand: u64) {
        let mut plant = lived(&plain(events));
        let settled = settle(&mut plant.clone(), &up_to(&plant, u32::MAX, hand));
        prop_assert!(!settled.is_recorded, "{settled:?}");
        let none = up_to(&plant, 0, hand);
        let none = settle(&mut plant, &none);
        prop_assert_eq!(none.held, []);
        let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
        prop_assert_eq!(living.collect::<Vec<_>>(), [MetamerId::new(0)]);
    }

    #[test]
    fn wood_and_buds_stand_by_the_rule(events in events(), force: u64, hand: u64) {
        let mut plant = lived(&events);
        let claims = claims(&plant, force, hand);
        let before = plant.clone();
        let rule = Rule::new(&before, &claims);
        let settled = settle(&mut plant, &claims);
        prop_assert_eq!(checks::all(&plant), Ok(()));
        let standing: BTreeSet<MetamerId> =
            (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)).collect();
        let wanted = rule.standing();
        prop_assert_eq!(&standing, &wanted);
        let buds = seen(&plant).buds.into_iter().map(|(axis, (node, _))| (axis, node));
        prop_assert_eq!(buds.collect::<BTreeMap<_, _>>(), rule.buds(&wanted));
        let alive = |id: &MetamerId| before.is_alive(*id);
        prop_assert!(settled.falls.iter().all(|id| alive(id) && !wanted.contains(id)));
        prop_assert!(settled.rises.iter().all(|id| !alive(id) && wanted.contains(id)));
        prop_assert!(settled.held.iter().all(|id| wanted.contains(id)));
        prop_assert!(settled.waiting.iter().all(|id| !wanted.contains(id)));
        // What is settled stays so.
        let mut again = claims.clone();
        again.resize(plant.step() as usize + 1, Claim::HAND);
        let more = settle(&mut plant, &again);
        prop_assert!(!more.is_recorded, "{:?}", plant.to_parts().edits.last());
    }

    #[test]
    fn drawn_wood_in_force_never_falls_by_a_switch(events in events(), hand: u64, force: u64, step: u16) {
        let mut plant = lived(&events);
        let mut claims = claims(&plant, force, hand);
        settle(&mut plant, &claims);
        claims.resize(plant.step() as usize + 1, Claim::HAND);
        let step = usize::from(step) % claims.len();
        // Bringing back may cut; taking back what grew, moved or cut never does.
        if step == 0 || !claims[step].in_force {
            return Ok(());
        }
        let held = plant.clone().settle(&claims.clone().into()).held;
        let drawn = |id: &MetamerId| claims[plant.birth(*id) as usize] == Claim::HAND && !held.contains(id);
        let alive = |id: &MetamerId| plant.is_alive(*id);
        let before: Vec<MetamerId> =
            (0..plant.metamer_count()).map(MetamerId::new).filter(alive).filter(drawn).collect();
        claims[step].in_force = false;
        let ours = |id: &MetamerId| claims[plant.birth(*id) as usize].in_force;
        let before: Vec<MetamerId> = before.into_iter().filter(ours).collect();
        let parts = plant.to_parts();
        let edits = parts.ends[step - 1][2] as usize..parts.ends[step][2] as usize;
        let moves = parts.edits[edits].iter().any(|edit| matches!(edit, Edit::Carried(_)));
        let former = seen(&plant);
        settle(&mut plant, &claims);
        let present = seen(&plant);
        for id in before {
            prop_assert!(plant.is_alive(id), "{id:?} fell");
            let (was, is) = (former.metamers[&id].0, present.metamers[&id].0);
            prop_assert!(moves || was == is, "{id:?} moved");
        }
    }

    #[test]
    fn changed_parts_are_refused_or_hold(
        events in events(),
        (force, hand) in any::<(u64, u64)>(),
        (pick, field, value) in (any::<u16>(), 0u8..8, 0u32..40),
    ) {
        let mut plant = lived(&events);
        let claims = claims(&plant, force, hand);
        settle(&mut plant, &claims);
        let mut parts = plant.to_parts();
        let own = Plant::from_parts(parts.clone());
        prop_assert_eq!(own.as_ref(), Ok(&plant));
        spoil(&mut parts, usize::from(pick), field, value);
        if let Ok(mut plant) = Plant::from_parts(parts) {
            prop_assert_eq!(checks::all(&plant), Ok(()));
            for step in (0..=plant.last_step()).rev() {
                plant.go_to(step);
            }
            plant.go_to(plant.last_step());
        }
    }
}

/// Changes one number of one settling.
fn spoil(parts: &mut PlantParts, pick: usize, field: u8, value: u32) {
    let resettled = parts.edits.iter_mut().filter_map(|edit| match edit {
        Edit::Resettled(edit) => Some(edit),
        _ => None,
    });
    let Some(edit) = resettled.last() else { return };
    fn at<T>(list: &mut [T], pick: usize) -> Option<&mut T> {
        let len = list.len().max(1);
        list.get_mut(pick % len)
    }
    let id = MetamerId::new(value as usize);
    match field {
        0 => at(&mut edit.metamers, pick).into_iter().for_each(|row| row.0 = id),
        1 => at(&mut edit.metamers, pick).into_iter().for_each(|row| row.1 = value),
        2 => at(&mut edit.axes, pick).into_iter().for_each(|row| row.0 = AxisId::new(value as usize)),
        3 => at(&mut edit.ends, pick).into_iter().for_each(|ends| ends.before = Some((id, id))),
        4 => at(&mut edit.ends, pick).into_iter().for_each(|ends| ends.after = Some((id, id))),
        5 => at(&mut edit.ends, pick).into_iter().for_each(|ends| ends.axis = AxisId::new(value as usize)),
        6 => at(&mut edit.severed, pick).into_iter().for_each(|row| *row = id),
        _ => at(&mut edit.carried.ends, pick).into_iter().for_each(|end| *end = Vec3::splat(value as f32)),
    }
}
