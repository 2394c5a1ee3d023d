//! Commands as JSON: on the wire, in the journal, and in the scripts of `espalier replay`.

use espalier_session::read_command;

/// One of each kind.
const COMMANDS: &str = include_str!("../seeds/commands.jsonl");

/// Reads one command; a refusal says why.
pub fn read(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    match read_command(text) {
        Ok(_) => true,
        Err(problem) => {
            assert!(!problem.message.is_empty(), "a refusal without a sentence: {problem:?}");
            false
        }
    }
}

/// One command of each kind.
pub fn seeds() -> Vec<Vec<u8>> {
    lines().map(|line| line.as_bytes().to_vec()).collect()
}

/// The same as text.
pub(crate) fn lines() -> impl Iterator<Item = &'static str> {
    COMMANDS.lines()
}
