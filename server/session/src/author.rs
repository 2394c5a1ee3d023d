//! Authors: clients that have sent commands, known by their keys across connections (`CM1`, `CM5`).

use std::{collections::BTreeMap, sync::Arc};

use crate::io::ClientId;

/// At most so many keys are remembered; the one unused longest is forgotten first.
pub(crate) const MAX_AUTHORS: usize = 4096;

/// What is remembered of a client key.
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
}

/// All authors by key.
#[derive(Debug, Default)]
pub(crate) struct Authors {
    by_key: BTreeMap<Arc<str>, Author>,
    /// Whether commands were taken before this session was loaded.
    restored: bool,
}

impl Authors {
    /// Those of a session loaded from disk: the highest durable id and its entry, by key.
    pub(crate) fn restored(durable: &BTreeMap<Arc<str>, LastCommand>) -> Self {
        let known = |last: &LastCommand| Author {
            taken: last.id,
            durable: last.id,
            forgot_refusals: true,
            last_entry: last.entry,
            ..Author::default()
        };
        Self {
            by_key: durable.iter().map(|(key, last)| (Arc::clone(key), known(last))).collect(),
            restored: true,
        }
    }

    /// The author with this key.
    pub(crate) fn get(&self, key: &str) -> Option<&Author> {
        self.by_key.get(key)
    }

    /// The author with this key.
    pub(crate) fn get_mut(&mut self, key: &str) -> Option<&mut Author> {
        self.by_key.get_mut(key)
    }

    /// The author with this key, new if need be.
    pub(crate) fn enter(&mut self, key: &Arc<str>) -> &mut Author {
        let forgot_refusals = self.restored;
        self.by_key.entry(Arc::clone(key)).or_insert_with(|| Author { forgot_refusals, ..Author::default() })
    }

    /// All of them.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = (&Arc<str>, &mut Author)> {
        self.by_key.iter_mut()
    }

    /// The connection with this key is closed. Forgets keys without commands, and beyond the limit those unused longest.
    pub(crate) fn leave(&mut self, key: &str) {
        let Some(author) = self.by_key.get_mut(key) else { return };
        author.client = None;
        if author.taken == 0 {
            self.by_key.remove(key);
        } else if self.by_key.len() > MAX_AUTHORS {
            let absent = self.by_key.iter().filter(|(_, author)| author.client.is_none());
            let quietest = absent.min_by_key(|(_, author)| author.last_entry).map(|(key, _)| Arc::clone(key));
            if let Some(key) = quietest {
                self.by_key.remove(&key);
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
pub(crate) fn note_last(last: &mut BTreeMap<Arc<str>, LastCommand>, key: &Arc<str>, command: LastCommand) {
    if command.id > 0 {
        last.insert(Arc::clone(key), command);
    }
    if last.len() > MAX_AUTHORS {
        let quietest = last.iter().min_by_key(|(_, command)| command.entry).map(|(key, _)| Arc::clone(key));
        if let Some(key) = quietest {
            last.remove(&key);
        }
    }
}
