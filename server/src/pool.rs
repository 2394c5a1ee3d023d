//! The simulation pool: heavy work runs here, in slices, so that sockets and acknowledgements never wait behind a tree,
//! and nobody who draws behind somebody else's. Whose slice is next is decided in `turns.rs`.

mod turns;

use std::{
    num::NonZeroUsize,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Condvar, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError, mpsc},
    thread,
    time::{Duration, Instant},
};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use tokio::sync::oneshot;

pub use self::turns::{Class, Person};
use self::turns::{Given, Turns};

/// Work on the pool panicked; the panic itself has been printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a computation failed")]
pub struct Panicked;

/// A slice that others wait behind ends after so long, where it can.
const SLICE: Duration = Duration::from_millis(3);

/// Workers for simulation, one for each core and two at least. What runs on them may itself use rayon and stays on its
/// worker, unless it has the pool to itself.
#[derive(Clone, Debug)]
pub struct SimulationPool(Arc<Handle>);

/// The workers end with the last of these.
#[derive(Debug)]
struct Handle {
    shared: Arc<Shared>,
    workers: OnceLock<()>,
}

#[derive(Debug)]
struct Shared {
    /// All cores, for what runs alone.
    wide: ThreadPool,
    /// One, for what runs while the calling thread is held.
    narrow: ThreadPool,
    began: Instant,
    state: Mutex<State>,
    /// There may be something to do.
    more: Condvar,
    /// Nothing is left that somebody waits for.
    quiet: Condvar,
}

#[derive(Debug)]
struct State {
    turns: Turns<Slice>,
    done: [Done; Class::ALL.len()],
    is_over: bool,
}

/// What was done of a class, from the start on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Done {
    /// Slices.
    pub slices: u64,
    /// How long all of them waited for a worker.
    pub waited: Duration,
    /// How long all of them took.
    pub worked: Duration,
}

/// A piece of work, and when it came.
struct Slice(Box<dyn FnOnce(&Turn<'_>) + Send>, Instant);

impl std::fmt::Debug for Slice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Slice")
    }
}

/// What work that can stop in between asks of the pool.
#[derive(Debug)]
pub struct Turn<'a> {
    shared: &'a Shared,
    begun: Instant,
}

impl Turn<'_> {
    /// Whether the work has had its time, and somebody else waits.
    pub fn is_over(&self) -> bool {
        self.begun.elapsed() >= SLICE && self.shared.lock().turns.waiting() > 0
    }
}

/// Time since this was first asked.
fn passed() -> Duration {
    static BEGAN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGAN.elapsed()
}

impl SimulationPool {
    /// A pool of this many threads, or one for each core.
    pub fn new(threads: Option<NonZeroUsize>) -> Result<Self, ThreadPoolBuildError> {
        espalier_growth::use_clock(passed);
        let cores = thread::available_parallelism();
        let threads = threads.or(cores.ok()).map_or(1, NonZeroUsize::get);
        let wide = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|number| format!("simulation-{number}"))
            .build()?;
        let narrow = ThreadPoolBuilder::new().num_threads(1).thread_name(|_| "held".into()).build()?;
        // With one core two workers share it, so that a large step there does not stop those who draw.
        let state = State { turns: Turns::new(threads.max(2)), done: Default::default(), is_over: false };
        let shared = Arc::new(Shared {
            wide,
            narrow,
            began: Instant::now(),
            state: Mutex::new(state),
            more: Condvar::new(),
            quiet: Condvar::new(),
        });
        Ok(Self(Arc::new(Handle { shared, workers: OnceLock::new() })))
    }

    /// Runs this on the pool and waits without holding a thread of the network.
    pub async fn run<T: Send + 'static>(
        &self,
        class: Class,
        person: Person,
        work: impl FnOnce(&Turn<'_>) -> T + Send + 'static,
    ) -> Result<T, Panicked> {
        let (answer, answered) = oneshot::channel();
        self.push(class, person, move |turn| {
            // Whoever asked may have gone, before it is begun or after; then the result is of no use.
            if answer.is_closed() {
                return;
            }
            let _ = answer.send(catch_unwind(AssertUnwindSafe(|| work(turn))).map_err(|_| Panicked));
        });
        answered.await.unwrap_or(Err(Panicked))
    }

    /// Waits for a turn, runs this, and holds the calling thread until it is done.
    pub fn hold<T: Send>(&self, class: Class, person: Person, work: impl FnOnce() -> T + Send) -> T {
        let (begin, begun) = mpsc::channel();
        let (end, ended) = mpsc::channel::<()>();
        self.push(class, person, move |_| {
            // The worker sleeps meanwhile.
            let _ = begin.send(()).map(|()| ended.recv());
        });
        let _ = begun.recv();
        // Dropped at the end, also if the work panics.
        let _end = end;
        self.0.shared.narrow.install(work)
    }

    fn push(&self, class: Class, person: Person, work: impl FnOnce(&Turn<'_>) + Send + 'static) {
        let Handle { shared, workers } = &*self.0;
        workers.get_or_init(|| shared.start());
        let now = shared.began.elapsed();
        shared.lock().turns.push(now, class, person, Slice(Box::new(work), Instant::now()));
        shared.more.notify_one();
    }

    /// Holds the calling thread, which is none of the pool's, while there is work on the pool that somebody waits for, but
    /// not for ever.
    pub fn give_way(&self, at_most: Duration) {
        let shared = &self.0.shared;
        let is_busy = |state: &mut State| !state.turns.keeps_nobody();
        let _ = shared.quiet.wait_timeout_while(shared.lock(), at_most, is_busy);
    }

    /// Runs this beside the pool, on a thread of its own, which a server that stops does not wait for. It may take long if
    /// it gives way time and again.
    pub async fn beside<T: Send + 'static>(
        &self,
        name: &str,
        work: impl FnOnce(&Self) -> T + Send + 'static,
    ) -> Result<T, Panicked> {
        let (answer, answered) = oneshot::channel();
        let pool = self.clone();
        let begun = thread::Builder::new().name(name.to_owned()).spawn(move || {
            if !answer.is_closed() {
                let _ = answer.send(catch_unwind(AssertUnwindSafe(|| work(&pool))).map_err(|_| Panicked));
            }
        });
        if let Err(error) = begun {
            tracing::error!(%error, name, "a thread could not be started");
        }
        answered.await.unwrap_or(Err(Panicked))
    }

    /// Slices that wait, by their class, and what was done of each.
    pub fn figures(&self) -> ([usize; Class::ALL.len()], [Done; Class::ALL.len()]) {
        let state = self.0.shared.lock();
        (state.turns.waiting_by_class(), state.done)
    }

    /// Runs this with all cores and holds the calling thread until it is done, whoever else waits.
    pub fn block_on<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.0.shared.wide.install(work)
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        self.shared.lock().is_over = true;
        self.shared.more.notify_all();
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn start(self: &Arc<Self>) {
        for number in 0..self.wide.current_num_threads().max(2) {
            let shared = Arc::clone(self);
            let worker = thread::Builder::new().name(format!("worker-{number}"));
            if let Err(error) = worker.spawn(move || shared.work()) {
                tracing::error!(%error, "a worker of the simulation pool could not be started");
            }
        }
    }

    /// What a worker does, until the pool is dropped.
    fn work(&self) {
        // What uses rayon here stays on this thread.
        let _narrow = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        while let Some(Given { class, person, slice: Slice(work, pushed), is_alone }) = self.next() {
            let turn = Turn { shared: self, begun: Instant::now() };
            if is_alone && self.wide.current_num_threads() > 1 {
                self.wide.install(|| work(&turn));
            } else {
                work(&turn);
            }
            let took = turn.begun.elapsed();
            let mut state = self.lock();
            state.turns.done(class, &person, took);
            let done = &mut state.done[class as usize];
            done.slices += 1;
            done.waited += turn.begun.saturating_duration_since(pushed);
            done.worked += took;
            if state.turns.keeps_nobody() {
                self.quiet.notify_all();
            }
            let is_over = state.is_over;
            drop(state);
            // What was kept from another worker may be done there now.
            if is_over { self.more.notify_all() } else { self.more.notify_one() }
        }
    }

    /// Waits for the next slice; nothing when the pool is dropped and nothing is left.
    fn next(&self) -> Option<Given<Slice>> {
        let mut state = self.lock();
        loop {
            let now = self.began.elapsed();
            if let Some(given) = state.turns.take(now) {
                return Some(given);
            }
            if state.is_over && state.turns.waiting() == 0 {
                return None;
            }
            state = match state.turns.look_again().and_then(|again| again.checked_sub(now)) {
                Some(wait) => {
                    self.more.wait_timeout(state, wait).map_or_else(|e| e.into_inner().0, |(state, _)| state)
                }
                None => self.more.wait(state).unwrap_or_else(PoisonError::into_inner),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pool(threads: usize) -> SimulationPool {
        SimulationPool::new(NonZeroUsize::new(threads)).unwrap()
    }

    fn somebody() -> Person {
        "somebody".into()
    }

    #[tokio::test]
    async fn a_panic_leaves_the_pool_working() {
        let pool = pool(1);
        let panic = pool.run(Class::Growing, somebody(), |_| panic!("on purpose, for a test"));
        assert_eq!(panic.await, Err::<(), _>(Panicked));
        assert_eq!(pool.run(Class::Growing, somebody(), |_| 6 * 7).await, Ok(42));
        let held =
            catch_unwind(AssertUnwindSafe(|| pool.hold(Class::Upkeep, somebody(), || panic!("on purpose"))));
        assert!(held.is_err());
        assert_eq!(pool.hold(Class::Upkeep, somebody(), || 6 * 7), 42);
    }

    /// Holds one worker until the sender is dropped or sends.
    fn hold(pool: &SimulationPool) -> (mpsc::Sender<()>, tokio::task::JoinHandle<Result<bool, Panicked>>) {
        let (open, gate) = mpsc::channel::<()>();
        let pool = pool.clone();
        let held = async move { pool.run(Class::Growing, somebody(), move |_| gate.recv().is_ok()).await };
        (open, tokio::spawn(held))
    }

    #[tokio::test]
    async fn work_that_nobody_waits_for_is_not_begun() {
        let pool = pool(1);
        let (begun, has_begun) = mpsc::channel::<()>();
        let held = [hold(&pool), hold(&pool)];
        let given_up = tokio::time::timeout(Duration::from_millis(20), async {
            tokio::task::yield_now().await;
            pool.run(Class::Growing, somebody(), move |_| begun.send(())).await
        });
        assert!(given_up.await.is_err(), "both workers are held");
        for (open, held) in held {
            open.send(()).unwrap();
            assert_eq!(held.await.unwrap(), Ok(true));
        }
        assert_eq!(pool.run(Class::Upkeep, somebody(), |_| 1).await, Ok(1), "a worker is free again");
        assert!(has_begun.recv().is_err(), "it was dropped, not begun");
    }

    #[tokio::test]
    async fn what_is_done_beside_gives_way_to_what_somebody_waits_for() {
        let pool = pool(1);
        let (open, drawing) = hold(&pool);
        while pool.0.shared.lock().turns.is_idle() {
            tokio::task::yield_now().await;
        }
        // With work on the pool it goes on only because it has waited long enough.
        pool.give_way(Duration::from_millis(1));
        assert!(!pool.0.shared.lock().turns.is_idle());
        let beneath = thread::spawn({
            let pool = pool.clone();
            move || pool.give_way(Duration::MAX)
        });
        open.send(()).unwrap();
        assert_eq!(drawing.await.unwrap(), Ok(true));
        beneath.join().unwrap();
        assert!(pool.0.shared.lock().turns.is_idle());
    }

    #[tokio::test]
    async fn what_is_done_beside_waits_for_no_upkeep_and_takes_no_worker() {
        let pool = pool(1);
        let (open, gate) = mpsc::channel::<()>();
        let jobs = pool.clone();
        let job = thread::spawn(move || jobs.hold(Class::Upkeep, somebody(), move || gate.recv()));
        while pool.0.shared.lock().turns.is_idle() || pool.0.shared.lock().turns.waiting() > 0 {
            tokio::task::yield_now().await;
        }
        // It would never come back from this if it waited for the job.
        let beside = pool.beside("beside", |pool| {
            pool.give_way(Duration::MAX);
            6 * 7
        });
        assert_eq!(beside.await, Ok(42));
        assert_eq!(pool.beside("beside", |_| panic!("on purpose, for a test")).await, Err::<(), _>(Panicked));
        let held = [hold(&pool), hold(&pool)];
        assert_eq!(pool.beside("beside", |_| 1).await, Ok(1), "no worker is free");
        drop(held);
        open.send(()).unwrap();
        assert_eq!(job.join().unwrap(), Ok(()));
    }

    #[tokio::test]
    async fn a_slice_is_over_only_if_somebody_waits() {
        let pool = pool(1);
        let (_open, _held) = hold(&pool);
        while pool.0.shared.lock().turns.is_idle() || pool.0.shared.lock().turns.waiting() > 0 {
            tokio::task::yield_now().await;
        }
        let others = pool.clone();
        let over = pool.run(Class::Drawing, somebody(), move |turn| {
            thread::sleep(SLICE);
            let alone = turn.is_over();
            others.push(Class::Drawing, somebody(), |_| ());
            [alone, turn.is_over()]
        });
        assert_eq!(over.await, Ok([false, true]), "the other worker is held");
    }

    #[tokio::test]
    async fn nested_parallel_work_stays_where_it_is() {
        let pool = pool(3);
        assert_eq!(pool.block_on(rayon::current_num_threads), 3);
        let alone = pool.run(Class::Growing, somebody(), |_| rayon::current_num_threads()).await;
        assert_eq!(alone, Ok(3), "what is alone has all threads");
        // What was done may still count as being done, so a worker says itself that it is held.
        let (begun, has_begun) = oneshot::channel();
        let (_open, gate) = mpsc::channel::<()>();
        let holding = pool.clone();
        let _held = tokio::spawn(async move {
            let work = move |_: &Turn<'_>| begun.send(()).is_ok() && gate.recv().is_ok();
            holding.run(Class::Growing, somebody(), work).await
        });
        assert_eq!(has_begun.await, Ok(()));
        let beside = pool.run(Class::Drawing, somebody(), |_| rayon::current_num_threads()).await;
        assert_eq!(beside, Ok(1));
    }

    #[test]
    fn the_workers_end_with_the_pool() {
        let pool = pool(2);
        assert_eq!(pool.hold(Class::Upkeep, somebody(), || 1), 1);
        let shared = Arc::downgrade(&pool.0.shared);
        drop(pool);
        while shared.strong_count() > 0 {
            thread::yield_now();
        }
    }
}
