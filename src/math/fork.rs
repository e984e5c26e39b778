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

/// Returns whether [`for_each`] does its pieces one after the other, on the calling thread.
pub(crate) fn is_serial() -> bool {
    #[cfg(feature = "threads")]
    if pool::has_threads() {
        return false;
    }
    true
}

/// Runs two pieces of work, side by side where there are threads, and returns what both return.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "threads")]
    if pool::has_threads() {
        return pool::join(a, b);
    }
    (a(), b())
}

/// A pool of threads, of which there is one for each size in a process. Without the feature `threads`, and where threads
/// cannot be started, the pool is the caller's own thread.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pool {
    threads: usize,
}

impl Pool {
    /// Returns the pool of a number of threads, which are started when it is first asked for.
    pub(crate) fn new(threads: usize) -> Self {
        let is_there = threads > 1 && pool_of(threads).is_some();
        Pool {
            threads: if is_there { threads } else { 1 },
        }
    }

    /// Number of threads in the pool.
    pub(crate) fn len(self) -> usize {
        self.threads
    }

    /// Runs `work` in the pool: [`for_each`] within it uses the pool's threads.
    pub(crate) fn run<R: Send>(self, work: impl FnOnce() -> R + Send) -> R {
        #[cfg(feature = "threads")]
        if self.threads > 1
            && let Some(pool) = pool_of(self.threads)
        {
            return pool::run(&pool, work);
        }
        work()
    }
}

#[cfg(feature = "threads")]
use pool::start as pool_of;

/// Returns no pool.
#[cfg(not(feature = "threads"))]
fn pool_of(_: usize) -> Option<()> {
    None
}

#[cfg(feature = "threads")]
mod pool {
    use std::cell::Cell;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Arc, Mutex, PoisonError};

    use rayon_core::{ThreadPool, ThreadPoolBuilder, Yield};

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

    /// Number of times that an idle thread looks for work before it lets other processes have its core: about as long as
    /// the work between two fork-joins takes.
    const IDLE_LOOKS: u32 = 4096;

    thread_local! {
        /// Number of pieces of work, one within the other, that the thread is at.
        static DEPTH: Cell<usize> = const { Cell::new(0) };
    }

    /// Runs `work` in a pool, whose other threads look for work until it is done: one that slept would take longer to
    /// wake up than most fork-joins take.
    pub(super) fn run<R: Send>(pool: &ThreadPool, work: impl FnOnce() -> R + Send) -> R {
        let done = Done(Arc::new(AtomicBool::new(false)));
        let is_done = done.0.clone();
        pool.spawn_broadcast(move |_| look_for_work(&is_done));
        pool.install(|| at_work(work))
    }

    /// Does a piece of work, within which the thread does not [look for](look_for_work) other work.
    fn at_work<R>(work: impl FnOnce() -> R) -> R {
        DEPTH.set(DEPTH.get() + 1);
        let result = work();
        DEPTH.set(DEPTH.get() - 1);
        result
    }

    /// Executes other threads' pieces of work until the work as a whole is done. A thread that waits within a piece
    /// returns at once: the work as a whole may wait for that piece.
    fn look_for_work(is_done: &AtomicBool) {
        let mut looks = 0;
        while DEPTH.get() == 0 && !is_done.load(Ordering::Acquire) {
            if rayon_core::yield_now() == Some(Yield::Executed) {
                looks = 0;
            } else if looks < IDLE_LOOKS {
                looks += 1;
                std::hint::spin_loop();
            } else {
                std::thread::yield_now();
            }
        }
    }

    /// Sets a flag when it is dropped, as after a panic too.
    struct Done(Arc<AtomicBool>);

    impl Drop for Done {
        fn drop(&mut self) {
            self.0.store(true, Ordering::Release);
        }
    }

    /// Runs two pieces of work side by side.
    pub(super) fn join<A: Send, B: Send>(
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        rayon_core::join(|| at_work(a), || at_work(b))
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
        join(
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

    /// A thread that waits for another one's piece must not begin with what waits for that piece.
    #[test]
    fn callers_at_the_same_time_share_a_pool_without_a_deadlock() {
        let sum_of_squares = |pieces: &mut Vec<usize>| {
            for_each(pieces, |index, piece| {
                let (a, b) = join(|| index * index, || *piece);
                *piece = a + b;
            });
            pieces.iter().sum::<usize>()
        };
        std::thread::scope(|scope| {
            for caller in 0..6 {
                scope.spawn(move || {
                    let pool = Pool::new(2 + caller % 2);
                    for _ in 0..300 {
                        let sum = pool.run(|| sum_of_squares(&mut vec![caller; 23]));
                        assert_eq!(sum, 23 * caller + 22 * 23 * 45 / 6);
                    }
                });
            }
        });
    }

    #[test]
    #[cfg(feature = "threads")]
    fn a_pool_works_after_a_panic() {
        let pool = Pool::new(2);
        let panics = || {
            for_each(&mut [0; 8], |index, _| assert!(index < 5, "as asked for"));
        };
        let result = std::panic::catch_unwind(|| pool.run(panics));
        assert!(result.is_err());
        let mut pieces = [1; 8];
        pool.run(|| for_each(&mut pieces, |_, piece| *piece += 1));
        assert_eq!(pieces, [2; 8]);
    }
}
