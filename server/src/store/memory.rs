//! The model of a store: what the contract means, in the plainest way. It forgets all when it is dropped.

mod answers;
mod audit;
mod authors;
mod comments;
mod finding;
mod gifts;
mod groups;
mod library;
mod locks;
mod passes;
mod standings;
mod users;
mod visits;

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{Mutex, MutexGuard, PoisonError},
    time::SystemTime,
};

use espalier_proto::Notice;
use espalier_session::{JournalEntry, Named, Principal};

use super::{
    Collection, Damage, Group, Heir, KEPT_SNAPSHOTS, Lease, NewSession, NewSnapshot, Noted, Pass, Removal,
    Store, StoreError, StoredSession, User,
    lease::Leases,
    seal::{Found, JournalRow, SessionRow, SnapshotRow},
};
use crate::access::SecretHash;

/// A store in memory.
#[derive(Debug, Default)]
pub struct MemoryStore {
    leases: Leases,
    kept: Mutex<Kept>,
}

#[derive(Debug, Default)]
struct Kept {
    closed: bool,
    sessions: BTreeMap<String, Session>,
    trees: BTreeMap<String, library::Tree>,
    collections: BTreeMap<String, Collection>,
    /// Principals and trees.
    favourites: BTreeSet<(String, String)>,
    passes: Vec<(SecretHash, Pass)>,
    /// In the order in which they began.
    answers: Vec<answers::Begun>,
    /// By their numbers.
    events: BTreeMap<u64, Noted>,
    last_event: u64,
    /// Each with the time when it was called so.
    authors: BTreeMap<Principal, (String, Named)>,
    /// Who has locked which tree.
    locks: BTreeMap<String, String>,
    removals: Vec<Removal>,
    /// To whom trees were handed over.
    heirs: BTreeMap<String, Heir>,
    /// By their trees and numbers.
    threads: BTreeMap<String, BTreeMap<u32, comments::Thread>>,
    /// By their folded names.
    users: BTreeMap<String, User>,
    /// By their folded names.
    groups: BTreeMap<String, Group>,
    gifts: Vec<gifts::KeptGift>,
}

#[derive(Debug)]
struct Session {
    row: SessionRow,
    journal: Vec<JournalRow>,
    /// In order of what they contain.
    snapshots: Vec<SnapshotRow>,
    aside: usize,
    /// The tree it belongs to, and its version.
    tree: Option<(String, u32)>,
    saved_through: u64,
    entered_at: String,
    tries: u32,
    /// Who has begun it or been in it.
    people: BTreeSet<String>,
    metamers: u32,
    is_forgotten: bool,
}

impl Session {
    fn is_saved(&self) -> bool {
        let is_untouched = self.row.last_entry == 0 && self.row.last_snapshot.is_none();
        self.row.last_entry <= self.saved_through && (self.tree.is_some() || is_untouched)
    }
}

impl MemoryStore {
    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn writing(&self) -> Result<MutexGuard<'_, Kept>, StoreError> {
        Some(self.kept()).filter(|kept| !kept.closed).ok_or(StoreError::Closed)
    }

    fn change<T>(
        &self,
        lease: &Lease,
        change: impl FnOnce(&mut Session) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        self.mend(lease, |session| {
            if !session.row.is_whole(&lease.session) {
                return Err(StoreError::Damaged("the row of the session is damaged".into()));
            }
            change(session)
        })
    }

    /// Changes a session whose own row may be damaged.
    fn mend<T>(
        &self,
        lease: &Lease,
        change: impl FnOnce(&mut Session) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        let mut kept = self.writing()?;
        self.leases.check(lease)?;
        let session = kept.sessions.get_mut(&lease.session).ok_or_else(unknown)?;
        let changed = change(session)?;
        session.row = session.row.clone().sealed(&lease.session);
        session.entered_at = now();
        Ok(changed)
    }
}

fn now() -> String {
    humantime::format_rfc3339_millis(SystemTime::now()).to_string()
}

fn unknown() -> StoreError {
    StoreError::Damaged("there is no such session".into())
}

impl Store for MemoryStore {
    async fn create_session(&self, new: NewSession) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if kept.sessions.contains_key(&new.name) {
            return Err(StoreError::Damaged("there is such a session".into()));
        }
        let row = SessionRow::new(&new, new.snapshot.is_some());
        let snapshot = |bytes| SnapshotRow::seal(&new.name, 0, new.simulation_version, bytes);
        let snapshots = new.snapshot.map(snapshot).into_iter().collect();
        if let Some((tree, version)) = &new.tree
            && let Some(tree) = kept.trees.get_mut(tree)
            && tree.versions.len() == *version as usize
            && !new.is_beside
        {
            tree.session = Some(new.name.clone());
        }
        let (tree, saved_through) = (new.tree, 0);
        let (journal, aside, entered_at, tries) = (Vec::new(), 0, now(), 0);
        let (people, metamers, is_forgotten) = (new.person.into_iter().collect(), new.metamers, false);
        let session = Session {
            row,
            journal,
            snapshots,
            aside,
            tree,
            saved_through,
            entered_at,
            tries,
            people,
            metamers,
            is_forgotten,
        };
        kept.sessions.insert(new.name, session);
        Ok(())
    }

    async fn count_try(&self, lease: &Lease) -> Result<u32, StoreError> {
        let mut kept = self.writing()?;
        self.leases.check(lease)?;
        let Some(session) = kept.sessions.get_mut(&lease.session) else { return Ok(0) };
        session.tries += 1;
        Ok(session.tries)
    }

    async fn forget_tries(&self, lease: &Lease) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        self.leases.check(lease)?;
        if let Some(session) = kept.sessions.get_mut(&lease.session) {
            session.tries = 0;
        }
        Ok(())
    }

    async fn has_session(&self, name: &str) -> Result<bool, StoreError> {
        Ok(self.kept().sessions.contains_key(name))
    }

    async fn acquire(&self, session: &str) -> Result<Lease, StoreError> {
        if let Some(session) = self.kept().sessions.get_mut(session) {
            session.entered_at = now();
        }
        Ok(self.leases.acquire(session))
    }

    async fn release(&self, lease: Lease) {
        self.leases.release(&lease);
    }

    async fn load_session(
        &self,
        name: &str,
        before: Option<u64>,
    ) -> Result<Option<StoredSession>, StoreError> {
        let kept = self.kept();
        let Some(session) = kept.sessions.get(name) else { return Ok(None) };
        let mut passed_over = Vec::new();
        let mut snapshot = None;
        let candidates = session.snapshots.iter().rev();
        for row in candidates.filter(|row| before.is_none_or(|entry| row.through < entry)) {
            if row.is_whole(name) {
                snapshot = Some(row.clone());
                break;
            }
            passed_over.push(Damage::Snapshot(row.through));
        }
        let through = snapshot.as_ref().map_or(0, |row| row.through);
        let rows = session.journal.iter().filter(|row| row.last > through).cloned().collect();
        let found = Found { row: session.row.clone(), passed_over, snapshot, rows };
        found.assemble(name, before).map(Some)
    }

    async fn set_aside(
        &self,
        lease: &Lease,
        damage: &[Damage],
        notices: &[Notice],
    ) -> Result<(), StoreError> {
        self.mend(lease, |session| {
            for part in damage {
                match *part {
                    Damage::Snapshot(through) => {
                        session.aside +=
                            session.snapshots.extract_if(.., |row| row.through == through).count();
                    }
                    Damage::Journal(from) => {
                        let rows: Vec<_> = session.journal.extract_if(.., |row| row.last >= from).collect();
                        session.aside += rows.len();
                        session
                            .journal
                            .extend(rows.iter().filter_map(|row| row.before(&lease.session, from)));
                        session.row.last_entry = from - 1;
                    }
                }
            }
            session.row.last_snapshot = session.snapshots.last().map(|row| row.through);
            session.row.keep_notices(notices);
            Ok(())
        })
    }

    async fn forget_notices(&self, lease: &Lease) -> Result<(), StoreError> {
        self.change(lease, |session| {
            session.row.notices = None;
            Ok(())
        })
    }

    async fn append(
        &self,
        lease: &Lease,
        simulation_version: u32,
        entries: &[JournalEntry],
    ) -> Result<(), StoreError> {
        if entries.is_empty() {
            return Ok(());
        }
        let row = JournalRow::seal(&lease.session, simulation_version, entries)?;
        self.change(lease, |session| {
            let last = session.row.last_entry;
            if row.first != last + 1 {
                return Err(StoreError::OutOfOrder { last, found: row.first });
            }
            session.row.last_entry = row.last;
            session.journal.push(row);
            Ok(())
        })
    }

    async fn keep_snapshot(&self, lease: &Lease, snapshot: NewSnapshot) -> Result<(), StoreError> {
        let NewSnapshot { through, simulation_version, bytes, metamers } = snapshot;
        let row = SnapshotRow::seal(&lease.session, through, simulation_version, bytes);
        self.change(lease, |session| {
            session.metamers = metamers;
            session.snapshots.retain(|row| row.through != through);
            session.snapshots.push(row);
            session.snapshots.sort_by_key(|row| row.through);
            session.row.last_snapshot = session.snapshots.last().map(|row| row.through);
            session.row.last_entry = session.row.last_entry.max(through);
            let surplus = session.snapshots.len().saturating_sub(KEPT_SNAPSHOTS);
            session.snapshots.drain(..surplus);
            if session.snapshots.len() == KEPT_SNAPSHOTS {
                let needed = session.snapshots[0].through;
                session.journal.retain(|row| row.last > needed);
            }
            Ok(())
        })
    }

    async fn purge_sessions(&self, saved: &str, unsaved: &str, limit: u32) -> Result<u64, StoreError> {
        let mut kept = self.writing()?;
        let mut due: Vec<_> = kept.sessions.iter().collect();
        due.retain(|(name, session)| {
            let before = if session.is_saved() { saved } else { unsaved };
            session.entered_at.as_str() < before && !self.leases.is_held(name)
        });
        due.sort_by_key(|(_, session)| session.entered_at.clone());
        let names: Vec<String> = due.into_iter().map(|(name, _)| name.clone()).take(limit as usize).collect();
        for name in &names {
            kept.sessions.remove(name);
            let trees = kept.trees.values_mut().filter(|tree| tree.session.as_ref() == Some(name));
            trees.for_each(|tree| tree.session = None);
        }
        Ok(names.len() as u64)
    }

    async fn shrink(&self) -> Result<bool, StoreError> {
        self.writing().map(|_| false)
    }

    async fn check_place(&self) -> Result<(), StoreError> {
        self.writing().map(drop)
    }

    async fn close(&self) {
        self.kept().closed = true;
    }
}

impl super::contract::Breakable for MemoryStore {
    async fn break_journal(&self, session: &str, first: u64) {
        let mut kept = self.kept();
        let rows = kept.sessions.get_mut(session).into_iter().flat_map(|session| &mut session.journal);
        for row in rows.filter(|row| row.first == first) {
            row.entries = row.entries.replace("grow", "glow");
        }
    }

    async fn lose_journal(&self, session: &str, first: u64) {
        let mut kept = self.kept();
        kept.sessions.get_mut(session).unwrap().journal.retain(|row| row.first != first);
    }

    async fn break_version(&self, session: &str, first: u64) {
        let mut kept = self.kept();
        let mut rows = kept.sessions.get_mut(session).unwrap().journal.iter_mut();
        rows.find(|row| row.first == first).unwrap().simulation_version += 1;
    }

    async fn break_session(&self, session: &str) {
        self.kept().sessions.get_mut(session).unwrap().row.seed ^= 1;
    }

    async fn lose_snapshot(&self, session: &str, through: u64) {
        let mut kept = self.kept();
        kept.sessions.get_mut(session).unwrap().snapshots.retain(|row| row.through != through);
    }

    async fn break_snapshot(&self, session: &str, through: u64) {
        let mut kept = self.kept();
        let rows = kept.sessions.get_mut(session).into_iter().flat_map(|session| &mut session.snapshots);
        for row in rows.filter(|row| row.through == through) {
            row.bytes[0] ^= 1;
        }
    }

    async fn break_all_snapshots(&self, session: &str) {
        for row in &mut self.kept().sessions.get_mut(session).unwrap().snapshots {
            row.bytes[0] ^= 1;
        }
    }

    async fn break_tree(&self, id: &str) {
        let mut kept = self.kept();
        let tree = kept.trees.get_mut(id).unwrap();
        tree.versions.iter_mut().for_each(|version| version.saved.document.bytes[0] ^= 1);
    }

    async fn break_name(&self, id: &str) {
        self.kept().trees.get_mut(id).unwrap().name.push('!');
    }

    async fn swap_documents(&self, id: &str) {
        let mut kept = self.kept();
        let versions = &mut kept.trees.get_mut(id).unwrap().versions;
        let (first, second) = versions.split_at_mut(1);
        std::mem::swap(&mut first[0].saved, &mut second[0].saved);
        std::mem::swap(&mut first[0].hash, &mut second[0].hash);
    }

    async fn set_aside_parts(&self, session: &str) -> usize {
        self.kept().sessions.get(session).map_or(0, |session| session.aside)
    }
}
