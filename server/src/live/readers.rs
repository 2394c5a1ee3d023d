//! Requests that wait for a document, and how long they wait for one whose growth found no memory (`LM19`).

use std::{collections::BTreeMap, time::Duration};

use espalier_proto::Pause;
use espalier_session::{ReadDocument, ReadId};
use tokio::{sync::oneshot, time::Instant};

use super::handle::Ended;
use crate::memory::Full;

/// Why a document was not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unread {
    /// The session has ended meanwhile.
    Ended,
    /// Its growth found no memory, and before that is done it cannot be read.
    Memory(Full),
}

impl From<Ended> for Unread {
    fn from(Ended: Ended) -> Self {
        Self::Ended
    }
}

/// Whoever waits is answered here.
pub(super) type Answer = oneshot::Sender<Result<ReadDocument, Unread>>;

/// Requests that wait for a document.
#[derive(Debug)]
pub(super) struct Readers {
    waiting: BTreeMap<u64, Reader>,
    next: u64,
    /// Since when growth rests for want of memory.
    resting: Option<Instant>,
    /// How long they then wait.
    patience: Duration,
}

#[derive(Debug)]
struct Reader {
    asked: Instant,
    answer: Answer,
}

impl Readers {
    /// None yet. Where growth rests each waits so long.
    pub(super) fn new(patience: Duration) -> Self {
        Self { waiting: BTreeMap::new(), next: 1, resting: None, patience }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Somebody asks; the number by which they are answered.
    pub(super) fn ask(&mut self, now: Instant, answer: Answer) -> ReadId {
        let read = self.next;
        self.next += 1;
        self.waiting.insert(read, Reader { asked: now, answer });
        ReadId(read)
    }

    /// Here is the document, unless they were told to come back.
    pub(super) fn answer(&mut self, read: ReadId, document: ReadDocument) {
        if let Some(Reader { answer, .. }) = self.waiting.remove(&read.0) {
            let _ = answer.send(Ok(document));
        }
    }

    /// Growth rests now, or does not.
    pub(super) fn note(&mut self, now: Instant, paused: Option<Pause>) {
        let since = self.resting.unwrap_or(now);
        self.resting = (paused == Some(Pause::Memory)).then_some(since);
    }

    /// When the first of them has waited long enough.
    pub(super) fn due(&self) -> Option<Instant> {
        let (resting, first) = (self.resting?, self.waiting.values().next()?);
        Some(first.asked.max(resting) + self.patience)
    }

    /// Tells those to come back who have waited long enough.
    pub(super) fn turn_away(&mut self, now: Instant) {
        while self.due().is_some_and(|due| due <= now)
            && let Some((_, reader)) = self.waiting.pop_first()
        {
            reader.refuse();
        }
    }

    /// Tells all of them to come back: the session leaves with what rests.
    pub(super) fn turn_all_away(&mut self) {
        std::mem::take(&mut self.waiting).into_values().for_each(Reader::refuse);
    }
}

impl Reader {
    fn refuse(self) {
        let _ = self.answer.send(Err(Unread::Memory(Full)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATIENCE: Duration = Duration::from_secs(2);

    fn refused(answered: &mut oneshot::Receiver<Result<ReadDocument, Unread>>) -> bool {
        matches!(answered.try_recv(), Ok(Err(Unread::Memory(Full))))
    }

    #[test]
    fn lm19_who_waits_for_growth_that_rests_is_told_to_come_back_in_turn() {
        let mut readers = Readers::new(PATIENCE);
        let start = Instant::now();
        let after = |seconds| start + Duration::from_secs(seconds);
        let (first, mut first_answer) = oneshot::channel();
        let (second, mut second_answer) = oneshot::channel();
        readers.ask(start, first);
        readers.note(after(10), None);
        assert_eq!(readers.due(), None, "growth that goes on is waited for");
        readers.note(after(20), Some(Pause::Memory));
        readers.ask(after(21), second);
        readers.note(after(21), Some(Pause::Memory));
        assert_eq!(readers.due(), Some(after(22)), "it rests since then");
        readers.turn_away(after(21));
        assert!(!refused(&mut first_answer));
        readers.turn_away(after(22));
        assert!(refused(&mut first_answer) && !refused(&mut second_answer));
        assert_eq!(readers.due(), Some(after(23)), "each has its own patience");
        readers.note(after(23), None);
        readers.turn_away(after(30));
        assert!(!readers.is_empty(), "it grows again");
        readers.turn_all_away();
        assert!(refused(&mut second_answer) && readers.is_empty());
    }
}
