//! Frames to clients, each at its own pace (`FL`).

use std::sync::Arc;

use espalier_proto::{DocumentState, Problem, ServerMessage};

use super::{ProgrammeInForce, Scenery, Session};
use crate::{
    clients::{ConnectedClient, View},
    io::{ClientId, Output},
    to_proto::{self, Held},
    work::{Answer, CatchUp, PAUSE_MS, Report, Work},
};

impl Session {
    /// The client took in frames up to `sequence`.
    pub(super) fn received(&mut self, client: ClientId, sequence: u32) {
        let (newest, now) = (self.newest.0, self.now);
        let Some(connected) = self.connected_mut(client) else { return };
        if connected.window.receive(sequence, newest, now).is_err() {
            let problem = Problem::out_of_range("sequence", sequence, format!("up to {newest}"));
            self.send(client, &ServerMessage::Problem { problem });
        }
    }

    /// The document came home from a slice of work.
    pub(super) fn worked(&mut self, mut work: Box<Work>) {
        let Report { delta, catch_ups, answers, bends, runs, acts, documents, snapshot, checksum } =
            work.take_report();
        self.deliver(delta.as_ref(), work.sequence);
        self.newest = (work.sequence, work.table.rows() as u32);
        self.done = work.done_through();
        for (client, frame) in catch_ups {
            self.deliver_catch_up(client, &frame);
        }
        if let Some(checksum) = checksum {
            self.tell_checksum(checksum);
        }
        self.take_bend_updates(bends);
        self.outputs.extend(runs.into_iter().map(|prediction| Output::Predict(Box::new(prediction))));
        for Answer { author, message } in answers {
            if let Some(client) = self.authors.get(&author).and_then(|author| author.client) {
                self.send(client, &message);
            }
        }
        for (act, outcome) in acts {
            self.act_done(act, outcome);
        }
        let answers = documents.into_iter().map(|(read, document)| Output::Document { read, document });
        self.outputs.extend(answers);
        if let Some((through, bytes)) = snapshot {
            self.upkeep.snapshot_made(through, bytes);
        }
        self.queue.came_back(&work.orders);
        if work.document.is_between() {
            // A stop counts on how far it is; what stands is still what was told last.
            self.figures.steps_begun = work.document.steps_begun();
        } else {
            self.take_figures(&mut work);
            self.unsettle_pins();
            self.find_branches(&mut work.document);
            self.find_limbs(&mut work.document);
        }
        self.came_home(work.hold);
        self.whole_due = self.now + PAUSE_MS;
        self.home = Some(work);
        // Steps that were expected and not taken count as well: a refused command leaves no other trace.
        self.upkeep.state_changed |= self.state() != self.upkeep.sent;
    }

    fn take_figures(&mut self, work: &mut Work) {
        (self.figures, self.leaves) = (work.document.figures(), work.table.leaves());
        let parameters = work.document.parameters();
        if parameters != self.parameters {
            self.parameters = parameters.clone();
            self.broadcast(&ServerMessage::Parameters { parameters: Box::new(parameters) });
        }
        let programme = ProgrammeInForce::of(&work.document);
        if programme != self.programme {
            self.programme = programme;
            self.broadcast(&self.programme.message());
        }
        let appearance = *work.document.appearance();
        if appearance != self.appearance {
            if appearance.wind != self.appearance.wind {
                self.wind_since = self.now;
            }
            self.appearance = appearance;
            self.broadcast(&self.appearance_message());
        }
        if !work.document.has_obstacles_of(&self.scenery.mark) {
            self.scenery = Scenery::of(&work.document);
            self.broadcast(&self.obstacles_message());
        }
        let (timeline, widths) = (self.line_of(&work.document), work.document.widths());
        self.upkeep.timeline_changed |= timeline != self.timeline;
        self.upkeep.widths_changed |= widths != self.widths;
        (self.timeline, self.widths) = (timeline, widths);
        let mark = work.document.design_mark();
        if mark != self.design_mark {
            self.design_mark = mark;
            self.design = work.document.design_told();
            self.upkeep.design_changed = true;
            let dyes = work.document.dyes();
            self.upkeep.dyes_changed |= dyes != self.dyes;
            self.dyes = dyes;
            self.branches_changed();
        }
        let mark = work.document.grammar_mark();
        if mark != self.grammar_mark {
            self.grammar_mark = mark;
            self.grammar = work.document.grammar_told();
            self.upkeep.grammar_changed = true;
        }
    }

    /// Sends the delta to all in step; a client whose window is closed falls out of step instead (`FL2`).
    fn deliver(&mut self, delta: Option<&Arc<[u8]>>, sequence: u32) {
        let Some(delta) = delta else { return };
        let (before, rows) = self.newest;
        for (&id, client) in &mut self.clients {
            let Some(ConnectedClient { window, view: view @ View::InStep, .. }) = &mut client.connected
            else {
                continue;
            };
            if window.admits(delta.len()) {
                window.send(sequence, delta.len(), self.now);
                self.outputs.push_back(Output::Frame(id, Arc::clone(delta)));
            } else {
                *view = View::Stale(Held::AsOf { sequence: before, rows });
            }
        }
    }

    fn deliver_catch_up(&mut self, client: ClientId, frame: &Arc<[u8]>) {
        let (sequence, now) = (self.newest.0, self.now);
        let Some(connected @ ConnectedClient { view: View::Coming, .. }) = self.connected_mut(client) else {
            return;
        };
        connected.window.send(sequence, frame.len(), now);
        connected.view = View::InStep;
        self.outputs.push_back(Output::Frame(client, Arc::clone(frame)));
    }

    /// Hands out what waits: journal entries to the disk, the document to the simulation pool.
    pub(super) fn dispatch(&mut self) {
        if let Some(batch) = self.journal.take_batch() {
            self.outputs.push_back(Output::Journal(batch));
        }
        let Some(mut work) = self.home.take() else { return };
        let queued = self.queue.orders.iter();
        queued.for_each(|order| work.stops.note_once(order.number, &order.command.action));
        self.queue.send_along(&mut work.orders);
        work.reads.append(&mut self.reads);
        self.ask_questions(&mut work);
        work.snapshot_wanted |= self.snapshot_due(work.applied);
        work.delta_wanted = false;
        for (&client, state) in &mut self.clients {
            let Some(connected) = &mut state.connected else { continue };
            match &mut connected.view {
                View::InStep => work.delta_wanted = true,
                view @ View::Stale(_) if connected.window.is_empty() => {
                    if let View::Stale(held) = std::mem::replace(view, View::Coming) {
                        work.catch_ups.push(CatchUp { client, held });
                    }
                }
                View::Stale(_) | View::Coming => {}
            }
        }
        work.now = self.now;
        work.whole_wanted |= work.is_behind && !work.is_needed() && self.now >= self.whole_due;
        self.ask_for_checksum(&mut work);
        if work.is_needed() {
            self.outputs.push_back(Output::Work(work));
        } else {
            self.home = Some(work);
        }
    }

    /// How the tree looks, as it is sent to clients (`AP3`).
    pub(super) fn appearance_message(&self) -> ServerMessage {
        ServerMessage::Appearance { appearance: Box::new(self.appearance), wind_since: self.wind_since }
    }

    /// All obstacles as they are sent to clients (`OB3`).
    pub(super) fn obstacles_message(&self) -> ServerMessage {
        ServerMessage::Obstacles { obstacles: self.scenery.obstacles.clone() }
    }

    /// The design in force as it is sent to clients (`DS4`).
    pub(super) fn design_message(&self) -> ServerMessage {
        ServerMessage::Design { design: self.design.clone().map(Box::new) }
    }

    /// The colours of branches as they are sent to clients (`DS14`).
    pub(super) fn dyes_message(&self) -> ServerMessage {
        to_proto::dyes(&self.dyes)
    }

    /// The grammar in force as it is sent to clients (`GR5`).
    pub(super) fn grammar_message(&self) -> ServerMessage {
        ServerMessage::Grammar { grammar: self.grammar.clone().map(Box::new) }
    }

    /// The document's figures as they are sent to clients.
    pub(super) fn state(&self) -> DocumentState {
        let people = self.people().count();
        to_proto::state(&self.figures, self.leaves, self.queue.least_steps(), people, self.paused())
    }

    pub(super) fn connected_mut(&mut self, client: ClientId) -> Option<&mut ConnectedClient> {
        self.clients.get_mut(&client)?.connected.as_mut()
    }
}
