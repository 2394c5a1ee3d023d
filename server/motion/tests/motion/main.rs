//! How grown trees and plain beams are made of limbs, bend, swing and sway.

mod answers;
mod bodies;
mod flutter;
mod golden;
mod gusts;
mod hostile;
mod joints;
mod limbs;
mod poses;
mod rigs;
mod shelter;
mod statics;
mod sway;
mod trees;
mod wind;
