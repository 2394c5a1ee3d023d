//! What travels between the server and its clients.
//!
//! Control is JSON text ([`control`], [`command`], [`library`]); growth arrives as binary mesh deltas ([`frame`]).
//! The rules both sides keep, each with its ID, stand in `PROTOCOL.md` beside this crate.
//! Types here are raw: a number is whatever JSON held. Ranges are checked where a value becomes
//! part of a document, and what failed comes back as a [`problem::Problem`].

pub mod appearance;
pub mod command;
pub mod control;
pub mod envelope;
pub mod frame;
pub mod ghost;
pub mod library;
pub mod obstacle;
pub mod parameters;
pub mod pose;
pub mod problem;
pub mod schematic;
pub mod species;
pub mod timeline;
pub mod typescript;
pub mod varint;
pub mod version;

pub use appearance::{Appearance, AppearancePatch};
pub use command::{Command, DrawingPlane, StrokeSample};
pub use control::{ClientMessage, DocumentState, Resume, ServerMessage};
pub use envelope::FrameKind;
pub use frame::{ChunkChange, Column, Frame, FrameError, Rows, Values};
pub use ghost::GhostFrame;
pub use obstacle::{Obstacle, PlacedObstacle, PlacedShape, Pose, Shape};
pub use parameters::{Parameters, ParametersPatch, VigorModel};
pub use pose::{PoseFrame, RowMotion};
pub use problem::{Problem, ProblemCode};
pub use schematic::Schematic;
pub use timeline::{OperationKind, Timeline, TimelineFuture, TimelineOperation, WidthConstraint};

/// A field that is there holds a value; `null` is none.
fn present<'de, T, D>(deserializer: D) -> Result<Option<T>, D::Error>
where
    T: serde::Deserialize<'de>,
    D: serde::Deserializer<'de>,
{
    T::deserialize(deserializer).map(Some)
}
