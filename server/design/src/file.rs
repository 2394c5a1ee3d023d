//! Designs as JSON.

mod edits;
mod json;
mod reading;
mod values;
mod writing;

pub use self::reading::MOST_BYTES;

/// The version of the format that is written.
pub const VERSION: u32 = 1;
