//! What travels between the server and its clients.
//!
//! Control is JSON text ([`control`], [`command`], [`library`]); growth arrives as binary mesh deltas ([`frame`]).
//! The rules both sides keep, each with its ID, stand in `PROTOCOL.md` beside this crate.
//! What a client sends is read into types that are in good form ([`reading`]): a number in its range, a rotation of
//! length 1. What cannot be read comes back as a [`problem::Problem`] with the field and what is allowed there. The
//! settings of a tree are those of the tables in `espalier-settings`.

pub mod access;
pub mod bend;
pub mod bounded;
pub mod command;
pub mod comment;
pub mod control;
pub mod design;
pub mod envelope;
pub mod frame;
pub mod ghost;
pub mod grammar;
pub mod http_problem;
pub mod library;
pub mod mesh;
pub mod obstacle;
pub mod packing;
pub mod permission;
pub mod place;
pub mod presence;
pub mod presence_frame;
pub mod problem;
pub mod programme;
pub mod protocol_tables;
pub mod ranges;
pub mod reading;
pub mod reason;
pub mod schema;
pub mod schematic;
pub mod species;
pub mod status;
pub mod text;
pub mod thumbnail;
pub mod timeline;
pub mod typescript;
pub mod varint;
pub mod version;

pub use bend::{BendFrame, RowMotion};
pub use bounded::{
    Age, BrushRadius, Depth, Diameter, EyeDistance, LimbLength, LimbOrders, LinkHours, List, Pitch,
    PredictedSteps, Scale, Share, SphereRadius, Steps, Touches, Yaw,
};
pub use command::{Action, Command, StrokeSample};
pub use control::{
    ClientMessage, Deed, DocumentState, Hint, HintReason, Notice, Pause, Resume, ServerMessage, Unreadable,
};
pub use design::{
    BranchPath, DesignEdit, DesignInForce, DesignSetting, DesignValue, DyeColours, DyedBlock, LimbOutline,
    MAX_DESIGN_BYTES, PlacedBranch, PutDesign,
};
pub use envelope::FrameKind;
pub use espalier_reading::NotAllowed;
pub use frame::{ChunkChange, Column, Frame, FrameError, Rows, Values};
pub use ghost::GhostFrame;
pub use grammar::{
    CheckGrammar, GrammarBody, GrammarDiagnostic, GrammarEnd, GrammarInForce, GrammarOrigins, GrammarReport,
    GrammarRule, GrammarSeverity, GrammarSize, GrammarSlider, GrammarValue, MAX_GRAMMAR_VALUES,
    ShippedGrammar,
};
pub use http_problem::{HttpProblem, PROBLEM_JSON};
pub use mesh::{Mesh, MeshError};
pub use obstacle::{
    MeshSize, Obstacle, PlacedObstacle, PlacedShape, Pose, Shape, SimpleShape, UploadedObstacle,
};
pub use place::{BoxSize, Direction, DrawingPlane, Offset, PlanePoint, Position, UnitRotation};
pub use presence::{Author, Camera, Device, Person, Pointer, Whereabouts};
pub use presence_frame::{DeviceNews, PointerNews, PointerPlace, PresenceFrame};
pub use problem::{Problem, ProblemCode};
pub use programme::{ParameterName, Programme, Slug, Stage};
pub use reason::Reason;
pub use schematic::Schematic;
pub use timeline::{
    ChangedOperation, OperationKind, Timeline, TimelineChange, TimelineFuture, TimelineOperation,
    TimelinePart, WidthConstraint,
};
