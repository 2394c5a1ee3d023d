//! One shared document: command order, undo, clients and their windows, without I/O.
//!
//! [`Session::handle`] takes what happened, [`Session::poll_output`] gives what is to be done; [`Input`] and
//! [`Output`] are the whole boundary. There is no clock, thread or socket in here: the caller hands in the
//! time. The rules kept are those of `proto/PROTOCOL.md`; comments and tests quote them by ID.

mod appearance;
mod author;
mod cause;
mod checksum;
mod clients;
mod command_script;
mod document;
mod entrant;
mod form;
mod grammars;
mod io;
mod journal;
mod obstacle;
mod prediction;
mod presence;
mod principal;
mod rights;
mod room;
mod schedule;
mod schematic;
mod session;
mod shares;
mod snapshot;
mod species_script;
mod stops;
mod stroke_pieces;
mod to_proto;
mod urgency;
mod window;
mod work;

pub use command_script::{ScriptError, read_commands};
pub use document::{
    Anchor, Document, DocumentError, Figures, LeftOut, MAX_METAMER_BUDGET, Search, TransplantError,
    Whereabouts, announced_bytes, plain,
};
pub use entrant::Entrant;
pub use form::read_command;
pub use grammars::{check_grammar, grammar_notes, grammar_script, shipped_grammar, wire_grammar};
pub use io::{ActId, AnchorId, ClientId, Input, JournalEntry, Named, Output, Place, ReadDocument, ReadId};
pub use prediction::PredictionRun;
pub use presence::Register;
pub use principal::Principal;
pub use rights::{Access, forbidden};
pub use room::HasRoom;
pub use schematic::schematic;
pub use session::{Restoring, Session, Tail};
pub use snapshot::RestoreError;
pub use species_script::{script, wire_species};
pub use to_proto::{delta, style_options, whole};
pub use urgency::Urgency;
pub use work::Work;
