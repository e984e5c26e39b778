//! Options of tracing rulings.

use crate::error::{Error, Result, positive};

/// Which lines are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TraceOptions {
    /// Distance between lines, in the surface's units: as seen from above, or in space on a mesh. `None`: ten
    /// spacings, or lengths of an edge.
    pub separation: Option<f64>,
    /// A line ends where the direction is trusted by less, from 0 to 1. Default 0.3.
    pub confidence: f64,
    /// A line ends where the surface bends by more from one vertex to the next, in radians: at a
    /// crease. Default 0.2.
    pub crease: f64,
}

impl Default for TraceOptions {
    fn default() -> Self {
        TraceOptions {
            separation: None,
            confidence: 0.3,
            crease: 0.2,
        }
    }
}

impl TraceOptions {
    /// These options with another distance.
    pub fn separation(self, separation: f64) -> Self {
        TraceOptions {
            separation: Some(separation),
            ..self
        }
    }

    /// These options with another least confidence.
    pub fn confidence(self, confidence: f64) -> Self {
        TraceOptions { confidence, ..self }
    }

    /// These options with another angle.
    pub fn crease(self, crease: f64) -> Self {
        TraceOptions { crease, ..self }
    }

    /// The distance between lines where neighbours have one of `spacing`.
    pub(super) fn checked(&self, spacing: f64) -> Result<f64> {
        positive("crease", self.crease)?;
        if !(0.0..=1.0).contains(&self.confidence) {
            let requirement = "must be from 0 to 1";
            return Err(Error::option("confidence", self.confidence, requirement));
        }
        match self.separation {
            Some(separation) => positive("separation", separation),
            None => Ok(10.0 * spacing),
        }
    }
}
