//! Documents go on under the next simulation: what was grown stays as it is, and only new growth follows other rules.
//!
//! The next simulation is one of tests alone (`next-simulation` of `espalier-growth`). Which one is at work holds for
//! the whole process, so these tests run one after the other.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod life;

use std::{
    fs,
    path::PathBuf,
    sync::{Mutex, MutexGuard, PoisonError},
};

use espalier_growth::{SIMULATION_VERSION, simulation_version, use_next_simulation};
use espalier_plant::checks;
use espalier_proto::{Action, Steps};
use espalier_session::{Document, JournalEntry, Principal, Session};
use proptest::prelude::*;

use crate::life::{LifeEvent, events, live};

/// Which simulation is at work: the present one, until [`Age::next`].
struct Age(#[allow(dead_code, reason = "it is held, not read")] MutexGuard<'static, ()>);

impl Age {
    fn present() -> Self {
        static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
        let guard = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
        use_next_simulation(false);
        Self(guard)
    }

    fn next(&self) {
        use_next_simulation(true);
        assert_eq!(simulation_version(), SIMULATION_VERSION + 1);
    }
}

/// Every place that a document can go to without growing: hashes of the plant with the parameters in force.
#[derive(Debug, PartialEq)]
struct Travels {
    present: u64,
    steps: Vec<u64>,
    undone: Vec<(u64, String)>,
    redone: u64,
    futures: Vec<(u32, u64)>,
}

impl Travels {
    fn of(document: &Document) -> Self {
        // Whoever drew when it was kept would hold time fast.
        let mut document = document.clone();
        document.end_gestures();
        let timeline = document.timeline();
        let plant = |document: &Document| document.plant().hash();
        let mut there = document.clone();
        let steps = (0..=timeline.last_step).map(|step| {
            there.apply(&Principal::visitor(), &Action::GoTo { step }.into()).unwrap();
            plant(&there)
        });
        let steps = steps.collect();
        let futures = timeline.futures.iter().map(|future| {
            let mut there = document.clone();
            there.apply(&Principal::visitor(), &Action::TakeFuture { future: future.future }.into()).unwrap();
            (future.future, plant(&there))
        });
        let futures = futures.collect();
        let mut there = document.clone();
        let mut undone = Vec::new();
        while there.apply(&Principal::visitor(), &Action::Undo {}.into()).is_ok() {
            undone.push((plant(&there), format!("{:?}", there.parameters())));
        }
        while there.apply(&Principal::visitor(), &Action::Redo {}.into()).is_ok() {}
        Self { present: plant(&document), steps, undone, redone: plant(&there), futures }
    }
}

fn grow(document: &mut Document, steps: u32) {
    document
        .apply(
            &Principal::visitor(),
            &Action::Grow { steps: Steps::nearest(steps), until: None, bud: None }.into(),
        )
        .unwrap();
}

#[test]
fn the_next_simulation_grows_otherwise() {
    let age = Age::present();
    let mut present = Document::new(3);
    grow(&mut present, 5);
    let before = present.clone();
    age.next();
    let mut next = Document::new(3);
    grow(&mut next, 5);
    assert_ne!(next.plant().hash(), present.plant().hash());
    // The same plant goes on otherwise too.
    let mut on = before.clone();
    grow(&mut on, 3);
    use_next_simulation(false);
    let mut as_before = before;
    grow(&mut as_before, 3);
    assert_ne!(on.plant().hash(), as_before.plant().hash());
}

#[test]
fn kept_documents_travel_as_ever_and_grow_by_new_rules() {
    let age = Age::present();
    let files = ["tree.document", "session.snapshot"].map(kept);
    let open = |[tree, snapshot]: &[Vec<u8>; 2]| {
        let session = Session::restore("elm", 1, Some(snapshot), 0, []).unwrap();
        [Document::from_bytes(tree).unwrap(), session.document().unwrap().clone()]
    };
    let before = open(&files).map(|document| Travels::of(&document));
    let mut grown = open(&files);
    grown.iter_mut().for_each(|document| grow(document, 2));
    age.next();
    for ((mut document, before), grown) in open(&files).into_iter().zip(before).zip(grown) {
        assert_eq!(Travels::of(&document), before);
        grow(&mut document, 2);
        assert_ne!(document.plant().hash(), grown.plant().hash(), "new growth follows new rules");
        document.end_gestures();
        document.apply(&Principal::visitor(), &Action::Undo {}.into()).unwrap();
        assert_eq!(document.plant().hash(), before.present);
    }
}

#[test]
fn a_tail_is_replayed_by_the_new_rules() {
    let age = Age::present();
    let snapshot = kept("session.snapshot");
    let rows: Vec<(u64, String, u32, String)> = serde_json::from_slice(&kept("session.tail.json")).unwrap();
    let entry = |(number, client, id, command): (u64, String, u32, String)| JournalEntry {
        number,
        principal: Principal::parse(&client).unwrap(),
        id,
        command,
    };
    let entries: Vec<JournalEntry> = rows.into_iter().map(entry).collect();
    let restore = |tail: &[JournalEntry]| {
        let session = Session::restore("elm", 1, Some(&snapshot), 0, tail.iter().cloned()).unwrap();
        session.document().unwrap().clone()
    };
    let (covered, replayed) = (restore(&[]), restore(&entries));
    age.next();
    assert_eq!(restore(&[]).hash(), covered.hash(), "nothing was done again");
    let mut regrown = restore(&entries);
    assert_ne!(regrown.plant().hash(), replayed.plant().hash());
    assert_eq!(regrown.timeline().operations.len(), replayed.timeline().operations.len());
    regrown.end_gestures();
    while regrown.apply(&Principal::visitor(), &Action::Undo {}.into()).is_ok() {}
    assert_eq!(regrown.plant().hash(), Document::new(11).plant().hash());
}

fn kept(name: &str) -> Vec<u8> {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "../../tests/kept/0.1.0", name].iter().collect();
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// An old writer and a new reader.
    #[test]
    fn any_life_goes_on_under_the_next_simulation(seed: u32, before in events(), after in events()) {
        let age = Age::present();
        let mut document = Document::new(seed);
        document.set_metamer_budget(3000);
        grow(&mut document, 4);
        before.iter().enumerate().for_each(|(number, event)| live(&mut document, number, event));
        let (bytes, travels, hash) = (document.to_bytes(), Travels::of(&document), document.hash());
        age.next();
        let mut read = Document::from_bytes(&bytes).unwrap();
        prop_assert_eq!(read.hash(), hash);
        prop_assert_eq!(&Travels::of(&read), &travels);
        // It lives on, and all that was grown by either simulation can be undone and redone.
        for (number, event) in after.iter().chain(&[LifeEvent::Grow(2)]).enumerate() {
            live(&mut read, 500 + number, event);
            prop_assert_eq!(checks::all(read.plant()), Ok(()), "{:?}", event);
        }
        let again = Document::from_bytes(&read.to_bytes()).unwrap();
        prop_assert_eq!(again.hash(), read.hash());
        prop_assert_eq!(&Travels::of(&again), &Travels::of(&read));
        read.end_gestures();
        while read.apply(&Principal::visitor(), &Action::Undo {}.into()).is_ok() {}
        prop_assert_eq!(read.plant().hash(), Document::new(seed).plant().hash());
    }
}
