//! What travels between the server and its clients.
//!
//! Control is JSON text ([`control`], [`command`], [`library`]); growth arrives as binary mesh deltas ([`frame`]).
//! The rules both sides keep, each with its ID, stand in `PROTOCOL.md` beside this crate.
//! Types here are raw: a number is whatever JSON held. Ranges are checked where a value becomes
//! part of a document, and what failed comes back as a [`problem::Problem`].

pub mod command;
pub mod control;
pub mod frame;
pub mod library;
pub mod parameters;
pub mod problem;
pub mod typescript;
pub mod varint;
pub mod version;

pub use command::{Command, StrokeSample};
pub use control::{ClientMessage, DocumentState, Resume, ServerMessage};
pub use frame::{ChunkChange, Column, Frame, FrameError, Rows, Values};
pub use parameters::{Parameters, ParametersPatch};
pub use problem::{Problem, ProblemCode};
