//! Grammars are read, derived and drawn; what cannot be is told.

mod bombs;
mod borrowed;
mod chance;
mod documented;
mod environment;
mod foreign;
mod hostile;
mod library;
mod limits;
mod mistakes;
mod organs;
mod reference;
mod textbook;
mod timing;
mod trees;
mod words;
