//! The contract of the list of events.

use super::super::{Audit, EXPORT, Event, Noted, audit::MOST_REFUSED};

fn event(at: &str) -> Event {
    Event {
        at: at.into(),
        who: "login Ada".into(),
        address: Some("192.168.1.9".into()),
        action: "delete".into(),
        object: Some("ash".into()),
        outcome: "done".into(),
    }
}

pub(super) async fn events_are_listed_newest_first(store: &impl Audit) {
    for at in ["2026-01", "2026-02", "2026-03"] {
        store.note(event(at)).await.unwrap();
    }
    store.note(Event { address: None, object: None, ..event("2026-04") }).await.unwrap();
    let times = async |limit, before| -> Vec<String> {
        let found = store.events(limit, before).await.unwrap();
        found.into_iter().map(|noted| noted.event.at).collect()
    };
    let all = store.events(9, None).await.unwrap();
    assert_eq!(all[0].event, Event { address: None, object: None, ..event("2026-04") });
    assert_eq!(all[1].event, event("2026-03"));
    assert_eq!(times(2, None).await, ["2026-04", "2026-03"]);
    assert_eq!(times(2, Some(all[1].number)).await, ["2026-02", "2026-01"]);
    assert!(times(2, Some(all[3].number)).await.is_empty());
    store.purge_events("2026-03").await.unwrap();
    assert_eq!(times(9, None).await, ["2026-04", "2026-03"]);
    store.note(event("2026-05")).await.unwrap();
    assert!(store.events(1, None).await.unwrap()[0].number > all[0].number, "numbers are used once");
}

/// Hour and minute of a day, with an outcome.
fn refused(at: &str, object: &str) -> Event {
    Event { object: Some(object.into()), outcome: "403".into(), ..event(&format!("2026-05-{at}:00.000Z")) }
}

pub(super) async fn events_that_come_again_are_counted(store: &impl Audit) {
    let counts = async || -> Vec<(u32, Option<String>)> {
        let all = store.events(1000, None).await.unwrap();
        all.into_iter().map(|Noted { times, last_at, .. }| (times, last_at)).collect()
    };
    for at in ["01T09:00", "01T09:01", "02T08:59"] {
        store.note(refused(at, "ash")).await.unwrap();
    }
    let last = Some("2026-05-02T08:59:00.000Z".to_owned());
    assert_eq!(counts().await, [(3, last)]);
    assert_eq!(store.events(1, None).await.unwrap()[0].event, refused("01T09:00", "ash"), "as it came first");
    store.note(refused("02T09:01", "ash")).await.unwrap();
    assert_eq!(counts().await.len(), 2, "each day anew");
    // Other people, and what was done, have rows of their own.
    store.note(Event { who: "login Bo".into(), ..refused("02T09:02", "ash") }).await.unwrap();
    for _ in 0..2 {
        store.note(Event { outcome: "done".into(), ..refused("02T09:02", "ash") }).await.unwrap();
    }
    assert_eq!(counts().await.len(), 5);
    for _ in 0..2 {
        let taken = Event { action: EXPORT.into(), outcome: "done".into(), ..refused("02T09:02", "ash") };
        store.note(taken).await.unwrap();
    }
    assert_eq!(counts().await.len(), 6);
    // Who is refused each time something else fills the list no faster.
    for number in 0..3 * MOST_REFUSED {
        store.note(refused("02T09:03", &format!("tree {number}"))).await.unwrap();
    }
    let all = counts().await;
    assert_eq!(all.len() as u32, 6 + MOST_REFUSED - 1);
    assert_eq!(all.iter().map(|(times, _)| times).sum::<u32>(), 9 + 3 * MOST_REFUSED);
    // What is still refused is no old news.
    store.purge_events("2026-05-02").await.unwrap();
    assert_eq!(counts().await.len(), all.len());
}
