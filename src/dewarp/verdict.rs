//! Whether a flat image is to be trusted.

use crate::unroll::UnrollReport;

/// Whether a flat image is to be trusted, in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Verdict {
    /// The page was flat to begin with, and faced the camera: the photo can be used as it is.
    Flat,
    /// The page was bent and is flat now, with lengths as on the page.
    Unrolled,
    /// The surface cannot be laid flat without stretching it, or its sheet lies on itself: some
    /// lengths are wrong.
    Stretched,
}

impl Verdict {
    /// From how a surface was unrolled: flat if the view from above is true to 0.2 % already;
    /// stretched from strains of 1 % on, or where the layout overlaps or is flipped.
    pub fn of(report: &UnrollReport) -> Self {
        /// Root mean squares of the strains.
        const FLAT: f64 = 0.002;
        const STRETCHED: f64 = 0.01;
        let sheet = report.distortion;
        if sheet.rms > STRETCHED || sheet.flipped > 0 || report.crossings > 0 {
            Verdict::Stretched
        } else if report.plan.rms < FLAT {
            Verdict::Flat
        } else {
            Verdict::Unrolled
        }
    }
}
