//! Journals, as a session is restored from them.

use espalier_session::{JournalEntry, Principal, Session};

use crate::{METAMERS, SEED, command};

/// Restores a session from lines of text: who, the number of the command, the command as JSON, with blanks between.
pub fn read(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let entries: Option<Vec<_>> = (1..).zip(text.lines()).map(|(number, line)| entry(number, line)).collect();
    let Some(entries) = entries else { return false };
    let snapshot = Session::seedling(SEED, METAMERS);
    let restore = || Session::restore("fuzzed", 1, Some(&snapshot), SEED, entries.iter().cloned());
    match (restore(), restore()) {
        (Ok(one), Ok(other)) => {
            let hash = |session: &Session| session.document().map(|document| document.hash());
            assert_eq!(hash(&one), hash(&other), "the same journal gives the same document");
            true
        }
        (one, other) => {
            assert_eq!(one.is_ok(), other.is_ok());
            false
        }
    }
}

/// All kinds of commands, by two people.
pub fn seeds() -> Vec<Vec<u8>> {
    let line = |(number, line)| format!("client-{} {} {line}\n", number % 2, number / 2 + 1);
    let all: Vec<String> = (0..).zip(command::lines()).map(line).collect();
    vec![all.concat().into_bytes(), all[..4].concat().into_bytes(), Vec::new()]
}

fn entry(number: u64, line: &str) -> Option<JournalEntry> {
    let (client, rest) = line.split_once(' ')?;
    let (id, command) = rest.split_once(' ')?;
    Some(JournalEntry {
        number,
        principal: Principal::parse(client)?,
        id: id.parse().ok()?,
        command: command.into(),
    })
}
