//! Why an edit is refused. Nothing of a refused edit is done.

use espalier_reading::NotAllowed;
use thiserror::Error;

use crate::{
    graph::{Owner, ShareId},
    key::Key,
    node::NodeId,
};

/// Most values that may be said in one design.
pub const MAX_VALUES: usize = 4096;
/// Most shared values.
pub const MAX_SHARES: usize = 512;
/// Most edits in one batch.
pub const MAX_BATCH: usize = 4096;

/// Why an edit is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Refusal {
    /// No such branch.
    #[error("there is no branch {0}: its bearer has no such lateral")]
    Unknown(NodeId),
    /// A branch for which there is no room.
    #[error(
        "branch {0} sleeps, for its bearer has no room for it; give the bearer more laterals, or forget the branch"
    )]
    Asleep(NodeId),
    /// A parameter of the root at another branch, or a level.
    #[error("{key} is a parameter of the root, not of {owner}")]
    OfRootOnly {
        /// Who should have got it.
        owner: Owner,
        /// The parameter.
        key: Key,
    },
    /// The root has nothing to inherit from.
    #[error("the root has nothing to inherit {0} from; it can only have a value of its own, or say nothing")]
    NothingToInherit(Key),
    /// The root keeps nothing to itself.
    #[error("all values of the root are public; {0} cannot be private there")]
    RootIsPublic(Key),
    /// A value that the parameter does not take.
    #[error("{owner}: {key}{} is {}, allowed is {}", .fault.at, .fault.found, .fault.allowed)]
    NotAllowed {
        /// Who should have got it; none for a shared value.
        owner: Place,
        /// The parameter.
        key: Key,
        /// What is wrong with it.
        fault: NotAllowed,
    },
    /// Only numbers and functions have relative values.
    #[error("{0} can be no relative value; numbers and functions can")]
    NotRelative(Key),
    /// No such share.
    #[error("there is no shared value {}", .0.0)]
    NoShare(ShareId),
    /// The number of a share that there is already.
    #[error("there is a shared value {} already", .0.0)]
    ShareTaken(ShareId),
    /// A share of another parameter, or of another order.
    #[error("{node} cannot share value {}: it is of {key} at order {order}", .share.0)]
    NotOfShare {
        /// Who should have shared it.
        node: Owner,
        /// The share.
        share: ShareId,
        /// Its parameter.
        key: Key,
        /// Its order.
        order: u8,
    },
    /// A share without members.
    #[error("a shared value needs at least one branch that shares it")]
    NobodyShares,
    /// A copy of a branch onto itself, its bearers, or what it bears, which would have no end.
    #[error("{from} cannot be copied to {to}: one bears the other, and the copy would have no end")]
    IntoItself {
        /// What should have been copied.
        from: NodeId,
        /// Where to.
        to: NodeId,
    },
    /// A copy of more orders of branching than there are.
    #[error("{from} cannot be copied to {to}: something it bears would be above order 4")]
    TooHigh {
        /// What should have been copied.
        from: NodeId,
        /// Where to.
        to: NodeId,
    },
    /// The root is no lateral.
    #[error("the root is no lateral of anything")]
    RootIsNoLateral,
    /// A place that is none on an axis.
    #[error("place {0} is not on the axis; allowed is 0 to 1")]
    OffAxis(String),
    /// Too many values.
    #[error("the design would have {found} values of its own; allowed are {MAX_VALUES}")]
    TooManyValues {
        /// How many there would be.
        found: usize,
    },
    /// Too many shares.
    #[error("the design would have more than {MAX_SHARES} shared values")]
    TooManyShares,
    /// Too many branches.
    #[error(
        "the plant would have more than {} branches; give axes fewer laterals, or fewer orders",
        crate::MAX_BRANCHES
    )]
    TooManyBranches,
    /// Too many edits at once.
    #[error("{found} edits at once; allowed are {MAX_BATCH}")]
    BatchTooLong {
        /// How many there are.
        found: usize,
    },
    /// One edit of several.
    #[error("edit {at}: {refusal}")]
    InBatch {
        /// Which, counted from 0.
        at: usize,
        /// Why.
        refusal: Box<Refusal>,
    },
}

/// Who a value is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// An owner.
    Owner(Owner),
    /// All that share a value.
    Share(ShareId),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Owner(owner) => owner.fmt(f),
            Self::Share(share) => write!(f, "shared value {}", share.0),
        }
    }
}
