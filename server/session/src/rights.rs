//! What a connection may do in a session (`AU2`). The server says so when it opens (`access`).

use espalier_proto::{Problem, Reason};

/// What somebody may do in a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Access {
    /// See it.
    #[default]
    Look,
    /// Have commands done.
    Edit,
}

impl Access {
    pub(crate) fn check_edit(self) -> Result<(), Problem> {
        match self {
            Self::Edit => Ok(()),
            Self::Look => Err(forbidden().at("kind", "commands of somebody who may edit")),
        }
    }
}

/// The refusal of what somebody may not do.
pub fn forbidden() -> Problem {
    Problem::new(Reason::Forbidden, "You may not do this here.")
}
