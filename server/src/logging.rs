//! What the server says of itself on standard error. It is never waited for, and no fault where nobody takes it.

use std::{
    io::{self, IsTerminal, Write},
    panic,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
        mpsc::{self, Receiver, SyncSender},
    },
    thread,
    time::Duration,
};

use tracing_subscriber::{EnvFilter, fmt};

/// Lines that wait to be written; further ones are counted.
const WAITING: usize = 1024;
/// How long the last lines may take when the server ends.
const LAST_LINES: Duration = Duration::from_secs(1);

/// Writes what still waits when it is dropped.
#[derive(Debug)]
pub struct Log {
    queue: Queue,
    written: Receiver<()>,
}

/// Where lines are put.
#[derive(Clone, Debug)]
struct Queue {
    lines: SyncSender<Waiting>,
    lost: Arc<AtomicU64>,
}

#[derive(Debug)]
enum Waiting {
    Line(Box<[u8]>),
    End,
}

/// How lines are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum LogFormat {
    /// For people.
    Text,
    /// An object of JSON a line, for programs.
    Json,
}

/// Has what this filter lets through written from now on, panics as well.
///
/// # Errors
/// Those of making a thread.
pub fn start(filter: EnvFilter, format: LogFormat) -> io::Result<Log> {
    let log = Log::to(io::stderr())?;
    let queue = log.queue.clone();
    let lines = fmt()
        .with_env_filter(filter)
        .with_writer(move || queue.clone())
        // It would complain on standard error itself, and panic where that is broken.
        .log_internal_errors(false);
    match format {
        LogFormat::Text => lines.with_ansi(io::stderr().is_terminal()).init(),
        LogFormat::Json => lines.json().flatten_event(true).with_current_span(true).init(),
    }
    // The usual hook waits until somebody takes what it says.
    panic::set_hook(Box::new(|panicked| tracing::error!("{panicked}")));
    Ok(log)
}

impl Log {
    /// Lines are written there, by a thread of their own.
    fn to(mut out: impl Write + Send + 'static) -> io::Result<Self> {
        let (lines, waiting) = mpsc::sync_channel(WAITING);
        let lost = Arc::new(AtomicU64::new(0));
        let queue = Queue { lines, lost: Arc::clone(&lost) };
        let (ended, written) = mpsc::channel();
        thread::Builder::new().name("log".into()).spawn(move || {
            while let Ok(Waiting::Line(line)) = waiting.recv() {
                // Nobody is left to be told that the log cannot be written.
                let _ = out.write_all(&line);
                let lost = lost.swap(0, Ordering::Relaxed);
                if lost > 0 {
                    let _ = writeln!(out, "{lost} lines of the log were lost: nobody took them in time.");
                }
            }
            let _ = out.flush();
            drop(ended);
        })?;
        Ok(Self { queue, written })
    }
}

impl Drop for Log {
    fn drop(&mut self) {
        // Where there is no room for the end, nobody reads.
        if self.queue.lines.try_send(Waiting::End).is_ok() {
            let _ = self.written.recv_timeout(LAST_LINES);
        }
    }
}

impl Write for Queue {
    /// Takes a line as a whole.
    fn write(&mut self, line: &[u8]) -> io::Result<usize> {
        if self.lines.try_send(Waiting::Line(line.into())).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
        Ok(line.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    fn say(log: &Log, number: usize) {
        log.queue.clone().write_all(format!("{number}\n").as_bytes()).unwrap();
    }

    /// Takes a line each time it is told to.
    struct Slow {
        told: Receiver<()>,
        taken: Arc<Mutex<Vec<u8>>>,
    }

    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            // When it is told nothing any more it takes everything.
            let _ = self.told.recv();
            self.taken.lock().unwrap().extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_log_that_nobody_reads_holds_up_nobody_and_says_what_was_lost() {
        let (tell, told) = mpsc::channel();
        let taken = Arc::<Mutex<Vec<u8>>>::default();
        let log = Log::to(Slow { told, taken: Arc::clone(&taken) }).unwrap();
        let more = 100;
        for number in 0..WAITING + more {
            say(&log, number);
        }
        let lost = log.queue.lost.load(Ordering::Relaxed);
        // The writing thread may hold one line already.
        assert!([more as u64 - 1, more as u64].contains(&lost), "{lost}");
        drop(tell);
        let text = || String::from_utf8(taken.lock().unwrap().clone()).unwrap();
        while !text().contains(&format!("{lost} lines of the log were lost")) {
            thread::yield_now();
        }
        drop(log);
        assert!(text().starts_with("0\n"), "{}", text());
    }

    /// Fails always.
    struct Broken;

    impl Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
    }

    #[test]
    fn a_log_that_cannot_be_written_is_no_fault() {
        let log = Log::to(Broken).unwrap();
        for number in 0..3 * WAITING {
            say(&log, number);
        }
        drop(log);
    }
}
