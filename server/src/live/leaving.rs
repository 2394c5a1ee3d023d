//! When a session leaves the memory: a decision, without a clock or a channel.

use espalier_proto::Pause;

/// Why a session leaves the memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Idle,
    /// With growth that rests, and goes on when somebody comes.
    Resting,
    Stopping,
    Failed,
}

/// How a session stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// Nobody is connected.
    pub(super) is_empty: bool,
    /// Nothing of it is at work, or on its way to the disk.
    pub(super) is_still: bool,
    /// Requests wait for an answer.
    pub(super) owes_answers: bool,
    /// Nothing is left to do.
    pub(super) is_settled: bool,
    /// The same, and a snapshot holds everything that was done.
    pub(super) is_kept: bool,
    /// Why growth rests, if it does.
    pub(super) paused: Option<Pause>,
}

impl Standing {
    /// Why it leaves once nobody has been here for a while.
    pub(super) fn end_in_time(self) -> Option<End> {
        self.end_if(self.is_kept)
    }

    /// Why it leaves at once where memory is short. It makes the snapshot that is missing as it leaves.
    pub(super) fn end_where_memory_is_short(self) -> Option<End> {
        self.end_if(self.is_settled)
    }

    fn end_if(self, is_done: bool) -> Option<End> {
        match self.paused {
            _ if !self.is_empty || !self.is_still => None,
            // The journal holds what rests, for whoever comes. Who waits for it is told to come back, or two such
            // sessions would wait for each other's memory.
            Some(_) => Some(End::Resting),
            None => (is_done && !self.owes_answers).then_some(End::Idle),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nobody is here, and all is done and kept.
    const LEFT: Standing = Standing {
        is_empty: true,
        is_still: true,
        owes_answers: false,
        is_settled: true,
        is_kept: true,
        paused: None,
    };
    /// Nobody is here, and growth found no memory.
    const RESTS: Standing =
        Standing { is_settled: false, is_kept: false, paused: Some(Pause::Memory), ..LEFT };

    fn ends(standing: Standing) -> [Option<End>; 2] {
        [standing.end_in_time(), standing.end_where_memory_is_short()]
    }

    #[test]
    fn lm19_a_session_in_which_nobody_is_makes_room() {
        assert_eq!(ends(LEFT), [Some(End::Idle); 2]);
        let unkept = Standing { is_kept: false, ..LEFT };
        assert_eq!(ends(unkept), [None, Some(End::Idle)], "the snapshot is made as it leaves");
        let grows = Standing { is_settled: false, ..unkept };
        assert_eq!(ends(grows), [None; 2], "what grows is not thrown away");
        let asked = Standing { owes_answers: true, ..LEFT };
        assert_eq!(ends(asked), [None; 2]);
    }

    #[test]
    fn lm19_a_session_that_rests_makes_room_though_a_request_waits_for_it() {
        for paused in [Pause::Memory, Pause::Crashes] {
            for owes_answers in [false, true] {
                let standing = Standing { owes_answers, paused: Some(paused), ..RESTS };
                assert_eq!(ends(standing), [Some(End::Resting); 2], "{standing:?}");
            }
        }
    }

    #[test]
    fn lm19_a_session_stays_where_somebody_is_or_while_it_is_at_work() {
        for standing in [LEFT, RESTS] {
            assert_eq!(ends(Standing { is_empty: false, ..standing }), [None; 2]);
            assert_eq!(ends(Standing { is_still: false, ..standing }), [None; 2]);
        }
    }
}
