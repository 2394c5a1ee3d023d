//! Pictures of saved versions that nobody saved with them: drawn when they are first asked for, and kept while there is
//! room, for a version never changes.

use std::{sync::Arc, time::Duration};

use espalier_session::DocumentError;
use quick_cache::{Weighter, sync::Cache};
use tokio::sync::Semaphore;

use crate::{
    document::Stored,
    memory::{self, Full, Memory, Use},
    pool::{Panicked, SimulationPool},
    store::TreeDocument,
};

/// Pictures that are drawn at the same time because somebody waits for them,
const AT_ONCE: usize = 2;
/// and turntables, each of a dozen pictures.
const TURNTABLES: usize = 1;

/// Bytes of pictures that are kept, and about how many pictures these are.
const ROOM: u64 = 32 << 20;
const ABOUT: usize = 512;

/// How a version is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// From the front.
    Thumbnail,
    /// From all around, in so many pictures of so many pixels across side by side.
    Turntable {
        /// Pixels across and down.
        side: usize,
        /// Pictures.
        count: u16,
    },
}

/// Why a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Somebody waits for it.
    Asked,
    /// Somebody may ask for it later.
    Ahead,
}

impl Why {
    /// How long what is drawn gives way, before each picture, to those who draw, grow and open trees.
    fn patience(self) -> Duration {
        match self {
            Self::Asked => Duration::from_millis(20),
            // Who asks meanwhile waits for the same picture.
            Self::Ahead => Duration::from_millis(200),
        }
    }
}

/// Of which tree, which version, and how.
type Key = (String, u32, Kind);
/// A PNG file.
pub type Png = Arc<[u8]>;

#[derive(Clone, Debug)]
struct Bytes;

impl Weighter<Key, Png> for Bytes {
    fn weight(&self, _: &Key, png: &Png) -> u64 {
        png.len() as u64
    }
}

/// The pictures that were drawn last.
#[derive(Clone, Debug)]
pub struct DrawnPictures {
    kept: Arc<Cache<Key, Png, Bytes>>,
    asked: Arc<Semaphore>,
    turntables: Arc<Semaphore>,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// There is no memory for it at this moment.
    #[error(transparent)]
    Full(#[from] Full),
    /// The drawing panicked.
    #[error(transparent)]
    Panicked(#[from] Panicked),
    /// The document cannot be read.
    #[error(transparent)]
    Document(#[from] DocumentError),
}

impl Default for DrawnPictures {
    fn default() -> Self {
        let kept = Arc::new(Cache::with_weighter(ABOUT, ROOM, Bytes));
        let [asked, turntables] = [AT_ONCE, TURNTABLES].map(|count| Arc::new(Semaphore::new(count)));
        Self { kept, asked, turntables }
    }
}

impl DrawnPictures {
    /// The picture, if it is kept.
    pub fn kept(&self, tree: &str, version: u32, kind: Kind) -> Option<Png> {
        self.kept.get(&(tree.to_owned(), version, kind))
    }

    /// The picture of a document, which is drawn once for all who ask at the same time.
    pub async fn of(
        &self,
        (tree, version, kind): (String, u32, Kind),
        document: TreeDocument,
        (memory, pool): (&Memory, &SimulationPool),
        why: Why,
    ) -> Result<Png, DrawError> {
        let key = (tree, version, kind);
        let drawn = self.kept.get_or_insert_async(&key, async {
            // What is drawn ahead is drawn one after the other anyway, and nobody waits behind it.
            let _place = match (why, kind) {
                (Why::Asked, Kind::Thumbnail) => self.asked.acquire().await.ok(),
                (Why::Asked, Kind::Turntable { .. }) => self.turntables.acquire().await.ok(),
                (Why::Ahead, _) => None,
            };
            let claim = memory.take_soon(Use::Export, memory::picture(document.bytes.len(), 0)).await?;
            // Pictures take seconds: on the pool others would wait behind them.
            let drawn = pool.beside("picture", move |pool| {
                let between = || pool.give_way(why.patience());
                between();
                let mut stored = Stored::read(&document.bytes)?;
                let png = match kind {
                    Kind::Thumbnail => stored.thumbnail(),
                    Kind::Turntable { side, count } => stored.strip(side, count, between),
                };
                drop(claim);
                Ok::<_, DocumentError>(png.into())
            });
            Ok::<Png, DrawError>(drawn.await??)
        });
        drawn.await
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn lb9_a_turntable_that_is_kept_waits_behind_none_that_is_drawn() {
        let (pictures, memory) = (DrawnPictures::default(), Memory::of(1 << 30));
        let pool = SimulationPool::new(None).unwrap();
        let kind = Kind::Turntable { side: 8, count: 2 };
        let key = |tree: &str| (tree.to_owned(), 1, kind);
        let png: Png = Arc::from(*b"a picture");
        pictures.kept.insert(key("ash"), Arc::clone(&png));
        let drawing = pictures.turntables.acquire().await.unwrap();
        let of = async |tree: &str| {
            let document = TreeDocument { simulation_version: 1, bytes: Vec::new() };
            pictures.of(key(tree), document, (&memory, &pool), Why::Asked).await
        };
        assert_eq!(of("ash").await.ok(), Some(png));
        let other = of("yew");
        tokio::pin!(other);
        assert!(futures_util::poll!(&mut other).is_pending(), "one is drawn at a time");
        drop(drawing);
        assert!(matches!(other.await, Err(DrawError::Document(_))));
    }
}
