//! Fork-join over independent pieces of work, on the threads of the pool that the caller runs in.
//!
//! Results do not depend on the number of threads: a caller divides its work into pieces by the size of its data alone,
//! and adds up what the pieces return in their order.

/// Calls `work` once for each piece of work, with the piece's index and state, side by side where there are threads.
pub(crate) fn for_each<S: Send>(pieces: &mut [S], work: impl Fn(usize, &mut S) + Sync) {
    #[cfg(feature = "threads")]
    if pieces.len() > 1 && pool::has_threads() {
        return pool::halve(0, pieces, &work);
    }
    for (index, piece) in pieces.iter_mut().enumerate() {
        work(index, piece);
    }
}

/// Runs two pieces of work, side by side where there are threads, and returns what both return.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "threads")]
    if pool::has_threads() {
        return rayon_core::join(a, b);
    }
    (a(), b())
}

/// Handle of a pool of threads, of which there is one for each size in a process. Without the feature `threads`, and
/// where threads cannot be started, the pool is the caller's own thread.
#[derive(Debug, Clone)]
pub(crate) struct Pool {
    #[cfg(feature = "threads")]
    threads: Option<std::sync::Arc<rayon_core::ThreadPool>>,
}

impl Pool {
    /// Returns the pool of a number of threads, which are started when it is first asked for.
    #[cfg(feature = "threads")]
    pub(crate) fn new(threads: usize) -> Self {
        Pool {
            threads: (threads > 1).then(|| pool::start(threads)).flatten(),
        }
    }

    /// Returns the pool of the caller's own thread.
    #[cfg(not(feature = "threads"))]
    pub(crate) fn new(_: usize) -> Self {
        Pool {}
    }

    /// Number of threads in the pool.
    pub(crate) fn len(&self) -> usize {
        #[cfg(feature = "threads")]
        if let Some(pool) = &self.threads {
            return pool.current_num_threads();
        }
        1
    }

    /// Runs `work` in the pool: [`for_each`] within it uses the pool's threads.
    pub(crate) fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        #[cfg(feature = "threads")]
        if let Some(pool) = &self.threads {
            return pool.install(work);
        }
        work()
    }
}

#[cfg(feature = "threads")]
mod pool {
    use std::cell::Cell;
    use std::sync::{Arc, Mutex, PoisonError};

    use rayon_core::{ThreadPool, ThreadPoolBuilder};

    /// Pools that have been started, one for each number of threads.
    static POOLS: Mutex<Vec<Arc<ThreadPool>>> = Mutex::new(Vec::new());

    /// Returns the pool of a number of threads; `None` where they cannot be started.
    pub(super) fn start(threads: usize) -> Option<Arc<ThreadPool>> {
        let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
        let started = pools
            .iter()
            .find(|pool| pool.current_num_threads() == threads);
        if let Some(pool) = started {
            return Some(pool.clone());
        }
        let builder = ThreadPoolBuilder::new()
            .num_threads(threads)
            .start_handler(|_| IS_IN_POOL.set(true))
            .thread_name(|index| format!("developable-{index}"));
        let pool = Arc::new(builder.build().ok()?);
        pools.push(pool.clone());
        Some(pool)
    }

    thread_local! {
        /// Whether the thread belongs to one of these pools, not to a pool that the library's user has made.
        static IS_IN_POOL: Cell<bool> = const { Cell::new(false) };
    }

    /// Returns whether the caller runs in one of these pools, which have more than one thread.
    pub(super) fn has_threads() -> bool {
        IS_IN_POOL.get()
    }

    /// Calls `work` for each piece, one half of the pieces beside the other; `first` is the index of the first piece.
    pub(super) fn halve<S: Send>(
        first: usize,
        pieces: &mut [S],
        work: &(impl Fn(usize, &mut S) + Sync),
    ) {
        if let [piece] = pieces {
            return work(first, piece);
        }
        let middle = pieces.len() / 2;
        let (left, right) = pieces.split_at_mut(middle);
        rayon_core::join(
            || halve(first, left, work),
            || halve(first + middle, right, work),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_done_once_with_its_index() {
        for threads in [1, 2, 5] {
            for count in [0usize, 1, 2, 3, 64, 65] {
                let mut pieces = vec![0; count];
                Pool::new(threads).run(|| {
                    for_each(&mut pieces, |index, piece| *piece += index + 1);
                });
                assert!(pieces.into_iter().eq(1..=count), "{threads} {count}");
            }
        }
    }
}
