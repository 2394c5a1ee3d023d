//! What was done, for administrators, and how it is noted.

use axum::{Json, extract::State, http::StatusCode};
use espalier_proto::access::AuditEvent;
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Failure, Query},
    limit::Limit,
};
use crate::{
    access::{Caller, Peer},
    store::{Audit, DONE, Event, Noted},
    text::shown,
    time::now,
};

/// Characters that are noted of who it was and of what it was done to.
const MOST_SHOWN: usize = 200;
/// Events in one answer.
const MAX_EVENTS: u32 = 1000;

/// Which events to list.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Page {
    /// How many at most, 1 to 1000.
    #[serde(default)]
    limit: Limit<MAX_EVENTS>,
    /// Those before this number.
    before: Option<u64>,
}

pub(super) async fn list(
    State(shared): State<Shared>,
    Query(page): Query<Page>,
) -> Result<Json<Vec<AuditEvent>>, Failure> {
    let events = shared.store.events(page.limit.get(), page.before).await?;
    Ok(Json(events.into_iter().map(described).collect()))
}

/// An event as it is told.
pub fn described(Noted { number, event, times, last_at }: Noted) -> AuditEvent {
    let Event { at, who, address, action, object, outcome } = event;
    AuditEvent { number, at, who, address, action, object, outcome, times, last_at }
}

/// Says of a response what was made of that which its path names, for the list.
#[derive(Clone, Debug)]
pub(super) struct Made(pub(super) String);

/// What an answer says has come of an action.
pub(super) fn outcome(status: StatusCode) -> String {
    if status.is_success() || status.is_redirection() { DONE.into() } else { status.as_u16().to_string() }
}

impl Shared {
    /// Adds to the list what somebody did; where that fails, what they did stands all the same.
    pub(super) async fn note(
        &self,
        who: String,
        peer: Option<Peer>,
        action: &str,
        object: Option<String>,
        outcome: String,
    ) {
        let (who, object) = (shown(&who, MOST_SHOWN), object.map(|object| shown(&object, MOST_SHOWN)));
        let address = peer.map(|Peer(address)| address.to_canonical().to_string());
        let event = Event { at: now(), who, address, action: action.into(), object, outcome };
        if let Err(error) = self.store.note(event).await {
            tracing::error!(%error, action, "what was done could not be noted");
        }
    }
}

/// Where a tree or a collection lies that is seen by other people from then on, as the list calls what was done.
pub(super) const MOVE: &str = "move";

/// How the list calls somebody.
pub(super) fn called(caller: &Caller) -> String {
    let me = caller.described();
    let way = me.way.name();
    let of = caller.acts_as().map(|name| format!(" of {name}")).unwrap_or_default();
    me.name.map_or_else(|| way.to_owned(), |name| format!("{way} {name}{of}"))
}
