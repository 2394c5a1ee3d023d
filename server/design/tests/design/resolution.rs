//! Values: own, inherited, relative, shared, and kept private (§2.1, §2.2).

use espalier_design::{
    Design, Edit, From, Key, NodeId, Op, Origin, Setting, ShareId, Source, Status, Value, Visibility,
};
use proptest::prelude::*;

use crate::{
    lives::{nodes, picks, sapling},
    said::{constant, designed, level, node, number, on, relative, scalar, set, shared},
};

/// The rule as the paper has it, in plain words: walk until somebody says something.
fn by_definition(design: &Design, of: NodeId, key: Key) -> Value {
    let setting = |of: NodeId| design.graph().setting(of, key).map(|(_, setting)| setting.clone());
    let said = setting(of);
    let inherited = || {
        let Some((bearer, _)) = of.bearer() else { return key.default().get().clone() };
        let mut candidates = Vec::new();
        if said.as_ref().is_some_and(|said| said.from == From::Below) {
            let axis = design.branch(bearer).expect("a bearer stands").laterals();
            let beneath = axis.iter().map(|branch| branch.id()).take_while(|&id| id != of);
            candidates.extend(beneath.collect::<Vec<_>>().into_iter().rev());
        }
        candidates.extend(bearer.path().collect::<Vec<_>>().into_iter().rev());
        let is_public =
            |of: &NodeId| setting(*of).is_none_or(|setting| setting.visibility == Visibility::Public);
        by_definition(design, candidates.into_iter().find(is_public).expect("the root is public"), key)
    };
    match said.as_ref().map(|said| &said.source) {
        None | Some(Source::Inherited) => inherited(),
        Some(Source::Explicit(value)) => value.get().clone(),
        Some(Source::Shared(share)) => design.graph().share(*share).expect("a share").value.get().clone(),
        Some(Source::Relative(op, by)) => {
            espalier_design::combined(&espalier_design::Held::new(inherited()), *op, by, key.row().range)
                .expect("it is a number or a function")
                .get()
                .clone()
        }
    }
}

#[test]
fn without_records_all_branches_have_the_values_of_the_root() {
    let design = designed(&[set(on("/"), Key::Girth, scalar(0.4))]);
    for id in nodes(&design) {
        let branch = design.branch(id).expect("it stands");
        assert_eq!(branch.values(), design.root().values(), "{id}");
    }
    assert!(nodes(&design).len() > 200);
}

#[test]
fn editing_an_inherited_value_changes_it_and_its_inheritors_only() {
    let mut design = sapling();
    let before = design.clone();
    let done = design.apply(&set(on("/1"), Key::Girth, scalar(0.3))).expect("it is allowed");
    for id in nodes(&before) {
        let is_reached = node("/1").holds(id);
        assert_eq!(number(&design, &id.to_string(), Key::Girth) == 0.3, is_reached, "{id}");
        assert_eq!(done.reached.changed.contains(&id), is_reached, "{id}");
    }
    // The root was looked at, the limbs, and what stands on one of them.
    let (limbs, twigs) =
        (design.root().laterals().len(), design.branch(node("/1")).unwrap().laterals().len());
    assert_eq!(done.reached.visited, 1 + limbs + twigs);
}

#[test]
fn what_is_private_is_passed_by() {
    let private = |value| Edit::Set {
        owner: on("/1"),
        key: Key::Girth,
        setting: Setting::own(scalar(value)).private(),
    };
    let mut design = designed(&[set(on("/"), Key::Girth, scalar(0.4)), private(0.2)]);
    assert_eq!([number(&design, "/1", Key::Girth), number(&design, "/1/0", Key::Girth)], [0.2, 0.4]);
    design.apply(&set(on("/1"), Key::Girth, scalar(0.2))).expect("it is allowed");
    assert_eq!(number(&design, "/1/0", Key::Girth), 0.2);
    // A value that is inherited can be hidden from those above as well.
    let hidden = Setting { visibility: Visibility::Private, ..Source::Inherited.into() };
    let mut design = designed(&[
        set(on("/"), Key::Girth, scalar(0.4)),
        set(on("/1"), Key::Girth, scalar(0.2)),
        Edit::Set { owner: on("/1/0"), key: Key::Girth, setting: hidden },
    ]);
    assert_eq!(number(&design, "/1/0/0", Key::Girth), 0.2);
    design.apply(&private(0.2)).expect("it is allowed");
    assert_eq!([number(&design, "/1/0", Key::Girth), number(&design, "/1/0/0", Key::Girth)], [0.4, 0.4]);
}

#[test]
fn relative_values_follow_what_they_inherit() {
    let mut design = designed(&[
        set(on("/"), Key::Reach, scalar(0.8)),
        relative(on("/1"), Key::Reach, Op::Add, scalar(0.2)),
        relative(on("/1/0"), Key::Reach, Op::Multiply, scalar(0.5)),
        relative(on("/1/0/0"), Key::Reach, Op::Add, scalar(0.1)),
        relative(on("/1"), Key::Taper, Op::Multiply, constant(0.5)),
        relative(on("/1/0"), Key::Taper, Op::Add, constant(0.25)),
    ]);
    let reaches = |design: &Design| ["/1", "/1/0", "/1/0/0"].map(|of| number(design, of, Key::Reach));
    let near =
        |a: [f32; 3], b: [f32; 3]| assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6), "{a:?} {b:?}");
    near(reaches(&design), [1.0, 0.5, 0.6]);
    // Its own taper leads from 1 to 0.25.
    let taper = |of: &str, t: f32| design.branch(node(of)).unwrap().values().function(Key::Taper).at(t);
    near([taper("/1", 0.0), taper("/1", 0.5), taper("/1/0", 1.0)], [0.5, 0.3125, 0.375]);
    design.apply(&set(on("/"), Key::Reach, scalar(1.0))).expect("it is allowed");
    near(reaches(&design), [1.2, 0.6, 0.7]);
    // Nothing leaves its range.
    design.apply(&relative(on("/1"), Key::Reach, Op::Multiply, scalar(10.0))).expect("it is allowed");
    assert_eq!(number(&design, "/1", Key::Reach), 3.0);
}

#[test]
fn a_shared_value_is_that_of_all_members_and_of_no_one_else() {
    let mut design = sapling();
    design.apply(&shared(7, Key::Girth, scalar(0.3), &["/0", "/2"])).expect("it is allowed");
    let girths = |design: &Design| ["/0", "/1", "/2", "/2/1"].map(|of| number(design, of, Key::Girth));
    assert_eq!(girths(&design), [0.3, 0.55, 0.3, 0.3]);
    let changed = Edit::SetShared { share: ShareId(7), value: scalar(0.4) };
    let done = design.apply(&changed).expect("it is allowed");
    assert_eq!(girths(&design), [0.4, 0.55, 0.4, 0.4]);
    assert!(!done.reached.changed.contains(&node("/1")));
    // Whoever gets a value of its own leaves; the last to leave takes the share along.
    for of in ["/0", "/2"] {
        assert!(design.graph().share(ShareId(7)).is_some());
        design.apply(&set(on(of), Key::Girth, scalar(0.5))).expect("it is allowed");
    }
    assert_eq!(design.graph().shares().count(), 0);
}

#[test]
fn a_level_speaks_for_branches_that_say_nothing() {
    let design = designed(&[
        set(level(1), Key::Girth, scalar(0.3)),
        set(on("/1"), Key::Girth, scalar(0.4)),
        set(level(2), Key::Reach, scalar(0.5)),
    ]);
    let of = |key, nodes: [&str; 4]| nodes.map(|of| number(&design, of, key));
    assert_eq!(of(Key::Girth, ["/", "/0", "/1", "/1/0"]), [0.55, 0.3, 0.4, 0.4]);
    assert_eq!(of(Key::Reach, ["/", "/0", "/1/0", "/1/0/0"]), [1.0, 1.0, 0.5, 0.5]);
}

#[test]
fn values_run_up_an_axis_from_branch_to_branch() {
    let shrinking = Setting::from(Source::Relative(Op::Multiply, scalar(0.5))).from_below();
    let mut design = designed(&[Edit::Set { owner: level(1), key: Key::Reach, setting: shrinking }]);
    let of = |design: &Design, nodes: [&str; 4]| nodes.map(|of| number(design, of, Key::Reach));
    assert_eq!(of(&design, ["/0", "/1", "/2", "/2/0"]), [0.5, 0.25, 0.125, 0.125]);
    design.apply(&set(on("/1"), Key::Reach, scalar(1.0))).expect("it is allowed");
    assert_eq!(of(&design, ["/0", "/1", "/2", "/3"]), [0.5, 1.0, 0.5, 0.25]);
    // What is private is passed by on the way along an axis as well.
    let private = Setting::own(scalar(1.0)).private();
    design.apply(&Edit::Set { owner: on("/1"), key: Key::Reach, setting: private }).expect("it is allowed");
    assert_eq!(of(&design, ["/0", "/1", "/2", "/3"]), [0.5, 1.0, 0.25, 0.125]);
}

#[test]
fn a_path_strip_shows_where_a_value_comes_from() {
    let mut design = sapling();
    design
        .apply(&Edit::Batch(vec![
            set(on("/"), Key::Girth, scalar(0.5)),
            relative(on("/1"), Key::Girth, Op::Multiply, scalar(0.5)),
            shared(1, Key::Reach, scalar(0.7), &["/2"]),
        ]))
        .expect("it is allowed");
    let strip = design.path_strip(node("/1/0"), Key::Girth);
    let seen: Vec<_> = strip.iter().map(|stop| (stop.status, stop.by, stop.from)).collect();
    assert_eq!(
        seen,
        [
            (Status::Own, Some(on("/")), None),
            (Status::Relative, Some(on("/1")), Some(NodeId::ROOT)),
            (Status::Inherited, None, Some(node("/1"))),
        ]
    );
    let (way, origin) = design.provenance(node("/1/0"), Key::Girth).expect("it stands");
    assert_eq!((way, origin), (["/1/0", "/1", "/"].map(node).to_vec(), Origin::Owner(on("/"))));
    assert_eq!(
        design.provenance(node("/2/0"), Key::Reach).map(|found| found.1),
        Some(Origin::Share(ShareId(1)))
    );
    assert_eq!(design.provenance(node("/2/0"), Key::Axis).map(|found| found.1), Some(Origin::Default));
    assert_eq!(design.provenance(node("/99"), Key::Axis), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn values_are_those_of_the_definition_after_any_edits(picks in picks(24)) {
        let mut design = sapling();
        for pick in picks {
            let _refused = design.apply(&pick.edit(&design));
        }
        for id in nodes(&design) {
            let branch = design.branch(id).expect("it stands");
            for key in Key::all() {
                prop_assert_eq!(branch.values().value(key).get(), &by_definition(&design, id, key), "{} of {}", key, id);
                // The owner that is named says the value, unless somebody on the way has said it relative to that.
                let (way, origin) = design.provenance(id, key).expect("it stands");
                let is_relative = |of: &NodeId| matches!(design.stop(*of, key), Some(stop) if stop.status == Status::Relative);
                if let (Origin::Owner(owner), false) = (origin, way.iter().any(is_relative)) {
                    let said = &design.graph().record(owner).expect("it says something").settings[&key];
                    prop_assert_eq!(&said.source, &Source::Explicit(branch.values().value(key).clone()));
                }
            }
        }
    }
}

/// A level that nobody listens to changes nothing.
#[test]
fn a_level_beyond_the_last_order_reaches_nothing() {
    let mut design = sapling();
    let done = design.apply(&set(level(4), Key::Girth, scalar(0.3))).expect("it is allowed");
    assert_eq!(done.reached.changed, []);
}
