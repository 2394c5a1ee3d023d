//! Rows with a checksum, and what of a session is whole.
//!
//! A checksum is over the row's key and its contents, so that a row in another's place is noticed as well. Rows of
//! the first release have none.

use espalier_session::{JournalEntry, Principal};
use flate2::Crc;

use super::{Damage, StoreError, StoredSession};

/// Consecutive entries as they are kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct JournalRow {
    pub(super) first: u64,
    pub(super) last: u64,
    /// A JSON array of `[principal, id, command]`.
    pub(super) entries: String,
    /// None for rows of the first release.
    pub(super) checksum: Option<u32>,
    pub(super) simulation_version: u32,
}

/// A snapshot as it is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SnapshotRow {
    pub(super) through: u64,
    pub(super) bytes: Vec<u8>,
    /// None for rows of the first release.
    pub(super) checksum: Option<u32>,
    pub(super) simulation_version: u32,
}

impl JournalRow {
    /// Seals entries, of which there is at least one.
    pub(super) fn seal(
        session: &str,
        simulation_version: u32,
        entries: &[JournalEntry],
    ) -> Result<Self, StoreError> {
        let (Some(first), Some(last)) = (entries.first(), entries.last()) else {
            return Err(StoreError::Damaged("a row of the journal holds one entry at least".into()));
        };
        let (first, last) = (first.number, last.number);
        let entry = |entry: &JournalEntry| (entry.principal.to_string(), entry.id, entry.command.clone());
        let entries = serde_json::to_string(&entries.iter().map(entry).collect::<Vec<_>>())
            .map_err(|error| StoreError::Damaged(error.to_string()))?;
        let checksum = Some(journal_sum(session, first, last, &entries));
        Ok(Self { first, last, entries, checksum, simulation_version })
    }

    /// The entries, unless the row is not what was written.
    fn open(&self, session: &str) -> Option<Vec<JournalEntry>> {
        let sum = || journal_sum(session, self.first, self.last, &self.entries);
        if self.checksum.is_some_and(|checksum| checksum != sum()) {
            return None;
        }
        let entries: Vec<(String, u32, String)> = serde_json::from_str(&self.entries).ok()?;
        if self.first.checked_add(entries.len() as u64)? != self.last.checked_add(1)? {
            return None;
        }
        let entry = |(number, (principal, id, command)): (u64, (String, u32, String))| {
            Some(JournalEntry { number, principal: Principal::parse(&principal)?, id, command })
        };
        (self.first..).zip(entries).map(entry).collect()
    }
}

impl SnapshotRow {
    pub(super) fn is_whole(&self, session: &str) -> bool {
        self.checksum.is_none_or(|checksum| checksum == snapshot_sum(session, self.through, &self.bytes))
    }
}

/// Puts a session together from the snapshot it goes on from and the rows behind that, as far as they are whole.
pub(super) fn assemble(
    session: &str,
    seed: u32,
    made_by: u32,
    snapshot: Option<SnapshotRow>,
    rows: Vec<JournalRow>,
) -> StoredSession {
    let mut stored = StoredSession { seed, newest_version: made_by, ..StoredSession::default() };
    if let Some(row) = snapshot {
        (stored.through, stored.newest_version) = (row.through, row.simulation_version);
        stored.snapshot = Some(row.bytes);
    }
    let mut next = stored.through.saturating_add(1);
    for row in rows {
        let Some(entries) = Some(&row).filter(|row| row.first <= next).and_then(|row| row.open(session))
        else {
            stored.damage.push(Damage::Journal(next));
            break;
        };
        stored.entries.extend(entries.into_iter().filter(|entry| entry.number >= next));
        next = next.max(row.last + 1);
        stored.newest_version = stored.newest_version.max(row.simulation_version);
        let oldest = stored.oldest_entries.map_or(row.simulation_version, |v| v.min(row.simulation_version));
        stored.oldest_entries = Some(oldest);
    }
    stored
}

/// Of a snapshot.
pub(super) fn snapshot_sum(session: &str, through: u64, bytes: &[u8]) -> u32 {
    sum(&[session.as_bytes(), &[0], &through.to_le_bytes(), bytes])
}

/// Of a saved tree's document.
pub(super) fn tree_sum(id: &str, document: &[u8]) -> u32 {
    sum(&[id.as_bytes(), &[0], document])
}

fn journal_sum(session: &str, first: u64, last: u64, entries: &str) -> u32 {
    sum(&[session.as_bytes(), &[0], &first.to_le_bytes(), &last.to_le_bytes(), entries.as_bytes()])
}

/// CRC-32.
fn sum(parts: &[&[u8]]) -> u32 {
    let mut sum = Crc::new();
    parts.iter().for_each(|part| sum.update(part));
    sum.sum()
}
