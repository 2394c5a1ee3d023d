//! Whatever the bytes are, they give a grammar or what is wrong with them.

use std::sync::Arc;

use espalier_grammar::{Derivation, Diagnostic, Grammar, Limits, MAX_TEXT, OpenSky, SHIPPED, WoodOptions};
use espalier_plant::hash::StableHash;

/// Numbers for tests, always the same.
struct Dice(StableHash);

impl Dice {
    fn new(seed: u64) -> Self {
        let mut hash = StableHash::default();
        hash.word(seed);
        Self(hash)
    }

    fn below(&mut self, bound: usize) -> usize {
        self.0.word(1);
        (self.0.finish() % bound as u64) as usize
    }
}

const SMALL: Limits = Limits { modules: 3000, parameters: 6000, nesting: 64, work: 200_000 };

/// Reads, derives and draws what can be.
fn try_all(bytes: &[u8]) {
    let checked = Grammar::check_bytes(bytes);
    let text = String::from_utf8_lossy(bytes);
    let lines: Vec<&str> = text.split('\n').collect();
    for Diagnostic { line, column, length, message, .. } in &checked.diagnostics {
        let found = lines.get(*line as usize - 1).unwrap_or_else(|| panic!("no line {line}: {message}"));
        let end = (column - 1 + length) as usize;
        assert!(end <= found.chars().count(), "line {line} ends before {end}: {message}\n{text}");
    }
    let Some(grammar) = checked.grammar else {
        assert!(!checked.diagnostics.is_empty());
        return;
    };
    let program = grammar.program(&[]).expect("the values of a file are in range");
    let Ok(mut derivation) = Derivation::new(Arc::new(program), 1, SMALL) else { return };
    for _ in 0..4 {
        let _ended = derivation.step(&OpenSky);
        let options = WoodOptions { nodes: 3000, extent: 500, twig_radius: 0.05 };
        if let Ok(drawn) = derivation.draw(&OpenSky, options) {
            assert!(drawn.wood.nodes.iter().all(|node| node.end.is_finite()));
        }
    }
}

#[test]
fn a_million_bytes_of_nonsense() {
    let mut dice = Dice::new(1);
    let alphabet = b"FAB[]()+-&^<>:-->0123.,%!?=*/ \n\t#@~{}abcstep light;|$'_\\\"\xc3\xa4\xff";
    let mut bytes = 0;
    while bytes < 1_000_000 {
        let length = dice.below(400);
        let any = dice.below(4) == 0;
        let text: Vec<u8> = (0..length)
            .map(|_| if any { dice.below(256) as u8 } else { alphabet[dice.below(alphabet.len())] })
            .collect();
        try_all(&text);
        bytes += length + 1;
    }
}

#[test]
fn a_text_that_is_too_long_ends_within_a_character() {
    for before in MAX_TEXT - 3..=MAX_TEXT {
        let text = format!("axiom: F\n# {}{}", "x".repeat(before - 11), "\u{10330}\u{e4}".repeat(4));
        try_all(text.as_bytes());
        assert_eq!(Grammar::check(&text).diagnostics.len(), 1, "{before}");
    }
}

#[test]
fn a_mark_before_the_first_line_is_no_part_of_it() {
    let checked = Grammar::check("\u{feff}axiom: F(1)\n");
    assert!(checked.grammar.is_some(), "{:?}", checked.diagnostics);
}

#[test]
fn damaged_grammars() {
    let mut dice = Dice::new(2);
    for shipped in SHIPPED {
        for _ in 0..60 {
            let mut bytes = shipped.text.as_bytes().to_vec();
            for _ in 0..=dice.below(4) {
                let at = dice.below(bytes.len());
                let other = dice.below(bytes.len());
                match dice.below(5) {
                    0 => bytes[at] = dice.below(128) as u8,
                    1 => bytes.truncate(at.max(1)),
                    2 => bytes.swap(at, other),
                    3 => drop(bytes.drain(at.min(other)..at.max(other).min(at.min(other) + 9))),
                    _ => {
                        let piece = bytes[at.min(other)..at.max(other).min(at.min(other) + 30)].to_vec();
                        bytes.splice(at..at, piece);
                    }
                }
                if bytes.is_empty() {
                    bytes.push(b'F');
                }
            }
            try_all(&bytes);
        }
    }
}

#[test]
fn depths_and_lengths_end() {
    for (open, close) in
        [("(", ")"), ("-", ""), ("!", ""), ("[", "]"), ("sin(", ")"), ("1+(", ")"), ("1?1:", "")]
    {
        for times in [10, 100, 10_000] {
            let (before, after) = (open.repeat(times), close.repeat(times));
            try_all(format!("axiom: F({before}1{after})").as_bytes());
            try_all(format!("axiom: A\nA --> {before}F{after}").as_bytes());
            try_all(format!("axiom: A\nA > {before}F{after} --> F").as_bytes());
            try_all(format!("axiom: A\nA : {before}1{after} --> F").as_bytes());
        }
    }
    for operator in ["+", "*", "^", "<", "&&"] {
        try_all(format!("axiom: F(1{})", format!("{operator}1").repeat(20_000)).as_bytes());
    }
    let text = "axiom: F\n".to_owned() + &"F --> F\n".repeat(2000);
    assert!(Grammar::check(&text).diagnostics.iter().any(|one| one.code == "too-many-rules"));
    let text = " ".repeat(MAX_TEXT + 1);
    assert_eq!(Grammar::check(&text).diagnostics[0].code, "too-long");
    assert_eq!(Grammar::check_bytes(b"axiom: F\nF --> \xff").diagnostics[0].code, "no-text");
}
