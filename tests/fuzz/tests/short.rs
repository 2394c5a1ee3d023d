//! Damage of every kind to what each reader takes: the same in every run, and made as small as can be where it fails.
//!
//! What a hunt finds is kept as a file in `found/TARGET`, and tried here for ever.

use std::{cell::Cell, fs, path::Path};

use espalier_fuzz::{TARGETS, Target};
use proptest::{
    prelude::*,
    sample::Index,
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};

/// Words and numbers that readers have stumbled over.
const WORDS: [&[u8]; 16] = [
    b"null",
    b"-1",
    b"0",
    b"1e39",
    b"1e999",
    b"-0.0",
    b"0.5",
    b"4294967296",
    b"18446744073709551616",
    b"[]",
    b"{}",
    b"\"\"",
    b"true",
    b"\n",
    b"\xff\xff\xff\xff",
    b"\0\0\0\0\0\0\0\x80",
];

#[derive(Clone, Debug)]
enum Damage {
    Flip(Index, u8),
    Set(Index, u8),
    Cut(Index, usize),
    End(Index),
    Word(Index, usize),
    /// In the place of a number, if one stands there.
    Number(Index, usize),
    Repeat {
        from: Index,
        length: usize,
        at: Index,
    },
    /// The rest is that of another seed.
    Splice {
        at: Index,
        seed: Index,
        from: Index,
    },
}

fn damage() -> impl Strategy<Value = Damage> {
    let index = any::<Index>;
    prop_oneof![
        4 => (index(), 0u8..8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        2 => (index(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        2 => (index(), 1usize..24).prop_map(|(at, length)| Damage::Cut(at, length)),
        1 => index().prop_map(Damage::End),
        2 => (index(), 0..WORDS.len()).prop_map(|(at, word)| Damage::Word(at, word)),
        4 => (index(), 0..WORDS.len()).prop_map(|(at, word)| Damage::Number(at, word)),
        2 => (index(), 1usize..64, index()).prop_map(|(from, length, at)| Damage::Repeat { from, length, at }),
        1 => (index(), index(), index()).prop_map(|(at, seed, from)| Damage::Splice { at, seed, from }),
    ]
}

fn inflict(damage: &Damage, bytes: &mut Vec<u8>, seeds: &[Vec<u8>]) {
    let place = |index: &Index, bytes: &[u8]| index.index(bytes.len() + 1);
    let byte = |index: &Index, bytes: &[u8]| index.index(bytes.len().max(1));
    match damage {
        Damage::Flip(at, bit) => {
            let at = byte(at, bytes);
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << bit;
            }
        }
        Damage::Set(at, with) => {
            let at = byte(at, bytes);
            if let Some(byte) = bytes.get_mut(at) {
                *byte = *with;
            }
        }
        Damage::Cut(at, length) => {
            let from = place(at, bytes);
            bytes.drain(from..(from + length).min(bytes.len()));
        }
        Damage::End(at) => bytes.truncate(place(at, bytes)),
        Damage::Word(at, word) => {
            let at = place(at, bytes);
            bytes.splice(at..at, WORDS[*word].iter().copied());
        }
        Damage::Number(at, word) => {
            let from = place(at, bytes);
            let Some(start) = (from..bytes.len()).find(|&at| bytes[at].is_ascii_digit()) else { return };
            let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
            let end = (start..bytes.len()).find(|&at| !is_part(&bytes[at])).unwrap_or(bytes.len());
            bytes.splice(start..end, WORDS[*word].iter().copied());
        }
        Damage::Repeat { from, length, at } => {
            let from = place(from, bytes);
            let part = bytes[from..(from + length).min(bytes.len())].to_vec();
            let at = place(at, bytes);
            bytes.splice(at..at, part);
        }
        Damage::Splice { at, seed, from } => {
            let other = &seeds[seed.index(seeds.len())];
            bytes.truncate(place(at, bytes));
            bytes.extend(&other[from.index(other.len() + 1)..]);
        }
    }
}

fn check(name: &str, cases: u32) {
    let Target { read, seeds, .. } = *TARGETS.iter().find(|target| target.name == name).expect("a target");
    let seeds = seeds();
    for (number, seed) in seeds.iter().enumerate() {
        assert!(read(seed), "seed {number} of {name} is refused, and damage to it would prove little");
    }
    if let Ok(found) = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("found").join(name)) {
        for file in found {
            read(&fs::read(file.expect("a file").path()).expect("it can be read"));
        }
    }
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let strategy = (any::<Index>(), prop::collection::vec(damage(), 1..4)).prop_map(|(seed, damages)| {
        let mut bytes = seeds[seed.index(seeds.len())].clone();
        damages.iter().for_each(|damage| inflict(damage, &mut bytes, &seeds));
        bytes
    });
    let taken = Cell::new(0);
    let outcome = TestRunner::new_with_rng(config, rng).run(&strategy, |bytes| {
        taken.set(taken.get() + u32::from(read(&bytes)));
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{name}: {error}");
    }
    println!("{name}: {} of {cases} were taken", taken.get());
}

#[test]
fn commands_survive_damage() {
    check("command", 20000);
}

#[test]
fn documents_survive_damage() {
    check("document", 1000);
}

#[test]
fn sections_survive_damage() {
    check("section", 1000);
}

#[test]
fn scripts_survive_damage() {
    check("script", 5000);
}

#[test]
fn thumbnails_survive_damage() {
    check("thumbnail", 10000);
}

#[test]
fn queries_survive_damage() {
    check("query", 5000);
}

#[test]
fn ranges_survive_damage() {
    check("range", 5000);
}

#[test]
fn frames_survive_damage() {
    check("frame", 10000);
}

#[test]
fn models_survive_damage() {
    check("gltf", 10000);
}

#[test]
fn faces_survive_damage() {
    check("obj", 10000);
}

#[test]
fn journals_survive_damage() {
    check("journal", 600);
}

#[test]
fn meshes_survive_damage() {
    check("mesh", 5000);
}

#[test]
fn messages_survive_damage() {
    check("message", 600);
}

#[test]
fn graphs_survive_damage() {
    check("mtg", 5000);
}

#[test]
fn cylinders_survive_damage() {
    check("qsm", 5000);
}

#[test]
fn skeletons_survive_damage() {
    check("skeleton", 5000);
}
