//! Report on a page that was found in a photo: the verdict on its fit and the measures behind that.

/// Verdict on a flat page: whether it can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageVerdict {
    /// The page was flat: only the perspective is removed.
    Flat,
    /// The page was bent and is flat now, with lengths as on the page.
    Unrolled,
    /// The flat page may be right, but nothing checks how it is bent: it shows too few lines of text, or it fills the photo, so
    /// that its edges are not seen.
    Unchecked,
    /// The flat page may be wrong: the expected error is above 1.5 % of the page's width, or the page hides a part of
    /// itself.
    Doubtful,
    /// The edges cannot belong to a sheet of paper: they are traced wrongly. Or the edges and lines of text cannot belong to a
    /// page that is curled in one direction, the only shape that two edges determine.
    NotThisKind,
}

/// Main reason why a flat page is doubtful ([`PageVerdict::Doubtful`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageDoubt {
    /// The expected error is above 1.5 % of the page's width.
    LargeError,
    /// A part of the page hides another part from the camera.
    HiddenPart,
    /// The page is crumpled: its model is a sheet that is strained.
    Crumpled,
    /// The page may be both pages of an open book: it is bent and wider than high, and no line of print crosses its middle.
    Spread,
    /// The outline that was found in the photo is doubtful.
    Outline,
}

/// Model of a page's shape, from the plainest to the most general.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageModel {
    /// A plane seen in perspective: a homography maps it to the photo.
    Plane,
    /// A cylinder over any curve: a page that is curled in one direction.
    Cylinder,
    /// An isometric sheet of any shape, bent without strain: a page that is folded, or bent both ways.
    Sheet,
    /// A sheet that is slightly strained: a crumpled page, whose wrinkles are too small to be visible in its outline.
    SoftSheet,
}

/// Displacement not exceeded in 95 of 100 cases where the outline is doubtful, in % of a page's width (`benches/page.md`, Expected error).
const DOUBTFUL_OUTLINE_ERROR_BOUND: f64 = 12.0;

/// Verdict on a page that was found in a photo, with the measures of its fit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct PageReport {
    /// Whether the flat page can be trusted.
    pub verdict: PageVerdict,
    /// Main reason for the verdict [`PageVerdict::Doubtful`]; `None` for other verdicts.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub doubt: Option<PageDoubt>,
    /// Model that was fitted to the page's shape: plane, cylinder or sheet.
    pub model: PageModel,
    /// Expected displacement of points on the flat page: the root mean square, in % of a page's width.
    pub error: f64,
    /// Displacement that is not exceeded in 95 of 100 cases, in % of a page's width.
    pub error_bound: f64,
    /// Focal length of the camera, in pixels of the photo.
    pub focal_length: f64,
    /// Angle between the camera's axis and the normal of the page's chord plane, in degrees.
    pub tilt: f64,
    /// Bound of the largest angle between the normals at two points of the page, in degrees: 0 for a plane.
    pub bend: f64,
    /// Root mean square distance in the photo between the page's edges, given or detected, and those of the fitted page, in pixels.
    pub residual: f64,
    /// Root mean square distance in the photo between the page's edges, given or detected, and those of the fitted page, in % of the
    /// width of one page.
    pub disagreement: f64,
    /// Number of lines of text that the fit of the page used besides the edges, traced and detected ones.
    pub lines: usize,
    /// Number of lines of text that were detected in the photo.
    pub lines_found: usize,
    /// Root mean square distance of the lines of text from level lines on the flat page, which they should follow, in % of a page's
    /// width.
    pub lines_disagreement: f64,
    /// Ratio of the page's height to its width.
    pub ratio: f64,
}

impl PageReport {
    /// Returns the report on a page whose outline was found with doubt: what follows from the outline is doubtful, too, and as wrong
    /// as the outline may be.
    pub fn with_doubtful_outline(mut self) -> Self {
        self.error_bound = self.error_bound.max(DOUBTFUL_OUTLINE_ERROR_BOUND);
        if !matches!(
            self.verdict,
            PageVerdict::Doubtful | PageVerdict::NotThisKind
        ) {
            self.verdict = PageVerdict::Doubtful;
            self.doubt = Some(PageDoubt::Outline);
        }
        self
    }

    /// Of the reports on two pages of a spread, the one with the larger expected error, with the lines of both.
    pub(super) fn worse(self, other: PageReport) -> PageReport {
        let one = if self.error > other.error {
            self
        } else {
            other
        };
        let verdict = [self, other]
            .into_iter()
            .max_by_key(|report| report.verdict as u8);
        PageReport {
            verdict: verdict.map_or(one.verdict, |report| report.verdict),
            doubt: self.doubt.or(other.doubt),
            lines: self.lines + other.lines,
            lines_found: self.lines_found + other.lines_found,
            ..one
        }
    }
}
