//! Levelling of rows and columns by what surfaces leave of the heights along them.
//!
//! The pixels of an image show by themselves that its lines are offset, but of these offsets only the part that changes from line
//! to line ([`HeightImage::repaired`](crate::HeightImage::repaired)). The rest looks like a shape that is alike all along a line. A surface
//! of low energy follows it less than it follows shapes, and leaves some of it behind, each time that it is solved for. As this
//! rest changes slowly from line to line, a coarse lattice shows it.

use super::closed_form::InputStatistics;
use super::merge::merge;
use super::residual::residuals;
use super::search::{interior_len, trial, trial_options};
use crate::error::Result;
use crate::fit::component_solver::{ComponentSolver, Status};
use crate::fit::input::Input;
use crate::fit::options::{HuberOptions, Options};
use crate::heights::heightfield::Heightfield;
use crate::math::statistics::median;

/// Number of coarse solves by whose residuals rows and columns are levelled, one after the other: each leaves less of the offsets
/// (`benches/scenes.md`, Offsets of rows).
const LEVELLING_SOLVES: usize = 3;

/// Levelling of an input whose rows or columns are offset, in progress.
#[derive(Debug, Clone)]
pub(crate) struct Levelling {
    pub asked: Options,
    /// Options of the coarse solves.
    options: Options,
    statistics: InputStatistics,
    /// Input at full size, levelled as far as it is.
    pub input: Input,
    coarse: Input,
    solve: Box<ComponentSolver>,
    /// Numbers of solves and of their ADMM iterations so far.
    pub solves: usize,
    pub iterations: usize,
}

impl Levelling {
    /// Starts the levelling of a noisy input for a solve with the options that were `asked` for, by coarse solves from the `first`
    /// options on; `None` where no lines are offset, or are levelled already, or there are too few vertices.
    ///
    /// # Errors
    /// Out of memory, and errors of the solver.
    pub(crate) fn new(
        input: &Input,
        asked: &Options,
        first: &Options,
        statistics: InputStatistics,
    ) -> Result<Option<Self>> {
        if input.offset_lines() == [false; 2] || input.is_levelled {
            return Ok(None);
        }
        let coarse = merge(input)?;
        if interior_len(&coarse) == 0 {
            return Ok(None);
        }
        let options = trial_options(first, HuberOptions::ANY);
        let solve = trial(&coarse, &options, statistics, None)?;
        Ok(Some(Levelling {
            asked: *asked,
            options,
            statistics,
            input: input.clone(),
            coarse,
            solve: Box::new(solve),
            solves: 0,
            iterations: 0,
        }))
    }

    /// Continues until `left` conjugate-gradient iterations are used up; returns whether the input is levelled.
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<bool> {
        while *left > 0 {
            if self.solve.advance(left)? == Status::Running {
                continue;
            }
            self.iterations += self.solve.progress().iteration;
            self.solves += 1;
            self.level()?;
            if self.solves == LEVELLING_SOLVES {
                self.input.is_levelled = true;
                return Ok(true);
            }
            let warm_start = self.solve.warm_start(self.coarse.field.lattice());
            self.coarse = merge(&self.input)?;
            *self.solve = trial(&self.coarse, &self.options, self.statistics, warm_start)?;
        }
        Ok(false)
    }

    /// Takes the medians of what the coarse surface leaves along each row, and along each column, out of the input where lines
    /// of its image are offset, interpolated between the coarse lines.
    fn level(&mut self) -> Result<()> {
        let surface = self.solve.surface()?;
        let (domain, surface) = (&self.solve.domain, surface.heightfield());
        let mut residuals = residuals(&self.coarse, domain, surface, 1.0)?;
        let mut heights = self.input.field.heights().to_vec();
        let is_offset = self.input.offset_lines();
        for axis in [0, 1].into_iter().filter(|axis| is_offset[*axis]) {
            let coarse_line = |vertex| lines(&self.coarse, vertex)[axis];
            let mut along: Vec<Vec<f64>> = Vec::new();
            for (vertex, residual) in residuals.iter().enumerate() {
                let line = coarse_line(vertex);
                along.resize_with(along.len().max(line + 1), Vec::new);
                along[line].extend(Some(*residual).filter(|residual| residual.is_finite()));
            }
            let offsets: Vec<Option<f64>> = along.iter_mut().map(|line| median(line)).collect();
            for (vertex, residual) in residuals.iter_mut().enumerate() {
                *residual -= offsets[coarse_line(vertex)].unwrap_or(0.0);
            }
            let known: Vec<[f64; 2]> = (offsets.iter().enumerate())
                .filter_map(|(line, offset)| Some([line as f64, (*offset)?]))
                .collect();
            // The mean of the four vertices of a rhombus is half a line behind the first row, and before the second column.
            let shift = [-0.5, 0.5][axis];
            for vertex in (0..heights.len()).filter(|vertex| !self.input.is_constrained(*vertex)) {
                let line = 0.5 * (lines(&self.input, vertex)[axis] as f64 + shift);
                heights[vertex] -= interpolated(&known, line);
            }
        }
        self.input.field = Heightfield::new(*self.input.field.lattice(), heights)?;
        Ok(())
    }
}

/// Numbers of the row and of the column that a vertex is in, the columns in steps of half a spacing: every odd row is half a spacing
/// to the left.
fn lines(input: &Input, vertex: usize) -> [usize; 2] {
    let cols = input.field.lattice().cols();
    let row = vertex / cols;
    [row, 2 * (vertex % cols) + 1 - row % 2]
}

/// Interpolates between points `[x, y]` with increasing `x`; beyond the first and the last, their `y` goes on. 0 without points.
fn interpolated(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.partition_point(|[at, _]| *at < x);
    match (points.get(after.wrapping_sub(1)), points.get(after)) {
        (Some([left, a]), Some([right, b])) => a + (b - a) * (x - left) / (right - left),
        (Some([_, y]), None) | (None, Some([_, y])) => *y,
        (None, None) => 0.0,
    }
}
