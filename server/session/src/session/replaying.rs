//! Copies of a session in which its design is played from the beginning (`RP`).

use std::collections::{BTreeMap, BTreeSet};

use espalier_proto::{Author, ServerMessage};

use super::{Restoring, Session};
use crate::{
    author::Authors, document::Document, io::Named, presence::Register, principal::Principal,
    snapshot::RestoreError,
};

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
        let mut session = Restoring::of_document(name.into(), epoch, document).session();
        session.is_replay = true;
        // Whoever comes back after a copy was lost goes on counting their commands.
        session.authors = Authors::restored(&BTreeMap::new());
        session.room.register = people;
        session.number_authors();
        Ok(session)
    }

    /// Who did what stands on the lines of time, as journals know them.
    pub fn authors(&self) -> Vec<Principal> {
        let mut authors = BTreeSet::new();
        if let Some(work) = &self.home {
            work.document.timeline_of(|author| {
                authors.insert(author.clone());
                0
            });
            // They will stand there once the journal is done.
            authors.extend(work.orders.iter().map(|order| order.author.clone()));
        }
        authors.into_iter().collect()
    }

    /// What some of them were called before the session was opened, before anybody comes.
    pub fn remember(&mut self, named: impl IntoIterator<Item = Named>) {
        named.into_iter().for_each(|named| self.room.register.remember(named));
        self.number_authors();
    }

    /// The lines of time get the numbers that people have.
    fn number_authors(&mut self) {
        if let Some(work) = self.home.take() {
            self.timeline = self.line_of(&work.document);
            self.told_timeline = self.timeline.clone();
            self.home = Some(work);
        }
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
