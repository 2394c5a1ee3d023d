//! Where the command line writes what it makes: a file, whole or not at all, or standard output.

use std::{
    fs::File,
    io::{self, BufWriter, ErrorKind, IsTerminal, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

use espalier_export::{ExportError, Sink};

use crate::{formats::FormatRow, progress::Bar};

/// What stands for standard output.
pub const STDOUT: &str = "-";

/// A file to write, in a format.
#[derive(Clone, Debug)]
pub struct Target {
    /// Where; [`STDOUT`] for standard output.
    pub path: PathBuf,
    /// As what.
    pub row: &'static FormatRow,
}

/// A file cannot be written; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The disk or the reader does not take it.
    #[error("The export {} cannot be written: {cause}.", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// Nothing can be written into a folder that is not there.
    #[error("The export {} cannot be written: there is no folder {}.", path.display(), folder.display())]
    Folder {
        /// Which file.
        path: PathBuf,
        /// The folder that it would be in.
        folder: PathBuf,
    },
    /// The result does not fit its format.
    #[error("The export failed: {0}.")]
    Export(ExportError),
    /// A terminal would show bytes as signs, and obey some of them.
    #[error("A .{0} file is not for a terminal: pass it to a program, or to a file with > or by its name.")]
    Terminal(&'static str),
}

/// Prints bytes. A reader that has seen enough, as `head` may, is no error of ours.
///
/// # Errors
/// Where they cannot be written for another reason.
pub fn print(bytes: &[u8]) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    read_enough(stdout.write_all(bytes).and_then(|()| stdout.flush()))
}

/// What was written to a reader that had seen enough was written.
fn read_enough(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

impl Target {
    /// Whether it goes to standard output.
    pub fn is_stdout(&self) -> bool {
        self.path == Path::new(STDOUT)
    }

    /// Whether it can be written there, before anything is made.
    ///
    /// # Errors
    /// A format that is no text is not for a terminal, and a file needs a folder.
    pub fn check(&self) -> Result<(), OutputError> {
        if self.is_stdout() {
            let is_shown = io::stdout().is_terminal() && !self.row.is_text();
            return if is_shown { Err(OutputError::Terminal(self.row.ending)) } else { Ok(()) };
        }
        let folder = self.folder();
        if folder.is_dir() {
            return Ok(());
        }
        Err(OutputError::Folder { path: self.path.clone(), folder: folder.to_owned() })
    }

    fn folder(&self) -> &Path {
        self.path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
    }

    /// Makes the file in a place of its own, and moves or copies it when it is whole.
    ///
    /// # Errors
    /// Those of what makes it, and of the disk.
    pub fn write(
        &self,
        make: impl FnOnce(&mut dyn Sink) -> Result<(), ExportError>,
    ) -> Result<(), OutputError> {
        self.check()?;
        let failed = |cause| OutputError::Write { path: self.path.clone(), cause };
        if self.is_stdout() {
            let mut file = made(tempfile::tempfile().map_err(failed)?, make, failed)?;
            file.rewind().map_err(failed)?;
            let mut stdout = io::stdout().lock();
            let copied = io::copy(&mut file, &mut stdout).and_then(|_| stdout.flush());
            return read_enough(copied).map_err(failed);
        }
        let mut file = tempfile::Builder::new();
        #[cfg(unix)]
        file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        // What went wrong concerns the folder; the name of the file in it that is moved says nothing to anybody.
        let file = file.tempfile_in(self.folder()).map_err(|error| failed(error.kind().into()))?;
        let (opened, path) = file.into_parts();
        drop::<File>(made(opened, make, failed)?);
        path.persist(&self.path).map_err(|error| failed(error.error))
    }
}

/// The file when all is in it.
fn made(
    file: File,
    make: impl FnOnce(&mut dyn Sink) -> Result<(), ExportError>,
    failed: impl Fn(io::Error) -> OutputError,
) -> Result<File, OutputError> {
    let bar = Bar::counting("working out what is in the file");
    let mut out = BufWriter::with_capacity(PIECE, Counted { file, bar: &bar });
    match make(&mut out) {
        Err(ExportError::Write(kind)) => return Err(failed(kind.into())),
        made => made.map_err(OutputError::Export)?,
    }
    out.into_inner().map(|counted| counted.file).map_err(|error| failed(error.into_error()))
}

/// Bytes that are counted and written at once.
const PIECE: usize = 64 * 1024;

/// A file that tells how many bytes it has got.
#[derive(Debug)]
struct Counted<'a> {
    file: File,
    bar: &'a Bar,
}

impl Write for Counted<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.bar.stage("writing the file");
        self.bar.count(count);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Counted<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_counted_and_its_stage_told() {
        let bar = Bar::counting("working out what is in the file");
        let mut out = BufWriter::with_capacity(4, Counted { file: tempfile::tempfile().unwrap(), bar: &bar });
        assert_eq!(bar.told(), ("working out what is in the file".into(), 0));
        out.write_all(b"a tree").unwrap();
        out.seek(SeekFrom::Start(2)).unwrap();
        out.write_all(b"bush").unwrap();
        out.flush().unwrap();
        assert_eq!(bar.told(), ("writing the file".into(), 10));
        let mut file = out.into_inner().unwrap().file;
        file.rewind().unwrap();
        assert_eq!(io::read_to_string(file).unwrap(), "a bush");
    }

    #[test]
    fn a_reader_that_has_seen_enough_has_been_served() {
        assert!(read_enough(Err(ErrorKind::BrokenPipe.into())).is_ok());
        assert!(read_enough(Err(ErrorKind::StorageFull.into())).is_err());
    }
}
