//! Documents in parts, each of which is kept once, however many documents hold it.
//!
//! A document is cut where its contents say so (FastCDC), not at fixed places: what is put in or taken out somewhere
//! changes the parts there, and the cuts behind it are where they were. So a tree that is a stroke later shares nearly
//! all parts with the one before.

use std::{collections::BTreeSet, error::Error, io, ops::Range};

use espalier_session::plain;
use fastcdc::v2020::FastCDC;
use flate2::Crc;
use sha2::{Digest, Sha256};
use sqlx::{AssertSqlSafe, QueryBuilder, Row, SqlitePool, sqlite::SqliteConnection};
use tokio::{sync::RwLock, task::spawn_blocking};

use super::{
    super::{StoreError, TreeDocument, seal::document_hash},
    packing::{Packer, Packing, Unpacker},
    writer::{Write, Writer},
};

/// How many bytes a part has at least, about and at most. Smaller ones share more, larger ones are fewer rows.
const LEAST: usize = 4 * 1024;
const USUAL: usize = 16 * 1024;
const MOST: usize = 64 * 1024;
/// So many packed bytes are written at a time, so that people's work has its turns between.
const MAX_WRITE: usize = 2 * 1024 * 1024;
/// So many parts are written by one statement: each is a turn of SQLite's own thread.
const MAX_INSERTED: usize = 32;
/// So many parts are looked for in one query.
const MAX_LOOKED_FOR: usize = 200;

type Hash = [u8; 32];

/// Where the parts of a document lie in the store.
#[derive(Clone, Debug)]
pub(super) struct Manifest {
    /// Of the whole document.
    hash: Vec<u8>,
    simulation_version: u32,
    parts: Vec<Hash>,
}

/// A part as it is written.
#[derive(Debug)]
pub(super) struct Part {
    hash: Hash,
    packed: Vec<u8>,
    checksum: u32,
}

/// Keeps the parts of documents that are about to be written from those who look for parts that nobody needs.
#[derive(Debug, Default)]
pub(super) struct Keeping(RwLock<()>);

impl Keeping {
    /// Makes parts durable, and then what names them.
    pub(super) async fn keep(
        &self,
        document: TreeDocument,
        readers: &SqlitePool,
        writer: &Writer,
        name: impl FnOnce(Manifest, Vec<u8>) -> Write,
    ) -> Result<u64, StoreError> {
        let _kept = self.0.read().await;
        let (document, cuts) = spawn_blocking(move || cut(document)).await.map_err(broken)?;
        let hashes: BTreeSet<Hash> = cuts.iter().map(|(hash, _)| *hash).collect();
        let mut missing = missing(readers, hashes).await?;
        let (hash, simulation_version) = (document_hash(&document), document.simulation_version);
        let parts = cuts.iter().map(|(hash, _)| *hash).collect();
        let mut cuts = cuts.into_iter();
        let mut bytes = document.bytes;
        let mut packed = Vec::new();
        loop {
            let packing = spawn_blocking(move || {
                let packed = pack_some(&bytes, &mut cuts, &mut missing)?;
                io::Result::Ok((packed, bytes, cuts, missing))
            });
            // What is packed is written while more is.
            let writing =
                async { if packed.is_empty() { Ok(0) } else { writer.write(Write::Parts(packed)).await } };
            let (packing, written) = tokio::join!(packing, writing);
            written?;
            (packed, bytes, cuts, missing) = packing.map_err(broken)?.map_err(broken)?;
            if packed.is_empty() {
                break;
            }
        }
        writer.write(name(Manifest { hash, simulation_version, parts }, bytes)).await
    }

    /// Finds documents and parts that nobody needs, and gives some of them up; whether there may be more.
    pub(super) async fn tidy(&self, readers: &SqlitePool, writer: &Writer) -> Result<bool, StoreError> {
        // While somebody keeps a document, its parts belong to nobody yet.
        let Ok(_alone) = self.0.try_write() else { return Ok(true) };
        for orphans in ORPHANS {
            let found: Vec<i64> = sqlx::query_scalar(AssertSqlSafe(orphans.sql())).fetch_all(readers).await?;
            if !found.is_empty() {
                writer.write(Write::Orphans(orphans, found)).await?;
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// What a work thread did not answer, or had no memory for.
fn broken(error: impl Error + Send + Sync + 'static) -> StoreError {
    StoreError::Failed { words: "a document cannot be packed", cause: Box::new(error) }
}

/// A document without its packing, and where to cut it.
fn cut(document: TreeDocument) -> (TreeDocument, Vec<(Hash, Range<usize>)>) {
    let document = TreeDocument { bytes: plain(document.bytes), ..document };
    let cuts = FastCDC::new(&document.bytes, LEAST, USUAL, MOST).map(|chunk| {
        let range = chunk.offset..chunk.offset + chunk.length;
        (Sha256::digest(&document.bytes[range.clone()]).into(), range)
    });
    let cuts = cuts.collect();
    (document, cuts)
}

/// Those of some parts that are not there, or not whole any more.
async fn missing(readers: &SqlitePool, mut wanted: BTreeSet<Hash>) -> Result<BTreeSet<Hash>, StoreError> {
    let all: Vec<Hash> = wanted.iter().copied().collect();
    for some in all.chunks(MAX_LOOKED_FOR) {
        let places = vec!["?"; some.len()].join(",");
        let sql = format!("SELECT hash, packed, checksum FROM parts WHERE hash IN ({places})");
        let mut query = sqlx::query(AssertSqlSafe(sql));
        for hash in some {
            query = query.bind(hash.as_slice());
        }
        for row in query.fetch_all(readers).await? {
            let (hash, packed): (Vec<u8>, Vec<u8>) = (row.try_get("hash")?, row.try_get("packed")?);
            let checksum: u32 = row.try_get("checksum")?;
            if let Ok(hash) = Hash::try_from(hash)
                && sum(&packed) == checksum
            {
                wanted.remove(&hash);
            }
        }
    }
    Ok(wanted)
}

/// Packs the next parts that are missing, as many as are written at a time.
fn pack_some(
    bytes: &[u8],
    cuts: &mut impl Iterator<Item = (Hash, Range<usize>)>,
    missing: &mut BTreeSet<Hash>,
) -> io::Result<Vec<Part>> {
    let mut packer = Packer::new()?;
    let mut parts = Vec::new();
    let mut length = 0;
    while length < MAX_WRITE
        && let Some((hash, range)) = cuts.find(|(hash, _)| missing.remove(hash))
    {
        let packed = packer.pack(&bytes[range])?;
        length += packed.len();
        parts.push(Part { hash, checksum: sum(&packed), packed });
    }
    Ok(parts)
}

fn sum(bytes: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum()
}

/// Writes parts that are not there, or not whole.
pub(super) async fn write(connection: &mut SqliteConnection, parts: &[Part]) -> Result<u64, StoreError> {
    for some in parts.chunks(MAX_INSERTED) {
        let mut query = QueryBuilder::new("INSERT INTO parts (hash, packing, packed, checksum) ");
        query.push_values(some, |mut row, part| {
            row.push_bind(part.hash.as_slice())
                .push_bind(Packing::NOW.column())
                .push_bind(part.packed.as_slice())
                .push_bind(part.checksum);
        });
        query.push(
            " ON CONFLICT (hash) DO UPDATE
             SET packing = excluded.packing, packed = excluded.packed, checksum = excluded.checksum",
        );
        query.build().execute(&mut *connection).await?;
    }
    Ok(parts.len() as u64)
}

/// Writes which parts a document has, if that is not known yet; gives the number of its row and its hash.
pub(super) async fn write_document(
    connection: &mut SqliteConnection,
    manifest: &Manifest,
) -> Result<(i64, Vec<u8>), StoreError> {
    let Manifest { hash, simulation_version, parts } = manifest;
    let row = sqlx::query_scalar(
        "INSERT INTO documents (hash, simulation_version, bytes) VALUES (?, ?, x'')
         ON CONFLICT (hash) DO UPDATE SET simulation_version = excluded.simulation_version, bytes = x''
         RETURNING id",
    );
    let id: i64 = row.bind(hash).bind(simulation_version).fetch_one(&mut *connection).await?;
    // One that is there already is written again: it may have been damaged since.
    sqlx::query("DELETE FROM document_parts WHERE document = ?").bind(id).execute(&mut *connection).await?;
    let numbered: Vec<(i64, &Hash)> = (0_i64..).zip(parts).collect();
    for some in numbered.chunks(MAX_LOOKED_FOR) {
        let mut query = QueryBuilder::new("INSERT INTO document_parts (document, ordinal, part) SELECT ");
        query.push_bind(id).push(", named.column1, parts.id FROM (");
        query.push_values(some, |mut row, (ordinal, part)| {
            row.push_bind(ordinal).push_bind(part.as_slice());
        });
        query.push(") AS named JOIN parts ON parts.hash = named.column2");
        if query.build().execute(&mut *connection).await?.rows_affected() != some.len() as u64 {
            return Err(StoreError::Damaged("a part of the document is not there".into()));
        }
    }
    Ok((id, hash.clone()))
}

/// What a row holds: bytes of its own, as earlier programs wrote them, or a document in parts.
pub(super) async fn contents(
    connection: &mut SqliteConnection,
    bytes: Vec<u8>,
    document: Option<i64>,
) -> Result<Vec<u8>, StoreError> {
    match document {
        Some(document) if bytes.is_empty() => read(connection, document).await,
        _ => Ok(bytes),
    }
}

/// The bytes of a document that has parts; those that can be read of it where it is damaged, which is for the caller to
/// notice.
async fn read(connection: &mut SqliteConnection, document: i64) -> Result<Vec<u8>, StoreError> {
    let parts: Vec<(i64, Vec<u8>)> = sqlx::query_as(
        "SELECT packing, packed FROM document_parts JOIN parts ON parts.id = part
         WHERE document = ? ORDER BY ordinal",
    )
    .bind(document)
    .fetch_all(connection)
    .await?;
    let unpacking = spawn_blocking(move || {
        let mut unpacker = Unpacker::new(MOST)?;
        let mut bytes = Vec::new();
        for (packing, packed) in &parts {
            let Some(packing) = Packing::of_column(*packing) else { break };
            if unpacker.unpack(packing, packed, &mut bytes).is_err() {
                break;
            }
        }
        io::Result::Ok(bytes)
    });
    unpacking.await.map_err(broken)?.map_err(broken)
}

/// Rows that nothing refers to any more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orphans {
    table: &'static str,
    /// Where a row is referred to.
    references: &'static [(&'static str, &'static str)],
}

/// In the order in which they go: a document before its parts.
const ORPHANS: [Orphans; 3] = [
    Orphans {
        table: "documents",
        references: &[("versions", "document"), ("snapshots", "document"), ("set_aside", "document")],
    },
    Orphans { table: "pictures", references: &[("versions", "picture")] },
    Orphans { table: "parts", references: &[("document_parts", "part")] },
];

impl Orphans {
    /// So many are given up in one step.
    const STEP: u32 = 32;

    fn condition(&self) -> String {
        let table = self.table;
        let none = self.references.iter().map(|(other, column)| {
            format!("NOT EXISTS (SELECT 1 FROM {other} WHERE {other}.{column} = {table}.id)")
        });
        none.collect::<Vec<_>>().join(" AND ")
    }

    fn sql(&self) -> String {
        format!("SELECT id FROM {} WHERE {} LIMIT {}", self.table, self.condition(), Self::STEP)
    }

    /// Gives up those of some rows that still nothing refers to.
    pub(super) async fn delete(
        &self,
        connection: &mut SqliteConnection,
        ids: &[i64],
    ) -> Result<u64, StoreError> {
        let sql = format!("DELETE FROM {} WHERE id = ? AND {}", self.table, self.condition());
        let mut gone = 0;
        for id in ids {
            let query = sqlx::query(AssertSqlSafe(sql.clone())).bind(id);
            gone += query.execute(&mut *connection).await?.rows_affected();
        }
        Ok(gone)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use espalier_growth::SIMULATION_VERSION;
    use espalier_proto::Command;
    use espalier_session::{Document, Principal};
    use flate2::{Compression, write::DeflateEncoder};
    use serde_json::json;

    use super::{
        super::{Folder, SqliteStore},
        MOST, Packing, Unpacker, sum,
    };
    use crate::store::{Library, NewSession, NewSnapshot, Store, contract::tree_of_bytes};

    fn after(document: &mut Document, commands: serde_json::Value) -> Vec<u8> {
        for command in serde_json::from_value::<Vec<Command>>(commands).unwrap() {
            document.apply(&Principal::visitor(), &command).unwrap();
        }
        document.to_bytes()
    }

    fn grown(document: &mut Document, steps: u32) -> Vec<u8> {
        after(document, json!([{ "kind": "grow", "steps": steps }]))
    }

    /// A short stroke up from the root.
    fn drawn(document: &mut Document) -> Vec<u8> {
        let samples = [[0.0, 1.0, 0.0], [2.0, 3.0, 0.0]].map(|at| json!({ "position": at, "radius": 1.0 }));
        after(
            document,
            json!([
                { "kind": "stroke_begin", "stroke": 1 },
                { "kind": "stroke_move", "stroke": 1, "samples": samples },
                { "kind": "stroke_end", "stroke": 1 },
            ]),
        )
    }

    async fn kept(store: &SqliteStore) -> i64 {
        sqlx::query_scalar("SELECT coalesce(sum(length(packed)), 0) FROM parts")
            .fetch_one(&store.readers)
            .await
            .unwrap()
    }

    /// ST12 of the plan for stores: versions, snapshots and sessions share what they have in common.
    #[tokio::test]
    async fn what_documents_have_in_common_is_kept_once() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let mut document = Document::new(3);
        let first = grown(&mut document, 24);
        store.add_tree(tree_of_bytes("ash", "2026", first.clone())).await.unwrap();
        let once = kept(&store).await;
        assert!(once > 100_000, "{once} bytes are a tree worth sharing");

        let session = NewSession {
            name: "oak".into(),
            simulation_version: SIMULATION_VERSION,
            snapshot: Some(first.clone()),
            ..NewSession::default()
        };
        store.create_session(session).await.unwrap();
        store.add_tree(tree_of_bytes("elm", "2026", first)).await.unwrap();
        assert_eq!(kept(&store).await, once, "opening and copying it keep nothing more");

        let lease = store.acquire("oak").await.unwrap();
        let later = drawn(&mut document);
        let snapshot = |through, bytes: &Vec<u8>| NewSnapshot {
            through,
            simulation_version: SIMULATION_VERSION,
            bytes: bytes.clone(),
            metamers: 1,
        };
        store.keep_snapshot(&lease, snapshot(1, &later)).await.unwrap();
        let twice = kept(&store).await;
        let share = (twice - once) as f64 / once as f64;
        println!("{} metamers: {once} bytes, {share:.3} of that more a stroke later", document.metamers());
        assert!(share < 0.25, "{share}");
        let read = store.load_session("oak", None).await.unwrap().unwrap();
        let read = Document::from_bytes(&read.snapshot.unwrap()).unwrap();
        assert_eq!(read.to_bytes(), later);

        store.sql("UPDATE trees SET deleted_at = '2026'".into()).await;
        store.purge("2027", 9).await.unwrap();
        for through in [2, 3] {
            store.keep_snapshot(&lease, snapshot(through, &later)).await.unwrap();
        }
        while store.shrink().await.unwrap() {}
        assert!(kept(&store).await < twice, "what only the trees held is gone");
        let read = store.load_session("oak", None).await.unwrap().unwrap();
        assert!(read.damage.is_empty() && read.snapshot.is_some(), "what the session holds is not");
        store.release(lease).await;
        store.purge_sessions("9999", "9999", 9).await.unwrap();
        while store.shrink().await.unwrap() {}
        assert_eq!(kept(&store).await, 0);
    }

    #[tokio::test]
    async fn parts_that_earlier_programs_deflated_are_read() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let bytes = grown(&mut Document::new(3), 12);
        store.add_tree(tree_of_bytes("ash", "2026", bytes.clone())).await.unwrap();
        let (id, packed): (i64, Vec<u8>) = sqlx::query_as("SELECT id, packed FROM parts ORDER BY id LIMIT 1")
            .fetch_one(&store.readers)
            .await
            .unwrap();
        let mut part = Vec::new();
        Unpacker::new(MOST).unwrap().unpack(Packing::NOW, &packed, &mut part).unwrap();
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::new(3));
        encoder.write_all(&part).unwrap();
        let deflated = encoder.finish().unwrap();
        let hex: String = deflated.iter().map(|byte| format!("{byte:02x}")).collect();
        let checksum = sum(&deflated);
        let earlier =
            format!("UPDATE parts SET packing = 0, packed = x'{hex}', checksum = {checksum} WHERE id = {id}");
        store.sql(earlier).await;
        let read = store.document("ash", 1).await.unwrap().unwrap();
        assert_eq!(Document::from_bytes(&read.bytes).unwrap().to_bytes(), bytes);

        store.sql(format!("UPDATE parts SET packing = 7 WHERE id = {id}")).await;
        assert!(store.document("ash", 1).await.is_err(), "a packing of later programs is not guessed");
    }

    #[tokio::test]
    async fn a_damaged_part_is_noticed_and_mended_by_the_next_save() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let bytes = grown(&mut Document::new(3), 12);
        store.add_tree(tree_of_bytes("ash", "2026", bytes.clone())).await.unwrap();
        let spoil = "UPDATE parts SET packed = zeroblob(length(packed))
                     WHERE id = (SELECT max(id) FROM parts)";
        store.sql(spoil.into()).await;
        assert!(store.document("ash", 1).await.is_err());
        store.add_tree(tree_of_bytes("elm", "2026", bytes.clone())).await.unwrap();
        for tree in ["ash", "elm"] {
            let read = store.document(tree, 1).await.unwrap().unwrap();
            assert_eq!(Document::from_bytes(&read.bytes).unwrap().to_bytes(), bytes);
        }
    }
}
