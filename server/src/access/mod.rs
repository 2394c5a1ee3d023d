//! Who may do what: who asks, what they may, and the one place that decides.

use espalier_proto::{Problem, Reason};

pub mod admission;
mod allowance;
mod caller;
pub mod cookie;
pub mod password;
mod secret;
mod table;
mod tries;

pub use self::{
    allowance::Allowances,
    caller::{Caller, Object, Peer, Unknown, address, way_of},
    secret::{Secret, SecretHash, hash},
    table::{Action, Reach},
    tries::{Tries, network},
};

/// What whoever shows nothing that lets them in is told.
pub fn not_let_in() -> Problem {
    Problem::new(Reason::NotLetIn, "This server lets in whoever is invited or logs in.")
}
