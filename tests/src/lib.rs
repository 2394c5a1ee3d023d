//! The system from outside: what the tests need to start the real program and to talk to it as a client does.
//!
//! Nothing here knows how the server works; it knows the wire, the command line and the operating system.

pub mod client;
pub mod dice;
#[cfg(target_os = "linux")]
pub mod full_disk;
pub mod http;
pub mod program;
pub mod scratch;
pub mod server;
pub mod strokes;
pub mod table;
pub mod tls;
