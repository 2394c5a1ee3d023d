//! Sessions where memory is short (`LM19`).

use espalier_proto::{DocumentState, Pause, Reason};

use super::*;
use crate::{
    live::Unread,
    memory::{Claim, Full, session},
};

const NAMES: [&str; 12] =
    ["ash", "beech", "birch", "elm", "fir", "larch", "lime", "maple", "pine", "plum", "rowan", "yew"];

/// A server that may take so much memory, and waits for none.
fn short_of(bytes: u64) -> House {
    let store = Arc::new(AnyStore::Memory(Box::default()));
    House::with(store, Memory::with_patience(bytes, Duration::from_millis(50)))
}

/// All that others may take, but for this much.
fn taken_but(house: &House, left: u64) -> Claim {
    let all = house.memory.look().left();
    house.memory.take(Use::Job, Need::Other, all - left).unwrap()
}

fn state(message: ServerMessage) -> Option<DocumentState> {
    match message {
        ServerMessage::State { state } => Some(state),
        _ => None,
    }
}

fn grow(id: u32, steps: u32) -> String {
    format!(r#"{{"type":"command","id":{id},"command":{{"kind":"grow","steps":{steps}}}}}"#)
}

#[tokio::test]
async fn lm19_growth_rests_where_memory_is_short_and_goes_on_when_there_is_some() {
    let house = short_of(1 << 30);
    house.begin("oak", SIMULATION_VERSION, None).await;
    let mut visitor = house.visit().await;
    let others = taken_but(&house, 1 << 20);
    visitor.say(&grow(1, 40)).await;
    assert_eq!(visitor.acknowledged().await, 1);
    let resting = visitor.hear(|message| state(message).filter(|state| state.paused.is_some())).await;
    assert_eq!(resting.paused, Some(Pause::Memory));
    assert!(resting.pending_steps > 0);
    drop(others);
    visitor.hear(|message| matches!(message, ServerMessage::Done { id: 1, .. }).then_some(())).await;
    assert_eq!(visitor.reached(40).await.through, 1);
}

#[tokio::test]
async fn lm19_a_session_opens_when_there_is_memory_for_it() {
    let house = short_of(1 << 30);
    house.begin("oak", SIMULATION_VERSION, None).await;
    let others = taken_but(&house, 1000);
    let error = house.sessions.open("oak").await.unwrap_err();
    assert_eq!((error.problem().reason, error.is_final()), (Reason::MemoryFull, false));
    drop(others);
    assert!(house.sessions.open("oak").await.unwrap().is_some());
}

#[tokio::test]
async fn lm19_sessions_in_which_nobody_is_leave_first() {
    let house = short_of(1 << 30);
    for name in ["oak", "elm"] {
        house.begin(name, SIMULATION_VERSION, None).await;
    }
    let mut visitor = house.visit().await;
    visitor.say(&grow(1, 2)).await;
    visitor.acknowledged().await;
    visitor.hear(|message| matches!(message, ServerMessage::Done { id: 1, .. }).then_some(())).await;
    visitor.session.send(Request::Leave(visitor.client)).await.unwrap();
    let _others = taken_but(&house, 1000);
    // It takes a snapshot along, and may not have left when the first one asks.
    let opened = async { while house.sessions.open("elm").await.is_err() {} };
    timeout(Duration::from_secs(20), opened).await.unwrap();
    let stored = house.store.load_session("oak", None).await.unwrap().unwrap();
    assert_eq!((stored.through, stored.entries.len()), (1, 0), "it left with a snapshot");
}

#[tokio::test]
async fn lm19_who_asks_for_a_tree_whose_growth_rests_is_told_to_come_back() {
    let house = short_of(1 << 30);
    house.begin("oak", SIMULATION_VERSION, None).await;
    let mut visitor = house.visit().await;
    let others = taken_but(&house, 1 << 20);
    visitor.say(&grow(1, 40)).await;
    visitor.hear(|message| state(message).filter(|state| state.paused.is_some())).await;
    assert_eq!(visitor.session.read().await.unwrap_err(), Unread::Memory(Full));
    visitor.session.send(Request::Leave(visitor.client)).await.unwrap();
    assert_eq!(visitor.session.read().await.unwrap_err(), Unread::Memory(Full), "nobody is there");
    drop(others);
    finished(&house, "oak").await;
}

/// Asks until the session has done its command, as a program does that is told to come back.
async fn finished(house: &House, name: &str) {
    let asked = async {
        loop {
            let Ok(Some(session)) = house.sessions.open(name).await else { continue };
            if session.read().await.is_ok_and(|document| document.through == 1) {
                break;
            }
        }
    };
    timeout(Duration::from_secs(60), asked).await.unwrap();
}

#[tokio::test]
async fn lm19_sessions_that_want_more_than_there_is_are_all_answered() {
    // Room for the sessions, and for some of them to grow.
    let house = short_of(session(0) * NAMES.len() as u64 * 100 / 85 + (4 << 20));
    let mut visitors = Vec::new();
    for name in NAMES {
        house.begin(name, SIMULATION_VERSION, None).await;
        visitors.push(house.visit_to(name).await);
    }
    for visitor in &mut visitors {
        visitor.say(&grow(1, 12)).await;
    }
    let mut resting = 0;
    for visitor in &mut visitors {
        assert_eq!(visitor.acknowledged().await, 1);
        resting += visitor
            .hear(|message| match message {
                ServerMessage::State { state } if state.paused.is_some() => Some(1),
                ServerMessage::Done { id: 1, .. } => Some(0),
                _ => None,
            })
            .await;
        assert!(house.memory.look().taken() <= house.memory.look().all());
    }
    assert!(resting > 0, "there is less than they want");
    for visitor in visitors {
        visitor.session.send(Request::Leave(visitor.client)).await.unwrap();
    }
    // One after the other has what it wants, for whoever has left makes room.
    for name in NAMES {
        finished(&house, name).await;
    }
}

#[tokio::test]
async fn lm19_sessions_that_find_room_only_one_by_one_all_finish() {
    // The first has done its command where there is room for more than one; no two of them find as much.
    let wide = short_of(1 << 30);
    let command = JournalEntry { command: r#"{"kind":"grow","steps":30}"#.into(), ..grown(1) };
    let begun = async |house: &House, name: &str| {
        house.begin(name, SIMULATION_VERSION, None).await;
        let lease = house.store.acquire(name).await.unwrap();
        house.store.append(&lease, SIMULATION_VERSION, std::slice::from_ref(&command)).await.unwrap();
        house.store.release(lease).await;
    };
    begun(&wide, "oak").await;
    finished(&wide, "oak").await;
    let wanted = wide.memory.look().taken_for(Use::Session);
    let house = short_of((wanted + wanted / 2) * 100 / 85);
    for name in ["oak", "elm", "ash"] {
        begun(&house, name).await;
    }
    join_all(["oak", "elm", "ash"].map(|name| finished(&house, name))).await;
}
