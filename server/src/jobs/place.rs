//! Where the files of jobs lie: a folder for each server, which is locked as long as its server lives.

use std::{
    fs::{self, File},
    io,
    path::Path,
};

use tempfile::{Builder, TempDir};

const PREFIX: &str = "espalier-jobs-";
/// What is locked in it.
const LOCK: &str = "lock";

/// A folder for files that go with it.
#[derive(Debug)]
pub(super) struct Place {
    /// Dropped first: some systems do not remove a file that is open.
    _lock: File,
    folder: TempDir,
}

impl Place {
    /// Makes one in a folder for temporary files.
    pub(super) fn new_in(parent: &Path) -> io::Result<Self> {
        loop {
            let folder = Builder::new().prefix(PREFIX).tempdir_in(parent)?;
            let path = folder.path().join(LOCK);
            let lock = File::create_new(&path)?;
            lock.lock()?;
            // Whoever looked in between has taken it for one that was left.
            if path.exists() {
                return Ok(Self { _lock: lock, folder });
            }
        }
    }

    /// Whether nobody has tidied it away.
    pub(super) fn is_there(&self) -> bool {
        self.folder.path().is_dir()
    }

    /// A folder in it, for the files of a job.
    pub(super) fn folder(&self) -> io::Result<TempDir> {
        tempfile::tempdir_in(self.folder.path())
    }
}

/// Removes the folders of servers that were killed.
pub(super) fn remove_left(parent: &Path) {
    let Ok(entries) = fs::read_dir(parent) else { return };
    let ours = entries.flatten().filter(|entry| entry.file_name().to_string_lossy().starts_with(PREFIX));
    for folder in ours.map(|entry| entry.path()) {
        // Those of other people cannot be opened.
        let Ok(lock) = File::options().write(true).open(folder.join(LOCK)) else { continue };
        if lock.try_lock().is_ok() {
            match fs::remove_dir_all(&folder) {
                Ok(()) => {
                    tracing::info!(folder = %folder.display(), "files that a killed server left are gone")
                }
                Err(error) => {
                    tracing::warn!(%error, folder = %folder.display(), "files of a killed server stay")
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jb3_files_of_a_killed_server_go_and_those_of_a_living_one_stay() {
        let parent = tempfile::tempdir().unwrap();
        let living = Place::new_in(parent.path()).unwrap();
        let file = living.folder().unwrap().keep().join("1.glb");
        fs::write(&file, "glTF").unwrap();
        let left = parent.path().join("espalier-jobs-x1/y");
        fs::create_dir_all(&left).unwrap();
        fs::write(left.join("1.glb"), "glTF").unwrap();
        fs::write(left.parent().unwrap().join(LOCK), "").unwrap();
        let other = parent.path().join("espalier-notes");
        fs::create_dir(&other).unwrap();
        remove_left(parent.path());
        assert!(file.exists() && other.exists() && !left.parent().unwrap().exists());
        let folder = living.folder.path().to_owned();
        drop(living);
        assert!(!folder.exists());
    }
}
