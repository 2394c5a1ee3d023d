//! Clients that ask what their rows must add up to (`CK1`).

use espalier_proto::ServerMessage;

use super::Session;
use crate::{
    checksum::Checksum,
    clients::{ConnectedClient, View},
    io::ClientId,
    work::Work,
};

/// Rows are added up no more often than this, in milliseconds, for it takes as long as there are many.
const CHECK_MS: u64 = 1000;

impl Session {
    /// The client wants to compare its rows.
    pub(super) fn ask_to_check(&mut self, client: ClientId) {
        if let Some(connected) = self.connected_mut(client) {
            connected.is_checking = true;
        }
    }

    /// Has rows added up where somebody waits for that and nothing else is to be done.
    pub(super) fn ask_for_checksum(&mut self, work: &mut Work) {
        if self.now >= self.check_due && !work.is_needed() && self.is_checked() {
            work.checksum_wanted = true;
            self.check_due = self.now + CHECK_MS;
        }
    }

    /// When rows may be added up again, if somebody waits for that.
    pub(super) fn checksum_due(&self) -> Option<u64> {
        (self.home.is_some() && self.check_due > self.now && self.is_checked()).then_some(self.check_due)
    }

    /// Tells all who wait and hold all rows.
    pub(super) fn tell_checksum(&mut self, checksum: Checksum) {
        let Checksum { sequence, rows, crc32, plant } = checksum;
        let message = ServerMessage::Checksum { sequence, rows, crc32, plant: format!("{plant:016x}") };
        let mut told = Vec::new();
        for (&id, client) in &mut self.clients {
            if let Some(connected) = client.connected.as_mut().filter(|connected| waits(connected)) {
                connected.is_checking = false;
                told.push(id);
            }
        }
        for client in told {
            self.send(client, &message);
        }
    }

    fn is_checked(&self) -> bool {
        self.clients.values().filter_map(|client| client.connected.as_ref()).any(waits)
    }
}

fn waits(client: &ConnectedClient) -> bool {
    client.is_checking && matches!(client.view, View::InStep)
}
