//! The journal as the session sees it: one batch on the way, the next one gathering (`CM2`).

use std::collections::{BTreeMap, VecDeque};

use crate::{io::JournalEntry, principal::Principal};

/// Numbers entries and knows which are durable.
#[derive(Debug)]
pub(crate) struct Journal {
    /// The last number given out.
    last: u64,
    /// The last number handed to the shell.
    handed: u64,
    /// The last number known to be durable.
    durable: u64,
    gathering: Vec<JournalEntry>,
    /// Author and id of every entry that is not durable yet, in order, with the length of its text.
    waiting: VecDeque<(Principal, u32, usize)>,
    waiting_bytes: usize,
}

impl Journal {
    /// A journal whose entries up to `last` are on disk.
    pub(crate) fn new(last: u64) -> Self {
        Self {
            last,
            handed: last,
            durable: last,
            gathering: Vec::new(),
            waiting: VecDeque::new(),
            waiting_bytes: 0,
        }
    }

    /// The last number given out.
    pub(crate) fn last(&self) -> u64 {
        self.last
    }

    /// The last number known to be durable.
    pub(crate) fn durable(&self) -> u64 {
        self.durable
    }

    /// Entries that are not durable yet, and the bytes of their text.
    pub(crate) fn waiting(&self) -> (usize, usize) {
        (self.waiting.len(), self.waiting_bytes)
    }

    /// Whether this command is on its way to the disk.
    pub(crate) fn is_waiting(&self, author: &Principal, id: u32) -> bool {
        self.waiting.iter().any(|(of, waiting, _)| of == author && *waiting == id)
    }

    /// Gives the next number to a command.
    pub(crate) fn append(&mut self, author: &Principal, id: u32, command: String) -> u64 {
        self.last += 1;
        self.waiting.push_back((author.clone(), id, command.len()));
        self.waiting_bytes += command.len();
        self.gathering.push(JournalEntry { number: self.last, principal: author.clone(), id, command });
        self.last
    }

    /// The next batch to write, unless one is on the way or there is nothing to write.
    pub(crate) fn take_batch(&mut self) -> Option<Vec<JournalEntry>> {
        if self.handed > self.durable || self.gathering.is_empty() {
            return None;
        }
        self.handed = self.last;
        Some(std::mem::take(&mut self.gathering))
    }

    /// Entries up to `through` are durable; the highest id of each author that is so since.
    pub(crate) fn made_durable(&mut self, through: u64) -> BTreeMap<Principal, u32> {
        let mut acknowledged = BTreeMap::new();
        while self.durable < through.min(self.handed) {
            let Some((author, id, bytes)) = self.waiting.pop_front() else { break };
            self.durable += 1;
            self.waiting_bytes -= bytes;
            if id > 0 {
                acknowledged.insert(author, id);
            }
        }
        acknowledged
    }
}
