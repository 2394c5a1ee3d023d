//! Designs from outside: what edits do to values, and what wood follows.
#![allow(clippy::disallowed_methods, reason = "expected figures are compared within a tolerance")]

mod documented;
mod edits;
mod files;
mod fitting;
mod generation;
mod hands;
mod identity;
mod lives;
mod refusals;
mod resolution;
mod said;
mod shells;
mod templates;
