//! Strokes: whether growth reaches their ends, fills the volume that the brush swept, and stays in it.

use espalier_session::Document;
use rayon::prelude::*;

use super::{
    Options,
    following::{Followed, drawn},
    mean_and_least, mean_and_most, shapes,
};

/// Prints a table.
pub fn measure(options: &Options) {
    println!("strokes, {} seeds each; mean and worst", options.seeds);
    println!("stroke  radius  arrived    good         fill        spill   metamers");
    for (name, path) in shapes::strokes() {
        for &radius in options.radii.iter().filter(|_| options.includes(name)) {
            let followed: Vec<Followed> = (1..=options.seeds)
                .into_par_iter()
                .map(|seed| {
                    let (document, before) = drawn(Document::new(seed), &path, radius, options.hand);
                    Followed::of(&document, before, &options.hand.told(&path), radius)
                })
                .collect();
            let column = |value: fn(&Followed) -> f32| followed.iter().map(value).collect::<Vec<_>>();
            println!(
                "{name:6} {radius:7} {:5} of {:2} {:7} {} {} {:10.0}",
                followed.iter().filter(|followed| followed.arrived).count(),
                options.seeds,
                followed.iter().filter(|followed| followed.is_good(name, radius)).count(),
                mean_and_least(&column(|followed| followed.fill)),
                mean_and_most(&column(|followed| followed.spill)),
                column(|followed| followed.metamers as f32).iter().sum::<f32>() / options.seeds as f32,
            );
        }
    }
}
