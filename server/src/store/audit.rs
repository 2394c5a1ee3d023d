//! What was done that somebody may be asked about later: who came in, and what they deleted or took away.

use std::time::{Duration, SystemTime};

use espalier_proto::access::Way;

use super::StoreError;
use crate::time::{now, written};

/// Rows kept at most; of more, the oldest are forgotten.
pub const MOST_EVENTS: u64 = 100_000;

/// Events that come again within this time of the first are counted in its row.
const COUNTED_FOR: Duration = Duration::from_hours(24);
/// Rows of what somebody is refused in that time for one reason; what else they are refused is counted in the last of
/// them.
pub(super) const MOST_REFUSED: u32 = 20;

/// How the list calls the taking of a tree.
pub const EXPORT: &str = "export";
/// What has come of an event that was not refused.
pub const DONE: &str = "done";

/// Keeps a bounded list of events.
pub trait Audit {
    /// Adds an event to the list, or counts it where it comes again ([`Event::may_repeat`]).
    async fn note(&self, event: Event) -> Result<(), StoreError>;

    /// So many at most, newest first, of those before a number.
    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<Noted>, StoreError>;

    /// Forgets what was before a time.
    async fn purge_events(&self, before: &str) -> Result<(), StoreError>;
}

/// Something that was done, or refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// When.
    pub at: String,
    /// By whom: how they came in, and how they are called.
    pub who: String,
    /// Where they asked from.
    pub address: Option<String>,
    /// What.
    pub action: String,
    /// To what.
    pub object: Option<String>,
    /// `done`, or the reason why not.
    pub outcome: String,
}

/// An event on the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Noted {
    /// Its own number.
    pub number: u64,
    /// What was done, the first time.
    pub event: Event,
    /// How often.
    pub times: u32,
    /// When it came last, where it came again.
    pub last_at: Option<String>,
}

impl Event {
    /// Whether it was refused.
    pub fn is_refused(&self) -> bool {
        self.outcome != DONE
    }

    /// Whether it is counted where it comes again. What changes something is noted each time.
    pub fn may_repeat(&self) -> bool {
        self.is_refused() || self.action == EXPORT
    }

    /// Since when an equal one may have come for this one to be counted with it.
    pub(super) fn counted_since(&self) -> String {
        let at = humantime::parse_rfc3339(&self.at).unwrap_or_else(|_| SystemTime::now());
        written(at - COUNTED_FOR)
    }

    /// What was done now at the machine itself.
    pub fn at_machine(action: &str, object: &str) -> Self {
        Self {
            at: now(),
            who: Way::Machine.name().to_owned(),
            address: None,
            action: action.to_owned(),
            object: Some(object.to_owned()),
            outcome: DONE.to_owned(),
        }
    }
}
