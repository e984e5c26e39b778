//! The solver and the examples: what every page needs.

mod cylinder;
mod examples;
mod occlusions;
mod results;
mod settings;
mod solver;
mod source;
