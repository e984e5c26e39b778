//! Fork-join on threads that the program has started and hands to the library, as WebAssembly's workers.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Threads that a program has started itself, where the library cannot start any. One thread of the program calls the
/// library, and is the team's first.
pub trait ThreadTeam: Sync {
    /// Number of threads, the calling one among them.
    fn thread_count(&self) -> usize;

    /// Calls `work` once with each index below `count`, on at most `threads` threads; returns when all calls have.
    fn run(&self, threads: usize, count: usize, work: &(dyn Fn(usize) + Sync));
}

static TEAM: OnceLock<&'static dyn ThreadTeam> = OnceLock::new();

/// Maximum number of threads of the work in progress: 1 outside of [`run`].
static MAX_ACTIVE_THREADS: AtomicUsize = AtomicUsize::new(1);

/// Whether the team is at work, so that pieces within a piece are done one after the other.
static IS_BUSY: AtomicBool = AtomicBool::new(false);

/// Lets all solves from now on use a team's threads. A second team is ignored.
pub fn set_thread_team(team: &'static dyn ThreadTeam) {
    let _ = TEAM.set(team);
}

/// Number of threads in the team.
pub(crate) fn available_threads() -> usize {
    TEAM.get().map_or(1, |team| team.thread_count())
}

/// Returns how many threads of a number there are.
pub(super) fn start(threads: usize) -> usize {
    threads.min(available_threads())
}

/// Runs `work` with a number of threads.
pub(super) fn run<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    MAX_ACTIVE_THREADS.store(threads, Ordering::Relaxed);
    let result = work();
    MAX_ACTIVE_THREADS.store(1, Ordering::Relaxed);
    result
}

/// Returns whether there is more than one thread for the caller's pieces.
pub(super) fn has_threads() -> bool {
    MAX_ACTIVE_THREADS.load(Ordering::Relaxed) > 1 && !IS_BUSY.load(Ordering::Relaxed)
}

/// Calls `work` for each piece.
pub(super) fn for_each<S: Send>(pieces: &mut [S], work: &(impl Fn(usize, &mut S) + Sync)) {
    let pieces: Vec<_> = pieces.iter_mut().map(Mutex::new).collect();
    side_by_side(pieces.len(), &|index| {
        let mut piece = pieces[index].lock().unwrap_or_else(PoisonError::into_inner);
        work(index, &mut piece);
    });
}

/// Runs two pieces of work one after the other: [`for_each`] within each has all threads then.
pub(super) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    (a(), b())
}

/// Calls `work` with each index below `count`, on the team's threads.
fn side_by_side(count: usize, work: &(dyn Fn(usize) + Sync)) {
    IS_BUSY.store(true, Ordering::Relaxed);
    match TEAM.get() {
        Some(team) => team.run(MAX_ACTIVE_THREADS.load(Ordering::Relaxed), count, work),
        None => (0..count).for_each(work),
    }
    IS_BUSY.store(false, Ordering::Relaxed);
}
