//! The connections of a session.

use std::{collections::BTreeMap, sync::Arc};

use crate::{
    entrant::Entrant,
    io::ClientId,
    prediction::{Cancelled, Prediction},
    presence::Presence,
    principal::Principal,
    rights::Access,
    session::{AskedLimb, LookedAt},
    to_proto::Held,
    window::{MAX_UNREAD_DESIGNS, MAX_UNREAD_STATES, Window},
};

/// One connection.
#[derive(Debug)]
pub(crate) struct Client {
    /// Whose it is.
    pub(crate) entrant: Entrant,
    /// What it may do.
    pub(crate) access: Access,
    /// Control messages sent and not yet written to the socket (`FL3`).
    pub(crate) unread: usize,
    /// What it gets the newest of once it has read some of them (`FL4`).
    pub(crate) lacks: Lacks,
    /// Of those, how many are to be written until it has had the notices; none if it is sent none.
    pub(crate) notified_after: Option<usize>,
    /// Who it is; nobody before its hello.
    pub(crate) connected: Option<ConnectedClient>,
}

/// What has changed and was not sent.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lacks {
    /// Figures.
    pub(crate) state: bool,
    /// The design in force.
    pub(crate) design: bool,
    /// Colours of branches.
    pub(crate) dyes: bool,
}

impl Client {
    /// Whether it lacks figures and may be sent some.
    pub(crate) fn wants_state(&self) -> bool {
        self.lacks.state && self.unread < MAX_UNREAD_STATES
    }

    /// The same of what designs say, which may be long.
    pub(crate) fn wants_designs(&self) -> bool {
        (self.lacks.design || self.lacks.dyes) && self.unread < MAX_UNREAD_DESIGNS
    }
}

/// A client that has said hello.
#[derive(Debug)]
pub(crate) struct ConnectedClient {
    pub(crate) principal: Principal,
    /// The command up to which it knows that all is done (`CM11`).
    pub(crate) done: u32,
    pub(crate) window: Window,
    pub(crate) view: View,
    pub(crate) watch: Watch,
    pub(crate) prediction_view: PredictionView,
    /// The branch of the design that it looks at.
    pub(crate) looked_at: Option<LookedAt>,
    /// The limb that it asks for.
    pub(crate) asked_limb: Option<AskedLimb>,
    pub(crate) presence: Presence,
    /// Whether it waits to hear what its rows must add up to (`CK1`).
    pub(crate) is_checking: bool,
}

/// The open bends that a client has seen (`BE5`).
#[derive(Debug, Default)]
pub(crate) struct Watch {
    /// The newest frame sent of each bend that it does not know to be over.
    pub(crate) shown: BTreeMap<u32, u32>,
    /// A frame that it has not answered.
    pub(crate) in_flight: Option<u32>,
}

/// The predictions of a client (`PD`).
#[derive(Debug, Default)]
pub(crate) struct PredictionView {
    /// Predictions asked for and ghosts ended: the newest of them.
    pub(crate) number: u32,
    /// What is asked for and not begun.
    pub(crate) wanted: Option<Prediction>,
    /// The prediction that is being made.
    pub(crate) running: Option<Cancelled>,
    /// A ghost that waits for the last one to be answered.
    pub(crate) ready: Option<Arc<[u8]>>,
    /// A ghost that is not answered.
    pub(crate) in_flight: Option<u32>,
    /// Whether it shows a ghost.
    pub(crate) is_shown: bool,
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
