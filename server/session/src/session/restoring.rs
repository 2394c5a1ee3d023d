//! Loading a session: its last snapshot, and what the journal holds behind it.

use std::collections::{BTreeMap, VecDeque};

use espalier_proto::Pause;

use super::Session;
use crate::{
    author::{LastCommand, note_last},
    document::Document,
    entrant::counted_by_key,
    form::read_command,
    io::JournalEntry,
    principal::Principal,
    room::HasRoom,
    snapshot::{self, RestoreError, Snapshot},
    stops::Stops,
    work::{Order, Work},
};

/// What becomes of the entries that no snapshot contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tail {
    /// They are done slice by slice ([`Restoring::follow`]).
    Follows,
    /// They wait until somebody says that they are to be done (`OP5`).
    Waits,
}

/// A session that is being loaded, into which nobody can come yet.
#[derive(Debug)]
pub struct Restoring {
    pub(super) name: String,
    pub(super) epoch: u32,
    pub(super) work: Box<Work>,
    /// The last entry in the snapshot,
    pub(super) snapshotted: u64,
    /// and of all.
    pub(super) last: u64,
    /// The last command of each author.
    pub(super) taken_by: BTreeMap<Principal, LastCommand>,
}

impl Restoring {
    /// Reads a snapshot, if there is one, and the journal entries behind it.
    ///
    /// Without a snapshot the document starts from `seed`; without entries either, the session is new.
    /// `epoch` must differ from load to load (`RS2`). Entries the snapshot contains are skipped.
    /// The snapshot may be that of an earlier simulation: what stands in it stays as it is, and only the entries
    /// behind it are done by the present one.
    pub fn new(
        name: impl Into<String>,
        epoch: u32,
        snapshot: Option<&[u8]>,
        seed: u32,
        entries: impl IntoIterator<Item = JournalEntry>,
        tail: Tail,
    ) -> Result<Self, RestoreError> {
        let Snapshot { through, last_commands, document } = match snapshot {
            Some(bytes) => snapshot::from_bytes(bytes)?,
            None => Snapshot { through: 0, last_commands: BTreeMap::new(), document: Document::new(seed) },
        };
        let (orders, stops) = read(entries, through)?;
        let last = orders.back().map_or(through, |order| order.number);
        let mut taken_by = last_commands.clone();
        for Order { number, author, id, .. } in &orders {
            note_last(&mut taken_by, author, LastCommand { id: *id, entry: *number });
        }
        let hold = (tail == Tail::Waits && !orders.is_empty()).then_some(Pause::Crashes);
        let mut work = Box::new(Work::new(document, epoch, through, last_commands));
        work.take_over(orders, stops, hold);
        Ok(Self { name: name.into(), epoch, work, snapshotted: through, last, taken_by })
    }

    /// A document to which nothing was done yet.
    pub(super) fn of_document(name: String, epoch: u32, document: Document) -> Self {
        let work = Box::new(Work::new(document, epoch, 0, BTreeMap::new()));
        Self { name, epoch, work, snapshotted: 0, last: 0, taken_by: BTreeMap::new() }
    }

    /// Does a slice of what the journal holds; whether more is to follow before anybody comes.
    ///
    /// Nothing more follows when all is done, when there is no room for it (`LM19`), and when what comes next is long
    /// growth that nobody has stopped: that goes on in the session, where people look on and may stop it.
    pub fn follow(&mut self, is_over: impl Fn() -> bool, has_room: HasRoom<'_>) -> bool {
        if self.work.follows() {
            self.work.follow(is_over, has_room);
        }
        self.work.follows()
    }

    /// Entries that are still to follow.
    pub fn to_follow(&self) -> usize {
        self.work.orders.len()
    }

    /// The session, as far as it is loaded.
    pub fn session(self) -> Session {
        Session::restored(self)
    }
}

impl Session {
    /// Loads a session to the end of its journal, growth as well; see [`Restoring::new`].
    pub fn restore(
        name: impl Into<String>,
        epoch: u32,
        snapshot: Option<&[u8]>,
        seed: u32,
        entries: impl IntoIterator<Item = JournalEntry>,
    ) -> Result<Self, RestoreError> {
        let mut restoring = Restoring::new(name, epoch, snapshot, seed, entries, Tail::Follows)?;
        while restoring.work.is_needed() {
            restoring.work.follow(|| false, &mut |_, _| true);
        }
        Ok(restoring.session())
    }
}

/// Orders of the entries behind one, and the stops among them.
fn read(
    entries: impl IntoIterator<Item = JournalEntry>,
    through: u64,
) -> Result<(VecDeque<Order>, Stops), RestoreError> {
    let (mut orders, mut stops) = (VecDeque::new(), Stops::default());
    let mut last = through;
    for entry in entries.into_iter().skip_while(|entry| entry.number <= through) {
        let JournalEntry { number, principal, id, command: text } = entry;
        if number != last + 1 {
            return Err(RestoreError::Gap { expected: last + 1, found: number });
        }
        last = number;
        let command = read_command(&text).map_err(|problem| RestoreError::Entry { number, problem })?;
        stops.note(number, &command.action);
        let (person, bytes) = (counted_by_key(&principal), text.len());
        orders.push_back(Order { number, author: principal, person, id, command, bytes, act: None });
    }
    Ok((orders, stops))
}
