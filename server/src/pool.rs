//! The simulation pool: heavy work runs here, so that sockets and acknowledgements never wait behind a tree.

use std::{
    num::NonZeroUsize,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
    thread,
};

use tokio::sync::oneshot;

/// Work on the pool panicked; the panic itself has been printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a computation failed")]
pub struct Panicked;

/// Threads for simulation, one for each core. What runs on them may itself use rayon and stays on them.
#[derive(Clone, Debug)]
pub struct SimulationPool(Arc<rayon::ThreadPool>);

impl SimulationPool {
    /// A pool of this many threads, or one for each core.
    pub fn new(threads: Option<NonZeroUsize>) -> Result<Self, rayon::ThreadPoolBuildError> {
        let cores = thread::available_parallelism();
        let threads = threads.or(cores.ok()).map_or(1, NonZeroUsize::get);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|number| format!("simulation-{number}"))
            .build()?;
        Ok(Self(Arc::new(pool)))
    }

    /// Runs this on the pool and waits without holding a thread of the network.
    pub async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Panicked> {
        let (answer, answered) = oneshot::channel();
        self.0.spawn(move || {
            // Whoever asked may have gone, before it is begun or after; then the result is of no use.
            if answer.is_closed() {
                return;
            }
            let _ = answer.send(catch_unwind(AssertUnwindSafe(work)).map_err(|_| Panicked));
        });
        answered.await.unwrap_or(Err(Panicked))
    }

    /// Runs this on the pool and holds the calling thread until it is done.
    pub fn block_on<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.0.install(work)
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
        let given_up = tokio::time::timeout(std::time::Duration::from_millis(20), async {
            tokio::task::yield_now().await;
            pool.run(move || begun.send(())).await
        });
        assert!(given_up.await.is_err(), "the one thread is held");
        open.send(()).unwrap();
        assert_eq!(held.await.unwrap(), Ok(true));
        assert_eq!(pool.run(|| 1).await, Ok(1), "the thread is free again");
        assert!(has_begun.recv().is_err(), "it was dropped, not begun");
    }

    #[test]
    fn nested_parallel_work_stays_on_the_pool() {
        let pool = SimulationPool::new(NonZeroUsize::new(3)).unwrap();
        assert_eq!(pool.block_on(rayon::current_num_threads), 3);
    }
}
