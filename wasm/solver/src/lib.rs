//! Solver for heightfields, detection of occlusions, and examples, for JavaScript.

mod cylinder;
mod examples;
mod occlusions;
mod results;
mod settings;
mod solver;
mod source;
