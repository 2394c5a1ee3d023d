//! A session as bytes: the document with one section more, that says who did how much and where the journal goes on.

mod format_1;

use std::collections::BTreeMap;

use espalier_proto::Problem;

use crate::{
    author::LastCommand,
    document::{Container, Document, DocumentError, Reader, SESSION, Writer},
    principal::Principal,
};

/// Why a session cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum RestoreError {
    /// The bytes are no snapshot, or are damaged.
    #[error("the snapshot is damaged")]
    Damaged,
    /// The document inside cannot be read: it is damaged, or a later program wrote it.
    #[error("the snapshot cannot be read: {0}")]
    Document(#[from] DocumentError),
    /// A journal entry is missing.
    #[error("the journal goes on with entry {found}, but entry {expected} is missing")]
    Gap {
        /// The entry that should follow.
        expected: u64,
        /// The one that does.
        found: u64,
    },
    /// A journal entry holds no command.
    #[error("journal entry {number} cannot be read: {problem}")]
    Entry {
        /// Which one.
        number: u64,
        /// Why.
        problem: Problem,
    },
}

/// What a snapshot holds.
#[derive(Debug)]
pub(crate) struct Snapshot {
    /// The last journal entry in it.
    pub(crate) through: u64,
    /// The last command of each author up to there.
    pub(crate) last_commands: BTreeMap<Principal, LastCommand>,
    pub(crate) document: Document,
}

/// Writes a snapshot.
pub(crate) fn to_bytes(
    through: u64,
    last_commands: &BTreeMap<Principal, LastCommand>,
    document: &Document,
) -> Vec<u8> {
    let mut session = Writer::default();
    session.u64(through);
    session.u32(last_commands.len() as u32);
    for (author, last) in last_commands {
        session.text(author.name());
        session.u32(last.id);
        session.u64(last.entry);
    }
    document.to_snapshot_bytes(session)
}

/// Reads a snapshot; any bytes at all give one or an error.
pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Snapshot, RestoreError> {
    if let Some(snapshot) = format_1::from_bytes(bytes)? {
        return Ok(snapshot);
    }
    let container = Container::read_any(bytes).map_err(|error| match error {
        DocumentError::NotADocument => RestoreError::Damaged,
        error => error.into(),
    })?;
    let session = container.read(&SESSION, read_session)?;
    let (through, last_commands) = session.ok_or(RestoreError::Damaged)?;
    let document = Document::from_container(&container)?;
    Ok(Snapshot { through, last_commands, document })
}

/// What the section of a session holds: the last entry, and the last command of each author.
type Progress = (u64, BTreeMap<Principal, LastCommand>);

fn read_session(reader: &mut Reader<'_>) -> Result<Progress, DocumentError> {
    reader.up_to(1)?;
    let through = reader.u64()?;
    let last_commands = reader.list(|r| {
        let author = Principal::named(r.text()?);
        Ok((author, LastCommand { id: r.u32()?, entry: r.u64()? }))
    })?;
    Ok((through, last_commands.into_iter().collect()))
}
