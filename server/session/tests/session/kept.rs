//! Kept documents: what each released program wrote opens for ever, with all of its time.
//!
//! `tests/kept` holds the files and says how they were made. After another release was added:
//! `UPDATE_GOLDEN=1 cargo nextest run -p espalier-session kept`; what is there already must not change.

use std::{fs, path::PathBuf};

use espalier_plant::checks;
use espalier_session::{Document, JournalEntry, Principal, Session, read_command};
use serde_json::{Value, json};

use crate::world::person;

/// The releases that `tests/kept` has documents of.
const RELEASES: [&str; 1] = ["0.1.0"];

#[test]
fn kept_trees_open_travel_and_grow_on() {
    for release in RELEASES {
        let document = Document::from_bytes(&file(release, "tree.document")).unwrap();
        check(release, "tree", &document);
    }
}

#[test]
fn kept_snapshots_open_travel_and_grow_on() {
    for release in RELEASES {
        let session = Session::restore("elm", 1, Some(&file(release, "session.snapshot")), 0, []).unwrap();
        check(release, "session", session.document().unwrap());
    }
}

/// What the released program did at random, 32 times, and its own account of every place in the time of each document.
#[test]
fn kept_lives_travel_and_grow_on() {
    for release in RELEASES {
        let lives: Vec<Value> = serde_json::from_slice(&file(release, "lives/expected.json")).unwrap();
        assert_eq!(lives.len(), 32);
        let mut growing = 0;
        for (number, expected) in lives.iter().enumerate() {
            let name = format!("lives/{number:02}.document");
            let mut document = Document::from_bytes(&file(release, &name)).unwrap();
            assert_holds(&format!("{release}/{name}"), expected, &way_through(&document));
            let read = Document::from_bytes(&document.to_bytes()).unwrap();
            assert_eq!(read.hash(), document.hash(), "{name} in today's format");
            document.end_gestures();
            let before = hash(&document);
            let grow = read_command(r#"{"kind":"grow","steps":2}"#).unwrap();
            // Some have come to their budget.
            if document.apply(&Principal::visitor(), &grow).is_ok() {
                assert_eq!(checks::all(document.plant()), Ok(()), "{name}");
                growing += u32::from(hash(&document) != before);
                apply(&mut document, r#"{"kind":"undo"}"#);
            }
            assert_eq!(hash(&document), before, "{name}: undoing new growth left something behind");
        }
        assert!(growing > 8, "only {growing} lives go on");
    }
}

/// The plants at every place that a document can go to without growing.
fn way_through(document: &Document) -> Value {
    let account = account(document);
    let plant = |place: &Value| place["plant"].clone();
    let futures = account["futures"].as_array().unwrap().iter().map(|future| plant(&future["place"]));
    let mut there = with_nobody_at_work(document);
    let undo = read_command(r#"{"kind":"undo"}"#).unwrap();
    let undone =
        std::iter::from_fn(|| there.apply(&Principal::visitor(), &undo).is_ok().then(|| hash(&there)));
    json!({
        "present": plant(&account["present"]),
        "steps": account["steps"],
        "futures": futures.collect::<Vec<_>>(),
        "undone": undone.collect::<Vec<_>>(),
        "redone": plant(&account["redone"]),
    })
}

#[test]
fn a_kept_journal_tail_is_replayed() {
    for release in RELEASES {
        let entries = tail(release);
        let snapshot = file(release, "session.snapshot");
        let restored = |tail: &[JournalEntry]| {
            let session = Session::restore("elm", 1, Some(&snapshot), 0, tail.iter().cloned()).unwrap();
            session.document().unwrap().clone()
        };
        let mut by_hand = restored(&[]);
        for (index, entry) in entries.iter().enumerate() {
            // Some end what is not in progress.
            let _refused = by_hand.apply(&entry.principal, &read_command(&entry.command).unwrap());
            assert_eq!(restored(&entries[..=index]).hash(), by_hand.hash(), "{release}: {}", entry.command);
        }
        assert_ne!(by_hand.hash(), restored(&[]).hash(), "{release}: the tail does something");
        grows_on(release, by_hand);
    }
}

#[test]
fn kept_files_that_were_damaged_are_refused() {
    for release in RELEASES {
        let tree = file(release, "tree.document");
        let sound = Document::from_bytes(&tree).unwrap().hash();
        let snapshot = file(release, "session.snapshot");
        for at in (0..tree.len()).step_by(101).chain(0..40) {
            let mut damaged = tree.clone();
            damaged[at] ^= 4;
            // The header's version of the simulation is the one thing without a checksum in this format.
            let is_same = Document::from_bytes(&damaged).is_ok_and(|read| read.hash() == sound);
            assert!(Document::from_bytes(&damaged).is_err() || is_same && (12..16).contains(&at), "{at}");
            assert!(Document::from_bytes(&tree[..at]).is_err(), "{at} bytes are not all");
            let mut damaged = snapshot.clone();
            damaged[at] ^= 4;
            for bytes in [&damaged, &snapshot[..at]] {
                assert!(Session::restore("elm", 1, Some(bytes), 0, []).is_err(), "{at}");
            }
        }
    }
}

/// `golden/later.espalier` is a document with a generator that only the tests of this crate have, and this program has
/// not.
#[test]
fn op1_a_document_with_an_unknown_generator_names_the_program_that_reads_it() {
    let later = include_bytes!("../../golden/later.espalier");
    let needed = "a later version of Espalier wrote the document: it has a section FORK of version 1, which version \
                  9.0.0 and later ones read";
    assert_eq!(Document::from_bytes(later).unwrap_err().to_string(), needed);
    let restored = Session::restore("elm", 1, Some(later), 0, []).map(drop);
    assert_eq!(restored.unwrap_err().to_string(), format!("the snapshot cannot be read: {needed}"));
}

/// The entries that no snapshot covers: number, client, id, command.
fn tail(release: &str) -> Vec<JournalEntry> {
    let rows: Vec<(u64, String, u32, String)> =
        serde_json::from_slice(&file(release, "session.tail.json")).unwrap();
    let entry = |(number, client, id, command): (u64, String, u32, String)| JournalEntry {
        number,
        principal: Principal::parse(&client).unwrap(),
        id,
        command,
    };
    rows.into_iter().map(entry).collect()
}

/// Compares all that a document holds, and every place in its time, with what its own program made of it.
fn check(release: &str, name: &str, document: &Document) {
    compare(release, name, account(document));
    grows_on(release, document.clone());
}

/// Every place a document can go to without growing.
fn account(document: &Document) -> Value {
    // Whoever drew when it was kept would hold time fast.
    let (kept, document) = (document, &with_nobody_at_work(document));
    let timeline = document.timeline();
    let mut travelled = document.clone();
    let steps: Vec<Value> = (0..=timeline.last_step)
        .map(|step| {
            apply(&mut travelled, r#"{"kind":"go_to","step":STEP}"#.replace("STEP", &step.to_string()));
            hash(&travelled)
        })
        .collect();
    let mut undone = document.clone();
    let undoes = repeat(&mut undone, r#"{"kind":"undo"}"#);
    let seedling = place(&undone);
    let redoes = repeat(&mut undone, r#"{"kind":"redo"}"#);
    let futures: Vec<Value> = (timeline.futures.iter())
        .map(|future| {
            let mut there = document.clone();
            let command = format!(r#"{{"kind":"take_future","future":{}}}"#, future.future);
            apply(&mut there, command);
            json!({ "future": future.future, "from": future.from, "on": future.on, "place": place(&there) })
        })
        .collect();
    json!({
        "present": place(document),
        "operations": timeline.operations.iter().map(|operation| operation.kind).collect::<Vec<_>>(),
        // The kept ones were counted from 0.
        "authors": timeline.operations.iter().map(|operation| operation.author - 1).collect::<Vec<_>>(),
        "done": timeline.done,
        "steps": steps,
        "undoes": undoes,
        "seedling": seedling,
        "redoes": redoes,
        "redone": place(&undone),
        "futures": futures,
        "open_strokes": kept.open_strokes(&person("first-person-01")),
        "open_bends": kept.open_bends(&person("second-person-2")),
        "widths": document.widths(),
        "obstacles": document.obstacles(),
        "parameters": document.parameters(),
        "appearance": looks(document),
    })
}

fn looks(document: &Document) -> Value {
    let looks = document.appearance();
    json!({
        "leaves": { "shape": format!("{:?}", looks.leaves.shape), "season": looks.leaves.season },
        "flowers": { "kind": format!("{:?}", looks.flowers.kind), "share": looks.flowers.share },
        "fruits": { "kind": format!("{:?}", looks.fruits.kind) },
        "bark": { "kind": format!("{:?}", looks.bark.kind) },
        "background": { "sky": format!("{:?}", looks.background.sky), "backdrop": looks.background.backdrop },
    })
}

/// Where a document is: what stands there, and what is in force.
fn place(document: &Document) -> Value {
    let figures = document.figures();
    json!({
        "plant": hash(document),
        "step": figures.step,
        "metamers": figures.metamers,
        "axes": figures.axes,
        "can_undo": figures.can_undo,
        "can_redo": figures.can_redo,
    })
}

fn with_nobody_at_work(document: &Document) -> Document {
    let mut alone = document.clone();
    alone.end_gestures();
    alone
}

fn hash(document: &Document) -> Value {
    json!(format!("{:016x}", document.plant().hash()))
}

/// Repeats a command until it is refused; how often it was done.
fn repeat(document: &mut Document, command: &str) -> u32 {
    let command = read_command(command).unwrap();
    let mut count = 0;
    while document.apply(&Principal::visitor(), &command).is_ok() {
        count += 1;
        assert!(count < 1000, "{command:?} has no end");
    }
    count
}

fn apply(document: &mut Document, command: impl AsRef<str>) {
    let command = command.as_ref();
    let command = read_command(command).unwrap();
    document
        .apply(&Principal::visitor(), &command)
        .unwrap_or_else(|problem| panic!("{command:?}: {problem}"));
}

/// Growth goes on from the present and from the seedling, and can be undone to the very plant before it.
fn grows_on(release: &str, mut document: Document) {
    document.end_gestures();
    for _ in 0..2 {
        let (before, metamers) = (document.plant().hash(), document.plant().metamer_count());
        apply(&mut document, r#"{"kind":"grow","steps":2}"#);
        assert!(document.plant().metamer_count() > metamers, "{release}: nothing grows any more");
        apply(&mut document, r#"{"kind":"undo"}"#);
        assert_eq!(document.plant().hash(), before, "{release}: undoing new growth left something behind");
        repeat(&mut document, r#"{"kind":"undo"}"#);
    }
}

fn folder(release: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "../../tests/kept", release].iter().collect()
}

fn file(release: &str, name: &str) -> Vec<u8> {
    let path = folder(release).join(name);
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn compare(release: &str, name: &str, found: Value) {
    let path = folder(release).join(format!("{name}.expected.json"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() && !path.exists() {
        fs::write(&path, format!("{}\n", serde_json::to_string_pretty(&found).unwrap())).unwrap();
    }
    let expected: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    // A number that has been text may differ in its last place.
    let found: Value = serde_json::from_str(&found.to_string()).unwrap();
    assert_holds(&format!("{release}/{name}"), &expected, &found);
}

/// All that is expected is there; a later program may know more fields of an object.
fn assert_holds(at: &str, expected: &Value, found: &Value) {
    match (expected, found) {
        (Value::Object(expected), Value::Object(found)) => {
            for (key, expected) in expected {
                assert_holds(&format!("{at}.{key}"), expected, found.get(key).unwrap_or(&Value::Null));
            }
        }
        (Value::Array(expected), Value::Array(found)) if expected.len() == found.len() => {
            for (index, (expected, found)) in expected.iter().zip(found).enumerate() {
                assert_holds(&format!("{at}[{index}]"), expected, found);
            }
        }
        _ => assert_eq!(found, expected, "{at}"),
    }
}
