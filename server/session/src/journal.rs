//! The journal as the session sees it: one batch on the way, the next one gathering (`CM2`).

use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
};

use crate::{io::JournalEntry, principal::Principal, shares::Shares};

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
    /// Entries that are not durable yet, in order.
    waiting: VecDeque<Waiting>,
    waiting_bytes: usize,
    /// How many of those are whose.
    shares: Shares,
}

/// An entry on its way.
#[derive(Debug)]
struct Waiting {
    author: Principal,
    id: u32,
    /// As whom it is counted.
    person: Arc<str>,
    /// The length of its text.
    bytes: usize,
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
            shares: Shares::default(),
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

    /// How many of those are somebody's.
    pub(crate) fn waiting_of(&self, person: &str) -> usize {
        self.shares.of(person)
    }

    /// Whether this command is on its way to the disk.
    pub(crate) fn is_waiting(&self, author: &Principal, id: u32) -> bool {
        self.waiting.iter().any(|waiting| waiting.author == *author && waiting.id == id)
    }

    /// Gives the next number to a command, which is counted as somebody's.
    pub(crate) fn append(&mut self, author: &Principal, person: Arc<str>, id: u32, command: String) -> u64 {
        self.last += 1;
        self.shares.add(&person);
        self.waiting_bytes += command.len();
        self.waiting.push_back(Waiting { author: author.clone(), id, person, bytes: command.len() });
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
            let Some(Waiting { author, id, person, bytes }) = self.waiting.pop_front() else { break };
            self.durable += 1;
            self.waiting_bytes -= bytes;
            self.shares.take(&person);
            if id > 0 {
                acknowledged.insert(author, id);
            }
        }
        acknowledged
    }
}
