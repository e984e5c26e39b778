//! Fork-join without threads.

/// Number of threads that a solve can use: the caller's.
pub(crate) fn available_threads() -> usize {
    1
}

/// Returns the number of threads that there are.
pub(super) fn start(_: usize) -> usize {
    1
}

/// Runs `work`.
pub(super) fn run<R: Send>(_: usize, work: impl FnOnce() -> R + Send) -> R {
    work()
}

/// Returns whether there is more than one thread.
pub(super) fn has_threads() -> bool {
    false
}

/// Calls `work` for each piece.
pub(super) fn for_each<S: Send>(pieces: &mut [S], work: &(impl Fn(usize, &mut S) + Sync)) {
    for (index, piece) in pieces.iter_mut().enumerate() {
        work(index, piece);
    }
}

/// Runs two pieces of work.
pub(super) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    (a(), b())
}
