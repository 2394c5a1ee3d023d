//! How well growth obeys a finger: strokes of many forms and widths, and lassos of many outlines, over some seeds.
//!
//!     cargo bench -p espalier-session --bench guidance -- [strokes|lassos] [OPTION VALUE]…
//!
//! Options: `--seeds` so many of each; `--only` names of forms, `--radii` and `--heights` in internodes, with commas
//! between; `--hand slow|fast|sparse`, how much of the finger's way is told, and in how many messages.

mod following;
mod lassos;
mod overlaps;
mod shapes;
mod strokes;

use following::Hand;

/// What is measured.
#[derive(Clone, Debug)]
struct Options {
    seeds: u32,
    only: Vec<String>,
    radii: Vec<f32>,
    heights: Vec<f32>,
    hand: Hand,
}

impl Options {
    fn includes(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only == name)
    }
}

fn main() {
    let mut options = Options {
        seeds: 16,
        only: Vec::new(),
        radii: vec![1.0, 1.5, 2.0, 3.0, 6.0, 12.0],
        heights: vec![36.0, 20.0],
        hand: Hand::SLOW,
    };
    let (mut strokes, mut lassos) = (false, false);
    let mut arguments = std::env::args().skip(1);
    let numbers = |text: String| text.split(',').map(|number| number.parse().expect("a number")).collect();
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().expect("an option has a value");
        match argument.as_str() {
            "strokes" => strokes = true,
            "lassos" => lassos = true,
            "--seeds" => options.seeds = value().parse().expect("a number"),
            "--only" => options.only = value().split(',').map(str::to_owned).collect(),
            "--radii" => options.radii = numbers(value()),
            "--heights" => options.heights = numbers(value()),
            "--hand" => {
                options.hand = match value().as_str() {
                    "slow" => Hand::SLOW,
                    "fast" => Hand::FAST,
                    "sparse" => Hand::SPARSE,
                    other => panic!("there is no hand {other}"),
                };
            }
            // Cargo says that this is a bench.
            "--bench" => {}
            other => panic!("there is no {other}"),
        }
    }
    let all = strokes == lassos;
    if strokes || all {
        strokes::measure(&options);
    }
    if lassos || all {
        lassos::measure(&options);
    }
}

/// Mean and least, as columns.
fn mean_and_least(values: &[f32]) -> String {
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    format!("{mean:5.2} {:5.2}", values.iter().copied().fold(f32::INFINITY, f32::min))
}

/// Mean and greatest, as columns.
fn mean_and_most(values: &[f32]) -> String {
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    format!("{mean:5.2} {:5.2}", values.iter().copied().fold(0.0, f32::max))
}
