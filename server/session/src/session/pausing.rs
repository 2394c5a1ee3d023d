//! Growth that rests: for want of memory (`LM19`), or because the server did not outlive it (`OP5`).

use espalier_proto::Pause;

use super::Session;

/// Growth that found no room asks again after so many milliseconds.
const ROOM_MS: u64 = 1_000;

/// Whether growth rests, and until when.
#[derive(Debug)]
pub(super) struct Pausing {
    /// Why it rests, as clients are told.
    pub(super) why: Option<Pause>,
    /// When it asks for room again.
    pub(super) due: Option<u64>,
    /// Somebody has said that it is to go on.
    goes_on: bool,
}

impl Pausing {
    /// It begins so.
    pub(super) fn new(why: Option<Pause>) -> Self {
        Self { why, due: (why == Some(Pause::Memory)).then_some(0), goes_on: false }
    }
}

impl Session {
    /// Why growth rests, if it does.
    pub fn paused(&self) -> Option<Pause> {
        self.pausing.why
    }

    /// What the document takes of memory, in rows; nothing while it is away on the simulation pool.
    pub fn held_rows(&self) -> Option<u64> {
        self.home.as_ref().map(|work| work.held_rows())
    }

    /// Whether nothing is left to do, of what the journal holds as well.
    pub fn is_settled(&self) -> bool {
        self.home.as_ref().is_some_and(|work| work.hold.is_none() && !work.is_needed())
    }

    /// Whether all is done that the journal held when the session was opened.
    pub fn has_caught_up(&self) -> bool {
        self.done >= self.opened_through
    }

    /// What the server did not outlive is to be tried again.
    pub(super) fn go_on(&mut self) {
        self.pausing.goes_on |= self.pausing.why == Some(Pause::Crashes);
    }

    /// The document came home: it rests, or does not any more.
    pub(super) fn came_home(&mut self, hold: Option<Pause>) {
        if hold == Some(Pause::Memory) {
            // Slices that show the tree to somebody meanwhile do not put it off.
            self.pausing.due.get_or_insert(self.now + ROOM_MS);
        }
        self.pausing.why = hold;
    }

    /// Lets growth try again, where it is time, or where it was stopped and takes a few steps more.
    pub(super) fn look_for_room(&mut self) {
        let Some(work) = &mut self.home else { return };
        match work.hold {
            None => self.pausing.due = None,
            Some(Pause::Memory) => {
                let queued = self.queue.orders.iter();
                queued.for_each(|order| work.stops.note_once(order.number, &order.command.action));
                let is_stopped = work.stops.end_of(work.applied).is_some();
                if is_stopped || self.pausing.due.is_some_and(|due| due <= self.now) {
                    (work.hold, self.pausing.due) = (None, None);
                }
            }
            Some(Pause::Crashes) => {
                if std::mem::take(&mut self.pausing.goes_on) {
                    (work.hold, self.pausing.why) = (None, None);
                    self.upkeep.state_changed = true;
                }
            }
        }
    }
}
