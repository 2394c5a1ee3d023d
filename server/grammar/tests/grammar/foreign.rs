//! What belongs to Python and to C is called by its name, with what to write instead.

use espalier_grammar::Grammar;

/// A piece of another language in a text, its kind, and what stands in the sentence.
const CONSTRUCTS: &[(&str, &str, &str)] = &[
    // Python, as files of L-Py have it.
    ("import random", "python", "`import`"),
    ("from math import *", "python", "`from`"),
    ("f = lambda x: x*2", "python", "`lambda`"),
    ("A(x) --> F(lambda y: y)", "python", "`lambda`"),
    ("total = sum([1, 2, 3])", "python", "`sum(…)`"),
    ("A(x) --> F(sum([x, 1]))", "python", "`[`"),
    ("A(x) --> F(len(x))", "python", "`len(…)`"),
    ("tree = AxialTree('F')", "python", "`AxialTree(…)`"),
    ("A(x) --> F(AxialTree(x))", "python", "`AxialTree(…)`"),
    ("squares = [x*x for x in range(5)]", "python", "a list made by `for`"),
    ("A(x) --> F([y for y in x])", "python", "a list made by `for`"),
    ("widths = [1, 2, 3]", "python", "`widths`"),
    ("A(x) --> F([1, 2])", "python", "`[`"),
    ("A(x) --> F('leaf')", "python", "a text in quotes"),
    ("r = random()", "python", "`random(…)`"),
    ("A(x) --> F(uniform(1, x))", "python", "`uniform(…)`"),
    ("A(x) --> F(randint(1, 6))", "python", "`randint(…)`"),
    ("A(x) --> F(gauss(1, x))", "python", "`gauss(…)`"),
    ("def f(x): return x", "python", "`def`"),
    ("for i in range(3):", "python", "`for`"),
    ("while True:", "python", "`while`"),
    ("if x > 3:", "python", "`if`"),
    ("try:", "python", "`try`"),
    ("assert x > 2", "python", "`assert`"),
    ("A(x) :\n  if x > 2: produce F(x)", "python", "goes on in Python"),
    ("A(x) : x > 2 and x < 4 --> F(x)", "python", "`and`"),
    ("A(x) : not x --> F(x)", "python", "`not`"),
    ("x = True", "python", "`True`"),
    ("A(x) : x > 2 & x < 4 --> F(x)", "python", "`&`"),
    ("A(x) : x > 2 | x < 4 --> F(x)", "python", "`|`"),
    ("A(x) --> F(x)Left(60)A(x)", "python", "`Left`"),
    ("A(x) ==> F(x)", "no-rule", "`==>`"),
    ("F => FF", "no-rule", "`=>`"),
    ("ω : F", "no-rule", "`ω`"),
    ("p1 : A(x) --> F(x)", "no-rule", "`p1`"),
    ("angle factor: 16", "no-rule", "`angle factor`"),
    // C, as files of cpfg and L+C have it.
    ("#include <math.h>", "c", "`#include`"),
    ("int steps = 3;", "c", "`int`"),
    ("float f(float x) { return x; }", "c", "`float`"),
    ("const double pi = 3.14;", "c", "`const`"),
    ("static int count;", "c", "`static`"),
    ("unsigned n;", "c", "`unsigned`"),
    ("void grow(int x) {", "c", "`void`"),
    ("struct leaf { float length; };", "c", "`struct`"),
    ("typedef float length;", "c", "`typedef`"),
    ("enum kind { bud, leaf };", "c", "`enum`"),
    ("switch (x) {", "c", "`switch`"),
    ("do {", "c", "`do`"),
    ("x++;", "c", "`++`"),
    ("array widths[3] = {1, 2, 3};", "c", "`array`"),
    ("#define TWICE(x) (2*x)", "c", "`TWICE(…)`"),
    ("A(x) --> F(int(x))", "c", "`int(…)`"),
    ("A(x) --> F(rand(x))", "python", "`rand(…)`"),
    ("if (x > 3) {", "python", "`if` is Python or C"),
    ("for (i = 0; i < 3; i = i+1)", "python", "`for` is Python or C"),
    ("return x;", "python", "`return` is Python or C"),
    ("A(x) --> F(\"leaf\")", "python", "Python or C"),
    ("printf(\"%d\", x);", "python", "`printf(…)` is a call of Python or C"),
];

#[test]
fn constructs_of_python_and_c_are_called_by_their_names() {
    for &(construct, kind, named) in CONSTRUCTS {
        let text = format!("axiom: A(1)\n{construct}\n");
        let found = Grammar::read(&text).expect_err(construct);
        let first = found.first().expect("something is told");
        assert_eq!((first.code, first.line), (kind, 2 + u32::from(first.line > 2)), "{construct}: {first}");
        assert!(first.message.contains(named), "{construct}: {first}");
        assert!(first.hint.as_deref().is_some_and(|hint| !hint.is_empty()), "{construct}: {first}");
    }
}

#[test]
fn numbers_may_be_called_as_words_of_other_languages_are() {
    for name in ["long", "short", "case", "pass", "do", "with", "try"] {
        let text = format!("{name} = 2\naxiom: F({name})\n");
        assert!(Grammar::read(&text).is_ok(), "{name}");
    }
}

#[test]
fn a_block_of_python_is_told_once() {
    let text = "axiom: A(1)\nA(x) :\n  y = len(x)\n\n  if y > 2:\n    produce F(y)\n  else:\n    produce *\nB --> F\n";
    let found = Grammar::read(text).expect_err("it is Python");
    let places: Vec<_> = found.iter().map(|one| (one.code, one.line)).collect();
    assert_eq!(places, [("python", 2)], "{found:?}");
}
