//! Rows with a checksum, and what of a session is whole.
//!
//! A checksum is over the row's key and its contents, so that a row in another's place is noticed as well. Rows of
//! the first release have none, and get none: nobody can say whether they are whole. They are read entry by entry,
//! as far as each can be read, until a snapshot has taken their place.

use espalier_proto::Notice;
use espalier_session::{Document, JournalEntry, Principal, read_command};
use flate2::Crc;
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::{Damage, NewSession, StoreError, StoredSession, TreeDocument};

/// This program, as it is named in what it writes.
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// What is kept of a session beside its journal and its snapshots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SessionRow {
    pub(super) seed: u32,
    pub(super) simulation_version: u32,
    /// The last entry there was.
    pub(super) last_entry: u64,
    /// The last entry of the newest snapshot there was.
    pub(super) last_snapshot: Option<u64>,
    /// A JSON array of notices that nobody has received yet.
    pub(super) notices: Option<String>,
    pub(super) written_by: Option<String>,
    /// None for rows of the first release.
    pub(super) checksum: Option<u32>,
}

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

impl SessionRow {
    pub(super) fn new(new: &NewSession, has_snapshot: bool) -> Self {
        let row = Self {
            seed: new.seed,
            simulation_version: new.simulation_version,
            last_entry: 0,
            last_snapshot: has_snapshot.then_some(0),
            notices: None,
            written_by: None,
            checksum: None,
        };
        row.sealed(&new.name)
    }

    /// The same as this program writes it.
    pub(super) fn sealed(mut self, session: &str) -> Self {
        self.written_by = Some(PROGRAM.into());
        self.checksum = Some(self.sum(session));
        self
    }

    /// Notices that are kept until somebody has received them.
    pub(super) fn keep_notices(&mut self, notices: &[Notice]) {
        let mut all = self.notices();
        for notice in notices {
            if !all.contains(notice) {
                all.push(notice.clone());
            }
        }
        self.notices = (!all.is_empty()).then(|| serde_json::to_string(&all).unwrap_or_default());
    }

    fn notices(&self) -> Vec<Notice> {
        // A newer program may keep notices that this one does not know.
        self.notices.as_deref().and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default()
    }

    pub(super) fn is_whole(&self, session: &str) -> bool {
        self.checksum.is_none_or(|checksum| checksum == self.sum(session))
    }

    fn sum(&self, session: &str) -> u32 {
        let snapshot = self.last_snapshot.unwrap_or(u64::MAX);
        sum(&[
            session.as_bytes(),
            &[0],
            &self.seed.to_le_bytes(),
            &self.simulation_version.to_le_bytes(),
            &self.last_entry.to_le_bytes(),
            &snapshot.to_le_bytes(),
            self.written_by.as_deref().unwrap_or_default().as_bytes(),
            &[0],
            self.notices.as_deref().unwrap_or_default().as_bytes(),
        ])
    }
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
        Ok(Self { first, last, entries, checksum: None, simulation_version }.with_sum(session))
    }

    pub(super) fn with_sum(mut self, session: &str) -> Self {
        self.checksum = Some(self.sum(session));
        self
    }

    fn sum(&self, session: &str) -> u32 {
        let version = self.simulation_version.to_le_bytes();
        let (first, last) = (self.first.to_le_bytes(), self.last.to_le_bytes());
        sum(&[session.as_bytes(), &[0], &version, &first, &last, self.entries.as_bytes()])
    }

    /// The entries up to the first that is not what was written.
    ///
    /// # Errors
    ///
    /// The row is whole, but in a form that this program does not know.
    fn open(&self, session: &str) -> Result<Vec<JournalEntry>, StoreError> {
        let Some(checksum) = self.checksum else {
            return Ok(self.read(|entry| read_command(&entry.command).is_ok()));
        };
        if checksum != self.sum(session) {
            return Ok(Vec::new());
        }
        let entries = self.read(|_| true);
        if entries.len() as u64 == self.count() {
            return Ok(entries);
        }
        Err(StoreError::Later(format!(
            "its journal entry {} has a later form",
            self.first + entries.len() as u64
        )))
    }

    /// The entries before the first that cannot be read or is not wanted.
    fn read(&self, is_wanted: impl Fn(&JournalEntry) -> bool) -> Vec<JournalEntry> {
        let values: Vec<Value> = serde_json::from_str(&self.entries).unwrap_or_default();
        if values.len() as u64 > self.count() {
            return Vec::new();
        }
        let entry = |(number, value): (u64, Value)| {
            let (principal, id, command): (String, u32, String) = serde_json::from_value(value).ok()?;
            Some(JournalEntry { number, principal: Principal::parse(&principal)?, id, command })
                .filter(&is_wanted)
        };
        (self.first..).zip(values).map_while(entry).collect()
    }

    fn count(&self) -> u64 {
        (self.last - self.first.min(self.last)).saturating_add(1)
    }

    /// What is whole of it before an entry, if anything is.
    pub(super) fn before(&self, session: &str, entry: u64) -> Option<Self> {
        let mut entries = self.open(session).unwrap_or_default();
        entries.retain(|one| one.number < entry);
        Self::seal(session, self.simulation_version, &entries).ok()
    }
}

impl SnapshotRow {
    pub(super) fn seal(session: &str, through: u64, simulation_version: u32, bytes: Vec<u8>) -> Self {
        let checksum = Some(snapshot_sum(session, simulation_version, through, &bytes));
        Self { through, bytes, checksum, simulation_version }
    }

    /// The same for a store that keeps the bytes elsewhere.
    pub(super) fn without_bytes(self) -> Self {
        Self { bytes: Vec::new(), ..self }
    }

    pub(super) fn is_whole(&self, session: &str) -> bool {
        let sum = || snapshot_sum(session, self.simulation_version, self.through, &self.bytes);
        self.checksum.is_none_or(|checksum| checksum == sum())
    }
}

/// What was found of a session.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) row: SessionRow,
    /// Damaged snapshots, newest first.
    pub(super) passed_over: Vec<Damage>,
    /// The newest whole one.
    pub(super) snapshot: Option<SnapshotRow>,
    /// Rows that hold entries after it.
    pub(super) rows: Vec<JournalRow>,
}

impl Found {
    /// Puts a session together as far as it is whole, from a snapshot before an entry if one is given.
    pub(super) fn assemble(self, session: &str, before: Option<u64>) -> Result<StoredSession, StoreError> {
        let Self { row, passed_over, snapshot, rows } = self;
        let is_whole = row.is_whole(session);
        let newest = passed_over.iter().filter_map(|part| part.snapshot()).max();
        let newest = newest.max(snapshot.as_ref().map(|row| row.through));
        let expected = row.last_snapshot.filter(|last| is_whole && before.is_none_or(|entry| *last < entry));
        let lost = expected.filter(|_| expected > newest).map(Damage::Snapshot);
        let mut stored = StoredSession {
            seed: row.seed,
            notices: row.notices(),
            written_by: row.written_by.clone(),
            damage: lost.into_iter().chain(passed_over).collect(),
            ..StoredSession::default()
        };
        match snapshot {
            Some(snapshot) => {
                stored.through = snapshot.through;
                stored.snapshot = Some(snapshot.bytes);
            }
            // The journal alone is no way back: what came before the oldest snapshot may be gone, or a saved tree.
            None if before.is_some() || !stored.damage.is_empty() => {
                let places = stored.damage.iter().filter_map(|part| part.snapshot());
                let places: Vec<_> = places.map(|entry| format!("the one after entry {entry}")).collect();
                let places = if places.is_empty() {
                    String::new()
                } else {
                    format!(": damaged or missing is {}", places.join(", "))
                };
                return Err(StoreError::Damaged(format!(
                    "no snapshot of session {session} is whole{places}"
                )));
            }
            None if !is_whole => {
                return Err(StoreError::Damaged(format!("the row of session {session} is damaged")));
            }
            None => {}
        }
        let mut next = stored.through.saturating_add(1);
        for journal in rows {
            // A row is missing before this one.
            if journal.first > next {
                stored.damage.push(Damage::Journal(next));
                return Ok(stored);
            }
            let entries = journal.open(session)?;
            let end = journal.first.saturating_add(entries.len() as u64);
            stored.entries.extend(entries.into_iter().filter(|entry| entry.number >= next));
            if end > next {
                next = end;
                stored.simulations.insert(journal.simulation_version);
            }
            if next <= journal.last {
                stored.damage.push(Damage::Journal(next));
                return Ok(stored);
            }
        }
        // Where the session's row is damaged, nobody knows what else there was.
        if next <= row.last_entry || !is_whole {
            stored.damage.push(Damage::Journal(next));
        }
        Ok(stored)
    }
}

/// SHA-256 of a saved document and the version of the simulation that grew it.
pub(super) fn document_hash(document: &TreeDocument) -> Vec<u8> {
    let hash = Sha256::new().chain_update(document.simulation_version.to_le_bytes());
    hash.chain_update(&document.bytes).finalize().to_vec()
}

/// Which section of a document differs from what was written, as the end of a sentence; nothing where its own checksums
/// are right.
pub(super) fn where_damaged(bytes: &[u8]) -> String {
    Document::from_bytes(bytes).err().map_or_else(String::new, |error| format!(" ({error})"))
}

/// Of a tree's row.
pub(super) fn tree_sum(key: &str, name: &str, head: u32) -> u32 {
    sum(&[key.as_bytes(), &[0], name.as_bytes(), &[0], &head.to_le_bytes()])
}

/// Of a version's row; the documents of earlier programs have no hash.
pub(super) fn version_sum(key: &str, number: u32, hash: Option<&[u8]>) -> u32 {
    sum(&[key.as_bytes(), &[0], &number.to_le_bytes(), hash.unwrap_or_default()])
}

fn snapshot_sum(session: &str, simulation_version: u32, through: u64, bytes: &[u8]) -> u32 {
    sum(&[session.as_bytes(), &[0], &simulation_version.to_le_bytes(), &through.to_le_bytes(), bytes])
}

/// CRC-32.
fn sum(parts: &[&[u8]]) -> u32 {
    let mut sum = Crc::new();
    parts.iter().for_each(|part| sum.update(part));
    sum.sum()
}
