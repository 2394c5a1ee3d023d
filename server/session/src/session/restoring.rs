//! Loading a session: its last snapshot, and what the journal holds behind it.

use std::collections::{BTreeMap, VecDeque};

use espalier_proto::Pause;

use super::Session;
use crate::{
    author::{LastCommand, note_last},
    document::Document,
    form::read_command,
    io::JournalEntry,
    principal::Principal,
    room::{self, HasRoom},
    snapshot::{self, RestoreError, Snapshot},
    stops::Stops,
    work::{Order, Rest, Urgency},
};

/// The share of a snapshot in the time that it takes to load a session, where entries follow: nobody knows before how
/// long those take.
const SNAPSHOT_SHARE: f32 = 0.5;

/// What becomes of the entries that no snapshot contains.
pub enum Tail<'a> {
    /// They are done at once, as far as there is room; the rest is done when there is.
    Done(HasRoom<'a>),
    /// They wait until somebody says that they are to be done (`OP5`).
    Waits,
}

/// A document that was restored, and how far.
#[derive(Debug)]
pub(super) struct Restored {
    pub(super) document: Document,
    /// The last entry in the snapshot,
    pub(super) snapshotted: u64,
    /// that the document has taken on,
    pub(super) applied: u64,
    /// and of all.
    pub(super) last: u64,
    /// The last command of each author that the document has taken on,
    pub(super) done_by: BTreeMap<Principal, LastCommand>,
    /// and of all.
    pub(super) taken_by: BTreeMap<Principal, LastCommand>,
    pub(super) rest: Rest,
    /// Triangles of its obstacles.
    triangles: u64,
}

impl Restored {
    /// A document to which nothing was done yet.
    pub(super) fn new(document: Document) -> Self {
        Self {
            triangles: document.held_triangles() as u64,
            document,
            snapshotted: 0,
            applied: 0,
            last: 0,
            done_by: BTreeMap::new(),
            taken_by: BTreeMap::new(),
            rest: Rest::default(),
        }
    }

    /// Does an order, as far as there is room; whether it is done.
    fn does(&mut self, order: &Order, has_room: HasRoom<'_>) -> bool {
        let Order { number, author, id, command, .. } = order;
        let held = self.document.held_rows(self.triangles);
        let taken_on = room::after_taking_on(&command.action, held);
        if taken_on > held && !has_room(taken_on, Urgency::Keeping) {
            self.rest.hold = Some(Pause::Memory);
            return false;
        }
        self.rest.stops.forget_through(*number);
        let end = self.rest.stops.end_of(*number);
        self.document.stop_at(end);
        self.applied = *number;
        note_last(&mut self.done_by, author, LastCommand { id: *id, entry: *number });
        // Under the same simulation, what the document refuses now it refused the first time as well; under a later one
        // a row may be gone, and the notice of a replayed tail says so (OP2).
        let begun = self.document.begin(author, command);
        if room::changes_triangles(&command.action) {
            self.triangles = self.document.held_triangles() as u64;
        }
        if begun.is_err() {
            return true;
        }
        loop {
            let grows = self.document.pending_steps() > 0 && end.is_none();
            if grows && !has_room(room::after_step(self.document.held_rows(self.triangles)), Urgency::Keeping)
            {
                self.rest.hold = Some(Pause::Memory);
                self.rest.doing = Some((author.clone(), *id, command.action.clone()));
                return true;
            }
            if !self.document.advance() {
                return true;
            }
        }
    }
}

impl Session {
    /// Loads a session: its last snapshot, if there is one, and the journal entries behind it.
    ///
    /// Without a snapshot the document starts from `seed`; without entries either, the session is new.
    /// `epoch` must differ from load to load (`RS2`). Entries the snapshot contains are skipped.
    /// The snapshot may be that of an earlier simulation: what stands in it stays as it is, and only the entries
    /// behind it are done by the present one.
    pub fn restore(
        name: impl Into<String>,
        epoch: u32,
        snapshot: Option<&[u8]>,
        seed: u32,
        entries: impl IntoIterator<Item = JournalEntry>,
    ) -> Result<Self, RestoreError> {
        let mut always = |_, _| true;
        Self::restore_with(name, epoch, snapshot, seed, entries, Tail::Done(&mut always), &mut |_| {})
    }

    /// The same where the entries may have to wait, telling now and then which share is done, from 0 to 1.
    pub fn restore_with(
        name: impl Into<String>,
        epoch: u32,
        snapshot: Option<&[u8]>,
        seed: u32,
        entries: impl IntoIterator<Item = JournalEntry>,
        mut tail: Tail<'_>,
        tell: &mut dyn FnMut(f32),
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
        let hold = (matches!(tail, Tail::Waits) && !orders.is_empty()).then_some(Pause::Crashes);
        let mut restored = Restored {
            triangles: document.held_triangles() as u64,
            document,
            snapshotted: through,
            applied: through,
            last,
            done_by: last_commands,
            taken_by,
            rest: Rest { orders, stops, hold, doing: None },
        };
        let all = restored.rest.orders.len() as f32;
        let begun = match snapshot {
            _ if restored.rest.orders.is_empty() => 1.0,
            Some(_) => SNAPSHOT_SHARE,
            None => 0.0,
        };
        if let Tail::Done(has_room) = &mut tail {
            tell(begun);
            while restored.rest.hold.is_none()
                && let Some(order) = restored.rest.orders.pop_front()
            {
                if !restored.does(&order, *has_room) {
                    restored.rest.orders.push_front(order);
                }
                tell(1.0 - (1.0 - begun) * restored.rest.orders.len() as f32 / all);
            }
        }
        Ok(Self::with_document(name.into(), epoch, restored))
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
        orders.push_back(Order { number, author: principal, id, command, bytes: text.len(), act: None });
    }
    Ok((orders, stops))
}
