//! What lets people in: invitations, devices, tokens.

use espalier_proto::access::Role;

use super::StoreError;
use crate::access::SecretHash;

/// Keeps passes. Their secrets are kept nowhere, so that who reads the database cannot come in with what stands there.
pub trait Passes {
    /// Keeps a pass; [`StoreError::NotFound`] where its tree or its holder is not there. A login's user is known by its
    /// name.
    async fn add_pass(&self, hash: SecretHash, pass: Pass) -> Result<(), StoreError>;

    /// The same with a token, or an invitation to a tree, where there are fewer than so many like it when it is made: tokens
    /// of the same holder, or what lets in for the same tree. Else it is [`StoreError::Full`].
    async fn add_pass_up_to(&self, most: u32, hash: SecretHash, pass: Pass) -> Result<(), StoreError>;

    /// The pass with this secret, unless it has expired.
    async fn pass(&self, hash: SecretHash, now: &str) -> Result<Option<Pass>, StoreError>;

    /// All of a kind that have not expired, newest first.
    async fn passes(&self, kind: PassKind, now: &str) -> Result<Vec<Pass>, StoreError>;

    /// Lets a pass last until another time.
    async fn extend_pass(&self, id: &str, expires_at: &str) -> Result<(), StoreError>;

    /// Lets a pass allow something else; whether it was there. What a login allows is its user's role.
    async fn change_pass(&self, id: &str, role: Role) -> Result<bool, StoreError>;

    /// Makes what an invitation lets in of it, which keeps its identifier and what it allows: a device with a secret of its
    /// own. Of several who do so at once one is told that it was done, and nobody while its tree is deleted.
    async fn redeem_pass(&self, hash: SecretHash, device: &Pass) -> Result<bool, StoreError>;

    /// Takes a pass away. Of several who do so at once, one is told that it was there.
    async fn take_pass(&self, id: &str) -> Result<bool, StoreError>;

    /// Forgets all that have expired.
    async fn purge_passes(&self, now: &str) -> Result<(), StoreError>;
}

/// Lets somebody in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pass {
    /// What it is told from others by; it is no secret.
    pub id: String,
    /// How it lets in.
    pub kind: PassKind,
    /// How people call it.
    pub name: String,
    /// What it allows: never more than whoever holds it may.
    pub role: Role,
    /// Whoever holds it: the user of a login, and whoever has made a token.
    pub holder: Option<Holder>,
    /// As whoever holds it a program may do no more than this, also where they may do more than elsewhere.
    pub most: Option<Role>,
    /// The only tree it is for.
    pub tree: Option<String>,
    /// When it was made.
    pub created_at: String,
    /// When it stops letting in, unless it is extended.
    pub expires_at: String,
    /// When it ends for good; for an invitation, when what comes of it does.
    pub ends_at: String,
}

/// Whoever holds a pass, as whom it lets in. It goes with them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Holder {
    /// A user.
    User {
        /// Their identifier.
        id: String,
        /// What they are called.
        name: String,
    },
    /// A device.
    Device {
        /// The identifier of its own pass.
        id: String,
        /// What it is known by.
        hash: SecretHash,
        /// How people call it.
        name: String,
    },
}

impl Holder {
    /// What they are called.
    pub fn name(&self) -> &str {
        match self {
            Self::User { name, .. } | Self::Device { name, .. } => name,
        }
    }
}

/// How a pass lets in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassKind {
    /// Once, and then as a device.
    Invitation,
    /// By a cookie.
    Device,
    /// By a cookie, as the user whose name it has.
    Login,
    /// By a header that a program sends.
    Token,
}

impl PassKind {
    /// How it is written in a database.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Invitation => "invitation",
            Self::Device => "device",
            Self::Login => "login",
            Self::Token => "token",
        }
    }

    /// The kind that is written so.
    pub(super) fn named(name: &str) -> Option<Self> {
        [Self::Invitation, Self::Device, Self::Login, Self::Token]
            .into_iter()
            .find(|kind| kind.name() == name)
    }
}
