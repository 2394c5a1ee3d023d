//! What can be asked for, and the least role that may have it.

use crate::access::Role::{self, Admin, Commenter, Editor, Owner, Viewer};

/// Who of those that are in for one tree alone may ask for something of the server as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// They may, for it tells nothing of other trees.
    Guests,
    /// They may not.
    Library,
}

/// Declares the actions, each with its row.
macro_rules! table {
    ($($(#[doc = $sentence:literal])+ $action:ident: $least:ident, $reach:ident;)+) => {
        /// What is asked for, at an address or for something that a request names.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Action {
            $($(#[doc = $sentence])+ $action,)+
        }

        impl Action {
            /// All of them, each with its name.
            pub const ALL: &'static [(Self, &'static str)] = &[$((Self::$action, stringify!($action)),)+];

            /// The least role that may do it.
            pub const fn least(self) -> Role {
                match self { $(Self::$action => $least,)+ }
            }

            /// Whether guests may do it to the server as a whole.
            pub const fn reach(self) -> Reach {
                match self { $(Self::$action => Reach::$reach,)+ }
            }
        }
    };
}

table! {
    /// Reads what is the same on every server: species, formats, this description; draws schematics.
    Look: Viewer, Guests;
    /// Comes into the session of a tree, or begins one. Which tree it may be is asked by itself ([`Action::OpenTree`]).
    EnterSession: Viewer, Guests;
    /// Grows trees from seeds into files, as a job.
    GrowTrees: Editor, Library;
    /// Lists jobs of one's own, takes what they made, and gives them up.
    OwnJobs: Viewer, Library;
    /// Begins a session that belongs to no tree.
    BeginSession: Editor, Library;
    /// Lists sessions, of which everybody but owners sees those that they have begun or been in.
    ListSessions: Viewer, Guests;
    /// Takes a session off one's list.
    ForgetSession: Viewer, Library;
    /// Asks for a session by its name.
    SeeSession: Viewer, Library;
    /// Joins a session.
    JoinSession: Viewer, Library;
    /// Does a command in a session, uploads included.
    EditSession: Editor, Library;
    /// Lets go on what the server did not outlive.
    ResumeSession: Owner, Library;
    /// Takes the tree of a session, as a file or into the library.
    TakeTree: Viewer, Library;
    /// Takes the mesh of an obstacle.
    SeeObstacle: Viewer, Library;
    /// Lists trees, of which guests see theirs.
    ListTrees: Viewer, Guests;
    /// Lists tags and people.
    SeeLibrary: Viewer, Library;
    /// Adds a tree to the library.
    SaveTree: Editor, Library;
    /// Takes what was saved of a tree: begins a session with it, copies it, or takes its document.
    OpenTree: Viewer, Library;
    /// Sees a tree with its versions and their pictures.
    SeeTree: Viewer, Library;
    /// Changes what is said of a tree, or saves a version of it.
    ChangeTree: Editor, Library;
    /// Reads what people say of a tree.
    ReadComments: Viewer, Library;
    /// Says something of a tree, and what is said of it is done.
    Comment: Commenter, Library;
    /// Deletes a tree, or takes that back.
    DeleteTree: Owner, Library;
    /// Says who comes to a tree and who owns it: makes and revokes links, removes people, locks it, hands it over.
    ShareTree: Owner, Library;
    /// Lists collections, of which whoever has no role on the server sees those that they were given.
    ListCollections: Viewer, Guests;
    /// Says to whom a collection is given.
    ShareCollection: Owner, Library;
    /// Makes, changes and deletes collections.
    ChangeCollections: Editor, Library;
    /// Sees figures of the server that name no tree and nobody.
    SeeFigures: Viewer, Library;
    /// Sees which sessions are in memory, and what they take.
    SeeServer: Owner, Library;
    /// Changes one's own password.
    OwnPassword: Viewer, Guests;
    /// Lists tokens of one's own, and revokes them.
    OwnTokens: Viewer, Guests;
    /// Makes a token that acts as oneself.
    MakeToken: Viewer, Library;
    /// Sees who can come in, and what was done.
    SeePeople: Admin, Library;
    /// Says who can come in, and what they may do: users, groups and their members.
    ChangePeople: Admin, Library;
}
