//! What is done beside the work: what nobody can want any more goes, in small steps, and a database that is gone is noticed.

use std::{
    sync::Arc,
    time::{Duration, SystemTime},
};

use espalier_proto::version::KEPT_DAYS;
use tokio::{
    sync::Notify,
    time::{interval, sleep},
};
use tokio_util::sync::CancellationToken;

use crate::{
    http,
    live::Sessions,
    store::{Answers, AnyStore, Audit, Library, Passes, Store, StoreError},
    time::written,
};

/// How often.
const PERIOD: Duration = Duration::from_hours(1);
/// How often the file is looked for.
const WATCH_PERIOD: Duration = Duration::from_secs(2);
/// A tree that was deleted can be taken back for so long.
const UNDELETABLE: Duration = Duration::from_hours(KEPT_DAYS as u64 * 24);
/// A session that is saved goes when nobody has entered it for so long; the tree stays.
const SAVED_SESSIONS: Duration = Duration::from_hours(30 * 24);
/// What was done is kept on the list for so long.
const EVENTS: Duration = Duration::from_hours(365 * 24);
/// Trees or sessions that go in one step, so that people's work has its turns between.
const STEP: u32 = 8;
const PAUSE: Duration = Duration::from_millis(100);

/// Runs until the server stops, at times and when told. A session that is not saved is kept for `unsaved` after somebody
/// was in it.
pub async fn run(store: Arc<AnyStore>, unsaved: Duration, told: Arc<Notify>, stop: CancellationToken) {
    let mut ticks = interval(PERIOD);
    let work = async {
        loop {
            tokio::select! {
                _ = ticks.tick() => {}
                () = told.notified() => {}
            }
            once(&store, unsaved, SystemTime::now()).await;
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

/// Does what is due at a time: first what makes room, for on a full disk nothing else can be done. What fails keeps nothing
/// else from being done.
async fn once(store: &AnyStore, unsaved: Duration, now: SystemTime) {
    let before = |span| written(now - span);
    let trees = async {
        while store.purge(&before(UNDELETABLE), STEP).await? > 0 {
            sleep(PAUSE).await;
        }
        Ok(())
    };
    let sessions = async {
        let (saved, unsaved) = (before(SAVED_SESSIONS.min(unsaved)), before(unsaved));
        loop {
            let gone = store.purge_sessions(&saved, &unsaved, STEP).await?;
            if gone == 0 {
                return Ok(());
            }
            tracing::info!(gone, "sessions that nobody had entered for long were given up");
            sleep(PAUSE).await;
        }
    };
    let room = async {
        while store.shrink().await? {
            sleep(PAUSE).await;
        }
        Ok(())
    };
    tried("deleted trees", trees.await);
    tried("old sessions", sessions.await);
    tried("room that is free", room.await);
    tried("old passes", store.purge_passes(&written(now)).await);
    tried("old answers", store.purge_answers(&before(http::KEPT)).await);
    tried("old events", store.purge_events(&before(EVENTS)).await);
}

/// Says of a step where it failed; it is tried again next time.
fn tried(what: &str, done: Result<(), StoreError>) {
    if let Err(error) = done {
        tracing::warn!(%error, what, "the database could not be looked after; it is tried again later");
    }
}

#[cfg(test)]
mod tests {
    use sqlx::{ConnectOptions, sqlite::SqliteConnectOptions};

    use super::*;
    use crate::store::{AnswerKey, Deletion, MostAnswers, NewSession, SqliteStore, TreeChange, tree};

    const UNSAVED: Duration = Duration::from_hours(90 * 24);

    #[tokio::test]
    async fn lb6_what_was_deleted_thirty_days_ago_goes() {
        let store = AnyStore::Memory(Box::default());
        for (id, at) in [("ash", "2026-05-01T11:59:59.999Z"), ("elm", "2026-05-01T12:00:00.000Z")] {
            store.add_tree(tree(id, "2026")).await.unwrap();
            let deletion = Some(Deletion::Deleted(at.into()));
            store.change_tree(id, None, TreeChange { deletion, ..TreeChange::default() }).await.unwrap();
        }
        let now = humantime::parse_rfc3339("2026-05-31T12:00:00Z").unwrap();
        once(&store, UNSAVED, now).await;
        assert_eq!(store.tree("ash").await.unwrap(), None);
        assert!(store.tree("elm").await.unwrap().is_some());
    }

    #[tokio::test]
    async fn lb6_what_cannot_be_tidied_keeps_nothing_else_from_going() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("trees.db");
        let store = AnyStore::Sqlite(SqliteStore::open(&path).await.unwrap());
        store.add_tree(tree("ash", "2026")).await.unwrap();
        let deletion = Some(Deletion::Deleted("2026-05-01T12:00:00.000Z".into()));
        store.change_tree("ash", None, TreeChange { deletion, ..TreeChange::default() }).await.unwrap();
        let mut beside = SqliteConnectOptions::new().filename(&path).connect().await.unwrap();
        for table in ["ALTER TABLE answers RENAME TO lost_answers", "ALTER TABLE audit RENAME TO lost_audit"]
        {
            sqlx::query(table).execute(&mut beside).await.unwrap();
        }
        once(&store, UNSAVED, humantime::parse_rfc3339("2026-07-01T12:00:00Z").unwrap()).await;
        assert_eq!(store.tree("ash").await.unwrap(), None);
        assert!(store.purge_answers("2026").await.is_err(), "that failed");
        store.close().await;
    }

    #[tokio::test]
    async fn lb8_a_session_that_nobody_enters_goes_later_where_it_is_not_saved() {
        let store = AnyStore::Memory(Box::default());
        for (name, snapshot) in [("seedling", None), ("unsaved", Some(vec![1]))] {
            let new = NewSession { name: name.into(), snapshot, ..NewSession::default() };
            store.create_session(new).await.unwrap();
        }
        let days = |days: u64| SystemTime::now() + Duration::from_hours(24 * days);
        let mut left = Vec::new();
        for day in [29, 31, 89, 91] {
            once(&store, UNSAVED, days(day)).await;
            let is_there = async |name| store.has_session(name).await.unwrap();
            left.push((is_there("seedling").await, is_there("unsaved").await));
        }
        assert_eq!(left, [(true, true), (false, true), (false, true), (false, false)]);
    }

    #[tokio::test]
    async fn ik4_answers_go_after_a_day() {
        let store = AnyStore::Memory(Box::default());
        let key = |byte| AnswerKey { caller: [1; 32], key: [byte; 32] };
        for (byte, at) in [(1, "2026-05-30T11:59:59.999Z"), (2, "2026-05-30T12:00:00.000Z")] {
            assert!(store.begin_answer(key(byte), at, "2026", MostAnswers::default()).await.unwrap());
        }
        let now = humantime::parse_rfc3339("2026-05-31T12:00:00Z").unwrap();
        once(&store, UNSAVED, now).await;
        assert_eq!(store.answer(key(1)).await.unwrap(), None);
        assert!(store.answer(key(2)).await.unwrap().is_some());
    }
}
