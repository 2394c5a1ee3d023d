//! Commands from outside: from people who upload, not over a client's socket.

use espalier_proto::{Command, PlacedObstacle, Problem, Reason};

use super::Session;
use crate::{
    entrant::Entrant,
    io::{ActId, Output},
    principal::Principal,
    rights::Access,
};

/// A command from outside whose answer is owed.
#[derive(Debug)]
pub(super) struct Act {
    id: ActId,
    /// Its journal entry.
    entry: u64,
    outcome: Option<Result<Option<PlacedObstacle>, Problem>>,
}

impl Session {
    /// Takes a command from outside into the order.
    pub(super) fn act(&mut self, id: ActId, principal: &Principal, by: &Entrant, command: Command) {
        let checked = if self.is_key_of_another(principal, &by.identity) {
            let message = "This client key is somebody else's.";
            Err(Problem::new(Reason::Forbidden, message).at("espalier-client", "a client key of one's own"))
        } else {
            self.check(Access::Edit, principal, command)
        };
        match checked {
            Ok((command, text)) => {
                let entry = self.accept(principal, 0, command, text, Some(id));
                self.acts.push(Act { id, entry, outcome: None });
            }
            Err(problem) => self.outputs.push_back(Output::Acted { act: id, outcome: Err(problem) }),
        }
    }

    /// The document has done, or refused, a command from outside.
    pub(super) fn act_done(&mut self, id: ActId, outcome: Result<Option<PlacedObstacle>, Problem>) {
        if let Some(act) = self.acts.iter_mut().find(|act| act.id == id) {
            act.outcome = Some(outcome);
        }
    }

    /// Answers what is both done and durable.
    pub(super) fn answer_acts(&mut self) {
        let durable = self.journal.durable();
        let answered = |act: &mut Act| act.outcome.is_some() && act.entry <= durable;
        for act in self.acts.extract_if(.., answered) {
            let outcome = act.outcome.unwrap_or(Ok(None));
            self.outputs.push_back(Output::Acted { act: act.id, outcome });
        }
    }
}
