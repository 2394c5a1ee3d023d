//! Limbs that grew, to those who look at one (`DS13`).

use espalier_proto::{LimbOutline, ServerMessage};

use super::Session;
use crate::{document::Document, io::ClientId};

/// A limb that a client asks for.
#[derive(Debug)]
pub(crate) struct AskedLimb {
    row: u32,
    /// What was found, once the document was at home.
    found: Option<Option<Box<LimbOutline>>>,
}

impl Session {
    /// A client looks at the limb that a row lies on. What it asked for before is not told any more.
    pub(super) fn look_at_limb(&mut self, client: ClientId, row: u32) {
        let Some(connected) = self.connected_mut(client) else { return };
        connected.asked_limb = Some(AskedLimb { row, found: None });
        if let Some(mut work) = self.home.take() {
            self.find_limbs(&mut work.document);
            self.home = Some(work);
        }
    }

    /// Finds the limbs that were asked for.
    pub(super) fn find_limbs(&mut self, document: &mut Document) {
        for connected in self.clients.values_mut().filter_map(|client| client.connected.as_mut()) {
            if let Some(AskedLimb { row, found: found @ None }) = &mut connected.asked_limb {
                *found = Some(document.limb_at(*row).map(Box::new));
            }
        }
    }

    /// Tells what has been found, once.
    pub(super) fn tell_limbs(&mut self) {
        let mut messages = Vec::new();
        for (&id, client) in &mut self.clients {
            let asked = client.connected.as_mut().map(|connected| &mut connected.asked_limb);
            let told = asked.and_then(|asked| asked.take_if(|asked| asked.found.is_some()));
            if let Some(AskedLimb { row, found: Some(limb) }) = told {
                messages.push((id, ServerMessage::Limb { of: row, limb }));
            }
        }
        for (client, message) in messages {
            self.send(client, &message);
        }
    }
}
