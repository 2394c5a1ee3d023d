//! Fidelity: what the papers say about form, measured on grown trees. `docs/fidelity.md` lists the figures.
//!
//! Every claim held for at least five seeds when it was written down; some of them are kept here. That a sketched
//! stroke is followed stands in `brushing.rs`, that a tree grows around what stands in its way in
//! `obstructing.rs`.

mod apical_control;
mod company;
mod gravity;
mod light_response;
mod limits;
mod measure;
mod outlines;
mod shoot_length;
mod silhouettes;
mod zones;

use espalier_plant::Plant;

use super::*;
use measure::{changed, seedling};

/// Lets a tree grow on its own until it has so many metamers.
fn grow_to(simulation: &mut Simulation, metamers: u32) {
    for _ in 0..100 {
        if simulation.plant().living_count() >= metamers {
            return;
        }
        grow(simulation, 1);
    }
    panic!("{} of {metamers} metamers in 100 steps", simulation.plant().living_count());
}
