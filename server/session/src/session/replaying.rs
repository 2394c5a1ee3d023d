//! Copies of a session in which its design is played from the beginning (`RP`).

use std::collections::{BTreeMap, BTreeSet};

use espalier_proto::{Author, ServerMessage};

use super::{Session, restoring::Restored};
use crate::{author::Authors, document::Document, presence::Register, snapshot::RestoreError};

impl Session {
    /// A copy of the session of which these are the document, as a [`Input::Read`](crate::Input::Read) gave it, and the
    /// people. It stands at the step where that stands.
    pub fn replay(
        name: impl Into<String>,
        epoch: u32,
        document: &[u8],
        people: Register,
    ) -> Result<Self, RestoreError> {
        let mut document = Document::from_bytes(document)?;
        document.end_gestures();
        let mut session = Self::with_document(name.into(), epoch, Restored::new(document));
        session.is_replay = true;
        // Whoever comes back after a copy was lost goes on counting their commands.
        session.authors = Authors::restored(&BTreeMap::new());
        session.room.register = people;
        if let Some(work) = session.home.take() {
            session.timeline = session.line_of(&work.document);
            session.told_timeline = session.timeline.clone();
            session.home = Some(work);
        }
        Ok(session)
    }

    /// Everybody who has been here, and what they are called.
    pub fn register(&self) -> &Register {
        &self.room.register
    }

    /// Who did what stands on the line.
    pub(super) fn authors_message(&self) -> ServerMessage {
        let numbers: BTreeSet<u32> =
            self.told_timeline.operations.iter().map(|operation| operation.author).collect();
        let name = |person| self.room.register.called(person).map(str::to_owned);
        ServerMessage::Authors {
            authors: numbers.into_iter().map(|person| Author { person, name: name(person) }).collect(),
        }
    }
}
