//! Solver for heightfields, detection of occlusions, and examples, for JavaScript.

mod cylinder;
mod examples;
#[cfg(feature = "threads")]
mod locked_allocator;
mod occlusions;
mod results;
mod settings;
mod solver;
mod source;
#[cfg(feature = "threads")]
mod team;
