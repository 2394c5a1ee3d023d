//! Comments as far as a session knows them: where their pins are now, and that they have changed (`CT`).

use std::collections::BTreeMap;

use espalier_proto::{ServerMessage, comment::Pin};
use glam::Vec3;

use super::Session;
use crate::{
    document::{Anchor, Search},
    io::{AnchorId, ClientId, Output, Place},
};

/// The pins of a session's tree.
#[derive(Debug, Default)]
pub(super) struct Pins {
    /// By their threads, with where they were when they were made.
    anchors: BTreeMap<u32, (Anchor, Vec3)>,
    /// As clients have them.
    told: BTreeMap<u32, Pin>,
    /// The document or the pins are others than when they were told.
    is_due: bool,
    asked: Vec<(AnchorId, u32)>,
}

impl Pins {
    pub(super) fn told(&self) -> impl Iterator<Item = Pin> {
        self.told.values().copied()
    }
}

impl Session {
    /// These are all pins from now on.
    pub(super) fn pin(&mut self, places: Vec<Place>) {
        let pins = &mut self.pins;
        pins.anchors =
            places.into_iter().map(|Place { thread, anchor, at }| (thread, (anchor, at))).collect();
        pins.told.retain(|thread, _| pins.anchors.contains_key(thread));
        pins.is_due = true;
    }

    /// Somebody wants to pin a thread to a row.
    pub(super) fn ask_anchor(&mut self, id: AnchorId, row: u32) {
        self.pins.asked.push((id, row));
    }

    /// Threads have changed: whoever shows them reads them again.
    pub(super) fn threads_changed(&mut self, threads: Vec<u32>) {
        if threads.is_empty() {
            return;
        }
        self.broadcast(&ServerMessage::ThreadsChanged { threads });
    }

    /// The document has changed.
    pub(super) fn unsettle_pins(&mut self) {
        self.pins.is_due = true;
    }

    /// Tells somebody who has come where all pins are.
    pub(super) fn show_pins(&mut self, client: ClientId) {
        let pins: Vec<Pin> = self.pins.told().collect();
        if !pins.is_empty() {
            self.send(client, &ServerMessage::Pins { pins });
        }
    }

    /// Finds the pins, where the document is here.
    pub(super) fn find_pins(&mut self) {
        let Some(work) = &self.home else { return };
        for (id, row) in std::mem::take(&mut self.pins.asked) {
            self.outputs.push_back(Output::Anchored(id, work.document.anchor(row)));
        }
        if !std::mem::take(&mut self.pins.is_due) || self.pins.anchors.is_empty() {
            return;
        }
        // What lies on no known line is looked for once growth rests, for that takes a pass over the tree.
        let is_resting = self.figures.pending_steps == 0;
        let search = if is_resting { Search::Everywhere } else { Search::KnownPlaces };
        let mut changed = Vec::new();
        let anchors = self.pins.anchors.values().map(|(anchor, place)| (anchor, *place));
        let all = work.document.whereabouts(anchors, search);
        for (&thread, found) in self.pins.anchors.keys().zip(all) {
            let (state, row, step, line) = (found.state, found.row, found.step, found.line);
            let pin = Pin { thread, state, row, step, line };
            if self.pins.told.insert(thread, pin) != Some(pin) {
                changed.push(pin);
            }
        }
        if !changed.is_empty() {
            self.broadcast(&ServerMessage::Pins { pins: changed });
        }
    }
}
