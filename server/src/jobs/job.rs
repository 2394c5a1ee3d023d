//! A job: what was asked for, how far it is, and how a tree of it is made.

use std::{
    fs::{self, File},
    io::{self, ErrorKind, Read},
    path::{Path, PathBuf},
    sync::{
        Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU32, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use espalier_export::ExportError;
use espalier_growth::species::Species;
use espalier_proto::{Command, Problem, Reason};
use espalier_session::{Document, LeftOut, Principal};
use tempfile::TempDir;
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::{BYTES_OF_ONE, KEPT, MOST_BYTES};
use crate::{
    access::Caller,
    document::{self, FileError},
    export_options::ExportOptions,
    formats::{self, FormatRow},
    memory::{self, Claim, Memory, Need, Use},
    pool::{Class, Person, SimulationPool},
    recipe::{Gardener, GrowError, Recipe},
    spool::Spool,
    time::now,
};

/// Bytes read from the disk at once.
const PIECE: usize = 256 * 1024;
/// How long a tree waits for memory before it is given up,
const ROOM_PATIENCE: Duration = Duration::from_mins(1);
/// and how often it asks.
const ROOM_PAUSE: Duration = Duration::from_millis(200);

/// What is to be grown, and written.
#[derive(Clone, Debug)]
pub struct Order {
    /// Who ordered it.
    pub by: Caller,
    /// How each tree grows.
    pub recipe: Recipe,
    /// The seed of each.
    pub seeds: Vec<u32>,
    /// The species that it is one of.
    pub species: Option<&'static Species>,
    /// The format of the files.
    pub row: &'static FormatRow,
    /// Its options.
    pub options: ExportOptions,
    /// What of the tree that they are like they are without.
    pub left_out: LeftOut,
}

/// Where a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Others come first.
    Waiting,
    /// Under way.
    Growing,
    /// Every seed has its file or its problem.
    Done,
    /// It ended before.
    Failed,
}

/// A tree that has its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grown {
    /// Its seed.
    pub seed: u32,
    /// Living metamers.
    pub metamers: u32,
    /// Bytes of the file.
    pub bytes: u64,
    /// CRC-32 of the file.
    pub sum: u32,
}

/// How far a job is.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Where it is.
    pub state: State,
    /// What it made.
    pub grown: Vec<Grown>,
    /// What it could not make.
    pub failed: Vec<(u32, Problem)>,
    /// Why it ended before it was done.
    pub problem: Option<Problem>,
    /// The seed under way.
    pub seed: Option<u32>,
    /// When it is old.
    pub(super) gone_at: Option<Instant>,
}

impl Progress {
    /// Seeds that are done with.
    fn tried(&self) -> usize {
        self.grown.len() + self.failed.len()
    }
}

/// A job.
#[derive(Debug)]
pub struct Job {
    /// What was asked for.
    pub order: Order,
    /// Later ones have larger numbers.
    pub number: u64,
    /// When it was ordered.
    pub ordered_at: String,
    given_up: CancellationToken,
    progress: Mutex<Progress>,
    /// Taken where the job is given up.
    folder: Mutex<Option<TempDir>>,
    metamers: AtomicU32,
    written: watch::Sender<u64>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Job {
    /// A job that waits. Its files lie in the folder; it is given up with `stop`.
    pub(super) fn new(order: Order, number: u64, folder: TempDir, stop: &CancellationToken) -> Self {
        Self {
            order,
            number,
            ordered_at: now(),
            given_up: stop.child_token(),
            progress: Mutex::new(Progress {
                state: State::Waiting,
                grown: Vec::new(),
                failed: Vec::new(),
                problem: None,
                seed: None,
                gone_at: None,
            }),
            folder: Mutex::new(Some(folder)),
            metamers: AtomicU32::default(),
            written: watch::Sender::default(),
        }
    }

    /// How far it is, to look at and to change.
    pub(super) fn lock(&self) -> MutexGuard<'_, Progress> {
        lock(&self.progress)
    }

    /// The seed whose turn it is.
    pub(super) fn next_seed(&self) -> Option<u32> {
        let progress = self.lock();
        self.order.seeds.get(progress.tried()).copied()
    }

    /// Trees that it has still to grow.
    pub(super) fn left(&self) -> usize {
        self.order.seeds.len().saturating_sub(self.lock().tried())
    }

    /// Its tree of a seed is under way.
    pub(super) fn begin(&self, seed: u32) {
        let mut progress = self.lock();
        (progress.state, progress.seed) = (State::Growing, Some(seed));
    }

    /// A tree is made, or cannot be; the last one ends the job.
    pub(super) fn made(&self, seed: u32, made: Result<Grown, Problem>) {
        let mut progress = self.lock();
        match made {
            Ok(grown) => progress.grown.push(grown),
            Err(problem) => progress.failed.push((seed, problem)),
        }
        progress.seed = None;
        drop(progress);
        if self.next_seed().is_none() {
            self.end(None);
        }
    }

    /// Ends it; a problem says why before it was done.
    pub(super) fn end(&self, problem: Option<Problem>) {
        let mut progress = self.lock();
        progress.state = if problem.is_none() { State::Done } else { State::Failed };
        (progress.problem, progress.seed) = (problem, None);
        progress.gone_at = Some(Instant::now() + KEPT);
    }

    /// Whether it has ended.
    pub(super) fn has_ended(&self) -> bool {
        matches!(self.lock().state, State::Done | State::Failed)
    }

    /// Whether nobody wants it any more.
    pub(super) fn is_given_up(&self) -> bool {
        self.given_up.is_cancelled()
    }

    /// Ends it, and takes its files away.
    pub(super) fn give_up(&self) {
        self.given_up.cancel();
        lock(&self.folder).take();
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.lock().clone()
    }

    /// Metamers of the tree under way, and bytes of its file.
    pub fn under_way(&self) -> (u32, u64) {
        (self.metamers.load(Ordering::Relaxed), *self.written.borrow())
    }

    /// The name of the file of a seed.
    pub fn file_name(&self, seed: u32) -> String {
        format!("{seed}.{}", self.order.row.ending)
    }

    /// The file of a seed, if it was made, and how many bytes it has.
    pub fn open(&self, seed: u32) -> io::Result<Option<(File, u64)>> {
        let made = self.lock().grown.iter().find(|grown| grown.seed == seed).copied();
        let Some((grown, path)) = made.and_then(|grown| Some((grown, self.path(seed)?))) else {
            return Ok(None);
        };
        Ok(Some((File::open(path)?, grown.bytes)))
    }

    /// Where the file of a seed lies, or would lie.
    pub(super) fn path(&self, seed: u32) -> Option<PathBuf> {
        Some(lock(&self.folder).as_ref()?.path().join(self.file_name(seed)))
    }

    /// Grows a tree and writes its file, which may have so many bytes.
    pub(super) fn make(
        &self,
        seed: u32,
        pool: &SimulationPool,
        memory: &Memory,
        bytes_left: u64,
    ) -> Result<Grown, Problem> {
        self.metamers.store(0, Ordering::Relaxed);
        self.written.send_replace(0);
        let made = self.grow(seed, pool, memory, bytes_left);
        if made.is_err()
            && let Some(path) = self.path(seed)
        {
            // Where there is none, nothing is left to be removed.
            let _ = fs::remove_file(path);
        }
        // Whoever gives a job up takes its folder away, and then the file cannot be written for that reason.
        made.map_err(|error| if self.is_given_up() { given_up() } else { problem_of(&error, seed) })
    }

    fn grow(
        &self,
        seed: u32,
        pool: &SimulationPool,
        memory: &Memory,
        bytes_left: u64,
    ) -> Result<Grown, JobError> {
        let Order { recipe, species, row, options, .. } = &self.order;
        let claim = memory.take(Use::Job, Need::Other, 0).map_err(|_| GrowError::NoMemory)?;
        let mut plot =
            Plot { document: recipe.seedling(seed).map_err(GrowError::from)?, claim, job: self, pool };
        recipe.grow(&mut plot)?;
        let Plot { mut document, claim: _claim, .. } = plot;
        let held = row.held(document.metamers(), document::leaves_per_node(&document), options);
        let _held = memory.take(Use::Job, Need::Other, held).map_err(|_| GrowError::NoMemory)?;
        let path = self.path(seed).ok_or(GrowError::GivenUp)?;
        let file = File::create_new(&path)?;
        let stop = self.given_up.clone();
        let mut out = Spool::new(file, pool.clone(), stop, self.written.clone()).within(bytes_left);
        formats::write(&mut document, *species, row.format, options, &mut out)?;
        let (_, bytes) = out.into_file()?;
        Ok(Grown { seed, metamers: document.metamers(), bytes, sum: sum_of(&path)? })
    }
}

/// The CRC-32 of a file.
fn sum_of(path: &Path) -> io::Result<u32> {
    let (mut file, mut piece, mut sum) = (File::open(path)?, vec![0; PIECE], crc32fast::Hasher::new());
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(sum.finalize()),
            count => sum.update(&piece[..count]),
        }
    }
}

/// A tree cannot be grown or written.
#[derive(Debug, thiserror::Error)]
enum JobError {
    #[error(transparent)]
    Grow(#[from] GrowError),
    #[error(transparent)]
    File(#[from] FileError),
}

impl From<ExportError> for JobError {
    fn from(error: ExportError) -> Self {
        Self::File(error.into())
    }
}

impl From<io::Error> for JobError {
    fn from(error: io::Error) -> Self {
        Self::File(error.into())
    }
}

fn problem_of(error: &JobError, seed: u32) -> Problem {
    match error {
        JobError::Grow(GrowError::Refused(problem)) => problem.clone(),
        JobError::Grow(error @ GrowError::Stalled { .. }) => {
            Problem::new(Reason::StoppedGrowing, error.to_string())
        }
        JobError::Grow(GrowError::GivenUp) => given_up(),
        JobError::Grow(error @ GrowError::NoMemory) => Problem::new(Reason::MemoryFull, error.to_string()),
        JobError::File(error) if error.on_disk() == Some(ErrorKind::QuotaExceeded) => {
            let [one, all] = [BYTES_OF_ONE, MOST_BYTES].map(|bytes| bytes >> 30);
            let sentence = format!(
                "The files of your jobs have {one} GiB, or those of all {all} GiB, and may not have more."
            );
            Problem::new(Reason::JobsDiskFull, sentence)
        }
        JobError::File(error) if error.on_disk() == Some(ErrorKind::StorageFull) => {
            Problem::new(Reason::JobsDiskFull, "The disk of the server is full.")
        }
        JobError::File(error) => {
            tracing::error!(%error, seed, "a tree of a job cannot be exported");
            Problem::new(Reason::NotExported, format!("The tree cannot be exported: {error}."))
        }
    }
}

fn given_up() -> Problem {
    Problem::new(Reason::Stopping, "The job was given up.")
}

/// A document that grows beneath those who draw, until it is given up.
struct Plot<'a> {
    document: Document,
    /// What is taken of memory for it.
    claim: Claim,
    job: &'a Job,
    pool: &'a SimulationPool,
}

impl Plot<'_> {
    /// Takes what the next step may need, and waits a while where there is none left.
    fn take_room(&mut self) -> Result<(), GrowError> {
        let rows = self.document.plant().metamer_count() as u64;
        let needed = memory::job(rows + rows / 8 + memory::STRIDE);
        if needed <= self.claim.bytes() {
            return Ok(());
        }
        let wanted = memory::job(rows + rows / 4 + 2 * memory::STRIDE);
        let begun = Instant::now();
        while self.claim.become_of(Need::Other, wanted).is_err() {
            if self.is_given_up() || begun.elapsed() >= ROOM_PATIENCE {
                return Err(GrowError::NoMemory);
            }
            thread::sleep(ROOM_PAUSE);
        }
        Ok(())
    }

    fn is_given_up(&self) -> bool {
        self.job.given_up.is_cancelled()
    }
}

impl Gardener for Plot<'_> {
    fn document(&self) -> &Document {
        &self.document
    }

    fn act(&mut self, command: &Command) -> Result<(), GrowError> {
        self.document.begin(&Principal::visitor(), command)?;
        loop {
            if self.is_given_up() {
                return Err(GrowError::GivenUp);
            }
            self.take_room()?;
            if !self.pool.hold(Class::Upkeep, Person::default(), || self.document.advance()) {
                return Ok(self.document.take_outcome()?);
            }
            self.job.metamers.store(self.document.metamers(), Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jb3_a_full_disk_ends_the_job_and_a_file_that_is_none_does_not() {
        let reason = |error: ExportError| problem_of(&JobError::from(error), 1).reason;
        for kind in [ErrorKind::StorageFull, ErrorKind::QuotaExceeded] {
            assert_eq!(reason(ExportError::Write(kind)), Reason::JobsDiskFull);
            assert_eq!(problem_of(&JobError::from(io::Error::from(kind)), 1).reason, Reason::JobsDiskFull);
        }
        assert_eq!(reason(ExportError::Write(ErrorKind::PermissionDenied)), Reason::NotExported);
    }
}
