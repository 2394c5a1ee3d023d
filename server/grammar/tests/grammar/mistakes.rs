//! What is wrong with a text is told with its place, and with what to write instead.

use std::collections::BTreeSet;

use espalier_grammar::{Diagnostic, Grammar, MAX_DIAGNOSTICS, Severity, WORDINGS};

fn told(text: &str) -> Vec<Diagnostic> {
    Grammar::check(text).diagnostics
}

/// The only thing that is wrong with a text: kind, line, column, length.
fn only(text: &str) -> (&'static str, u32, u32, u32) {
    match &*told(text) {
        [one] => (one.code, one.line, one.column, one.length),
        other => panic!("{text}\n{other:#?}"),
    }
}

#[test]
fn each_mistake_is_told_at_its_place() {
    let cases = [
        ("axiom: F\nF --> FG]", ("bracket", 2, 9, 1)),
        ("axiom: F\nF --> F[F", ("bracket", 2, 8, 1)),
        ("axiom: F\nF --> F]F[", ("bracket", 2, 8, 1)),
        ("axiom: F\nF(x) --> F(sni(x))", ("unknown-function", 2, 12, 3)),
        ("axiom: F\nF(x) --> F(sin(x, 2))", ("parameter-count", 2, 12, 3)),
        ("axiom: F\nF(x) --> F(y)", ("unknown-name", 2, 12, 1)),
        ("axiom: F\nF(x) --> F(x", ("missing", 2, 13, 0)),
        ("axiom: F\nF(x) --> F(x*)", ("no-expression", 2, 14, 1)),
        ("axiom: F\nF(x) --> F()x)", ("no-symbol", 2, 14, 1)),
        ("axiom: F\nF(x) : x = 3 --> F(x)", ("assignment", 2, 10, 1)),
        ("axiom: F\nF(x) : x > 3 and x < 5 --> F(x)", ("python", 2, 14, 3)),
        ("axiom: F\nF(x) : not x --> F(x)", ("python", 2, 8, 3)),
        ("axiom: F\nF(x, x) --> F(x)", ("twice", 2, 6, 1)),
        ("axiom: F\nF(3) --> F", ("no-name", 2, 3, 1)),
        ("axiom: F\nF -> FF", ("no-rule", 2, 1, 7)),
        ("axiom: F\nangle 30", ("no-rule", 2, 1, 5)),
        ("axiom: F\nderivation length 30", ("no-rule", 2, 1, 17)),
        ("axiom: F\n#define a 30;", ("c", 2, 13, 1)),
        ("axiom: F\nF --> F --> F", ("two-arrows", 2, 9, 3)),
        ("axiom: F\nF G --> F", ("predecessor", 2, 3, 2)),
        ("axiom: F\nspikem --> F", ("predecessor", 2, 1, 6)),
        ("axiom: F\nA < spike(x) --> F", ("predecessor", 2, 5, 5)),
        ("axiom: F@Zz(1)", ("no-symbol", 1, 9, 3)),
        ("axiom: F(func(1, 2))", ("unknown-curve", 1, 15, 1)),
        ("axiom: F\n#define R ratoi\n", ("unknown-name", 2, 11, 5)),
        ("axiom: F(R)\n#define R [F]\n", ("unknown-name", 1, 10, 1)),
        ("axiom: R\n#define R [F]R\n", ("c", 2, 14, 1)),
        ("axiom: F\nseed: -1", ("out-of-range", 2, 1, 5)),
        ("axiom: F\n[ --> F", ("bracket", 2, 1, 1)),
        ("axiom: F\nA < B < C --> F", ("bad-context", 2, 1, 10)),
        ("axiom: F\nA[B] < F --> F", ("bad-context", 2, 1, 5)),
        ("axiom: F\nF --> F2", ("no-symbol", 2, 8, 1)),
        ("axiom: F\nF --> F ~ F", ("no-symbol", 2, 9, 1)),
        ("axiom: F\naxiom: F", ("twice", 2, 1, 6)),
        ("F --> F", ("no-axiom", 1, 1, 0)),
        ("axiom: F\na = 1\na = 2", ("twice", 3, 1, 1)),
        ("axiom: F\nslider: b 1 2", ("unknown-name", 2, 9, 1)),
        ("axiom: F\na = 1\nslider: a 2 1", ("empty-range", 3, 9, 1)),
        ("axiom: F\na = 5\nslider: a 1 2", ("out-of-range", 2, 1, 1)),
        ("axiom: F\na = 1/0", ("out-of-range", 2, 1, 1)),
        ("axiom: F\na = ran(1)", ("out-of-range", 2, 1, 1)),
        ("axiom: F\nscale: 0", ("out-of-range", 2, 1, 6)),
        ("axiom: F\nderivation length: 2.5", ("out-of-range", 2, 1, 18)),
        ("axiom: F\nbuds: many", ("no-choice", 2, 7, 4)),
        ("axiom: F\nfunc: f 0 1 0 2", ("bad-curve", 2, 7, 1)),
        ("axiom: F(func(g, 1))", ("unknown-curve", 1, 15, 1)),
        ("axiom: F\nmaximum depth: 3", ("misplaced", 2, 1, 14)),
        ("axiom: F\nhomomorphism:\nA < F --> F", ("misplaced", 3, 1, 6)),
        ("axiom: @R(1)", ("parameter-count", 1, 8, 2)),
        ("axiom: F\nF --> F : 0\nF --> G : 0", ("no-probability", 2, 1, 11)),
        ("axiom: F\nF --> (0.5) F : 0.5", ("twice", 2, 15, 5)),
        ("axiom: F\nF --> F + a b\n1.5", ("no-rule", 3, 1, 3)),
    ];
    for (text, wanted) in cases {
        if text.contains("a b") {
            // Letters that do nothing are told as well.
            assert!(told(text).iter().any(|one| (one.code, one.line, one.column, one.length) == wanted));
            continue;
        }
        let errors: Vec<_> = told(text).into_iter().filter(|one| one.severity == Severity::Error).collect();
        let first = errors.first().unwrap_or_else(|| panic!("nothing is told of {text}"));
        assert_eq!((first.code, first.line, first.column, first.length), wanted, "{text}\n{errors:#?}");
    }
}

#[test]
fn what_is_near_is_offered() {
    let hint = |text: &str| told(text).remove(0).hint;
    assert_eq!(hint("axiom: F(sqr(4))").as_deref(), Some("did you mean sqrt?"));
    assert_eq!(hint("angel = 3\naxiom: F(angle)").as_deref(), Some("did you mean angel?"));
    assert_eq!(hint("axiom: F\nF -> G").as_deref(), Some("rules have the arrow -->"));
    assert_eq!(hint("axiom F[+F] G").as_deref(), Some("write axiom: F[+F] G"));
    assert_eq!(hint("axiom: F\n#define a 30;").as_deref(), Some("write #define a 30"));
    assert_eq!(hint("axiom: F(k)").as_deref(), Some("define it on a line of its own: k = 1"));
    assert_eq!(told("axiom: F(light)"), [], "a function without parameters needs no parentheses");
}

#[test]
fn other_languages_are_called_by_their_names() {
    let cases = [
        ("axiom: F\nfrom math import *", "python"),
        ("axiom: F\ndef f(x): return x", "python"),
        ("axiom: F\nA(x) :", "python"),
        ("axiom: F\nif x > 3:", "python"),
        ("axiom: F\nproduce F", "python"),
        ("axiom: F\nStart: { x = 0; }", "cpfg-statements"),
        ("axiom: F\nF(x) : { while (x) { } } --> F", "cpfg-statements"),
        ("axiom: F\na = 1\nF(x) : { a = 2; } --> F", "cpfg-statements"),
        ("axiom: F\nF(x) : { y += 2; } --> F", "cpfg-statements"),
        ("axiom: F\nF(x) --> y = x; produce F(y)", "cpfg-statements"),
        ("axiom: F\narray widths[3] = {1, 2, 3};", "c"),
        ("axiom: F\n#define TWICE(x) (2*x)", "c"),
        ("axiom: F\nwidths = [1, 2, 3]", "python"),
        ("axiom: F\nrandom.seed(3)", "python"),
        ("axiom: F\nsetSeed(3)", "python"),
        ("axiom: F\nendgroup", "groups"),
        ("axiom: F\n#include <x.h>", "c"),
        ("axiom: F\ndouble x;", "c"),
        ("axiom: F\ngroup 1:", "groups"),
        ("axiom: F\nA << F --> F", "new-context"),
    ];
    for (text, wanted) in cases {
        let found = told(text);
        let last = text.trim_end().lines().count() as u32;
        let is_told = |one: &Diagnostic| {
            one.code == wanted && one.hint.is_some() && (one.line == 2 || one.line == last)
        };
        assert!(found.iter().any(is_told), "{text}\n{found:#?}");
    }
}

#[test]
fn what_is_outside_the_language_is_named_and_its_way_in_is_told() {
    let cases = [
        (
            "axiom: F\nspikem --> F",
            "a rule rewrites one module, and `spikem` is read as 6 of one letter each",
            "declare the name above: module spikem",
        ),
        (
            "axiom: F(func(2, 0.5))",
            "curve 2 lies in another file of cpfg",
            "write its points into this one: func: 2 0 0 0.5 0.8 1 1",
        ),
        (
            "#define TWICE(x) (2*x)\naxiom: F",
            "`TWICE(…)` is a macro with parameters, which is not read",
            "write what it stands for into the rules, or make a rule of it",
        ),
        (
            "axiom: F\narray w[3];",
            "`array` is a row of numbers of cpfg, which is not read",
            "give each number a name of its own, or make a curve of them: func: name 0 1 1 2",
        ),
        (
            // As L-Py writes nearly all of its rules.
            "axiom: A(1)\nA(x) :\n    produce F(x) A(x+1)",
            "a rule that ends with `:` goes on in Python, which is not run here",
            "write the successor behind the arrow: A(x) --> F(x)",
        ),
        (
            "axiom: A\nA :\n  if x > 1:\n    produce F",
            "a rule that ends with `:` goes on in Python, which is not run here",
            "write the successor behind the arrow: A(x) --> F(x)",
        ),
        (
            "axiom: F(1)\nF(x) : produce F(x/3)+(60)F(x/3)",
            "`produce` is Python, which is not run here",
            "write the successor behind the arrow: A --> F",
        ),
        ("SHOWN = False\naxiom: F", "`False` is Python, and definitions are numbers", "write 0"),
        (
            "c = curve.deepcopy()\naxiom: F",
            "`curve.deepcopy(…)` is a call of Python, which is not run here",
            "definitions are numbers: R = 1.5",
        ),
        (
            "axiom: F(bran(2, 3))",
            "`bran` is a function of cpfg that is not known here",
            "docs/grammars.md lists the functions",
        ),
        (
            "t = 1\naxiom: A(1)\nA(x) : {t = x;} --> F(t)",
            "statements cannot change `t`, which is defined for all rules",
            "give the number a new name: A(x) : {y = x+1;} --> F(y)",
        ),
        ("axiom: F\nF(x) : {n = n(x);} --> F", "there is no function `n`", "did you mean ln?"),
        (
            "axiom: F\nF(x) : {if (x) y = 1;} --> F",
            "`if` is a statement, and none is run here",
            "in braces only numbers are given names: A(x) : {y = 2*x;} --> F(y)",
        ),
        (
            "axiom: F@Q(2)",
            "`@Q` is no symbol that the turtle knows here",
            "docs/grammars.md lists the names that begin so",
        ),
    ];
    for (text, message, hint) in cases {
        let found = told(text);
        let first = &found[0];
        assert_eq!((&*first.message, first.hint.as_deref()), (message, Some(hint)), "{text}\n{found:#?}");
    }
}

/// What stands in braces in a sentence and is no value, but how something is written.
const WORDINGS_WITH_BRACES: &[&str] = &["{y = 2*x;}", "{y = x+1;}"];

#[test]
fn every_sentence_has_its_values() {
    // What stands in braces has a value, and every value has its braces, in all that the tests of this file provoke.
    let source = include_str!("mistakes.rs");
    let texts = source.split('"').filter(|text| text.contains("axiom")).map(|text| text.replace("\\n", "\n"));
    let mut seen = 0;
    for found in texts.flat_map(|text| told(&text)) {
        let row = WORDINGS.iter().find(|row| row.id == found.id).expect("it is in the table");
        assert_eq!(row.kind(), found.code);
        let template = format!("{}{}", row.message, row.hint.unwrap_or_default());
        for (_, value) in &found.values {
            assert!(!value.is_empty(), "{found}");
        }
        let named = found.values.iter().filter(|(name, _)| template.contains(&format!("{{{name}}}")));
        let without = WORDINGS_WITH_BRACES.iter().filter(|sign| template.contains(**sign)).count();
        let names: BTreeSet<_> =
            template.split('{').skip(1).filter_map(|rest| rest.split_once('}')).collect();
        let names: BTreeSet<_> = names.into_iter().map(|(name, _)| name).collect();
        assert_eq!(named.count(), names.len() - without, "{}", found.id);
        seen += 1;
    }
    assert!(seen > 80, "{seen}");
}

#[test]
fn one_mistake_does_not_hide_the_next() {
    let text = "axiom: F(\nF --> F]\nscale: x\nG(a) --> G(b)\nA -> B";
    let lines: Vec<u32> = told(text).iter().map(|one| one.line).collect();
    assert_eq!(lines, [1, 2, 3, 4, 5]);
    let many = "axiom: F\n".to_owned() + &"F --> ]\n".repeat(200);
    assert_eq!(told(&many).len(), MAX_DIAGNOSTICS);
}

#[test]
fn what_does_nothing_is_a_warning() {
    let cases = [
        ("axiom: FQ\nF --> F", ("does-nothing", 1, 9, 1)),
        ("axiom: F~a\nF --> F", ("surface-as-leaf", 1, 9, 2)),
        ("axiom: F@o\nF --> F", ("not-drawn", 1, 9, 2)),
        ("axiom: F{.f.F\nF --> F", ("does-nothing", 1, 9, 1)),
        ("axiom: AB\nA --> A\nB --> B\nhomomorphism:\nA --> F(1)B\nB --> F(2)", ("does-nothing", 5, 11, 1)),
        ("axiom: F;\nF --> F", ("not-drawn", 1, 9, 1)),
        ("axiom: F+F\nF --> F", ("no-angle", 1, 9, 1)),
        ("axiom: A\nA --> F\nA --> G", ("never-fires", 3, 1, 7)),
        ("axiom: A(1)\nA --> F", ("parameter-count", 1, 8, 1)),
    ];
    for (text, wanted) in cases {
        assert_eq!(only(text), wanted, "{text}");
        assert!(Grammar::read(text).is_ok(), "a warning hinders nobody: {text}");
    }
    // A rule behind one with a condition fires, and so do alternatives; contexts give letters a meaning.
    let fine = "axiom: A(1)MB\nA(x) : x > 1 --> F\nA(x) --> F : 1\nA(x) --> G : 2\nM < B --> F";
    assert_eq!(told(fine), []);
}

#[test]
fn files_of_both_worlds_are_read() {
    // As cpfg has them, and as L-Py does.
    let cpfg = "Lsystem: 1\n#define STEPS 3\n#define r 0.5 /* how far */\nderivation length: STEPS\nignore: +-\n\
        axiom: A(1)\nA(x) : x > 0.1 --> F(x)[+(30)A(x*r)]-(30)A(x*r) : 0.9\n\
        A(x) : x > 0.1 --> F(x) : 0.1\nA(x) : * --> F(x)\nhomomorphism\nmaximum depth: 2\nF(x) : * --> !(x)F(x)\nendlsystem\nanything";
    assert_eq!(told(cpfg), []);
    let lpy = "module Apex, Leaf(1)\nr = 0.7 # ratio\nAxiom: Apex(1)\nderivation length: 4\nproduction:\n\
        Apex(x) --> nF(x, 0.2)[/(90)&(30)Apex(x*r)]Leaf(x)\ninterpretation:\nmaximum depth: 2\nLeaf(x) --> [_(x)F(x**2)]\nendlsystem\n\
        ###### INITIALISED BY L-PY ######\n__lpy_code_version__ = 1.1\n";
    assert_eq!(told(lpy), []);
    let pfg =
        "Lsystem: 1\nderivation length: 3\nangle increment: 30\naxiom: F\nF --> F[+F]F[-F]F\nendlsystem\n";
    assert_eq!(told(pfg), []);
    // A word of L-Py that is declared is a module like any other.
    assert_eq!(told("module Left\naxiom: Left(1)\nLeft(x) --> F(x)Left(x+1)\n"), []);
}

#[test]
fn curves_of_other_files_may_be_written_into_this_one() {
    assert_eq!(told("func: 1 0 0 1 2\naxiom: F(func(1, 0.5))"), []);
}

#[test]
fn deep_files_of_cpfg_are_read_as_deep_as_may_be() {
    let found = told("axiom: A\nhomomorphism:\nmaximum depth: 3000\nA --> F");
    assert_eq!(found.len(), 1, "{found:#?}");
    let first = &found[0];
    assert_eq!((first.severity, first.id), (Severity::Warning, "out-of-range.depth-taken"));
}
