//! Timing of what ADMM does at some checks only: balancing the dual, changing ρ, and dual ascent.

/// Timer of a repeated task that waits for at least a quarter of the ADMM iterations so far between two times.
///
/// Growing intervals make ρ settle in the end, without which ADMM need not converge (Boyd et al., Sec. 3.4.1), and
/// bound the share of the time that costly work takes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct GrowingInterval {
    last: usize,
}

impl GrowingInterval {
    /// Returns whether the interval, with `extra` iterations added to it, has passed at this iteration.
    pub(super) fn has_passed(&self, iteration: usize, extra: usize) -> bool {
        iteration >= self.last + self.last / 4 + extra
    }

    /// Starts the next interval at this iteration.
    pub(super) fn restart(&mut self, iteration: usize) {
        self.last = iteration;
    }
}

/// Timer that decides at which iteration dual ascent is tried again.
#[derive(Debug, Clone, Copy)]
pub(super) struct AscentTimer {
    next_iteration: usize,
    pass_start: usize,
    has_settled: bool,
}

impl AscentTimer {
    /// Makes a timer that allows no dual ascent before `first_iteration`.
    pub(super) fn new(first_iteration: usize) -> Self {
        AscentTimer {
            next_iteration: first_iteration,
            pass_start: 0,
            has_settled: false,
        }
    }

    /// Resets the timer at `iteration`, for another pass with other penalty weights.
    pub(super) fn begin_pass(&mut self, iteration: usize) {
        *self = AscentTimer {
            next_iteration: iteration,
            pass_start: iteration,
            has_settled: false,
        };
    }

    /// Records that the objective no longer falls, so that only the dual bound can improve. The first time, dual ascent
    /// is due at once, however long coarser levels have taken.
    pub(super) fn note_settled(&mut self, iteration: usize) {
        if !self.has_settled {
            self.has_settled = true;
            self.next_iteration = self.next_iteration.min(iteration);
        }
    }

    /// Returns whether dual ascent is due at this iteration.
    pub(super) fn is_due(&self, iteration: usize) -> bool {
        iteration >= self.next_iteration
    }

    /// Records the duality gap that an ascent has left, as a multiple of the requested one, and sets the next ascent's
    /// iteration by it: gaps hardly fall faster than with the square of the iterations.
    pub(super) fn note_ascent(&mut self, iteration: usize, gap_ratio: f64) {
        let iterations = (iteration - self.pass_start) as f64;
        self.next_iteration = self.pass_start + (iterations * gap_ratio.sqrt()) as usize;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_grow_by_a_quarter() {
        let mut interval = GrowingInterval::default();
        assert!(interval.has_passed(0, 0) && !interval.has_passed(19, 20));
        interval.restart(40);
        assert!(!interval.has_passed(49, 0) && interval.has_passed(50, 0));
        assert!(!interval.has_passed(69, 20) && interval.has_passed(70, 20));
    }

    #[test]
    fn a_gap_of_four_times_the_goal_takes_twice_the_iterations() {
        let mut timer = AscentTimer::new(30);
        assert!(!timer.is_due(29) && timer.is_due(30));
        timer.note_settled(20);
        assert!(timer.is_due(20));
        timer.begin_pass(50);
        timer.note_ascent(70, 4.0);
        assert!(!timer.is_due(89) && timer.is_due(90));
        // Only the first time in a pass.
        timer.note_settled(75);
        timer.note_ascent(80, 4.0);
        timer.note_settled(85);
        assert!(!timer.is_due(109) && timer.is_due(110));
    }
}
