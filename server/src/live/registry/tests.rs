//! Sessions from the store to clients and back, without sockets.

mod crashes;
mod memory;

use std::time::Duration;

use espalier_proto::{Notice, ServerMessage, access::Role, version::CloseCode};
use espalier_session::{
    ClientId, Document, Entrant, JournalEntry, Principal, ReadDocument, RestoreError, Restoring, Session,
};
use tokio::time::timeout;

use super::{
    super::{
        handle::Request,
        outbox::{self, Outgoing, Outgoings},
    },
    *,
};
use crate::{
    SIMULATION_VERSION,
    memory::{Need, Use},
    pool::{Class, Person, Turn},
    store::{Breakable, Lease, NewSession, NewSnapshot},
};

const HELLO: &str = r#"{"type":"hello","protocol":4,"client":"test-client"}"#;

struct House {
    store: Arc<AnyStore>,
    stop: CancellationToken,
    memory: Memory,
    sessions: Sessions,
}

impl House {
    async fn new() -> Self {
        let house = Self::at(Arc::new(AnyStore::Memory(Box::default())));
        house.begin("oak", SIMULATION_VERSION, None).await;
        house
    }

    fn at(store: Arc<AnyStore>) -> Self {
        Self::with(store, Memory::of(1 << 40))
    }

    /// A server that may take so much memory.
    fn with(store: Arc<AnyStore>, memory: Memory) -> Self {
        let (pool, stop) = (SimulationPool::new(None).unwrap(), CancellationToken::new());
        let sessions = Sessions::new(Arc::clone(&store), pool, memory.clone(), stop.clone());
        Self { store, stop, memory, sessions }
    }

    async fn begin(&self, name: &str, simulation_version: u32, snapshot: Option<Vec<u8>>) {
        let new =
            NewSession { name: name.into(), seed: 7, simulation_version, snapshot, ..NewSession::default() };
        self.store.create_session(new).await.unwrap();
    }

    async fn restarted(self) -> Self {
        self.stop.cancel();
        self.sessions.ended().await;
        Self::at(self.store)
    }

    async fn visit(&self) -> Visitor {
        self.visit_to("oak").await
    }

    async fn visit_to(&self, name: &str) -> Visitor {
        let session = self.sessions.open(name).await.unwrap().unwrap();
        let (outbox, outgoings) = outbox::lane();
        let client = session.join(outbox, Entrant::new("somebody", Role::Editor)).await.unwrap();
        let mut visitor = Visitor { session, client, outgoings };
        visitor.say(HELLO).await;
        visitor
    }
}

/// What is taken for a session that is seated.
fn room(house: &House) -> Growing {
    Growing::new(house.memory.take(Use::Session, Need::Other, 0).unwrap())
}

/// A client without a socket.
struct Visitor {
    session: SessionHandle,
    client: ClientId,
    outgoings: Outgoings,
}

impl Visitor {
    async fn say(&mut self, text: &str) {
        self.session.send(Request::Text(self.client, text.into())).await.unwrap();
    }

    async fn grow(&mut self, id: u32) {
        self.say(&format!(r#"{{"type":"command","id":{id},"command":{{"kind":"grow","steps":3}}}}"#)).await;
    }

    /// The next control message that `pick` takes.
    async fn hear<T>(&mut self, pick: impl Fn(ServerMessage) -> Option<T>) -> T {
        let picked = async {
            loop {
                let Outgoing::Text(text) = self.outgoings.lane.recv().await.unwrap() else { continue };
                // As a socket says of what it has written. Fails when the session has ended.
                let _ = self.session.send(Request::Written(self.client, 1)).await;
                if let Some(picked) = pick(serde_json::from_str(&text).unwrap()) {
                    return picked;
                }
            }
        };
        timeout(Duration::from_secs(20), picked).await.unwrap()
    }

    async fn acknowledged(&mut self) -> u32 {
        self.hear(|message| match message {
            ServerMessage::Acknowledged { id } => Some(id),
            _ => None,
        })
        .await
    }

    /// The document when this step is reached.
    async fn reached(&self, step: u32) -> ReadDocument {
        loop {
            let document = self.session.read().await.unwrap();
            if Document::from_bytes(&document.bytes).unwrap().figures().step == step {
                return document;
            }
        }
    }

    /// Epoch, acknowledged command and living metamers of the welcome.
    async fn welcome(&mut self) -> (u32, u32, u32) {
        self.hear(|message| match message {
            ServerMessage::Welcome { epoch, acknowledged, state, .. } => {
                Some((epoch, acknowledged, state.metamers))
            }
            _ => None,
        })
        .await
    }

    async fn close_code(&self) -> CloseCode {
        timeout(Duration::from_secs(20), self.outgoings.closing.decided()).await.unwrap();
        self.outgoings.closing.farewell().code
    }
}

#[tokio::test]
async fn an_unknown_session_leaves_no_trace() {
    let house = House::new().await;
    assert!(house.sessions.open("elm").await.unwrap().is_none());
    assert!(house.sessions.0.slots().is_empty());
}

#[tokio::test]
async fn many_who_come_at_once_meet_in_one_session() {
    let house = House::new().await;
    let visits: Vec<_> = std::iter::repeat_with(|| house.visit()).take(8).collect();
    let mut epochs = Vec::new();
    for mut visitor in join_all(visits).await {
        epochs.push(visitor.welcome().await.0);
    }
    assert!(epochs.iter().all(|&epoch| epoch == epochs[0]), "{epochs:?}");
}

#[tokio::test]
async fn cm2_acknowledged_commands_survive_a_restart() {
    let house = House::new().await;
    let mut visitor = house.visit().await;
    let (epoch, ..) = visitor.welcome().await;
    visitor.grow(1).await;
    visitor.grow(2).await;
    while visitor.acknowledged().await < 2 {}
    let before = visitor.reached(6).await;
    assert!(before.metamers > 0);

    let house = house.restarted().await;
    let mut visitor = house.visit().await;
    let (epoch_after, acknowledged, metamers) = visitor.welcome().await;
    assert_ne!(epoch_after, epoch, "RS2");
    assert_eq!((acknowledged, metamers), (2, before.metamers));
    assert_eq!(visitor.session.read().await.unwrap().bytes, before.bytes);
}

#[tokio::test]
async fn rp3_who_did_what_is_known_by_name_after_a_restart() {
    let house = House::new().await;
    let mut visitor = house.visit().await;
    visitor.say(r#"{"type":"here","name":"Anne"}"#).await;
    visitor.grow(1).await;
    visitor.acknowledged().await;
    visitor.say(r#"{"type":"here","name":"Ann"}"#).await;
    visitor.reached(3).await;
    let house = house.restarted().await;
    let session = house.sessions.open("oak").await.unwrap().unwrap();
    let (document, people) = (session.read().await.unwrap(), session.register().await.unwrap());
    let replay = Session::replay("copy", 1, &document.bytes, people).unwrap();
    let session = house.sessions.play("copy", replay, room(&house));
    let (outbox, outgoings) = outbox::lane();
    let client = session.join(outbox, Entrant::new("a stranger", Role::Viewer)).await.unwrap();
    let mut visitor = Visitor { session, client, outgoings };
    visitor.say(&HELLO.replace("test-client", "another-client")).await;
    let authors = visitor.hear(|message| match message {
        ServerMessage::Authors { authors } => Some(authors),
        _ => None,
    });
    let names: Vec<_> = authors.await.into_iter().map(|author| author.name).collect();
    assert_eq!(names, [Some("Ann".to_owned())]);
}

fn grown(number: u64) -> JournalEntry {
    let command = r#"{"kind":"grow","steps":2}"#.into();
    let principal = Principal::client("test-client").unwrap();
    JournalEntry { number, principal, id: number as u32, command }
}

#[tokio::test]
async fn a_damaged_snapshot_falls_back_to_the_one_before() {
    let house = House::new().await;
    let mut visitor = house.visit().await;
    visitor.grow(1).await;
    visitor.acknowledged().await;
    let tree = visitor.reached(3).await;

    let start = Session::of_tree("elm", 1, &tree.bytes, 1_000_000).unwrap().1;
    house.begin("elm", SIMULATION_VERSION, Some(start)).await;
    let lease = house.store.acquire("elm").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION, &[grown(1)]).await.unwrap();
    // Its checksum is right, but it is no snapshot.
    let (simulation_version, bytes) = (SIMULATION_VERSION, b"damaged".to_vec());
    let damaged = NewSnapshot { through: 1, simulation_version, bytes, metamers: 1 };
    house.store.keep_snapshot(&lease, damaged).await.unwrap();
    let (_, acknowledged, metamers) = house.visit_to("elm").await.welcome().await;
    assert_eq!(acknowledged, 1);
    assert!(metamers > tree.metamers, "the tree it began with, grown on");
    let stored = house.store.load_session("elm", None).await.unwrap().unwrap();
    assert_ne!(stored.snapshot.as_deref(), Some(b"damaged".as_slice()), "it is put aside");
}

#[tokio::test]
async fn a_session_that_was_begun_is_in_memory_for_whoever_comes_and_leaves_if_nobody_does() {
    let house = House::new().await;
    let tree = Document::new(7).to_bytes();
    let (session, snapshot) = Session::of_tree("elm", 3, &tree, 1_000_000).unwrap();
    house.begin("elm", SIMULATION_VERSION, Some(snapshot)).await;
    house.sessions.seat("elm", session, room(&house)).await;
    let (epoch, ..) = house.visit_to("elm").await.welcome().await;
    assert_eq!(epoch, 3, "it was not loaded again");

    let (session, snapshot) = Session::of_tree("ash", 4, &tree, 1_000_000).unwrap();
    house.begin("ash", SIMULATION_VERSION, Some(snapshot)).await;
    house.sessions.seat("ash", session, room(&house)).await;
    let seated = house.sessions.0.slots().get("ash").cloned().unwrap();
    seated.session.get().unwrap().gone.cancelled().await;
    assert!(!house.sessions.0.slots().contains_key("ash"));
    assert!(house.sessions.0.slots().contains_key("elm"), "somebody is there");
}

#[tokio::test]
async fn a_session_without_a_sound_snapshot_is_not_invented() {
    let house = House::new().await;
    house.begin("elm", SIMULATION_VERSION, Some(b"damaged".to_vec())).await;
    let error = house.sessions.open("elm").await.unwrap_err();
    assert!(matches!(error, OpenError::Restore(RestoreError::Damaged)) && error.is_final(), "{error}");
    assert!(house.sessions.0.slots().is_empty());
}

#[tokio::test]
async fn op1_a_session_of_a_newer_program_opens_if_all_its_sections_are_known() {
    let house = House::new().await;
    house.begin("elm", SIMULATION_VERSION + 1, Some(Session::seedling(7, 1_000_000))).await;
    house.visit_to("elm").await.welcome().await;
    let later = include_bytes!("../../../session/golden/later.espalier");
    house.begin("ash", SIMULATION_VERSION, Some(later.to_vec())).await;
    let error = house.sessions.open("ash").await.unwrap_err();
    assert!(error.is_final());
    let words = "section FORK of version 1, which version 9.0.0 and later ones read";
    assert!(error.problem().in_close()[..123].contains(words), "{error}");
}

#[tokio::test]
async fn op1_a_snapshot_in_a_newer_format_is_not_passed_over() {
    let house = House::new().await;
    let start = Session::seedling(7, 1_000_000);
    house.begin("elm", SIMULATION_VERSION, Some(start.clone())).await;
    let lease = house.store.acquire("elm").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION, &[grown(1)]).await.unwrap();
    let mut bytes = start;
    // The container's format follows eight bytes of magic.
    bytes[8] = 99;
    let newer = NewSnapshot { through: 1, simulation_version: SIMULATION_VERSION, bytes, metamers: 1 };
    house.store.keep_snapshot(&lease, newer).await.unwrap();
    let error = house.sessions.open("elm").await.unwrap_err();
    assert!(matches!(error, OpenError::Later(_)) && error.is_final(), "{error}");
}

#[tokio::test]
async fn op2_op3_an_older_journal_is_done_again_and_said_once() {
    let house = House::new().await;
    house.begin("elm", SIMULATION_VERSION - 1, Some(Session::seedling(7, 1_000_000))).await;
    let lease = house.store.acquire("elm").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION - 1, &[grown(1)]).await.unwrap();
    let notified = |message| match message {
        ServerMessage::Notice { notice } => Some(notice),
        _ => None,
    };
    let mut visitor = house.visit_to("elm").await;
    let regrown = Notice::Regrown { from: SIMULATION_VERSION - 1, to: SIMULATION_VERSION };
    assert_eq!(visitor.hear(notified).await, regrown);
    assert!(visitor.session.read().await.unwrap().metamers > 1);
    visitor.session.send(Request::Written(visitor.client, 100)).await.unwrap();
    visitor.session.read().await.unwrap();
    // The snapshot that is made at once leaves nothing to be said the next time.
    let house = house.restarted().await;
    let stored = house.store.load_session("elm", None).await.unwrap().unwrap();
    assert_eq!((stored.through, stored.simulations.len()), (1, 0));
    let mut visitor = house.visit_to("elm").await;
    visitor.welcome().await;
    visitor.say(r#"{"type":"ping","nonce":5}"#).await;
    let pong = |message| match message {
        ServerMessage::Notice { notice } => panic!("{notice:?}"),
        ServerMessage::Pong { nonce, .. } => Some(nonce),
        _ => None,
    };
    assert_eq!(visitor.hear(pong).await, 5);
}

#[tokio::test]
async fn a_clean_stop_leaves_nothing_to_replay() {
    let house = House::new().await;
    let mut visitor = house.visit().await;
    visitor.grow(1).await;
    visitor.grow(2).await;
    while visitor.acknowledged().await < 2 {}
    let before = visitor.reached(6).await;
    let house = house.restarted().await;
    let stored = house.store.load_session("oak", None).await.unwrap().unwrap();
    assert_eq!((stored.through, stored.entries.len()), (2, 0));
    let visitor = house.visit().await;
    assert_eq!(visitor.session.read().await.unwrap().bytes, before.bytes);
}

#[tokio::test]
async fn a_stopping_server_says_goodbye() {
    let house = House::new().await;
    let visitor = house.visit().await;
    house.stop.cancel();
    assert_eq!(visitor.close_code().await, CloseCode::GoingAway);
    house.sessions.ended().await;
    assert!(matches!(house.sessions.open("oak").await, Err(OpenError::Stopping)));
}

#[tokio::test]
async fn cm2_nothing_is_acknowledged_that_was_not_written() {
    let house = House::new().await;
    let mut visitor = house.visit().await;
    let (epoch, ..) = visitor.welcome().await;
    // From here on every write fails, as on a full disk.
    house.store.close().await;
    visitor.grow(1).await;
    assert_eq!(visitor.close_code().await, CloseCode::InternalError);
    while let Ok(outgoing) = visitor.outgoings.lane.try_recv() {
        let Outgoing::Text(text) = outgoing else { continue };
        assert!(!text.contains("\"type\":\"acknowledged\""), "{text}");
    }
    // Who joins now gets the session as it is on disk.
    let mut visitor = house.visit().await;
    let (epoch_after, acknowledged, metamers) = visitor.welcome().await;
    assert_ne!(epoch_after, epoch);
    assert_eq!((acknowledged, metamers), (0, 0));
}

#[tokio::test]
async fn hs8_a_session_that_is_opened_says_how_far_it_is() {
    let house = House::new().await;
    let lease = house.store.acquire("oak").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION, &[grown(1), grown(2)]).await.unwrap();
    let share = |opening: &Opening| opening.share.clone();
    let opening = house.sessions.opening("oak");
    let oak = share(&opening).unwrap();
    assert!(opening.opened().await.unwrap().is_some());
    assert_eq!(*oak.borrow(), Some(1.0));
    let opening = house.sessions.opening("oak");
    assert!(share(&opening).is_none(), "it is in memory");
    assert!(opening.opened().await.unwrap().is_some());
    let opening = house.sessions.opening("elm");
    let elm = share(&opening).unwrap();
    assert!(opening.opened().await.unwrap().is_none());
    assert_eq!(*elm.borrow(), None, "there is none");
}

#[tokio::test]
async fn op4_a_panic_while_restoring_falls_back_to_the_snapshot_before() {
    let house = House::new().await;
    house.begin("elm", SIMULATION_VERSION, Some(Session::seedling(7, 1_000_000))).await;
    let lease = house.store.acquire("elm").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION, &[grown(1)]).await.unwrap();
    let bytes = b"deadly".to_vec();
    let deadly = NewSnapshot { through: 1, simulation_version: SIMULATION_VERSION, bytes, metamers: 1 };
    house.store.keep_snapshot(&lease, deadly).await.unwrap();
    let begin: restoring::Begin = |name, epoch, snapshot, seed, entries, tail| {
        assert_ne!(snapshot, Some(b"deadly".as_slice()), "on purpose, for a test");
        Restoring::new(name, epoch, snapshot, seed, entries, tail)
    };
    let (services, progress) = (&house.sessions.0.services, Progress::default());
    let session = restoring::restored_by(begin, services, "elm", &lease, &progress).await;
    let Opened { session, .. } = session.unwrap().unwrap();
    assert_eq!(session.document().unwrap().figures().step, 2);
    let stored = house.store.load_session("elm", None).await.unwrap().unwrap();
    assert_eq!((stored.through, stored.damage), (0, vec![]), "it is put aside");
}

#[tokio::test]
async fn op1_a_sealed_entry_that_is_no_command_is_a_newer_programs() {
    let house = House::new().await;
    let lease = house.store.acquire("oak").await.unwrap();
    let later = JournalEntry { command: r#"{"kind":"fly"}"#.into(), ..grown(1) };
    house.store.append(&lease, SIMULATION_VERSION, &[later]).await.unwrap();
    let error = house.sessions.open("oak").await.unwrap_err();
    assert!(matches!(error, OpenError::Later(_)) && error.is_final(), "{error}");
    assert!(error.to_string().contains(env!("CARGO_PKG_VERSION")), "{error}");
    assert!(error.problem().in_close().len() <= 123, "it fits into the reason of a close");
    assert_eq!(house.store.load_session("oak", None).await.unwrap().unwrap().damage, []);
}

/// A session whose last entry is gone.
async fn with_a_lost_entry(house: &House) -> Lease {
    let lease = house.store.acquire("oak").await.unwrap();
    house.store.append(&lease, SIMULATION_VERSION, &[grown(1)]).await.unwrap();
    let AnyStore::Memory(store) = &*house.store else { unreachable!("the model") };
    store.lose_journal("oak", 1).await;
    lease
}

#[tokio::test]
async fn op3_notices_wait_in_the_store_for_somebody() {
    let house = House::new().await;
    with_a_lost_entry(&house).await;
    // The first who opens it asks for the tree, and nobody is there to be notified.
    let session = house.sessions.open("oak").await.unwrap().unwrap();
    session.read().await.unwrap();
    let house = house.restarted().await;
    let damaged = Notice::Damaged { entry: 1 };
    let mut visitor = house.visit().await;
    let notified = |message| match message {
        ServerMessage::Notice { notice } => Some(notice),
        _ => None,
    };
    assert_eq!(visitor.hear(notified).await, damaged);
    // It has been handed to the lane; whether it has gone out only the socket knows.
    let stored = house.store.load_session("oak", None).await.unwrap().unwrap();
    assert_eq!((stored.notices, stored.damage), (vec![damaged], vec![]));
    visitor.session.send(Request::Written(visitor.client, 100)).await.unwrap();
    visitor.session.read().await.unwrap();
    let house = house.restarted().await;
    let stored = house.store.load_session("oak", None).await.unwrap().unwrap();
    assert_eq!(stored.notices, []);
}

#[tokio::test]
async fn a_load_that_nobody_waits_for_any_more_leaves_nothing_behind() {
    let house = House::new().await;
    let (open, gate) = std::sync::mpsc::channel::<()>();
    let pool = house.sessions.0.services.pool.clone();
    let workers = pool.block_on(rayon::current_num_threads).max(2);
    let gate = Arc::new(Mutex::new(gate));
    let held: Vec<_> = (0..workers)
        .map(|_| {
            let (pool, gate) = (pool.clone(), Arc::clone(&gate));
            tokio::spawn(async move {
                let wait = move |_: &Turn<'_>| gate.lock().unwrap().recv().is_ok();
                pool.run(Class::Growing, Person::default(), wait).await
            })
        })
        .collect();
    tokio::task::yield_now().await;
    {
        let mut opening = std::pin::pin!(house.sessions.open("oak"));
        while !house.sessions.0.slots().contains_key("oak") {
            assert!(futures_util::poll!(opening.as_mut()).is_pending());
            tokio::task::yield_now().await;
        }
    }
    drop(open);
    for one in held {
        one.await.unwrap().unwrap();
    }
    house.stop.cancel();
    house.sessions.ended().await;
    assert!(house.sessions.0.slots().is_empty());
}
