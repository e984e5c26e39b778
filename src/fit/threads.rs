//! Threads of a solve: how many it uses, and why not more.

use crate::lattice::domain::Domain;
use crate::math::fork::{HAS_POOLS, Pool, available_threads};

/// Maximum number of threads of a solve that can be asked for.
pub(crate) const MAX_THREADS: usize = 256;

/// Reason why a solve did not use more threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum ThreadLimit {
    /// No more were asked for by the option [`Options::threads`](crate::Options::threads).
    Options,
    /// The process may use no more cores.
    Cores,
    /// The surface has too few vertices: each thread gets at least some thousand.
    Vertices,
    /// The library was built without a feature for threads, or no other threads were started for it.
    Build,
    /// The system did not start more threads.
    System,
}

/// Threads of one solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Threads {
    pool: Pool,
    limit: ThreadLimit,
}

impl Threads {
    /// Takes the number of threads that is `asked` for, or one for each core, but no more than have work on a domain.
    pub(crate) fn new(asked: Option<usize>, domain: &Domain) -> Self {
        let (wanted, limit) = match asked {
            Some(asked) => (asked, ThreadLimit::Options),
            None => (available_threads(), ThreadLimit::Cores),
        };
        let bands = domain.bands().len();
        let (wanted, limit) = if !HAS_POOLS {
            (1, ThreadLimit::Build)
        } else if bands < wanted {
            (bands, ThreadLimit::Vertices)
        } else {
            (wanted, limit)
        };
        let pool = Pool::new(wanted);
        let limit = if pool.len() < wanted {
            ThreadLimit::System
        } else {
            limit
        };
        Threads { pool, limit }
    }

    /// Number of threads.
    pub(crate) fn len(self) -> usize {
        self.pool.len()
    }

    /// Reason why there are not more threads.
    pub(crate) fn limit(self) -> ThreadLimit {
        self.limit
    }

    /// Runs a part of the solve on these threads.
    pub(crate) fn run<R: Send>(self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.run(work)
    }
}
