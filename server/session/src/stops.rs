//! Where growth ends that somebody wants to end (`ST1`).
//!
//! Growth under way when `stop` comes has run some steps, and nobody knows how many until it is back from the
//! simulation pool. So the session writes into the journal, with the command itself, a count of steps that
//! cannot have been reached yet, and growth that was begun before ends there: at once as people see it, and at
//! the very same step when the journal is replayed.

use std::collections::VecDeque;

use espalier_proto::Action;

/// Stops that concern entries not done yet, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stops {
    /// The entry of each, and the count of steps begun at which growth of earlier entries ends.
    ends: VecDeque<(u64, u32)>,
}

impl Stops {
    /// The same where it may have been noted already.
    pub(crate) fn note_once(&mut self, entry: u64, action: &Action) {
        if self.ends.back().is_none_or(|(last, _)| *last < entry) {
            self.note(entry, action);
        }
    }

    /// Notes an action if it is a stop.
    pub(crate) fn note(&mut self, entry: u64, action: &Action) {
        if let &Action::Stop { tick: Some(tick) } = action {
            self.ends.push_back((entry, tick));
        }
    }

    /// Where growth of an entry ends: at the least of what later entries say.
    pub(crate) fn end_of(&self, entry: u64) -> Option<u32> {
        self.ends.iter().filter(|(stop, _)| *stop > entry).map(|(_, end)| *end).min()
    }

    /// Entries up to this one have been begun; stops among them concern nothing any more.
    pub(crate) fn forget_through(&mut self, entry: u64) {
        while self.ends.front().is_some_and(|(stop, _)| *stop <= entry) {
            self.ends.pop_front();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn st1_a_stop_ends_what_came_before_it() {
        let mut stops = Stops::default();
        stops.note(3, &Action::Stop { tick: Some(10) });
        stops.note(4, &Action::Undo {});
        stops.note(5, &Action::Stop { tick: Some(12) });
        assert_eq!(
            [1, 2, 3, 4, 5].map(|entry| stops.end_of(entry)),
            [Some(10), Some(10), Some(12), Some(12), None]
        );
        stops.forget_through(4);
        assert_eq!(stops.end_of(4), Some(12));
        assert_eq!(stops.end_of(5), None);
    }
}
