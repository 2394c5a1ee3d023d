//! The document on its way through the simulation pool, in slices.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
};

use espalier_mesh::{Detail, RingTable, Style};
use espalier_proto::{
    BendFrame, Command, Deed, Hint, Pause, PlacedObstacle, Position, Problem, RowMotion, ServerMessage,
};

use crate::{
    author::{LastCommand, note_last},
    checksum::{self, Checksum},
    document::{Document, DrawnInVain, Switched},
    io::{ActId, ClientId, ReadDocument, ReadId},
    prediction::{PredictionRun, Question},
    principal::Principal,
    room::{self, HasRoom},
    snapshot,
    stops::Stops,
    to_proto::{self, Held},
    urgency::{LONG_ROWS, Urgency, grows_alone, is_in_one_piece},
};

/// After so many steps a slice ends, so that long growth is seen while it goes on; stopping counts on it (`ST1`).
pub(crate) const SLICE_STEPS: u32 = 4;
/// After so many new metamers a slice ends.
const SLICE_METAMERS: u32 = 2000;
/// After so many commands a slice ends.
const SLICE_COMMANDS: u32 = 64;

/// While somebody draws or something grows, older wood is shown anew no more often than this, in milliseconds (`FL5`).
const LOOKS_MS: u64 = 500;
/// Whoever has drawn draws on as long as no more time than this goes by, in milliseconds.
pub(crate) const PAUSE_MS: u64 = 3000;

/// Growth that has so much left, in metamers times steps, is long: it takes some tenths of a second at least.
const LONG_GROWTH: u64 = 1_000_000;

/// A command in its place in the order.
#[derive(Debug)]
pub(crate) struct Order {
    /// Its journal entry.
    pub(crate) number: u64,
    /// For whom it is done.
    pub(crate) author: Principal,
    /// As whom that is counted where people take turns.
    pub(crate) person: Arc<str>,
    /// The author's number; 0 where the session acts for it.
    pub(crate) id: u32,
    /// What to do, and the gesture it is part of.
    pub(crate) command: Command,
    /// The length of its journal text, for bounds.
    pub(crate) bytes: usize,
    /// Who waits for its outcome, if it came from outside.
    pub(crate) act: Option<ActId>,
}

/// A client that needs a frame of its own.
#[derive(Debug)]
pub(crate) struct CatchUp {
    pub(crate) client: ClientId,
    pub(crate) held: Held,
}

/// What is said of a command to the client that sent it, and to nobody else.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) author: Principal,
    pub(crate) message: ServerMessage,
}

/// A bend as it is sent to clients.
#[derive(Clone, Debug)]
pub(crate) struct BendUpdate {
    pub(crate) bend: u32,
    pub(crate) sequence: u32,
    pub(crate) is_over: bool,
    pub(crate) frame: Arc<[u8]>,
}

/// What a slice brought about.
#[derive(Debug, Default)]
pub(crate) struct Report {
    /// For everybody in step.
    pub(crate) delta: Option<Arc<[u8]>>,
    pub(crate) catch_ups: Vec<(ClientId, Arc<[u8]>)>,
    pub(crate) answers: Vec<Answer>,
    /// New frames of open bends; without a frame's motions a bend is over.
    pub(crate) bends: Vec<BendUpdate>,
    /// Predictions to be made.
    pub(crate) runs: Vec<PredictionRun>,
    /// What became of commands from outside: the obstacle they placed.
    pub(crate) acts: Vec<(ActId, Result<Option<PlacedObstacle>, Problem>)>,
    /// The document for each read.
    pub(crate) documents: Vec<(ReadId, ReadDocument)>,
    /// A snapshot and the last entry it contains.
    pub(crate) snapshot: Option<(u64, Vec<u8>)>,
    /// What the rows add up to.
    pub(crate) checksum: Option<Checksum>,
}

/// The document and everything to be done to it. Owns all it needs: call [`Work::run`] on any thread.
#[derive(Debug)]
pub struct Work {
    pub(crate) document: Document,
    pub(crate) table: RingTable,
    style: Style,
    pub(crate) epoch: u32,
    /// The newest frame.
    pub(crate) sequence: u32,
    /// The last journal entry the document has taken on.
    pub(crate) applied: u64,
    /// The last command of each author up to there.
    pub(crate) last_commands: BTreeMap<Principal, LastCommand>,
    pub(crate) orders: VecDeque<Order>,
    /// Where growth that was begun before certain entries ends (`ST1`).
    pub(crate) stops: Stops,
    pub(crate) catch_ups: Vec<CatchUp>,
    pub(crate) reads: Vec<ReadId>,
    pub(crate) questions: Vec<Question>,
    pub(crate) snapshot_wanted: bool,
    pub(crate) checksum_wanted: bool,
    /// The session's time, in milliseconds.
    pub(crate) now: u64,
    /// When older wood is shown anew while it changes all the time.
    looks_due: u64,
    /// Until when somebody is taken to draw on.
    draws_until: u64,
    /// Whether the table may be behind the document in what older wood looks like,
    pub(crate) is_behind: bool,
    /// and is to make up for that.
    pub(crate) whole_wanted: bool,
    /// Whether anybody is in step and needs the delta.
    pub(crate) delta_wanted: bool,
    /// Whether a command is still being done.
    pub(crate) busy: bool,
    /// Why commands rest.
    pub(crate) hold: Option<Pause>,
    /// Triangles of its obstacles.
    triangles: u64,
    /// Whose command was taken on last, and its number.
    doing: Option<(Principal, u32)>,
    /// As whom that is counted where people take turns.
    doing_for: Option<Arc<str>>,
    /// Whether the tree grows by it alone, without a hand.
    doing_alone: bool,
    /// Whether it does so in one piece.
    doing_in_one_piece: bool,
    /// The document is read when this entry is done: all that was acknowledged before the session was opened is in it.
    reads_from: u64,
    /// Who waits for the outcome of that command, if it came from outside and is still open.
    owed: Option<ActId>,
    /// The frame with all rows, kept while it is current: clients often join at the same time.
    complete: Option<(u32, Arc<[u8]>)>,
    /// The open bends as they were reported last.
    bends: BTreeMap<u32, Vec<RowMotion>>,
    /// The sequence of the newest frame.
    bend_sequence: u32,
    report: Report,
}

impl Work {
    /// A document nobody has seen yet.
    pub(crate) fn new(
        document: Document,
        epoch: u32,
        applied: u64,
        last_commands: BTreeMap<Principal, LastCommand>,
    ) -> Self {
        let busy = document.pending_steps() > 0;
        let style = Style::new(to_proto::style_options(&document.parameters()));
        let mut work = Self {
            document,
            table: RingTable::new(),
            style,
            epoch,
            sequence: 0,
            applied,
            last_commands,
            orders: VecDeque::new(),
            stops: Stops::default(),
            catch_ups: Vec::new(),
            reads: Vec::new(),
            questions: Vec::new(),
            snapshot_wanted: false,
            checksum_wanted: false,
            now: 0,
            looks_due: 0,
            draws_until: 0,
            is_behind: false,
            whole_wanted: false,
            delta_wanted: false,
            busy,
            hold: None,
            triangles: 0,
            doing: None,
            doing_for: None,
            doing_alone: true,
            doing_in_one_piece: false,
            reads_from: applied,
            owed: None,
            complete: None,
            bends: BTreeMap::new(),
            bend_sequence: 0,
            report: Report::default(),
        };
        work.triangles = work.document.held_triangles() as u64;
        work
    }

    /// Takes over what a journal holds that is not done yet, or waits for a reason.
    pub(crate) fn take_over(&mut self, orders: VecDeque<Order>, stops: Stops, hold: Option<Pause>) {
        self.reads_from = orders.back().map_or(self.applied, |order| order.number);
        (self.orders, self.stops, self.hold) = (orders, stops, hold);
    }

    /// Whether more of what was taken over is to be done before anybody comes: long growth that nobody has stopped is not.
    pub(crate) fn follows(&self) -> bool {
        let left = u64::from(self.document.pending_steps()) * u64::from(self.document.metamers());
        let is_stopped = self.stops.end_of(self.applied).is_some();
        let grows_on = self.busy && self.doing_alone && !is_stopped && left >= LONG_GROWTH;
        self.hold.is_none() && (self.busy || !self.orders.is_empty()) && !grows_on
    }

    /// Does a slice of it, of which nothing is shown yet.
    pub(crate) fn follow(&mut self, is_over: impl Fn() -> bool, has_room: HasRoom<'_>) {
        self.simulate(is_over, has_room);
    }

    /// Shows the tree as it is now to whoever comes first.
    pub(crate) fn show(&mut self) {
        self.sync();
        self.report_bends();
    }

    /// Does one slice of what is to be done, which ends after the step or command at which `is_over` says so. Takes a
    /// while; the result goes back as [`crate::Input::Worked`].
    pub fn run(&mut self, is_over: impl Fn() -> bool) {
        self.run_within(is_over, &mut |_, _| true);
    }

    /// The same where there may be no room for what grows: then it rests, and the session asks again after a while.
    pub fn run_within(&mut self, is_over: impl Fn() -> bool, has_room: HasRoom<'_>) {
        self.simulate(is_over, has_room);
        self.show();
        for CatchUp { client, held } in std::mem::take(&mut self.catch_ups) {
            let frame = self.catch_up(&held);
            self.report.catch_ups.push((client, frame));
        }
        if std::mem::take(&mut self.checksum_wanted) {
            self.report.checksum = Some(self.checksum());
        }
    }

    fn checksum(&self) -> Checksum {
        let (sequence, rows) = (self.sequence, self.table.rows() as u32);
        Checksum { sequence, rows, crc32: checksum::crc32(&self.table), plant: self.document.plant().hash() }
    }

    /// What the slices since the last call brought about.
    pub(crate) fn take_report(&mut self) -> Report {
        std::mem::take(&mut self.report)
    }

    /// The journal entry through which all is done, with the growth that came of it.
    pub(crate) fn done_through(&self) -> u64 {
        self.applied.saturating_sub(u64::from(self.busy))
    }

    /// Whether there is something to run.
    pub(crate) fn is_needed(&self) -> bool {
        let is_read = self.snapshot_wanted
            || !self.questions.is_empty()
            || !self.reads.is_empty() && (self.may_be_read() || self.hold.is_none());
        let is_done = self.busy || !self.orders.is_empty();
        // What rests in the midst of a command cannot be read.
        let rests = self.hold.is_some();
        !self.catch_ups.is_empty()
            || self.checksum_wanted
            || self.whole_wanted
            || is_done && !rests
            || is_read && !(rests && self.busy)
    }

    /// Whether all that was acknowledged before the session was opened is in the document, or waits for an owner's word.
    fn may_be_read(&self) -> bool {
        self.applied >= self.reads_from || self.hold == Some(Pause::Crashes)
    }

    /// What the document takes of memory, in rows.
    pub fn held_rows(&self) -> u64 {
        self.document.held_rows(self.triangles)
    }

    /// What the next slice is for. What is long in one piece takes its turn among what grows, though somebody waits for
    /// it: it would keep all who draw from the workers.
    pub fn urgency(&self) -> Urgency {
        match self.need() {
            Urgency::Drawing if self.is_long() => Urgency::Growing,
            need => need,
        }
    }

    /// Whether the next slice does something in one piece that takes long.
    fn is_long(&self) -> bool {
        let next = self.orders.front().filter(|_| !self.busy);
        let is_in_one_piece = self.busy && self.doing_in_one_piece
            || next.is_some_and(|order| is_in_one_piece(&order.command.action))
            || self.shows_all();
        is_in_one_piece && self.has_many_rows()
    }

    fn has_many_rows(&self) -> bool {
        self.document.plant().recorded_metamers() > LONG_ROWS
    }

    /// Whether somebody who comes is to be shown the tree, and that is not made yet. Whoever has only fallen behind is
    /// sent what has changed since.
    fn shows_all(&self) -> bool {
        let is_made = self.complete.as_ref().is_some_and(|(sequence, _)| *sequence == self.sequence);
        self.catch_ups.iter().any(|catch_up| match catch_up.held {
            Held::Nothing => !is_made,
            Held::Chunks(_) => true,
            Held::AsOf { .. } => false,
        })
    }

    /// For what the next slice needs memory.
    fn need(&self) -> Urgency {
        let next = match (self.busy, self.orders.front()) {
            (true, _) => Some(self.doing_alone),
            (false, Some(order)) => Some(grows_alone(&order.command.action)),
            (false, None) => None,
        };
        match next {
            Some(true) => Urgency::Growing,
            Some(false) => Urgency::Drawing,
            // What is shown of a tree that was just opened, or has rested.
            None if !self.catch_ups.is_empty() => Urgency::Drawing,
            None => Urgency::Keeping,
        }
    }

    /// For whom the next slice is, if it is for one person.
    pub fn whose(&self) -> Option<&Arc<str>> {
        let doing = self.doing_for.as_ref().filter(|_| self.busy);
        doing.or_else(|| self.orders.front().map(|order| &order.person))
    }

    fn simulate(&mut self, is_over: impl Fn() -> bool, has_room: HasRoom<'_>) {
        // As many as a stop counts on: what is written as commands are taken on is among them (`ST1`).
        let begun = self.document.steps_begun();
        let mut steps = 0;
        let mut commands = 0;
        let start = self.document.metamers();
        self.document.stop_at(self.stops.end_of(self.applied));
        if self.hold.is_some() {
            if !self.busy {
                self.hand_out(has_room);
            }
            return;
        }
        loop {
            let is_full = self.document.steps_begun().wrapping_sub(begun) >= SLICE_STEPS;
            if self.busy {
                if is_full {
                    return;
                }
                if !self.may_step(has_room) {
                    self.hold = Some(Pause::Memory);
                    return;
                }
                if self.document.advance() {
                    self.report_hints();
                    self.report_outcome();
                    steps += 1;
                    if steps == SLICE_STEPS
                        || is_over()
                        || self.document.metamers() >= start.saturating_add(SLICE_METAMERS)
                    {
                        return;
                    }
                    continue;
                }
                self.busy = false;
            }
            self.hand_out(has_room);
            if is_full || commands == SLICE_COMMANDS || commands > 0 && is_over() {
                return;
            }
            let Some(order) = self.orders.front() else { return };
            // What is long takes a turn of its own.
            let is_first = commands == 0 && steps == 0;
            if !is_first && is_in_one_piece(&order.command.action) && self.has_many_rows() {
                return;
            }
            let held = self.held_rows();
            let taken_on = room::after_taking_on(&order.command.action, held);
            if taken_on > held && !has_room(taken_on, self.need()) {
                self.hold = Some(Pause::Memory);
                return;
            }
            let Some(order) = self.orders.pop_front() else { return };
            commands += 1;
            self.begin(order);
        }
    }

    /// Whether there is room for the next step. Growth that is stopped has a few steps left, which it always takes.
    fn may_step(&self, has_room: HasRoom<'_>) -> bool {
        let is_stopped = self.stops.end_of(self.applied).is_some();
        let grows = self.document.pending_steps() > 0 && !is_stopped;
        !grows || has_room(room::after_step(self.held_rows()), self.need())
    }

    fn begin(&mut self, order: Order) {
        self.applied = order.number;
        self.stops.forget_through(order.number);
        self.document.stop_at(self.stops.end_of(order.number));
        note_last(&mut self.last_commands, &order.author, LastCommand { id: order.id, entry: order.number });
        self.doing = Some((order.author.clone(), order.id));
        self.doing_for = Some(Arc::clone(&order.person));
        self.doing_alone = grows_alone(&order.command.action);
        self.doing_in_one_piece = is_in_one_piece(&order.command.action);
        let begun = self.document.begin(&order.author, &order.command);
        if room::changes_triangles(&order.command.action) {
            self.triangles = self.document.held_triangles() as u64;
        }
        self.owed = order.act;
        if !self.document.is_undecided() {
            self.answer_act(begun.clone());
        }
        match begun {
            Ok(()) => {
                self.busy = true;
                if let Some(Switched { kind, away, fell, rose, held, passed }) = self.document.take_switched()
                {
                    let deed = Deed { id: order.id, kind, away, fell, rose, held, passed };
                    self.answer(&order.author, order.id, ServerMessage::Deed { deed });
                }
            }
            Err(problem) => {
                self.answer(&order.author, order.id, ServerMessage::Refused { id: order.id, problem });
            }
        }
    }

    /// Tells whoever sent the command from outside what became of it.
    fn answer_act(&mut self, outcome: Result<(), Problem>) {
        if let Some(act) = self.owed.take() {
            self.report.acts.push((act, outcome.map(|()| self.document.obstacles().pop())));
        }
    }

    /// What was open as the command was taken on may be decided now.
    fn report_outcome(&mut self) {
        if self.document.is_undecided() {
            return;
        }
        let outcome = self.document.take_outcome();
        if let (Err(problem), Some((author, id))) = (outcome.clone(), self.doing.clone()) {
            self.answer(&author, id, ServerMessage::Refused { id, problem });
        }
        self.answer_act(outcome);
    }

    /// Answers a command. The session's own have number 0, and nobody waits for their answer; those that are done again
    /// after a crash were answered before it.
    fn answer(&mut self, author: &Principal, id: u32, message: ServerMessage) {
        if id > 0 && self.applied > self.reads_from {
            self.report.answers.push(Answer { author: author.clone(), message });
        }
    }

    /// All hints belong to the command that is being done.
    fn report_hints(&mut self) {
        let drawn = self.document.take_drawn_in_vain();
        let Some((author, id)) = self.doing.clone().filter(|_| !drawn.is_empty()) else { return };
        for DrawnInVain { stroke, reason, place } in drawn {
            let hint = Hint { id, stroke, reason, position: Position::nearest(place) };
            self.answer(&author, id, ServerMessage::Hint { hint });
        }
    }

    /// Between two commands the document is whole: now it can be read.
    fn hand_out(&mut self, has_room: HasRoom<'_>) {
        for question in std::mem::take(&mut self.questions) {
            // A prediction grows a copy.
            let held = self.held_rows();
            let run = if has_room(held + room::after_step(held), Urgency::Growing) {
                PredictionRun::new(question, self.document.fork(), self.style.clone(), self.epoch)
            } else {
                PredictionRun::refused(question, self.style.clone(), self.epoch)
            };
            self.report.runs.push(run);
        }
        if self.snapshot_wanted {
            self.snapshot_wanted = false;
            let snapshot = snapshot::to_bytes(self.applied, &self.last_commands, &self.document);
            self.report.snapshot = Some((self.applied, snapshot));
        }
        if self.may_be_read() && !self.reads.is_empty() {
            let document = ReadDocument {
                bytes: self.document.to_saved_bytes(),
                metamers: self.document.metamers(),
                species: self.document.species(),
                through: self.applied,
            };
            let answers = self.reads.drain(..).map(|read| (read, document.clone()));
            self.report.documents.extend(answers);
        }
    }

    /// Tells the bends that changed; what the table shows of bends is behind what the report holds already.
    fn report_bends(&mut self) {
        if self.document.is_between() {
            return;
        }
        let bends = self.document.bend_motions();
        let over = self.bends.keys().filter(|bend| !bends.contains_key(bend));
        let mut changed: Vec<_> = over.map(|&bend| (bend, Vec::new())).collect();
        let is_new = |(bend, update): &(&u32, &Vec<RowMotion>)| self.bends.get(bend) != Some(update);
        changed.extend(bends.iter().filter(is_new).map(|(&bend, update)| (bend, update.clone())));
        for (bend, motions) in changed {
            self.bend_sequence += 1;
            let (sequence, is_over) = (self.bend_sequence, motions.is_empty());
            let frame = BendFrame { epoch: self.epoch, sequence, bend, motions }.encode().into();
            self.report.bends.push(BendUpdate { bend, sequence, is_over, frame });
        }
        self.bends = bends;
    }

    fn sync(&mut self) {
        if self.document.is_between() {
            return;
        }
        let options = to_proto::style_options(&self.document.parameters());
        if options != *self.style.options() {
            self.style = Style::new(options);
        }
        let sequence = self.sequence + 1;
        let detail = self.detail();
        let changes = self.table.sync_in(detail, self.document.portrait(), &self.style, sequence);
        self.is_behind = detail != Detail::Whole;
        if changes.is_empty() {
            return;
        }
        self.sequence = sequence;
        if self.delta_wanted {
            let frame = to_proto::delta(&self.table, &changes, self.epoch, sequence);
            self.report.delta = Some(frame.encode().into());
        }
    }

    /// How much of what older wood looks like is shown now (`FL5`).
    fn detail(&mut self) -> Detail {
        if self.document.has_open_strokes() {
            self.draws_until = self.now + PAUSE_MS;
        }
        let is_done = !self.busy && self.orders.is_empty() && self.document.pending_steps() == 0;
        let is_at_rest = self.hold.is_some() || is_done && self.now >= self.draws_until;
        let is_whole_wanted = std::mem::take(&mut self.whole_wanted) || self.checksum_wanted;
        if !is_whole_wanted && !is_at_rest && self.now < self.looks_due {
            return Detail::Form;
        }
        self.looks_due = self.now + LOOKS_MS;
        if is_whole_wanted || is_at_rest { Detail::Whole } else { Detail::Coarse }
    }

    pub(crate) fn catch_up(&mut self, held: &Held) -> Arc<[u8]> {
        if !matches!(held, Held::Nothing) {
            return to_proto::catch_up(&self.table, held, self.epoch, self.sequence).encode().into();
        }
        if let Some((sequence, frame)) = &self.complete
            && *sequence == self.sequence
        {
            return Arc::clone(frame);
        }
        let frame: Arc<[u8]> =
            to_proto::catch_up(&self.table, held, self.epoch, self.sequence).encode().into();
        self.complete = Some((self.sequence, Arc::clone(&frame)));
        frame
    }
}
