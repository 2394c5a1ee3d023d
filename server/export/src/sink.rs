//! Where the bytes of a file go.

use std::io::{self, Cursor, Seek, Write};

use crate::ExportError;

/// A file that is being written, on disk or in memory. Writers of formats put small pieces into it as they make them, so
/// it may be slow, stop for a while, or fail to end the export.
pub trait Sink: Write + Seek {}

impl<T: Write + Seek + ?Sized> Sink for T {}

/// A file in memory.
///
/// # Errors
/// Those of what writes it.
pub fn in_memory(
    write: impl FnOnce(&mut dyn Sink) -> Result<(), ExportError>,
) -> Result<Vec<u8>, ExportError> {
    let mut file = Cursor::new(Vec::new());
    write(&mut file)?;
    Ok(file.into_inner())
}

impl From<io::Error> for ExportError {
    fn from(error: io::Error) -> Self {
        Self::Write(error.kind())
    }
}

impl From<serde_json::Error> for ExportError {
    fn from(error: serde_json::Error) -> Self {
        // What is written here is always JSON, so it was the file that failed.
        Self::Write(error.io_error_kind().unwrap_or(io::ErrorKind::InvalidData))
    }
}
