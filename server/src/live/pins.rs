//! Where the comments of a tree are pinned, as a session takes them.

use espalier_proto::comment::ThreadPlace;
use espalier_session::{Anchor, Place};
use serde::{Deserialize, Serialize};

use crate::store::{Comments, Library, StoreError};

/// A pin as the store has it, as JSON.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StoredPin {
    /// As clients are told.
    pub at: ThreadPlace,
    /// How it is found again.
    pub anchor: Anchor,
}

impl StoredPin {
    /// As the store keeps it.
    pub fn to_json(&self) -> String {
        // Numbers and lists always have a JSON form.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// What the store has kept of a thread.
    pub fn from_json(thread: u32, json: &str) -> Result<Self, StoreError> {
        serde_json::from_str(json)
            .map_err(|error| StoreError::Damaged(format!("the pin of thread {thread} is damaged: {error}")))
    }
}

/// All pins of a tree. One that cannot be read is left out, so that the others are shown.
pub async fn pins_of(tree: &str, store: &impl Comments) -> Result<Vec<Place>, StoreError> {
    let pins = store.pins(tree).await?.into_iter();
    let read = pins.filter_map(|(thread, json)| match StoredPin::from_json(thread, &json) {
        Ok(StoredPin { at, anchor }) => Some(Place { thread, anchor, at: at.place.get() }),
        Err(error) => {
            tracing::error!(tree, %error, "a comment is shown without its place");
            None
        }
    });
    Ok(read.collect())
}

/// All pins of the tree that a session is of.
pub(super) async fn pins_of_session(
    session: &str,
    store: &(impl Comments + Library),
) -> Result<Vec<Place>, StoreError> {
    match store.tree_of(session).await? {
        Some(tree) => pins_of(&tree.id, store).await,
        None => Ok(Vec::new()),
    }
}
