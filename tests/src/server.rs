//! A real server process with a database file of its own.

use std::{
    env, fs,
    io::{BufRead, BufReader, Read},
    path::{Path, PathBuf},
    process::{Child, ChildStderr, Command, ExitStatus, Stdio},
    sync::{Arc, Mutex, PoisonError, mpsc},
    thread,
    time::{Duration, Instant},
};

use serde_json::{Value, json};

use crate::{http, program};

/// Longer than anything takes on a busy machine; it only keeps a test from hanging.
pub const GUARD: Duration = Duration::from_secs(60);

/// How often a test kills its server: as often as `ESPALIER_KILLS` says, else so often.
///
/// # Panics
/// If the variable is no number.
pub fn kills(else_so_often: usize) -> usize {
    env::var("ESPALIER_KILLS")
        .map_or(else_so_often, |kills| kills.parse().expect("ESPALIER_KILLS is a number"))
}

/// A running server; dropping it kills it.
#[derive(Debug)]
pub struct Server {
    child: Child,
    port: u16,
    database: PathBuf,
    printed: Arc<Mutex<String>>,
    /// Standard error, where nobody reads it.
    _unread: Option<ChildStderr>,
}

/// Who reads what a server writes to standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Readers {
    /// It is read and kept.
    Some,
    /// The other end is open, and nobody reads there.
    Asleep,
    /// The other end is closed.
    Gone,
}

impl Server {
    /// Starts a server on a free port of this machine.
    pub fn start(database: &Path) -> Self {
        Self::start_on(database, 0)
    }

    /// Starts a server on this port.
    pub fn start_on(database: &Path, port: u16) -> Self {
        Self::start_with(database, port, &[])
    }

    /// Starts a server with more options.
    pub fn start_with(database: &Path, port: u16, options: &[&str]) -> Self {
        Self::start_before(Readers::Some, database, port, options)
    }

    /// Starts a server on a free port of this machine, with more in its environment.
    pub fn start_in(environment: &[(&str, PathBuf)], database: &Path) -> Self {
        let mut command = program::command();
        command.envs(environment.iter().map(|(name, value)| (name, value)));
        Self::start_by(command, Readers::Some, database, 0, &[])
    }

    /// The same where standard error is read, or not.
    pub fn start_before(readers: Readers, database: &Path, port: u16, options: &[&str]) -> Self {
        Self::start_by(program::command(), readers, database, port, options)
    }

    fn start_by(
        mut command: Command,
        readers: Readers,
        database: &Path,
        port: u16,
        options: &[&str],
    ) -> Self {
        let mut child = command
            .args(["serve", "--host", "127.0.0.1", "--port", &port.to_string(), "--database"])
            .arg(database)
            .args(options)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let printed = Arc::new(Mutex::new(String::new()));
        let (found, address) = mpsc::channel();
        let stdout = child.stdout.take().expect("standard output is piped");
        let stderr = child.stderr.take().expect("standard error is piped");
        collect(stdout, Arc::clone(&printed), found.clone());
        let unread = match readers {
            Readers::Some => {
                collect(stderr, Arc::clone(&printed), found);
                None
            }
            Readers::Asleep => Some(stderr),
            Readers::Gone => None,
        };
        let port = match address.recv_timeout(GUARD) {
            Ok(port) => port,
            Err(_) => {
                // Whether it is killed matters less than what it said.
                let _ = child.kill();
                let said = printed.lock().unwrap_or_else(PoisonError::into_inner);
                panic!("the server printed no address:\n{said}");
            }
        };
        let server = Self { child, port, database: database.to_owned(), printed, _unread: unread };
        let started = Instant::now();
        while !http::get(port, "/health").is_ok_and(|answer| answer.status == 200) {
            assert!(started.elapsed() < GUARD, "the server does not answer:\n{}", server.printed());
            thread::sleep(Duration::from_millis(20));
        }
        server
    }

    /// The port it listens on.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// All it has printed so far.
    pub fn printed(&self) -> String {
        self.printed.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// A new session with this seed; returns its name.
    pub fn new_session(&self, seed: u32) -> String {
        let answer = http::send(self.port, "POST", "/api/v1/sessions", Some(&json!({ "seed": seed })))
            .expect("the server answers");
        assert_eq!(answer.status, 201, "{}", answer.text());
        let body: Value = serde_json::from_slice(&answer.body).expect("the answer is JSON");
        body["session"].as_str().expect("the answer names the session").to_owned()
    }

    /// Kills it as a power cut would, and starts it again on the same port and database.
    pub fn kill_and_restart(self) -> Self {
        let (port, database) = (self.port, self.database.clone());
        self.kill();
        Self::start_on(&database, port)
    }

    /// Kills it as a power cut would.
    pub fn kill(mut self) {
        self.child.kill().expect("a child can be killed");
        self.child.wait().expect("a child can be waited for");
    }

    /// Asks it to stop, and waits until it has.
    pub fn terminate(mut self) -> ExitStatus {
        let asked = Command::new("kill").args(["-TERM", &self.child.id().to_string()]).status();
        assert!(asked.is_ok_and(|status| status.success()), "SIGTERM can be sent");
        let started = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().expect("a child can be waited for") {
                return status;
            }
            assert!(started.elapsed() < GUARD, "the server does not stop:\n{}", self.printed());
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// Resident memory in bytes, as the kernel counts it.
    pub fn resident_bytes(&self) -> u64 {
        self.status("VmRSS:")
    }

    /// The most resident memory in bytes since [`Server::forget_peak`].
    pub fn peak_bytes(&self) -> u64 {
        self.status("VmHWM:")
    }

    /// The peak of resident memory begins anew.
    pub fn forget_peak(&self) {
        fs::write(self.told_by_kernel("clear_refs"), "5").expect("Linux has clear_refs");
    }

    /// Processor time taken so far, by all threads, in steps of a hundredth of a second.
    pub fn processor_time(&self) -> Duration {
        let stat = fs::read_to_string(self.told_by_kernel("stat")).expect("Linux has /proc");
        // The program's name, in brackets, may hold spaces.
        let fields =
            stat.rsplit_once(')').map(|(_, fields)| fields.split_whitespace()).expect("a process has a name");
        let hundredths: u64 = fields.skip(11).take(2).map(|ticks| ticks.parse().unwrap_or(0)).sum();
        Duration::from_millis(hundredths * 10)
    }

    fn status(&self, row: &str) -> u64 {
        let status = fs::read_to_string(self.told_by_kernel("status")).expect("Linux has /proc");
        let line = status.lines().find(|line| line.starts_with(row)).expect("a process has memory");
        let kilobytes: u64 =
            line.split_whitespace().nth(1).and_then(|n| n.parse().ok()).expect("it is a number");
        kilobytes * 1024
    }

    fn told_by_kernel(&self, what: &str) -> PathBuf {
        PathBuf::from(format!("/proc/{}/{what}", self.child.id()))
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Keeps what the server prints, and sends on the port of the first address in it.
fn collect(from: impl Read + Send + 'static, printed: Arc<Mutex<String>>, found: mpsc::Sender<u16>) {
    thread::spawn(move || {
        for line in BufReader::new(from).lines().map_while(Result::ok) {
            if let Some(port) = port_of(&line) {
                // Only the first address is waited for.
                let _ = found.send(port);
            }
            let mut printed = printed.lock().unwrap_or_else(PoisonError::into_inner);
            printed.push_str(&line);
            printed.push('\n');
        }
    });
}

fn port_of(line: &str) -> Option<u16> {
    let (_, address) = line.split_once("http://")?;
    let (_, port) = address.split_once(':')?;
    let digits: String = port.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok()
}
