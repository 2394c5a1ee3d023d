//! Words are what the textbooks say.

use std::sync::Arc;

use espalier_grammar::{Derivation, Grammar, Limits, OpenSky, Progress};
use proptest::prelude::*;

use crate::textbook::{Rule, System};

/// The word of a grammar after so many steps.
pub fn derived(text: &str, depth: u32) -> String {
    let (grammar, derivation) = derivation(text, depth);
    derivation.word().text(&grammar)
}

/// A grammar derived so far.
pub fn derivation(text: &str, depth: u32) -> (Grammar, Derivation) {
    let grammar = Grammar::read(text).unwrap_or_else(|errors| panic!("{errors:#?}\n{text}"));
    let program = Arc::new(grammar.program(&[]).expect("the values of the file are in range"));
    let mut derivation = Derivation::new(program, 1, Limits::default()).expect("the axiom is small");
    derivation.derive(depth, &OpenSky).expect("it is small");
    (grammar, derivation)
}

fn rule(text: &str) -> Rule {
    let (before, successor) = text.split_once(" --> ").expect("a rule");
    let (left, rest) = before.split_once(" < ").map_or((None, before), |(left, rest)| (Some(left), rest));
    let (symbol, right) =
        rest.split_once(" > ").map_or((rest, None), |(symbol, right)| (symbol, Some(right)));
    let one = |text: &str| text.chars().next().expect("a symbol");
    let successor = successor.replace('*', "");
    Rule { left: left.map(one), symbol: one(symbol), right: right.map(one), successor }
}

fn system(axiom: &str, ignored: &str, rules: &[&str]) -> System {
    let rules = rules.iter().copied().map(rule).collect();
    System { axiom: axiom.into(), ignored: ignored.into(), rules }
}

#[test]
fn words_are_those_of_the_textbooks() {
    let systems = [
        // Algae.
        system("B", "", &["A --> AB", "B --> A"]),
        // Curves.
        system("F-F-F-F", "", &["F --> F-F+F+FF-F-F+F"]),
        system("F", "", &["F --> F+G", "G --> F-G"]),
        // Bushes with brackets.
        system("F", "", &["F --> F[+F]F[-F]F"]),
        system("F", "", &["F --> F[+F]F[-F][F]"]),
        system("F", "", &["F --> FF-[-F+F+F]+[+F-F-F]"]),
        system("X", "", &["X --> F[+X]F[-X]+X", "F --> FF"]),
        system("X", "", &["X --> F-[[X]+X]+F[+FX]-X", "F --> FF"]),
        // Signals: one that climbs, one that comes down.
        system("b[+a]a[-a]a[+a]a", "+-", &["b < a --> b", "b --> a"]),
        system("a[+a]a[-a]a[+a]b", "+-", &["a > b --> b", "b --> a"]),
        // Branches that depend on both neighbours.
        system(
            "FYFYFY",
            "+-F",
            &[
                "X < X > X --> X",
                "X < X > Y --> Y[+FYFY]",
                "X < Y > X --> Y",
                "X < Y > Y --> Y",
                "Y < X > X --> X",
                "Y < X > Y --> YFY",
                "Y < Y > X --> Y",
                "Y < Y > Y --> X",
                "+ --> -",
                "- --> +",
            ],
        ),
        // What vanishes.
        system("ABA", "", &["A --> BA", "B --> *"]),
    ];
    for system in systems {
        for depth in 0..=6 {
            assert_eq!(derived(&system.text(), depth), system.derive(depth as usize), "{system:?}");
        }
    }
}

#[test]
fn words_of_known_lengths() {
    // The algae's words are as long as Fibonacci's numbers, and Koch's have eight times as many lines each step.
    let algae = "axiom: B\nA --> AB\nB --> A";
    let lengths: Vec<usize> = (0..10).map(|depth| derived(algae, depth).len()).collect();
    assert_eq!(lengths, [1, 1, 2, 3, 5, 8, 13, 21, 34, 55]);
    let koch = "axiom: F-F-F-F\nangle: 90\nF --> F-F+F+FF-F-F+F";
    let lines: Vec<usize> = (0..4).map(|depth| derived(koch, depth).matches('F').count()).collect();
    assert_eq!(lines, [4, 32, 256, 2048]);
}

#[test]
fn parameters_are_computed_and_conditions_choose() {
    // The example with which parametric systems were introduced.
    let text = "axiom: B(2)A(4,4)
        A(x,y) : y <= 3 --> A(x*2,x+y)
        A(x,y) : y > 3 --> B(x)A(x/y,0)
        B(x) : x < 1 --> C
        B(x) : x >= 1 --> B(x-1)
        module C";
    let words: Vec<String> = (0..=4).map(|depth| derived(text, depth)).collect();
    assert_eq!(words, ["B(2)A(4,4)", "B(1)B(4)A(1,0)", "B(0)B(3)A(2,1)", "CB(2)A(4,3)", "CB(1)A(8,7)"]);
}

#[test]
fn contexts_bring_their_parameters_and_may_be_branches() {
    let text = "axiom: A(1)B(3)A(5)\nA(x) < B(y) > A(z) : y < 4 --> B(x+z)[A(x)]";
    assert_eq!(derived(text, 1), "A(1)B(6)[A(1)]A(5)");
    // The symbol sees its axis, and asks for a branch that begins with H.
    let text = "axiom: ABC[DE][SG[HI[JK]L]MNO]\nBC < S > G[H]M --> X\nX --> X";
    assert_eq!(derived(text, 1), "ABC[DE][XG[HI[JK]L]MNO]");
    let text = "axiom: ABC[DE][SG[IH]MNO]\nBC < S > G[H]M --> X\nX --> X";
    assert_eq!(derived(text, 1), "ABC[DE][SG[IH]MNO]");
    // The second of two branches fits.
    let text = "axiom: S[A(1)B][A(2)C]D\nS > [A(x)C]D --> S(x)\nS(x) --> S(x)";
    assert_eq!(derived(text, 1), "S(2)[A(1)B][A(2)C]D");
}

#[test]
fn homomorphisms_do_not_touch_the_word_and_decompositions_do() {
    let text = "axiom: I(3)
        decomposition: maximum depth: 10
        I(n) : n > 1 --> F I(n-1)
        I(n) : n <= 1 --> F A
        production:
        A --> I(2)
        homomorphism:
        A --> F F";
    assert_eq!((derived(text, 0), derived(text, 1)), ("FFFA".to_owned(), "FFFFFA".to_owned()));
}

#[test]
fn cuts_take_the_rest_of_a_branch() {
    let text = "axiom: A[BCD[E]]G\nB --> B%";
    assert_eq!(derived(text, 1), "A[B%CD[E]]G");
    assert_eq!(derived(text, 2), "A[B%%]G");
}

fn symbols() -> impl Strategy<Value = String> {
    proptest::string::string_regex("[ABCF+-]{0,4}").expect("it is a pattern")
}

/// Strings with brackets that match.
fn strings() -> impl Strategy<Value = String> {
    (symbols(), symbols(), symbols(), symbols(), 0..4).prop_map(|(a, b, c, d, shape)| match shape {
        0 => format!("{a}{b}"),
        1 => format!("{a}[{b}]{c}"),
        2 => format!("{a}[{b}[{c}]]{d}"),
        _ => format!("{a}[{b}][{c}]{d}"),
    })
}

fn systems() -> impl Strategy<Value = System> {
    let context = || proptest::option::of(proptest::sample::select(vec!['A', 'B', 'C', 'F']));
    let symbol = proptest::sample::select(vec!['A', 'B', 'C', 'F', '+']);
    let rule = (context(), symbol, context(), strings()).prop_map(|(left, symbol, right, successor)| Rule {
        left,
        symbol,
        right,
        successor,
    });
    let rules = proptest::collection::vec(rule, 1..6);
    let ignored = proptest::sample::select(vec!["", "+-", "F+-"]);
    (strings(), ignored, rules).prop_map(|(axiom, ignored, rules)| System {
        axiom: format!("A{axiom}"),
        ignored: ignored.into(),
        rules,
    })
}

proptest! {
    #[test]
    fn random_grammars_derive_as_the_textbook_does(system in systems(), slice in 1usize..50) {
        let text = system.text();
        let grammar = Grammar::read(&text).expect("it can be read");
        let program = Arc::new(grammar.program(&[]).expect("it has no sliders"));
        let mut derivation = Derivation::new(program, 1, Limits::default()).expect("the axiom is small");
        for depth in 1..=3 {
            // In slices of any size, which must not show.
            while derivation.advance(&OpenSky, slice) != Ok(Progress::Stepped) {}
            prop_assert_eq!(derivation.word().text(&grammar), system.derive(depth), "{}", text);
        }
    }
}
