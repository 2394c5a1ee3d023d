//! What it costs to make triangles of trees of 10,000 and of 100,000 metamers: of their wood, and of all of them in a file.

use std::{hint::black_box, time::Instant};

use espalier_export::{About, Model, glb, in_memory};
use espalier_growth::{NoObserver, ParameterValues, Parameters, Simulation, StepInput};
use espalier_mesh::{Bodies, Grain, Style, StyleOptions, Wood};
use espalier_settings::Appearance;
use serde_json::Value;

const ROUNDS: usize = 9;

fn main() {
    for metamers in [10_000, 100_000] {
        mesh(metamers);
    }
}

fn mesh(metamers: u32) {
    let (values, looks) = (ParameterValues::default(), Appearance::default());
    let mut simulation = Simulation::new(1, Parameters::new(values.clone()).expect("defaults are in range"));
    simulation.set_metamer_budget(u32::MAX);
    while simulation.plant().living_count() < metamers {
        simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
    }
    let plant = simulation.plant();
    let style = Style::new(StyleOptions {
        girth_exponent: values.girth_exponent,
        twig_diameter: values.twig_diameter,
        leaves_per_node: values.leaves_per_node as u8,
        leaf_size: values.leaf_size,
    });
    println!(
        "{} metamers living                  best    median, ms    millions of triangles a second",
        plant.living_count()
    );
    let courses = || Bodies::of(plant, &style, &looks.bark, Grain::default());
    measure("where wood is drawn", || {
        black_box(courses());
        0
    });
    let bodies = courses();
    measure("triangles of wood", || {
        let mut triangles = 0;
        for body in bodies.iter() {
            let mut wood = Wood::of(body.seed());
            body.sweep(&mut wood);
            triangles += black_box(&wood).triangles().count();
        }
        triangles
    });
    let about = About {
        program: "meshing",
        simulation: 0,
        species: None,
        seed: Some(1),
        parameters: &values,
        obstacles: &[],
        author: None,
        licence: None,
    };
    let file = || {
        in_memory(|out| glb(plant, &style, &looks, &about, &Model::default(), out))
            .expect("it can be written")
    };
    let written = file();
    let all = triangles(&written);
    measure("a glTF file of wood and leaves", || {
        black_box(file());
        all
    });
    println!("  {all} triangles in {} MB\n", written.len() / 1_000_000);
}

/// How many triangles a file has.
fn triangles(file: &[u8]) -> usize {
    // A header of twelve bytes, then the length and the kind of its JSON.
    let length = u32::from_le_bytes(file[12..16].try_into().expect("four bytes")) as usize;
    let root: Value = serde_json::from_slice(&file[20..20 + length]).expect("it is JSON");
    let primitives = root["meshes"].as_array().into_iter().flatten();
    let primitives = primitives.flat_map(|mesh| mesh["primitives"].as_array().into_iter().flatten());
    let indices = primitives.filter_map(|primitive| primitive["indices"].as_u64());
    indices.filter_map(|at| root["accessors"][at as usize]["count"].as_u64()).sum::<u64>() as usize / 3
}

/// Prints how long something takes and how many of the triangles that it says it makes a second; the best round says what
/// it costs rather than what else the machine was doing.
fn measure(what: &str, mut work: impl FnMut() -> usize) {
    let mut made = 0;
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let begun = Instant::now();
            made = work();
            1e3 * begun.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    let rate = if made > 0 { format!("{:.1}", made as f64 / times[0] / 1e3) } else { String::new() };
    println!("  {what:<30} {:>10.1} {:>10.1}    {rate}", times[0], times[ROUNDS / 2]);
}
