//! The contract of the list of events.

use super::super::{Audit, Event};

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
        found.into_iter().map(|(_, event)| event.at).collect()
    };
    let all = store.events(9, None).await.unwrap();
    assert_eq!(all[0].1, Event { address: None, object: None, ..event("2026-04") });
    assert_eq!(all[1].1, event("2026-03"));
    assert_eq!(times(2, None).await, ["2026-04", "2026-03"]);
    assert_eq!(times(2, Some(all[1].0)).await, ["2026-02", "2026-01"]);
    assert!(times(2, Some(all[3].0)).await.is_empty());
    store.purge_events("2026-03").await.unwrap();
    assert_eq!(times(9, None).await, ["2026-04", "2026-03"]);
    store.note(event("2026-05")).await.unwrap();
    assert!(store.events(1, None).await.unwrap()[0].0 > all[0].0, "numbers are used once");
}
