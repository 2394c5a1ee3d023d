//! Figures of the server for programs that look after it.

mod text;

pub use text::{Figures, Kind};
