//! Each limit of a text holds to its last, and one more is refused.

use espalier_grammar::{Grammar, MAX_TEXT};

/// The kinds of what is said of a text, warnings included.
fn told(text: &str) -> Vec<&'static str> {
    Grammar::check(text).diagnostics.iter().map(|one| one.id).collect()
}

#[track_caller]
fn refused(text: &str, id: &str) {
    let checked = Grammar::check(text);
    assert!(checked.grammar.is_none(), "it is read");
    let first = checked.diagnostics.first().map(|one| one.id);
    assert_eq!(first, Some(id), "{}", &text[..text.len().min(200)]);
}

#[track_caller]
fn read(text: &str) {
    assert!(Grammar::check(text).grammar.is_some(), "{:?}: {}", told(text), &text[..text.len().min(200)]);
}

fn numbers(count: usize) -> String {
    (1..=count).map(|number| number.to_string()).collect::<Vec<_>>().join(",")
}

#[test]
fn modules_have_sixteen_parameters() {
    let names = |count: usize| (0..count).map(|one| format!("p{one}")).collect::<Vec<_>>().join(",");
    read(&format!("axiom: A({})\nA({}) --> F(p15)", numbers(16), names(16)));
    refused(&format!("axiom: A({})", numbers(17)), "parameter-count.most");
    refused(&format!("axiom: A\nA({}) --> F", names(17)), "parameter-count.most");
}

#[test]
fn branches_lie_sixty_four_deep_in_each_other_in_one_string() {
    let nested = |depth: usize| format!("axiom: {}F{}", "[".repeat(depth), "]".repeat(depth));
    read(&nested(64));
    refused(&nested(65), "too-long.string");
}

#[test]
fn expressions_lie_no_deeper_than_they_may() {
    let nested = |depth: usize| format!("axiom: F({}1{})", "(".repeat(depth), ")".repeat(depth));
    read(&nested(40));
    refused(&nested(60), "too-deep.levels");
    refused(&format!("axiom: F(1{})", "+1".repeat(300)), "too-deep.chain");
}

#[test]
fn texts_strings_and_rules_are_no_longer_than_they_may() {
    let padded = |length: usize| {
        let text = "axiom: F\n";
        format!("{text}{}", "#".repeat(length - text.len()))
    };
    read(&padded(MAX_TEXT));
    refused(&padded(MAX_TEXT + 1), "too-long.file");
    read(&format!("axiom: {}", "F".repeat(10_000)));
    refused(&format!("axiom: {}", "F".repeat(10_001)), "too-long.string");
    let rules = |count: usize| format!("axiom: A(1)\n{}", "A(x) : x > 1 --> F(x)\n".repeat(count));
    read(&rules(1000));
    refused(&rules(1001), "too-many-rules");
}

#[test]
fn macros_do_not_go_off() {
    // Each stands for two of the one before: nothing in the end, or many modules.
    let doubling = |last: &str| {
        let names = ["LA", "LB", "LC", "LD", "LE", "LG", "LH", "LI", "LJ", "LK", "LM", "LN"];
        let lines: String =
            names.windows(2).map(|pair| format!("#define {} {} {}\n", pair[1], pair[0], pair[0])).collect();
        format!("#define LA {last}\n{lines}")
    };
    read(&format!("{}axiom: LI", doubling("F F")));
    refused(&format!("{}axiom: LN LN LN LN LN LN", doubling("F F")), "too-long.string");
    let many = "A --> LN LN LN LN\n".repeat(900);
    refused(&format!("{}axiom: A\n{many}", doubling("F")), "too-long.string");
}

#[test]
fn within_a_step_rules_go_on_as_often_as_their_section_says() {
    for section in ["decomposition", "homomorphism"] {
        read(&format!("axiom: A\n{section}: maximum depth: 100\nA --> FA"));
        let text = format!("axiom: A\n{section}: maximum depth: 101\nA --> FA");
        assert_eq!(told(&text), ["out-of-range.depth-taken"], "it is told, and read as 100");
        refused(&format!("axiom: A\n{section}: maximum depth: 0\nA --> FA"), "out-of-range.maximum-depth");
    }
}

#[test]
fn numbers_of_headers_are_in_their_ranges() {
    for (line, id) in [
        ("derivation length: 1001", "out-of-range.depth"),
        ("derivation length: 1/0", "out-of-range.depth"),
        ("scale: 0", "out-of-range.scale"),
        ("scale: ln(-1)", "out-of-range.scale"),
        ("angle: 1/0", "out-of-range.angle"),
        ("dt: 0", "out-of-range.dt"),
        ("seed: -1", "out-of-range.seed"),
        ("timing: A 1e9", "out-of-range.lifespan"),
        ("a = 10^400", "out-of-range.finite"),
        ("a = 1/0", "out-of-range.finite"),
        ("a = ran(1)", "out-of-range.unsteady"),
    ] {
        refused(&format!("{line}\naxiom: A\nA --> F"), id);
    }
    read("derivation length: 1000\naxiom: A\nA --> F");
    let checked = Grammar::check("axiom: A\nA --> F\ntiming: A 1, B 0\nB --> F");
    let place = checked.diagnostics.first().map(|one| (one.id, one.line, one.column, one.length));
    assert_eq!(place, Some(("out-of-range.lifespan", 3, 14, 1)));
}

#[test]
fn a_predecessor_has_up_to_sixty_four_parameters_with_its_contexts() {
    let module = |name: char, from: usize, count: usize| {
        let names: Vec<String> = (from..from + count).map(|at| format!("p{at}")).collect();
        format!("{name}({})", names.join(","))
    };
    let rule = |more: usize| {
        let left = [module('A', 0, 16), module('B', 16, 16)].concat();
        let right = [module('D', 48, 16), module('E', 64, more)].concat();
        let right = if more == 0 { module('D', 48, 16) } else { right };
        format!("axiom: F\n{left} < {} > {right} --> F(p63)", module('C', 32, 16))
    };
    read(&rule(0));
    refused(&rule(1), "parameter-count.contexts");
}
