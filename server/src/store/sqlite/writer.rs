//! The one writer: collects what arrives within a few milliseconds and commits it together.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use sqlx::{Connection, sqlite::SqliteConnection};
use tokio::{
    sync::{Mutex, mpsc, oneshot},
    task::JoinHandle,
    time::{Instant, timeout_at},
};
use tokio_util::sync::CancellationToken;

use super::{
    super::{Commits, StoreError, lease::Leases},
    answers::AnswerWrite,
    audit::AuditWrite,
    authors::AuthorWrite,
    comments::CommentWrite,
    finding::FindingWrite,
    gifts::GiftWrite,
    groups::GroupWrite,
    locks::LockWrite,
    parts::{self, Orphans, Part},
    passes::PassWrite,
    place::Place,
    reserve::Reserve,
    sessions::SessionWrite,
    shrinking,
    standings::StandingWrite,
    tree_writes::TreeWrite,
    users::UserWrite,
    visits::VisitWrite,
};

/// How long a write waits for others to be committed with it. What arrives during a commit is in the next group.
const GROUP_WINDOW: Duration = Duration::from_millis(5);
/// The most writes in one commit.
const MAX_GROUP: usize = 256;
/// Writes waiting for the writer; beyond that, whoever writes waits too.
const QUEUE: usize = 256;

/// Anything that changes the database.
#[derive(Debug)]
pub(super) enum Write {
    Session(SessionWrite),
    Tree(TreeWrite),
    Finding(FindingWrite),
    Parts(Vec<Part>),
    /// Rows that nothing referred to a moment ago.
    Orphans(Orphans, Vec<i64>),
    /// Answers with 1 if there is more to give back.
    Shrink,
    Pass(PassWrite),
    User(UserWrite),
    Group(GroupWrite),
    Gift(GiftWrite),
    Audit(AuditWrite),
    Author(AuthorWrite),
    Answer(AnswerWrite),
    Comment(CommentWrite),
    Lock(LockWrite),
    Visit(VisitWrite),
    Standing(StandingWrite),
    #[cfg(test)]
    Raw(String),
}

impl Write {
    /// Whether the disk has more room afterwards, or will have once the database has shrunk.
    const fn frees(&self) -> bool {
        match self {
            Self::Tree(write) => write.frees(),
            Self::Session(write) => write.frees(),
            Self::Orphans(..) | Self::Shrink => true,
            _ => false,
        }
    }

    /// Answers with the number of rows changed, or of the version made.
    async fn apply(&self, connection: &mut SqliteConnection, leases: &Leases) -> Result<u64, StoreError> {
        match self {
            Self::Session(write) => write.apply(connection, leases).await,
            Self::Tree(write) => write.apply(connection).await,
            Self::Finding(write) => write.apply(connection).await,
            Self::Parts(some) => parts::write(connection, some).await,
            Self::Orphans(orphans, ids) => orphans.delete(connection, ids).await,
            Self::Shrink => Ok(shrinking::step(connection).await?.into()),
            Self::Pass(write) => write.apply(connection).await,
            Self::User(write) => write.apply(connection).await,
            Self::Group(write) => write.apply(connection).await,
            Self::Gift(write) => write.apply(connection).await,
            Self::Audit(write) => write.apply(connection).await,
            Self::Author(write) => write.apply(connection).await,
            Self::Answer(write) => write.apply(connection).await,
            Self::Comment(write) => write.apply(connection).await,
            Self::Lock(write) => write.apply(connection).await,
            Self::Visit(write) => write.apply(connection).await,
            Self::Standing(write) => write.apply(connection).await,
            #[cfg(test)]
            Self::Raw(sql) => {
                let query = sqlx::query(sqlx::AssertSqlSafe(sql.clone()));
                Ok(query.execute(connection).await?.rows_affected())
            }
        }
    }
}

#[derive(Debug)]
struct Request {
    write: Write,
    answer: oneshot::Sender<Result<u64, StoreError>>,
}

/// What was committed, from the start on.
#[derive(Debug, Default)]
struct Counts {
    commits: AtomicU64,
    writes: AtomicU64,
    failed: AtomicU64,
    micros: AtomicU64,
}

#[derive(Debug)]
pub(super) struct Writer {
    requests: mpsc::Sender<Request>,
    leases: Arc<Leases>,
    counts: Arc<Counts>,
    closing: CancellationToken,
    task: Mutex<Option<JoinHandle<()>>>,
}

impl Writer {
    /// Room is kept for deleting, or what is kept already may be given up.
    pub(super) fn start(connection: SqliteConnection, place: Arc<Place>, reserve: Reserve) -> Self {
        let (requests, receiver) = mpsc::channel(QUEUE);
        let closing = CancellationToken::new();
        let (leases, counts) = (Arc::new(Leases::default()), Arc::<Counts>::default());
        let (of_task, counted) = (Arc::clone(&leases), Arc::clone(&counts));
        let task =
            tokio::spawn(run(connection, (place, reserve), receiver, of_task, counted, closing.clone()));
        Self { requests, leases, counts, closing, task: Mutex::new(Some(task)) }
    }

    /// Who may write to which session.
    pub(super) fn leases(&self) -> &Leases {
        &self.leases
    }

    /// What was committed, from the start on.
    pub(super) fn commits(&self) -> Commits {
        let count = |count: &AtomicU64| count.load(Ordering::Relaxed);
        Commits {
            commits: count(&self.counts.commits),
            writes: count(&self.counts.writes),
            failed: count(&self.counts.failed),
            took: Duration::from_micros(count(&self.counts.micros)),
        }
    }

    /// Returns once the write is durable.
    pub(super) async fn write(&self, write: Write) -> Result<u64, StoreError> {
        let (answer, answered) = oneshot::channel();
        self.requests.send(Request { write, answer }).await.map_err(|_| StoreError::Closed)?;
        answered.await.map_err(|_| StoreError::Closed)?
    }

    /// Commits what has come so far and closes the connection.
    pub(super) async fn close(&self) {
        self.closing.cancel();
        let Some(task) = self.task.lock().await.take() else { return };
        if let Err(error) = task.await {
            tracing::error!(%error, "the database writer ended badly");
        }
    }
}

async fn run(
    mut connection: SqliteConnection,
    (place, reserve): (Arc<Place>, Reserve),
    mut requests: mpsc::Receiver<Request>,
    leases: Arc<Leases>,
    counts: Arc<Counts>,
    closing: CancellationToken,
) {
    loop {
        let first = tokio::select! {
            biased;
            first = requests.recv() => first,
            () = closing.cancelled() => {
                // What is queued is still taken, but nothing after it.
                requests.close();
                requests.recv().await
            }
        };
        let Some(first) = first else { break };
        let mut group = vec![first];
        let deadline = Instant::now() + GROUP_WINDOW;
        while group.len() < MAX_GROUP {
            match timeout_at(deadline, requests.recv()).await {
                Ok(Some(request)) => group.push(request),
                Ok(None) | Err(_) => break,
            }
        }
        match place.missing() {
            None => {
                let begun = Instant::now();
                commit(&mut connection, &reserve, &leases, &counts, group).await;
                let took = u64::try_from(begun.elapsed().as_micros()).unwrap_or(u64::MAX);
                counts.micros.fetch_add(took, Ordering::Relaxed);
            }
            Some(cause) => {
                for request in group {
                    let _ = request.answer.send(Err(StoreError::Gone(cause.clone())));
                }
            }
        }
    }
    if let Err(error) = connection.close().await {
        tracing::error!(%error, "closing the database failed");
    }
}

/// A group is committed as one; if that fails, each write is tried alone, so that one cannot spoil the others.
async fn commit(
    connection: &mut SqliteConnection,
    reserve: &Reserve,
    leases: &Leases,
    counts: &Counts,
    group: Vec<Request>,
) {
    counts.writes.fetch_add(group.len() as u64, Ordering::Relaxed);
    if group.len() > 1 {
        let writes: Vec<&Write> = group.iter().map(|request| &request.write).collect();
        match commit_together(connection, leases, &writes).await {
            Ok(changed) => {
                counts.commits.fetch_add(1, Ordering::Relaxed);
                for (request, changed) in group.into_iter().zip(changed) {
                    // Whoever asked may have gone; the write stands all the same.
                    let _ = request.answer.send(Ok(changed));
                }
                return;
            }
            Err(error) => tracing::debug!(%error, "a group of writes failed; trying them one by one"),
        }
    }
    for request in group {
        let mut result = commit_together(connection, leases, &[&request.write]).await;
        let is_full = result.as_ref().is_err_and(StoreError::is_full_disk);
        if is_full && request.write.frees() && reserve.give_up() {
            tracing::warn!("the disk is full; what was kept for that is given up, so that deleting works");
            result = commit_together(connection, leases, &[&request.write]).await;
        }
        if matches!(request.write, Write::Shrink)
            && matches!(&result, Ok(more) if more.iter().sum::<u64>() == 0)
        {
            shrinking::settle(connection).await;
            reserve.fill();
        }
        let count = if result.is_ok() { &counts.commits } else { &counts.failed };
        count.fetch_add(1, Ordering::Relaxed);
        let _ = request.answer.send(result.map(|changed| changed.into_iter().sum()));
    }
}

async fn commit_together(
    connection: &mut SqliteConnection,
    leases: &Leases,
    writes: &[&Write],
) -> Result<Vec<u64>, StoreError> {
    let result = try_together(connection, leases, writes).await;
    if result.is_err() {
        // SQLite itself ends a transaction that meets a full disk; then there is none to roll back.
        // sqlx's own transactions would count that one as open for ever, so they are not used here.
        let _ = sqlx::query("ROLLBACK").execute(connection).await;
    }
    result
}

async fn try_together(
    connection: &mut SqliteConnection,
    leases: &Leases,
    writes: &[&Write],
) -> Result<Vec<u64>, StoreError> {
    sqlx::query("BEGIN IMMEDIATE").execute(&mut *connection).await?;
    let mut changed = Vec::with_capacity(writes.len());
    for write in writes {
        changed.push(write.apply(connection, leases).await?);
    }
    sqlx::query("COMMIT").execute(connection).await?;
    Ok(changed)
}

#[cfg(test)]
mod tests {
    use sqlx::ConnectOptions;

    use super::{
        super::{Folder, SqliteStore, open::writer_options},
        *,
    };
    use crate::store::Store;

    fn insert(name: &str, bytes: usize) -> Write {
        Write::Raw(format!("INSERT INTO pictures (media_type, bytes) VALUES ('{name}', zeroblob({bytes}))"))
    }

    #[tokio::test]
    async fn writing_goes_on_when_the_disk_has_room_again() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        let mut connection = writer_options(&folder.database()).connect().await.unwrap();
        // Asked for less than the file has, SQLite keeps to what it has: the file cannot grow.
        let limit = sqlx::query_scalar::<_, i64>("PRAGMA max_page_count = 1");
        limit.fetch_one(&mut connection).await.unwrap();
        let (small, large) = (insert("small", 10), insert("large", 1_000_000));
        let leases = Leases::default();
        let error = commit_together(&mut connection, &leases, &[&small, &large]).await.unwrap_err();
        assert_eq!(error.in_words(), "the disk is full", "{error}");

        let limit = sqlx::query_scalar::<_, i64>("PRAGMA max_page_count = 100000");
        limit.fetch_one(&mut connection).await.unwrap();
        let ids = || sqlx::query_scalar::<_, String>("SELECT media_type FROM pictures ORDER BY media_type");
        assert!(ids().fetch_all(&mut connection).await.unwrap().is_empty(), "all of a group or nothing");
        commit_together(&mut connection, &leases, &[&small, &large]).await.unwrap();
        assert_eq!(ids().fetch_all(&mut connection).await.unwrap(), ["large", "small"]);
    }
}
