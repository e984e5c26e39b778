//! Noisy surfaces whose true shape is known: to try the solver on, and to measure it by.

mod example;
mod generate;
mod shapes;

pub use example::Example;
pub use generate::{ExampleOptions, Sample};
