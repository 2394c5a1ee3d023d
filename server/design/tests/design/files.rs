//! Designs as JSON, there and back; and what is refused, with its field.

use espalier_design::{Design, Edit, Key, MAX_VALUES, MOST_BYTES, Name};
use espalier_reading::Unread;
use proptest::prelude::*;

use crate::{
    lives::{picks, sapling},
    said::{constant, curved, designed, level, node, on, plain, scalar, set, shared},
};

/// The field at fault, and what is allowed there.
fn refused(text: &str) -> (String, String) {
    match Design::from_json(text) {
        Err(Unread::Refused(refusal)) => (refusal.field, refusal.allowed.unwrap_or(refusal.what)),
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn a_design_is_read_as_it_was_written() {
    let mut edits = plain(4);
    edits.extend([
        set(on("/1"), Key::Axis, curved()),
        Edit::Name { node: node("/1"), name: Name::new("the lowest limb").ok() },
        set(level(1), Key::Girth, scalar(0.1)),
        shared(3, Key::Reach, scalar(0.5), &["/0", "/2"]),
        Edit::Anchor { node: node("/3"), at: Some(0.9) },
        set(on("/"), Key::Density, constant(3.0)),
        Edit::Seed { seed: 11 },
    ]);
    let design = designed(&edits);
    let text = design.to_json();
    assert_eq!(Design::from_json(&text), Ok(design.clone()));
    assert!(text.contains(r#""girth":{"own":0.1}"#), "numbers are short: {text}");
    assert_eq!(Design::from_json(r#"{"version":1}"#), Ok(Design::default()));
}

#[test]
fn laterals_without_slots_are_those_that_their_bearer_has() {
    let text = r#"{"version":1,"nodes":{"/2":{"values":{"girth":{"own":0.25}}}}}"#;
    assert_eq!(Design::from_json(text), Ok(designed(&[set(on("/2"), Key::Girth, scalar(0.25))])));
}

#[test]
fn what_is_not_allowed_is_named_by_its_field() {
    let of = |values: &str| format!(r#"{{"version":1,"nodes":{{"/1":{{"values":{{{values}}}}}}}}}"#);
    for (text, field, allowed) in [
        ("[]".to_owned(), "", "an object"),
        ("{}".to_owned(), "version", "1"),
        (r#"{"version":2,"new":5}"#.to_owned(), "version", "1"),
        (r#"{"version":1,"new":5}"#.to_owned(), "new", "version, seed, nodes, levels, shares, laterals"),
        (r#"{"version":1,"version":1}"#.to_owned(), "version", "once"),
        (r#"{"version":1,"seed":-1}"#.to_owned(), "seed", "a whole number from 0 to 4294967295"),
        (
            r#"{"version":1,"nodes":{"7":{}}}"#.to_owned(),
            "nodes.7",
            "/, or the way to a branch, as /3 or /3/0",
        ),
        (
            r#"{"version":1,"nodes":{"/7":{"values":{"girth":{"own":0.5}}}}}"#.to_owned(),
            "nodes./7",
            "a lateral that its bearer has",
        ),
        (r#"{"version":1,"levels":{"5":{}}}"#.to_owned(), "levels.5", "1 to 4"),
        (r#"{"version":1,"levels":{"1":{"name":"limbs"}}}"#.to_owned(), "levels.1.name", "values"),
        (of(r#""girth":{"own":2}"#), "nodes./1.values.girth.own", "0.02 to 1.5"),
        (of(r#""girth":{"own":"2"}"#), "nodes./1.values.girth.own", "a number"),
        (of(r#""girth":{}"#), "nodes./1.values.girth", "one field of own, shared, add, multiply, inherited"),
        (
            of(r#""girth":{"own":1,"add":1}"#),
            "nodes./1.values.girth.add",
            "one field of own, shared, add, multiply, inherited",
        ),
        (
            of(r#""girth":{"own":1,"private":false}"#),
            "nodes./1.values.girth.private",
            "true, or no such field",
        ),
        (
            of(r#""girth":{"shared":4}"#),
            "nodes./1.values.girth.shared",
            "a number of `shares` with key girth and level 1",
        ),
        (of(r#""density":{"own":[]}"#), "nodes./1.values.density.own", "2 to 16 points"),
        (of(r#""density":{"own":[[0,1],[0.5]]}"#), "nodes./1.values.density.own[1]", "a list of 2 numbers"),
        (of(r#""density":{"own":[[0,1],[1,99]]}"#), "nodes./1.values.density.own[1][1]", "0 to 60"),
        (
            of(r#""axis":{"own":[[0,0,0],[1,0,0]]}"#),
            "nodes./1.values.axis.own[1]",
            "[0, 1, 0], where the axis ends",
        ),
        (
            of(r#""silhouette":{"own":{"top":[0,1,0]}}"#),
            "nodes./1.values.silhouette.own.bottom",
            "the fields top, bottom, radii, heights, upper, lower, tip",
        ),
        (
            of(r#""height":{"own":30}"#),
            "nodes./1.values.height.own",
            "is refused: height is a parameter of the root, not of /1",
        ),
        (
            r#"{"version":1,"shares":{"1":{"key":"girth","level":1,"value":0.5}}}"#.to_owned(),
            "shares.1",
            "at least one branch of order 1 with it",
        ),
        (
            r#"{"version":1,"shares":{"1":{"key":"girth","level":0,"value":0.5}}}"#.to_owned(),
            "shares.1.level",
            "1 to 4",
        ),
        (
            r#"{"version":1,"laterals":{"/":[{"number":1,"home":0.5},{"number":1,"home":0.5}]}}"#.to_owned(),
            "laterals./[1].number",
            "a number above that of the lateral before",
        ),
        (
            r#"{"version":1,"laterals":{"/":[{"number":1,"home":5}]}}"#.to_owned(),
            "laterals./[0].home",
            "0 to 1",
        ),
        (
            r#"{"version":1,"laterals":{"/":[{"number":1,"home":0.5,"place":3}]}}"#.to_owned(),
            "laterals./",
            "places from 0 to 0, each once",
        ),
    ] {
        assert_eq!(refused(&text), (field.to_owned(), allowed.to_owned()), "{text}");
    }
    let inside_out = of(
        r#""silhouette":{"own":{"top":[0,0.1,0],"bottom":[0,0,0],"radii":[1,1,1,1],"heights":[0.5,0.5,0.5,0.5],"upper":2,"lower":2,"tip":[0,1,0]}}"#,
    );
    let (field, allowed) = refused(&inside_out);
    assert!(
        field == "nodes./1.values.silhouette.own.heights[0]" && allowed.contains("inside out"),
        "{field} {allowed}"
    );
    assert!(matches!(Design::from_json("{"), Err(Unread::NotJson { line: 1, .. })));
}

#[test]
fn a_hundred_thousand_values_are_refused() {
    let record = |at: u32| {
        let (limb, twig) = (at % 300, at / 300);
        format!(r#""/{limb}/{twig}":{{"values":{{"reach":{{"own":1}}}}}}"#)
    };
    let nodes = (0..100_000).map(record).collect::<Vec<_>>().join(",");
    let text = format!(r#"{{"version":1,"nodes":{{{nodes}}}}}"#);
    assert_eq!(refused(&text), ("nodes".into(), format!("{MAX_VALUES} at most")));
    assert_eq!(refused(&" ".repeat(MOST_BYTES + 1)).1, format!("{MOST_BYTES} at most"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn any_design_is_read_as_it_was_written(picks in picks(24)) {
        let mut design = sapling();
        for pick in picks {
            let _refused = design.apply(&pick.edit(&design));
        }
        let text = design.to_json();
        let read = Design::from_json(&text).expect("it was written");
        prop_assert_eq!(&read, &design, "{}", text);
        prop_assert_eq!(read.to_json(), text);
    }

    #[test]
    fn no_text_makes_it_panic(cut in any::<prop::sample::Index>(), byte in any::<u8>(), picks in picks(8)) {
        let mut design = sapling();
        for pick in picks {
            let _refused = design.apply(&pick.edit(&design));
        }
        let mut bytes = design.to_json().into_bytes();
        let at = cut.index(bytes.len());
        bytes[at] = byte;
        if let Ok(text) = String::from_utf8(bytes) {
            let _read = Design::from_json(&text);
        }
    }
}
