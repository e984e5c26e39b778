//! The result of a solve: heights on the lattice, and its report.

use super::report::Report;
use crate::heights::heightfield::Heightfield;

/// A solved surface.
///
/// It has a height wherever the input had one, omitted vertices included.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    pub(crate) heightfield: Heightfield,
    pub(crate) report: Report,
}

impl Surface {
    /// The heights, in the input's units.
    pub fn heightfield(&self) -> &Heightfield {
        &self.heightfield
    }

    /// The heights, in the input's units.
    pub fn into_heightfield(self) -> Heightfield {
        self.heightfield
    }

    /// The report of the solve: what was solved, how well, and at what cost.
    pub fn report(&self) -> &Report {
        &self.report
    }
}
