//! The result of a solve: heights on the lattice, and its report.

use super::report::Report;
use crate::heights::heightfield::Heightfield;

/// Result of a solve: the surface's heights, and the report.
///
/// It has a height wherever the input had one, omitted vertices included.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    pub(crate) heightfield: Heightfield,
    pub(crate) report: Report,
}

impl Surface {
    /// Returns the heights of the surface, in the input's units.
    pub fn heightfield(&self) -> &Heightfield {
        &self.heightfield
    }

    /// Returns the heights of the surface, in the input's units.
    pub fn into_heightfield(self) -> Heightfield {
        self.heightfield
    }

    /// Report of the solve: what was solved, how well, and at what cost.
    pub fn report(&self) -> &Report {
        &self.report
    }
}
