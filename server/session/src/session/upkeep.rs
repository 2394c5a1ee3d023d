//! What happens by the clock: late hellos, strokes and bends left open, snapshots, news for everybody.

use std::collections::{BTreeSet, VecDeque};

use espalier_proto::{Action, DocumentState, Pause, ServerMessage, version::CloseCode};

use super::{Session, text_of};
use crate::{
    clients::Lacks,
    document::Figures,
    io::{ClientId, Output},
    principal::Principal,
};

/// How long the strokes of a client that went away stay open, in milliseconds (`CM5`).
const ABSENCE_MS: u64 = 30_000;
/// Figures go out no more often than this, in milliseconds.
const STATE_MS: u64 = 50;
/// Of figures no more than this are sent in all.
const STATES_PER_MS: u64 = 4;
/// Lines of time go out no faster than this, and no more often than figures.
const TIMELINE_BYTES_PER_MS: u64 = 256;
/// After so many commands a snapshot is made.
const SNAPSHOT_COMMANDS: u64 = 512;
/// A snapshot costs in proportion to the plants; with so many metamers more, wait for one command more.
const SNAPSHOT_METAMERS: u64 = 50;
/// After a pause of so many milliseconds a snapshot is made.
const SNAPSHOT_PAUSE_MS: u64 = 30_000;

/// A snapshot that could not be kept is made anew after so many milliseconds.
const SNAPSHOT_RETRY_MS: u64 = 5_000;

/// Deadlines and what they are about.
#[derive(Debug)]
pub(super) struct Upkeep {
    started: bool,
    /// When hellos are due; all have the same patience, so this is in order.
    pub(super) hellos: VecDeque<(u64, ClientId)>,
    /// When strokes of absent authors end, in order.
    absences: VecDeque<(u64, Principal)>,
    /// Authors whose strokes end as soon as the document is at home.
    pub(super) overdue: BTreeSet<Principal>,
    /// Whether figures differ from what was sent to clients.
    pub(super) state_changed: bool,
    /// What was sent to clients last.
    pub(super) sent: DocumentState,
    state_due: u64,
    /// Whether lines of time differ from what was sent to clients.
    pub(super) timeline_changed: bool,
    timeline_due: u64,
    /// Whether width constraints do.
    pub(super) widths_changed: bool,
    widths_due: u64,
    /// Whether the design does.
    pub(super) design_changed: bool,
    /// Whether colours of branches do, which are told with it.
    pub(super) dyes_changed: bool,
    design_due: u64,
    /// Whether the grammar does.
    pub(super) grammar_changed: bool,
    grammar_due: u64,
    pub(super) last_command_at: u64,
    /// The last entry in a snapshot that is kept.
    snapshotted: u64,
    /// Whether a snapshot is being made, waits for the journal, or is on its way to the disk.
    snapshot_asked: bool,
    /// When the next one is made after one that could not be kept.
    retry_at: Option<u64>,
    /// When the document contains this entry a snapshot is made, without waiting for a pause.
    keep_through: Option<u64>,
    /// A snapshot whose entries are not all durable yet, with the last of them.
    snapshot: Option<(u64, Vec<u8>)>,
    wake_at: Option<u64>,
}

impl Upkeep {
    pub(super) fn new(snapshotted: u64) -> Self {
        Self {
            started: false,
            hellos: VecDeque::new(),
            absences: VecDeque::new(),
            overdue: BTreeSet::new(),
            state_changed: false,
            sent: DocumentState::default(),
            state_due: 0,
            timeline_changed: false,
            timeline_due: 0,
            widths_changed: false,
            widths_due: 0,
            design_changed: false,
            dyes_changed: false,
            design_due: 0,
            grammar_changed: false,
            grammar_due: 0,
            last_command_at: 0,
            snapshotted,
            snapshot_asked: false,
            retry_at: None,
            keep_through: None,
            snapshot: None,
            wake_at: None,
        }
    }

    /// Whether the time that was asked for last has come.
    pub(super) fn is_due(&self, now: u64) -> bool {
        self.wake_at.is_some_and(|at| at <= now)
    }

    /// The time asked for has come; the next one must be asked for anew.
    pub(super) fn woken(&mut self) {
        self.wake_at = None;
    }

    /// When a snapshot is made of what is in none, if nothing else asks for it.
    fn next_snapshot(&self) -> u64 {
        self.retry_at.unwrap_or(self.last_command_at + SNAPSHOT_PAUSE_MS)
    }

    /// A snapshot is wanted as soon as the document contains this entry.
    pub(super) fn keep_through(&mut self, entry: u64) {
        self.keep_through = Some(entry);
    }

    /// The document came home with a snapshot.
    pub(super) fn snapshot_made(&mut self, through: u64, bytes: Vec<u8>) {
        self.snapshot = Some((through, bytes));
    }

    /// The snapshot that was handed out is kept.
    pub(super) fn snapshot_kept(&mut self, through: u64) {
        self.snapshot_asked = false;
        self.retry_at = None;
        self.snapshotted = self.snapshotted.max(through);
    }

    /// The snapshot that was handed out could not be kept: another one is made after a while. Until then the journal alone
    /// holds the entries that it was to cover.
    pub(super) fn snapshot_failed(&mut self, now: u64) {
        self.snapshot_asked = false;
        self.retry_at = Some(now + SNAPSHOT_RETRY_MS);
    }

    /// Whether a snapshot holds everything up to `last`.
    pub(super) fn holds(&self, last: u64) -> bool {
        self.snapshotted == last
    }

    /// Whether nothing waits for the clock.
    pub(super) fn is_done(&self) -> bool {
        self.absences.is_empty() && self.overdue.is_empty()
    }
}

impl Session {
    /// Time begins with the first input: after a restart the absent have their whole patience again.
    pub(super) fn start_clocks(&mut self) {
        if self.upkeep.started {
            return;
        }
        self.upkeep.started = true;
        self.upkeep.last_command_at = self.now;
        let until = self.now + ABSENCE_MS;
        let Some(work) = &self.home else { return };
        for (principal, author) in self.authors.iter_mut() {
            // What the journal holds that is not done yet may begin something as well.
            let acts = work.orders.iter().any(|order| order.author == *principal);
            if acts
                || !work.document.open_strokes(principal).is_empty()
                || !work.document.open_bends(principal).is_empty()
            {
                author.strokes_end_at = Some(until);
                self.upkeep.absences.push_back((until, principal.clone()));
            }
        }
    }

    /// An author's connection is gone.
    pub(super) fn author_left(&mut self, principal: &Principal, client: ClientId) {
        let until = self.now + ABSENCE_MS;
        let Some(author) = self.authors.get_mut(principal).filter(|author| author.client == Some(client))
        else {
            return;
        };
        if author.taken > 0 {
            author.strokes_end_at = Some(until);
            self.upkeep.absences.push_back((until, principal.clone()));
        }
        self.authors.leave(principal);
    }

    /// The session is to be put away: what would take long ends, and what was done is kept.
    pub(super) fn stop(&mut self) {
        if self.paused() == Some(Pause::Crashes) {
            // What waits goes on waiting.
            return;
        }
        for connected in self.clients.values_mut().filter_map(|client| client.connected.as_mut()) {
            connected.prediction_view.cancel();
            connected.prediction_view.wanted = None;
        }
        if self.state().pending_steps > 0 {
            let action = self.stop_now();
            if let Ok(text) = serde_json::to_string(&action) {
                self.accept(&Principal::visitor(), 0, action.into(), text, None);
            }
        }
        self.upkeep.keep_through(self.journal.last());
    }

    /// Does all that is due now.
    pub(super) fn keep_up(&mut self) {
        while let Some(client) = pop_due(&mut self.upkeep.hellos, self.now) {
            if self.clients.get(&client).is_some_and(|client| client.connected.is_none()) {
                self.close(client, CloseCode::HelloExpected, "no hello came for 10 seconds");
            }
        }
        while let Some(principal) = pop_due(&mut self.upkeep.absences, self.now) {
            let due = self.authors.get(&principal).and_then(|author| author.strokes_end_at);
            if due.is_some_and(|due| due <= self.now) {
                self.upkeep.overdue.insert(principal);
            }
        }
        self.let_go_of_overdue();
        self.hand_out_snapshot();
        if self.upkeep.state_changed && self.now >= self.upkeep.state_due {
            self.upkeep.state_changed = false;
            self.upkeep.state_due = self.now + STATE_MS.max(self.clients.len() as u64 / STATES_PER_MS);
            self.upkeep.sent = self.state();
            self.clients.values_mut().for_each(|client| client.lacks.state = client.connected.is_some());
        }
        self.tell_state();
        if self.upkeep.widths_changed && self.now >= self.upkeep.widths_due {
            self.upkeep.widths_changed = false;
            self.upkeep.widths_due = self.now + STATE_MS;
            self.broadcast(&ServerMessage::Widths { widths: self.widths.clone() });
        }
        if self.upkeep.design_changed && self.now >= self.upkeep.design_due {
            self.upkeep.design_changed = false;
            self.upkeep.design_due = self.now + STATE_MS;
            let dyes = std::mem::take(&mut self.upkeep.dyes_changed);
            for client in self.clients.values_mut().filter(|client| client.connected.is_some()) {
                client.lacks.design = true;
                client.lacks.dyes |= dyes;
            }
        }
        self.tell_designs();
        if !self.upkeep.design_changed {
            self.tell_branches();
            self.tell_limbs();
        }
        if self.upkeep.grammar_changed && self.now >= self.upkeep.grammar_due {
            self.upkeep.grammar_changed = false;
            self.upkeep.grammar_due = self.now + STATE_MS;
            self.broadcast(&self.grammar_message());
        }
        if self.upkeep.timeline_changed && self.now >= self.upkeep.timeline_due {
            self.upkeep.timeline_changed = false;
            let change = self.told_timeline.change_to(&self.timeline);
            self.told_timeline.clone_from(&self.timeline);
            let text = text_of(&ServerMessage::TimelineChanged(Box::new(change)));
            self.upkeep.timeline_due = self.now + STATE_MS.max(text.len() as u64 / TIMELINE_BYTES_PER_MS);
            self.broadcast_text(&text);
        }
        self.tell_who_is_done();
        self.keep_room();
    }

    /// Sends figures to those who lack them and can read them.
    fn tell_state(&mut self) {
        let told: Vec<ClientId> =
            self.clients.iter().filter(|(_, client)| client.wants_state()).map(|(&id, _)| id).collect();
        if told.is_empty() {
            return;
        }
        let text = text_of(&ServerMessage::State { state: self.upkeep.sent.clone() });
        for id in told {
            if let Some(client) = self.clients.get_mut(&id) {
                client.lacks.state = false;
            }
            self.send_text(id, &text);
        }
    }

    /// Sends the design in force and the colours of branches to those who lack them and can read them.
    fn tell_designs(&mut self) {
        let wants = self.clients.iter().filter(|(_, client)| client.wants_designs());
        let told: Vec<(ClientId, Lacks)> = wants.map(|(&id, client)| (id, client.lacks)).collect();
        if told.is_empty() {
            return;
        }
        let (design, dyes) = (text_of(&self.design_message()), text_of(&self.dyes_message()));
        for (id, lacks) in told {
            if let Some(client) = self.clients.get_mut(&id) {
                client.lacks = Lacks { state: lacks.state, ..Lacks::default() };
            }
            for (is_lacked, text) in [(lacks.design, &design), (lacks.dyes, &dyes)] {
                if is_lacked {
                    self.send_text(id, text);
                }
            }
        }
    }

    /// Tells those of whose commands nothing is left to do, once they have been told what came of them (`CM11`).
    fn tell_who_is_done(&mut self) {
        let upkeep = &self.upkeep;
        let settings_changed = upkeep.widths_changed || upkeep.design_changed || upkeep.grammar_changed;
        if upkeep.state_changed || settings_changed || upkeep.timeline_changed {
            return;
        }
        let done = self.done.min(self.journal.durable());
        let mut notified = Vec::new();
        for (&client, state) in &mut self.clients {
            let Lacks { state: lacks_state, design, dyes } = state.lacks;
            let is_told = !(lacks_state || design || dyes);
            let Some(connected) = state.connected.as_mut().filter(|_| is_told) else { continue };
            let Some(author) = self.authors.get(&connected.principal) else { continue };
            if author.taken > connected.done && author.last_entry <= done {
                connected.done = author.taken;
                notified.push((client, author.taken));
            }
        }
        for (client, id) in notified {
            let Figures { step, metamers, .. } = self.figures;
            self.send(client, &ServerMessage::Done { id, step, metamers });
        }
    }

    /// Ends the strokes and bends of those who stayed away, once it is known which are open.
    fn let_go_of_overdue(&mut self) {
        let Some(work) = &self.home else { return };
        let orders = || work.orders.iter().chain(&self.queue.orders);
        let mut ends = Vec::new();
        self.upkeep.overdue.retain(|principal| {
            if orders().any(|order| order.author == *principal) {
                return true;
            }
            let strokes = work.document.open_strokes(principal).into_iter();
            let strokes = strokes.map(|stroke| Action::StrokeEnd { stroke });
            let bends = work.document.open_bends(principal).into_iter();
            let bends = bends.map(|bend| Action::BendEnd { bend });
            ends.extend(strokes.chain(bends).map(|action| (principal.clone(), action)));
            false
        });
        for (principal, action) in ends {
            let Ok(text) = serde_json::to_string(&action) else { continue };
            self.accept(&principal, 0, action.into(), text, None);
        }
    }

    /// Whether the document, which contains entries up to `applied`, should be written down when it is next whole.
    pub(super) fn snapshot_due(&mut self, applied: u64) -> bool {
        let since = applied - self.upkeep.snapshotted;
        let many = SNAPSHOT_COMMANDS.max(u64::from(self.figures.metamers) / SNAPSHOT_METAMERS);
        let asked = self.upkeep.snapshot_asked;
        let there = self.upkeep.keep_through.is_some_and(|entry| applied >= entry);
        let many = self.upkeep.retry_at.is_none() && since >= many;
        let due = !asked && (many || since > 0 && (there || self.now >= self.upkeep.next_snapshot()));
        self.upkeep.snapshot_asked |= due;
        self.upkeep.keep_through.take_if(|_| there && !asked);
        due
    }

    /// A snapshot must not be ahead of the journal: it waits until all its entries are durable.
    fn hand_out_snapshot(&mut self) {
        let durable = self.journal.durable();
        if let Some((through, bytes)) = self.upkeep.snapshot.take_if(|(through, _)| *through <= durable) {
            self.outputs.push_back(Output::Snapshot { through, bytes });
        }
    }

    /// Asks for the earliest deadline, if it differs from what was asked for.
    pub(super) fn ask_to_be_woken(&mut self) {
        let upkeep = &self.upkeep;
        let state = upkeep.state_changed.then_some(upkeep.state_due);
        let timeline = upkeep.timeline_changed.then_some(upkeep.timeline_due);
        let widths = upkeep.widths_changed.then_some(upkeep.widths_due);
        let design = upkeep.design_changed.then_some(upkeep.design_due);
        let grammar = upkeep.grammar_changed.then_some(upkeep.grammar_due);
        // What waits in the journal cannot be kept yet.
        let applied = self.home.as_ref().map_or(0, |work| work.applied);
        let unkept = applied > upkeep.snapshotted && !upkeep.snapshot_asked;
        let pause = unkept.then(|| upkeep.next_snapshot());
        let hello = upkeep.hellos.front().map(|(due, _)| *due);
        let absence = upkeep.absences.front().map(|(due, _)| *due);
        let memory = self.pausing.due.filter(|_| self.home.is_some());
        let (room, checksum) = (self.room_due(), self.checksum_due());
        let whole = self.home.as_ref().filter(|work| work.is_behind).map(|_| self.whole_due);
        let earliest =
            [state, timeline, widths, design, grammar, pause, hello, absence, memory, room, checksum, whole]
                .into_iter()
                .flatten()
                .min();
        if earliest != upkeep.wake_at {
            self.upkeep.wake_at = earliest;
            self.outputs.extend(earliest.map(Output::WakeAt));
        }
    }
}

fn pop_due<T>(deadlines: &mut VecDeque<(u64, T)>, now: u64) -> Option<T> {
    let due = deadlines.front().is_some_and(|(due, _)| *due <= now);
    if due { deadlines.pop_front().map(|(_, what)| what) } else { None }
}
