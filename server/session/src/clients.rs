//! The connections of a session.

use std::{collections::BTreeMap, sync::Arc};

use crate::{io::ClientId, to_proto::Held, window::Window};

/// One connection.
#[derive(Debug, Default)]
pub(crate) struct Client {
    /// Control messages sent and not yet written to the socket (`FL3`).
    pub(crate) unread: usize,
    /// Who it is; nobody before its hello.
    pub(crate) guest: Option<Guest>,
}

/// A client that has said hello.
#[derive(Debug)]
pub(crate) struct Guest {
    pub(crate) key: Arc<str>,
    pub(crate) window: Window,
    pub(crate) view: View,
}

/// What a client has of the table of rings.
#[derive(Debug)]
pub(crate) enum View {
    /// All of it: the next delta fits.
    InStep,
    /// Less; a catch-up is due when its window is empty.
    Stale(Held),
    /// A catch-up is being made.
    Coming,
}

/// All connections by id.
pub(crate) type Clients = BTreeMap<ClientId, Client>;
