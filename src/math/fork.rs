//! Fork-join over independent pieces of work, on the threads of the pool that the caller runs in.
//!
//! Results do not depend on the number of threads: a caller divides its work into pieces by the size of its data alone,
//! and adds up what the pieces return in their order.

#[cfg(feature = "threads")]
#[path = "fork/rayon.rs"]
mod backend;
#[cfg(all(feature = "thread-team", not(feature = "threads")))]
#[path = "fork/team.rs"]
mod backend;
#[cfg(not(any(feature = "thread-team", feature = "threads")))]
#[path = "fork/single.rs"]
mod backend;

pub(crate) use backend::available_threads;
#[cfg(all(feature = "thread-team", not(feature = "threads")))]
pub use backend::{ThreadTeam, set_thread_team};

/// Whether the library was built with a feature that lets it use more than one thread.
pub(crate) const HAS_POOLS: bool = cfg!(any(feature = "thread-team", feature = "threads"));

/// Calls `work` once for each piece of work, with the piece's index and state, side by side where there are threads.
pub(crate) fn for_each<S: Send>(pieces: &mut [S], work: impl Fn(usize, &mut S) + Sync) {
    if pieces.len() > 1 && !is_serial() {
        return backend::for_each(pieces, &work);
    }
    for (index, piece) in pieces.iter_mut().enumerate() {
        work(index, piece);
    }
}

/// Returns whether [`for_each`] does its pieces one after the other, on the calling thread.
pub(crate) fn is_serial() -> bool {
    !backend::has_threads()
}

/// Runs two pieces of work, side by side where there are threads, and returns what both return.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    if is_serial() {
        return (a(), b());
    }
    backend::join(a, b)
}

/// A pool of threads, of which there is one for each size in a process. Where threads cannot be started, the pool is the
/// caller's own thread.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pool {
    threads: usize,
}

impl Pool {
    /// Returns the pool of at most a number of threads, which are started when it is first asked for.
    pub(crate) fn new(threads: usize) -> Self {
        let threads = match threads {
            0 | 1 => 1,
            _ => backend::start(threads),
        };
        Pool { threads }
    }

    /// Number of threads in the pool.
    pub(crate) fn len(self) -> usize {
        self.threads
    }

    /// Runs `work` in the pool: [`for_each`] within it uses the pool's threads.
    pub(crate) fn run<R: Send>(self, work: impl FnOnce() -> R + Send) -> R {
        match self.threads {
            1 => work(),
            threads => backend::run(threads, work),
        }
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
