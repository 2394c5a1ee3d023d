//! Grammars are read, derived and drawn; what cannot be is told.

mod textbook;
mod words;
