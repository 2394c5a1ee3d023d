//! Where branches of the design stand, to those who look at one (`DS8`).

use espalier_proto::{BranchPath, PlacedBranch, ServerMessage};

use super::Session;
use crate::{document::Document, io::ClientId};

/// The branch that a client looks at.
#[derive(Debug)]
pub(crate) struct LookedAt {
    of: BranchPath,
    found: Found,
}

/// What is known of the places of branches.
#[derive(Debug)]
enum Found {
    /// They are to be found when the document is at home.
    No,
    /// They are to be told.
    New(Vec<PlacedBranch>),
    /// The client has them.
    Told,
}

impl Session {
    /// A client looks at a branch, or at none any more.
    pub(super) fn look_at_branch(&mut self, client: ClientId, of: Option<BranchPath>) {
        let Some(connected) = self.connected_mut(client) else { return };
        connected.looked_at = of.map(|of| LookedAt { of, found: Found::No });
        if let Some(mut work) = self.home.take() {
            self.find_branches(&mut work.document);
            self.home = Some(work);
        }
    }

    /// What is known of their places holds no longer.
    pub(super) fn branches_changed(&mut self) {
        for connected in self.clients.values_mut().filter_map(|client| client.connected.as_mut()) {
            if let Some(looked_at) = &mut connected.looked_at {
                looked_at.found = Found::No;
            }
        }
    }

    /// Finds the places that are to be told.
    pub(super) fn find_branches(&mut self, document: &mut Document) {
        for connected in self.clients.values_mut().filter_map(|client| client.connected.as_mut()) {
            if let Some(LookedAt { of, found: found @ Found::No }) = &mut connected.looked_at {
                *found = Found::New(document.branches_around(of));
            }
        }
    }

    /// Tells what has been found and not been told. What a client asks for while the document is away waits until it is at
    /// home.
    pub(super) fn tell_branches(&mut self) {
        let mut messages = Vec::new();
        for (&id, client) in &mut self.clients {
            let looked_at = client.connected.as_mut().and_then(|connected| connected.looked_at.as_mut());
            if let Some(LookedAt { of, found }) = looked_at
                && let Found::New(_) = found
                && let Found::New(branches) = std::mem::replace(found, Found::Told)
            {
                messages.push((id, ServerMessage::Branches { of: of.clone(), branches }));
            }
        }
        for (client, message) in messages {
            self.send(client, &message);
        }
    }
}
