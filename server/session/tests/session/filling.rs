//! A brush gets what it swept, whatever its path and the plant's habit are.

use espalier_growth::species;
use espalier_proto::{Action, Steps};
use espalier_session::{Document, Principal, wire_species};
use espalier_settings::ParametersPatch;
use glam::Vec3;
use rayon::prelude::*;

use crate::{
    following::{self, Followed, Hand, drawn},
    shapes,
};

/// Radii of the brush.
const RADII: [f32; 6] = [1.0, 1.5, 2.0, 3.0, 6.0, 12.0];

/// Strokes of these radii from the tops of trunks, each by so many seeds, in documents that begin with one action.
fn check(names: &[&str], radii: &[f32], seeds: u32, hand: Hand, begin: Option<&Action>) {
    let paths = shapes::strokes().into_iter().filter(|(name, _)| names.is_empty() || names.contains(name));
    let cases: Vec<_> = paths
        .flat_map(|(name, path)| radii.iter().map(move |&radius| (name, path.clone(), radius)))
        .flat_map(|(name, path, radius)| (1..=seeds).map(move |seed| (name, path.clone(), radius, seed)))
        .collect();
    let fails = |(name, path, radius, seed): &(&str, Vec<Vec3>, f32, u32)| {
        let mut document = Document::new(*seed);
        if let Some(action) = begin {
            document.apply(&Principal::visitor(), &action.clone().into()).expect("it can be done");
        }
        let (document, before) = drawn(document, path, *radius, hand);
        let followed = Followed::of(&document, before, &hand.told(path), *radius);
        let says = || format!("{name}, radius {radius}, seed {seed}: {followed:?}");
        (!followed.is_good(name, *radius)).then(says)
    };
    let failures: Vec<String> = cases.par_iter().filter_map(fails).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn cm6_strokes_of_all_forms_fill_what_they_swept_and_no_more() {
    check(&[], &RADII, 16, Hand::SLOW, None);
}

#[test]
fn cm6_a_stroke_in_one_message_fills_what_it_swept_as_well() {
    check(&[], &RADII, 4, Hand::FAST, None);
}

#[test]
fn cm6_a_stroke_of_few_samples_fills_what_it_swept_as_well() {
    check(&[], &RADII, 4, Hand::SPARSE, None);
}

#[test]
fn cm6_what_a_brush_fills_is_not_shed_while_it_lasts() {
    for (shedding, shadow) in [(0.6, None), (0.2, Some(0.5))] {
        let parameters = ParametersPatch {
            shedding_threshold: Some(shedding),
            shadow_strength: shadow,
            ..ParametersPatch::default()
        };
        check(&["line", "level"], &[3.0, 6.0], 2, Hand::SLOW, Some(&Action::SetParameters { parameters }));
    }
}

#[test]
fn cm6_a_brush_fills_what_it_swept_however_plants_seek_the_light() {
    for phototropism in [0.5, 1.0] {
        let parameters = ParametersPatch { phototropism: Some(phototropism), ..ParametersPatch::default() };
        check(&[], &[3.0, 6.0], 2, Hand::SLOW, Some(&Action::SetParameters { parameters }));
    }
}

#[test]
fn cm6_a_brush_fills_what_it_swept_in_any_species() {
    for slug in ["stone-pine", "scots-pine"] {
        let programme = Some(wire_species(species::find(slug).expect("it exists")).programme);
        check(
            &["line", "level"],
            &[3.0, 6.0],
            2,
            Hand::SLOW,
            Some(&Action::SetProgramme { programme, keep: false }),
        );
    }
}

/// A limb drawn level from near the top of a tree of a species: where it ends.
fn limb_on(slug: &str, age: u32, seed: u32) -> (Document, Vec3) {
    let mut document = Document::new(seed);
    let programme = Some(wire_species(species::find(slug).expect("it exists")).programme);
    act(&mut document, Action::SetProgramme { programme, keep: false });
    act(&mut document, Action::Grow { steps: Steps::nearest(age), until: None, bud: None });
    let nodes = following::nodes(&document, 0);
    let top = nodes.into_iter().max_by(|a, b| a.y.total_cmp(&b.y)).expect("a trunk");
    let (from, to) = (top - Vec3::Y, top - Vec3::Y + 17.0 * Vec3::X);
    following::stroke(&mut document, 1, &[from, to], 3.0, Hand::SLOW);
    (document, to)
}

fn act(document: &mut Document, action: Action) {
    document.apply(&Principal::visitor(), &action.into()).expect("it can be done");
}

/// From a place to the nearest living node.
fn nearness(document: &Document, place: Vec3) -> f32 {
    following::nodes(document, 0).into_iter().map(|node| node.distance(place)).fold(f32::INFINITY, f32::min)
}

#[test]
fn pg6_a_species_does_not_shed_what_was_drawn() {
    for (slug, age) in [("scots-pine", 6), ("scots-pine", 16), ("stone-pine", 6)] {
        let (mut document, end) = limb_on(slug, age, 1);
        assert!(nearness(&document, end) <= 2.0, "{slug} of age {age}");
        for steps in [1, 11] {
            act(&mut document, Action::Grow { steps: Steps::nearest(steps), until: None, bud: None });
            let far = nearness(&document, end);
            assert!(far <= 2.0, "{slug} of age {age}: {far} internodes away {steps} steps later");
        }
    }
}

#[test]
fn pg6_a_threshold_set_by_hand_judges_what_was_drawn() {
    let (mut document, end) = limb_on("scots-pine", 6, 1);
    let parameters = ParametersPatch { shedding_threshold: Some(1.0), ..ParametersPatch::default() };
    act(&mut document, Action::SetParameters { parameters });
    act(&mut document, Action::Grow { steps: Steps::nearest(1), until: None, bud: None });
    assert!(nearness(&document, end) > 8.0, "{}", nearness(&document, end));
}

#[test]
fn pg6_a_step_of_a_stroke_sheds_nothing_that_stands() {
    let mut document = Document::new(1);
    let programme = Some(wire_species(species::find("scots-pine").expect("it exists")).programme);
    act(&mut document, Action::SetProgramme { programme, keep: false });
    act(&mut document, Action::Grow { steps: Steps::nearest(6), until: None, bud: None });
    let before = following::nodes(&document, 0);
    following::stroke(&mut document, 1, &[Vec3::Y * 4.0, Vec3::new(9.0, 5.0, 0.0)], 0.0, Hand::SLOW);
    let after = following::nodes(&document, 0);
    assert!(before.iter().all(|node| after.contains(node)), "{} and {}", before.len(), after.len());
    assert!(after.len() > before.len());
}

#[test]
fn pg6_what_was_drawn_is_known_after_opening_again() {
    let (mut document, end) = limb_on("scots-pine", 6, 1);
    let mut opened = Document::from_bytes(&document.to_bytes()).expect("its own bytes");
    for document in [&mut document, &mut opened] {
        act(document, Action::Grow { steps: Steps::nearest(3), until: None, bud: None });
        assert!(nearness(document, end) <= 2.0);
    }
    assert_eq!(document.plant().hash(), opened.plant().hash());
}
