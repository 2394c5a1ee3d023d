//! Finds the `espalier` program and runs its command line to the end.

use std::{
    env,
    io::Write,
    path::PathBuf,
    process::{Command, Stdio},
};

/// What a finished run left behind.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The exit status; -1 if a signal ended it.
    pub code: i32,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// The program: named by `ESPALIER_PROGRAM`, else the one cargo put beside the tests.
pub fn path() -> PathBuf {
    if let Some(path) = env::var_os("ESPALIER_PROGRAM") {
        return path.into();
    }
    let test = env::current_exe().expect("a test knows its own path");
    let folder = test.parent().and_then(|deps| deps.parent()).expect("tests lie in target/PROFILE/deps");
    let program = folder.join("espalier");
    assert!(
        program.exists(),
        "{} is not there: run `cargo build --workspace --bins --tests`",
        program.display()
    );
    program
}

/// A command that runs the program without the environment's settings of it.
pub fn command() -> Command {
    let mut command = Command::new(path());
    for (name, _) in env::vars_os() {
        if name.to_string_lossy().starts_with("ESPALIER_") {
            command.env_remove(name);
        }
    }
    command.stdin(Stdio::null());
    command
}

/// Runs the program with these arguments until it ends.
pub fn run(arguments: &[&str]) -> Finished {
    run_with(arguments, "")
}

/// The same with something on its standard input.
pub fn run_with(arguments: &[&str], input: &str) -> Finished {
    finished(command().args(arguments), input)
}

/// Runs a command until it ends, with something on its standard input.
pub fn finished(command: &mut Command, input: &str) -> Finished {
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program starts");
    // One that does not read has closed it.
    let _ = child.stdin.take().expect("it is piped").write_all(input.as_bytes());
    let output = child.wait_with_output().expect("the program ends");
    Finished {
        code: output.status.code().unwrap_or(-1),
        stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}
