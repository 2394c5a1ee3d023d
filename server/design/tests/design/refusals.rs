//! What is refused, and that nothing of it is done.

use espalier_design::{
    Curve, Design, Edit, Envelope, Function, Key, MAX_BATCH, MAX_BRANCHES, MAX_VALUES, Name, Op, Refusal,
    Setting, ShareId, Source,
};
use glam::Vec3;

use crate::said::{
    constant, curved, designed, envelope, level, node, on, plain, relative, scalar, set, shared, span, vector,
};

/// The refusal of an edit, of which nothing was done.
fn refused(design: &Design, edit: &Edit) -> Refusal {
    let mut tried = design.clone();
    let refusal = tried.apply(edit).expect_err(&format!("{edit:?} is refused"));
    assert_eq!(&tried, design, "{edit:?}");
    refusal
}

fn private(of: &str, key: Key, value: f32) -> Edit {
    Edit::Set { owner: on(of), key, setting: Setting::own(scalar(value)).private() }
}

#[test]
fn a_branch_that_is_not_there_is_named() {
    let design = designed(&plain(3));
    for edit in [
        set(on("/3"), Key::Girth, scalar(0.5)),
        set(on("/1/0"), Key::Girth, scalar(0.5)),
        Edit::Clear { owner: on("/3"), key: Key::Girth },
        Edit::Name { node: node("/3"), name: Name::new("limb").ok() },
        Edit::Anchor { node: node("/3"), at: Some(0.5) },
        Edit::Forget { node: node("/3") },
        Edit::Copy { from: node("/0"), to: node("/3") },
        Edit::Copy { from: node("/3"), to: node("/0") },
        shared(1, Key::Girth, scalar(0.5), &["/0", "/3"]),
    ] {
        let refusal = refused(&design, &edit);
        let unknown = if edit == set(on("/1/0"), Key::Girth, scalar(0.5)) { "/1/0" } else { "/3" };
        assert_eq!(refusal, Refusal::Unknown(node(unknown)), "{edit:?}");
    }
}

#[test]
fn a_sleeping_branch_takes_no_values() {
    let mut design = designed(&plain(3));
    for of in ["/0", "/1", "/2"] {
        design.apply(&set(on(of), Key::Axis, curved())).expect("it is allowed");
    }
    design.apply(&set(on("/"), Key::Density, constant(2.0))).expect("it is allowed");
    let asleep = design.asleep().next().expect("there is room for two");
    let of = asleep.to_string();
    let refusal = refused(&design, &set(on(&of), Key::Girth, scalar(0.5)));
    assert_eq!(refusal, Refusal::Asleep(asleep));
    assert!(refusal.to_string().contains("no room"), "{refusal}");
    // Nor does what stands on it.
    let above = set(on(&format!("{of}/0")), Key::Girth, scalar(0.5));
    assert_eq!(refused(&design, &above), Refusal::Asleep(asleep));
}

#[test]
fn values_out_of_range_are_refused_where_they_stand() {
    let design = Design::default();
    let inside_out = Envelope { top: Vec3::Y * 0.2, heights: [0.3; 4], ..Envelope::default() };
    let flat = Envelope { heights: [0.5, 0.5, 1.5, 0.5], ..Envelope::default() };
    for (key, value, at, allowed) in [
        (Key::Girth, scalar(2.0), "", "0.02 to 1.5"),
        (Key::Girth, scalar(f32::NAN), "", "0.02 to 1.5"),
        (Key::Height, scalar(1e9), "", "4 to 400"),
        (Key::Whorl, scalar(1.5), "", "a whole number from 1 to 6"),
        (Key::Zone, span(0.8, 0.2), "[1]", "0.8 to 1"),
        (Key::Pull, vector(0.0, 9.0, 0.0), "[1]", "-8 to 8"),
        (Key::Density, constant(61.0), "[0][1]", "0 to 60"),
        (Key::Girth, constant(0.5), "", "a number"),
        (
            Key::Silhouette,
            envelope(Envelope { radii: [0.5, 0.5, 0.0, 0.5], ..Envelope::default() }),
            "radii[2]",
            "0.02 to 4",
        ),
        (Key::Silhouette, envelope(Envelope { upper: 9.0, ..Envelope::default() }), "upper", "0.2 to 8"),
        (
            Key::Silhouette,
            envelope(Envelope { tip: Vec3::ZERO, ..Envelope::default() }),
            "tip",
            "a place at least 0.05 from the base",
        ),
    ] {
        let Refusal::NotAllowed { fault, .. } = refused(&design, &set(on("/"), key, value)) else {
            panic!("{key}")
        };
        assert_eq!((fault.at.as_str(), fault.allowed.as_str()), (at, allowed), "{key}");
    }
    for (value, at) in [(inside_out, "heights[0]"), (flat, "heights[2]")] {
        let Refusal::NotAllowed { fault, .. } =
            refused(&design, &set(on("/1"), Key::Silhouette, envelope(value)))
        else {
            panic!("it is not allowed")
        };
        assert!(fault.at == at && fault.allowed.contains("inside out"), "{fault}");
    }
    let upside_down = Envelope { top: Vec3::ZERO, bottom: Vec3::Y, ..Envelope::default() };
    assert!(upside_down.check().is_err_and(|fault| fault.at == "top"));
    assert_eq!(
        refused(&design, &Edit::Anchor { node: node("/0"), at: Some(f32::NAN) }),
        Refusal::OffAxis("NaN".into())
    );
}

#[test]
fn functions_and_curves_without_points_cannot_be_made() {
    assert!(Function::new(&[]).is_err_and(|fault| fault.allowed == "2 to 16 points"));
    assert!(Curve::new(&[]).is_err_and(|fault| fault.allowed == "2 to 24 points"));
}

#[test]
fn the_root_inherits_nothing_and_hides_nothing() {
    let design = Design::default();
    assert_eq!(
        refused(&design, &relative(on("/"), Key::Reach, Op::Add, scalar(0.1))),
        Refusal::NothingToInherit(Key::Reach)
    );
    assert_eq!(refused(&design, &private("/", Key::Reach, 0.5)), Refusal::RootIsPublic(Key::Reach));
    let height = set(on("/1"), Key::Height, scalar(50.0));
    assert_eq!(refused(&design, &height), Refusal::OfRootOnly { owner: on("/1"), key: Key::Height });
    let height = set(level(1), Key::Height, scalar(50.0));
    assert_eq!(refused(&design, &height), Refusal::OfRootOnly { owner: level(1), key: Key::Height });
    assert_eq!(
        refused(&design, &shared(1, Key::Reach, scalar(0.5), &["/"])),
        Refusal::NothingToInherit(Key::Reach)
    );
    assert_eq!(refused(&design, &Edit::Anchor { node: node("/"), at: None }), Refusal::RootIsNoLateral);
}

#[test]
fn only_numbers_and_functions_are_relative() {
    let design = Design::default();
    assert_eq!(
        refused(&design, &relative(on("/1"), Key::Axis, Op::Add, curved())),
        Refusal::NotRelative(Key::Axis)
    );
    let refusal = refused(&design, &relative(on("/1"), Key::Reach, Op::Multiply, scalar(-1.0)));
    assert!(matches!(refusal, Refusal::NotAllowed { fault, .. } if fault.allowed == "0 to 10"));
    let refusal = refused(&design, &relative(on("/1"), Key::Reach, Op::Multiply, constant(1.0)));
    assert!(matches!(refusal, Refusal::NotAllowed { fault, .. } if fault.allowed == "a number"));
}

#[test]
fn values_are_shared_within_one_order_and_parameter() {
    let design = designed(&[shared(1, Key::Girth, scalar(0.5), &["/0"])]);
    let join = |of: &str, key, share| Edit::Set {
        owner: on(of),
        key,
        setting: Source::Shared(ShareId(share)).into(),
    };
    let not_of =
        |of: &str| Refusal::NotOfShare { node: on(of), share: ShareId(1), key: Key::Girth, order: 1 };
    assert_eq!(refused(&design, &join("/0/0", Key::Girth, 1)), not_of("/0/0"));
    assert_eq!(refused(&design, &join("/1", Key::Reach, 1)), not_of("/1"));
    assert_eq!(refused(&design, &join("/1", Key::Girth, 2)), Refusal::NoShare(ShareId(2)));
    let level = Edit::Set { owner: level(1), key: Key::Girth, setting: Source::Shared(ShareId(1)).into() };
    assert!(matches!(refused(&design, &level), Refusal::NotOfShare { .. }));
    assert_eq!(
        refused(&design, &shared(1, Key::Girth, scalar(0.5), &["/2"])),
        Refusal::ShareTaken(ShareId(1))
    );
    assert_eq!(refused(&design, &shared(2, Key::Girth, scalar(0.5), &[])), Refusal::NobodyShares);
    assert!(matches!(
        refused(&design, &shared(2, Key::Girth, scalar(0.5), &["/0", "/0/0"])),
        Refusal::NotOfShare { .. }
    ));
    let other = Edit::SetShared { share: ShareId(9), value: scalar(0.5) };
    assert_eq!(refused(&design, &other), Refusal::NoShare(ShareId(9)));
    let curve = Edit::SetShared { share: ShareId(1), value: curved() };
    assert!(matches!(refused(&design, &curve), Refusal::NotAllowed { .. }));
}

#[test]
fn a_copy_without_end_or_beyond_the_last_order_is_refused() {
    let design = designed(&[
        set(on("/"), Key::Orders, scalar(4.0)),
        set(on("/"), Key::Density, constant(3.0)),
        set(on("/1/0/0"), Key::Axis, curved()),
    ]);
    for (from, to) in [("/1", "/1"), ("/1", "/1/0"), ("/1/0", "/1"), ("/", "/1"), ("/1", "/")] {
        let (from, to) = (node(from), node(to));
        assert_eq!(refused(&design, &Edit::Copy { from, to }), Refusal::IntoItself { from, to });
    }
    let (from, to) = (node("/1"), node("/0/0/0"));
    assert_eq!(refused(&design, &Edit::Copy { from, to }), Refusal::TooHigh { from, to });
}

#[test]
fn there_is_a_limit_to_everything() {
    let design = Design::default();
    let edits = vec![Edit::Seed { seed: 1 }; MAX_BATCH + 1];
    assert_eq!(refused(&design, &Edit::Batch(edits)), Refusal::BatchTooLong { found: MAX_BATCH + 1 });
    let dense = [
        set(on("/"), Key::Orders, scalar(2.0)),
        set(on("/"), Key::Density, constant(60.0)),
        set(on("/"), Key::Orders, scalar(4.0)),
    ];
    assert!(
        matches!(refused(&design, &Edit::Batch(dense.to_vec())), Refusal::InBatch { at: 2, refusal } if *refusal == Refusal::TooManyBranches)
    );
    const { assert!(MAX_BRANCHES < 60 * 60 * 60 * 60) };
}

#[test]
fn more_values_than_may_be_are_refused() {
    let mut design =
        designed(&[set(on("/"), Key::Orders, scalar(2.0)), set(on("/"), Key::Density, constant(60.0))]);
    let keys = [Key::Reach, Key::Girth, Key::Irregularity];
    let mut nodes = Vec::new();
    design.root().walk(&mut |branch| nodes.push(branch.id()));
    let edits: Vec<_> = (nodes.iter().filter(|node| node.order() == 2))
        .flat_map(|&node| keys.map(|key| set(espalier_design::Owner::Node(node), key, scalar(0.5))))
        .take(MAX_VALUES - 2)
        .collect();
    design.apply(&Edit::Batch(edits)).expect("they are as many as may be");
    assert_eq!(design.graph().values(), MAX_VALUES);
    let one_more = set(on("/0"), Key::Reach, scalar(0.5));
    assert_eq!(refused(&design, &one_more), Refusal::TooManyValues { found: MAX_VALUES + 1 });
    // What replaces a value is none more.
    design.apply(&set(on("/"), Key::Orders, scalar(3.0))).expect_err("there would be too many branches");
    design.apply(&set(on("/"), Key::Density, constant(59.0))).expect("it is allowed");
}

#[test]
fn names_are_short_and_plain() {
    for text in ["", "a\nb", &"x".repeat(65)] {
        assert!(Name::new(text).is_err(), "{text}");
    }
    let named = Edit::Name { node: node("/1"), name: Name::new("first branch").ok() };
    let design = designed(&[named]);
    assert_eq!(
        design.graph().record(on("/1")).and_then(|record| record.name.as_ref()).map(Name::as_str),
        Some("first branch")
    );
}
