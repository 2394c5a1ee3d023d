//! What the simulation pool knows of a session's work.

use espalier_session::{Urgency, Work};

use crate::pool::{Class, Person};

/// Whose turn on the pool a slice of work is.
pub(super) fn turn_of(work: &Work) -> (Class, Person) {
    let class = match work.urgency() {
        Urgency::Drawing => Class::Drawing,
        // What is read of an open tree keeps the next stroke from it, so it does not wait for what is long.
        Urgency::Growing | Urgency::Keeping => Class::Growing,
    };
    (class, work.whose().map_or_else(Person::default, |person| person.name().into()))
}

#[cfg(test)]
mod tests {
    use espalier_session::{Input, Output, ReadId, Session};

    use super::*;

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
