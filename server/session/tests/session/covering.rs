//! A lasso gets what was drawn: the tree, its leaves included, covers the outline and little beside it.

use espalier_growth::species;
use espalier_proto::Action;
use espalier_session::{Document, Principal, wire_species};
use glam::Vec2;
use rayon::prelude::*;

use crate::{
    overlaps::{Overlaps, enclose, enclosed},
    shapes,
};

const SEEDS: u32 = 16;
/// Heights of the outlines, and the overlap with leaves that seedlings reach on average. Leaves of one internode stick out of
/// what is narrow: two outlines have bounds of their own at the lower height.
const HEIGHTS: [(f32, f32); 2] = [(36.0, 0.88), (20.0, 0.82)];
const NARROW: [(&str, f32, f32); 2] = [("bar", 20.0, 0.765), ("thin ring", 20.0, 0.805)];

/// No seed has less than this.
const WORST: f32 = 0.7;

/// A species that sheds strongly while it is young keeps what a lasso calls for.
#[test]
fn la1_seedlings_of_every_species_fill_an_outline() {
    let circle: Vec<Vec2> = (0..48)
        .map(|i| Vec2::from_angle(i as f32 / 48.0 * std::f32::consts::TAU) * 12.0 + 14.0 * Vec2::Y)
        .collect();
    let cases: Vec<_> =
        species::all().iter().flat_map(|species| (1..=3).map(move |seed| (species, seed))).collect();
    let falls_short = |&(species, seed): &(&species::Species, u32)| {
        let mut document = Document::new(seed);
        let programme = Some(wire_species(species).programme);
        document
            .apply(&Principal::visitor(), &Action::SetProgramme { programme, keep: false }.into())
            .expect("it can be set");
        enclose(&mut document, &circle);
        let Overlaps { metamers, count, .. } = Overlaps::of(&mut document, &circle);
        (metamers < 0.7).then(|| format!("{}, seed {seed}: {metamers}, {count} metamers", species.slug))
    };
    let failures: Vec<String> = cases.par_iter().filter_map(falls_short).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn la1_lassos_are_covered_by_leaves() {
    let cases: Vec<_> = HEIGHTS
        .into_iter()
        .flat_map(|(height, least)| {
            shapes::outlines().into_iter().map(move |(name, outline)| {
                let narrow = NARROW.iter().find(|&&(narrow, at, _)| (narrow, at) == (name, height));
                (name, height, narrow.map_or(least, |&(.., least)| least), outline)
            })
        })
        .collect();
    let falls_short = |(name, height, least, outline): &(&str, f32, f32, Vec<Vec2>)| {
        let outline: Vec<Vec2> = outline.iter().map(|&corner| corner * (height / shapes::HEIGHT)).collect();
        let overlap = |seed| Overlaps::of(&mut enclosed(seed, &outline), &outline).leaves;
        let overlaps: Vec<f32> = (1..=SEEDS).map(overlap).collect();
        let mean = overlaps.iter().sum::<f32>() / SEEDS as f32;
        let worst = overlaps.into_iter().fold(1.0, f32::min);
        (mean < *least || worst < WORST).then(|| format!("{name}, {height} tall: {mean}, at worst {worst}"))
    };
    let failures: Vec<String> = cases.par_iter().filter_map(falls_short).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}
