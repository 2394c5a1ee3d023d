//! Wood from the outline inwards (§3), as rows of an ordinary plant.

use std::ops::Range;

use espalier_design::{
    Design, Edit, Envelope, Generated, Generator, Half, Held, Key, MAX_INTERNODES, Missing, NodeId, Placed,
    Value,
};
use espalier_growth::{Parameters, transplant};
use espalier_plant::{MetamerId, Plant, checks};
use glam::Vec3;
use proptest::prelude::*;

use crate::{
    lives::{picks, sapling},
    said::{constant, curved, designed, envelope, level, node, on, plain, scalar, set, vector},
};

fn grown(design: &Design) -> Generated {
    Generator::default().generate(design, MAX_INTERNODES)
}

fn planted(generated: &Generated) -> Plant {
    transplant(&generated.wood, &Parameters::default()).expect("it fits together")
}

/// How deep the end of a branch that is so much longer is inside the outline of its bearer.
fn depth_beyond(bearer: &Placed, branch: &Placed, longer: f32) -> f32 {
    let (frame, scale) = bearer.outline();
    let end = branch.base + branch.frame.y_axis * (branch.length + longer);
    let hull = bearer.values.envelope(Key::Silhouette);
    hull.depth(frame.transpose() * (end - bearer.base) / scale)
}

/// Outlines of any shape.
fn envelopes() -> impl Strategy<Value = Envelope> {
    envelopes_of(0.1..1.2, 0.25..0.75, 0.5..4.0)
}

/// Outlines without hollows.
fn round() -> impl Strategy<Value = Envelope> {
    envelopes_of(0.3..0.6, 0.45..0.55, 1.5..3.0)
}

fn envelopes_of(
    radii: Range<f32>,
    heights: Range<f32>,
    shapes: Range<f32>,
) -> impl Strategy<Value = Envelope> {
    let around = |range: Range<f32>| prop::array::uniform4(range);
    (around(radii), around(heights), shapes.clone(), shapes, -0.2f32..0.2).prop_map(
        |(radii, heights, upper, lower, aside)| Envelope {
            top: Vec3::new(aside, 1.0, -aside),
            bottom: Vec3::new(0.0, -0.2, aside),
            radii,
            heights,
            upper,
            lower,
            tip: Vec3::Y,
        },
    )
}

#[test]
fn the_wood_of_a_design_is_an_ordinary_plant() {
    let design = Design::default();
    let generated = grown(&design);
    let plant = planted(&generated);
    assert_eq!(checks::all(&plant), Ok(()));
    assert_eq!(plant.living_count() as usize, generated.wood.nodes.len() - 1);
    assert_eq!(generated.placed.len(), generated.wood.axes.len());
    let Missing { too_short, cut_away, left_out } = generated.missing;
    assert_eq!((generated.placed.len() + too_short, cut_away, left_out), (design.root().count(), 0, 0));
    // Its radii are those that the design gives.
    let row = generated.rows(NodeId::ROOT).next().expect("there is a stem");
    let first = generated.placed(NodeId::ROOT).expect("it stands").radius_at(generated.places[row as usize]);
    assert_eq!(plant.given_radius(MetamerId::new(row as usize)), Some(first));
}

#[test]
fn each_row_knows_its_branch_and_place() {
    let generated = grown(&sapling());
    for of in &generated.placed {
        let rows: Vec<_> = generated.rows(of.node).collect();
        assert!(!rows.is_empty());
        let places: Vec<_> = rows.iter().map(|&row| generated.at(row)).collect();
        assert!(places.iter().all(|at| at.is_some_and(|(node, _)| node == of.node)));
        assert!(places.is_sorted_by(|a, b| a.map(|a| a.1) < b.map(|b| b.1)));
        assert_eq!(places.last().and_then(|last| Some(last.as_ref()?.1)), Some(1.0));
    }
}

#[test]
fn a_bent_axis_ends_where_its_chord_does() {
    let design = designed(&[set(on("/"), Key::Height, scalar(30.0)), set(on("/"), Key::Axis, curved())]);
    let generated = grown(&design);
    let last = generated.rows(NodeId::ROOT).last().expect("there is a stem");
    assert!(generated.wood.nodes[last as usize].end.distance(Vec3::Y * 30.0) < 1e-3);
}

#[test]
fn chance_is_keyed_by_the_seed_and_by_the_branch() {
    let crooked = |seed| designed(&[set(on("/"), Key::Irregularity, scalar(0.5)), Edit::Seed { seed }]);
    assert_eq!(grown(&crooked(1)).wood, grown(&crooked(1)).wood);
    assert_ne!(grown(&crooked(1)).wood, grown(&crooked(2)).wood);
    assert_eq!(checks::all(&planted(&grown(&crooked(3)))), Ok(()));
}

#[test]
fn a_branch_that_was_cut_away_is_no_wood_and_one_that_was_cut_has_no_bud() {
    let design = designed(&[set(on("/1"), Key::Shown, scalar(0.0)), set(on("/2"), Key::Cut, scalar(0.5))]);
    let (whole, generated) = (grown(&Design::default()), grown(&design));
    assert!(generated.placed(node("/1")).is_none() && generated.placed(node("/1/0")).is_none());
    let cut = generated.placed.iter().position(|placed| placed.node == node("/2")).expect("it stands");
    assert!(!generated.wood.axes[cut].has_bud);
    let reach = |generated: &Generated| generated.rows(node("/2")).count() as f32;
    assert!((reach(&generated) / reach(&whole) - 0.5).abs() < 0.2);
    let gone = generated.missing.cut_away + generated.missing.too_short + generated.placed.len();
    assert!(generated.missing.cut_away > 0 && gone == design.root().count());
    // Nobody else has noticed.
    let of = |generated: &Generated, of: &str| generated.placed(node(of)).cloned();
    assert_eq!(of(&generated, "/3"), of(&whole, "/3"));
}

#[test]
fn what_draws_branches_turns_them() {
    let heading =
        |edits: &[Edit]| grown(&designed(edits)).placed(node("/2")).expect("it stands").frame.y_axis;
    let free = heading(&[]);
    let drawn = heading(&[set(level(1), Key::Pull, vector(3.0, 0.0, 0.0))]);
    assert!(drawn.x > free.x && drawn.x > 0.9, "{drawn}");
    let turned = heading(&[set(on("/2"), Key::Turn, vector(0.0, 180.0, 0.0))]);
    assert!((turned - Vec3::new(-free.x, free.y, -free.z)).length() < 1e-4, "{free} {turned}");
}

#[test]
fn a_branch_outside_the_outline_is_told() {
    let hull = Envelope { bottom: Vec3::Y * 0.6, heights: [0.8; 4], ..Envelope::default() };
    let generated = grown(&designed(&[set(on("/"), Key::Silhouette, envelope(hull))]));
    let lowest = generated.placed(node("/0")).expect("it stands");
    assert!(lowest.is_outside && (lowest.length - 2.0).abs() < 1e-6);
    assert!(!generated.placed(node("/5")).expect("it stands").is_outside);
}

#[test]
fn only_the_limb_that_changed_grows_anew() {
    let mut design = sapling();
    let mut generator = Generator::default();
    let before = generator.generate(&design, MAX_INTERNODES);
    assert_eq!(before.renewed.len(), before.limbs.len());
    design.apply(&set(on("/2"), Key::Axis, curved())).expect("it is allowed");
    let after = generator.generate(&design, MAX_INTERNODES);
    assert_eq!(after.renewed, [node("/2")]);
    for ((id, was), (_, is)) in before.limbs.iter().zip(&after.limbs).filter(|(limb, _)| limb.0 != node("/2"))
    {
        let ends = |of: &Generated, rows: &Range<u32>| {
            of.wood.nodes[rows.start as usize..rows.end as usize]
                .iter()
                .map(|row| row.end)
                .collect::<Vec<_>>()
        };
        assert_eq!(ends(&before, was), ends(&after, is), "{id}");
    }
    design.apply(&set(on("/"), Key::Height, scalar(50.0))).expect("it is allowed");
    assert_eq!(generator.generate(&design, MAX_INTERNODES).renewed.len(), after.limbs.len());
}

#[test]
fn a_budget_leaves_out_and_counts() {
    let design = Design::default();
    let whole = grown(&design).wood.nodes.len();
    for budget in [0, 1, 50, whole - 2] {
        let generated = Generator::default().generate(&design, budget);
        assert!(generated.wood.nodes.len() <= budget + 1 && generated.missing.left_out > 0);
        assert_eq!(checks::all(&planted(&generated)), Ok(()), "{budget}");
    }
}

#[test]
fn the_rows_of_a_design_are_the_same_for_ever() {
    let mut design = designed(&[
        set(on("/"), Key::Irregularity, scalar(0.4)),
        set(level(1), Key::Pull, vector(0.3, -0.2, 0.0)),
        set(on("/1"), Key::Axis, curved()),
        Edit::Seed { seed: 7 },
    ]);
    let hull = Envelope { radii: [0.5, 0.3, 0.4, 0.35], upper: 1.4, ..Envelope::default() };
    design.apply(&set(on("/"), Key::Silhouette, envelope(hull))).expect("it is allowed");
    let plant = planted(&grown(&design));
    assert_eq!(format!("{:016x}", plant.hash()), "ed27651f53057757");
}

#[test]
fn an_envelope_of_round_halves_is_an_ovoid() {
    // Above: y = 1 − (1 − 0.5)(ρ / 0.5)².
    let hull = Envelope { radii: [0.5; 4], heights: [0.5; 4], ..Envelope::default() };
    for (rho, height) in [(0.0, 1.0), (0.25, 0.875), (0.4, 0.68)] {
        let up = hull.distance(Vec3::new(rho, 0.5, 0.0), Vec3::Y).expect("it is inside");
        assert!((0.5 + up - height).abs() < 1e-3, "{rho}: {up}");
    }
    assert!((hull.distance(Vec3::Y * 0.5, Vec3::Z).expect("it is inside") - 0.5).abs() < 1e-3);
    assert_eq!(hull.distance(Vec3::X, Vec3::X), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn branches_end_on_the_outline_of_their_bearer(hull in envelopes(), upper in 20.0f32..100.0) {
        let mut edits = plain(9);
        edits.push(set(on("/"), Key::Silhouette, envelope(hull)));
        edits.push(set(on("/"), Key::BranchingAngle, constant(upper)));
        let generated = grown(&designed(&edits));
        let stem = generated.placed(NodeId::ROOT).expect("it stands");
        for limb in generated.placed.iter().filter(|placed| placed.node.order() == 1 && !placed.is_outside) {
            let (within, beyond) = (depth_beyond(stem, limb, -0.05), depth_beyond(stem, limb, 0.05));
            prop_assert!(within > 0.0 && beyond < 0.0, "{:?}: {} {}", limb.node, within, beyond);
        }
    }

    #[test]
    fn an_outline_twice_as_large_bears_branches_twice_as_long(hull in round(), scale in 1.0f32..3.0) {
        let lengths = |height: f32| {
            let mut edits = plain(7);
            edits.push(set(on("/"), Key::Silhouette, envelope(hull.clone())));
            edits.push(set(on("/"), Key::Height, scalar(height)));
            let generated = grown(&designed(&edits));
            let limbs = generated.placed.iter().filter(|placed| placed.node.order() == 1 && !placed.is_outside);
            limbs.map(|placed| (placed.node, placed.length)).collect::<Vec<_>>()
        };
        let (small, large) = (lengths(60.0), lengths(60.0 * scale));
        for (node, length) in &small {
            let found = large.iter().find(|found| found.0 == *node).map(|found| found.1);
            prop_assert!(found.is_some_and(|found| (found / length / scale - 1.0).abs() < 0.02), "{:?} {:?} {}", node, found, length);
        }
    }

    #[test]
    fn inside_is_below_the_surface_that_is_drawn(hull in envelopes(), angle in 0.0f32..core::f32::consts::TAU, share in 0.05f32..0.95) {
        for half in [Half::Upper, Half::Lower] {
            let point = hull.surface(angle, share, half);
            prop_assert!(hull.depth(point).abs() < 2e-3, "{}", hull.depth(point));
            let out = if half == Half::Upper { Vec3::Y } else { Vec3::NEG_Y };
            prop_assert!(!hull.contains(point + out * 0.01));
            prop_assert!(hull.contains(point - out * 0.01) || hull.surface(angle, share, Half::Upper).y - hull.surface(angle, share, Half::Lower).y < 0.02);
        }
        prop_assert!(hull.depth(hull.periphery(angle) * Vec3::new(1.02, 1.0, 1.02)) < 0.0);
    }

    #[test]
    fn whatever_is_designed_is_an_ordinary_plant(picks in picks(20), cut in 0.0f32..1.0) {
        let mut design = sapling();
        for pick in picks {
            let _refused = design.apply(&pick.edit(&design));
        }
        design.apply(&set(on("/"), Key::Cut, scalar(cut))).expect("it is allowed");
        let plant = planted(&grown(&design));
        prop_assert_eq!(checks::all(&plant), Ok(()));
    }
}

#[test]
fn leaves_and_colours_are_known_of_every_branch() {
    let material = espalier_design::Material { bark: [0.5; 3], leaves: [1.0, 0.5, 0.2] };
    let design = designed(&[
        set(on("/"), Key::Leaves, constant(4.0)),
        set(on("/1"), Key::Material, Held::new(Value::Material(material))),
    ]);
    let generated = grown(&design);
    let twig = generated
        .placed
        .iter()
        .find(|placed| node("/1").holds(placed.node) && placed.leafy_from == 0.0)
        .expect("it bears twigs");
    assert_eq!((twig.leaves(0.5), twig.values.material(Key::Material)), (4.0, &material));
    assert_eq!(
        generated.placed(node("/1")).map(|placed| [placed.leaves(0.5), placed.leaves(1.0)]),
        Some([0.0, 4.0])
    );
}
