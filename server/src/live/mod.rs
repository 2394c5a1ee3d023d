//! Sessions that are in memory: an actor for each, and the sockets connected to it.

mod actor;
mod handle;
mod keeping;
mod leaving;
mod loading;
mod outbox;
mod pins;
mod readers;
mod registry;
mod restoring;
mod socket;
mod turn;

pub use handle::{Ended, PersonNamed, SessionFigures, SessionHandle};
pub use loading::open;
pub use pins::{StoredPin, pins_of};
pub use readers::Unread;
pub use registry::{Looked, Sessions};
pub use restoring::OpenError;
pub use socket::{Grants, serve, turn_away};
