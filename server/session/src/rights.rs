//! What a session asks before somebody joins it, and before it takes a command (`AU2`). The server answers
//! (`authority.rs`).

use std::{fmt, sync::Arc};

use espalier_proto::{Problem, Reason};

use crate::principal::Principal;

/// What somebody wants of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// To join and see it.
    Join,
    /// To have a command done.
    Edit,
}

/// Says who may do what in a session. By default everybody may do everything.
#[derive(Clone)]
pub struct Rights(Arc<May>);

type May = dyn Fn(&Principal, Access) -> bool + Send + Sync;

impl Rights {
    /// The rights that this function gives.
    pub fn new(may: impl Fn(&Principal, Access) -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(may))
    }

    pub(crate) fn ask(&self, principal: &Principal, access: Access) -> Result<(), Problem> {
        let (field, allowed) = match access {
            Access::Join => ("client", "the key of a client that may join"),
            Access::Edit => ("kind", "commands of a client that may edit"),
        };
        if (self.0)(principal, access) { Ok(()) } else { Err(forbidden().at(field, allowed)) }
    }
}

impl Default for Rights {
    fn default() -> Self {
        Self::new(|_, _| true)
    }
}

impl fmt::Debug for Rights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Rights")
    }
}

/// The refusal of what a principal may not do.
pub fn forbidden() -> Problem {
    Problem::new(Reason::Forbidden, "You may not do this here.")
}
