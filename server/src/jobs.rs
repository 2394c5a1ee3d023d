//! Jobs: trees that are grown on request, one tree after the other and in turns of those who ordered them, beneath those
//! who draw. Their files lie on disk until the job is given up, is old, or the server stops.

mod job;
mod place;

use std::{
    cmp::Reverse,
    collections::BTreeMap,
    env, io,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

use espalier_proto::{Problem, Reason};
use tokio::{sync::Notify, time::sleep};
use tokio_util::sync::CancellationToken;

pub use self::job::{Grown, Job, Order, Progress, State};
use self::place::Place;
use crate::{
    access::{Action, Caller},
    memory::Memory,
    name,
    pool::SimulationPool,
    queue::Queue,
    store::AnyStore,
};

/// Jobs of one person that may wait,
pub const WAITING_OF_ONE: usize = 64;
/// and of all.
pub const MOST_WAITING: usize = 256;
/// Jobs of one person that are kept, those that have ended included,
pub const KEPT_OF_ONE: usize = 1000;
/// and of all.
pub const MOST_KEPT: usize = 4000;
/// Bytes that the files of one person's jobs may have,
pub const BYTES_OF_ONE: u64 = 12 << 30;
/// and of all.
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
    memory: Memory,
    stop: CancellationToken,
}

#[derive(Debug, Default)]
struct Table {
    jobs: BTreeMap<String, Arc<Job>>,
    /// Jobs with trees to grow.
    waiting: Queue,
    /// Made for the first job.
    place: Option<Place>,
    /// How many were ordered so far.
    ordered: u64,
}

/// A job, its name, and how many come before it.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Its name.
    pub name: String,
    /// What it is.
    pub job: Arc<Job>,
    /// How many begin before it.
    pub ahead: usize,
}

impl Table {
    /// The jobs that wait, in the order in which they begin.
    fn in_order(&self) -> Vec<&str> {
        let is_waiting =
            |name: &&str| self.jobs.get(*name).is_some_and(|job| job.lock().state == State::Waiting);
        let left = |name: &str| self.jobs.get(name).map_or(0, |job| job.left());
        self.waiting.in_order(left).into_iter().filter(is_waiting).collect()
    }
}

/// Why an order is not taken.
#[derive(Debug, thiserror::Error)]
pub enum NotTaken {
    /// As many jobs wait, or are kept, as may.
    #[error("{MOST_WAITING} jobs wait or {MOST_KEPT} are kept already")]
    Full,
    /// As many of theirs wait, or are kept, as may.
    #[error("{WAITING_OF_ONE} of your jobs wait or {KEPT_OF_ONE} are kept already")]
    Share,
    /// The server stops.
    #[error("the server is stopping")]
    Stopping,
    /// There is no place for its files.
    #[error(transparent)]
    Disk(#[from] io::Error),
}

impl Jobs {
    /// No jobs. Somebody has to [`run`](Self::run) them.
    pub fn new(pool: SimulationPool, memory: Memory, stop: CancellationToken) -> Self {
        Self(Arc::new(Inner { table: Mutex::default(), added: Notify::new(), pool, memory, stop }))
    }

    /// Does what is ordered until the server stops; then all files go. The store says who is still let in.
    pub async fn run(self, store: Arc<AnyStore>) {
        let tidied = tokio::task::spawn_blocking(|| place::remove_left(&env::temp_dir())).await;
        if let Err(error) = tidied {
            tracing::error!(%error, "files that jobs of earlier servers left were not looked for");
        }
        while !self.0.stop.is_cancelled() {
            if let Some((name, job)) = self.next() {
                if self.work(&job, &store).await {
                    self.table().waiting.remove(&name);
                }
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
        let person = order.by.person();
        let kept = table.jobs.values().filter(|job| job.order.by.person() == person).count();
        if table.waiting.of(&person) >= WAITING_OF_ONE || kept >= KEPT_OF_ONE {
            return Err(NotTaken::Share);
        }
        let place = match table.place.take().filter(Place::is_there) {
            Some(place) => place,
            None => Place::new_in(&env::temp_dir())?,
        };
        let folder = table.place.insert(place).folder()?;
        table.ordered += 1;
        let job = Job::new(order, table.ordered, folder, &self.0.stop);
        table.jobs.insert(name.clone(), Arc::new(job));
        table.waiting.add(person, name);
        self.0.added.notify_one();
        Ok(())
    }

    /// The job of this name, if it is this caller's, and how many come before it.
    pub fn find(&self, name: &str, caller: &Caller) -> Option<(Arc<Job>, usize)> {
        let table = self.table();
        let job = table.jobs.get(name).filter(|job| caller.has_what_is_of(&job.order.by)).cloned()?;
        let ahead = table.in_order().into_iter().position(|other| other == name).unwrap_or(0);
        Some((job, ahead))
    }

    /// So many of this caller's jobs, newest first; those before a number, if one is given.
    pub fn list(&self, caller: &Caller, limit: usize, before: Option<u64>) -> Vec<Listed> {
        let table = self.table();
        let is_asked_for = |(_, job): &(&String, &Arc<Job>)| {
            before.is_none_or(|before| job.number < before) && caller.has_what_is_of(&job.order.by)
        };
        let mut found: Vec<_> = table.jobs.iter().filter(is_asked_for).collect();
        found.sort_unstable_by_key(|(_, job)| Reverse(job.number));
        found.truncate(limit);
        let ahead: BTreeMap<&str, usize> = table.in_order().into_iter().zip(0..).collect();
        let listed = found.into_iter().map(|(name, job)| Listed {
            name: name.clone(),
            job: Arc::clone(job),
            ahead: ahead.get(&**name).copied().unwrap_or(0),
        });
        listed.collect()
    }

    /// Ends a job, and takes its files away; false if there is none of this name that is this caller's.
    pub fn give_up(&self, name: &str, caller: &Caller) -> bool {
        let mut table = self.table();
        let is_theirs = |job: &Arc<Job>| caller.has_what_is_of(&job.order.by);
        if !table.jobs.get(name).is_some_and(is_theirs) {
            return false;
        }
        table.waiting.remove(name);
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

    /// The job whose turn it is, with its name.
    fn next(&self) -> Option<(String, Arc<Job>)> {
        let mut table = self.table();
        let name = table.waiting.next()?;
        let job = table.jobs.get(&name).cloned()?;
        Some((name, job))
    }

    /// Bytes that may still be written for somebody.
    fn bytes_left(&self, person: &str) -> u64 {
        let held = |job: &Arc<Job>| job.lock().grown.iter().map(|grown| grown.bytes).sum::<u64>();
        let table = self.table();
        let of_one = table.jobs.values().filter(|job| job.order.by.person() == person).map(held).sum();
        let of_all = table.jobs.values().map(held).sum();
        MOST_BYTES.saturating_sub(of_all).min(BYTES_OF_ONE.saturating_sub(of_one))
    }

    /// Grows the next tree of a job; whether that was the last.
    async fn work(&self, job: &Arc<Job>, store: &AnyStore) -> bool {
        let Some(seed) = job.next_seed().filter(|_| !job.is_given_up()) else { return true };
        if !may_go_on(&job.order.by, store).await {
            job.end(Some(Problem::new(Reason::Forbidden, "Whoever ordered this may grow trees no longer.")));
            return true;
        }
        job.begin(seed);
        let (this, pool, memory) = (Arc::clone(job), self.0.pool.clone(), self.0.memory.clone());
        let bytes_left = self.bytes_left(&job.order.by.person());
        let made = tokio::task::spawn_blocking(move || this.make(seed, &pool, &memory, bytes_left)).await;
        let made = made.unwrap_or_else(|error| {
            tracing::error!(%error, seed, "a tree of a job failed");
            Err(Problem::new(Reason::Failed, "The server failed to compute this."))
        });
        match made {
            Err(problem) if problem.reason == Reason::JobsDiskFull => job.end(Some(problem)),
            made => job.made(seed, made),
        }
        job.has_ended()
    }
}

/// Whether whoever ordered a job may still have it done. Where nobody can say, they may as before.
async fn may_go_on(by: &Caller, store: &AnyStore) -> bool {
    by.still_may(Action::GrowTrees, store).await.unwrap_or_else(|error| {
        tracing::warn!(%error, "whether a job may go on is not known");
        true
    })
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use espalier_proto::{Steps, access::Role};
    use espalier_session::LeftOut;

    use super::*;
    use crate::{
        export_options::ExportOptions,
        formats::FORMATS,
        recipe::Recipe,
        store::{Terms, User, UserChange, Users},
    };

    fn order(seeds: &[u32], steps: u32) -> Order {
        let steps = Some(Steps::nearest(steps));
        Order {
            by: Caller::local(),
            recipe: Recipe { steps, budget: 1_000_000, ..Recipe::default() },
            seeds: seeds.to_vec(),
            species: None,
            row: FORMATS.iter().find(|row| row.ending == "mtg").unwrap(),
            options: ExportOptions::default(),
            left_out: LeftOut::default(),
        }
    }

    fn endless() -> Order {
        let mut order = order(&[1, 2], 1);
        order.recipe.metamers = Some(1_000_000);
        order
    }

    fn jobs() -> Jobs {
        let pool = SimulationPool::new(NonZeroUsize::new(1)).unwrap();
        Jobs::new(pool, Memory::of(1 << 40), CancellationToken::new())
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
        job.has_ended()
    }

    fn store() -> Arc<AnyStore> {
        Arc::new(AnyStore::Memory(Box::default()))
    }

    /// An order of somebody who has logged in.
    fn order_of(name: &str, seeds: &[u32]) -> Order {
        Order { by: Caller::logged_in(name, Role::Editor), ..order(seeds, 1) }
    }

    async fn store_with(name: &str, role: Role) -> Arc<AnyStore> {
        let store = store();
        let user = User {
            name: name.into(),
            role,
            id: name.into(),
            group_role: None,
            password: "none".into(),
            created_at: "2026".into(),
            revision: 1,
        };
        store.add_user(user).await.unwrap();
        store
    }

    #[tokio::test]
    async fn jb6_people_take_turns_and_nobody_fills_the_queue() {
        let (jobs, store) = (jobs(), store_with("Bo", Role::Editor).await);
        let names: Vec<_> = (0..WAITING_OF_ONE).map(|_| added(&jobs, order(&[1, 2], 1))).collect();
        assert!(matches!(jobs.add(order(&[1], 1)), Err(NotTaken::Share)));
        let [first, second] = [&names[0], &names[1]];
        let others = added(&jobs, order_of("Bo", &[5, 6]));
        assert_eq!(find(&jobs, &others).map(|(_, ahead)| ahead), Some(1), "not behind 64 jobs");
        for name in ["Cy", "Di"] {
            (0..WAITING_OF_ONE).for_each(|_| drop(added(&jobs, order_of(name, &[1]))));
        }
        (1..WAITING_OF_ONE).for_each(|_| drop(added(&jobs, order_of("Bo", &[1]))));
        assert!(matches!(jobs.add(order_of("Eve", &[1])), Err(NotTaken::Full)));
        let kept = jobs.table().jobs.clone();
        for (name, job) in kept {
            let is_of = |other: &str| job.order.by.person().ends_with(other);
            if is_of("cy") || is_of("di") {
                assert!(jobs.give_up(&name, &Caller::local()));
            }
        }
        // A tree of each in turn, and one job of each at a time.
        for expected in [first, &others, first, &others, second] {
            let (name, job) = jobs.next().unwrap();
            assert_eq!(name, *expected);
            if jobs.work(&job, &store).await {
                jobs.table().waiting.remove(&name);
            }
        }
    }

    #[tokio::test]
    async fn jb7_a_job_ends_where_whoever_ordered_it_may_no_longer() {
        let jobs = jobs();
        for change in [Some(UserChange::role(Role::Viewer)), None] {
            let store = store_with("Ada", Role::Editor).await;
            let id = added(&jobs, order_of("Ada", &[1, 2, 3]));
            let (name, job) = jobs.next().unwrap();
            assert!(!jobs.work(&job, &store).await);
            store.change_user("Ada", UserChange::role(Role::Owner), Terms::default()).await.unwrap();
            assert!(!jobs.work(&job, &store).await, "who may more may go on");
            match change {
                Some(change) => store.change_user("Ada", change, Terms::default()).await.unwrap(),
                None => store.remove_user("Ada", Terms::default()).await.unwrap(),
            };
            assert!(jobs.work(&job, &store).await);
            let Progress { state, grown, problem, .. } = find(&jobs, &id).unwrap().0.progress();
            assert_eq!((state, grown.len()), (State::Failed, 2), "what was made stays");
            assert_eq!(problem.map(|problem| problem.reason), Some(Reason::Forbidden));
            jobs.table().waiting.remove(&name);
        }
    }

    #[tokio::test]
    async fn jb2_jobs_of_one_are_done_in_their_order() {
        let jobs = jobs();
        let names: Vec<_> = (0..WAITING_OF_ONE).map(|_| added(&jobs, order(&[1], 1))).collect();
        assert_eq!(find(&jobs, &names[5]).map(|(_, ahead)| ahead), Some(5));
        assert!(jobs.give_up(&names[2], &Caller::local()));
        assert_eq!(find(&jobs, &names[5]).map(|(_, ahead)| ahead), Some(4));
        tokio::spawn(jobs.clone().run(store()));
        let last = until(&jobs, &names[WAITING_OF_ONE - 1], has_ended).await;
        assert_eq!(last.progress().grown.len(), 1);
        let others = names.iter().enumerate().filter(|(index, _)| *index != 2);
        assert!(others.into_iter().all(|(_, name)| has_ended(&find(&jobs, name).unwrap().0)));
    }

    #[test]
    fn jb8_jobs_are_listed_newest_first_page_by_page() {
        let jobs = jobs();
        let names: Vec<_> = (0..5).map(|_| added(&jobs, order(&[1], 1))).collect();
        let others = added(&jobs, order_of("Bo", &[1]));
        let list = |caller: &Caller, limit, before| jobs.list(caller, limit, before);
        let bo = Caller::logged_in("Bo", Role::Viewer);
        assert_eq!(list(&bo, 9, None).iter().map(|one| &one.name).collect::<Vec<_>>(), [&others]);
        let (mut seen, mut before) = (Vec::new(), None);
        loop {
            let page = list(&Caller::local(), 2, before);
            let Some(last) = page.last() else { break };
            before = Some(last.job.number);
            seen.extend(page.iter().map(|one| one.name.clone()));
            // Neither what comes meanwhile nor what goes moves the pages.
            added(&jobs, order(&[1], 1));
            jobs.give_up(&names[3], &Caller::local());
        }
        let expected = [&others, &names[4], &names[2], &names[1], &names[0]];
        assert_eq!(seen.iter().collect::<Vec<_>>(), expected, "administrators see those of all");
        for Listed { name, ahead, .. } in list(&Caller::local(), 99, None) {
            assert_eq!(find(&jobs, &name).map(|(_, ahead)| ahead), Some(ahead), "{name}");
        }
    }

    #[tokio::test]
    async fn jb3_files_are_kept_for_an_hour_within_their_room() {
        let jobs = jobs();
        tokio::spawn(jobs.clone().run(store()));
        let id = added(&jobs, order(&[7, 3], 4));
        let job = until(&jobs, &id, has_ended).await;
        let Progress { grown, failed, state, .. } = job.progress();
        assert_eq!((state, failed.len()), (State::Done, 0));
        assert_eq!(grown.iter().map(|grown| grown.seed).collect::<Vec<_>>(), [7, 3]);
        for Grown { seed, metamers, bytes, .. } in grown {
            let (file, length) = job.open(seed).unwrap().expect("there is such a file");
            assert_eq!((file.metadata().unwrap().len(), length), (bytes, bytes));
            assert!(bytes > 100 && metamers > 3);
        }
        assert!(job.open(8).unwrap().is_none());

        let problem = job.make(9, &jobs.0.pool, &jobs.0.memory, 10).unwrap_err();
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
        tokio::spawn(jobs.clone().run(store()));
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
        tokio::spawn(jobs.clone().run(store()));
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
        let running = tokio::spawn(jobs.clone().run(store()));
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
