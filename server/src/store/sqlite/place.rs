//! The file that is open: kept from other servers, whatever name they know it by, and missed when it is gone.

use std::{
    fs::{self, File, TryLockError},
    io,
    path::{Path, PathBuf},
};

use super::super::StoreError;

/// The file of a database, locked until this is dropped; the system frees the locks when the process dies.
///
/// SQLite has locks of its own, which POSIX drops as soon as the process closes any handle of the file: this one closes
/// after the connections.
#[derive(Debug)]
pub(super) struct Place {
    path: PathBuf,
    /// Known by the file itself: a hard link is the same one.
    #[cfg(unix)]
    file: File,
    /// Known by the file's name, as it is to servers of earlier releases and on every system.
    by_name: Option<File>,
    #[cfg(unix)]
    identity: Identity,
}

/// Device and number of a file.
#[cfg(unix)]
type Identity = (u64, u64);

impl Place {
    /// Locks the file, which is made where there is none, and nothing beside it: it may turn out to be another
    /// program's. Comes before SQLite opens it, which under a second name would take it for a database of its own. An error
    /// is half a sentence.
    pub(super) fn lock(path: &Path) -> Result<Self, String> {
        let place = Self::of(path)?;
        #[cfg(unix)]
        try_lock(&place.file)?;
        Ok(place)
    }

    /// Whether no server uses the file, or there is none yet.
    pub(super) fn is_free(path: &Path) -> bool {
        let opened = [path.to_owned(), lock_of(path)].map(|path| File::options().write(true).open(path));
        opened.into_iter().flatten().all(|file| !matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
    }

    /// Whether a server uses the file by another name, as a hard link has one: what it wrote last lies beside that name.
    pub(super) fn is_used_elsewhere(path: &Path) -> bool {
        let is_locked = |path: &Path| {
            let opened = File::options().write(true).open(path);
            opened.is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
        };
        is_locked(path) && !is_locked(&lock_of(path))
    }

    /// The file, which other servers may use.
    pub(super) fn of(path: &Path) -> Result<Self, String> {
        #[cfg(unix)]
        let file = {
            let opened = File::options().read(true).write(true).create(true).truncate(false).open(path);
            opened.map_err(|error| format!("it cannot be opened ({error})"))?
        };
        Ok(Self {
            path: path.to_owned(),
            by_name: None,
            #[cfg(unix)]
            identity: identity(&file.metadata().map_err(|error| error.to_string())?),
            #[cfg(unix)]
            file,
        })
    }

    /// Locks the file's name as well, in a file beside it.
    pub(super) fn lock_name(&mut self) -> Result<(), String> {
        let name = lock_of(&self.path);
        let file =
            File::create(&name).map_err(|error| format!("{} cannot be written ({error})", name.display()))?;
        try_lock(&file)?;
        self.by_name = Some(file);
        Ok(())
    }

    /// Why what is written would be lost: the file is no longer the one under its name.
    pub(super) fn missing(&self) -> Option<String> {
        match fs::metadata(&self.path) {
            #[cfg(unix)]
            Ok(metadata) if identity(&metadata) != self.identity => {
                Some("there is another file in its place".into())
            }
            Ok(_) => None,
            Err(error) => Some(error.to_string()),
        }
    }

    /// [`Place::missing`] as an error.
    pub(super) fn check(&self) -> Result<(), StoreError> {
        self.missing().map_or(Ok(()), |cause| Err(StoreError::Gone(cause)))
    }

    /// Lets other servers have it.
    pub(super) fn unlock(&self) -> io::Result<()> {
        #[cfg(unix)]
        self.file.unlock()?;
        self.by_name.as_ref().map_or(Ok(()), File::unlock)
    }
}

/// The file beside the database that is locked for its name.
fn lock_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".lock");
    name.into()
}

/// How the names of files go on that lie beside a database for it.
const BESIDE: [&str; 4] = ["-wal", "-shm", ".lock", ".reserve"];

/// Whether a path leads to the database, under whatever name, or to a file that lies beside it for it.
pub(super) fn is_part_of(path: &Path, database: &Path) -> bool {
    let same = |other: &Path| match (fs::metadata(path), fs::metadata(other)) {
        (Ok(one), Ok(other)) => is_same(&one, &other),
        _ => false,
    };
    let beside = |suffix: &str| {
        let mut name = database.as_os_str().to_owned();
        name.push(suffix);
        let name = PathBuf::from(name);
        path == name || same(&name)
    };
    path == database || same(database) || BESIDE.iter().any(|suffix| beside(suffix))
}

#[cfg(unix)]
fn is_same(one: &fs::Metadata, other: &fs::Metadata) -> bool {
    identity(one) == identity(other)
}

#[cfg(not(unix))]
fn is_same(_: &fs::Metadata, _: &fs::Metadata) -> bool {
    false
}

fn try_lock(file: &File) -> Result<(), String> {
    match file.try_lock() {
        Ok(()) => Ok(()),
        Err(TryLockError::WouldBlock) => Err("another Espalier server is using it".into()),
        Err(TryLockError::Error(error)) => Err(format!("it cannot be locked ({error})")),
    }
}

#[cfg(unix)]
fn identity(metadata: &fs::Metadata) -> Identity {
    use std::os::unix::fs::MetadataExt;
    (metadata.dev(), metadata.ino())
}

#[cfg(all(test, unix))]
mod tests {
    use super::{
        super::{Folder, SqliteStore},
        *,
    };
    use crate::store::{NewSession, Store};

    fn oak() -> NewSession {
        NewSession { name: "oak".into(), seed: 1, simulation_version: 1, ..NewSession::default() }
    }

    #[tokio::test]
    async fn a_hard_link_is_the_same_file() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let link = folder.database().with_file_name("link.db");
        fs::hard_link(folder.database(), &link).unwrap();
        let refusal = SqliteStore::open(&link).await.unwrap_err().to_string();
        assert!(refusal.contains("another Espalier server is using it"), "{refusal}");
        store.close().await;
        SqliteStore::open(&link).await.unwrap().close().await;
    }

    #[tokio::test]
    async fn nothing_is_written_to_a_file_that_is_gone() {
        let folder = Folder::new();
        let (path, elsewhere) = (folder.database(), folder.database().with_file_name("elsewhere.db"));
        let store = SqliteStore::open(&path).await.unwrap();
        fs::rename(&path, &elsewhere).unwrap();
        for replaced in [false, true] {
            if replaced {
                fs::copy(&elsewhere, &path).unwrap();
            }
            for refused in [
                store.create_session(oak()).await.unwrap_err(),
                store.acquire("oak").await.unwrap_err(),
                store.check_place().await.unwrap_err(),
            ] {
                assert!(refused.in_words().contains("moved, deleted or replaced"), "{refused}");
            }
        }
        fs::rename(&elsewhere, &path).unwrap();
        store.check_place().await.unwrap();
        store.create_session(oak()).await.unwrap();
        store.close().await;
    }
}
