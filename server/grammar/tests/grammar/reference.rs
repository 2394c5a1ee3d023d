//! Words that were written down by hand. `tests/lpy/compare.py` holds L-Py to the same ones, where it is installed.

use super::words::derived;

/// Name, depth, axiom, rules and word of each case.
fn cases() -> impl Iterator<Item = [&'static str; 5]> {
    let lines = include_str!("../lpy/cases.txt").lines();
    lines.filter(|line| !line.starts_with('#')).map(|line| {
        let fields: Vec<&str> = line.split('|').map(str::trim).collect();
        fields.try_into().expect("five fields")
    })
}

#[test]
fn words_are_those_that_were_written_down() {
    assert!(cases().count() >= 10);
    for [name, depth, axiom, rules, word] in cases() {
        let rules: Vec<&str> = rules.split(";;").map(str::trim).collect();
        // Signs are modules like others in these cases, and are not looked past.
        let text = format!("angle: 30\nignore: + -\naxiom: {axiom}\n{}\n", rules.join("\n"));
        assert_eq!(derived(&text, depth.parse().expect("a depth")), word, "{name}");
    }
}
