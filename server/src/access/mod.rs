//! Who may do what: who asks, what they may, and the one place that decides.

pub use espalier_proto::permission::{Action, Reach};
use espalier_proto::{Problem, Reason};

pub mod admission;
mod caller;
pub mod cookie;
pub mod password;
mod rate;
mod secret;
mod tries;

pub use self::{
    caller::{Caller, Object, Peer, Unknown, address, way_of},
    rate::Rate,
    secret::{Secret, SecretHash, hash},
    tries::{Tries, network},
};

/// What whoever shows nothing that lets them in is told.
pub fn not_let_in() -> Problem {
    Problem::new(Reason::NotLetIn, "This server lets in whoever is invited or logs in.")
}
