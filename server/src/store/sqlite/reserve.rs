//! Room on the disk that is given up when the disk is full, so that something can be deleted then: SQLite writes before it
//! frees.

use std::{
    fs::{self, File},
    io::{self, Write as _},
    path::{Path, PathBuf},
};

/// Enough for the log of a step of deleting.
const BYTES: usize = 8 * 1024 * 1024;
const PIECE: usize = 64 * 1024;

/// A file beside the database that is as large as the room.
#[derive(Debug)]
pub(super) struct Reserve(PathBuf);

impl Reserve {
    pub(super) fn beside(database: &Path) -> Self {
        let mut name = database.as_os_str().to_owned();
        name.push(".reserve");
        Self(name.into())
    }

    /// Takes the room, unless it is taken already; nothing where there is no such room.
    pub(super) fn fill(&self) {
        if fs::metadata(&self.0).is_ok_and(|file| file.len() == BYTES as u64) {
            return;
        }
        if let Err(error) = self.write() {
            tracing::debug!(%error, "no room could be kept for deleting");
            self.give_up();
        }
    }

    fn write(&self) -> io::Result<()> {
        let mut file = File::create(&self.0)?;
        // What does not compress, so that the room is truly taken.
        let mut state = 1_u64;
        let piece: Vec<u8> = std::iter::repeat_with(|| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 56) as u8
        })
        .take(PIECE)
        .collect();
        for _ in 0..BYTES / PIECE {
            file.write_all(&piece)?;
        }
        file.sync_all()
    }

    /// Gives the room up; whether there was any.
    pub(super) fn give_up(&self) -> bool {
        fs::remove_file(&self.0).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::{super::Folder, *};

    #[test]
    fn room_is_given_up_once_and_taken_again() {
        let folder = Folder::new();
        let database = folder.database();
        fs::create_dir_all(database.parent().unwrap()).unwrap();
        let reserve = Reserve::beside(&database);
        assert!(!reserve.give_up());
        reserve.fill();
        reserve.fill();
        assert_eq!(fs::metadata(&reserve.0).unwrap().len(), BYTES as u64);
        assert!(reserve.give_up() && !reserve.give_up());
    }
}
