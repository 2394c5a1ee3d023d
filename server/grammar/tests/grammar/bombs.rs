//! Budgets end what would take too much, and leave the step before.

use std::sync::Arc;

use espalier_grammar::{
    Derivation, Grammar, Limits, MOST_OF_ONE, OpenSky, Progress, Stop, WORDINGS, WoodOptions,
};

fn begun(text: &str, limits: Limits) -> Result<Derivation, Stop> {
    let grammar = Grammar::read(text).unwrap_or_else(|errors| panic!("{errors:#?}"));
    Derivation::new(Arc::new(grammar.program(&[]).expect("no sliders")), 1, limits)
}

/// Why a derivation ends, and after how many steps.
fn end(text: &str, limits: Limits) -> (Stop, u32) {
    let mut derivation = match begun(text, limits) {
        Ok(derivation) => derivation,
        Err(stop) => return (stop, 0),
    };
    let stop = derivation.derive(1000, &OpenSky).expect_err("it must end");
    assert_eq!(derivation.advance(&OpenSky, 1), Err(stop), "nothing goes on");
    (stop, derivation.depth())
}

const SMALL: Limits = Limits { modules: 1000, parameters: 100, nesting: 20, work: 100_000 };

#[test]
fn each_budget_ends_a_derivation() {
    assert_eq!(end("axiom: F\nF --> FFFFFFFF", SMALL), (Stop::Modules(1000), 3));
    assert_eq!(end("axiom: A\nA --> F(1,2,3)A", SMALL), (Stop::Parameters(100), 33));
    assert_eq!(end("axiom: A\nA --> [A]", SMALL), (Stop::Nesting(20), 20));
    let (stop, _) = end("axiom: A(0)\nA(x) --> A(x+1-1+1-1)", Limits { work: 50, ..SMALL });
    assert_eq!(stop, Stop::Work(50));
}

#[test]
fn bombs_of_every_kind_go_off_in_vain() {
    let limits = Limits::default();
    assert_eq!(end("axiom: F\nF --> FFFFFFFF", limits), (Stop::Modules(8_000_000), 7));
    // A context that is far away from everyone who looks for it: the square of the word's length.
    let text = format!("axiom: A\nignore: F\nA --> {}\nB < F --> G", "F".repeat(4000));
    let (stop, _) = end(&text, Limits { work: 5_000_000, ..limits });
    assert_eq!(stop, Stop::Work(5_000_000));
}

#[test]
fn rules_that_never_rest_are_told_by_their_line() {
    let text = "axiom: A\ndecomposition:\nA --> FA";
    assert_eq!(end(text, Limits::default()), (Stop::Endless { line: 3, column: 1, most: 10 }, 0));
    // Twice as many each time, and yet at its end soon.
    let text = "axiom: A\ndecomposition: maximum depth: 100\nA --> AA";
    assert_eq!(end(text, Limits::default()).1, 0);
    // A lifespan so short that a step is over a hundred of them.
    let text = "axiom: A\ntiming: A 0.001\nA --> FA";
    assert_eq!(end(text, Limits::default()), (Stop::Endless { line: 3, column: 1, most: 100 }, 0));
}

const WOOD: WoodOptions = WoodOptions { nodes: 1000, extent: 1000, twig_radius: 0.05 };

/// Why a word is not drawn, and what finding that out has cost.
fn undrawn(text: &str, limits: Limits) -> (Stop, u64) {
    let derivation = begun(text, limits).expect("the axiom is small");
    let mut drawing = derivation.drawing(WOOD);
    loop {
        if let Err(stop) = drawing.advance(&derivation, &OpenSky, 1000) {
            return (stop, drawing.work());
        }
    }
}

#[test]
fn homomorphisms_do_not_go_off_either() {
    let single = Stop::Single(MOST_OF_ONE);
    let most = MOST_OF_ONE as u64;
    // Two to the power of a hundred; the same with parameters and conditions; with nothing left of it; with names.
    let bombs = [
        ("axiom: A\nhomomorphism: maximum depth: 100\nA --> AA", 2),
        ("axiom: A(99)\nhomomorphism: maximum depth: 100\nA(n) : n > 0 --> A(n-1)A(n-1)", 8),
        (
            "axiom: A(50)\nhomomorphism: maximum depth: 100\nA(n) : n > 0 --> A(n-1)A(n-1)\nA(n) : n <= 0 --> *",
            12,
        ),
        ("axiom: A(99)\nhomomorphism: maximum depth: 100\nA(n) : {m = n-1;} n > 0 --> A(m)A(m)", 12),
        ("axiom: nF(1,1e-6)", 2),
    ];
    for (text, for_each) in bombs {
        let (stop, work) = undrawn(text, Limits::default());
        assert_eq!(stop, single, "{text}");
        assert!(work <= for_each * most, "{text}: {work}");
    }
    // No module is read as very many, but there are many.
    let text = format!(
        "axiom: {}\nhomomorphism: maximum depth: 100\nA(n) : n > 0 --> A(n-1)A(n-1)",
        "A(14)".repeat(9000)
    );
    let limits = Limits { modules: 50_000, ..Limits::default() };
    let (stop, work) = undrawn(&text, limits);
    assert_eq!(stop, Stop::Read(200_000));
    assert!(work < 2_000_000, "{work}");
}

#[test]
fn decompositions_that_leave_nothing_are_counted() {
    let vanishes = |axiom: &str| {
        format!(
            "axiom: {axiom}\nB --> A(60)\nC --> A(12)\ndecomposition: maximum depth: 100\n\
             A(n) : n > 0 --> A(n-1)A(n-1)\nA(n) : n <= 0 --> *"
        )
    };
    assert_eq!(end(&vanishes("A(60)"), Limits::default()), (Stop::Single(MOST_OF_ONE), 0));
    let mut one = begun(&vanishes("B"), Limits::default()).expect("it is small");
    assert_eq!(one.step(&OpenSky), Err(Stop::Single(MOST_OF_ONE)));
    assert!(one.work() <= 12 * MOST_OF_ONE as u64, "{}", one.work());
    let limits = Limits { modules: 50_000, ..Limits::default() };
    let mut many = begun(&vanishes(&"C".repeat(9000)), limits).expect("it is small");
    assert_eq!(many.step(&OpenSky), Err(Stop::Modules(50_000)));
    assert!(many.work() <= 12 * 100_000, "{}", many.work());
    assert!(many.word().len() == 9000, "the word is that of before");
}

/// What the next slices of so many modules cost, one by one, until the step ends.
fn slices(derivation: &mut Derivation, modules: usize) -> Vec<u64> {
    let mut costs = Vec::new();
    loop {
        let before = derivation.work();
        let came = derivation.advance(&OpenSky, modules).expect("it goes on");
        costs.push(derivation.work() - before);
        if came == Progress::Stepped {
            return costs;
        }
    }
}

#[test]
fn a_slice_ends_after_so_much_work_of_any_kind() {
    // What a slice of 100 modules may cost: modules taken and made, and steps of computing, with those of the last one.
    let most = 100 * (1 + 2 + 8);
    let cases = [
        // Copied, rewritten to much, computed long, looked for far away, decomposed to nothing.
        (format!("axiom: {}\nB --> C", "F".repeat(5000)), 0),
        (format!("axiom: {}\nA --> {}", "A".repeat(500), "F".repeat(300)), 300),
        (format!("axiom: {}\nA(x) --> A(x{})", "A(1)".repeat(500), "+1-1".repeat(40)), 200),
        (format!("axiom: C{}\nignore: F\nB < A --> C", "FFFFFFFFFA".repeat(300)), 3000),
        (
            format!(
                "axiom: {}\nB --> A(5)\ndecomposition:\nA(n) : n > 0 --> A(n-1)A(n-1)\nA(n) : n <= 0 --> *",
                "B".repeat(500)
            ),
            800,
        ),
    ];
    for (text, of_the_last) in cases {
        let mut derivation = begun(&text, Limits::default()).expect("it is small");
        let costs = slices(&mut derivation, 100);
        assert!(costs.len() > 4, "{}", &text[text.len() - 40..]);
        let worst = costs.iter().max();
        assert!(worst <= Some(&(most + of_the_last)), "{worst:?}: {}", &text[text.len() - 40..]);
        let mut whole = begun(&text, Limits::default()).expect("it is small");
        assert_eq!(whole.step(&OpenSky), Ok(()));
        assert_eq!(whole.word(), derivation.word(), "slices do not show");
    }
}

#[test]
fn numbers_that_are_none_are_told_by_their_rule() {
    let none = |line| (Stop::NoNumber { line, column: 1 }, 0);
    for expression in
        ["1/0", "1/(x-1)", "sqrt(-x)", "ln(0)", "ln(-x)", "x%0", "exp(1000*x)", "asin(2*x)", "10^400"]
    {
        let text = format!("axiom: A(1)\nA(x) --> A({expression})");
        assert_eq!(end(&text, SMALL), none(2), "{expression}");
    }
    assert_eq!(end("axiom: A(1)\n\nA(x) : 1/(x-1) > 0 --> F", SMALL), none(3));
    assert_eq!(end("axiom: A(1)\n\nA(x) : 0 && sqrt(-x) --> F", SMALL), none(3));
    let text = "a = 2\naxiom: F A(1/(a-2))\nA(x) --> F";
    assert_eq!(end(text, SMALL), (Stop::NoNumber { line: 2, column: 8 }, 0));
    let text = "axiom: A(1)\nA(x) --> F : x-1\nA(x) --> G : 0*x";
    assert_eq!(end(text, SMALL), (Stop::NoProbability { line: 2, column: 1 }, 0));
    let text = "axiom: A(1)\nA(x) --> F : -x\nA(x) --> G : 3";
    assert_eq!(end(text, SMALL), (Stop::NoProbability { line: 2, column: 1 }, 0));
}

#[test]
fn too_much_wood_is_not_drawn() {
    let drawn = |axiom: &str| {
        let derivation = begun(&format!("axiom: {axiom}"), Limits::default()).expect("it is small");
        derivation.draw(&OpenSky, WoodOptions { nodes: 1000, extent: 5000, twig_radius: 0.05 })
    };
    assert_eq!(drawn("F(999)").map(|drawn| drawn.wood.nodes.len()), Ok(1000));
    assert_eq!(drawn("F(1000)"), Err(Stop::Nodes(1000)));
    assert_eq!(drawn("F(1e9)"), Err(Stop::Nodes(1000)));
    assert_eq!(drawn("F(1e300)"), Err(Stop::Extent(5000)));
    assert_eq!(drawn("f(6000)F"), Err(Stop::Extent(5000)));
    assert_eq!(drawn("f(1e300)f(1e300)f(1e308)f(1e308)F"), Err(Stop::Extent(5000)));
    assert_eq!(drawn("nF(1e9, 1e-9)"), Err(Stop::Nodes(1000)));
}

#[test]
fn what_was_derived_before_a_budget_ended_stays() {
    let mut derivation = begun("axiom: F\nF --> FFFFFFFF", SMALL).expect("it is small");
    while derivation.advance(&OpenSky, 7).is_ok() {}
    assert_eq!((derivation.depth(), derivation.word().len()), (3, 512));
    let mut whole = begun("axiom: F\nF --> FFFFFFFF", SMALL).expect("it is small");
    assert_eq!(whole.step(&OpenSky), Ok(()));
    assert_eq!(whole.advance(&OpenSky, 3), Ok(Progress::Working));
    assert_eq!((whole.depth(), whole.word().len()), (1, 8), "a step that goes on does not show");
}

#[test]
fn each_end_has_a_sentence_of_its_own_with_its_values() {
    let stops = [
        Stop::Modules(11),
        Stop::Parameters(11),
        Stop::Nesting(11),
        Stop::Work(11),
        Stop::NoNumber { line: 11, column: 12 },
        Stop::NoProbability { line: 11, column: 12 },
        Stop::Endless { line: 11, column: 12, most: 13 },
        Stop::Single(11),
        Stop::Read(11),
        Stop::Nodes(11),
        Stop::Extent(11),
        Stop::Full,
        Stop::World(11),
        Stop::Broken,
        Stop::Counted,
    ];
    let rows: Vec<&str> = WORDINGS.iter().filter(|row| row.kind() == "ends").map(|row| row.id).collect();
    let told: Vec<&str> = stops.iter().map(|stop| stop.sentence().0.id).collect();
    assert_eq!(told, rows, "a row for each, and none besides");
    for stop in stops {
        let (text, (_, values)) = (stop.to_string(), stop.sentence());
        assert!(
            !text.contains(['{', '}']) && values.iter().all(|(_, value)| text.contains(&**value)),
            "{text}"
        );
    }
}
