//! What the documentation shows is so.

use espalier_grammar::{Grammar, SHIPPED, Severity};

use crate::{
    trees::{drawn, planted},
    words::derived,
};

const PAGE: &str = include_str!("../../../../docs/grammars.md");

/// The grammars that the page shows.
fn examples() -> Vec<&'static str> {
    let blocks = PAGE.split("```lsystem\n").skip(1);
    blocks.map(|block| block.split("```").next().unwrap_or_default()).collect()
}

#[test]
fn each_example_grows_a_plant() {
    let examples = examples();
    assert!(examples.len() >= 6);
    for text in examples {
        assert_eq!(Grammar::check(text).diagnostics, [], "{text}");
        let depth =
            Grammar::read(text).expect("it is right").program(&[]).expect("as the file has it").depth();
        let found = drawn(text, depth);
        assert!(planted(&found).living_count() >= 10, "{text}");
    }
}

#[test]
fn the_signal_of_the_page_climbs() {
    let text = examples().into_iter().find(|text| text.contains("S < N")).expect("it is there");
    assert_eq!(derived(text, 0), "FSFNFNFN");
    assert_eq!(derived(text, 1), "FNFS[+F][-F]FNFN");
    assert_eq!(derived(text, 3), "FNFN[+F][-F]FN[+F][-F]FS[+F][-F]");
}

#[test]
fn each_kind_of_error_is_on_the_page() {
    let told = |text: &str| Grammar::check(text).diagnostics.remove(0);
    // Its examples are told as it says.
    assert_eq!(told("axiom: F\nF --> F]").code, "bracket");
    assert_eq!(told("axiom: F\nF(x) --> F(sni(x))").hint.as_deref(), Some("did you mean sin?"));
    assert_eq!(told("axiom: F\nF(x) : x = 3 --> F").hint.as_deref(), Some("write =="));
    assert_eq!(told("axiom: F\nA B --> F").code, "predecessor");
    for text in ["axiom: F]", "axiom: F\nif x:", "axiom: FQ", "", "axiom: F(", "axiom: A\nA --> F\nA --> F"] {
        let found = told(text);
        assert!(PAGE.contains(&format!("`{}`", found.code)), "{found}");
    }
    assert_eq!(told("axiom: FQ").severity, Severity::Warning);
}

#[test]
fn the_page_counts_what_is_shipped() {
    assert!(PAGE.contains(&format!("; {} of them are in", SHIPPED.len())));
}
