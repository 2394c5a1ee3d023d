//! Sessions that are in memory: an actor for each, and the sockets connected to it.

mod actor;
mod outbox;
mod registry;
mod socket;

pub use actor::{Ended, SessionHandle};
pub use registry::{OpenError, Sessions};
pub use socket::{REFUSED_MESSAGE_BYTES, serve, turn_away};
