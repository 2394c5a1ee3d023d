//! What files of cpfg and L-Py say besides, with the meaning that it has there.

use std::sync::Arc;

use espalier_grammar::{Derivation, Grammar, Limits, OpenSky, WoodOptions};

use super::words::derived;

#[test]
fn numbers_may_end_with_their_point() {
    assert_eq!(derived("axiom: A(3)\nA(x) --> A(1. - x)B(2.)C(x/2.)", 1), "A(-2)B(2)C(1.5)");
}

#[test]
fn a_star_is_any_context() {
    let text = "axiom: A B C\n* < A > * : * --> D\n* < B --> E\nC > * --> G";
    assert_eq!(derived(text, 1), "DEG");
}

#[test]
fn statements_name_numbers() {
    let text = "axiom: A(2)\nA(x) : {y = x*x; z = y+1;} z > 4 {w = z*10} --> B(y, z, w)";
    assert_eq!(derived(text, 1), "B(4,5,50)");
    // What comes behind the condition is computed only where it holds.
    let text = "axiom: A(0)A(2)\nA(x) : x > 0 {y = 1/x;} --> B(y)";
    assert_eq!(derived(text, 1), "A(0)B(0.5)");
    // With contexts, and in homomorphisms and decompositions.
    let text =
        "axiom: A(1)B(2)\nA(x) < B(y) > * : {s = x+y;} --> C(s)\ndecomposition:\nC(s) : {t = 2*s;} --> D(t)";
    assert_eq!(derived(text, 1), "A(1)D(6)");
    // One draw of chance is one number, wherever its name stands.
    let text = "axiom: A\nA : {r = ran(1);} --> B(r, r) : 1\nA : {r = ran(1);} --> B(r, r) : 1";
    let word = derived(text, 1);
    let (one, other) = word.trim_matches(['B', '(', ')']).split_once(',').expect("two numbers");
    assert_eq!(one, other);
}

#[test]
fn statements_give_parameters_other_numbers() {
    // As files of cpfg let time go on: the condition and the successor mean the newer number.
    let text = "axiom: A(3)\nA(t) : {t = t-1;} t > 1 {t = 10*t; u = t+1;} --> A(t)B(u)";
    assert_eq!(derived(text, 1), "A(20)B(21)");
    assert_eq!(
        derived(&text.replace("A(3)", "A(2)"), 1),
        "A(2)",
        "its own number is left where no rule acts"
    );
    // The number of a context means the newer one as well, and the older one stays in the word.
    let text = "axiom: A(1)B(5)\nA(x) < B(y) : {x = x+y; y = x*x;} --> C(x, y)";
    assert_eq!(derived(text, 1), "A(1)C(6,36)");
}

#[test]
fn rules_may_have_their_arrow_on_the_next_line() {
    let text =
        "axiom: A(3)\nA(t) : t > 1 {u = t*t;}\n  --> B(u)\n      A(t-1)\nA(t) : t <= 1\n{v = 7;} --> C(v)";
    assert_eq!(derived(text, 3), "B(9)B(4)C(7)");
    // A header that lacks something is not taken for a predecessor.
    assert!(Grammar::read("axiom: A\n--> F").is_err());
}

#[test]
fn macros_stand_for_modules() {
    let text = "#define LEAF [+(a)L(x)]\n#define a 30\n#define APEX A\n#define TWO LEAF LEAF\n\
                axiom: APEX(1)LEAF2\nAPEX(x) --> F TWO APEX(x+1)";
    // `LEAF2` is no name of a macro, but five modules and a digit.
    assert!(Grammar::read(text).is_err());
    let text = text.replace("LEAF2", "");
    assert_eq!(derived(&text, 1), "F[+(30)L(1)][+(30)L(1)]A(2)");
}

#[test]
fn a_file_may_say_its_seed() {
    let seed = |text: &str| {
        let grammar = Grammar::read(text).unwrap_or_else(|errors| panic!("{errors:#?}"));
        grammar.program(&[]).expect("no sliders").seed()
    };
    assert_eq!(seed("axiom: F\nseed: 41"), Some(41));
    assert_eq!(seed("axiom: F"), None);
}

#[test]
fn tiny_pieces_are_told_with_the_scale_that_mends_them() {
    let found = |scale: &str| {
        let text = format!("axiom: A\nscale: {scale}\nA --> F(0.1)[+(30)F(0.1)F(0.1)F(0.1)]A");
        let grammar = Grammar::read(&text).unwrap_or_else(|errors| panic!("{errors:#?}"));
        let program = Arc::new(grammar.program(&[]).expect("no sliders"));
        let mut derivation = Derivation::new(program, 1, Limits::default()).expect("it is small");
        derivation.derive(80, &OpenSky).expect("it is small");
        let options = WoodOptions { nodes: 5000, extent: 5000, twig_radius: 0.05 };
        let drawn = derivation.draw(&OpenSky, options).expect("it is small");
        grammar.tiny_pieces(&derivation, &drawn)
    };
    let told = found("1").expect("its lines are a tenth of an internode long");
    assert_eq!((told.id, told.line), ("tiny-pieces", 1));
    assert_eq!(told.hint.as_deref(), Some("write scale: 10"));
    assert_eq!(found("10"), None);
}
