//! Branches that are bent by touches.

mod bad_input;
mod golden;
mod pose;
mod reversal;
mod shapes;
