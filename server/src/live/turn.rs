//! What the simulation pool knows of a session's work.

use std::sync::Arc;

use espalier_session::{Urgency, Work};

use crate::pool::{Class, Person};

/// Whose turn on the pool a slice of work is.
pub(super) fn turn_of(work: &Work) -> (Class, Person) {
    let class = match work.urgency() {
        Urgency::Drawing => Class::Drawing,
        // What is read of an open tree keeps the next stroke from it, so it does not wait for what is long.
        Urgency::Growing | Urgency::Keeping => Class::Growing,
    };
    (class, work.whose().map_or_else(Person::default, Arc::clone))
}

#[cfg(test)]
mod tests {
    use espalier_proto::{access::Role, version::PROTOCOL_VERSION};
    use espalier_session::{ClientId, Entrant, Input, Output, ReadId, Session};

    use super::*;

    /// Work of a command that somebody gives with a client key.
    fn work_of(entrant: Entrant, key: &str) -> Box<Work> {
        let mut session = Session::restore("oak", 1, None, 7, []).unwrap();
        session.handle(0, Input::Connected(ClientId(1), entrant));
        let hello = format!(r#"{{"type":"hello","protocol":{PROTOCOL_VERSION},"client":"{key}"}}"#);
        session.handle(0, Input::Text(ClientId(1), hello));
        let grow = r#"{"type":"command","id":1,"command":{"kind":"grow","steps":1}}"#;
        let worked = |session: &mut Session| {
            let mut outputs = std::iter::from_fn(|| session.poll_output());
            outputs.find_map(|output| if let Output::Work(work) = output { Some(work) } else { None })
        };
        // What they are shown first.
        if let Some(mut shown) = worked(&mut session) {
            shown.run(|| false);
            session.handle(0, Input::Worked(shown));
        }
        session.handle(0, Input::Text(ClientId(1), grow.into()));
        worked(&mut session).unwrap()
    }

    #[test]
    fn who_comes_with_many_keys_has_one_turn() {
        let turn = |entrant: Entrant, key: &str| turn_of(&work_of(entrant, key)).1;
        let bo = || Entrant::new("user Bo", Role::Editor);
        assert_eq!(turn(bo(), "bo-tablet"), turn(bo(), "bo-phone"));
        assert_ne!(turn(bo(), "bo-tablet"), turn(Entrant::new("user Ann", Role::Editor), "bo-tablet"));
        // Nobody knows who is at the machine itself.
        let machine = || Entrant { is_anybody: true, ..Entrant::new("machine", Role::Admin) };
        assert_ne!(turn(machine(), "page-one"), turn(machine(), "page-two"));
        assert_eq!(turn(machine(), "page-one"), turn(machine(), "page-one"));
    }

    #[test]
    fn what_is_read_of_an_open_tree_waits_for_nothing_long() {
        let mut session = Session::restore("oak", 1, None, 7, []).unwrap();
        session.handle(0, Input::Read(ReadId(1)));
        let mut outputs = std::iter::from_fn(|| session.poll_output());
        let work = outputs.find_map(|output| if let Output::Work(work) = output { Some(work) } else { None });
        let work = work.unwrap();
        assert_eq!(work.urgency(), Urgency::Keeping);
        assert_eq!(turn_of(&work).0, Class::Growing);
    }
}
