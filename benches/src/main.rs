//! One measurement: a task as JSON in, what it cost and what came out as JSON.
//!
//! `npm run bench` runs this program once for each measurement.

mod cholesky;
mod conic;
mod energy;
mod input;
mod library;
mod memory;
mod restart;
mod task;

use std::error::Error;

use task::{Method, Task, best};

#[global_allocator]
static HEAP: memory::Heap = memory::Heap;

fn main() -> Result<(), Box<dyn Error>> {
    let json = std::env::args().nth(1).ok_or("the task is missing")?;
    let task: Task = serde_json::from_str(&json)?;
    let field = input::read(&task.input)?;
    let measurement = best(|| match task.method {
        Method::Library => match &task.from {
            None => library::solve(&field, &task.options),
            Some(from) => restart::solve(&field, from, &task.options),
        },
        Method::Cholesky => cholesky::solve(&field, &task.options),
        Method::Conic => conic::solve(&field, &task.options),
    })?;
    println!("{}", serde_json::to_string(&measurement)?);
    Ok(())
}
