//! How many bytes of files that are made and sent may lie on the disk, of one person and of all.

use std::{
    collections::BTreeMap,
    fs::File,
    io::{self, Read, Seek, SeekFrom},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

/// Room on the disk.
#[derive(Clone, Debug)]
pub struct Rooms(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    of_one: u64,
    of_all: u64,
    /// Bytes that are taken by each person.
    taken: Mutex<BTreeMap<String, u64>>,
}

/// What one file takes of it, until this is dropped.
#[derive(Debug)]
pub struct Room {
    rooms: Rooms,
    person: String,
    bytes: AtomicU64,
}

/// A file that keeps its room as long as it is read.
#[derive(Debug)]
pub struct InRoom {
    file: File,
    _room: Arc<Room>,
}

impl Rooms {
    /// Room for so many bytes of one person, and of all.
    pub fn new(of_one: u64, of_all: u64) -> Self {
        Self(Arc::new(Inner { of_one, of_all, taken: Mutex::default() }))
    }

    /// Room for a file of somebody, of which nothing is taken yet.
    pub fn of(&self, person: String) -> Arc<Room> {
        Arc::new(Room { rooms: self.clone(), person, bytes: AtomicU64::default() })
    }

    fn taken(&self) -> MutexGuard<'_, BTreeMap<String, u64>> {
        self.0.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Room {
    /// Takes so many bytes more; false where there are not so many left.
    pub(super) fn take(&self, bytes: u64) -> bool {
        let Inner { of_one, of_all, .. } = *self.rooms.0;
        let mut taken = self.rooms.taken();
        let all: u64 = taken.values().sum();
        let one = taken.get(&self.person).copied().unwrap_or(0);
        if all.saturating_add(bytes) > of_all || one.saturating_add(bytes) > of_one {
            return false;
        }
        taken.insert(self.person.clone(), one + bytes);
        self.bytes.fetch_add(bytes, Ordering::Relaxed);
        true
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        let mut taken = self.rooms.taken();
        let left = taken.remove(&self.person).unwrap_or(0).saturating_sub(*self.bytes.get_mut());
        if left > 0 {
            taken.insert(std::mem::take(&mut self.person), left);
        }
    }
}

impl InRoom {
    /// This file, which has this room.
    pub fn new(file: File, room: Arc<Room>) -> Self {
        Self { file, _room: room }
    }
}

impl Read for InRoom {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.file.read(bytes)
    }
}

impl Seek for InRoom {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ex2_files_of_one_and_of_all_have_so_much_room_until_they_are_sent() {
        let rooms = Rooms::new(10, 15);
        let of = |person: &str| rooms.of(person.to_owned());
        let (first, second, other) = (of("ada"), of("ada"), of("bo"));
        assert!(first.take(6) && second.take(4) && !second.take(1), "those of one");
        assert!(other.take(5) && !other.take(1), "those of all");
        drop(first);
        assert!(second.take(6) && !second.take(1));
        drop((second, other));
        assert!(rooms.taken().is_empty());
    }
}
