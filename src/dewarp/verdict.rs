//! Verdict on a flat image: flat, unrolled or stretched, by the sheet's strain.

use crate::unroll::UnrollReport;

/// Maximum root mean square strain between a surface and its view from straight above, and maximum displacement, as
/// [`WarpMap::displacement`](super::WarpMap::displacement) measures it, for the verdict `Flat`: 0.2 % is half a millimetre on a
/// page of A4.
pub(super) const MAX_FLAT_STRAIN: f64 = 0.002;

/// Maximum root mean square strain of the sheet for the verdict `Unrolled`: lengths are wrong by 1 %, 2 mm on a page of
/// A4.
const MAX_UNROLLED_STRAIN: f64 = 0.01;

/// Maximum share of the sheet's area that is strained by more than 1 % for the verdict `Unrolled`: paper does not stretch
/// by that, so that the surface is not the page's. `benches/verdicts.md` has the simulated phone captures that chose it.
const MAX_STRAINED_SHARE: f64 = 0.03;

/// Maximum distance by which a crop may reach beyond the page, as a share of the page's side. Of simulated phone captures all
/// crops along the page's edges are below, see `benches/verdicts.md`.
const MAX_CROP_OVERREACH: f64 = 0.02;

/// Verdict on a flat image: whether it can be trusted.
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
    /// The surface cannot be laid flat without stretching, or its sheet overlaps itself: some lengths are wrong.
    Stretched,
    /// The flat image hardly shows the page: depths of a part of it are missing, or the crop reaches beyond the page in the
    /// photo.
    Doubtful,
}

impl Verdict {
    /// Derives the verdict from the report on an unrolled surface: stretched if its root mean square strain is above
    /// 1 %, if more than 3 % of its area is strained by more than 1 %, or if the layout overlaps or has flipped triangles;
    /// flat if the view from above has a strain below 0.2 %; else unrolled.
    pub fn from_report(report: &UnrollReport) -> Self {
        if Self::has_large_strain(report) || report.distortion.flipped > 0 || report.crossings > 0 {
            Verdict::Stretched
        } else if report.plan.rms < MAX_FLAT_STRAIN {
            Verdict::Flat
        } else {
            Verdict::Unrolled
        }
    }

    /// The verdict where the crop reaches beyond the page by a share of its side, as
    /// [`PageOutline::overreach`](crate::page::PageOutline::overreach) measures it: doubtful above 2 %, unless stretched.
    pub fn with_overreach(self, overreach: f64) -> Self {
        if overreach > MAX_CROP_OVERREACH {
            self.or_doubtful()
        } else {
            self
        }
    }

    /// Doubtful, unless what is known to be worse.
    pub(super) fn or_doubtful(self) -> Self {
        match self {
            Verdict::Stretched => Verdict::Stretched,
            _ => Verdict::Doubtful,
        }
    }

    /// Whether the layout's strain is too large for the verdict `Unrolled`, as a whole or in too large a part.
    pub(super) fn has_large_strain(report: &UnrollReport) -> bool {
        let strain = &report.distortion;
        strain.rms > MAX_UNROLLED_STRAIN || strain.above > MAX_STRAINED_SHARE
    }
}
