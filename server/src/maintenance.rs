//! What is done beside the work: what nobody can want any more goes, in small steps, and a database that is gone is noticed.

use std::{
    sync::Arc,
    time::{Duration, SystemTime},
};

use tokio::time::{interval, sleep};
use tokio_util::sync::CancellationToken;

use crate::{
    live::Sessions,
    store::{AnyStore, Library, Store, StoreError},
};

/// How often.
const PERIOD: Duration = Duration::from_hours(1);
/// How often the file is looked for.
const WATCH_PERIOD: Duration = Duration::from_secs(2);
/// A tree that was deleted can be taken back for so long.
const UNDELETABLE: Duration = Duration::from_hours(30 * 24);
/// Trees that go in one step, so that people's work has its turns between.
const STEP: u32 = 8;
const PAUSE: Duration = Duration::from_millis(100);

/// Runs until the server stops.
pub async fn run(store: Arc<AnyStore>, stop: CancellationToken) {
    let mut ticks = interval(PERIOD);
    let work = async {
        loop {
            ticks.tick().await;
            if let Err(error) = once(&store, SystemTime::now()).await {
                tracing::warn!(%error, "the database could not be looked after; it is tried again later");
            }
        }
    };
    stop.run_until_cancelled(work).await;
}

/// Looks whether the database is still there, until the server stops. Where it is not, everybody in a session is told, for
/// not all of them are about to draw.
pub async fn watch(store: Arc<AnyStore>, sessions: Sessions, stop: CancellationToken) {
    let mut ticks = interval(WATCH_PERIOD);
    let mut was_there = true;
    let work = async {
        loop {
            ticks.tick().await;
            let found = store.check_place().await;
            match &found {
                Ok(()) if !was_there => tracing::info!("the database is there again"),
                Err(error) if was_there => {
                    tracing::error!(%error, "nothing can be kept until it is back or the server is started anew");
                    sessions.fail(error.in_words()).await;
                }
                _ => {}
            }
            was_there = found.is_ok();
        }
    };
    stop.run_until_cancelled(work).await;
}

/// Does what is due at a time.
async fn once(store: &AnyStore, now: SystemTime) -> Result<(), StoreError> {
    let before = humantime::format_rfc3339_millis(now - UNDELETABLE).to_string();
    while store.purge(&before, STEP).await? > 0 {
        sleep(PAUSE).await;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::{Deletion, MemoryStore, TreeChange, tree};

    #[tokio::test]
    async fn lb6_what_was_deleted_thirty_days_ago_goes() {
        let store = AnyStore::Memory(MemoryStore::default());
        for (id, at) in [("ash", "2026-05-01T11:59:59.999Z"), ("elm", "2026-05-01T12:00:00.000Z")] {
            store.add_tree(tree(id, "2026")).await.unwrap();
            let deletion = Some(Deletion::Deleted(at.into()));
            store.change_tree(id, None, TreeChange { deletion, ..TreeChange::default() }).await.unwrap();
        }
        let now = humantime::parse_rfc3339("2026-05-31T12:00:00Z").unwrap();
        once(&store, now).await.unwrap();
        assert_eq!(store.tree("ash").await.unwrap(), None);
        assert!(store.tree("elm").await.unwrap().is_some());
    }
}
