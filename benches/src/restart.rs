//! The library, from where an earlier solve has left it.

use std::error::Error;
use std::time::Instant;

use developable::{Heightfield, Solver, Status};

use crate::library::{input, options, outcome};
use crate::task::{Outcome, Settings};

pub fn solve(
    field: &Heightfield,
    from: &Settings,
    to: &Settings,
) -> Result<Outcome, Box<dyn Error>> {
    let mut solver = Solver::new(input(field)?, &options(from))?;
    run(&mut solver)?;
    let start = Instant::now();
    solver.restart(&options(to))?;
    run(&mut solver)?;
    let surface = solver.surface()?;
    Ok(Outcome {
        seconds: start.elapsed().as_secs_f64(),
        ..outcome(surface.report())?
    })
}

fn run(solver: &mut Solver) -> developable::Result<()> {
    while solver.advance(1000)? == Status::Running {}
    Ok(())
}
