//! L-systems: grammars that write plants.
//!
//! [`Grammar`] is a text that has been read, [`Program`] the same with values for its sliders. A [`Derivation`] rewrites
//! all modules of its [`Word`] step by step, a slice at a time if that is wanted, and [`Derivation::draw`] has a turtle
//! read the word as [wood](espalier_plant::Wood), of which growth makes a plant as of wood from any file.
//!
//! A grammar is data: it has no statements, everything that it may take is [bounded](Limits), and what ends a
//! derivation leaves the step before. Each module has a key that it keeps while it goes on, and its chance hangs on
//! that key: what happens in one branch changes nothing in another. Lengths are in internodes, Y is up.

mod code;
mod contexts;
mod derivation;
mod diagnostic;
mod environment;
mod expression;
mod foreign;
mod functions;
mod grammar;
mod headers;
#[cfg(test)]
mod highlighting_tests;
mod keys;
mod library;
mod limits;
mod parser;
mod pieces;
mod producing;
mod program;
mod reading;
mod review;
mod rules;
mod source;
mod strings;
mod symbols;
mod turtle;
mod wood;
mod word;
mod wording;

pub use derivation::{Derivation, Place, Progress};
pub use diagnostic::{Diagnostic, MAX_DIAGNOSTICS, Severity};
pub use environment::{Environment, OpenSky, Stand};
pub use grammar::{Buds, Checked, Grammar, MAX_TEXT, Radii, Slider};
pub use library::{SHIPPED, Shipped};
pub use limits::{Limits, MOST_OF_ONE, Stop};
pub use program::{BadValue, Program};
pub use wood::{Drawing, Drawn, WoodOptions};
pub use word::Word;
pub use wording::{WORDINGS, Wording};
