//! Opening the file, bringing its schema up to date, and every way that can fail.

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

use sqlx::{
    ConnectOptions, SqlSafeStr, SqlitePool,
    migrate::{MigrateError, Migration, MigrationType, Migrator},
    sqlite::{
        SqliteAutoVacuum, SqliteConnectOptions, SqliteConnection, SqliteExecutor, SqliteJournalMode,
        SqlitePoolOptions, SqliteSynchronous,
    },
};

use super::{
    super::FULL_DISK, care::part_of, finding, identity, in_words, parts::Keeping, place::Place,
    reserve::Reserve, shrinking, writer::Writer,
};

/// The schema: one file of `migrations/` for each change, in order.
const MIGRATIONS: &[(&str, &str)] = &[
    ("0001_sessions_and_trees", include_str!("../../../../migrations/0001_sessions_and_trees.sql")),
    ("0002_checksums", include_str!("../../../../migrations/0002_checksums.sql")),
    ("0003_whole_sessions", include_str!("../../../../migrations/0003_whole_sessions.sql")),
    ("0004_trees_with_versions", include_str!("../../../../migrations/0004_trees_with_versions.sql")),
    ("0005_finding_trees", include_str!("../../../../migrations/0005_finding_trees.sql")),
    ("0006_sessions_that_go", include_str!("../../../../migrations/0006_sessions_that_go.sql")),
    ("0007_passes", include_str!("../../../../migrations/0007_passes.sql")),
    ("0008_parts_of_documents", include_str!("../../../../migrations/0008_parts_of_documents.sql")),
    ("0009_users", include_str!("../../../../migrations/0009_users.sql")),
    ("0010_audit", include_str!("../../../../migrations/0010_audit.sql")),
    ("0011_answers", include_str!("../../../../migrations/0011_answers.sql")),
    ("0012_counted_events", include_str!("../../../../migrations/0012_counted_events.sql")),
    ("0013_parts_packed_faster", include_str!("../../../../migrations/0013_parts_packed_faster.sql")),
    ("0014_tries_to_open", include_str!("../../../../migrations/0014_tries_to_open.sql")),
    ("0015_comments", include_str!("../../../../migrations/0015_comments.sql")),
    ("0016_locked_trees", include_str!("../../../../migrations/0016_locked_trees.sql")),
    ("0017_groups", include_str!("../../../../migrations/0017_groups.sql")),
    ("0018_standings", include_str!("../../../../migrations/0018_standings.sql")),
    ("0019_people_of_sessions", include_str!("../../../../migrations/0019_people_of_sessions.sql")),
    ("0020_tags_without_case", include_str!("../../../../migrations/0020_tags_without_case.sql")),
    ("0021_authors", include_str!("../../../../migrations/0021_authors.sql")),
    ("0022_people_over_http", include_str!("../../../../migrations/0022_people_over_http.sql")),
    ("0023_gifts", include_str!("../../../../migrations/0023_gifts.sql")),
    ("0024_trees_in_collections", include_str!("../../../../migrations/0024_trees_in_collections.sql")),
    ("0025_identities_of_authors", include_str!("../../../../migrations/0025_identities_of_authors.sql")),
];

/// Releases before this one can lose a committed transaction when the write-ahead log starts over.
const OLDEST_SAFE_SQLITE: [u32; 3] = [3, 51, 3];

/// The write-ahead log keeps no more of the disk than this between checkpoints.
const MAX_IDLE_LOG: u64 = 16 * 1024 * 1024;

/// Larger files are read through while the server already serves, for that takes seconds.
const MAX_CHECKED_BYTES: u64 = 256 * 1024 * 1024;

/// Where a copy lies beside no database.
const CUT_SHORT: &str =
    "it was to be restored, and that was cut short: restore it again, or delete the file that ends in .part";

const READERS: u32 = 4;
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// The database cannot be used; each message is one sentence for the person at the terminal.
#[derive(Debug, thiserror::Error)]
#[error("The database {} cannot be used: {reason}.", path.display())]
pub struct OpenError {
    path: PathBuf,
    reason: String,
}

impl OpenError {
    /// `reason` is half a sentence.
    pub(super) fn new(path: &Path, reason: String) -> Self {
        Self { path: path.to_owned(), reason }
    }
}

/// Sessions and trees in one file.
#[derive(Debug)]
pub struct SqliteStore {
    pub(super) readers: SqlitePool,
    pub(super) writer: Writer,
    pub(super) keeping: Keeping,
    /// Two servers on one file would each think that they hold its sessions.
    pub(super) place: Arc<Place>,
}

impl SqliteStore {
    /// Opens the file, or makes it together with its folder.
    pub async fn open(path: &Path) -> Result<Self, OpenError> {
        let mut opened = Self::try_open(path).await;
        // SQLite needs a little room to open a database; what was kept for deleting is enough for both.
        if opened.as_ref().is_err_and(|reason| reason == FULL_DISK) && Reserve::beside(path).give_up() {
            tracing::warn!(
                "the disk is full; what was kept for that is given up, so that the server can start"
            );
            opened = Self::try_open(path).await;
        }
        opened.map_err(|reason| OpenError::new(path, reason))
    }

    /// Whether a server uses the file.
    pub fn is_in_use(path: &Path) -> bool {
        !Place::is_free(path)
    }

    /// Opens the file for a few rows, also beside a server that uses it; its sessions stay that server's.
    pub async fn open_beside(path: &Path) -> Result<Self, OpenError> {
        if Place::is_free(path) {
            return Self::open(path).await;
        }
        Self::try_open_beside(path).await.map_err(|reason| OpenError::new(path, reason))
    }

    async fn try_open_beside(path: &Path) -> Result<Self, String> {
        identity::check(path).await?;
        let place = Arc::new(Place::of(path)?);
        let mut connection = writer_options(path).connect().await.map_err(|error| sentence(&error))?;
        if !is_current(&mut connection).await? {
            return Err("the server that uses it is of an earlier release; stop that first".into());
        }
        let options = common_options(path).read_only(true);
        let readers = SqlitePoolOptions::new().max_connections(1).connect_with(options).await;
        let readers = readers.map_err(|error| sentence(&error))?;
        let writer = Writer::start(connection, Arc::clone(&place), Reserve::beside(path));
        Ok(Self { readers, writer, keeping: Keeping::default(), place })
    }

    async fn try_open(path: &Path) -> Result<Self, String> {
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder)
                .map_err(|error| format!("its folder {} cannot be made ({error})", folder.display()))?;
        }
        if path.is_dir() {
            return Err("it is a folder".into());
        }
        let size = match fs::metadata(path) {
            Ok(metadata) if metadata.permissions().readonly() => return Err("it is read-only".into()),
            Ok(metadata) => metadata.len(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => 0,
            Err(error) => return Err(error.to_string()),
        };
        let mut place = Place::lock(path)?;
        if size == 0 && part_of(path).exists() {
            return Err(CUT_SHORT.into());
        }
        if size > 0 {
            identity::check(path).await?;
        }
        place.lock_name()?;
        let place = Arc::new(place);

        let mut connection = writer_options(path).connect().await.map_err(|error| sentence(&error))?;
        check_version(&mut connection).await?;
        if size <= MAX_CHECKED_BYTES {
            check_integrity(&mut connection).await?;
        }
        migrator()
            .run_direct(None, &mut connection, false)
            .await
            .map_err(|error| migration_sentence(&error))?;
        finding::fold_all(&mut connection).await.map_err(|error| error.to_string())?;
        shrinking::allow(&mut connection).await;

        let readers = SqlitePoolOptions::new()
            .max_connections(READERS)
            .connect_with(common_options(path).read_only(true))
            .await
            .map_err(|error| sentence(&error))?;
        if size > MAX_CHECKED_BYTES {
            let readers = readers.clone();
            tokio::spawn(async move { check_beside(&readers).await });
        }
        let reserve = Reserve::beside(path);
        reserve.fill();
        let writer = Writer::start(connection, Arc::clone(&place), reserve);
        Ok(Self { readers, writer, keeping: Keeping::default(), place })
    }

    /// Commits what is under way and closes the file.
    pub(super) async fn shut(&self) {
        self.readers.close().await;
        self.writer.close().await;
        if let Err(error) = self.place.unlock() {
            tracing::warn!(%error, "the database's lock stays until the end of the process");
        }
    }
}

pub(super) fn common_options(path: &Path) -> SqliteConnectOptions {
    SqliteConnectOptions::new().filename(path).busy_timeout(BUSY_TIMEOUT).foreign_keys(true)
}

pub(super) fn writer_options(path: &Path) -> SqliteConnectOptions {
    common_options(path)
        .create_if_missing(true)
        // Of a file that is made now; an earlier one is rewritten once.
        .auto_vacuum(SqliteAutoVacuum::Incremental)
        .pragma("journal_size_limit", MAX_IDLE_LOG.to_string())
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
}

/// Versions and descriptions are those that `sqlx::migrate!` reads from the names of files.
pub(super) fn migrator() -> Migrator {
    let migration = |&(name, sql): &(&'static str, &'static str)| {
        let description = name.trim_start_matches(|letter: char| !letter.is_alphabetic()).replace('_', " ");
        let sql = sql.into_sql_str();
        Migration::new(number_of(name), description.into(), MigrationType::Simple, sql, false)
    };
    Migrator::with_migrations(MIGRATIONS.iter().map(migration).collect())
}

/// The number with which the name of a migration begins.
fn number_of(name: &str) -> i64 {
    name.split('_').next().and_then(|number| number.parse().ok()).unwrap_or(0)
}

async fn check_version(connection: &mut SqliteConnection) -> Result<(), String> {
    let version: String = sqlx::query_scalar("SELECT sqlite_version()")
        .fetch_one(connection)
        .await
        .map_err(|error| sentence(&error))?;
    if is_safe(&version) {
        return Ok(());
    }
    let [major, minor, patch] = OLDEST_SAFE_SQLITE;
    Err(format!(
        "this program was built with SQLite {version}, which can lose data; it needs {major}.{minor}.{patch}"
    ))
}

fn is_safe(version: &str) -> bool {
    let parts: Vec<u32> = version.split('.').map_while(|part| part.parse().ok()).collect();
    parts.as_slice() >= OLDEST_SAFE_SQLITE.as_slice()
}

/// Whether a file has the schema of this program; an error where it has a later one.
pub(super) async fn is_current(connection: &mut SqliteConnection) -> Result<bool, String> {
    let (found, count): (Option<i64>, i64) =
        sqlx::query_as("SELECT max(version), count(*) FROM _sqlx_migrations")
            .fetch_one(connection)
            .await
            .map_err(|error| sentence(&error))?;
    let (found, known) = (found.unwrap_or(0), MIGRATIONS.last().map_or(0, |(name, _)| number_of(name)));
    if found > known {
        Err(migration_sentence(&MigrateError::VersionMissing(found)))
    } else {
        Ok(count == MIGRATIONS.len() as i64)
    }
}

pub(super) async fn check_integrity(connection: impl SqliteExecutor<'_>) -> Result<(), String> {
    let found: String = sqlx::query_scalar("PRAGMA quick_check(1)")
        .fetch_one(connection)
        .await
        .map_err(|error| sentence(&error))?;
    if found == "ok" { Ok(()) } else { Err(format!("it is damaged ({})", found.replace('\n', " "))) }
}

/// Reads the file through beside the work, until the server stops.
async fn check_beside(readers: &SqlitePool) {
    match check_integrity(readers).await {
        Ok(()) => tracing::info!("the database has been read through and is whole"),
        Err(_) if readers.is_closed() => {}
        Err(reason) => {
            tracing::error!(
                "the database was read through: {reason}; `espalier check` says what is still whole"
            );
        }
    }
}

pub(super) fn sentence(error: &sqlx::Error) -> String {
    in_words(error).map_or_else(|| error.to_string(), str::to_owned)
}

fn migration_sentence(error: &MigrateError) -> String {
    match error {
        MigrateError::VersionMissing(version) => {
            format!(
                "its schema ({version}) is newer than this program knows; use the newer Espalier that wrote it"
            )
        }
        MigrateError::VersionMismatch(version) => {
            format!("its schema ({version}) was made by a different build of Espalier")
        }
        MigrateError::Execute(error) | MigrateError::ExecuteMigration(error, _) => sentence(error),
        other => other.to_string(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use sqlx::Connection;

    use super::{super::writer::Write, *};
    use crate::store::Store;

    /// A folder of its own for one test, removed when the test ends.
    pub struct Folder(PathBuf);

    impl Folder {
        pub(crate) fn new() -> Self {
            let path = std::env::temp_dir().join(format!("espalier-test-{:016x}", rand::random::<u64>()));
            fs::create_dir(&path).unwrap();
            Self(path)
        }

        pub(crate) fn database(&self) -> PathBuf {
            self.0.join("made/for/it/test.db")
        }
    }

    impl SqliteStore {
        /// Runs SQL without the store.
        pub(in super::super) async fn sql(&self, sql: String) {
            self.writer.write(Write::Raw(sql)).await.unwrap();
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    async fn refusal(path: &Path) -> String {
        SqliteStore::open(path).await.unwrap_err().to_string()
    }

    #[test]
    fn every_migration_is_embedded_under_its_number() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../migrations");
        let files =
            fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
        let files: std::collections::BTreeSet<String> = files.collect();
        assert_eq!(files, MIGRATIONS.iter().map(|(name, _)| format!("{name}.sql")).collect());
        let numbers = MIGRATIONS.iter().map(|(name, _)| number_of(name));
        assert!(numbers.clone().is_sorted_by(|a, b| a < b) && numbers.min() == Some(1));
    }

    #[test]
    fn the_first_migration_is_the_one_that_was_released() {
        // What stands in `_sqlx_migrations` of every database that people have.
        let first = &migrator().migrations[0];
        let checksum: String = first.checksum.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!((first.version, &*first.description), (1, "sessions and trees"));
        assert_eq!(
            checksum,
            "784b77d6a7065b3d1fdd7d351a37b1ab79e517aa16209037a6594f239e51de7eb634325c7da0ff49fbdc2763714808d8"
        );
    }

    #[tokio::test]
    async fn makes_the_file_and_its_folder() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        assert!(folder.database().is_file());
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
    }

    #[tokio::test]
    async fn writes_are_logged_and_synchronous() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        let mut connection = writer_options(&folder.database()).connect().await.unwrap();
        for (pragma, expected) in
            [("PRAGMA synchronous", 2), ("PRAGMA foreign_keys", 1), ("PRAGMA busy_timeout", 5000)]
        {
            let value: i64 = sqlx::query_scalar(pragma).fetch_one(&mut connection).await.unwrap();
            assert_eq!(value, expected, "{pragma}");
        }
        let mode: String =
            sqlx::query_scalar("PRAGMA journal_mode").fetch_one(&mut connection).await.unwrap();
        assert_eq!(mode, "wal");
    }

    #[tokio::test]
    async fn a_second_server_is_turned_away() {
        let folder = Folder::new();
        let first = SqliteStore::open(&folder.database()).await.unwrap();
        assert!(refusal(&folder.database()).await.contains("another Espalier server is using it"));
        first.close().await;
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
    }

    #[tokio::test]
    async fn a_newer_schema_is_said_so() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        let mut connection = writer_options(&folder.database()).connect().await.unwrap();
        sqlx::query(
            "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time)
             VALUES (9999, 'from the future', TRUE, x'00', 0)",
        )
        .execute(&mut connection)
        .await
        .unwrap();
        connection.close().await.unwrap();
        let refusal = refusal(&folder.database()).await;
        assert!(refusal.contains("schema (9999) is newer"), "{refusal}");
    }

    #[tokio::test]
    async fn a_file_of_another_kind_is_refused() {
        let folder = Folder::new();
        let path = folder.0.join("letter.db");
        fs::write(&path, "Dear tree, ".repeat(500)).unwrap();
        let refusal = refusal(&path).await;
        assert!(refusal.contains("it is not a database"), "{refusal}");
        assert_eq!(refusal.lines().count(), 1);
    }

    #[tokio::test]
    async fn a_damaged_file_is_refused() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        let mut bytes = fs::read(folder.database()).unwrap();
        bytes[4096..].fill(0xa5);
        fs::write(folder.database(), bytes).unwrap();
        let refusal = refusal(&folder.database()).await;
        assert!(refusal.contains("it is damaged"), "{refusal}");
    }

    #[tokio::test]
    async fn a_read_only_file_is_refused() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        let mut permissions = fs::metadata(folder.database()).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(folder.database(), permissions).unwrap();
        assert!(refusal(&folder.database()).await.contains("it is read-only"));
    }

    #[tokio::test]
    async fn a_folder_is_no_database() {
        let folder = Folder::new();
        assert!(refusal(&folder.0).await.contains("it is a folder"));
        let beneath_a_file = folder.0.join("file");
        fs::write(&beneath_a_file, "").unwrap();
        assert!(refusal(&beneath_a_file.join("x.db")).await.contains("cannot be made"));
    }

    #[test]
    fn old_sqlite_is_not_safe() {
        for (version, safe) in
            [("3.51.3", true), ("3.51.2", false), ("3.52.0", true), ("4.0", true), ("3.9.9", false)]
        {
            assert_eq!(is_safe(version), safe, "{version}");
        }
    }
}
