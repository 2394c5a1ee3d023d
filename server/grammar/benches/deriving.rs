//! What grammars cost: a text read, words derived, and wood drawn and planted, on one thread.

use std::{hint::black_box, sync::Arc, time::Instant};

use espalier_grammar::{Derivation, Grammar, Limits, OpenSky, Program, WoodOptions};
use espalier_growth::{ParameterValues, Parameters, transplant};

const ROUNDS: usize = 15;
const OPTIONS: WoodOptions = WoodOptions { nodes: 4_000_000, extent: 100_000, twig_radius: 0.03 };

/// Grammars of about 100,000 internodes: one of parameters alone, one whose wood lengthens in each step, one of chance.
const LARGE: [(&str, u32, &str); 4] = [
    (
        "parametric, two branches at each fork",
        16,
        "axiom: A(1.4,9)\nA(l,w) --> !(w)F(l)[+(30)A(l*0.97,w*0.7)]/(137.5)[-(40)A(l*0.97,w*0.7)]",
    ),
    (
        "three branches, all wood lengthens",
        10,
        "axiom: !(1)F(1)A\nA --> !(1.7)F(0.5)[&(19)F(0.5)A]/(94.7)[&(19)F(0.5)A]/(132.6)[&(19)F(0.5)A]\n\
         F(l) --> F(l*1.1)\n!(w) --> !(w*1.7)",
    ),
    (
        "chance and conditions",
        24,
        "axiom: A(1)\nA(x) : x > 0.2 --> F(x)[+(20+ran(30))A(x*(0.8+ran(0.2)))]/(137.5)A(x*0.93) : 0.7\n\
         A(x) : x > 0.2 --> F(x)A(x*0.95) : 0.3",
    ),
    (
        "left contexts",
        10,
        "axiom: F(1)A\nignore: + -\nF(a) < A --> F(1)[+(30)A][-(30)A]F(1)A\nF(x) < F(l) --> F(l*1.01)",
    ),
];

fn main() {
    for (what, depth, text) in LARGE {
        let program = Arc::new(program(text));
        let derived = derive(&program, depth);
        let drawn = derived.draw(&OpenSky, OPTIONS).expect("it fits");
        let word = derived.word();
        println!(
            "{what}: {} internodes, {} modules of {:.1} bytes         best    median, ms",
            drawn.wood.nodes.len(),
            word.len(),
            word.bytes() as f64 / word.len() as f64
        );
        measure("derived from the axiom", || derive(&program, depth));
        measure("drawn as wood", || derived.draw(&OpenSky, OPTIONS));
        measure("derived and drawn", || derive(&program, depth).draw(&OpenSky, OPTIONS));
        let parameters = Parameters::new(ParameterValues::default()).expect("defaults are in range");
        measure("planted, with every check", || transplant(&drawn.wood, &parameters));
    }
    let (_, _, text) = LARGE[0];
    let grammar =
        Grammar::read(&text.replace("0.97", "r").replace("axiom", "r = 0.97\nslider: r 0.5 1\naxiom"))
            .expect("it is right");
    println!("a slider, 8,191 lines");
    let mut r = 0.9;
    measure("dragged: compiled, derived and drawn", || {
        r += 0.001;
        let program = Arc::new(grammar.program(&[("r", r)]).expect("it is in range"));
        derive(&program, 13).draw(&OpenSky, OPTIONS)
    });
    let rules: String = (0..30)
        .map(|rule| format!("A(x,y) : x > {rule} && y < sin(x) --> F(x*2)[+(30)A(x-1,y)]\n"))
        .collect();
    let text = format!("axiom: A(1,2)\n{rules}");
    println!("a text of {} bytes", text.len());
    measure("checked", || Grammar::check(&text));
}

fn program(text: &str) -> Program {
    Grammar::read(text).expect("it is right").program(&[]).expect("it has no sliders")
}

fn derive(program: &Arc<Program>, depth: u32) -> Derivation {
    let mut derivation =
        Derivation::new(Arc::clone(program), 1, Limits::default()).expect("the axiom is small");
    derivation.derive(depth, &OpenSky).expect("it fits");
    derivation
}

/// Prints how long something takes: the best round says what it costs rather than what else the machine was doing.
fn measure<T>(what: &str, mut work: impl FnMut() -> T) {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let begun = Instant::now();
            black_box(work());
            1e3 * begun.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    println!("  {what:<48} {:>10.3} {:>10.3}", times[0], times[ROUNDS / 2]);
}
