//! Scripts: one command in JSON on each line.

use espalier_proto::{Command, Problem};

use crate::form::read_command;

/// A line that cannot be read or done.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} line {line}: {problem}")]
pub struct ScriptError {
    /// The script, as it was given.
    pub name: String,
    /// Which line, from 1.
    pub line: usize,
    /// Why.
    pub problem: Box<Problem>,
}

/// The commands of a script, each with its line; empty lines are none.
///
/// # Errors
///
/// A line is no command.
pub fn read_commands(name: &str, bytes: &[u8]) -> Result<Vec<(usize, Command)>, ScriptError> {
    let numbered = (1..).zip(bytes.split(|&byte| byte == b'\n'));
    numbered
        .filter(|(_, line)| !line.trim_ascii().is_empty())
        .map(|(line, bytes)| match read_command(&String::from_utf8_lossy(bytes)) {
            Ok(command) => Ok((line, command)),
            Err(problem) => Err(ScriptError { name: name.to_owned(), line, problem: Box::new(problem) }),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use espalier_proto::Action;

    use super::*;

    #[test]
    fn empty_lines_count_but_do_nothing() {
        let script =
            read_commands("s", b"\n{\"kind\":\"undo\"}\r\n  \n{\"kind\":\"redo\"}").expect("a script");
        assert_eq!(script, [(2, Action::Undo {}.into()), (4, Action::Redo {}.into())]);
        assert_eq!(read_commands("s", b""), Ok(vec![]));
        assert_eq!(read_commands("s", b"{\"kind\":\"undo\"}\n\xff").expect_err("no script").line, 2);
    }

    #[test]
    fn an_error_names_line_field_and_range() {
        let sample = |radius| format!("{{\"position\":[0,1,0],\"radius\":{radius}}}");
        let samples = [sample(1), sample(2), sample(3), sample(99)].join(",");
        let text = format!(
            "{{\"kind\":\"stroke_begin\",\"stroke\":1}}\n{{\"kind\":\"stroke_move\",\"stroke\":1,\"samples\":[{samples}]}}"
        );
        let error = read_commands("script.jsonl", text.as_bytes()).expect_err("no script");
        assert_eq!(error.to_string(), "script.jsonl line 2: samples[3].radius is 99; allowed: 0 to 40");
    }

    #[test]
    fn what_is_no_command_is_an_error() {
        for bad in [
            "{",
            "[]",
            "undo",
            "{\"kind\":\"dig\"}",
            "{\"kind\":\"grow\",\"steps\":-1}",
            "{\"kind\":\"undo\"} x",
        ] {
            let error = read_commands("s", bad.as_bytes()).expect_err("no script");
            assert!(error.to_string().starts_with("s line 1: "), "{error}");
        }
    }
}
