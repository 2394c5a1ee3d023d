//! The simulation pool: heavy work runs here, so that sockets and acknowledgements never wait behind a tree.

use std::{
    num::NonZeroUsize,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    thread,
    time::Duration,
};

use tokio::sync::oneshot;

/// Work on the pool panicked; the panic itself has been printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a computation failed")]
pub struct Panicked;

/// Threads for simulation, one for each core. What runs on them may itself use rayon and stays on them.
#[derive(Clone, Debug)]
pub struct SimulationPool(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    threads: rayon::ThreadPool,
    /// Pieces of work that somebody waits for.
    at_work: Mutex<usize>,
    idle: Condvar,
}

/// One of them, until it is done.
struct Turn(Arc<Shared>);

impl Turn {
    fn of(shared: &Arc<Shared>) -> Self {
        *shared.lock() += 1;
        Self(Arc::clone(shared))
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        *self.0.lock() -= 1;
        self.0.idle.notify_all();
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, usize> {
        self.at_work.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl SimulationPool {
    /// A pool of this many threads, or one for each core.
    pub fn new(threads: Option<NonZeroUsize>) -> Result<Self, rayon::ThreadPoolBuildError> {
        let cores = thread::available_parallelism();
        let threads = threads.or(cores.ok()).map_or(1, NonZeroUsize::get);
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|number| format!("simulation-{number}"))
            .build()?;
        Ok(Self(Arc::new(Shared { threads, at_work: Mutex::default(), idle: Condvar::new() })))
    }

    /// Runs this on the pool and waits without holding a thread of the network.
    pub async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Panicked> {
        let (answer, answered) = oneshot::channel();
        let turn = Turn::of(&self.0);
        self.0.threads.spawn(move || {
            let _turn = turn;
            // Whoever asked may have gone, before it is begun or after; then the result is of no use.
            if answer.is_closed() {
                return;
            }
            let _ = answer.send(catch_unwind(AssertUnwindSafe(work)).map_err(|_| Panicked));
        });
        answered.await.unwrap_or(Err(Panicked))
    }

    /// Holds the calling thread, which does what nobody waits for, while there is work on the pool, but not for ever.
    pub fn give_way(&self, at_most: Duration) {
        let is_busy = |at_work: &mut usize| *at_work > 0;
        let _ = self.0.idle.wait_timeout_while(self.0.lock(), at_most, is_busy);
    }

    /// Runs this on the pool and holds the calling thread until it is done.
    pub fn block_on<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.0.threads.install(work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_panic_leaves_the_pool_working() {
        let pool = SimulationPool::new(NonZeroUsize::new(1)).unwrap();
        assert_eq!(pool.run(|| panic!("on purpose, for a test")).await, Err::<(), _>(Panicked));
        assert_eq!(pool.run(|| 6 * 7).await, Ok(42));
    }

    #[tokio::test]
    async fn work_that_nobody_waits_for_is_not_begun() {
        let pool = SimulationPool::new(NonZeroUsize::new(1)).unwrap();
        let (open, gate) = std::sync::mpsc::channel::<()>();
        let (begun, has_begun) = std::sync::mpsc::channel::<()>();
        let held = tokio::spawn({
            let pool = pool.clone();
            async move { pool.run(move || gate.recv().is_ok()).await }
        });
        let given_up = tokio::time::timeout(Duration::from_millis(20), async {
            tokio::task::yield_now().await;
            pool.run(move || begun.send(())).await
        });
        assert!(given_up.await.is_err(), "the one thread is held");
        open.send(()).unwrap();
        assert_eq!(held.await.unwrap(), Ok(true));
        assert_eq!(pool.run(|| 1).await, Ok(1), "the thread is free again");
        assert!(has_begun.recv().is_err(), "it was dropped, not begun");
    }

    #[tokio::test]
    async fn what_nobody_waits_for_gives_way() {
        let pool = SimulationPool::new(NonZeroUsize::new(1)).unwrap();
        let (open, gate) = std::sync::mpsc::channel::<()>();
        let drawing = tokio::spawn({
            let pool = pool.clone();
            async move { pool.run(move || gate.recv().is_ok()).await }
        });
        while *pool.0.lock() == 0 {
            tokio::task::yield_now().await;
        }
        // With work on the pool it goes on only because it has waited long enough.
        pool.give_way(Duration::from_millis(1));
        assert_eq!(*pool.0.lock(), 1);
        let beneath = thread::spawn({
            let pool = pool.clone();
            move || pool.give_way(Duration::MAX)
        });
        open.send(()).unwrap();
        assert_eq!(drawing.await.unwrap(), Ok(true));
        beneath.join().unwrap();
        assert_eq!(*pool.0.lock(), 0);
    }

    #[test]
    fn nested_parallel_work_stays_on_the_pool() {
        let pool = SimulationPool::new(NonZeroUsize::new(3)).unwrap();
        assert_eq!(pool.block_on(rayon::current_num_threads), 3);
    }
}
