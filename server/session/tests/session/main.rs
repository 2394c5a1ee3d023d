//! A session under virtual time, with a simulated disk, simulation pool and clients.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bending;
mod commands;
mod cutting;
mod durability;
mod filling;
mod flow;
mod futures;
mod fuzz;
mod guiding;
mod handshake;
mod hints;
mod kept;
mod limits;
mod looks;
mod mirror;
mod obstacles;
mod refusals;
mod rights;
mod rows;
mod schema;
mod shaping;
mod stopping;
mod world;
