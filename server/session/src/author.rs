//! Authors: principals that have sent commands, known across connections (`CM1`, `CM5`).

use std::{collections::BTreeMap, sync::Arc};

use crate::{io::ClientId, principal::Principal};

/// At most so many are remembered; the one unused longest is forgotten first.
pub(crate) const MAX_AUTHORS: usize = 4096;

/// What is remembered of an author.
#[derive(Debug, Default)]
pub(crate) struct Author {
    /// Its connection, while it has one.
    pub(crate) client: Option<ClientId>,
    /// The highest command id taken, done or refused.
    pub(crate) taken: u32,
    /// The highest command id that is durable.
    pub(crate) durable: u32,
    /// Whether `taken` may be too low. Ids of refused commands are in no journal, so after a restart the
    /// next command may skip some.
    pub(crate) forgot_refusals: bool,
    /// The journal entry of its last command.
    pub(crate) last_entry: u64,
    /// When its open strokes end, if it does not return before.
    pub(crate) strokes_end_at: Option<u64>,
    /// As whom what it does is counted ([`Entrant::counted_as`](crate::Entrant)), if it has come.
    pub(crate) counted_as: Option<Arc<str>>,
}

/// All authors.
#[derive(Debug, Default)]
pub(crate) struct Authors {
    known: BTreeMap<Principal, Author>,
    /// Whether commands were taken before this session was loaded.
    restored: bool,
}

impl Authors {
    /// Those of a session loaded from disk: the highest durable id of each and its entry.
    pub(crate) fn restored(durable: &BTreeMap<Principal, LastCommand>) -> Self {
        let known = |last: &LastCommand| Author {
            taken: last.id,
            durable: last.id,
            forgot_refusals: true,
            last_entry: last.entry,
            ..Author::default()
        };
        Self {
            known: durable.iter().map(|(author, last)| (author.clone(), known(last))).collect(),
            restored: true,
        }
    }

    /// What is known of this principal.
    pub(crate) fn get(&self, principal: &Principal) -> Option<&Author> {
        self.known.get(principal)
    }

    /// What is known of this principal.
    pub(crate) fn get_mut(&mut self, principal: &Principal) -> Option<&mut Author> {
        self.known.get_mut(principal)
    }

    /// This principal as an author, new if need be.
    pub(crate) fn enter(&mut self, principal: &Principal) -> &mut Author {
        let forgot_refusals = self.restored;
        self.known.entry(principal.clone()).or_insert_with(|| Author { forgot_refusals, ..Author::default() })
    }

    /// All of them.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = (&Principal, &mut Author)> {
        self.known.iter_mut()
    }

    /// The connection of this author is closed. Forgets who gave no command, and beyond the limit those unused longest.
    pub(crate) fn leave(&mut self, principal: &Principal) {
        let Some(author) = self.known.get_mut(principal) else { return };
        author.client = None;
        if author.taken == 0 {
            self.known.remove(principal);
        } else if self.known.len() > MAX_AUTHORS {
            let absent = self.known.iter().filter(|(_, author)| author.client.is_none());
            let quietest =
                absent.min_by_key(|(_, author)| author.last_entry).map(|(author, _)| author.clone());
            if let Some(quietest) = quietest {
                self.known.remove(&quietest);
            }
        }
    }
}

/// An author's last command in the journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LastCommand {
    /// The author's number for it.
    pub(crate) id: u32,
    /// The journal's.
    pub(crate) entry: u64,
}

/// Notes a command as its author's last; the map is bounded like [`Authors`].
pub(crate) fn note_last(
    last: &mut BTreeMap<Principal, LastCommand>,
    author: &Principal,
    command: LastCommand,
) {
    if command.id > 0 {
        last.insert(author.clone(), command);
    }
    if last.len() > MAX_AUTHORS {
        let quietest = last.iter().min_by_key(|(_, command)| command.entry).map(|(author, _)| author.clone());
        if let Some(quietest) = quietest {
            last.remove(&quietest);
        }
    }
}
