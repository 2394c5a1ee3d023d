//! How grown trees and plain beams are made of limbs, bend, swing and sway.

mod joints;
mod limbs;
mod shelter;
mod statics;
mod trees;
mod wind;
