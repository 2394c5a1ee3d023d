//! Branches that are bent by touches.

mod bad_input;
mod golden;
mod reversal;
mod shapes;
mod solution;
