//! What a connection may do in a session (`AU2`). The server says so when it opens (`access`).

use espalier_proto::{Action, Problem, Reason};

/// What somebody may do in a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Access {
    /// See it.
    #[default]
    Look,
    /// See it at any step of the line, in a copy that is theirs alone (`RP1`).
    Travel,
    /// Have commands done.
    Edit,
}

impl Access {
    pub(crate) fn check(self, action: &Action) -> Result<(), Problem> {
        match self {
            Self::Edit => Ok(()),
            Self::Travel if matches!(action, Action::GoTo { .. }) => Ok(()),
            Self::Travel => Err(forbidden().at("kind", "go_to")),
            Self::Look => Err(forbidden().at("kind", "commands of somebody who may edit")),
        }
    }
}

/// The refusal of what somebody may not do.
pub fn forbidden() -> Problem {
    Problem::new(Reason::Forbidden, "You may not do this here.")
}
