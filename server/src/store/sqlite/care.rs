//! Copying a database while it is in use, putting a copy in its place, and reading all of one.

use std::{
    collections::BTreeSet,
    ffi::OsString,
    fs, io,
    path::{Path, PathBuf},
    time::{Duration, SystemTime},
};

use sqlx::{
    ConnectOptions, Connection, SqlitePool,
    sqlite::{SqliteConnection, SqlitePoolOptions},
};
use tokio::time::interval;

use super::{
    super::{Damage, StoreError},
    identity,
    open::{self, OpenError, common_options, sentence},
    place::{self, Place},
    sessions, trees,
};

/// How often the progress of a copy is reported.
const REPORT_PERIOD: Duration = Duration::from_millis(200);
/// Why a database of an earlier schema is not read.
pub(super) const EARLIER: &str =
    "its schema is an earlier program's; a server that is started on it brings it up to date";
/// Why a database is not read by a name that is not the server's.
const ELSEWHERE: &str = "a server is using it by another name (this one is a hard link to the same file), beside which it \
    keeps what it wrote last; give the name that the server was started with, or ask the server itself with --url";
/// What SQLite keeps beside a database: its write-ahead log and the memory shared by those who use it.
const COMPANIONS: [&str; 3] = ["", "-wal", "-shm"];

/// A database cannot be copied, replaced or read; each message is one sentence for the person at the terminal.
#[derive(Debug, thiserror::Error)]
pub enum CareError {
    /// The database cannot be used.
    #[error(transparent)]
    Database(#[from] OpenError),
    /// A file is in the way.
    #[error("There is a file {} already: give another name, or --replace.", .0.display())]
    Exists(PathBuf),
    /// A copy would take the place of what is copied.
    #[error("{} is the database itself, or belongs to it: give another name.", .0.display())]
    Itself(PathBuf),
    /// A file cannot be written.
    #[error("The file {} cannot be written: {reason}.", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// Why not, half a sentence.
        reason: String,
    },
}

/// What is in a database, and what of it is not what was once written, a phrase for each.
#[derive(Debug, Default)]
pub struct Report {
    /// Sessions read.
    pub sessions: u64,
    /// Trees with all their versions read.
    pub trees: u64,
    /// Versions read.
    pub versions: u64,
    /// What is damaged.
    pub damage: Vec<String>,
}

/// Copies a database to a file, which others may go on writing to: the copy is what was committed when it began.
/// `progress` gets the bytes written and about how many there will be. Gives the bytes of the copy.
pub async fn backup(
    database: &Path,
    to: &Path,
    is_replacing: bool,
    mut progress: impl FnMut(u64, u64),
) -> Result<u64, CareError> {
    if place::is_part_of(to, database) {
        return Err(CareError::Itself(to.to_owned()));
    }
    if to.exists() && !is_replacing {
        return Err(CareError::Exists(to.to_owned()));
    }
    let mut connection = reading(database).await?;
    let temporary = beside(to, ".part");
    let copied = copy(&mut connection, database, &temporary, &mut progress).await;
    let moved = copied
        .and_then(|bytes| put(&temporary, to).map(|()| bytes).map_err(|error| cannot_write(to, &error)));
    if moved.is_err() {
        // Half a copy is of no use; that it may stay is said by the error before.
        let _ = fs::remove_file(&temporary);
    }
    moved
}

/// Puts a copy in the place of a database that no server uses; gives the name that what was there has now.
pub async fn restore(
    copy_of_it: &Path,
    database: &Path,
    mut progress: impl FnMut(u64, u64),
) -> Result<Option<PathBuf>, CareError> {
    let refused = |reason| OpenError::new(copy_of_it, reason);
    if !copy_of_it.is_file() {
        return Err(refused("there is no such file".into()).into());
    }
    let mut connection = reading(copy_of_it).await?;
    // One of an earlier schema is brought up to date by the server that is started on it.
    open::is_current(&mut connection).await.map_err(refused)?;
    open::check_integrity(&mut connection).await.map_err(refused)?;
    let in_use = |reason| OpenError::new(database, reason);
    let is_there = fs::metadata(database).is_ok_and(|metadata| metadata.len() > 0);
    let mut place = Place::lock(database).map_err(in_use)?;
    // One that cannot be read at all may be ours, and is kept in any case.
    if is_there && identity::is_ours(database).await.is_ok_and(|is_ours| !is_ours) {
        return Err(in_use(identity::FOREIGN.into()).into());
    }
    place.lock_name().map_err(in_use)?;
    let temporary = part_of(database);
    if let Err(error) = copy(&mut connection, copy_of_it, &temporary, &mut progress).await {
        let _ = fs::remove_file(&temporary);
        return Err(error);
    }
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string().replace(':', "-");
    let kept = beside(database, &format!(".before-{now}"));
    for companion in COMPANIONS.into_iter().filter(|_| is_there) {
        match fs::rename(beside(database, companion), beside(&kept, companion)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(cannot_write(&kept, &error)),
            _ => {}
        }
    }
    put(&temporary, database).map_err(|error| cannot_write(database, &error))?;
    drop(place);
    Ok(is_there.then_some(kept))
}

/// Reads everything in a database, in use or not, and says what is damaged. `progress` gets how many sessions and versions
/// were read, and how many there are.
pub async fn check(database: &Path, mut progress: impl FnMut(u64, u64)) -> Result<Report, CareError> {
    let mut connection = reading(database).await?;
    let mut report = Report::default();
    let found: Vec<String> = sqlx::query_scalar("PRAGMA integrity_check(20)")
        .fetch_all(&mut connection)
        .await
        .map_err(|error| unusable(database, &error))?;
    report
        .damage
        .extend(found.into_iter().filter(|line| line != "ok").map(|line| format!("the file: {line}")));
    let refused = |reason| OpenError::new(database, reason);
    if !open::is_current(&mut connection).await.map_err(refused)? {
        return Err(refused(EARLIER.into()).into());
    }
    let failed = |error: &sqlx::Error| unusable(database, error);
    let names: Vec<String> = sqlx::query_scalar("SELECT name FROM sessions ORDER BY name")
        .fetch_all(&mut connection)
        .await
        .map_err(|error| failed(&error))?;
    let versions: Vec<(String, u32)> =
        sqlx::query_as("SELECT key, number FROM trees JOIN versions ON tree = trees.id ORDER BY key, number")
            .fetch_all(&mut connection)
            .await
            .map_err(|error| failed(&error))?;
    drop(connection.close().await);

    let options = SqlitePoolOptions::new().max_connections(1);
    let readers = options
        .connect_with(common_options(database).read_only(true))
        .await
        .map_err(|error| failed(&error))?;
    let all = (names.len() + versions.len()) as u64;
    report.sessions = names.len() as u64;
    report.versions = versions.len() as u64;
    report.trees = versions.iter().map(|(key, _)| key).collect::<BTreeSet<_>>().len() as u64;
    for (done, name) in (1..).zip(&names) {
        match of_session(&readers, name).await {
            Ok(found) => report.damage.extend(found),
            Err(error) => report.damage.push(words(&error, || format!("session {name}"))),
        }
        progress(done, all);
    }
    for (done, (key, number)) in (report.sessions + 1..).zip(&versions) {
        if let Err(error) = trees::document(&readers, key, *number).await {
            report.damage.push(words(&error, || format!("version {number} of the tree {key}")));
        }
        progress(done, all);
    }
    readers.close().await;
    Ok(report)
}

/// What of a session is damaged: of what it opens from, and of what it would open from else.
async fn of_session(readers: &SqlitePool, name: &str) -> Result<BTreeSet<String>, StoreError> {
    let mut found = BTreeSet::new();
    let mut before = None;
    loop {
        let Some(stored) = sessions::load(readers, name, before).await? else { break };
        found.extend(stored.damage.iter().map(|damage| match damage {
            Damage::Snapshot(through) => {
                format!("session {name}: the snapshot after entry {through} is damaged or missing")
            }
            Damage::Journal(from) => {
                format!("session {name}: the journal is damaged or missing from entry {from}")
            }
        }));
        let older: Option<i64> =
            sqlx::query_scalar("SELECT max(through) FROM snapshots WHERE session = ? AND through < ?")
                .bind(name)
                .bind(stored.through.cast_signed())
                .fetch_one(readers)
                .await?;
        if older.is_none() {
            break;
        }
        before = Some(stored.through);
    }
    Ok(found)
}

/// What is damaged names itself; what else is wrong is said of what was read.
fn words(error: &StoreError, read: impl FnOnce() -> String) -> String {
    match error {
        StoreError::Damaged(what) => what.clone(),
        error => format!("{}: {}", read(), error.in_words()),
    }
}

/// A connection that reads a database of ours, which there must be.
pub(super) async fn reading(database: &Path) -> Result<SqliteConnection, OpenError> {
    let refused = |reason| OpenError::new(database, reason);
    if !database.is_file() {
        return Err(refused("there is no such file".into()));
    }
    if Place::is_used_elsewhere(database) {
        return Err(refused(ELSEWHERE.into()));
    }
    identity::check(database).await.map_err(refused)?;
    let options = common_options(database).read_only(true);
    options.connect().await.map_err(|error| refused(sentence(&error)))
}

/// Writes a copy of what a connection reads and waits until it is on the disk; gives its size.
async fn copy(
    connection: &mut SqliteConnection,
    from: &Path,
    to: &Path,
    progress: &mut impl FnMut(u64, u64),
) -> Result<u64, CareError> {
    // One that was left by a copy that was cut short.
    match fs::remove_file(to) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(cannot_write(to, &error)),
        _ => {}
    }
    let Some(name) = to.to_str() else {
        return Err(CareError::Write { path: to.to_owned(), reason: "its name is not Unicode".into() });
    };
    let size = |path: &Path| fs::metadata(path).map_or(0, |metadata| metadata.len());
    let all = size(from);
    let mut ticks = interval(REPORT_PERIOD);
    let copying = sqlx::query("VACUUM INTO ?").bind(name).execute(connection);
    tokio::pin!(copying);
    loop {
        tokio::select! {
            copied = &mut copying => {
                copied.map_err(|error| CareError::Write { path: to.to_owned(), reason: sentence(&error) })?;
                break;
            }
            _ = ticks.tick() => progress(size(to).min(all), all),
        }
    }
    let file = fs::File::open(to).map_err(|error| cannot_write(to, &error))?;
    file.sync_all().map_err(|error| cannot_write(to, &error))?;
    Ok(size(to))
}

/// Where a copy is written that is to take the place of a database.
pub(super) fn part_of(database: &Path) -> PathBuf {
    beside(database, ".part")
}

/// Gives a file another name, and has the folder keep that also where the power fails.
fn put(file: &Path, name: &Path) -> io::Result<()> {
    fs::rename(file, name)?;
    let folder = name.parent().filter(|folder| !folder.as_os_str().is_empty());
    // Not every system opens folders; what it keeps of them is its own affair then.
    if let Ok(folder) = fs::File::open(folder.unwrap_or(Path::new("."))) {
        folder.sync_all()?;
    }
    Ok(())
}

fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ending);
    name.into()
}

fn unusable(database: &Path, error: &sqlx::Error) -> OpenError {
    OpenError::new(database, sentence(error))
}

fn cannot_write(path: &Path, error: &io::Error) -> CareError {
    CareError::Write { path: path.to_owned(), reason: error.to_string() }
}
