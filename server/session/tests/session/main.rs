//! A session under virtual time, with a simulated disk, simulation pool and clients.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bending;
mod checking;
mod commands;
mod comments;
mod covering;
mod cutting;
mod deeds;
#[expect(dead_code, reason = "the bench alone prints them, and learns")]
#[path = "../../benches/delta_bytes.rs"]
mod delta_bytes;
mod designing;
mod durability;
mod faults;
mod filling;
mod finishing;
mod five_people;
mod flow;
#[expect(dead_code, reason = "the bench alone prints all columns")]
#[path = "../../benches/guidance/following.rs"]
mod following;
mod futures;
mod fuzz;
mod grammar_surroundings;
mod grammars;
mod guiding;
mod handshake;
mod hints;
mod kept;
mod limits;
mod looks;
mod mirror;
mod obstacles;
#[expect(dead_code, reason = "the bench alone prints all columns")]
#[path = "../../benches/guidance/overlaps.rs"]
mod overlaps;
mod pausing;
mod presence;
mod refusals;
mod replaying;
mod rights;
mod rows;
mod schema;
#[path = "../../benches/guidance/shapes.rs"]
mod shapes;
mod shaping;
mod stopping;
mod turns;
mod world;
