//! What designing costs: a limb that changes, a whole tree of 10,000 internodes, and a design for 100,000 rows that grew.

use std::{hint::black_box, time::Instant};

use espalier_design::{
    Curve, Design, Edit, Fitting, Function, Generator, Held, Key, Limits, MAX_INTERNODES, MOST_ORDERS,
    NodeId, Owner, Setting, Value,
};
use espalier_growth::{NoObserver, Parameters, Simulation, StepInput, species};
use espalier_plant::{Girth, MetamerId, Plant};
use glam::Vec3;

const ROUNDS: usize = 31;

fn main() {
    let design = tree();
    let mut generator = Generator::default();
    let whole = generator.generate(&design, MAX_INTERNODES);
    let limb = &whole.limbs[0];
    println!(
        "{} branches, {} internodes, {} of them on limb {}       best    median, ms",
        design.root().count(),
        whole.wood.nodes.len(),
        limb.1.len(),
        limb.0
    );
    let limb = limb.0;
    let bends = [curve(0.2), curve(0.3)];
    let mut round = 0;
    let mut design = design;
    measure("a limb: bent, and all rows", || {
        round += 1;
        set(&mut design, limb, Key::Axis, bends[round % 2].clone());
        generator.generate(&design, MAX_INTERNODES)
    });
    measure("a limb: bent, values alone", || {
        round += 1;
        set(&mut design, limb, Key::Axis, bends[round % 2].clone());
    });
    measure("the whole tree: bent, and all rows", || {
        round += 1;
        set(&mut design, NodeId::ROOT, Key::Axis, bends[round % 2].clone());
        generator.generate(&design, MAX_INTERNODES)
    });
    measure("the whole tree: bent, values alone", || {
        round += 1;
        set(&mut design, NodeId::ROOT, Key::Axis, bends[round % 2].clone());
    });
    let wood = generator.generate(&design, MAX_INTERNODES).wood;
    let parameters = Parameters::default();
    measure("a plant of that wood, with buds", || espalier_growth::transplant(&wood, &parameters));
    let oak = oak(100_000);
    let girth = Girth::new(oak.1.girth_exponent, oak.1.twig_diameter);
    let begun = || {
        Fitting::new(&oak.0, &girth, MetamerId::new(0), MOST_ORDERS, Limits::default()).expect("it has wood")
    };
    measure(&format!("a design for {} rows begun", oak.0.living_count()), begun);
    let mut fitting = begun();
    let mut trials = Vec::new();
    while {
        let start = Instant::now();
        let goes_on = fitting.step();
        trials.push(start.elapsed().as_secs_f64() * 1e3);
        goes_on
    } {}
    trials.sort_by(f64::total_cmp);
    let (count, whole) = (trials.len(), trials.iter().sum::<f64>());
    println!(
        "a trial of it                                      {:>8.3} {:>8.3}",
        trials[0],
        trials[count / 2]
    );
    let fitted = fitting.found();
    println!(
        "{count} trials in {whole:.0} ms, {:.0} the longest: {} values, overlap {:.2}",
        trials[count - 1],
        fitted.records,
        fitted.overlap
    );
}

/// An oak of so many metamers, and its parameters.
fn oak(metamers: u32) -> (Plant, Parameters) {
    let species = species::find("oak").expect("there are oaks");
    let parameters = Parameters::new(species.parameters.clone()).expect("they are in range");
    let mut simulation = Simulation::new(1, parameters.clone());
    simulation.set_metamer_budget(metamers);
    let alone = StepInput { autonomous: true, ..StepInput::default() };
    while simulation.step(&alone, &mut NoObserver).metamers_grown > 0 {}
    (simulation.plant().clone(), parameters)
}

/// About 10,000 internodes.
fn tree() -> Design {
    let mut design = Design::default();
    set(&mut design, NodeId::ROOT, Key::Height, Held::new(Value::Scalar(90.0)));
    set(&mut design, NodeId::ROOT, Key::Density, Held::new(Value::Function(Function::constant(19.0))));
    design
}

fn curve(bend: f32) -> Held {
    let curve = Curve::new(&[Vec3::ZERO, Vec3::new(bend, 0.4, 0.1), Vec3::Y]).expect("it is a curve");
    Held::new(Value::Curve(curve))
}

fn set(design: &mut Design, node: NodeId, key: Key, value: Held) {
    let edit = Edit::Set { owner: Owner::Node(node), key, setting: Setting::own(value) };
    design.apply(&edit).expect("it is allowed");
}

fn measure<T>(what: &str, mut run: impl FnMut() -> T) {
    let mut times: Vec<_> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("{what:<50} {:>8.3} {:>8.3}", times[0], times[ROUNDS / 2]);
}
