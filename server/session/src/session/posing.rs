//! Poses of open bends to clients, the newest only (`BE5`).

use std::sync::Arc;

use super::Session;
use crate::{
    clients::{ConnectedClient, View},
    io::{ClientId, Output},
    work::Posed,
};

impl Session {
    /// Takes new poses in and sends them to all who can take them.
    pub(super) fn take_poses(&mut self, poses: Vec<Posed>) {
        self.poses.extend(poses.into_iter().map(|pose| (pose.bend, pose)));
        if self.poses.is_empty() {
            return;
        }
        for client in self.clients.keys().copied().collect::<Vec<_>>() {
            self.send_poses(client);
        }
        let watches = || self.clients.values().filter_map(|client| Some(&client.connected.as_ref()?.watch));
        let is_shown = |bend: u32| watches().any(|watch| watch.shown.contains_key(&bend));
        let ended: Vec<u32> = self
            .poses
            .values()
            .filter(|pose| pose.is_over && !is_shown(pose.bend))
            .map(|pose| pose.bend)
            .collect();
        ended.iter().for_each(|bend| {
            self.poses.remove(bend);
        });
    }

    /// The client has drawn poses up to this one.
    pub(super) fn received_pose(&mut self, client: ClientId, sequence: u32) {
        let Some(connected) = self.connected_mut(client) else { return };
        connected.watch.in_flight = connected.watch.in_flight.filter(|&pose| pose > sequence);
        self.send_poses(client);
    }

    /// Sends a client in step the poses it lacks, unless it has not answered the last ones. That a bend is over
    /// is said at once, for the rows have changed already.
    fn send_poses(&mut self, client: ClientId) {
        let Some(state) = self.clients.get_mut(&client) else { return };
        let Some(ConnectedClient { watch, view: View::InStep, .. }) = &mut state.connected else { return };
        let is_ready = watch.in_flight.is_none();
        for pose in self.poses.values() {
            let shown = watch.shown.get(&pose.bend).copied();
            let is_due = match shown {
                Some(shown) => shown < pose.sequence && (is_ready || pose.is_over),
                None => is_ready && !pose.is_over,
            };
            if !is_due {
                continue;
            }
            if pose.is_over {
                watch.shown.remove(&pose.bend);
            } else {
                watch.shown.insert(pose.bend, pose.sequence);
                watch.in_flight = watch.in_flight.max(Some(pose.sequence));
            }
            self.outputs.push_back(Output::Frame(client, Arc::clone(&pose.frame)));
        }
    }
}
