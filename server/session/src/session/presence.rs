//! Who is here and what they do, told to those who ask (`PS`). Nothing of it is journaled, acknowledged or queued.

use std::{collections::BTreeMap, sync::Arc};

use espalier_proto::{
    Camera, ClientMessage, Device, Person, Problem, Reason, ServerMessage, Timeline, access::Role,
    version::MAX_SHOWN_DEVICES,
};

use super::Session;
use crate::{
    clients::{Client, ConnectedClient},
    document::Document,
    entrant::Entrant,
    io::{ClientId, Named, Output},
    presence::{FramesOfTick, Here, Presence, Register, Said},
    principal::Principal,
    rights::{Access, forbidden},
};

/// Frames go out no more often than this, in milliseconds (`PS2`).
const TICK_MS: u64 = 50;
/// The list of people goes out no more often than this, in milliseconds.
const PEOPLE_MS: u64 = 250;
/// Two devices or more are asked so often whether they are there, in milliseconds (`PS3`).
const PING_MS: u64 = 2_000;
/// One that says nothing for so long is gone, in milliseconds,
const SILENCE_MS: u64 = 4_500;
/// or later where something is on its way to it, for which it may take so many times as long as it was seen to need;
const SLOWER: u64 = 2;
/// but no later than this.
const LONGEST_SILENCE_MS: u64 = 15_000;
/// Everyone is brought to a view no more often than this, in milliseconds (`PS5`).
const GATHER_MS: u64 = 10_000;

/// The presence of a session as a whole.
#[derive(Debug, Default)]
pub(super) struct Room {
    pub(super) register: Register,
    /// What authors are called, as it is kept.
    kept_names: BTreeMap<Principal, Arc<str>>,
    /// Whether somebody may be called otherwise, or has become an author.
    pub(super) names_changed: bool,
    /// Counts frames.
    tick: u32,
    tick_due: u64,
    people_changed: bool,
    people_due: u64,
    /// When devices are asked next whether they are there; nothing while one is alone.
    ping_due: Option<u64>,
    gather_due: u64,
}

impl Session {
    /// Somebody has said hello.
    pub(super) fn enter_room(&mut self, client: ClientId, principal: &Principal) -> Presence {
        let here: Here = self.present().map(|presence| (presence.device, presence.person)).unzip();
        let entrant = self.clients.get(&client).map(|client| client.entrant.clone());
        let entrant = entrant.unwrap_or_else(|| Entrant::new("", Role::Viewer));
        self.authors.enter(principal).counted_as = Some(entrant.counted_as(principal));
        let Entrant { identity, name, .. } = entrant;
        let (device, person) = self.room.register.enter(principal, &identity, &here);
        if let Some(given) = name {
            self.room.register.give_name(person, given);
        }
        (self.room.people_changed, self.room.names_changed) = (true, true);
        Presence::new(device, person, self.now)
    }

    /// The lines of time, with the numbers that people have here.
    pub(super) fn line_of(&mut self, document: &Document) -> Timeline {
        let register = &mut self.room.register;
        document.timeline_of(|author| register.author(author))
    }

    /// A device has left.
    pub(super) fn leave_room(&mut self, device: u32) {
        for connected in self.clients.values_mut().filter_map(|client| client.connected.as_mut()) {
            connected.presence.follows.take_if(|followed| *followed == device);
        }
        self.room.people_changed = true;
    }

    /// What a page says of itself and its person (`PS1`).
    pub(super) fn here(&mut self, client: ClientId, said: Said, name: Option<&str>) {
        let Some(state) = self.clients.get(&client) else { return };
        let shows = [
            (said.tool.is_some(), "tool"),
            (said.radius.is_some(), "radius"),
            (!said.sketch.is_empty(), "sketch"),
        ];
        let shown = shows.into_iter().find(|(is_there, _)| *is_there && state.access != Access::Edit);
        if let Some((_, field)) = shown {
            let problem = forbidden().at(field, "nothing, of somebody who may not edit");
            return self.send(client, &ServerMessage::Problem { problem });
        }
        let Some(connected) = self.connected_mut(client) else { return };
        let is_another = connected.presence.say(said);
        let person = connected.presence.person;
        let is_renamed = name.is_some_and(|name| self.room.register.name(person, name));
        self.room.people_changed |= is_another || is_renamed;
        self.room.names_changed |= is_renamed;
    }

    /// A page follows the camera of a device, or none (`PS4`).
    pub(super) fn follow(&mut self, client: ClientId, device: Option<u32>) {
        let followed = device.filter(|device| self.present().any(|present| present.device == *device));
        let Some(connected) = self.connected_mut(client) else { return };
        connected.presence.follows = followed.filter(|followed| *followed != connected.presence.device);
        self.room.people_changed = true;
    }

    /// Somebody brings everyone to a view (`PS5`).
    pub(super) fn gather(&mut self, client: ClientId, camera: Camera) {
        let Some(state) = self.clients.get(&client) else { return };
        let Some(by) = state.connected.as_ref().map(|connected| connected.presence.device) else { return };
        let problem = if state.access != Access::Edit {
            Some(forbidden().at("type", "gather of somebody who may edit"))
        } else if self.now < self.room.gather_due {
            let left = (self.room.gather_due - self.now).div_ceil(1000);
            let message = "everyone was brought to a view a moment ago";
            Some(Problem::new(Reason::TooOften, message).at("gather", format!("after {left} s")))
        } else {
            None
        };
        if let Some(problem) = problem {
            return self.send(client, &ServerMessage::Problem { problem });
        }
        self.room.gather_due = self.now + GATHER_MS;
        let others = self.listeners().into_iter().filter(|other| *other != client).collect::<Vec<_>>();
        for other in others {
            self.send(other, &ServerMessage::Gathered { by, camera });
        }
    }

    /// There was a sign of a client. Whether others are to hear of it.
    pub(super) fn hear(&mut self, client: ClientId) -> bool {
        let now = self.now;
        let Some(connected) = self.connected_mut(client) else { return false };
        connected.presence.heard_at = now;
        let was_gone = std::mem::take(&mut connected.presence.is_gone);
        self.room.people_changed |= was_gone;
        was_gone
    }

    /// The client has drawn the frames up to this one.
    pub(super) fn received_presence(&mut self, client: ClientId, sequence: u32) {
        let Some(connected) = self.connected_mut(client) else { return };
        connected.presence.in_flight.take_if(|waiting| *waiting <= sequence);
    }

    /// Somebody may do more or less from now on (`AU3`).
    pub(super) fn grant(&mut self, client: ClientId, role: Role) {
        // In a replay everybody does the same, whoever they are.
        let Some(state) = self.clients.get_mut(&client).filter(|_| !self.is_replay) else { return };
        state.entrant.role = role;
        state.access = state.entrant.access();
        let access = state.access;
        let Some(connected) = state.connected.as_mut() else { return };
        if access != Access::Edit {
            connected.presence.lay_down();
        }
        let principal = connected.principal.clone();
        self.room.people_changed = true;
        self.send(client, &ServerMessage::Role { role });
        // Who gets it back before it is known which strokes are open goes on with them, and with all that they begin.
        if access == Access::Look {
            self.upkeep.overdue.insert(principal);
        } else {
            self.upkeep.overdue.remove(&principal);
        }
    }

    /// Does what is due now: asks who is there, and tells what is new.
    pub(super) fn keep_room(&mut self) {
        self.keep_names();
        self.ask_who_is_there();
        if self.room.people_changed && self.now >= self.room.people_due {
            self.room.people_changed = false;
            self.room.people_due = self.now + PEOPLE_MS;
            self.tell_people();
        }
        if self.next_tick().is_some_and(|due| due <= self.now) {
            self.tick();
        }
    }

    /// Has it kept what those are called who have done something (`PS6`).
    fn keep_names(&mut self) {
        if !std::mem::take(&mut self.room.names_changed) {
            return;
        }
        for client in self.clients.values() {
            let Some(ConnectedClient { principal, presence, .. }) = &client.connected else { continue };
            let is_author = self.authors.get(principal).is_some_and(|author| author.last_entry > 0);
            if !is_author {
                continue;
            }
            // Those without a name are kept as well, for what they did stays theirs (`UD8`).
            let name = self.room.register.called(presence.person).unwrap_or_default();
            if self.room.kept_names.get(principal).is_none_or(|kept| **kept != *name) {
                let (author, name): (_, Arc<str>) = (principal.clone(), name.into());
                self.room.kept_names.insert(author.clone(), Arc::clone(&name));
                let person = Some(Arc::clone(&client.entrant.identity));
                self.outputs.push_back(Output::Named(Named { author, person, name }));
            }
        }
        // Those who have left are kept under their last name already.
        let clients = &self.clients;
        self.room.kept_names.retain(|author, _| {
            let mut here = clients.values().filter_map(|client| client.connected.as_ref());
            here.any(|connected| connected.principal == *author)
        });
    }

    /// When something is due next.
    pub(super) fn room_due(&self) -> Option<u64> {
        let room = &self.room;
        let has_listeners = self.present().any(|present| present.listens);
        let people = (room.people_changed && has_listeners).then_some(room.people_due);
        let silence = room.ping_due.and_then(|_| self.silences().min());
        [people, room.ping_due, silence, self.next_tick()].into_iter().flatten().min()
    }

    fn ask_who_is_there(&mut self) {
        if self.present().count() < 2 {
            self.room.ping_due = None;
            return;
        }
        if self.room.ping_due.is_none() {
            // Whoever was alone was asked nothing, so that their silence says nothing.
            let now = self.now;
            let connected = self.clients.values_mut().filter_map(|client| client.connected.as_mut());
            connected.for_each(|connected| connected.presence.heard_at = now);
        }
        if self.room.ping_due.is_none_or(|due| due <= self.now) {
            self.room.ping_due = Some(self.now + PING_MS);
            let asked = self.clients.iter().filter(|(_, client)| client.connected.is_some());
            self.outputs.extend(asked.map(|(&client, _)| Output::Ping(client)));
        }
        for connected in self.clients.values_mut().filter_map(|client| client.connected.as_mut()) {
            if !connected.presence.is_gone && silent_at(connected) <= self.now {
                connected.presence.is_gone = true;
                self.room.people_changed = true;
            }
        }
    }

    /// When each device that is here will have been silent for too long.
    fn silences(&self) -> impl Iterator<Item = u64> {
        let connected = self.clients.values().filter_map(|client| client.connected.as_ref());
        connected.filter(|connected| !connected.presence.is_gone).map(silent_at)
    }

    fn tell_people(&mut self) {
        let (people, more) = self.people_here();
        for client in self.listeners() {
            let Some(you) = self.connected_mut(client).map(|connected| connected.presence.device) else {
                continue;
            };
            self.send(client, &ServerMessage::People { you, people: people.clone(), more });
        }
    }

    /// Whoever has this number and is here, called as others see them.
    pub fn person(&self, number: u32) -> Option<Entrant> {
        let is_it = |client: &&Client| {
            client.connected.as_ref().is_some_and(|connected| connected.presence.person == number)
        };
        let client = self.clients.values().filter(is_it).max_by_key(|client| client.entrant.role)?;
        let name = self.room.register.name_of(number).map(Arc::from);
        Some(Entrant { name: name.or_else(|| client.entrant.name.clone()), ..client.entrant.clone() })
    }

    /// Those who are here and have a name: their numbers, who they are, and what they are called. Each once.
    pub fn named(&self) -> Vec<(u32, Arc<str>, Arc<str>)> {
        let here = self.clients.values().filter_map(|client| {
            let number = client.connected.as_ref()?.presence.person;
            let given = client.entrant.name.as_deref();
            let name = self.room.register.name_of(number).or(given)?;
            Some((number, (Arc::clone(&client.entrant.person), name.into())))
        });
        let once: BTreeMap<u32, (Arc<str>, Arc<str>)> = here.collect();
        once.into_iter().map(|(number, (person, name))| (number, person, name)).collect()
    }

    /// What whoever is at a device is called, if they are here and have a name.
    pub fn called(&self, at: &Principal) -> Option<Arc<str>> {
        let is_it = |connected: &&ConnectedClient| connected.principal == *at;
        let found = self.clients.values().filter_map(|client| client.connected.as_ref()).find(is_it)?;
        self.person(found.presence.person)?.name
    }

    /// Those who are shown to each other, and how many devices are here beside theirs.
    fn people_here(&self) -> (Vec<Person>, u32) {
        let shown = self.shown();
        let mut people: BTreeMap<u32, Person> = BTreeMap::new();
        for client in self.clients.values() {
            let Some(ConnectedClient { presence, .. }) = &client.connected else { continue };
            if is_shown(presence, shown) {
                let given = client.entrant.name.as_deref();
                let name = self.room.register.name_of(presence.person).or(given).map(str::to_owned);
                let role = client.entrant.role;
                let person = people.entry(presence.person).or_insert_with(|| Person {
                    person: presence.person,
                    name,
                    role,
                    devices: Vec::new(),
                });
                person.role = person.role.max(role);
                person.devices.push(Device {
                    device: presence.device,
                    state: presence.state(),
                    tool: presence.tool.clone(),
                    follows: presence.follows,
                });
            }
        }
        let mut people: Vec<Person> = people.into_values().collect();
        people.iter_mut().for_each(|person| person.devices.sort_by_key(|device| device.device));
        let more = self.present().count().saturating_sub(MAX_SHOWN_DEVICES);
        (people, more as u32)
    }

    /// The last device that is shown, if not all are.
    fn shown(&self) -> Option<u32> {
        let mut devices: Vec<u32> = self.present().map(|present| present.device).collect();
        devices.sort_unstable();
        devices.get(MAX_SHOWN_DEVICES..).filter(|rest| !rest.is_empty())?;
        devices.get(MAX_SHOWN_DEVICES - 1).copied()
    }

    /// When the next frame is due: something is new, or somebody who can take a frame again lacks something.
    fn next_tick(&self) -> Option<u64> {
        if !self.present().any(|present| present.listens) {
            return None;
        }
        let shown = self.shown();
        let told = self.present().filter(|present| is_shown(present, shown));
        let news = told.filter_map(|present| present.due(self.is_followed(present.device)));
        let late = self.present().any(|present| self.lacks(present, shown)).then_some(0);
        news.chain(late).min().map(|due| due.max(self.room.tick_due))
    }

    fn tick(&mut self) {
        self.room.tick_due = self.now + TICK_MS;
        self.room.tick = self.room.tick.wrapping_add(1);
        let (tick, now, shown) = (self.room.tick, self.now, self.shown());
        let followed: Vec<u32> = self.present().filter_map(|present| present.follows).collect();
        let connected = self.clients.values_mut().filter_map(|client| client.connected.as_mut());
        // What is new of others stays so until they are shown.
        for presence in connected.map(|it| &mut it.presence).filter(|presence| is_shown(presence, shown)) {
            let is_followed = followed.contains(&presence.device);
            presence.stamp(tick, now, is_followed);
        }
        let mut frames = FramesOfTick::default();
        let mut sent = Vec::new();
        for (&client, state) in &self.clients {
            let Some(ConnectedClient { presence, .. }) = &state.connected else { continue };
            if self.lacks(presence, shown) {
                let told = self.present().filter(|present| is_shown(present, shown));
                sent.push((client, frames.after(presence.seen, (self.epoch, tick), told)));
            }
        }
        for (client, frame) in sent {
            if let Some(connected) = self.connected_mut(client) {
                (connected.presence.seen, connected.presence.in_flight) = (tick, Some(tick));
                self.outputs.push_back(Output::Volatile(client, frame));
            }
        }
    }

    /// Whether a device is told of others, can take a frame, and has not been told all of the others that are shown.
    fn lacks(&self, device: &Presence, shown: Option<u32>) -> bool {
        let can_take = device.listens && device.in_flight.is_none();
        let others = self.present().filter(|other| is_shown(other, shown));
        let mut others = others.filter(|other| other.device != device.device);
        can_take && others.any(|other| other.newest() > device.seen)
    }

    fn is_followed(&self, device: u32) -> bool {
        self.present().any(|present| present.follows == Some(device))
    }

    fn present(&self) -> impl Iterator<Item = &Presence> {
        let connected = self.clients.values().filter_map(|client| client.connected.as_ref());
        connected.map(|connected| &connected.presence)
    }

    /// Whoever is told of others.
    fn listeners(&self) -> Vec<ClientId> {
        let listens = |connected: &ConnectedClient| connected.presence.listens;
        let listeners =
            self.clients.iter().filter(|(_, client)| client.connected.as_ref().is_some_and(listens));
        listeners.map(|(&client, _)| client).collect()
    }
}

/// Whether a device is shown to the others, where this is the last one that is ([`Session::shown`]).
fn is_shown(device: &Presence, last: Option<u32>) -> bool {
    last.is_none_or(|last| device.device <= last)
}

/// When a device will have been silent for too long. A slow link is no absence.
fn silent_at(connected: &ConnectedClient) -> u64 {
    let on_its_way = SLOWER * connected.window.takes();
    connected.presence.heard_at + (SILENCE_MS + on_its_way).min(LONGEST_SILENCE_MS)
}

/// What a `here` says, and the name in it.
pub(super) fn said(message: ClientMessage) -> Option<(Said, Option<String>)> {
    let ClientMessage::Here { pointer, radius, tool, sketch, camera, away, name } = message else {
        return None;
    };
    let said = Said {
        pointer,
        radius,
        tool: tool.map(String::from),
        sketch: sketch.map(Vec::from).unwrap_or_default(),
        camera,
        is_away: away,
    };
    Some((said, name.map(String::from)))
}
