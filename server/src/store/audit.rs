//! What was done that somebody may be asked about later: who came in, and what they deleted or took away.

use espalier_proto::access::Way;

use super::StoreError;
use crate::time::now;

/// Events kept at most; of more, the oldest are forgotten.
pub const MOST_EVENTS: u64 = 100_000;

/// Keeps a bounded list of events.
pub trait Audit {
    /// Adds an event to the list.
    async fn note(&self, event: Event) -> Result<(), StoreError>;

    /// So many at most, newest first, of those before a number; each with its own number.
    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<(u64, Event)>, StoreError>;

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

impl Event {
    /// What was done now at the machine itself.
    pub fn at_machine(action: &str, object: &str) -> Self {
        Self {
            at: now(),
            who: Way::Machine.name().to_owned(),
            address: None,
            action: action.to_owned(),
            object: Some(object.to_owned()),
            outcome: "done".to_owned(),
        }
    }
}
