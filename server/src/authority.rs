//! Who may do what: the one place that decides.

use espalier_session::{Access, Principal, Rights};

/// What is asked for, at an address or for something that a request names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    BeginSession,
    SeeSession,
    JoinSession,
    /// Does a command in a session, uploads included.
    EditSession,
    /// Takes the tree of a session, as a file or into the library.
    TakeTree,
    SeeObstacle,
    SeeSpecies,
    DrawSchematic,
    ListTrees,
    SaveTree,
    /// Takes what was saved of a tree: begins a session with it, copies it, or takes its document.
    OpenTree,
    /// Sees a tree with its versions and their pictures.
    SeeTree,
    /// Changes what is said of a tree, or saves a version of it.
    ChangeTree,
    /// Deletes a tree, or takes that back.
    DeleteTree,
    /// Makes, changes and deletes collections.
    ChangeCollections,
}

/// What it is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Object<'a> {
    /// The server as a whole, and its library.
    Server,
    /// The session of this name.
    Session(&'a str),
    /// The saved tree with this identifier.
    Tree(&'a str),
}

/// Decides whether somebody may do something.
pub type Authority = fn(&Principal, Action, Object<'_>) -> bool;

/// What a session asks, of this authority and under its name.
pub fn over(authority: Authority, session: &str) -> Rights {
    let session = session.to_owned();
    Rights::new(move |principal, access| {
        let action = match access {
            Access::Join => Action::JoinSession,
            Access::Edit => Action::EditSession,
        };
        authority(principal, action, Object::Session(&session))
    })
}

/// Who may do an action.
enum Right {
    /// Whoever reaches the server; for sessions and trees this means who knows the name.
    Anybody,
}

impl Action {
    fn right(self) -> Right {
        match self {
            Self::BeginSession
            | Self::SeeSession
            | Self::JoinSession
            | Self::TakeTree
            | Self::EditSession
            | Self::SeeObstacle
            | Self::SeeSpecies
            | Self::DrawSchematic
            | Self::ListTrees
            | Self::SaveTree
            | Self::OpenTree
            | Self::SeeTree
            | Self::ChangeTree
            | Self::DeleteTree
            | Self::ChangeCollections => Right::Anybody,
        }
    }
}

/// The rights that hold on this server.
pub fn may(_principal: &Principal, action: Action, _object: Object<'_>) -> bool {
    match action.right() {
        Right::Anybody => true,
    }
}
