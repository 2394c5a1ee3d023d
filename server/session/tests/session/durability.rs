//! `CM2`, snapshots and restarts.

use std::sync::LazyLock;

use espalier_proto::{Notice, ServerMessage, version::CloseCode};
use espalier_session::{Document, Input, JournalEntry, Principal, ReadId, RestoreError, Session};
use proptest::prelude::*;
use serde_json::json;

use crate::world::{SEED, World, grow, person};

#[test]
fn cm2_nothing_is_acknowledged_before_it_is_durable() {
    let mut world = World::new();
    world.write_ms = 400;
    let client = world.join("birch-01");
    world.command(client, 1, grow(1));
    world.command(client, 2, grow(1));
    world.pass(399);
    assert!(world.peer(client).acknowledged().is_empty());
    assert_eq!(world.document().figures().step, 2, "but it is seen at once");
    world.pass(1);
    assert_eq!(world.peer(client).acknowledged(), [1]);
    world.pass(400);
    assert_eq!(world.peer(client).acknowledged(), [1, 2]);
}

#[test]
fn cm2_only_what_was_handed_out_can_be_durable() {
    let mut world = World::new();
    world.write_ms = 1_000;
    let client = world.join("birch-01");
    world.command(client, 1, grow(1));
    world.command(client, 2, grow(1));
    world.writing = None;
    world.handle(Input::Journaled(2));
    world.pass(10);
    assert_eq!(world.peer(client).acknowledged(), [1]);
}

#[test]
fn commands_gather_while_the_disk_is_busy() {
    let mut world = World::new();
    world.write_ms = 100;
    let client = world.join("birch-01");
    for id in 1..=50 {
        world.command(client, id, json!({ "kind": "redo" }));
    }
    world.pass(100);
    assert_eq!(world.disk.len(), 1);
    world.pass(100);
    assert_eq!(world.disk.len(), 50, "the rest is one batch");
    assert_eq!(world.peer(client).acknowledged(), [1, 50]);
}

#[test]
fn hs5_a_failed_journal_closes_with_1011_and_a_restart_goes_on() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, grow(3));
    world.settle();
    world.command(birch, 2, grow(3));
    world.handle(Input::JournalFailed("no space left".into()));
    for client in [birch, maple] {
        assert_eq!(world.peer(client).closed, Some(CloseCode::InternalError));
    }
    assert!(world.session.has_failed());
    let late = world.connect();
    assert_eq!(world.peer(late).closed, Some(CloseCode::InternalError));

    world.crash();
    let birch = world.join("birch-01");
    assert_eq!(world.peer(birch).welcome_acknowledged(), 1);
    world.command(birch, 2, grow(3));
    world.settle();
    assert_eq!(world.peer(birch).acknowledged(), [2]);
    assert_eq!(world.document().figures().step, 6);
}

#[test]
fn a_crash_loses_nothing_acknowledged() {
    let mut world = World::new();
    world.write_ms = 50;
    let client = world.join("birch-01");
    for id in 1..=10 {
        world.command(client, id, grow(1));
        world.pass(9);
    }
    let acknowledged = *world.peer(client).acknowledged().last().unwrap();
    assert!(acknowledged < 10, "the crash comes in time to lose something");
    world.crash();
    let client = world.join("birch-01");
    assert_eq!(world.peer(client).welcome_acknowledged(), acknowledged);
    for id in acknowledged + 1..=10 {
        world.command(client, id, grow(1));
    }
    world.settle();
    world.pass(200);
    assert_eq!(world.document().figures().step, 10);
    world.assert_mirrored(client);
}

#[test]
fn many_commands_make_a_snapshot() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for id in 1..=600 {
        world.command(client, id, if id % 2 == 0 { json!({ "kind": "undo" }) } else { grow(1) });
        world.pass(1);
    }
    world.settle();
    assert_eq!(world.snapshots, 1);
    let through = world.snapshot.as_ref().unwrap().0;
    assert!((512..=600).contains(&through));
    restart_and_compare(&mut world);
}

#[test]
fn a_pause_makes_a_snapshot() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(5));
    world.pass(29_000);
    assert_eq!(world.snapshots, 0);
    world.pass(2_000);
    assert_eq!(world.snapshots, 1);
    assert_eq!(world.snapshot.as_ref().unwrap().0, 1);
    world.pass(120_000);
    assert_eq!(world.snapshots, 1, "nothing new, no new snapshot");
    restart_and_compare(&mut world);
}

#[test]
fn a_snapshot_waits_for_the_disk() {
    let mut world = World::new();
    world.write_ms = 100_000;
    let client = world.join("birch-01");
    world.command(client, 1, grow(5));
    world.pass(90_000);
    assert_eq!(world.snapshots, 0);
    world.pass(20_000);
    assert_eq!(world.snapshots, 1);
}

#[test]
fn undo_reaches_behind_a_restart() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(5));
    world.settle();
    let five = world.document().plant().clone();
    world.command(client, 2, grow(7));
    world.pass(40_000);
    world.disk.retain(|entry| entry.number > world.snapshot.as_ref().unwrap().0);
    assert!(world.disk.is_empty(), "everything is in the snapshot");
    world.crash();
    let client = world.join("birch-01");
    world.command(client, 3, json!({ "kind": "undo" }));
    world.settle();
    assert!(world.peer(client).refused().is_empty());
    assert_eq!(world.document().plant().metamer_count(), five.metamer_count());
}

#[test]
fn op2_a_session_that_is_put_away_stops_growing_and_keeps_a_snapshot_of_everything() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(3));
    world.command(client, 2, grow(1000));
    world.pass(10);
    assert!(world.working.is_some(), "it is still growing");
    world.handle(Input::Stopping);
    world.settle();
    let step = world.document().figures().step;
    assert!((3..30).contains(&step), "growth goes no further than its next slice: {step}");
    assert_eq!(world.snapshot.as_ref().map(|(through, _)| *through), Some(3));
    assert!(world.session.is_kept());
    assert!(world.disk[2].command.contains("stop"), "a replay ends there as well");
    // What a snapshot holds already needs no other.
    let before = world.snapshots;
    world.handle(Input::Stopping);
    world.settle();
    assert_eq!((world.snapshots, world.disk.len()), (before, 3));
    restart_and_compare(&mut world);
}

#[test]
fn op2_predictions_end_when_the_session_is_put_away() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(3));
    world.settle();
    world.send(client, &json!({ "type": "predict", "rows": [], "steps": 40 }));
    world.handle(Input::Stopping);
    world.settle();
    world.pass(100);
    assert!(world.peer(client).ghosts.is_empty(), "nobody waits for it");
    assert!(world.session.is_kept());
}

#[test]
fn a_snapshot_that_was_not_kept_covers_nothing_and_is_made_again_soon() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.is_full = true;
    world.command(client, 1, grow(2));
    world.pass(31_000);
    assert_eq!((world.snapshots, world.session.is_kept()), (1, false));
    assert_eq!(world.peer(client).acknowledged(), [1], "the journal holds it");
    world.pass(4_000);
    assert_eq!(world.snapshots, 1, "not at once");
    world.pass(2_000);
    assert_eq!(world.snapshots, 2);
    world.leave(client);
    world.pass(31_000);
    assert!(!world.session.is_idle(), "nothing holds what was done but the journal");
    world.is_full = false;
    world.pass(6_000);
    assert!(world.session.is_kept() && world.session.is_idle());
    assert_eq!(world.snapshot.as_ref().unwrap().0, 1);
    restart_and_compare(&mut world);
}

#[test]
fn op3_everybody_is_notified_once_of_how_the_session_was_opened() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(2));
    world.settle();
    world.crash();
    let sent = [Notice::Regrown { from: 1, to: 2 }, Notice::Damaged { entry: 7 }];
    world.session.notify(sent.clone());
    let notices = |world: &World, client: u64| -> Vec<Notice> {
        let texts = world.peer(client).texts.iter();
        texts
            .filter_map(|text| match text {
                ServerMessage::Notice { notice } => Some(notice.clone()),
                _ => None,
            })
            .collect()
    };
    world.pass(100);
    assert_eq!(world.notified, 0, "nobody is here");
    let deaf = world.connect();
    world.peer_mut(deaf).deaf = true;
    world.hello(deaf, "birch-03", None);
    world.pass(100);
    assert_eq!(world.notified, 0, "they have not gone out");
    world.leave(deaf);
    let first = world.join("birch-01");
    world.pass(100);
    assert_eq!(world.notified, 1);
    let second = world.join("birch-02");
    world.settle();
    assert_eq!(notices(&world, first), sent);
    assert_eq!(notices(&world, second), sent);
    assert_eq!(
        world.snapshot.as_ref().map(|(through, _)| *through),
        Some(1),
        "what was restored is kept at once"
    );
    let mirror = world.leave(first).mirror;
    let returned = world.rejoin("birch-01", mirror);
    world.settle();
    assert!(world.peer(returned).resumed());
    assert_eq!(notices(&world, returned), []);
}

#[test]
fn a_missing_entry_is_noticed() {
    let entry = |number| JournalEntry {
        number,
        principal: Principal::client("birch-01").unwrap(),
        id: number as u32,
        command: r#"{"kind":"grow","steps":1}"#.into(),
    };
    let restore = |entries: Vec<JournalEntry>| Session::restore("x", 1, None, SEED, entries).map(drop);
    assert!(restore(vec![entry(1), entry(2)]).is_ok());
    assert!(matches!(restore(vec![entry(2)]), Err(RestoreError::Gap { expected: 1, found: 2 })));
    assert!(matches!(restore(vec![entry(1), entry(3)]), Err(RestoreError::Gap { expected: 2, found: 3 })));
    let unreadable = JournalEntry { command: "{".into(), ..entry(1) };
    assert!(matches!(restore(vec![unreadable]), Err(RestoreError::Entry { number: 1, .. })));
}

#[test]
fn a_read_gives_the_document() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(9));
    world.handle(Input::Read(ReadId(5)));
    world.settle();
    let (id, read) = world.documents.pop().unwrap();
    assert_eq!((id, read.through, read.species), (ReadId(5), 0, None), "the command was not durable yet");
    let document = Document::from_bytes(&read.bytes).unwrap();
    assert_eq!(document.figures().metamers, read.metamers);
    assert_eq!(document.figures().pending_steps, 0, "a document is whole between two commands");
    world.handle(Input::Read(ReadId(6)));
    world.settle();
    let (id, read) = world.documents.pop().unwrap();
    assert_eq!((id, read.through), (ReadId(6), 1));
}

#[test]
fn a_saved_tree_opens_as_a_session() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(9));
    world.settle();
    world.handle(Input::Read(ReadId(1)));
    world.settle();
    let (_, read) = world.documents.pop().unwrap();
    let (begun, snapshot) = Session::of_tree("opened", 1, &read.bytes, 1_000_000).unwrap();
    let opened = Session::restore("opened", 1, Some(&snapshot), 0, []).unwrap();
    for session in [&begun, &opened] {
        assert_eq!(session.document().unwrap().hash(), world.document().hash());
    }
    let bytes = |session: &Session| session.document().unwrap().to_bytes();
    assert!(bytes(&begun) == bytes(&opened), "the one in memory and the one that was kept");
    assert!(Session::of_tree("tree", 1, b"not a tree", 1_000_000).is_err());
}

#[test]
fn an_idle_session_says_so() {
    let mut world = World::new();
    assert!(world.session.is_idle());
    let client = world.join("birch-01");
    world.command(client, 1, grow(2));
    world.settle();
    assert!(!world.session.is_idle());
    world.leave(client);
    world.pass(100);
    assert!(!world.session.is_idle(), "a snapshot is still to come");
    world.pass(61_000);
    assert!(world.session.is_idle());
}

#[test]
fn a_clean_stop_leaves_no_tail() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(7));
    world.command(client, 2, json!({ "kind": "stroke_begin", "stroke": 1 }));
    world.leave(client);
    world.handle(Input::Stopping);
    world.pass(100);
    assert_eq!(
        world.snapshot.as_ref().unwrap().0,
        3,
        "what waited ended or was done, and a snapshot holds it"
    );
    let hash = world.document().hash();
    world.disk.clear();
    world.crash();
    assert_eq!(world.document().hash(), hash, "the snapshot alone is enough");
    assert_eq!(world.document().open_strokes(&person("birch-01")), [1]);
}

fn restart_and_compare(world: &mut World) {
    let hash = world.document().hash();
    let figures = world.document().figures();
    world.crash();
    assert_eq!(world.document().hash(), hash);
    assert_eq!(world.document().figures(), figures);
    assert_eq!(world.replayed_hash(), hash, "the snapshot and the journal agree");
}

static SOME_SNAPSHOT: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(5));
    world.pass(31_000);
    world.snapshot.unwrap().1
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_damaged_snapshot_is_noticed(at in any::<prop::sample::Index>(), bit in 0..8u32, cut in any::<prop::sample::Index>()) {
        let good = &*SOME_SNAPSHOT;
        let mut damaged = good.clone();
        damaged[at.index(good.len())] ^= 1 << bit;
        prop_assert!(Session::restore("x", 1, Some(&damaged), SEED, []).is_err());
        prop_assert!(Session::restore("x", 1, Some(&good[..cut.index(good.len())]), SEED, []).is_err());
        prop_assert!(Session::restore("x", 1, Some(good), SEED, []).is_ok());
    }

    #[test]
    fn any_bytes_are_refused_as_a_snapshot(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(Session::restore("x", 1, Some(&bytes), SEED, []).is_err());
    }
}
