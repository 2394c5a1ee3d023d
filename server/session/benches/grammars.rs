//! Grammars in documents: 100 k internodes derived and laid down, a slider on a plant of 10 k, a text that is checked.

mod support;

use std::time::{Duration, Instant};

use espalier_proto::{Action, CheckGrammar, Command, GrammarValue, List, Steps};
use espalier_session::{Document, Principal, check_grammar, grammar_script};
use support::{Cost, Followed, Percentiles};

const ROUNDS: usize = 15;

/// Grammars of about 100,000 internodes, as deep as that is.
const LARGE: [(&str, u32, &str); 2] = [
    (
        "two branches at each fork",
        16,
        "axiom: A(1.4,9)\nscale: 0.4\nA(l,w) --> !(w)F(l)[+(30)A(l*0.97,w*0.7)]/(137.5)[-(40)A(l*0.97,w*0.7)]",
    ),
    (
        "three branches, all wood lengthens",
        10,
        "axiom: !(1)F(1)A\nscale: 0.4\n\
         A --> !(1.7)F(0.5)[&(19)F(0.5)A]/(94.7)[&(19)F(0.5)A]/(132.6)[&(19)F(0.5)A]\n\
         F(l) --> F(l*1.1)\n!(w) --> !(w*1.7)",
    ),
];

/// About 10,000 internodes.
const SLID: &str = "slider: a 10 60\na = 30\naxiom: A(1.4)\nscale: 0.5\n\
                    A(l) --> F(l)[+(a)A(l*0.95)]/(137.5)[-(a)A(l*0.95)]";

fn main() {
    support::on_the_pool(bench);
}

fn bench() {
    println!("{:<42} {:>9} {:>9} {:>9}", "ms", "median", "p99", "most");
    for (what, depth, text) in LARGE {
        laid_down(what, depth, text);
    }
    slider();
    checks();
}

fn script(text: &str, depth: u32) -> Action {
    grammar_script(text, Some(Steps::nearest(depth))).expect("it is a grammar")
}

/// All steps from the axiom, each laid down in the document, without clients.
fn laid_down(what: &str, depth: u32, text: &str) {
    let (mut all, mut last) = (Vec::new(), Vec::new());
    let mut metamers = 0;
    for _ in 0..ROUNDS {
        let mut document = Document::new(1);
        document.set_metamer_budget(u32::MAX);
        let mut apply =
            |action: Action| document.apply(&Principal::visitor(), &action.into()).expect("it can be done");
        let begun = Instant::now();
        apply(script(text, depth - 1));
        let before_last = Instant::now();
        apply(Action::Derive { steps: Steps::nearest(1) });
        last.push(before_last.elapsed());
        all.push(begun.elapsed());
        metamers = document.metamers();
    }
    println!("{what}: {metamers} internodes at depth {depth}");
    print("  all steps, each laid down", all);
    print("  the last step", last);
    let mut at_once = Vec::new();
    for _ in 0..ROUNDS {
        let mut document = Document::new(1);
        document.set_metamer_budget(u32::MAX);
        let mut apply =
            |action: Action| document.apply(&Principal::visitor(), &action.into()).expect("it can be done");
        apply(script("axiom: A", 1));
        let begun = Instant::now();
        // Without a position it takes the place of the grammar in force: one step, whatever the depth.
        apply(script(text, depth));
        at_once.push(begun.elapsed());
    }
    print("  derived to that depth, laid down once", at_once);
}

/// A slider dragged in one gesture, with the delta for a client.
fn slider() {
    let mut followed = Followed::tree(0);
    followed.act(&script(SLID, 13));
    println!("a slider on {} internodes", followed.document.metamers());
    let mut costs: Vec<Cost> = Vec::new();
    for value in 0..60 {
        let value = 30.0 + 0.25 * f64::from(value + 1);
        let values = vec![GrammarValue { name: "a".into(), value }];
        let values = List::try_from(values).expect("one value");
        let action = Action::SetGrammarValues { values };
        costs.push(followed.command(&Command { gesture: Some(7), ..action.into() }));
    }
    for (what, part) in [
        ("  a value, with its delta", Cost::total as fn(&Cost) -> Duration),
        ("    document", |cost| cost.act),
        ("    looks and table", |cost| cost.sync),
        ("    frame", |cost| cost.encode),
    ] {
        print(what, costs.iter().map(part).collect());
    }
}

/// What is wrong with a text of 2 KB, and how large it is at each depth.
fn checks() {
    let mut text = String::from("axiom: A(1)\nslider: a 10 60\na = 30\n");
    for number in 0.. {
        if text.len() >= 2000 {
            break;
        }
        text += &format!(
            "module B{number}\nB{number}(x) : x > {number} --> F(x)[+(a+{number})A(x*0.9)]/(137.5)B{number}(x-1)\n"
        );
    }
    text += "A(l) --> F(l)[+(a)A(l*0.9)]/(137.5)B1(l)\n";
    println!("a text of {} bytes", text.len());
    for (what, sizes) in [("  checked", false), ("  checked, with sizes", true)] {
        let wanted = CheckGrammar { text: text.clone(), values: List::default(), seed: None, sizes };
        let mut times = Vec::new();
        for _ in 0..ROUNDS {
            let begun = Instant::now();
            let found = check_grammar(&wanted).expect("no values are set");
            times.push(begun.elapsed());
            assert!(found.depth.is_some(), "it has no errors: {:?}", found.diagnostics.first());
        }
        print(what, times);
    }
}

fn print(what: &str, times: Vec<Duration>) {
    println!("{what:<42} {}", Percentiles::of_milliseconds(times.into_iter()));
}
