//! Width constraints on random trees, and on small ones whose radii can be calculated by hand.
#![allow(clippy::disallowed_methods, reason = "the plain definition is compared within a tolerance")]

mod golden;
mod plain;

use espalier_plant::{AxisId, Girth, Internode, MetamerId, Plant, Widths, widths::in_force};
use glam::Vec3;
use plain::Plain;
use proptest::prelude::*;

const TWIG: f32 = 0.1;

#[derive(Clone, Debug)]
enum Event {
    Grow(Vec<(u16, u8)>),
    Shed(u16),
    Prune(u16),
}

fn plants() -> impl Strategy<Value = Plant> {
    let event = prop_oneof![
        6 => prop::collection::vec(any::<(u16, u8)>(), 1..16).prop_map(Event::Grow),
        1 => any::<u16>().prop_map(Event::Shed),
        1 => any::<u16>().prop_map(Event::Prune),
    ];
    prop::collection::vec(event, 1..14).prop_map(|events| {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        plant.sow(Vec3::X);
        plant.end_step();
        for event in events {
            happen(&mut plant, &event);
        }
        plant
    })
}

/// Constraints by picks of living wood; diameters from a third of a twig's to many times a trunk's.
fn wishes() -> impl Strategy<Value = Vec<(u16, f32)>> {
    prop::collection::vec((any::<u16>(), (-1.0f32..5.0).prop_map(|log| TWIG * log.exp())), 0..8)
}

fn happen(plant: &mut Plant, event: &Event) {
    plant.begin_step();
    match event {
        Event::Grow(picks) => {
            for &(pick, length) in picks {
                let buds: Vec<_> = (0..plant.axis_count())
                    .map(AxisId::new)
                    .filter(|&axis| plant.is_axis_alive(axis))
                    .collect();
                if let Some(&bud) = buds.get(usize::from(pick) % buds.len().max(1)) {
                    grow(plant, bud, 0.3 + f32::from(length) / 200.0);
                }
            }
        }
        Event::Shed(pick) => {
            let axes = (0..plant.axis_count()).map(AxisId::new);
            let laterals: Vec<_> =
                axes.filter(|&axis| plant.is_axis_alive(axis) && plant.axes().order(axis) > 0).collect();
            if let Some(&axis) = laterals.get(usize::from(*pick) % laterals.len().max(1)) {
                plant.shed(&[axis]);
            }
        }
        Event::Prune(pick) => {
            let wood = wood(plant);
            if let Some(&cut) = wood.get(usize::from(*pick) % wood.len().max(1)) {
                plant.prune(&[cut]);
            }
        }
    }
    plant.end_step();
}

fn grow(plant: &mut Plant, axis: AxisId, length: f32) -> MetamerId {
    let heading = plant.bud_direction(axis);
    let normal = heading.any_orthonormal_vector();
    let end = plant.bud_position(axis) + length * heading;
    plant.extend(axis, &Internode { end, normal, laterals: &[(heading + normal).normalize()] })
}

fn wood(plant: &Plant) -> Vec<MetamerId> {
    let rows = (0..plant.metamer_count()).map(MetamerId::new);
    rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).collect()
}

fn constraints(plant: &Plant, wishes: &[(u16, f32)]) -> Vec<(MetamerId, f32)> {
    let wood = wood(plant);
    let picks = wishes.iter().filter(|_| !wood.is_empty());
    let mut chosen: Vec<_> = picks.map(|&(pick, d)| (wood[usize::from(pick) % wood.len()], d)).collect();
    chosen.sort_by_key(|&(id, _)| id);
    chosen.dedup_by_key(|&mut (id, _)| id);
    chosen
}

/// Gives radii of these diameters.
fn with_given(mut plant: Plant, wishes: &[(u16, f32)]) -> Plant {
    let radii: Vec<_> =
        constraints(&plant, wishes).into_iter().map(|(id, diameter)| (id, Some(0.5 * diameter))).collect();
    plant.begin_edit();
    plant.give_radii(&radii).expect("living wood");
    plant.end_step();
    plant
}

proptest! {
    #[test]
    fn widths_are_what_the_definition_says(
        plant in plants(), wishes in wishes(), given in wishes(), exponent in 2.0f32..3.0,
    ) {
        let plant = with_given(plant, &given);
        let wanted = constraints(&plant, &wishes);
        let girth = Girth::new(exponent, TWIG);
        let widths = Widths::solve(&plant, &wanted, &girth);
        let plain = Plain::new(&plant, &wanted, f64::from(exponent), f64::from(TWIG));
        for id in wood(&plant) {
            let (is, should) = (2.0 * f64::from(widths.radius(id)), plain.diameter(id));
            prop_assert!((is / should - 1.0).abs() < 1e-4, "{id:?} is {is} wide, not {should}");
        }
    }

    #[test]
    fn wood_is_as_thick_as_what_it_bears(plant in plants(), wishes in wishes()) {
        let wanted = constraints(&plant, &wishes);
        let girth = Girth::new(2.5, TWIG);
        let widths = Widths::solve(&plant, &wanted, &girth);
        for id in wood(&plant) {
            let radius = widths.radius(id);
            prop_assert!(radius.is_finite() && radius >= 0.499_999 * TWIG);
            if let Some(parent) = plant.metamers().parent(id).filter(|&parent| !plant.is_seed(parent)) {
                prop_assert!(widths.radius(parent) >= radius * 0.999_999, "{id:?} is thicker than its parent");
            }
        }
    }

    #[test]
    fn constraints_hold_unless_they_cannot(plant in plants(), wishes in wishes()) {
        let wanted = constraints(&plant, &wishes);
        let girth = Girth::new(2.5, TWIG);
        let widths = Widths::solve(&plant, &wanted, &girth);
        prop_assert_eq!(widths.constraints().len(), wanted.len());
        for (width, &(id, diameter)) in widths.constraints().iter().zip(&wanted) {
            prop_assert_eq!((width.metamer, width.wanted), (id, diameter));
            prop_assert_eq!(widths.effective(id), Some(width.effective));
            prop_assert!((2.0 * widths.radius(id) / width.effective - 1.0).abs() < 1e-6);
            let above = plant.above(id);
            let thickest = widths.constraints().iter().filter(|w| w.metamer != id && above.contains(&w.metamer));
            let least = thickest.map(|w| w.effective).fold(TWIG, f32::max);
            prop_assert_eq!(width.effective, diameter.max(least));
        }
    }

    #[test]
    fn wood_beyond_constraints_stays_as_it_was(plant in plants(), wishes in wishes()) {
        let wanted = constraints(&plant, &wishes);
        let girth = Girth::new(2.5, TWIG);
        let widths = Widths::solve(&plant, &wanted, &girth);
        let is_below = |id: MetamerId, other: MetamerId| plant.above(id).contains(&other);
        for id in wood(&plant) {
            if !wanted.iter().any(|&(held, _)| is_below(id, held) || is_below(held, id)) {
                prop_assert_eq!(widths.log_radius(id), None);
                prop_assert_eq!(widths.radius(id).to_bits(), girth.radius(plant.metamers().tips(id)).to_bits());
            }
        }
    }
}

proptest! {
    #[test]
    fn widths_travel_in_time(plant in plants(), wishes in wishes(), removed: u16) {
        let mut plant = plant;
        let girth = Girth::new(2.5, TWIG);
        let wanted = constraints(&plant, &wishes);
        let gone = wanted.get(usize::from(removed) % wanted.len().max(1)).map(|&(id, _)| (id, None));
        for (id, diameter) in wanted.iter().map(|&(id, diameter)| (id, Some(diameter))).chain(gone) {
            plant.begin_edit();
            plant.set_width(id, diameter);
            plant.end_step();
        }
        let radii = |plant: &Plant| {
            let widths = Widths::of(plant, &girth);
            wood(plant).into_iter().map(|id| (id, widths.radius(id).to_bits())).collect::<Vec<_>>()
        };
        let steps: Vec<_> = (0..=plant.last_step()).map(|step| { plant.go_to(step); radii(&plant) }).collect();
        let mut left = wanted.clone();
        left.retain(|&(id, _)| gone != Some((id, None)));
        let at_last = Widths::solve(&plant, &left, &girth);
        prop_assert!(steps[steps.len() - 1].iter().all(|&(id, bits)| at_last.radius(id).to_bits() == bits));
        for step in (0..=plant.last_step()).rev() {
            plant.go_to(step);
            prop_assert_eq!(&radii(&plant), &steps[step as usize]);
        }
    }
}

/// Gives radii of these diameters to rows.
fn given(plant: Plant, diameters: &[(usize, f32)]) -> Plant {
    let mut plant = plant;
    let radii: Vec<_> =
        diameters.iter().map(|&(row, diameter)| (MetamerId::new(row), Some(0.5 * diameter))).collect();
    plant.begin_edit();
    plant.give_radii(&radii).expect("living wood");
    plant.end_step();
    plant
}

/// A trunk of so many internodes of length 1.
fn pole(internodes: usize) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    for _ in 0..internodes {
        grow(&mut plant, AxisId::new(0), 1.0);
    }
    plant.end_step();
    plant
}

/// A trunk of one internode on which the trunk and two laterals go on.
fn trident() -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    let laterals = [Vec3::X, Vec3::Z];
    plant.extend(AxisId::new(0), &Internode { end: Vec3::Y, normal: Vec3::X, laterals: &laterals });
    for axis in 0..3 {
        grow(&mut plant, AxisId::new(axis), 1.0);
    }
    plant.end_step();
    plant
}

/// Diameters under constraints on rows.
fn diameters(plant: &Plant, wanted: &[(usize, f32)]) -> Vec<f32> {
    let wanted: Vec<_> = wanted.iter().map(|&(row, diameter)| (MetamerId::new(row), diameter)).collect();
    let girth = Girth::new(2.0, TWIG);
    let widths = Widths::solve(plant, &wanted, &girth);
    wood(plant).into_iter().map(|id| 2.0 * widths.radius(id)).collect()
}

#[track_caller]
fn check(plant: &Plant, wanted: &[(usize, f32)], expected: &[f32]) {
    let is = diameters(plant, wanted);
    assert_eq!(is.len(), expected.len());
    assert!(
        is.iter().zip(expected).all(|(is, should)| (is - should).abs() < 1e-5),
        "{is:?}, not {expected:?}"
    );
}

#[test]
fn an_unbranched_limb_tapers_evenly_in_logarithms() {
    check(&pole(4), &[], &[0.1; 4]);
    // From 0.8 to a tip of 0.1 in three internodes: halved in each.
    check(&pole(4), &[(1, 0.8)], &[0.8, 0.4, 0.2, 0.1]);
    // Below the lower constraint nothing limits the trunk; between two, each internode halves.
    check(&pole(5), &[(2, 3.2), (4, 0.8)], &[3.2, 3.2, 1.6, 0.8, 0.1]);
}

#[test]
fn a_root_finds_its_exponent() {
    // Three tips: 3·0.1^n = 0.3 for n = 1, and at n = 2 the trunk has √3 of a twig.
    check(&trident(), &[], &[0.173_205, 0.1, 0.1, 0.1]);
    check(&trident(), &[(1, 0.3)], &[0.3, 0.1, 0.1, 0.1]);
    check(&trident(), &[(1, 0.15)], &[0.15, 0.1, 0.1, 0.1]);
    // One lateral of 0.2: the base follows by n = 2.
    check(&trident(), &[(3, 0.2)], &[0.244_949, 0.1, 0.2, 0.1]);
}

#[test]
fn a_given_radius_stays_and_its_bearer_follows() {
    let plant = given(trident(), &[(3, 0.2)]);
    // As under a constraint, the base follows by n = 2.
    check(&plant, &[], &[0.244_949, 0.1, 0.2, 0.1]);
    // The constraint of a person goes before, above and below.
    check(&plant, &[(3, 0.4)], &[0.424_264, 0.1, 0.4, 0.1]);
    check(&plant, &[(1, 0.4)], &[0.4, 0.1, 0.2, 0.1]);
    check(&plant, &[(1, 0.15)], &[0.2, 0.1, 0.2, 0.1]);
}

#[test]
fn what_grows_on_wood_of_a_given_radius_follows_from_its_tips() {
    let plant = given(pole(4), &[(1, 0.8), (2, 0.05)]);
    check(&plant, &[], &[0.8, 0.05, 0.1, 0.1]);
    // A constraint above is none of the bearer's concern.
    check(&plant, &[(4, 0.6)], &[0.8, 0.05, 0.6, 0.6]);
    let plant = given(trident(), &[(1, 0.4)]);
    check(&plant, &[], &[0.4, 0.1, 0.1, 0.1]);
}

#[test]
fn ghosts_of_shed_branches_keep_their_girth() {
    let mut plant = trident();
    plant.begin_step();
    plant.shed(&[AxisId::new(2)]);
    plant.end_step();
    check(&plant, &[], &[0.173_205, 0.1, 0.1]);
    // Three equal leaves, one of them a ghost, in 0.3.
    check(&plant, &[(1, 0.3)], &[0.3, 0.1, 0.1]);
    check(&plant, &[(3, 0.2)], &[0.244_949, 0.1, 0.2]);
}

#[test]
fn pruned_branches_leave_no_girth() {
    let mut plant = trident();
    plant.begin_edit();
    plant.prune(&[MetamerId::new(4)]);
    plant.end_step();
    check(&plant, &[], &[0.141_421, 0.1, 0.1]);
    check(&plant, &[(3, 0.2)], &[0.223_607, 0.1, 0.2]);
}

#[test]
fn a_stub_keeps_the_width_that_holds_it() {
    let mut plant = pole(5);
    plant.begin_edit();
    plant.set_width(MetamerId::new(2), Some(0.4));
    plant.prune(&[MetamerId::new(3)]);
    plant.end_step();
    check(&plant, &[(2, 0.4)], &[0.4, 0.4]);
    let girth = Girth::new(2.0, TWIG);
    assert!((Widths::of(&plant, &girth).radius(MetamerId::new(2)) - 0.2).abs() < 1e-6);
}

#[test]
fn thick_wood_is_borne_by_wood_as_thick() {
    // The upper constraint wins: the lower one is wider than was asked, and says so.
    check(&pole(4), &[(1, 0.2), (3, 0.5)], &[0.5, 0.5, 0.5, 0.1]);
    let mut plant = pole(4);
    plant.begin_edit();
    plant.set_width(MetamerId::new(1), Some(0.2));
    plant.set_width(MetamerId::new(3), Some(0.5));
    plant.set_width(MetamerId::new(4), Some(0.001));
    plant.end_step();
    let widths = in_force(&plant, &Girth::new(2.0, TWIG));
    let widths: Vec<_> = widths.iter().map(|w| (w.metamer.raw(), w.wanted, w.effective)).collect();
    assert_eq!(widths, [(1, 0.2, 0.5), (3, 0.5, 0.5), (4, 0.001, TWIG)]);
}

#[test]
fn nothing_exceeds_a_root_that_is_too_thin() {
    // With n = 8 three twigs make 0.1·3^(1/8) = 0.114720, and no trunk is thinner than a twig.
    for (wanted, trunk) in [(0.12, 0.12), (0.102, 0.102), (0.05, 0.1)] {
        check(&trident(), &[(1, wanted)], &[trunk, 0.1, 0.1, 0.1]);
    }
    let mut plant = pole(2);
    plant.begin_step();
    grow(&mut plant, AxisId::new(2), 1.0);
    plant.end_step();
    // The fork alone would be 0.109051 wide.
    check(&plant, &[(1, 0.105)], &[0.105, 0.105, 0.1]);
}

#[test]
fn a_trunk_too_thick_for_its_twigs_tapers() {
    let mut plant = pole(4);
    plant.begin_step();
    grow(&mut plant, AxisId::new(3), 1.0);
    plant.end_step();
    // Two twigs make 0.2 at most. What is missing, a ninefold, is spread over the three internodes to the root.
    let [low, high] = [1.0, 2.0].map(|thirds| 0.2 * libm::powf(9.0, thirds / 3.0));
    check(&plant, &[(1, 1.8)], &[1.8, high, low, 0.1, 0.1]);
}

#[test]
fn wishes_beyond_reason_stay_finite() {
    for wish in [f32::NAN, f32::INFINITY, f32::MAX, f32::MIN_POSITIVE, 0.0, -1.0] {
        for rows in [&[1][..], &[4], &[1, 2, 3, 4]] {
            let wanted: Vec<_> = rows.iter().map(|&row| (row, wish)).collect();
            assert!(diameters(&trident(), &wanted).iter().all(|d| d.is_finite() && *d >= 0.099_999));
        }
    }
}

#[test]
fn seeds_and_dead_wood_are_passed_over() {
    let mut plant = trident();
    plant.begin_step();
    plant.shed(&[AxisId::new(1)]);
    plant.end_step();
    check(&plant, &[(0, 5.0), (3, 5.0)], &[0.173_205, 0.1, 0.1]);
    let girth = Girth::new(2.0, TWIG);
    let held = [(MetamerId::new(0), 5.0), (MetamerId::new(3), 5.0)];
    assert!(Widths::solve(&plant, &held, &girth).constraints().is_empty());
}
