//! What is known of who is here and what they do (`PS`): of everything the newest alone.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

use espalier_proto::{
    BrushRadius, Camera, DeviceNews, Pointer, PointerNews, PointerPlace, Position, PresenceFrame,
    Whereabouts,
    presence_frame::{ALONG_STEPS, PLACE_STEPS, RADIUS_STEPS},
};
use glam::Vec3;

use crate::{io::Named, principal::Principal};

/// People and devices whose numbers are kept after they have left.
const MAX_KNOWN: usize = 1024;
/// Cameras that nobody follows are told no more often than this, in milliseconds (`PS4`).
const CAMERA_MS: u64 = 500;

/// Something that is told, and the tick in which it became what it is; 0 where it never changed.
#[derive(Clone, Debug, Default)]
struct Told<T> {
    value: T,
    since: u32,
    /// Whether it is newer than that.
    is_new: bool,
}

impl<T: PartialEq> Told<T> {
    fn set(&mut self, value: T) {
        if value != self.value {
            self.value = value;
            self.is_new = true;
        }
    }
}

impl<T: Clone> Told<T> {
    fn stamp(&mut self, tick: u32) {
        if std::mem::take(&mut self.is_new) {
            self.since = tick;
        }
    }

    fn after(&self, tick: u32) -> Option<T> {
        (self.since > tick).then(|| self.value.clone())
    }
}

/// What a page says with `here`, but for its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Said {
    pub(crate) pointer: Option<Pointer>,
    pub(crate) radius: Option<BrushRadius>,
    pub(crate) tool: Option<String>,
    pub(crate) sketch: Vec<Position>,
    pub(crate) camera: Option<Camera>,
    pub(crate) is_away: bool,
}

/// A page that is connected.
#[derive(Debug, Default)]
pub(crate) struct Presence {
    /// Its number.
    pub(crate) device: u32,
    /// That of whoever is at it.
    pub(crate) person: u32,
    /// Whether it has said `here`, and so is told of others.
    pub(crate) listens: bool,
    pub(crate) tool: Option<String>,
    is_away: bool,
    /// Whether it has been silent for too long.
    pub(crate) is_gone: bool,
    /// When a sign of it came last.
    pub(crate) heard_at: u64,
    /// The device whose camera it follows.
    pub(crate) follows: Option<u32>,
    pointer: Told<PointerNews>,
    sketch: Told<Vec<[i32; 3]>>,
    camera: Told<Option<[f32; 6]>>,
    camera_told_at: Option<u64>,
    /// The tick of the last frame that it was sent.
    pub(crate) seen: u32,
    /// A frame that it has not answered.
    pub(crate) in_flight: Option<u32>,
}

impl Presence {
    pub(crate) fn new(device: u32, person: u32, now: u64) -> Self {
        Self { device, person, heard_at: now, ..Self::default() }
    }

    /// Where its person is.
    pub(crate) fn state(&self) -> Whereabouts {
        match (self.is_gone, self.is_away) {
            (true, _) => Whereabouts::Gone,
            (false, true) => Whereabouts::Away,
            (false, false) => Whereabouts::Here,
        }
    }

    /// Takes what it says; whether the list of people is another now.
    pub(crate) fn say(&mut self, said: Said) -> bool {
        let place = said.pointer.as_ref().map_or(PointerPlace::Nowhere, place_of);
        let radius = said.radius.map_or(0.0, BrushRadius::get);
        self.pointer.set(PointerNews { place, radius: (radius * RADIUS_STEPS).round() as u32 });
        self.sketch.set(said.sketch.iter().map(|place| steps(place.get())).collect());
        if let Some(camera) = said.camera {
            self.camera.set(Some(camera.numbers()));
        }
        let is_same = self.tool == said.tool && self.is_away == said.is_away && self.listens;
        (self.tool, self.is_away, self.listens) = (said.tool, said.is_away, true);
        !is_same
    }

    /// It shows nothing of itself any more but that it is there.
    pub(crate) fn lay_down(&mut self) {
        self.tool = None;
        self.pointer.set(PointerNews { radius: 0, ..self.pointer.value });
        self.sketch.set(Vec::new());
    }

    /// When something new of it is told, if anything is new; at once is 0.
    pub(crate) fn due(&self, is_followed: bool) -> Option<u64> {
        if self.pointer.is_new || self.sketch.is_new {
            return Some(0);
        }
        let told_at = self.camera_told_at.filter(|_| !is_followed);
        self.camera.is_new.then(|| told_at.map_or(0, |at| at + CAMERA_MS))
    }

    /// A tick of the presence: what is new becomes what is told.
    pub(crate) fn stamp(&mut self, tick: u32, now: u64, is_followed: bool) {
        self.pointer.stamp(tick);
        self.sketch.stamp(tick);
        if self.camera.is_new && (is_followed || self.camera_told_at.is_none_or(|at| now >= at + CAMERA_MS)) {
            self.camera.stamp(tick);
            self.camera_told_at = Some(now);
        }
    }

    /// The last tick in which anything of it changed.
    pub(crate) fn newest(&self) -> u32 {
        self.pointer.since.max(self.sketch.since).max(self.camera.since)
    }

    /// What changed after a tick.
    pub(crate) fn news(&self, after: u32) -> Option<DeviceNews> {
        (self.newest() > after).then(|| DeviceNews {
            device: self.device,
            pointer: self.pointer.after(after),
            sketch: self.sketch.after(after),
            camera: self.camera.after(after).flatten(),
        })
    }
}

fn place_of(pointer: &Pointer) -> PointerPlace {
    match pointer {
        Pointer::Wood { row, along, offset } => PointerPlace::Wood {
            row: *row,
            along: (along.get() * ALONG_STEPS).round() as u8,
            offset: steps(offset.get()),
        },
        Pointer::Space { position } => PointerPlace::Space(steps(position.get())),
    }
}

fn steps(place: Vec3) -> [i32; 3] {
    (place * PLACE_STEPS).to_array().map(|number| number.round() as i32)
}

/// The frames of one tick: each is made once, however many clients get it.
#[derive(Debug, Default)]
pub(crate) struct FramesOfTick(BTreeMap<u32, Arc<[u8]>>);

impl FramesOfTick {
    /// What changed after a tick, of these devices.
    pub(crate) fn after<'a>(
        &mut self,
        after: u32,
        (epoch, sequence): (u32, u32),
        devices: impl Iterator<Item = &'a Presence>,
    ) -> Arc<[u8]> {
        let frame = self.0.entry(after).or_insert_with(|| {
            let devices = devices.filter_map(|device| device.news(after)).collect();
            PresenceFrame { epoch, sequence, devices }.encode().into()
        });
        Arc::clone(frame)
    }
}

/// The numbers of devices and of people that are in use.
pub(crate) type Here = (BTreeSet<u32>, BTreeSet<u32>);

/// Numbers of people and devices, and what people are called, while the session is in memory. A replay takes a copy, so
/// that everybody has the number and with it the colour that they have in the session (`RP3`).
#[derive(Clone, Debug, Default)]
pub struct Register {
    people: Numbers<Arc<str>>,
    devices: Numbers<Principal>,
    /// Who is, or was last, at which device.
    person_at: BTreeMap<Principal, u32>,
    /// What people call themselves, by their numbers.
    names: BTreeMap<u32, String>,
    /// What the server calls them, until they choose.
    given: BTreeMap<u32, Arc<str>>,
    /// Who did something before the session was opened, and what they were called.
    authors: BTreeMap<Principal, u32>,
    remembered: BTreeMap<u32, Arc<str>>,
}

impl Register {
    /// Whether what is done under a key counts for somebody else (`HS4`).
    pub(crate) fn is_of_another(&self, key: &Principal, person: &Arc<str>) -> bool {
        let people = &self.people.numbers;
        let known = self.person_at.get(key).or_else(|| self.authors.get(key));
        let Some(number) = known.filter(|number| people.get(&author_alone(key)) != Some(number)) else {
            return false;
        };
        // Whoever is forgotten by now has nothing any more.
        people.get(person) != Some(number) && people.values().any(|other| other == number)
    }

    /// The numbers of a device and of whoever is at it, where these are in use.
    pub(crate) fn enter(
        &mut self,
        principal: &Principal,
        person: &Arc<str>,
        (devices, people): &Here,
    ) -> (u32, u32) {
        let device = self.devices.of(principal, |number| devices.contains(&number));
        self.people.rename(&author_alone(principal), person);
        let person = self.people.of(person, |number| people.contains(&number));
        let known: BTreeSet<u32> = self.people.numbers.values().copied().collect();
        self.names.retain(|number, _| known.contains(number));
        self.given.retain(|number, _| known.contains(number));
        self.remembered.retain(|number, _| known.contains(number));
        self.person_at.insert(principal.clone(), person);
        self.person_at.retain(|device, _| self.devices.numbers.contains_key(device));
        (device, person)
    }

    /// The number of whoever did something at a device, which may have been long ago.
    pub(crate) fn author(&mut self, device: &Principal) -> u32 {
        match self.person_at.get(device).or_else(|| self.authors.get(device)) {
            Some(&person) => person,
            None => self.people.of(&author_alone(device), |_| true),
        }
    }

    /// What somebody was called who has done something. Of several names of one person the last counts.
    pub(crate) fn remember(&mut self, Named { author, person, name }: Named) {
        let alone = author_alone(&author);
        let person = person.unwrap_or_else(|| alone.clone());
        self.people.rename(&alone, &person);
        let number = self.people.of(&person, |_| true);
        self.authors.insert(author, number);
        if !name.is_empty() {
            self.remembered.insert(number, name);
        }
    }

    /// The other keys of whoever is, or was last, at a device: those known as authors from before, and of the others
    /// those of which something is so.
    pub(crate) fn other_keys<'a>(
        &'a self,
        device: &'a Principal,
        has_done: impl Fn(&&Principal) -> bool,
    ) -> impl Iterator<Item = &'a Principal> {
        let person = self.person_at.get(device);
        let of_them = move |(key, number): (&'a Principal, &u32)| (Some(number) == person).then_some(key);
        // Whoever is at a device now counts, whoever was before.
        let before =
            self.authors.iter().filter(|(key, _)| !self.person_at.contains_key(key)).filter_map(of_them);
        let here = self.person_at.iter().filter_map(of_them);
        let here = here.filter(move |key| has_done(key) || self.authors.contains_key(key));
        before.chain(here).filter(move |key| *key != device)
    }

    /// Somebody chooses a name; whether it is another than before.
    pub(crate) fn name(&mut self, person: u32, name: &str) -> bool {
        self.names.insert(person, name.to_owned()).is_none_or(|before| before != name)
    }

    /// The server has a name for somebody.
    pub(crate) fn give_name(&mut self, person: u32, name: Arc<str>) {
        self.given.insert(person, name);
    }

    /// What somebody is called, also after they have left.
    pub(crate) fn called(&self, person: u32) -> Option<&str> {
        let given = || self.given.get(&person).or_else(|| self.remembered.get(&person));
        self.name_of(person).or_else(|| given().map(AsRef::as_ref))
    }

    /// What somebody has chosen to be called.
    pub(crate) fn name_of(&self, person: u32) -> Option<&str> {
        self.names.get(&person).map(String::as_str)
    }
}

/// Stands for whoever was at a device, as long as nobody has come who says who that is.
fn author_alone(device: &Principal) -> Arc<str> {
    format!("author {}", device.name()).into()
}

#[derive(Clone, Debug)]
struct Numbers<K> {
    numbers: BTreeMap<K, u32>,
    last: u32,
}

impl<K> Default for Numbers<K> {
    fn default() -> Self {
        Self { numbers: BTreeMap::new(), last: 0 }
    }
}

impl<K: Clone + Ord> Numbers<K> {
    /// Gives the number of one key to another, which has none.
    fn rename(&mut self, from: &K, to: &K) {
        if !self.numbers.contains_key(to)
            && let Some(number) = self.numbers.remove(from)
        {
            self.numbers.insert(to.clone(), number);
        }
    }

    /// The number of a key. Where too many are known, the first one that is not in use is forgotten.
    fn of(&mut self, key: &K, is_used: impl Fn(u32) -> bool) -> u32 {
        if let Some(&known) = self.numbers.get(key) {
            return known;
        }
        if self.numbers.len() >= MAX_KNOWN {
            let unused = self.numbers.iter().filter(|(_, number)| !is_used(**number));
            let oldest = unused.min_by_key(|(_, number)| **number).map(|(key, _)| key.clone());
            if let Some(oldest) = oldest {
                self.numbers.remove(&oldest);
            }
        }
        self.last = self.last.wrapping_add(1);
        self.numbers.insert(key.clone(), self.last);
        self.last
    }
}

#[cfg(test)]
mod tests {
    use espalier_proto::version::MAX_SKETCH_PLACES;

    use super::*;

    #[test]
    fn ps2_what_is_told_of_a_device_is_bounded() {
        let far = |i: usize| {
            let sign = if i.is_multiple_of(2) { 1000.0 } else { -1000.0 };
            Position::nearest(Vec3::new(sign, sign, sign))
        };
        let mut device = Presence::new(u32::MAX, 1, 0);
        device.say(Said {
            pointer: Some(Pointer::Space { position: far(0) }),
            radius: Some(BrushRadius::MOST),
            sketch: (0..MAX_SKETCH_PLACES).map(far).collect(),
            camera: Some(Camera {
                target: far(1),
                yaw: espalier_proto::Yaw::MOST,
                pitch: espalier_proto::Pitch::MOST,
                distance: espalier_proto::EyeDistance::MOST,
            }),
            ..Said::default()
        });
        device.stamp(1, 0, true);
        let mut bytes = Vec::new();
        device.news(0).expect("all of it is new").write(&mut bytes);
        assert!(bytes.len() <= 512, "{} bytes", bytes.len());
    }

    #[test]
    fn numbers_are_kept_until_there_are_too_many() {
        let mut numbers = Numbers::default();
        assert_eq!(numbers.of(&0, |_| false), 1);
        for key in 1..2 * MAX_KNOWN {
            numbers.of(&key, |number| number == 1);
        }
        assert_eq!(numbers.of(&0, |_| false), 1, "it was in use");
        assert_eq!(numbers.numbers.len(), MAX_KNOWN);
        assert!(numbers.of(&1, |_| false) > MAX_KNOWN as u32, "it was forgotten");
    }
}
