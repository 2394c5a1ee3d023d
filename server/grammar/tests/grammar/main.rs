//! Grammars are read, derived and drawn; what cannot be is told.

mod bombs;
mod borrowed;
mod chance;
mod documented;
mod environment;
mod hostile;
mod library;
mod limits;
mod mistakes;
mod textbook;
mod timing;
mod trees;
mod words;
