//! Scripts of the command line.

use espalier_session::read_commands;

use crate::command;

/// Reads a script; what it says is wrong names a line of it.
pub fn read(bytes: &[u8]) -> bool {
    match read_commands("script", bytes) {
        Ok(commands) => {
            assert!(commands.is_sorted_by(|(one, _), (other, _)| one < other));
            true
        }
        Err(error) => {
            assert!((1..=bytes.split(|&byte| byte == b'\n').count()).contains(&error.line), "{error}");
            false
        }
    }
}

/// All kinds of commands; one line between empty ones; nothing.
pub fn seeds() -> Vec<Vec<u8>> {
    let all: Vec<&str> = command::lines().collect();
    vec![all.join("\n").into_bytes(), format!("\n\r\n{}\n\n", all[0]).into_bytes(), Vec::new()]
}
