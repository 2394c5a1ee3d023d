//! Modules that wait, and growth between.

use std::sync::Arc;

use espalier_grammar::{Derivation, Drawn, Grammar, Limits, OpenSky, WoodOptions};

use crate::words::derived;

const OPTIONS: WoodOptions = WoodOptions { nodes: 10_000, extent: 1000, twig_radius: 0.05 };

fn drawn(text: &str, depth: u32) -> Drawn {
    let grammar = Grammar::read(text).unwrap_or_else(|errors| panic!("{errors:#?}"));
    let program = Arc::new(grammar.program(&[]).expect("no sliders"));
    let mut derivation = Derivation::new(program, 1, Limits::default()).expect("the axiom is small");
    derivation.derive(depth, &OpenSky).expect("it is small");
    derivation.draw(&OpenSky, OPTIONS).expect("it is small")
}

#[test]
fn modules_wait_for_their_time() {
    let text = "axiom: AB\ntiming: A 2 B 3\nA --> AF\nB --> G";
    let words: Vec<String> = (0..=6).map(|depth| derived(text, depth)).collect();
    assert_eq!(words, ["AB", "AB", "AFB", "AFG", "AFFG", "AFFG", "AFFFG"]);
}

#[test]
fn steps_of_any_size_come_to_the_same() {
    // After three units of time, in steps of 1/8, 1/2, 1 and 3.
    let at = |step: &str, depth| derived(&format!("axiom: A\ndt: {step}\ntiming: A 0.75\nA --> FA"), depth);
    let whole = at("0.125", 24);
    assert_eq!(whole, "FFFFA");
    for (step, depth) in [("0.5", 6), ("1", 3), ("3", 1)] {
        assert_eq!(at(step, depth), whole);
    }
}

#[test]
fn growth_goes_on_evenly_when_a_module_is_rewritten() {
    // An internode is drawn by its bud until that is rewritten; both are as long at that time.
    let text = "dt: 0.001\naxiom: A\ntiming: A 1\nA --> I A\nhomomorphism:\nA --> F(2*age)\nI --> F(2+age)";
    let top = |depth| {
        let drawn = drawn(text, depth);
        let highest = drawn.wood.nodes.iter().map(|node| node.end.y).fold(0.0, f32::max);
        f64::from(highest)
    };
    let (before, after) = (top(999), top(1001));
    assert!((before - 2.0).abs() < 4e-3 && (after - before).abs() < 1e-2, "{before} {after}");
}

#[test]
fn ages_count_steps_where_nobody_waits() {
    let text = "axiom: A\nA --> A B(0)\nB(x) --> B(age)";
    assert_eq!(derived(text, 3), "AB(0)B(0)B(1)");
}
