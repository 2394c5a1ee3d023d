//! Pictures of saved versions that nobody saved with them: drawn when they are first asked for, and kept while there is
//! room, for a version never changes.

use std::sync::Arc;

use espalier_session::DocumentError;
use quick_cache::{Weighter, sync::Cache};

use crate::{
    document::Stored,
    memory::{self, Full, Memory, Use},
    pool::{Class, Panicked, Person, SimulationPool},
    store::TreeDocument,
};

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
pub struct DrawnPictures(Arc<Cache<Key, Png, Bytes>>);

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
        Self(Arc::new(Cache::with_weighter(ABOUT, ROOM, Bytes)))
    }
}

impl DrawnPictures {
    /// The picture, if it is kept.
    pub fn kept(&self, tree: &str, version: u32, kind: Kind) -> Option<Png> {
        self.0.get(&(tree.to_owned(), version, kind))
    }

    /// The picture of a document, which is drawn once for all who ask at the same time.
    pub async fn of(
        &self,
        (tree, version, kind): (String, u32, Kind),
        document: TreeDocument,
        (memory, pool): (&Memory, &SimulationPool),
        (class, person): (Class, Person),
    ) -> Result<Png, DrawError> {
        let key = (tree, version, kind);
        let drawn = self.0.get_or_insert_async(&key, async {
            let claim = memory.take_soon(Use::Export, memory::picture(document.bytes.len(), 0)).await?;
            let drawn = pool.run(class, person, move |_| {
                let mut stored = Stored::read(&document.bytes)?;
                let png = match kind {
                    Kind::Thumbnail => stored.thumbnail(),
                    Kind::Turntable { side, count } => stored.strip(side, count),
                };
                drop(claim);
                Ok::<_, DocumentError>(png.into())
            });
            Ok::<Png, DrawError>(drawn.await??)
        });
        drawn.await
    }
}
