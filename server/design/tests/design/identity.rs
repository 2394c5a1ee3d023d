//! Who a branch is when others come and go (§4, Figure 10).

use espalier_design::{Design, Edit, Key, NodeId, Standing};
use proptest::prelude::*;

use crate::said::{constant, curved, designed, node, on, plain, scalar, set};

fn give(design: &mut Design, laterals: u16) {
    design.apply(&set(on("/"), Key::Density, constant(laterals.into()))).expect("it is allowed");
}

fn stands(design: &Design) -> Vec<(String, f32)> {
    design.root().laterals().iter().map(|branch| (branch.id().to_string(), branch.t())).collect()
}

fn is_curved(design: &Design, of: &str) -> bool {
    design.branch(node(of)).is_some_and(|branch| *branch.values().value(Key::Axis) == curved())
}

#[test]
fn a_shaped_branch_lives_through_another_density_and_back() {
    let mut design = designed(&plain(3));
    design.apply(&set(on("/0"), Key::Axis, curved())).expect("it is allowed");
    let (before, azimuth) = (design.clone(), design.root().laterals()[0].azimuth());
    assert_eq!(stands(&design), [("/0".into(), 0.25), ("/1".into(), 0.5), ("/2".into(), 0.75)]);
    give(&mut design, 4);
    let four: Vec<_> = stands(&design).into_iter().map(|(id, t)| (id, (t * 100.0).round())).collect();
    assert_eq!(four, [("/0".into(), 20.0), ("/1".into(), 40.0), ("/3".into(), 60.0), ("/2".into(), 80.0)]);
    assert!(is_curved(&design, "/0"));
    assert_eq!(design.root().laterals()[0].azimuth(), azimuth);
    give(&mut design, 3);
    assert_eq!(design, before);
}

#[test]
fn a_branch_without_room_sleeps_and_wakes_as_it_was() {
    let mut design = designed(&plain(3));
    for of in ["/0", "/1", "/2"] {
        design.apply(&set(on(of), Key::Axis, curved())).expect("it is allowed");
    }
    let before = stands(&design);
    give(&mut design, 1);
    let asleep: Vec<NodeId> = design.asleep().collect();
    assert_eq!(asleep.len(), 2);
    assert!(asleep.iter().all(|&id| design.standing(id) == Standing::Asleep(id)));
    give(&mut design, 0);
    assert_eq!((design.asleep().count(), design.root().laterals().len()), (3, 0));
    give(&mut design, 3);
    assert_eq!(stands(&design), before);
    assert!(["/0", "/1", "/2"].into_iter().all(|of| is_curved(&design, of)));
}

#[test]
fn what_sleeps_can_be_forgotten() {
    let mut design = designed(&plain(2));
    design.apply(&set(on("/0"), Key::Axis, curved())).expect("it is allowed");
    give(&mut design, 0);
    design.apply(&Edit::Forget { node: node("/0") }).expect("it is allowed");
    assert_eq!((design.asleep().count(), design.graph().slots(NodeId::ROOT)), (0, None));
}

#[test]
fn an_anchored_branch_stands_where_it_was_put() {
    let mut design = designed(&plain(3));
    design.apply(&Edit::Anchor { node: node("/1"), at: Some(0.6) }).expect("it is allowed");
    for laterals in [3, 4, 7, 1, 3] {
        give(&mut design, laterals);
        let stands = stands(&design);
        assert!(stands.iter().any(|(id, t)| id == "/1" && *t == 0.6), "{laterals}: {stands:?}");
    }
    design.apply(&Edit::Anchor { node: node("/1"), at: None }).expect("it is allowed");
    assert_eq!(design.graph().slots(NodeId::ROOT), None);
}

#[test]
fn an_axis_of_no_higher_order_lets_its_branches_sleep() {
    let mut design = designed(&[set(on("/1/2"), Key::Axis, curved())]);
    let before = design.clone();
    design.apply(&set(on("/"), Key::Orders, scalar(1.0))).expect("it is allowed");
    assert_eq!(design.standing(node("/1/2")), Standing::Asleep(node("/1/2")));
    design.apply(&Edit::Clear { owner: on("/"), key: Key::Orders }).expect("it is allowed");
    assert_eq!(design, before);
}

proptest! {
    #[test]
    fn shaped_branches_stay_who_they_are_through_any_densities(
        first in 3u16..20,
        shaped in prop::collection::btree_set(0u16..3, 1..=3),
        changes in prop::collection::vec(3u16..22, 1..=20),
    ) {
        let mut design = designed(&plain(first));
        for &ordinal in &shaped {
            design.apply(&set(on(&format!("/{ordinal}")), Key::Axis, curved())).expect("it is allowed");
        }
        let azimuths = |design: &Design| shaped.iter().map(|ordinal| design.branch(node(&format!("/{ordinal}"))).map(|branch| branch.azimuth())).collect::<Vec<_>>();
        let before = azimuths(&design);
        for laterals in changes {
            give(&mut design, laterals);
            prop_assert_eq!(design.root().laterals().len(), usize::from(laterals));
            let keep_their_shape = shaped.iter().all(|ordinal| is_curved(&design, &format!("/{ordinal}")));
            prop_assert!(keep_their_shape);
            prop_assert_eq!(azimuths(&design), before.clone());
            prop_assert!(design.root().laterals().is_sorted_by(|a, b| a.t() < b.t()));
        }
    }
}
