//! Every reader of bytes from outside, and bytes that it takes.
//!
//! A reader takes any bytes at all, or refuses them; what it takes it can write and read again. `tests/short.rs` tries
//! some damage of the seeds in every run of the tests; `tests/hunt` looks for more, guided by coverage.
//!
//! Another reader: a file here with `read` and `seeds`, its line in [`TARGETS`], a program in `fuzz_targets`.

pub mod command;
pub mod document;
pub mod frame;
pub mod gltf;
pub mod grammar;
pub mod journal;
pub mod mesh;
pub mod message;
pub mod mtg;
pub mod obj;
pub mod qsm;
pub mod query;
pub mod range;
pub mod script;
pub mod section;
pub mod skeleton;
pub mod thumbnail;
mod wood;

/// A reader.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, as in `tests/hunt NAME`.
    pub name: &'static str,
    /// Reads bytes; whether they were taken.
    pub read: fn(&[u8]) -> bool,
    /// Bytes that it takes, for mutations to start from.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

/// All readers.
pub const TARGETS: [Target; 17] = [
    Target { name: "command", read: command::read, seeds: command::seeds },
    Target { name: "document", read: document::read, seeds: document::seeds },
    Target { name: "frame", read: frame::read, seeds: frame::seeds },
    Target { name: "gltf", read: gltf::read, seeds: gltf::seeds },
    Target { name: "grammar", read: grammar::read, seeds: grammar::seeds },
    Target { name: "journal", read: journal::read, seeds: journal::seeds },
    Target { name: "mesh", read: mesh::read, seeds: mesh::seeds },
    Target { name: "message", read: message::read, seeds: message::seeds },
    Target { name: "mtg", read: mtg::read, seeds: mtg::seeds },
    Target { name: "obj", read: obj::read, seeds: obj::seeds },
    Target { name: "qsm", read: qsm::read, seeds: qsm::seeds },
    Target { name: "query", read: query::read, seeds: query::seeds },
    Target { name: "range", read: range::read, seeds: range::seeds },
    Target { name: "script", read: script::read, seeds: script::seeds },
    Target { name: "section", read: section::read, seeds: section::seeds },
    Target { name: "skeleton", read: skeleton::read, seeds: skeleton::seeds },
    Target { name: "thumbnail", read: thumbnail::read, seeds: thumbnail::seeds },
];

/// A session's document may hold so many metamers, so that growth takes no time.
const METAMERS: u32 = 400;
/// The seed of all randomness.
const SEED: u32 = 7;
