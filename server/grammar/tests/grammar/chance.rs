//! Keys stay with what goes on, and chance stays with keys.

use std::{collections::BTreeSet, sync::Arc};

use espalier_grammar::{Derivation, Drawn, Grammar, Limits, OpenSky, SHIPPED, WoodOptions};

use crate::words::derivation;

const OPTIONS: WoodOptions = WoodOptions { nodes: 1_000_000, extent: 10_000, twig_radius: 0.05 };

fn seeded(text: &str, seed: u32, depth: u32) -> (Grammar, Derivation) {
    let grammar = Grammar::read(text).unwrap_or_else(|errors| panic!("{errors:#?}"));
    let program = Arc::new(grammar.program(&[]).expect("no sliders are set"));
    let mut derivation = Derivation::new(program, seed, Limits::default()).expect("the axiom is small");
    derivation.derive(depth, &OpenSky).expect("it is small");
    (grammar, derivation)
}

fn drawn(derivation: &Derivation) -> Drawn {
    derivation.draw(&OpenSky, OPTIONS).expect("it is small")
}

fn keys(derivation: &Derivation) -> BTreeSet<u64> {
    (0..derivation.word().len()).map(|at| derivation.word().key(at)).collect()
}

#[test]
fn no_two_modules_or_nodes_have_one_key() {
    for shipped in SHIPPED {
        let (_, derivation) = derivation(shipped.text, 6);
        assert_eq!(keys(&derivation).len(), derivation.word().len(), "{}", shipped.name);
        let drawn = drawn(&derivation);
        let unique: BTreeSet<_> = drawn.keys.iter().collect();
        assert_eq!(unique.len(), drawn.wood.nodes.len(), "{}", shipped.name);
    }
    // What one module becomes when it is read, and pieces of one line.
    let (_, derivation) =
        derivation("axiom: AAF(9)\nhomomorphism: maximum depth: 3\nA --> BB\nB --> FF(3)nF(3,1)", 0);
    let drawn = drawn(&derivation);
    let unique: BTreeSet<_> = drawn.keys.iter().collect();
    assert_eq!((unique.len(), drawn.wood.nodes.len()), (38, 38));
}

#[test]
fn wood_that_lengthens_keeps_its_keys() {
    let text = SHIPPED.iter().find(|shipped| shipped.name == "ternary-wind").expect("it is shipped").text;
    let mut before = BTreeSet::new();
    for depth in 0..=7 {
        let (_, derivation) = derivation(text, depth);
        let now: BTreeSet<u64> = drawn(&derivation).keys.into_iter().collect();
        assert!(before.is_subset(&now), "wood of step {depth} was made anew");
        before = now;
    }
    // All of a curve is drawn anew: its lines become others.
    let lines = |depth| drawn(&derivation("axiom: F\nF --> FF", depth).1).keys;
    let (one, two) = (lines(3), lines(4));
    assert!(one[1..].iter().all(|key| !two.contains(key)));
}

#[test]
fn the_same_seed_gives_the_same_word_and_another_one_another() {
    let text = SHIPPED.iter().find(|shipped| shipped.name == "honda-maple").expect("it is shipped").text;
    let word = |seed| {
        let (grammar, derivation) = seeded(text, seed, 6);
        derivation.word().text(&grammar)
    };
    assert_eq!(word(7), word(7));
    assert_ne!(word(7), word(8));
}

#[test]
fn alternatives_are_drawn_by_their_weights() {
    let text = format!(
        "axiom: {}\nA --> X : 3\nA --> Y : 1\nA --> Z : 0\nX --> X\nY --> Y\nZ --> Z",
        "A".repeat(8000)
    );
    let (grammar, derivation) = seeded(&text, 5, 1);
    let word = derivation.word().text(&grammar);
    let share = word.matches('X').count() as f64 / 8000.0;
    // The deviation is 0.0048.
    assert!((share - 0.75).abs() < 0.025, "{share}");
    assert!(!word.contains('Z') && !word.contains('A'));
}

#[test]
fn numbers_of_chance_lie_where_they_are_asked_for() {
    let text = format!("axiom: {}\nA(x) --> B(ran(4), nran(10, 2))\nB(x,y) --> B(x,y)", "A(0)".repeat(4000));
    let (_, derivation) = seeded(&text, 3, 1);
    let word = derivation.word();
    let all = |at: usize| (0..word.len()).map(move |module| word.parameters(module)[at]);
    assert!(all(0).all(|x| (0.0..4.0).contains(&x)));
    let mean = |numbers: &mut dyn Iterator<Item = f64>| numbers.sum::<f64>() / 4000.0;
    let (uniform, normal) = (mean(&mut all(0)), mean(&mut all(1)));
    let spread = mean(&mut all(1).map(|y| (y - 10.0) * (y - 10.0))).sqrt();
    // Six deviations of the means, and of the spread.
    assert!((uniform - 2.0).abs() < 0.11, "{uniform}");
    assert!((normal - 10.0).abs() < 0.19 && (spread - 2.0).abs() < 0.14, "{normal} {spread}");
}

#[test]
fn what_happens_in_one_branch_changes_no_chance_in_another() {
    let text = "axiom: A(0)\nA(x) --> F(1)[B(0)]A(x+ran(1))\nB(y) --> F(1)B(y+ran(1))";
    let without = text.replace("\nB(y) --> F(1)B(y+ran(1))", "\nB(y) --> B(y)");
    let trunk = |text: &str| {
        let (grammar, derivation) = seeded(text, 11, 9);
        let word = derivation.word().text(&grammar);
        word[word.rfind('A').expect("it has an apex")..].to_owned()
    };
    assert_eq!(trunk(text), trunk(&without));
    // Another successor before the heir leaves the heir's chance alone as well.
    assert_eq!(trunk(text), trunk(&text.replace("F(1)[B(0)]A", "F(1)F(1)[B(0)][B(0)]A")));
}

#[test]
fn without_one_laterals_rule_all_draws_elsewhere_are_as_they_were() {
    let text = "axiom: A(0)\nA(x) --> F(1)[B(ran(1))][C(ran(1))]A(x+ran(1))\n\
                B(y) --> F(ran(1))[E(ran(1))]B(y+ran(1))\n\
                C(z) --> F(nran(1, 1))C(z+ran(1)) : 2\nC(z) --> D(ran(1)) : 1\nD(z) --> D(z)\nE(z) --> E(z)";
    let without = text.replace("B(y) --> F(ran(1))[E(ran(1))]B(y+ran(1))\n", "");
    assert_ne!(text, without);
    // All words in brackets that do not begin with what B has made, and the trunk.
    let elsewhere = |text: &str| {
        let (grammar, derivation) = seeded(text, 23, 9);
        let word = derivation.word().text(&grammar);
        let is_of_b = |branch: &&str| branch.contains('B') || branch.contains('E');
        let branches: Vec<String> =
            word.split(['[', ']']).filter(|branch| !is_of_b(branch)).map(str::to_owned).collect();
        let of_c = branches.iter().filter(|branch| branch.contains('C') || branch.contains('D')).count();
        assert!(of_c >= 9, "{word}");
        branches.into_iter().filter(|branch| branch.contains(['A', 'C', 'D'])).collect::<Vec<_>>()
    };
    assert_eq!(elsewhere(text), elsewhere(&without));
}
