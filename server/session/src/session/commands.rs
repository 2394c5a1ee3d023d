//! Commands: their numbers, their one order, their way to the disk (`CM`).

use std::{collections::VecDeque, sync::Arc};

use espalier_proto::{Action, Command, Problem, Reason, ServerMessage, bounded::List, command::MAX_OWN_KEYS};

use super::Session;
use crate::{
    entrant::counted_by_key,
    form::{self, read_command},
    io::{ActId, ClientId},
    principal::Principal,
    rights::Access,
    shares::Shares,
    work::{Order, SLICE_STEPS},
};

/// The most commands that wait for the document or for the disk.
const MAX_WAITING: usize = 4096;
/// The most of those that are one person's, so that nobody keeps all others out.
const MAX_WAITING_OF_ONE: usize = 1024;
/// The most bytes of journal text that wait for the document or for the disk.
const MAX_WAITING_BYTES: usize = 8 * 1024 * 1024;

/// Commands in order that the document has not taken on.
#[derive(Debug, Default)]
pub(super) struct Queue {
    /// Those that wait at home.
    pub(super) orders: VecDeque<Order>,
    /// Bytes and least steps of those.
    weight: Weight,
    /// Of those that went away with the document.
    away: Weight,
}

#[derive(Debug, Default)]
struct Weight {
    orders: usize,
    /// How many of them are whose.
    shares: Shares,
    bytes: usize,
    steps: u32,
}

impl Weight {
    fn add(&mut self, order: &Order) {
        self.orders += 1;
        self.shares.add(&order.person);
        self.bytes += order.bytes;
        self.steps = self.steps.saturating_add(least_steps(&order.command.action));
    }
}

/// The fewest simulation steps an action will run, for telling people how much is still to come.
fn least_steps(action: &Action) -> u32 {
    match action {
        Action::Grow { steps, .. } => steps.get(),
        Action::StrokeMove { .. }
        | Action::Lasso { .. }
        | Action::FitDesign { .. }
        | Action::Refill { .. } => 1,
        _ => 0,
    }
}

impl Queue {
    fn push(&mut self, order: Order) {
        self.weight.add(&order);
        self.orders.push_back(order);
    }

    /// Moves everything to what the document takes along.
    pub(super) fn send_along(&mut self, along: &mut VecDeque<Order>) {
        along.append(&mut self.orders);
        self.weight = Weight::default();
        self.came_back(along);
    }

    /// The document came back with these still to be done.
    pub(super) fn came_back(&mut self, orders: &VecDeque<Order>) {
        self.away = Weight::default();
        orders.iter().for_each(|order| self.away.add(order));
    }

    /// The fewest steps still to be run for these commands.
    pub(super) fn least_steps(&self) -> u32 {
        self.weight.steps.saturating_add(self.away.steps)
    }

    pub(super) fn waiting(&self) -> (usize, usize) {
        (self.weight.orders + self.away.orders, self.weight.bytes + self.away.bytes)
    }

    /// How many of those commands are somebody's.
    fn waiting_of(&self, person: &str) -> usize {
        self.weight.shares.of(person) + self.away.shares.of(person)
    }
}

impl Session {
    /// A numbered command came; `command` is a problem if it could not be read.
    pub(super) fn take(
        &mut self,
        client: ClientId,
        principal: &Principal,
        id: u32,
        command: Result<Command, Problem>,
    ) {
        let access = self.clients.get(&client).map(|client| client.access).unwrap_or_default();
        let author = self.authors.enter(principal);
        let next = author.taken.saturating_add(1);
        if id <= author.taken && id > 0 {
            return self.take_again(client, access, principal, id, command);
        }
        if id != next && !(author.forgot_refusals && id > next) {
            let message = format!("the command has number {id}, but the next one of this client is {next}");
            let problem = Problem::new(Reason::NumberTaken, message).at("id", next.to_string());
            return self.send(client, &ServerMessage::Refused { id, problem });
        }
        author.taken = id;
        author.forgot_refusals = false;
        match command.and_then(|command| self.check(access, principal, command)) {
            Ok((command, text)) => {
                self.accept(principal, id, command, text, None);
            }
            Err(problem) => {
                if problem.reason == Reason::Behind
                    && let Some(author) = self.authors.get_mut(principal)
                {
                    // It comes again, and what was sent after it must not go before it (`LM23`).
                    author.taken = id - 1;
                }
                self.send(client, &ServerMessage::Refused { id, problem });
            }
        }
    }

    /// A command came whose number was taken before: it is answered again, not done again (`CM1`).
    fn take_again(
        &mut self,
        client: ClientId,
        access: Access,
        principal: &Principal,
        id: u32,
        command: Result<Command, Problem>,
    ) {
        let durable = self.authors.get(principal).map_or(0, |author| author.durable);
        if id <= durable {
            return self.send(client, &ServerMessage::Acknowledged { id: durable });
        }
        if self.journal.is_waiting(principal, id) {
            return;
        }
        let problem = match command.and_then(|command| self.check(access, principal, command)) {
            Err(problem) if problem.reason != Reason::Behind => problem,
            _ => Problem::new(Reason::NumberTaken, format!("command {id} was refused before"))
                .at("id", "a number that no command had"),
        };
        self.send(client, &ServerMessage::Refused { id, problem });
    }

    /// A command that its author may give, in good form, read back from the very text the journal will hold, so that a
    /// replay cannot differ.
    pub(super) fn check(
        &self,
        access: Access,
        principal: &Principal,
        mut command: Command,
    ) -> Result<(Command, String), Problem> {
        access.check(&command.action)?;
        form::check(&command.action)?;
        match &mut command.action {
            Action::Stop { .. } => command.action = self.stop_now(),
            Action::TakeBack { keys } | Action::BringBack { keys } => *keys = self.other_keys(principal),
            _ => {}
        }
        let text = serde_json::to_string(&command)
            .map_err(|error| Problem::new(Reason::Malformed, error.to_string()).at("kind", "plain values"))?;
        let command = read_command(&text)?;
        let (queued, queued_bytes) = self.queue.waiting();
        let (writing, written_bytes) = self.journal.waiting();
        // Growth can be stopped that keeps all others from being done.
        let room = if matches!(command.action, Action::Stop { .. }) { 2 } else { 1 };
        let full = queued.max(writing) >= room * MAX_WAITING
            || queued_bytes.max(written_bytes).saturating_add(text.len()) > room * MAX_WAITING_BYTES;
        if full {
            let message = "too many commands wait to be done: try again when the tree has caught up";
            let allowed = format!("up to {MAX_WAITING} commands in {MAX_WAITING_BYTES} bytes that wait");
            return Err(Problem::new(Reason::Behind, message).at("kind", allowed));
        }
        let person = self.counted_as(principal);
        if self.queue.waiting_of(&person).max(self.journal.waiting_of(&person)) >= room * MAX_WAITING_OF_ONE {
            let message = "too many of your commands wait to be done: try again when the tree has caught up";
            let allowed = format!("up to {MAX_WAITING_OF_ONE} commands of one person that wait");
            return Err(Problem::new(Reason::Behind, message).at("kind", allowed));
        }
        Ok((command, text))
    }

    /// As whom it is counted what is done with a client key.
    fn counted_as(&self, principal: &Principal) -> Arc<str> {
        let known = self.authors.get(principal).and_then(|author| author.counted_as.as_ref());
        known.map_or_else(|| counted_by_key(principal), Arc::clone)
    }

    /// The other keys under which whoever has this one did something (`UD8`).
    fn other_keys(&self, principal: &Principal) -> List<String, 0, MAX_OWN_KEYS> {
        let has_done = |key: &&Principal| self.authors.get(key).is_some_and(|author| author.last_entry > 0);
        let keys = self.room.register.other_keys(principal, has_done);
        keys.map(|key| key.name().to_owned())
            .take(MAX_OWN_KEYS)
            .collect::<Vec<_>>()
            .try_into()
            .unwrap_or_default()
    }

    /// A stop of all growth under way (`ST1`).
    pub(super) fn stop_now(&self) -> Action {
        // The slice under way began at the figures known here, so growth cannot be beyond this when it returns.
        Action::Stop { tick: Some(self.figures.steps_begun.saturating_add(SLICE_STEPS)) }
    }

    /// Gives a command its place in the order; the number of its journal entry.
    pub(super) fn accept(
        &mut self,
        principal: &Principal,
        id: u32,
        command: Command,
        text: String,
        act: Option<ActId>,
    ) -> u64 {
        let bytes = text.len();
        let person = self.counted_as(principal);
        let number = self.journal.append(principal, Arc::clone(&person), id, text);
        if let Some(author) = self.authors.get_mut(principal) {
            self.room.names_changed |= author.last_entry == 0;
            author.last_entry = number;
        }
        self.queue.push(Order { number, author: principal.clone(), person, id, command, bytes, act });
        self.upkeep.last_command_at = self.now;
        self.upkeep.state_changed |= self.queue.least_steps() > 0;
        number
    }

    /// Entries up to `through` are durable.
    pub(super) fn journaled(&mut self, through: u64) {
        for (principal, id) in self.journal.made_durable(through) {
            let Some(author) = self.authors.get_mut(&principal) else { continue };
            author.durable = id;
            if let Some(client) = author.client {
                self.send(client, &ServerMessage::Acknowledged { id });
            }
        }
    }
}
