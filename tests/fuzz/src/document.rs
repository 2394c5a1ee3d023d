//! Documents, as saved trees and snapshots hold them.

use std::{fs, path::Path};

use espalier_proto::{Action, Command};
use espalier_session::{Document, Principal, Session, read_command};

use crate::{METAMERS, SEED, command};

/// So many operations are taken back and done again.
const OPERATIONS: usize = 40;

/// Reads a document, or a snapshot with one in it; what can be read is the same when it is written and read again, and
/// goes back to its beginning and forth again.
pub fn read(bytes: &[u8]) -> bool {
    let restored = Session::restore("fuzzed", 1, Some(bytes), SEED, []);
    let Ok(mut document) = Document::from_bytes(bytes) else { return restored.is_ok() };
    let hash = document.hash();
    let again = Document::from_bytes(&document.to_bytes()).map(|document| document.hash());
    assert_eq!(again.as_ref().ok(), Some(&hash), "{again:?}");
    document.set_metamer_budget(METAMERS);
    let all = |document: &mut Document, command: &Command| {
        (0..OPERATIONS).take_while(|_| document.apply(&Principal::visitor(), command).is_ok()).count()
    };
    all(&mut document, &Action::Undo {}.into());
    all(&mut document, &Action::Redo {}.into());
    true
}

/// What each release wrote; a tree with a history and a future, as it is saved, and as the first snapshot of a session;
/// what a grammar wrote that asks what stands around.
pub fn seeds() -> Vec<Vec<u8>> {
    kept().into_iter().chain(own()).chain([written()]).collect()
}

/// The documents and snapshots in `tests/kept`.
fn kept() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kept");
    let releases = fs::read_dir(folder).into_iter().flatten().flatten().map(|release| release.path());
    let mut files: Vec<_> = releases
        .flat_map(|release| ["tree.document", "session.snapshot"].map(|name| release.join(name)))
        .filter_map(|file| fs::read(file).ok())
        .collect();
    // Folders come in any order.
    files.sort();
    files
}

/// A tree with a history and a future, as it is saved, and as the first snapshot of a session.
fn own() -> Vec<Vec<u8>> {
    let mut document = Document::new(SEED);
    document.set_metamer_budget(METAMERS);
    for line in command::lines() {
        // Some are refused by a tree so small.
        let _ = read_command(line).and_then(|command| document.apply(&Principal::visitor(), &command));
    }
    // What is being drawn or bent cannot be kept.
    document.end_gestures();
    let bytes = document.to_bytes();
    let snapshot = Session::of_tree("tree", 1, &bytes, METAMERS).map(|(_, snapshot)| snapshot);
    [document.to_saved_bytes(), bytes].into_iter().chain(snapshot).collect()
}

/// A grammar that has a body and asks for light, derived, cut, set to another value and derived on.
fn written() -> Vec<u8> {
    const LINES: [&str; 4] = [
        r#"{"kind":"set_grammar","text":"a = 30\nslider: a 5 90\naxiom: F A\nA : light() > 0.1 && inside(0) --> F[+(a)A]/(90)A\n","depth":3,"within":{"outline":[[-4,0],[4,0],[4,9],[-4,9]],"plane":{"origin":[0,0,0],"right":[1,0,0],"up":[0,1,0]},"depth":1}}"#,
        r#"{"kind":"prune","rows":[4]}"#,
        r#"{"kind":"set_grammar_values","values":[{"name":"a","value":25.5}]}"#,
        r#"{"kind":"derive","steps":2}"#,
    ];
    let mut document = Document::new(SEED);
    document.set_metamer_budget(METAMERS);
    for line in LINES {
        let done = read_command(line).and_then(|command| document.apply(&Principal::visitor(), &command));
        let refused = done.err();
        assert!(refused.is_none(), "{line}: {refused:?}");
    }
    document.to_bytes()
}
