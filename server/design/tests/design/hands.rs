//! What hands do to designed wood survives the next time that wood is made; and what seals it.

use espalier_design::{
    Block, Design, Edit, Envelope, Generated, Generator, Key, MAX_INTERNODES, NodeId, Seal, Standing,
    hands::{self, Untouched},
};
use espalier_growth::{Parameters, transplant};
use espalier_plant::{AxisId, Internode, MetamerId};
use glam::{Quat, Vec3};
use proptest::prelude::*;

use crate::said::{constant, curved, designed, envelope, node, on, plain, scalar, set};

fn grown(design: &Design) -> Generated {
    Generator::default().generate(design, MAX_INTERNODES)
}

fn places(generated: &Generated, of: NodeId) -> Vec<Vec3> {
    generated.rows(of).map(|row| generated.wood.nodes[row as usize].end).collect()
}

/// The nodes of a branch, bent aside: the farther out, the farther.
fn aside(generated: &Generated, of: NodeId, by: Vec3) -> Vec<Vec3> {
    let all = places(generated, of);
    let count = all.len() as f32;
    all.iter()
        .enumerate()
        .map(|(at, &place)| place + by * ((at + 1) as f32 / count) * ((at + 1) as f32 / count))
        .collect()
}

/// How far the nodes of a branch are from a line at most.
fn off(generated: &Generated, of: NodeId, base: Vec3, line: &[Vec3]) -> f32 {
    let line: Vec<Vec3> = std::iter::once(base).chain(line.iter().copied()).collect();
    let to_line = |place: Vec3| {
        let near = |pair: &[Vec3]| {
            let way = pair[1] - pair[0];
            let t = ((place - pair[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            place.distance(pair[0] + way * t)
        };
        line.windows(2).map(near).fold(f32::INFINITY, f32::min)
    };
    places(generated, of).into_iter().map(to_line).fold(0.0, f32::max)
}

#[test]
fn a_bent_limb_keeps_its_shape_through_density_and_outline() {
    let mut design = designed(&plain(5));
    let before = grown(&design);
    let limb = node("/1");
    let wanted = aside(&before, limb, Vec3::new(0.0, 6.0, 4.0));
    design.apply(&hands::bend(&design, &before, limb, &wanted).expect("it is wood")).expect("it is allowed");
    let after = grown(&design);
    let base = after.placed(limb).expect("it stands").base;
    assert!(off(&after, limb, base, &wanted) < 0.2, "{}", off(&after, limb, base, &wanted));
    assert!(
        after
            .rows(limb)
            .last()
            .is_some_and(|row| after.wood.nodes[row as usize].end.distance(wanted[wanted.len() - 1]) < 0.2)
    );
    // Nobody else has moved.
    assert_eq!(places(&after, node("/0")), places(&before, node("/0")));
    let shape = design.branch(limb).expect("it stands").values().curve(Key::Axis).clone();
    design.apply(&set(on("/"), Key::Density, constant(7.0))).expect("it is allowed");
    let hull = Envelope { radii: [0.6; 4], ..Envelope::default() };
    design.apply(&set(on("/"), Key::Silhouette, envelope(hull))).expect("it is allowed");
    assert_eq!(design.branch(limb).expect("it stands").values().curve(Key::Axis), &shape);
    assert!(grown(&design).placed(limb).is_some());
}

#[test]
fn a_bent_stem_carries_its_limbs_along() {
    let mut design = designed(&plain(5));
    let before = grown(&design);
    let wanted = aside(&before, NodeId::ROOT, Vec3::new(12.0, -3.0, 0.0));
    design
        .apply(&hands::bend(&design, &before, NodeId::ROOT, &wanted).expect("it is wood"))
        .expect("it is allowed");
    let after = grown(&design);
    assert!(off(&after, NodeId::ROOT, Vec3::ZERO, &wanted) < 0.2);
    // The outline has stayed where it was.
    let outline = |generated: &Generated| generated.placed(NodeId::ROOT).map(|stem| stem.outline());
    let ((was, size), (is, now)) = (outline(&before).unwrap(), outline(&after).unwrap());
    assert!((size / now - 1.0).abs() < 1e-3 && was.abs_diff_eq(is, 1e-4));
    assert_ne!(places(&after, node("/4")), places(&before, node("/4")));
}

#[test]
fn a_branch_that_chance_has_bent_is_bent_from_there() {
    let mut edits = plain(5);
    edits.extend([set(on("/"), Key::Irregularity, scalar(0.4)), Edit::Seed { seed: 5 }]);
    let mut design = designed(&edits);
    let before = grown(&design);
    let limb = node("/2");
    let wanted = aside(&before, limb, Vec3::new(0.0, -5.0, 0.0));
    design.apply(&hands::bend(&design, &before, limb, &wanted).expect("it is wood")).expect("it is allowed");
    let after = grown(&design);
    let base = after.placed(limb).expect("it stands").base;
    assert!(off(&after, limb, base, &wanted) < 0.6, "{}", off(&after, limb, base, &wanted));
    assert_eq!(places(&after, node("/3")), places(&before, node("/3")));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_turned_branch_goes_where_it_was_turned(angle in -1.5f32..1.5, x in -1.0f32..1.0, y in -1.0f32..1.0, z in 0.1f32..1.0) {
        let mut design = designed(&plain(5));
        let before = grown(&design);
        let limb = node("/2");
        let by = Quat::from_axis_angle(Vec3::new(x, y, z).normalize(), angle);
        let wanted = by * before.placed(limb).unwrap().frame.y_axis;
        design.apply(&hands::turn(&design, &before, limb, by).expect("it is wood")).expect("it is allowed");
        let after = grown(&design);
        let placed = after.placed(limb).expect("it stands");
        prop_assert!(placed.frame.y_axis.distance(wanted) < 1e-3, "{} {}", placed.frame.y_axis, wanted);
        // It keeps its length where its reach can make up for the outline there.
        let reach = design.branch(limb).unwrap().values().scalar(Key::Reach);
        prop_assert!(reach >= 3.0 || (placed.length / before.placed(limb).unwrap().length - 1.0).abs() < 1e-2);
    }
}

#[test]
fn a_width_is_that_of_the_place_and_a_cut_leaves_the_rest() {
    let mut design = designed(&plain(5));
    let before = grown(&design);
    design.apply(&hands::widen(&before, node("/2"), 0.5, 0.3).expect("it is wood")).expect("it is allowed");
    design.apply(&hands::widen(&before, NodeId::ROOT, 0.0, 2.5).expect("it is wood")).expect("it is allowed");
    let after = grown(&design);
    assert!((after.placed(NodeId::ROOT).unwrap().radius_at(0.0) - 2.5).abs() < 1e-4);
    // Its share of the stem, which has become thicker as well.
    let thicker = 2.5 / before.placed(NodeId::ROOT).unwrap().radius;
    assert!((after.placed(node("/2")).unwrap().radius_at(0.5) - 0.3 * thicker).abs() < 1e-3);
    design.apply(&hands::cut(&after, node("/2"), 0.6).expect("it is wood")).expect("it is allowed");
    design.apply(&hands::cut(&after, node("/3"), 0.0).expect("it is wood")).expect("it is allowed");
    let cut = grown(&design);
    assert!(cut.placed(node("/3")).is_none());
    let kept = places(&cut, node("/2"));
    let whole = places(&after, node("/2"));
    assert!(kept.len() < whole.len() && kept.len() * 2 > whole.len());
    assert!(kept[0].distance(whole[0]) < 0.5, "what is left stands where it stood");
}

#[test]
fn what_sleeps_wakes_when_it_is_woken() {
    let mut design = designed(&plain(4));
    for of in ["/0", "/1", "/2", "/3"] {
        design.apply(&set(on(of), Key::Axis, curved())).expect("it is allowed");
    }
    design.apply(&set(on("/"), Key::Density, constant(1.0))).expect("it is allowed");
    let asleep: Vec<NodeId> = design.asleep().collect();
    assert_eq!(asleep.len(), 3);
    for id in asleep {
        let mut woken = design.clone();
        woken.apply(&hands::wake(&design, id).expect("it sleeps")).expect("it is allowed");
        assert_eq!(woken.standing(id), Standing::Awake);
    }
    let awake = design.root().laterals()[0].id();
    assert_eq!(hands::wake(&design, awake), Err(Untouched::Awake(awake)));
    design.apply(&set(on("/"), Key::Orders, scalar(0.0))).expect("it is allowed");
    assert_eq!(hands::wake(&design, awake), Err(Untouched::NoRoom(awake)));
}

#[test]
fn a_hand_that_changes_nothing_says_why() {
    let design = designed(&plain(5));
    let generated = grown(&design);
    let absent = node("/77");
    assert_eq!(hands::cut(&generated, absent, 0.5), Err(Untouched::NoWood(absent)));
    assert_eq!(hands::turn(&design, &generated, absent, Quat::IDENTITY), Err(Untouched::NoWood(absent)));
    assert!(matches!(
        hands::bend(&design, &generated, node("/1"), &[]),
        Err(Untouched::OtherNodes { found: 0, .. })
    ));
    let lost = vec![Vec3::NAN; generated.rows(node("/1")).count()];
    assert!(matches!(hands::bend(&design, &generated, node("/1"), &lost), Err(Untouched::NotAllowed { .. })));
    assert!(matches!(hands::widen(&generated, node("/1"), 0.5, f32::NAN), Err(Untouched::NotAllowed { .. })));
    let none = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    assert!(matches!(hands::turn(&design, &generated, node("/1"), none), Err(Untouched::NotAllowed { .. })));
}

#[test]
fn growth_on_top_seals_the_wood_of_a_design() {
    let mut plant =
        transplant(&grown(&Design::default()).wood, &Parameters::default()).expect("it fits together");
    let block = Block::of_present(&plant).expect("it has wood");
    assert_eq!((block.step, block.first, block.end as usize), (1, 1, plant.metamer_count()));
    assert_eq!(block.seal(&plant), Seal::Open);
    assert!(block.contains(MetamerId::new(1)) && !block.contains(MetamerId::new(0)));
    plant.begin_step();
    let tip = plant.bud_position(AxisId::new(0));
    let (heading, normal) =
        (plant.bud_direction(AxisId::new(0)), plant.metamers().normal(plant.bud_node(AxisId::new(0))));
    plant.extend(AxisId::new(0), &Internode { end: tip + heading, normal, laterals: &[] });
    plant.end_step();
    assert_eq!(block.seal(&plant), Seal::Sealed { grown: 1, steps: 1 });
    // An edit of a hand seals it as growth does.
    plant.go_to(1);
    plant.begin_edit();
    plant.prune(&[MetamerId::new(2)]);
    plant.end_step();
    assert_eq!(block.seal(&plant), Seal::Sealed { grown: 0, steps: 1 });
    plant.go_to(0);
    assert_eq!((block.seal(&plant), Block::of_present(&plant)), (Seal::Undone, None));
}
