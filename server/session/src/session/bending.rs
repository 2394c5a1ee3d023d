//! Frames of open bends to clients, the newest only (`BE5`).

use std::sync::Arc;

use super::Session;
use crate::{
    clients::{ConnectedClient, View},
    io::{ClientId, Output},
    work::BendUpdate,
};

impl Session {
    /// Takes new frames in and sends them to all who can take them.
    pub(super) fn take_bend_updates(&mut self, bends: Vec<BendUpdate>) {
        self.bends.extend(bends.into_iter().map(|update| (update.bend, update)));
        if self.bends.is_empty() {
            return;
        }
        for client in self.clients.keys().copied().collect::<Vec<_>>() {
            self.send_bend_frames(client);
        }
        let watches = || self.clients.values().filter_map(|client| Some(&client.connected.as_ref()?.watch));
        let is_shown = |bend: u32| watches().any(|watch| watch.shown.contains_key(&bend));
        let ended: Vec<u32> = self
            .bends
            .values()
            .filter(|update| update.is_over && !is_shown(update.bend))
            .map(|update| update.bend)
            .collect();
        ended.iter().for_each(|bend| {
            self.bends.remove(bend);
        });
    }

    /// The client has drawn the frames up to this one.
    pub(super) fn received_bend_frame(&mut self, client: ClientId, sequence: u32) {
        let Some(connected) = self.connected_mut(client) else { return };
        connected.watch.in_flight = connected.watch.in_flight.filter(|&waiting| waiting > sequence);
        self.send_bend_frames(client);
    }

    /// Sends a client in step the frames it lacks, unless it has not answered the last ones. That a bend is over
    /// is said at once, for the rows have changed already.
    fn send_bend_frames(&mut self, client: ClientId) {
        let Some(state) = self.clients.get_mut(&client) else { return };
        let Some(ConnectedClient { watch, view: View::InStep, .. }) = &mut state.connected else { return };
        let is_ready = watch.in_flight.is_none();
        for update in self.bends.values() {
            let shown = watch.shown.get(&update.bend).copied();
            let is_due = match shown {
                Some(shown) => shown < update.sequence && (is_ready || update.is_over),
                None => is_ready && !update.is_over,
            };
            if !is_due {
                continue;
            }
            if update.is_over {
                watch.shown.remove(&update.bend);
            } else {
                watch.shown.insert(update.bend, update.sequence);
                watch.in_flight = watch.in_flight.max(Some(update.sequence));
            }
            self.outputs.push_back(Output::Frame(client, Arc::clone(&update.frame)));
        }
    }
}
