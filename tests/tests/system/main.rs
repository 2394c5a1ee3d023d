//! The system from outside: the real program, a real socket, a real database.

mod appearance;
mod bad_input;
mod care;
mod command_line;
mod commands;
mod crashes;
mod exports;
mod guiding;
mod handshake;
mod imports;
mod jobs;
mod later_programs;
mod library;
mod library_commands;
mod logging;
mod obstacles;
mod people;
mod python;
mod shaping;
mod shared_tree;
mod slow_clients;
mod species;
mod startup;
mod upgrades;
mod users;
mod versions;
