//! Why something was refused: the names by which programs know it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::problem::ProblemCode;

/// Declares the reasons, those of each code together, with a sentence that `PROTOCOL.md` has as well.
macro_rules! reasons {
    ($($code:ident { $(#[doc = $sentence:literal] $reason:ident,)+ })+) => {
        /// Why something was refused. Clients find their own words by it, in the language of whoever reads.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum Reason {
            $($(#[doc = $sentence] $reason,)+)+
        }

        impl Reason {
            /// All of them in their order, each with its sentence.
            pub const ALL: &'static [(Self, &'static str)] = &[$($((Self::$reason, Self::$reason.sentence()),)+)+];

            /// What it says in general, as `PROTOCOL.md` does.
            pub const fn sentence(self) -> &'static str {
                match self { $($(Self::$reason => $sentence.trim_ascii(),)+)+ }
            }

            /// The code of a problem with this reason.
            pub const fn code(self) -> ProblemCode {
                match self { $($(Self::$reason)|+ => ProblemCode::$code,)+ }
            }

            /// Its name as programs know it.
            pub fn name(self) -> String {
                // A name without contents always has a JSON form, which is a text.
                serde_json::to_value(self).ok().and_then(|name| Some(name.as_str()?.to_owned())).unwrap_or_default()
            }
        }
    };
}

reasons! {
    Malformed {
        /// The message is no JSON, or a field of it is missing, unknown or of another type.
        Malformed,
        /// The address does not take this method.
        WrongMethod,
        /// A file did not arrive whole.
        FileCutOff,
        /// No tree can be made of a file; `cause` says why. The code is that of the cause.
        NotATreeFile,
        /// A file is neither glTF nor OBJ; `cause` says what it is.
        NotModel,
        /// A file is not glTF.
        NotGltf,
        /// A file is glTF of another version, `cause`.
        GltfVersion,
        /// The buffers of a glTF file lie in other files.
        GltfBuffers,
        /// A glTF file needs `cause`, which is not read.
        GltfNeeds,
        /// A glTF file contradicts itself.
        GltfDamaged,
        /// A line of an OBJ file is none; `cause` says why.
        ObjDamaged,
        /// A text is no grammar; `cause` says where and why.
        NotAGrammar,
        /// The body of a request is packed in a way that is not read, `cause`.
        PackedRequest,
        /// A thumbnail is not a picture.
        ThumbnailKind,
    }
    OutOfRange {
        /// A value is outside its range.
        OutOfRange,
        /// A list has too few entries.
        TooFew,
        /// A place is not on the ground.
        OffGround,
        /// A place is inside an obstacle.
        InObstacle,
        /// A shape has no surface that something could stand behind.
        NoSurface,
        /// No triangle of a mesh has an area.
        EmptyMesh,
        /// A mesh has more triangles or vertices than a mesh may have, or a file more triangles than are read.
        LargeMesh,
        /// A name or note is too short or too long.
        TextLength,
        /// A name or note has characters that mislead, or none that one can see.
        TextUnseen,
        /// A list of trees is asked for with too many words.
        ManyWords,
        /// There are too many tags.
        ManyTags,
        /// A tag has a comma.
        TagComma,
        /// A file format does not have this option.
        NoSuchOption,
    }
    TooMany {
        /// A list has too many entries.
        TooMany,
        /// Something is tried or done too often.
        TooOften,
        /// Too many commands wait to be done, in the session or of one person (LM23).
        Behind,
        /// A file has too many bytes.
        LargeFile,
        /// The body of a request has too many bytes.
        LargeRequest,
        /// A thumbnail has too many bytes.
        LargeThumbnail,
    }
    Refused {
        /// One may not do this.
        Forbidden,
        /// Whoever asks was not let in: they were not invited and have not logged in.
        NotLetIn,
        /// A name and a password do not belong together, or nobody goes by the name.
        WrongPassword,
        /// A page of another site asks.
        OtherSite,
        /// The server is not known by the name that its address was given.
        UnknownHost,
        /// The number of a command, stroke or bend is taken, or not the next one.
        NumberTaken,
        /// There is nothing to undo.
        NothingToUndo,
        /// Nothing that this person did can be taken back.
        NothingOfYours,
        /// There is nothing to redo.
        NothingToRedo,
        /// The plant is a seed.
        NothingToUngrow,
        /// No lateral branch stands in so little light.
        NoDimBranch,
        /// The foot of a trunk cannot be turned.
        TrunkTurned,
        /// The foot of a trunk cannot be moved.
        TrunkMoved,
        /// Nothing branches off below, so the trunk cannot be cut.
        TrunkCut,
        /// Somebody is bending the branch.
        BeingBent,
        /// A branch cannot be set on itself.
        OwnBranch,
        /// Later steps stand on the wood of the design, so it cannot change.
        DesignSealed,
        /// The design refuses this; the message says why.
        DesignRefused,
        /// Somebody has stopped the fitting of a design.
        FitStopped,
        /// Somebody is drawing.
        BeingDrawn,
        /// The branch would leave the world.
        OutsideWorld,
        /// Nothing can grow into this outline.
        NoRoom,
        /// The document holds as many metamers as it may.
        TreeFull,
        /// The tree stopped growing before it had as many metamers as were asked for.
        StoppedGrowing,
        /// As many strokes as may be are in progress.
        StrokesFull,
        /// As many bends as may be are in progress.
        BendsFull,
        /// As many width constraints as may be are in force.
        WidthsFull,
        /// The history keeps as many places of moved wood as it may.
        HistoryFull,
        /// As many obstacles as may be are in the scene.
        ObstaclesFull,
        /// The meshes of the scene and its history would have too many triangles.
        TrianglesFull,
        /// The shape of a mesh stays as it is.
        MeshKeepsShape,
        /// A grammar cannot be derived any further; `cause` says why.
        GrammarEnds,
        /// There is no programme that parameters could follow.
        NoProgramme,
        /// A future is damaged.
        FutureDamaged,
        /// The owner of a tree has locked it.
        TreeLocked,
        /// An owner has removed somebody for some hours; `cause` is who did it.
        Removed,
        /// An owner has removed somebody and revoked the link by which they came; `cause` is who did it.
        RemovedGuest,
        /// A comment is too old to be changed.
        CommentStays,
        /// A tree that is not deleted can neither be taken back nor deleted for good.
        NotDeleted,
        /// A collection cannot lie in itself.
        CollectionInItself,
        /// Somebody or something goes by this name already.
        NameTaken,
        /// Nobody else is an administrator.
        LastAdmin,
        /// Another request had this key.
        KeyOfAnother,
        /// The request with this key is under way.
        KeyUnderWay,
        /// The request with this key was done, and its answer is not kept.
        AnswerNotKept,
        /// The server stopped while the request with this key was under way.
        OutcomeUnknown,
        /// Nothing waits to go on.
        NothingWaits,
        /// A newer program wrote this.
        NewerProgram,
        /// What is stored of a session is damaged.
        SessionDamaged,
        /// The server did not outlive opening a session, twice; an owner lets it be tried again.
        SessionWaits,
        /// What is stored of a saved tree is damaged.
        TreeDamaged,
    }
    NotFound {
        /// There is no living metamer with this row.
        BranchGone,
        /// No grammar is in force.
        NoGrammar,
        /// No such stroke is in progress.
        StrokeGone,
        /// No such bend is in progress.
        BendGone,
        /// There is no such future.
        FutureGone,
        /// There is no such obstacle.
        ObstacleGone,
        /// There is no design in force.
        DesignGone,
        /// The design has no such branch, or it sleeps.
        DesignBranchGone,
        /// There is no such template of designs.
        NoTemplate,
        /// There is no such tree in the library.
        NoTree,
        /// There is no such collection in the library.
        NoCollection,
        /// There is no such session.
        NoSession,
        /// There is no such invitation, or not any more.
        NoInvitation,
        /// There is no such address, or nothing there.
        NoneSuch,
    }
    Stale {
        /// Somebody else has changed the tree meanwhile.
        Stale,
    }
    Unavailable {
        /// The database file was moved, deleted or replaced.
        DatabaseGone,
        /// The database cannot be used now.
        DatabaseFailed,
        /// The server is stopping.
        Stopping,
        /// The session cannot be opened now.
        NotOpened,
        /// The session has just ended.
        SessionEnded,
        /// As many people as may be are here.
        ManyPeople,
        /// The server failed to compute this.
        Failed,
        /// The server is busy growing.
        Busy,
        /// The server has no memory left for this now.
        MemoryFull,
        /// The request took too long.
        Late,
        /// The obstacle was not placed.
        NotPlaced,
        /// The tree cannot be exported.
        NotExported,
        /// As many jobs wait as may.
        JobsFull,
        /// The files of jobs find no room on the disk.
        JobsDiskFull,
        /// The picture cannot be drawn.
        NotDrawn,
    }
}
