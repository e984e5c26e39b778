//! Allocator that all threads of the memory can use: the standard library's own has no lock in a build for one thread.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::team::has_crashed;

#[global_allocator]
static ALLOCATOR: LockedAllocator = LockedAllocator {
    is_locked: AtomicBool::new(false),
};

/// The system's allocator behind a spin lock.
struct LockedAllocator {
    is_locked: AtomicBool,
}

impl LockedAllocator {
    /// Calls `allocate` while no other thread allocates. Traps if a helper has crashed, which may hold the lock for ever.
    fn locked<T>(&self, allocate: impl FnOnce() -> T) -> T {
        while self.is_locked.swap(true, Ordering::Acquire) {
            if has_crashed() {
                std::process::abort();
            }
            std::hint::spin_loop();
        }
        let result = allocate();
        self.is_locked.store(false, Ordering::Release);
        result
    }
}

// SAFETY: every call is handed to the system's allocator as it is, one at a time.
unsafe impl GlobalAlloc for LockedAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller meets the requirements of the same function.
        self.locked(|| unsafe { System.alloc(layout) })
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        self.locked(|| unsafe { System.alloc_zeroed(layout) })
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above.
        self.locked(|| unsafe { System.realloc(pointer, layout, size) })
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        self.locked(|| unsafe { System.dealloc(pointer, layout) });
    }
}
