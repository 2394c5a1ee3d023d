//! What travels between the server and its clients.
//!
//! Control is JSON text ([`control`], [`command`], [`library`]); growth arrives as binary mesh deltas ([`frame`]).
//! The rules both sides keep, each with its ID, stand in `PROTOCOL.md` beside this crate.
//! Types here are raw: a number is whatever JSON held. Ranges are checked where a value becomes
//! part of a document, and what failed comes back as a [`problem::Problem`]. The settings of a tree are those of the
//! tables in `espalier-settings`.

pub mod command;
pub mod control;
pub mod envelope;
pub mod frame;
pub mod ghost;
pub mod library;
pub mod obstacle;
pub mod pose;
pub mod problem;
pub mod protocol_tables;
pub mod schematic;
pub mod species;
pub mod timeline;
pub mod typescript;
pub mod varint;
pub mod version;

pub use command::{Command, DrawingPlane, StrokeSample};
pub use control::{ClientMessage, DocumentState, Notice, Resume, ServerMessage};
pub use envelope::FrameKind;
pub use frame::{ChunkChange, Column, Frame, FrameError, Rows, Values};
pub use ghost::GhostFrame;
pub use obstacle::{Obstacle, PlacedObstacle, PlacedShape, Pose, Shape};
pub use pose::{PoseFrame, RowMotion};
pub use problem::{Problem, ProblemCode};
pub use schematic::Schematic;
pub use timeline::{OperationKind, Timeline, TimelineFuture, TimelineOperation, WidthConstraint};
