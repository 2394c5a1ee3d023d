//! What the simulation pool knows of a session's work.

use espalier_session::{Urgency, Work};

use crate::pool::{Class, Person};

/// Whose turn on the pool a slice of work is.
pub(super) fn turn_of(work: &Work) -> (Class, Person) {
    let class = match work.urgency() {
        Urgency::Drawing => Class::Drawing,
        Urgency::Growing => Class::Growing,
        Urgency::Keeping => Class::Whole,
    };
    (class, work.whose().map_or_else(Person::default, |person| person.name().into()))
}
