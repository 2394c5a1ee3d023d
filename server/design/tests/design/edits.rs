//! Edits are done as a whole, undone to the bit, and reach nobody else.

use espalier_design::{Design, Edit, Generator, Key, MAX_INTERNODES, ShareId};
use proptest::prelude::*;

use crate::{
    lives::{picks, sapling},
    said::{constant, curved, designed, level, node, on, scalar, set, shared, vector},
};

fn wood(design: &Design) -> espalier_plant::Wood {
    Generator::default().generate(design, MAX_INTERNODES).wood
}

#[test]
fn reverting_a_value_brings_the_very_rows_back() {
    let mut design = sapling();
    let (before, rows) = (design.clone(), wood(&design));
    design.apply(&set(on("/1"), Key::Axis, curved())).expect("it is allowed");
    assert_ne!(wood(&design), rows);
    design.apply(&Edit::Clear { owner: on("/1"), key: Key::Axis }).expect("it is allowed");
    assert_eq!(design, before);
    assert_eq!(wood(&design), rows);
}

#[test]
fn what_changes_nothing_leaves_nothing_to_undo() {
    let mut design = designed(&[set(on("/1"), Key::Reach, scalar(0.5))]);
    for edit in [
        set(on("/1"), Key::Reach, scalar(0.5)),
        Edit::Clear { owner: on("/2"), key: Key::Reach },
        Edit::Forget { node: node("/3") },
        Edit::Seed { seed: 0 },
        Edit::Batch(vec![
            set(on("/2"), Key::Reach, scalar(0.7)),
            Edit::Clear { owner: on("/2"), key: Key::Reach },
        ]),
    ] {
        let done = design.apply(&edit).expect("it is allowed");
        assert!(done.undo.is_empty(), "{edit:?}: {:?}", done.undo);
    }
}

#[test]
fn edits_of_different_branches_or_parameters_come_to_the_same_in_any_order() {
    let edits = [
        set(on("/1"), Key::Reach, scalar(0.5)),
        set(on("/2/0"), Key::Girth, scalar(0.3)),
        set(on("/1"), Key::Axis, curved()),
        set(level(2), Key::Roll, scalar(20.0)),
        shared(1, Key::Girth, scalar(0.2), &["/3", "/0"]),
    ];
    let all = designed(&edits);
    for turn in 1..edits.len() {
        let mut turned = edits.to_vec();
        turned.rotate_left(turn);
        assert_eq!(designed(&turned), all);
        turned.reverse();
        assert_eq!(designed(&turned), all);
    }
}

#[test]
fn a_batch_is_done_as_a_whole_or_not_at_all() {
    let mut design = sapling();
    let before = design.clone();
    let mut edits = vec![
        set(on("/1"), Key::Reach, scalar(0.5)),
        set(on("/"), Key::Density, constant(9.0)),
        set(on("/99"), Key::Reach, scalar(0.5)),
    ];
    let refusal = design.apply(&Edit::Batch(edits.clone())).expect_err("there is no limb 99");
    assert!(refusal.to_string().starts_with("edit 2: there is no branch /99"), "{refusal}");
    assert_eq!(design, before);
    // What an edit of a batch has made, a later one finds.
    edits[2] = set(on("/6"), Key::Reach, scalar(0.5));
    let done = design.apply(&Edit::Batch(edits)).expect("now there is a limb 6");
    design.restore(done.undo).expect("it is as it was left");
    assert_eq!(design, before);
}

#[test]
fn a_copy_says_of_one_branch_what_is_said_of_another() {
    let mut design = designed(&[
        set(on("/1"), Key::Axis, curved()),
        set(on("/1/2"), Key::Reach, scalar(0.4)),
        shared(1, Key::Girth, scalar(0.2), &["/1/3", "/2/0"]),
        Edit::Copy { from: node("/1"), to: node("/3") },
    ]);
    let of = |design: &Design, of: &str, key| design.branch(node(of)).unwrap().values().value(key).clone();
    for (from, to, key) in
        [("/1", "/3", Key::Axis), ("/1/2", "/3/2", Key::Reach), ("/1/3", "/3/3", Key::Girth)]
    {
        assert_eq!(of(&design, from, key), of(&design, to, key));
    }
    design.apply(&Edit::SetShared { share: ShareId(1), value: scalar(0.3) }).expect("it is allowed");
    assert_eq!(of(&design, "/3/3", Key::Girth), scalar(0.3));
    // On another order it has a value of its own.
    design.apply(&Edit::Copy { from: node("/1/3"), to: node("/2/0/1") }).expect("it is allowed");
    assert_eq!(of(&design, "/2/0/1", Key::Girth), scalar(0.3));
    assert_eq!(design.graph().members(ShareId(1)).count(), 3);
}

/// A limb that stands as it did, on a stem that goes there a rounding error otherwise.
#[test]
fn a_limb_that_is_kept_tells_where_its_bearer_goes_now() {
    let mut design = sapling();
    let mut generator = Generator::default();
    for edit in [
        set(level(1), Key::Orders, scalar(1.0)),
        set(on("/"), Key::Pull, vector(0.5129695, 0.4870305, -0.5129695)),
        Edit::Anchor { node: node("/0"), at: Some(0.0) },
    ] {
        design.apply(&edit).expect("it is allowed");
        let kept = generator.generate(&design, 110);
        assert_eq!(kept.placed, Generator::default().generate(&design, 110).placed);
    }
    let limb = node("/1");
    assert!(!generator.generate(&design, 110).renewed.contains(&limb), "what stays is kept");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn what_is_up_to_date_is_what_comes_from_scratch(picks in picks(30)) {
        let mut design = sapling();
        let mut generator = Generator::default();
        for pick in picks {
            let _refused = design.apply(&pick.edit(&design));
        }
        let again = generator.generate(&design, MAX_INTERNODES);
        let scratch = Generator::default().generate(&design, MAX_INTERNODES);
        prop_assert_eq!(again.wood, scratch.wood);
    }

    #[test]
    fn limbs_that_are_kept_are_those_that_would_grow(picks in picks(16), budget in 50usize..2000) {
        let mut design = sapling();
        let mut generator = Generator::default();
        for pick in picks {
            let _refused = design.apply(&pick.edit(&design));
            let kept = generator.generate(&design, budget);
            let scratch = Generator::default().generate(&design, budget);
            prop_assert!(kept.wood.nodes.len() <= budget + 1);
            prop_assert_eq!((&kept.wood, &kept.placed, kept.missing), (&scratch.wood, &scratch.placed, scratch.missing));
            prop_assert!(kept.renewed.len() <= scratch.renewed.len());
        }
    }

    #[test]
    fn undoing_and_doing_again_are_exact(picks in picks(24)) {
        let first = sapling();
        let mut design = first.clone();
        let (mut states, mut undos) = (vec![design.clone()], Vec::new());
        for pick in picks {
            let before = design.clone();
            match design.apply(&pick.edit(&design)) {
                Ok(done) => {
                    undos.push(done.undo);
                    states.push(design.clone());
                }
                Err(_) => prop_assert_eq!(&design, &before),
            }
        }
        let (mut redos, last) = (Vec::new(), design.clone());
        for undo in undos.into_iter().rev() {
            let state = states.pop();
            prop_assert_eq!(state.as_ref(), Some(&design));
            redos.push(design.restore(undo).expect("it is as it was left").undo);
        }
        prop_assert_eq!(&design, &first);
        let mut there = first;
        for redo in redos.into_iter().rev() {
            there.restore(redo).expect("it is as it was left");
        }
        prop_assert_eq!(there, last);
    }
}
