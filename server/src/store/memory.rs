//! The model of a store: what the contract means, in the plainest way. It forgets all when it is dropped.

use std::{
    collections::BTreeMap,
    sync::{Mutex, MutexGuard, PoisonError},
};

use espalier_proto::Notice;
use espalier_session::JournalEntry;

use super::{
    Damage, KEPT_SNAPSHOTS, Lease, NewSession, NewSnapshot, NewTree, Picture, Store, StoreError,
    StoredSession, StoredTree, TreeDocument, TreeKey,
    lease::Leases,
    seal::{Found, JournalRow, SessionRow, SnapshotRow, tree_sum},
};

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
    trees: BTreeMap<TreeKey, (NewTree, u32)>,
}

#[derive(Debug)]
struct Session {
    row: SessionRow,
    journal: Vec<JournalRow>,
    /// In order of what they contain.
    snapshots: Vec<SnapshotRow>,
    aside: usize,
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
        Ok(changed)
    }
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
        let row = SessionRow::new(&new);
        let snapshot = |bytes| SnapshotRow::seal(&new.name, 0, new.simulation_version, bytes);
        let snapshots = new.snapshot.map(snapshot).into_iter().collect();
        let session = Session { row, journal: Vec::new(), snapshots, aside: 0 };
        kept.sessions.insert(new.name, session);
        Ok(())
    }

    async fn has_session(&self, name: &str) -> Result<bool, StoreError> {
        Ok(self.kept().sessions.contains_key(name))
    }

    async fn acquire(&self, session: &str) -> Result<Lease, StoreError> {
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
        let NewSnapshot { through, simulation_version, bytes } = snapshot;
        let row = SnapshotRow::seal(&lease.session, through, simulation_version, bytes);
        self.change(lease, |session| {
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

    async fn save_tree(&self, tree: NewTree) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let key = TreeKey { saved_at: tree.saved_at.clone(), id: tree.id.clone() };
        let checksum = tree_sum(&tree);
        kept.trees.insert(key, (tree, checksum));
        Ok(())
    }

    async fn rename_tree(&self, id: &str, name: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some((tree, checksum)) = kept.trees.values_mut().find(|(tree, _)| tree.id == id) else {
            return Ok(false);
        };
        let is_whole = *checksum == tree_sum(tree);
        tree.name = name.to_owned();
        if is_whole {
            *checksum = tree_sum(tree);
        }
        Ok(true)
    }

    async fn delete_tree(&self, id: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let before = kept.trees.len();
        kept.trees.retain(|key, _| key.id != id);
        Ok(kept.trees.len() < before)
    }

    async fn trees(&self, limit: u32, behind: Option<&TreeKey>) -> Result<Vec<StoredTree>, StoreError> {
        let kept = self.kept();
        let trees = kept.trees.iter().rev().filter(|(key, _)| behind.is_none_or(|behind| *key < behind));
        Ok(trees.take(limit as usize).map(|(key, (tree, _))| line(key, tree)).collect())
    }

    async fn tree(&self, id: &str) -> Result<Option<StoredTree>, StoreError> {
        let kept = self.kept();
        let tree = kept.trees.iter().find(|(key, _)| key.id == id);
        Ok(tree.map(|(key, (tree, _))| line(key, tree)))
    }

    async fn tree_document(&self, id: &str) -> Result<Option<TreeDocument>, StoreError> {
        let kept = self.kept();
        let Some((tree, checksum)) = kept.trees.values().find(|(tree, _)| tree.id == id) else {
            return Ok(None);
        };
        if *checksum != tree_sum(tree) {
            return Err(StoreError::Damaged(format!("the tree {id} is damaged")));
        }
        Ok(Some(tree.document.clone()))
    }

    async fn thumbnail(&self, id: &str) -> Result<Option<Picture>, StoreError> {
        let kept = self.kept();
        let tree = kept.trees.values().find(|(tree, _)| tree.id == id);
        Ok(tree.and_then(|(tree, _)| tree.thumbnail.clone()))
    }

    async fn close(&self) {
        self.kept().closed = true;
    }
}

fn line(key: &TreeKey, tree: &NewTree) -> StoredTree {
    StoredTree {
        key: key.clone(),
        name: tree.name.clone(),
        metamers: tree.metamers,
        has_thumbnail: tree.thumbnail.is_some(),
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

    async fn break_tree(&self, id: &str) {
        let mut kept = self.kept();
        for (tree, _) in kept.trees.values_mut().filter(|(tree, _)| tree.id == id) {
            tree.document.bytes[0] ^= 1;
        }
    }

    async fn break_name(&self, id: &str) {
        for (tree, _) in self.kept().trees.values_mut().filter(|(tree, _)| tree.id == id) {
            tree.name.push('!');
        }
    }

    async fn set_aside_parts(&self, session: &str) -> usize {
        self.kept().sessions.get(session).map_or(0, |session| session.aside)
    }
}
