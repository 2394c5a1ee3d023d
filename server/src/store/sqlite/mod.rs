//! A store in one SQLite file: one writer that commits in groups, and readers beside it.

mod answers;
mod audit;
mod authors;
mod care;
mod comments;
mod finding;
mod gifts;
mod groups;
mod identity;
mod library_file;
mod locks;
mod open;
mod packing;
mod parts;
mod passes;
mod place;
mod reserve;
mod sessions;
mod shrinking;
mod standings;
mod tree_writes;
mod trees;
mod users;
mod visits;
mod writer;

use std::collections::BTreeSet;

use espalier_proto::Notice;
use espalier_session::JournalEntry;

#[cfg(test)]
use self::open::tests::Folder;
pub use self::{
    care::{CareError, Report, backup, check, restore},
    library_file::LibraryFile,
    open::{OpenError, SqliteStore},
};
use self::{
    finding::FindingWrite, parts::Manifest, sessions::SessionWrite, tree_writes::TreeWrite, writer::Write,
};
use super::{
    Collection, CollectionChange, Commits, Damage, Finding, Lease, Library, NewSession, NewSnapshot, NewTree,
    NewVersion, Picture, SessionTree, Store, StoreError, StoredSession, StoredTree, StoredVersion,
    TreeChange, TreeDocument, TreeQuery,
    seal::{JournalRow, SnapshotRow},
};

impl Store for SqliteStore {
    async fn create_session(&self, mut new: NewSession) -> Result<(), StoreError> {
        let Some(bytes) = new.snapshot.take() else {
            return self.writer.write(Write::Session(SessionWrite::Create(new, None))).await.map(drop);
        };
        let simulation_version = new.simulation_version;
        self.keep(TreeDocument { simulation_version, bytes }, |manifest, bytes| {
            let row = SnapshotRow::seal(&new.name, 0, simulation_version, bytes).without_bytes();
            Write::Session(SessionWrite::Create(new, Some((row, manifest))))
        })
        .await
        .map(drop)
    }

    async fn has_session(&self, name: &str) -> Result<bool, StoreError> {
        sessions::exists(&self.readers, name).await
    }

    async fn acquire(&self, session: &str) -> Result<Lease, StoreError> {
        self.place.check()?;
        // The lock on the file keeps other processes away.
        let lease = self.writer.leases().acquire(session);
        // On a full disk a session opens all the same.
        if let Err(error) = self.writer.write(Write::Session(SessionWrite::Enter(session.into()))).await {
            tracing::warn!(%error, session, "that the session was entered is not kept");
        }
        Ok(lease)
    }

    async fn count_try(&self, lease: &Lease) -> Result<u32, StoreError> {
        let tries = self.writer.write(Write::Session(SessionWrite::CountTry(lease.clone()))).await?;
        Ok(u32::try_from(tries).unwrap_or(u32::MAX))
    }

    async fn forget_tries(&self, lease: &Lease) -> Result<(), StoreError> {
        self.writer.write(Write::Session(SessionWrite::ForgetTries(lease.clone()))).await.map(drop)
    }

    async fn release(&self, lease: Lease) {
        self.writer.leases().release(&lease);
    }

    async fn load_session(
        &self,
        name: &str,
        before: Option<u64>,
    ) -> Result<Option<StoredSession>, StoreError> {
        sessions::load(&self.readers, name, before).await
    }

    async fn set_aside(
        &self,
        lease: &Lease,
        damage: &[Damage],
        notices: &[Notice],
    ) -> Result<(), StoreError> {
        let write = SessionWrite::SetAside(lease.clone(), damage.to_vec(), notices.to_vec());
        self.writer.write(Write::Session(write)).await.map(drop)
    }

    async fn forget_notices(&self, lease: &Lease) -> Result<(), StoreError> {
        self.writer.write(Write::Session(SessionWrite::ForgetNotices(lease.clone()))).await.map(drop)
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
        self.writer.write(Write::Session(SessionWrite::Append(lease.clone(), row))).await.map(drop)
    }

    async fn keep_snapshot(&self, lease: &Lease, snapshot: NewSnapshot) -> Result<(), StoreError> {
        let NewSnapshot { through, simulation_version, bytes, metamers } = snapshot;
        self.keep(TreeDocument { simulation_version, bytes }, |manifest, bytes| {
            let row = SnapshotRow::seal(&lease.session, through, simulation_version, bytes).without_bytes();
            Write::Session(SessionWrite::Snapshot(lease.clone(), row, manifest, metamers))
        })
        .await
        .map(drop)
    }

    async fn purge_sessions(&self, saved: &str, unsaved: &str, limit: u32) -> Result<u64, StoreError> {
        let (saved, unsaved) = (saved.to_owned(), unsaved.to_owned());
        self.writer.write(Write::Session(SessionWrite::Purge { saved, unsaved, limit })).await
    }

    async fn shrink(&self) -> Result<bool, StoreError> {
        Ok(self.keeping.tidy(&self.readers, &self.writer).await?
            || self.writer.write(Write::Shrink).await? > 0)
    }

    async fn check_place(&self) -> Result<(), StoreError> {
        self.place.check()
    }

    async fn close(&self) {
        self.shut().await;
    }
}

impl Library for SqliteStore {
    async fn add_tree(&self, mut tree: NewTree) -> Result<(), StoreError> {
        let document = tree.version.contents.take_document();
        self.keep_if_new(document, |manifest| TreeWrite::Add(tree, manifest)).await.map(drop)
    }

    async fn add_version(
        &self,
        tree: &str,
        expected: Option<u64>,
        mut version: NewVersion,
    ) -> Result<u32, StoreError> {
        let document = version.contents.take_document();
        let key = tree.to_owned();
        let write = |manifest| TreeWrite::AddVersion { key, expected, version, manifest };
        Ok(self.keep_if_new(document, write).await? as u32)
    }

    async fn change_tree(
        &self,
        tree: &str,
        expected: Option<u64>,
        change: TreeChange,
    ) -> Result<(), StoreError> {
        let write = TreeWrite::Change { key: tree.to_owned(), expected, change };
        self.writer.write(Write::Tree(write)).await.map(drop)
    }

    async fn trees(&self, query: &TreeQuery) -> Result<Vec<StoredTree>, StoreError> {
        trees::list(&self.readers, query).await
    }

    async fn tree(&self, id: &str) -> Result<Option<StoredTree>, StoreError> {
        trees::find(&self.readers, id).await
    }

    async fn versions(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredVersion>, StoreError> {
        trees::versions(&self.readers, tree, limit, before).await
    }

    async fn document(&self, tree: &str, version: u32) -> Result<Option<TreeDocument>, StoreError> {
        trees::document(&self.readers, tree, version).await
    }

    async fn thumbnail(&self, tree: &str, version: u32) -> Result<Option<Picture>, StoreError> {
        trees::thumbnail(&self.readers, tree, version).await
    }

    async fn tree_of(&self, session: &str) -> Result<Option<SessionTree>, StoreError> {
        trees::tree_of(&self.readers, session).await
    }

    async fn purge(&self, before: &str, limit: u32) -> Result<u64, StoreError> {
        self.writer.write(Write::Tree(TreeWrite::Purge { before: before.to_owned(), limit })).await
    }
}

impl SqliteStore {
    /// What was committed since it was opened.
    pub fn commits(&self) -> Commits {
        self.writer.commits()
    }
}

impl Finding for SqliteStore {
    async fn collections(&self) -> Result<Vec<Collection>, StoreError> {
        finding::collections(&self.readers).await
    }

    async fn add_collection(&self, new: Collection) -> Result<(), StoreError> {
        self.writer.write(Write::Finding(FindingWrite::AddCollection(new))).await.map(drop)
    }

    async fn change_collection(&self, id: &str, change: CollectionChange) -> Result<(), StoreError> {
        let write = FindingWrite::ChangeCollection(id.to_owned(), change);
        self.writer.write(Write::Finding(write)).await.map(drop)
    }

    async fn delete_collection(&self, id: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Finding(FindingWrite::DeleteCollection(id.to_owned()))).await.map(drop)
    }

    async fn tags(&self) -> Result<Vec<(String, u32)>, StoreError> {
        finding::tags(&self.readers).await
    }

    async fn authors(&self) -> Result<Vec<(String, u32)>, StoreError> {
        finding::authors(&self.readers).await
    }

    async fn favourites(&self, principal: &str) -> Result<BTreeSet<String>, StoreError> {
        finding::favourites(&self.readers, principal).await
    }

    async fn set_favourite(&self, principal: &str, tree: &str, is_one: bool) -> Result<(), StoreError> {
        let (principal, tree) = (principal.to_owned(), tree.to_owned());
        let write = FindingWrite::SetFavourite { principal, tree, is_one };
        self.writer.write(Write::Finding(write)).await.map(drop)
    }
}

impl SqliteStore {
    /// Keeps the parts of a document, and then what names them and may seal what they hold.
    async fn keep(
        &self,
        document: TreeDocument,
        name: impl FnOnce(Manifest, Vec<u8>) -> Write,
    ) -> Result<u64, StoreError> {
        self.keeping.keep(document, &self.readers, &self.writer, name).await
    }

    /// The same for what may hold no document of its own.
    async fn keep_if_new(
        &self,
        document: Option<TreeDocument>,
        name: impl FnOnce(Option<Manifest>) -> TreeWrite,
    ) -> Result<u64, StoreError> {
        match document {
            Some(document) => self.keep(document, |manifest, _| Write::Tree(name(Some(manifest)))).await,
            None => self.writer.write(Write::Tree(name(None))).await,
        }
    }
}

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        if is_damage(&error) {
            tracing::error!(%error, "the database is damaged");
            return Self::Damaged("its database is damaged".into());
        }
        let words = in_words(&error).unwrap_or("its database failed");
        Self::Failed { words, cause: Box::new(error) }
    }
}

/// Whether a page or a column is not what was once written, so that asking again is of no use.
fn is_damage(error: &sqlx::Error) -> bool {
    match error {
        sqlx::Error::Database(error) => {
            let code = error.code().and_then(|code| code.parse::<u32>().ok());
            matches!(code.map(|code| code & 0xff), Some(11 | 26))
        }
        sqlx::Error::ColumnDecode { .. } | sqlx::Error::Decode(_) => true,
        _ => false,
    }
}

/// What SQLite answers where there is no room for the index of its log (`SQLITE_IOERR_SHMSIZE`).
const NO_ROOM_FOR_INDEX: u32 = 4874;

/// Sentences for the ways in which SQLite refuses, by its primary result code.
fn in_words(error: &sqlx::Error) -> Option<&'static str> {
    let sqlx::Error::Database(error) = error else { return None };
    let code: u32 = error.code()?.parse().ok()?;
    if code == NO_ROOM_FOR_INDEX {
        return Some(super::FULL_DISK);
    }
    Some(match code & 0xff {
        5 | 6 => "another program holds it locked",
        8 => "it is read-only",
        10 => "the disk cannot be read or written",
        11 => "it is damaged",
        13 => super::FULL_DISK,
        14 => "it cannot be opened; does the folder exist, and may you write there?",
        23 => "access to it is denied",
        26 => "it is not a database",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{
        super::{
            MemoryStore,
            contract::{self, Breakable},
        },
        *,
    };

    impl Breakable for SqliteStore {
        async fn break_journal(&self, session: &str, first: u64) {
            self.sql(format!(
                "UPDATE journal SET entries = replace(entries, 'grow', 'glow')
                 WHERE session = '{session}' AND first = {first}"
            ))
            .await;
        }

        async fn lose_journal(&self, session: &str, first: u64) {
            self.sql(format!("DELETE FROM journal WHERE session = '{session}' AND first = {first}")).await;
        }

        async fn break_version(&self, session: &str, first: u64) {
            self.sql(format!(
                "UPDATE journal SET simulation_version = simulation_version + 1
                 WHERE session = '{session}' AND first = {first}"
            ))
            .await;
        }

        async fn break_session(&self, session: &str) {
            self.sql(format!("UPDATE sessions SET seed = 5 WHERE name = '{session}'")).await;
        }

        async fn lose_snapshot(&self, session: &str, through: u64) {
            self.sql(format!("DELETE FROM snapshots WHERE session = '{session}' AND through = {through}"))
                .await;
        }

        async fn break_snapshot(&self, session: &str, through: u64) {
            self.sql(format!(
                "UPDATE snapshots SET bytes = x'ff' WHERE session = '{session}' AND through = {through}"
            ))
            .await;
        }

        async fn break_all_snapshots(&self, session: &str) {
            self.sql(format!(
                "UPDATE parts SET packed = x'ff' WHERE id IN
                 (SELECT part FROM document_parts JOIN snapshots USING (document) WHERE session = '{session}')"
            ))
            .await;
        }

        async fn break_tree(&self, id: &str) {
            self.sql(format!(
                "UPDATE documents SET bytes = x'ff' WHERE id IN
                 (SELECT document FROM versions JOIN trees ON trees.id = tree WHERE key = '{id}')"
            ))
            .await;
        }

        async fn break_name(&self, id: &str) {
            self.sql(format!("UPDATE trees SET name = 'Elm' WHERE key = '{id}'")).await;
        }

        async fn swap_documents(&self, id: &str) {
            self.sql(format!(
                "UPDATE versions SET document =
                     (SELECT sum(document) FROM versions JOIN trees ON trees.id = tree WHERE key = '{id}') - document
                 WHERE tree = (SELECT id FROM trees WHERE key = '{id}')"
            ))
            .await;
        }

        async fn set_aside_parts(&self, session: &str) -> usize {
            let count: i64 = sqlx::query_scalar("SELECT count(*) FROM set_aside WHERE session = ?")
                .bind(session)
                .fetch_one(&self.readers)
                .await
                .unwrap();
            count as usize
        }
    }

    #[tokio::test]
    async fn keeps_the_contract() {
        contract::all(async || {
            let folder = Folder::new();
            (SqliteStore::open(&folder.database()).await.unwrap(), folder)
        })
        .await;
    }

    #[tokio::test]
    async fn the_model_keeps_the_contract() {
        contract::all(async || (MemoryStore::default(), ())).await;
    }
}
