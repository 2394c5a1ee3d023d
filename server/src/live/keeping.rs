//! Where what is done in a session is kept: in the store, or nowhere, as of a replay.

use std::{sync::Arc, time::Duration};

use espalier_session::{JournalEntry, Named, Place, Principal};

use super::pins::pins_of_session;
use crate::{
    SIMULATION_VERSION,
    store::{AnyStore, Authors, Lease, NewSnapshot, Store, StoreError},
    time,
};

/// A session without clients for so long is unloaded.
const IDLE: Duration = Duration::from_secs(60);

/// Where what is done in a session is kept.
#[derive(Clone, Debug)]
pub(super) enum Keeping {
    /// In the store, by the right to write to the session.
    Stored(Arc<AnyStore>, Lease),
    /// Nowhere: it is a copy for one who looks on.
    Nowhere,
}

impl Keeping {
    /// How long the session waits for somebody to come back.
    pub(super) fn patience(&self) -> Duration {
        match self {
            Self::Stored(..) => IDLE,
            Self::Nowhere => Duration::ZERO,
        }
    }

    /// Makes commands durable.
    pub(super) async fn append(&self, entries: &[JournalEntry]) -> Result<(), StoreError> {
        match self {
            Self::Stored(store, lease) => store.append(lease, SIMULATION_VERSION, entries).await,
            Self::Nowhere => Ok(()),
        }
    }

    /// Keeps the document of so many metamers, with everything done in it through a journal entry.
    pub(super) async fn keep_snapshot(
        &self,
        through: u64,
        bytes: Vec<u8>,
        metamers: u32,
    ) -> Result<(), StoreError> {
        let snapshot = NewSnapshot { through, simulation_version: SIMULATION_VERSION, bytes, metamers };
        match self {
            Self::Stored(store, lease) => store.keep_snapshot(lease, snapshot).await,
            Self::Nowhere => Ok(()),
        }
    }

    /// The server outlives the session.
    pub(super) async fn forget_tries(&self) -> Result<(), StoreError> {
        match self {
            Self::Stored(store, lease) => store.forget_tries(lease).await,
            Self::Nowhere => Ok(()),
        }
    }

    /// What is to be told of how it was opened has been told.
    pub(super) async fn forget_notices(&self) -> Result<(), StoreError> {
        match self {
            Self::Stored(store, lease) => store.forget_notices(lease).await,
            Self::Nowhere => Ok(()),
        }
    }

    /// Where the comments of the tree are pinned.
    pub(super) async fn pins(&self, session: &str) -> Result<Vec<Place>, StoreError> {
        match self {
            Self::Stored(store, _) => pins_of_session(session, &**store).await,
            Self::Nowhere => Ok(Vec::new()),
        }
    }

    /// What authors are called.
    pub(super) async fn named_authors(&self, authors: &[Principal]) -> Result<Vec<Named>, StoreError> {
        match self {
            Self::Stored(store, _) => store.named_authors(authors).await,
            // It has them from the session that it is of.
            Self::Nowhere => Ok(Vec::new()),
        }
    }

    /// An author is called so.
    pub(super) async fn name_author(&self, named: &Named) -> Result<(), StoreError> {
        match self {
            Self::Stored(store, _) => store.name_author(named, &time::now()).await,
            Self::Nowhere => Ok(()),
        }
    }

    /// The session has ended.
    pub(super) async fn release(self) {
        match self {
            Self::Stored(store, lease) => store.release(lease).await,
            Self::Nowhere => {}
        }
    }
}
