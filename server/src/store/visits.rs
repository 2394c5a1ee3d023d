//! Who has been in which session, and lists of sessions by that.

use super::StoreError;

/// Keeps who has been in which session.
pub trait Visits {
    /// Somebody is in a session; it is on lists again if it was taken off.
    async fn visit(&self, session: &str, person: &str) -> Result<(), StoreError>;

    /// Sessions on the list, those first in which something was done last.
    async fn sessions(&self, query: &SessionQuery) -> Result<Vec<SessionLine>, StoreError>;

    /// Takes a session off a person's list, or off everybody's where nobody is named; whether it was on it.
    async fn forget_session(&self, session: &str, person: Option<&str>) -> Result<bool, StoreError>;
}

/// Which sessions to list.
#[derive(Clone, Debug, Default)]
pub struct SessionQuery {
    /// Only those that this person has begun or been in.
    pub person: Option<String>,
    /// Only those of this tree.
    pub tree: Option<String>,
    /// Only those of trees that this person was given, or that were handed over to them.
    pub seen_by: Option<String>,
    /// Only those that are saved as they are, or those that are not.
    pub is_saved: Option<bool>,
    /// How many at most.
    pub limit: u32,
    /// Those behind this place.
    pub after: Option<SessionPlace>,
}

/// A place between the lines of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SessionPlace {
    /// When something was done in the session of the line before.
    pub used_at: String,
    /// Its name.
    pub name: String,
}

/// A session in a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SessionLine {
    /// Its name.
    pub name: String,
    /// The tree that it belongs to, and the version that it was saved as or began with.
    pub tree: Option<LineTree>,
    /// Whether nothing was done since it was saved, or since it began.
    pub is_saved: bool,
    /// Living metamers when they were counted last.
    pub metamers: u32,
    /// When somebody entered it or drew in it last.
    pub used_at: String,
}

/// The tree of a session.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineTree {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: String,
    /// The version.
    pub version: u32,
}

impl SessionLine {
    /// Its place in the list.
    pub fn place(&self) -> SessionPlace {
        SessionPlace { used_at: self.used_at.clone(), name: self.name.clone() }
    }
}
