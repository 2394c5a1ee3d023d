//! Lassos: how much of their outlines trees cover.

use glam::Vec2;
use rayon::prelude::*;

use super::{
    Options, mean_and_least,
    overlaps::{Overlaps, enclosed},
    shapes,
};

/// A tree that covers less than this of its outline is dead.
const DEAD: f32 = 0.5;

/// Prints a table.
pub fn measure(options: &Options) {
    println!("lassos, {} seeds each; mean and least overlap; dead: below {DEAD}", options.seeds);
    println!("outline   height  with leaves  missed spilt     metamers   dead   count");
    for &height in &options.heights {
        let mut means = Vec::new();
        for (name, outline) in shapes::outlines().into_iter().filter(|(name, _)| options.includes(name)) {
            let outline: Vec<Vec2> = outline.iter().map(|&p| p * (height / shapes::HEIGHT)).collect();
            let overlaps: Vec<Overlaps> = (1..=options.seeds)
                .into_par_iter()
                .map(|seed| Overlaps::of(&mut enclosed(seed, &outline), &outline))
                .collect();
            let column = |value: fn(&Overlaps) -> f32| overlaps.iter().map(value).collect::<Vec<_>>();
            let mean = |value| column(value).iter().sum::<f32>() / options.seeds as f32;
            let with_leaves = column(|overlap| overlap.leaves);
            means.push(with_leaves.iter().sum::<f32>() / with_leaves.len() as f32);
            println!(
                "{name:10} {height:5}  {}   {:5.2} {:5.2}  {}   {:4} {:7.0}",
                mean_and_least(&with_leaves),
                mean(|overlap| overlap.missed),
                mean(|overlap| overlap.spilt),
                mean_and_least(&column(|overlap| overlap.metamers)),
                with_leaves.iter().filter(|&&overlap| overlap < DEAD).count(),
                mean(|overlap| overlap.count as f32),
            );
        }
        println!("all        {height:5}  {}", mean_and_least(&means));
    }
}
