//! Jobs: trees that are grown on request, one job after the other, beneath those who draw. Their files lie on disk until the
//! job is given up, is old, or the server stops.

mod job;
mod place;

use std::{
    collections::{BTreeMap, VecDeque},
    env, io,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

use espalier_proto::{Problem, Reason};
use tokio::{sync::Notify, time::sleep};
use tokio_util::sync::CancellationToken;

pub use self::job::{Grown, Job, Order, Progress, State};
use self::place::Place;
use crate::{access::Caller, name, pool::SimulationPool};

/// Jobs that may wait.
pub const MOST_WAITING: usize = 64;
/// Jobs that are kept, those that have ended included.
pub const MOST_KEPT: usize = 1000;
/// Bytes that the files of all jobs may have.
pub const MOST_BYTES: u64 = 16 << 30;
/// How long a job that has ended is kept.
const KEPT: Duration = Duration::from_hours(1);
/// How often old jobs are looked for where nobody asks for one.
const ROUND: Duration = Duration::from_secs(60);

/// All jobs.
#[derive(Clone, Debug)]
pub struct Jobs(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    table: Mutex<Table>,
    added: Notify,
    pool: SimulationPool,
    stop: CancellationToken,
}

#[derive(Debug, Default)]
struct Table {
    jobs: BTreeMap<String, Arc<Job>>,
    waiting: VecDeque<String>,
    /// Made for the first job.
    place: Option<Place>,
}

/// Why an order is not taken.
#[derive(Debug, thiserror::Error)]
pub enum NotTaken {
    /// As many jobs wait, or are kept, as may.
    #[error("{MOST_WAITING} jobs wait or {MOST_KEPT} are kept already")]
    Full,
    /// The server stops.
    #[error("the server is stopping")]
    Stopping,
    /// There is no place for its files.
    #[error(transparent)]
    Disk(#[from] io::Error),
}

impl Jobs {
    /// No jobs. Somebody has to [`run`](Self::run) them.
    pub fn new(pool: SimulationPool, stop: CancellationToken) -> Self {
        Self(Arc::new(Inner { table: Mutex::default(), added: Notify::new(), pool, stop }))
    }

    /// Does one job after the other until the server stops; then all files go.
    pub async fn run(self) {
        let tidied = tokio::task::spawn_blocking(|| place::remove_left(&env::temp_dir())).await;
        if let Err(error) = tidied {
            tracing::error!(%error, "files that jobs of earlier servers left were not looked for");
        }
        while !self.0.stop.is_cancelled() {
            if let Some(job) = self.next() {
                self.work(&job).await;
                continue;
            }
            tokio::select! {
                () = self.0.added.notified() => {}
                () = sleep(ROUND) => {}
                () = self.0.stop.cancelled() => {}
            }
        }
        *self.table() = Table::default();
    }

    /// Takes an order; the name of the job.
    pub fn add(&self, order: Order) -> Result<String, NotTaken> {
        let name = name::unguessable();
        self.add_named(name.clone(), order).map(|()| name)
    }

    /// The same under this name, which no other job has.
    pub fn add_named(&self, name: String, order: Order) -> Result<(), NotTaken> {
        let mut table = self.table();
        // Asked under the lock: what is added before the stop goes with it.
        if self.0.stop.is_cancelled() {
            return Err(NotTaken::Stopping);
        }
        if table.waiting.len() >= MOST_WAITING || table.jobs.len() >= MOST_KEPT {
            return Err(NotTaken::Full);
        }
        let place = match table.place.take().filter(Place::is_there) {
            Some(place) => place,
            None => Place::new_in(&env::temp_dir())?,
        };
        let folder = table.place.insert(place).folder()?;
        table.jobs.insert(name.clone(), Arc::new(Job::new(order, folder, &self.0.stop)));
        table.waiting.push_back(name);
        self.0.added.notify_one();
        Ok(())
    }

    /// The job of this name, if it is this caller's, and how many come before it.
    pub fn find(&self, name: &str, caller: &Caller) -> Option<(Arc<Job>, usize)> {
        let table = self.table();
        let job = table.jobs.get(name).filter(|job| caller.has_what_is_of(&job.order.by)).cloned()?;
        let ahead = table.waiting.iter().position(|other| other == name).unwrap_or(0);
        Some((job, ahead))
    }

    /// Ends a job, and takes its files away; false if there is none of this name that is this caller's.
    pub fn give_up(&self, name: &str, caller: &Caller) -> bool {
        let mut table = self.table();
        let is_theirs = |job: &Arc<Job>| caller.has_what_is_of(&job.order.by);
        if !table.jobs.get(name).is_some_and(is_theirs) {
            return false;
        }
        table.waiting.retain(|other| other != name);
        let job = table.jobs.remove(name);
        drop(table);
        job.inspect(|job| job.give_up()).is_some()
    }

    /// The jobs, but for those that are old.
    fn table(&self) -> MutexGuard<'_, Table> {
        let mut table = self.0.table.lock().unwrap_or_else(PoisonError::into_inner);
        let is_old = |job: &Job| job.lock().gone_at.is_some_and(|at| at <= Instant::now());
        table.jobs.retain(|_, job| !is_old(job));
        table
    }

    fn next(&self) -> Option<Arc<Job>> {
        let mut table = self.table();
        let name = table.waiting.pop_front()?;
        table.jobs.get(&name).cloned()
    }

    /// Bytes that may still be written.
    fn bytes_left(&self) -> u64 {
        let held = |job: &Arc<Job>| job.lock().grown.iter().map(|grown| grown.bytes).sum::<u64>();
        MOST_BYTES.saturating_sub(self.table().jobs.values().map(held).sum())
    }

    async fn work(&self, job: &Arc<Job>) {
        job.lock().state = State::Growing;
        for &seed in &job.order.seeds {
            if job.is_given_up() {
                return;
            }
            job.lock().seed = Some(seed);
            let (this, pool, bytes_left) = (Arc::clone(job), self.0.pool.clone(), self.bytes_left());
            let made = tokio::task::spawn_blocking(move || this.make(seed, &pool, bytes_left)).await;
            let made = made.unwrap_or_else(|error| {
                tracing::error!(%error, seed, "a tree of a job failed");
                Err(Problem::new(Reason::Failed, "The server failed to compute this."))
            });
            let mut progress = job.lock();
            match made {
                Ok(grown) => progress.grown.push(grown),
                Err(problem) if problem.reason == Reason::JobsDiskFull => {
                    (progress.state, progress.problem) = (State::Failed, Some(problem));
                    break;
                }
                Err(problem) => progress.failed.push((seed, problem)),
            }
        }
        let mut progress = job.lock();
        if progress.state == State::Growing {
            progress.state = State::Done;
        }
        (progress.seed, progress.gone_at) = (None, Some(Instant::now() + KEPT));
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use espalier_proto::Steps;

    use super::*;
    use crate::{document::FORMATS, export_options::ExportOptions, recipe::Recipe};

    fn order(seeds: &[u32], steps: u32) -> Order {
        let steps = Some(Steps::nearest(steps));
        Order {
            by: Caller::local(),
            recipe: Recipe { steps, budget: 1_000_000, ..Recipe::default() },
            seeds: seeds.to_vec(),
            species: None,
            row: FORMATS.iter().find(|row| row.ending == "mtg").unwrap(),
            options: ExportOptions::default(),
        }
    }

    fn endless() -> Order {
        let mut order = order(&[1, 2], 1);
        order.recipe.metamers = Some(1_000_000);
        order
    }

    fn jobs() -> Jobs {
        let pool = SimulationPool::new(NonZeroUsize::new(1)).unwrap();
        Jobs::new(pool, CancellationToken::new())
    }

    fn added(jobs: &Jobs, order: Order) -> String {
        jobs.add(order).unwrap()
    }

    fn find(jobs: &Jobs, id: &str) -> Option<(Arc<Job>, usize)> {
        jobs.find(id, &Caller::local())
    }

    async fn until(jobs: &Jobs, id: &str, is_so: impl Fn(&Job) -> bool) -> Arc<Job> {
        loop {
            let (job, _) = find(jobs, id).expect("the job is there");
            if is_so(&job) {
                return job;
            }
            sleep(Duration::from_millis(2)).await;
        }
    }

    fn has_ended(job: &Job) -> bool {
        job.progress().seed.is_none() && matches!(job.progress().state, State::Done | State::Failed)
    }

    #[tokio::test]
    async fn jb2_jobs_are_done_in_their_order_and_64_wait() {
        let jobs = jobs();
        let names: Vec<_> = (0..MOST_WAITING).map(|_| added(&jobs, order(&[1], 1))).collect();
        assert!(matches!(jobs.add(order(&[1], 1)), Err(NotTaken::Full)));
        assert_eq!(find(&jobs, &names[5]).map(|(_, ahead)| ahead), Some(5));
        assert!(jobs.give_up(&names[2], &Caller::local()));
        assert_eq!(find(&jobs, &names[5]).map(|(_, ahead)| ahead), Some(4));
        tokio::spawn(jobs.clone().run());
        let last = until(&jobs, &names[MOST_WAITING - 1], has_ended).await;
        assert_eq!(last.progress().grown.len(), 1);
        let others = names.iter().enumerate().filter(|(index, _)| *index != 2);
        assert!(others.into_iter().all(|(_, name)| has_ended(&find(&jobs, name).unwrap().0)));
    }

    #[tokio::test]
    async fn jb3_files_are_kept_for_an_hour_within_their_room() {
        let jobs = jobs();
        tokio::spawn(jobs.clone().run());
        let id = added(&jobs, order(&[7, 3], 4));
        let job = until(&jobs, &id, has_ended).await;
        let Progress { grown, failed, state, .. } = job.progress();
        assert_eq!((state, failed.len()), (State::Done, 0));
        assert_eq!(grown.iter().map(|grown| grown.seed).collect::<Vec<_>>(), [7, 3]);
        for Grown { seed, metamers, bytes } in grown {
            let (file, length) = job.open(seed).unwrap().expect("there is such a file");
            assert_eq!((file.metadata().unwrap().len(), length), (bytes, bytes));
            assert!(bytes > 100 && metamers > 3);
        }
        assert!(job.open(8).unwrap().is_none());

        let problem = job.make(9, &jobs.0.pool, 10).unwrap_err();
        assert_eq!(problem.reason, Reason::JobsDiskFull);
        assert!(!job.path(9).unwrap().exists(), "what was begun is gone");

        let folder = job.path(7).unwrap();
        job.lock().gone_at = Some(Instant::now());
        drop(job);
        assert!(find(&jobs, &id).is_none() && !folder.exists());
    }

    #[tokio::test]
    async fn jb2_a_tree_that_cannot_be_grown_is_told_with_its_problem() {
        let jobs = jobs();
        tokio::spawn(jobs.clone().run());
        let mut small = endless();
        small.recipe.budget = 20;
        let id = added(&jobs, small);
        let Progress { state, grown, failed, .. } = until(&jobs, &id, has_ended).await.progress();
        assert_eq!((state, grown.len(), failed.len()), (State::Done, 0, 2));
        assert!(failed.iter().all(|(_, problem)| problem.reason == Reason::StoppedGrowing));
    }

    #[tokio::test]
    async fn jb4_a_job_that_is_given_up_ends_at_once_with_its_files() {
        let jobs = jobs();
        tokio::spawn(jobs.clone().run());
        let (id, next) = (added(&jobs, endless()), added(&jobs, order(&[1], 2)));
        let job = until(&jobs, &id, |job| job.under_way().0 > 0).await;
        let file = job.path(1).unwrap();
        let folder = file.parent().unwrap();
        assert!(folder.exists());
        assert!(jobs.give_up(&id, &Caller::local()) && !jobs.give_up(&id, &Caller::local()));
        assert!(find(&jobs, &id).is_none() && !folder.exists());
        until(&jobs, &next, has_ended).await;
    }

    #[tokio::test]
    async fn jb3_when_the_server_stops_all_files_go() {
        let jobs = jobs();
        let running = tokio::spawn(jobs.clone().run());
        let (id, waiting) = (added(&jobs, endless()), added(&jobs, endless()));
        let job = until(&jobs, &id, |job| job.under_way().0 > 0).await;
        let folders = [job, find(&jobs, &waiting).unwrap().0].map(|job| job.path(1).unwrap());
        let folders = folders.map(|file| file.parent().unwrap().to_owned());
        jobs.0.stop.cancel();
        running.await.unwrap();
        assert!(folders.iter().all(|folder| !folder.exists()));
        assert!(matches!(jobs.add(endless()), Err(NotTaken::Stopping)));
    }
}
