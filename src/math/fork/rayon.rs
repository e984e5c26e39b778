//! Fork-join on threads of the process, in pools of rayon-core.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use rayon_core::{ThreadPool, ThreadPoolBuilder, Yield};

/// Pools that have been started, one for each number of threads.
static POOLS: Mutex<Vec<Arc<ThreadPool>>> = Mutex::new(Vec::new());

/// Number of cores that the process may use.
pub(crate) fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Starts the pool of a number of threads; returns that number, or 1 where they cannot be started.
pub(super) fn start(threads: usize) -> usize {
    pool_of(threads).map_or(1, |pool| pool.current_num_threads())
}

/// Returns the pool of a number of threads; `None` where they cannot be started.
fn pool_of(threads: usize) -> Option<Arc<ThreadPool>> {
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

/// Runs `work` in the pool of a number of threads, whose other threads look for work until it is done: one that slept would take longer to
/// wake up than most fork-joins take.
pub(super) fn run<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    let Some(pool) = pool_of(threads) else {
        return work();
    };
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

/// Calls `work` for each piece.
pub(super) fn for_each<S: Send>(pieces: &mut [S], work: &(impl Fn(usize, &mut S) + Sync)) {
    halve(0, pieces, work);
}

/// Calls `work` for each piece, one half of the pieces beside the other; `first` is the index of the first piece.
fn halve<S: Send>(first: usize, pieces: &mut [S], work: &(impl Fn(usize, &mut S) + Sync)) {
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
