//! A lasso gets what was drawn: the tree, its leaves included, covers the outline and little beside it.

use glam::Vec2;
use rayon::prelude::*;

use crate::{
    overlaps::{Overlaps, enclosed},
    shapes,
};

const SEEDS: u32 = 16;
/// Heights of the outlines, and the overlap with leaves that seedlings reach on average. Leaves of one internode stick out of
/// what is narrow: two outlines have bounds of their own at the lower height.
const HEIGHTS: [(f32, f32); 2] = [(36.0, 0.88), (20.0, 0.82)];
const NARROW: [(&str, f32, f32); 2] = [("bar", 20.0, 0.765), ("thin ring", 20.0, 0.805)];

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
        let mean = (1..=SEEDS).map(overlap).sum::<f32>() / SEEDS as f32;
        (mean < *least).then(|| format!("{name}, {height} tall: {mean}"))
    };
    let failures: Vec<String> = cases.par_iter().filter_map(falls_short).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}
