//! The grammars that come with the program.

use std::sync::Arc;

use espalier_grammar::{Derivation, Grammar, Limits, OpenSky, SHIPPED, Shipped};

use crate::{
    trees::{drawn, planted},
    words::derived,
};

fn shipped(name: &str) -> &'static Shipped {
    SHIPPED.iter().find(|shipped| shipped.name == name).expect("it is shipped")
}

#[test]
fn each_is_right_and_says_what_it_is() {
    for Shipped { name, text } in SHIPPED {
        let checked = Grammar::check(text);
        assert_eq!(checked.diagnostics, [], "{name}");
        let grammar = checked.grammar.expect("nothing is wrong with it");
        assert!(grammar.title().is_some_and(|title| title.len() > 3), "{name} has no title");
        let is_sentence = |about: &str| about.ends_with('.') && about.len() > 20;
        assert!(grammar.about().is_some_and(is_sentence), "{name} has no sentence");
        assert!(!grammar.sliders().is_empty(), "{name} has no slider");
    }
}

#[test]
fn each_grows_a_plant_at_every_depth() {
    for Shipped { name, text } in SHIPPED {
        let depth =
            Grammar::read(text).expect("it is right").program(&[]).expect("as the file has it").depth();
        let mut before = 0;
        for depth in [depth / 2, depth] {
            let found = drawn(text, depth);
            let plant = planted(&found);
            assert!(plant.living_count() >= before, "{name} shrinks");
            before = plant.living_count();
        }
        assert!((100..20_000).contains(&before), "{name} has {before} metamers");
    }
}

#[test]
fn each_bears_its_sliders_to_their_ends() {
    for Shipped { name, text } in SHIPPED {
        let grammar = Grammar::read(text).expect("it is right");
        for slider in grammar.sliders() {
            for value in [slider.from, slider.to] {
                let program = grammar.program(&[(&slider.name, value)]).expect("it is in range");
                let depth = program.depth();
                let limits = Limits { modules: 500_000, ..Limits::default() };
                let mut derivation =
                    Derivation::new(Arc::new(program), 1, limits).expect("the axiom is small");
                let derived = derivation.derive(depth, &OpenSky);
                assert_eq!(derived, Ok(()), "{name} with {} at {value}", slider.name);
            }
        }
    }
}

/// Lines that are drawn, by depth, of those whose numbers follow a law.
#[test]
fn lines_are_as_many_as_they_must_be() {
    let lines = |name: &str, depth: u32| {
        let word = derived(shipped(name).text, depth);
        word.matches(['F', 'G']).count() as u32
    };
    for depth in 0..=6u32 {
        let (two, three, four, five) = (2u32.pow(depth), 3u32.pow(depth), 4u32.pow(depth), 5u32.pow(depth));
        for (name, wanted) in [
            ("koch", four),
            ("sierpinski", three),
            ("dragon", two + 1),
            ("bush-bracketed", if depth > 4 { continue } else { five }),
            ("barron-binary", two - 1),
            ("monopodial", two - 1),
            ("sympodial", two - 1),
            ("leeuwenberg", (three - 1) / 2),
            ("ternary-wind", 2 * three - 1),
            ("topiary-box", if depth > 2 { continue } else { [1, 3, 7][depth as usize] }),
        ] {
            assert_eq!(lines(name, depth), wanted, "{name} at depth {depth}");
        }
    }
    assert_eq!(lines("barron-binary", 8), 255);
}

#[test]
fn counts_of_the_others_are_as_they_were() {
    let counts: Vec<String> = (SHIPPED.iter())
        .map(|Shipped { name, text }| {
            let depth =
                Grammar::read(text).expect("it is right").program(&[]).expect("as the file has it").depth();
            let found = drawn(text, depth);
            format!("{name} {} {}", found.wood.nodes.len(), found.wood.axes.len())
        })
        .collect();
    let wanted: Vec<String> = include_str!("counts.txt").lines().map(str::to_owned).collect();
    assert_eq!(counts, wanted);
}

#[test]
fn sliders_are_kept_in_their_ranges() {
    let grammar = Grammar::read(shipped("barron-binary").text).expect("it is right");
    let slider = grammar.sliders().into_iter().find(|slider| slider.name == "a").expect("it has one");
    assert_eq!((slider.value, slider.from, slider.to), (28.0, 10.0, 60.0));
    assert!(grammar.program(&[("a", 30.0), ("r", 0.7)]).is_ok());
    let too_much = grammar.program(&[("a", 90.0)]).expect_err("it is out of range");
    assert_eq!(too_much.to_string(), "`a` goes from 10 to 60");
    let unknown = grammar.program(&[("wr", 0.5)]).expect_err("it has no slider");
    assert_eq!(unknown.id(), "out-of-range.no-slider");
    assert!(grammar.program(&[("a", f64::NAN)]).is_err());
}
