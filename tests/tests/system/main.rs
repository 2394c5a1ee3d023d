//! The system from outside: the real program, a real socket, a real database.

mod appearance;
mod bad_input;
mod bad_peers;
mod care;
mod command_line;
mod commands;
mod crashes;
mod designs;
mod exports;
#[cfg(target_os = "linux")]
mod full_disk;
mod guiding;
mod handshake;
mod imports;
mod jobs;
mod later_programs;
mod library;
mod library_commands;
mod load;
mod logging;
mod memory;
mod obstacles;
mod people;
mod presence;
mod python;
mod removing;
mod replaying;
mod shaping;
mod shared_tree;
mod slow_clients;
mod species;
mod startup;
mod stopping;
mod upgrades;
mod users;
mod versions;
