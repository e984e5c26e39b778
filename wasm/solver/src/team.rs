//! Team of threads in one memory: the solver's own, and helpers, which are further instances of this module in workers of
//! their own, each with its own stack.
//!
//! Only the solver's instance uses JavaScript's objects and the standard library's thread-locals: it is built for one
//! thread. A mutex of the standard library is locked on helpers, too (`src/math/fork/team.rs`). Helpers run pieces of a job, which are numerics, and the allocator has a lock.

use std::cell::{RefCell, UnsafeCell};
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use developable::checks::try_filled;
use developable::{ThreadTeam, set_thread_team};
use js_sys::Function;
use wasm_bindgen::prelude::*;

use developable_wasm::Result;

/// Size of a helper's stack in bytes.
const HELPER_STACK_BYTES: usize = 1 << 20;

/// Alignment of the top of a stack in bytes.
const STACK_ALIGNMENT: usize = 16;

/// Size of the guard below a stack in bytes, which no frame reaches: wasm has no pages that trap.
const GUARD_BYTES: usize = 1 << 10;

/// Value of each byte of a guard, and of a stack that nobody has used.
const GUARD_BYTE: u8 = 0xa5;

/// Number of times that an idle helper looks for a job before it sleeps: about a millisecond, longer than nearly all work
/// between two jobs. To sleep and wake up takes longer than most jobs.
const MAX_IDLE_LOOKS: u32 = 1 << 20;

/// Number of times that the solver looks whether helpers have finished before it lets other processes have its core: about a
/// millisecond, so that it does so only where helpers do not have a core of their own.
const MAX_BUSY_LOOKS: u32 = 1 << 20;

/// Bit of [`GATE`] that is set while helpers may begin to work at the job; the others count those at work.
const OPEN: u32 = 1 << 31;

/// The job in progress, or the last one.
struct Job {
    work: Option<&'static (dyn Fn(usize) + Sync)>,
    /// Number of pieces.
    count: usize,
}

struct SharedJob(UnsafeCell<Job>);

// SAFETY: the solver writes the job while the gate is closed and no helper is at work; helpers read it while they are
// counted in the gate.
unsafe impl Sync for SharedJob {}

static JOB: SharedJob = SharedJob(UnsafeCell::new(Job {
    work: None,
    count: 0,
}));

static GATE: AtomicU32 = AtomicU32::new(0);

/// Maximum number of helpers at the job.
static MAX_HELPERS: AtomicU32 = AtomicU32::new(0);

/// Index of the next piece that nobody has begun.
static NEXT_PIECE: AtomicUsize = AtomicUsize::new(0);

/// Number of jobs so far, whose change sleeping helpers wait for.
static JOB_COUNT: AtomicU32 = AtomicU32::new(0);

/// Number of helpers that have started.
static HELPER_COUNT: AtomicU32 = AtomicU32::new(0);

/// Number of helpers that sleep, or are about to.
static SLEEPING_COUNT: AtomicU32 = AtomicU32::new(0);

/// Number of helpers that have crashed: JavaScript counts them.
static CRASH_COUNT: AtomicU32 = AtomicU32::new(0);

/// Whether a helper has crashed.
pub(crate) fn has_crashed() -> bool {
    CRASH_COUNT.load(Ordering::Relaxed) > 0
}

thread_local! {
    /// The solver's functions [`wake` and `pause`](lead_team).
    static FUNCTIONS: RefCell<Option<[Function; 2]>> = const { RefCell::new(None) };
}

struct Team;

impl ThreadTeam for Team {
    fn thread_count(&self) -> usize {
        1 + HELPER_COUNT.load(Ordering::Acquire) as usize
    }

    fn run(&self, threads: usize, count: usize, work: &(dyn Fn(usize) + Sync)) {
        // SAFETY: the lifetime ends with this call, and the gate is closed and left by all helpers before that. Nobody
        // else reads or writes the job now: the gate is closed since the last job.
        unsafe {
            let work = std::mem::transmute::<
                &(dyn Fn(usize) + Sync),
                &'static (dyn Fn(usize) + Sync),
            >(work);
            *JOB.0.get() = Job {
                work: Some(work),
                count,
            };
        }
        let helpers = threads.min(count).saturating_sub(1) as u32;
        MAX_HELPERS.store(helpers, Ordering::Relaxed);
        NEXT_PIECE.store(0, Ordering::Relaxed);
        GATE.store(OPEN, Ordering::Release);
        JOB_COUNT.fetch_add(1, Ordering::SeqCst);
        if SLEEPING_COUNT.load(Ordering::SeqCst) > 0 {
            call(0, helpers);
        }
        run_pieces(count, work);
        GATE.fetch_and(!OPEN, Ordering::AcqRel);
        let mut looks = 0;
        while GATE.load(Ordering::Acquire) != 0 {
            assert!(!has_crashed(), "a helper of the team has crashed");
            if looks < MAX_BUSY_LOOKS {
                looks += 1;
                std::hint::spin_loop();
            } else {
                call(1, 0);
            }
        }
    }
}

/// Calls the solver's function `wake` (0) or `pause` (1).
fn call(function: usize, argument: u32) {
    FUNCTIONS.with_borrow(|functions| {
        if let Some(functions) = functions {
            // Without it helpers sleep on and the solver looks more often: the result is the same.
            let _ = functions[function].call1(&JsValue::UNDEFINED, &argument.into());
        }
    });
}

/// Runs pieces until all have been begun.
fn run_pieces(count: usize, work: &(dyn Fn(usize) + Sync)) {
    loop {
        let piece = NEXT_PIECE.fetch_add(1, Ordering::Relaxed);
        if piece >= count {
            return;
        }
        work(piece);
    }
}

/// Makes the calling instance the solver's. `wake(count)` wakes sleeping helpers up, and `pause()` lets other processes
/// have the core for a moment. Returns the addresses of the numbers of jobs and of crashes.
#[wasm_bindgen(js_name = leadTeam)]
pub fn lead_team(wake: Function, pause: Function) -> Vec<usize> {
    FUNCTIONS.set(Some([wake, pause]));
    set_thread_team(&Team);
    vec![JOB_COUNT.as_ptr() as usize, CRASH_COUNT.as_ptr() as usize]
}

/// Allocates the stack of a helper, with a guard below it, and returns the address of its top.
#[wasm_bindgen(js_name = helperStack)]
pub fn helper_stack() -> Result<usize> {
    let size = GUARD_BYTES + HELPER_STACK_BYTES + STACK_ALIGNMENT;
    let memory = try_filled("stack of a thread", size, GUARD_BYTE)?.leak();
    let top = memory.as_ptr_range().end as usize / STACK_ALIGNMENT * STACK_ALIGNMENT;
    Ok(top)
}

/// Traps if a helper whose stack has this top has written below it.
fn check_guard(top: usize) {
    let guard = (top - HELPER_STACK_BYTES - GUARD_BYTES) as *const u8;
    // SAFETY: `helper_stack` has allocated these bytes for good, and only a helper that overflows writes them.
    let is_sound = |i| unsafe { guard.add(i).read_volatile() } == GUARD_BYTE;
    if !(0..GUARD_BYTES).all(is_sound) {
        std::process::abort();
    }
}

/// Joins the team as a helper; [`help`] is called next.
#[unsafe(no_mangle)]
pub extern "C" fn join_team() {
    SLEEPING_COUNT.fetch_add(1, Ordering::SeqCst);
    HELPER_COUNT.fetch_add(1, Ordering::SeqCst);
}

/// Helps with jobs until there has been none for a while, on the stack with this [top](helper_stack). Returns the number
/// of jobs by then, whose change the caller waits for before the next call.
#[unsafe(no_mangle)]
pub extern "C" fn help(stack: usize) -> u32 {
    SLEEPING_COUNT.fetch_sub(1, Ordering::SeqCst);
    let mut last = None;
    let mut looks = 0;
    loop {
        let jobs = JOB_COUNT.load(Ordering::SeqCst);
        if last != Some(jobs) {
            last = Some(jobs);
            if enter() {
                // SAFETY: the solver does not change the job while this helper is counted in the gate.
                let job = unsafe { &*JOB.0.get() };
                if let Some(work) = job.work {
                    run_pieces(job.count, work);
                }
                // While the solver waits for this helper: it hears of the crash.
                check_guard(stack);
                GATE.fetch_sub(1, Ordering::Release);
            }
            looks = 0;
        } else if looks < MAX_IDLE_LOOKS {
            looks += 1;
            std::hint::spin_loop();
        } else {
            SLEEPING_COUNT.fetch_add(1, Ordering::SeqCst);
            return jobs;
        }
    }
}

/// Counts the calling helper among those at work, if the gate is open and there are not enough already.
fn enter() -> bool {
    let enough = OPEN + MAX_HELPERS.load(Ordering::Relaxed);
    GATE.fetch_update(Ordering::Acquire, Ordering::Relaxed, |gate| {
        (OPEN..enough).contains(&gate).then_some(gate + 1)
    })
    .is_ok()
}
