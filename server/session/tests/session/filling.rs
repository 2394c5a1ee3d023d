//! A brush gets what it swept, whatever its path and the plant's habit are.

use espalier_growth::species;
use espalier_proto::Action;
use espalier_session::{Document, wire_species};
use espalier_settings::ParametersPatch;
use rayon::prelude::*;

use crate::{
    following::{Followed, drawn},
    shapes,
};

/// Strokes of these radii from the tops of trunks, each by so many seeds, in documents that begin with one action.
fn check(names: &[&str], radii: &[f32], seeds: u32, begin: Option<&Action>) {
    let paths = shapes::strokes().into_iter().filter(|(name, _)| names.is_empty() || names.contains(name));
    let cases: Vec<_> = paths
        .flat_map(|(name, path)| radii.iter().map(move |&radius| (name, path.clone(), radius)))
        .flat_map(|(name, path, radius)| (1..=seeds).map(move |seed| (name, path.clone(), radius, seed)))
        .collect();
    let fails = |(name, path, radius, seed): &(&str, Vec<glam::Vec3>, f32, u32)| {
        let mut document = Document::new(*seed);
        if let Some(action) = begin {
            document.apply("finger", &action.clone().into()).expect("it can be done");
        }
        let (document, before) = drawn(document, path, *radius, 2.0);
        let followed = Followed::of(&document, before, path, *radius);
        let says = || format!("{name}, radius {radius}, seed {seed}: {followed:?}");
        (!followed.is_good(name, *radius)).then(says)
    };
    let failures: Vec<String> = cases.par_iter().filter_map(fails).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn cm6_strokes_of_all_forms_fill_what_they_swept_and_no_more() {
    check(&[], &[1.0, 1.5, 2.0, 3.0, 6.0, 12.0], 16, None);
}

#[test]
fn cm6_what_a_brush_fills_is_not_shed_while_it_lasts() {
    for (shedding, shadow) in [(0.6, None), (0.2, Some(0.5))] {
        let parameters = ParametersPatch {
            shedding_threshold: Some(shedding),
            shadow_strength: shadow,
            ..ParametersPatch::default()
        };
        check(&["line", "level"], &[3.0, 6.0], 2, Some(&Action::SetParameters { parameters }));
    }
}

#[test]
fn cm6_a_brush_fills_what_it_swept_in_any_species() {
    for slug in ["stone-pine", "scots-pine"] {
        let programme = Some(wire_species(species::find(slug).expect("it exists")).programme);
        check(&["line", "level"], &[3.0, 6.0], 2, Some(&Action::SetProgramme { programme, keep: false }));
    }
}
