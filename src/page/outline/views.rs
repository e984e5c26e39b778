//! Views of a photo in which pages are searched: with print suppressed, and as it is.

use super::corners::END_LENGTH_SHARE;
use super::morphology::{closed, closed_plane};
use super::planes::{Planes, RIM_PIXELS};
use super::region::{Region, regions};
use crate::dewarp::Photo;

/// Maximum width of print that is suppressed before the search for a page, as a share of the photo's longer side: bars
/// of colour across a page are as high as that.
const PRINT_WIDTH_SHARE: f64 = 0.03;

/// Minimum number of visible edges of a page: with fewer it can hardly be told from a table.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_VISIBLE_EDGES: usize = 3;

/// Cost of a sideways step by one pixel in the search for a page's edge, where full contrast earns 1 for each pixel of
/// length.
/// Its row: `benches/page.md`, Constants of the outline.
const STEP_COST: f32 = 0.15;

/// The same in the photo as it is, where edges are not to follow a pattern of the ground.
/// Its row: `benches/outline.md`, Patterned ground.
const PATTERN_STEP_COST: f32 = 0.6;

/// Width of the ground, in pixels, that the photo as it is shows beside each place where an edge is visible: a strip of shade along the
/// rim is narrower.
/// Its row: `benches/outline.md`, Patterned ground.
const PATTERN_GROUND_PIXELS: f64 = 4.0;

/// The reduced photo as it is (`raw`), and with print suppressed (`clean`).
pub(super) struct Views {
    pub raw: Planes,
    pub clean: Planes,
}

/// One view of a photo, and how a page is searched in it.
pub(super) struct View<'a> {
    /// The reduced photo as it is.
    pub raw: &'a Planes,
    /// The reduced photo in which paper and ground are told apart.
    pub planes: &'a Planes,
    /// The reduced photo in which paper and ground are told apart, at half its resolution.
    pub half: Planes,
    /// Amount by which suppressing print changes each pixel of the halved photo; empty where print is suppressed.
    marks: Vec<f32>,
    /// Half the width, in pixels of the halved photo, of what is too narrow for paper and of gaps in it; 0 for none.
    narrow: usize,
    /// Cost of a sideways step by one pixel of an edge.
    pub step_cost: f32,
    /// Share of an edge's length, to either side of a point, over which its contrast is averaged.
    pub averaged_share: f64,
    /// Width of the ground, in pixels, that the photo shows beside each place where an edge is visible.
    pub ground_width: f64,
    /// Minimum number of visible edges of a page.
    pub min_visible_edges: usize,
}

impl Views {
    /// Reduces a photo, and suppresses the print in it.
    pub fn new(photo: &Photo<'_>) -> Self {
        let raw = Planes::from_photo(photo);
        let clean = closed(&raw, (0.5 * PRINT_WIDTH_SHARE * raw.longer_side()) as usize);
        Views { raw, clean }
    }

    /// The view with print suppressed, and with it the narrow parts of a ground's pattern.
    pub fn without_print(&self) -> View<'_> {
        View {
            raw: &self.raw,
            planes: &self.clean,
            half: self.clean.halved(),
            marks: Vec::new(),
            narrow: 0,
            step_cost: STEP_COST,
            averaged_share: 0.0,
            ground_width: RIM_PIXELS,
            min_visible_edges: MIN_VISIBLE_EDGES,
        }
    }

    /// The view of the photo as it is, in which a pattern of the ground is told from paper by its width.
    pub fn as_it_is(&self) -> View<'_> {
        let half = self.raw.halved();
        View {
            raw: &self.raw,
            planes: &self.raw,
            marks: marks(&self.clean.halved(), &half),
            half,
            narrow: (0.25 * PRINT_WIDTH_SHARE * self.raw.longer_side()) as usize,
            step_cost: PATTERN_STEP_COST,
            averaged_share: END_LENGTH_SHARE,
            ground_width: PATTERN_GROUND_PIXELS,
            min_visible_edges: 4,
        }
    }
}

/// Largest difference of each pixel's colours.
fn marks(clean: &Planes, raw: &Planes) -> Vec<f32> {
    let difference = |i: usize, k: usize| clean.channels[k][i] - raw.channels[k][i];
    (0..raw.len())
        .map(|i| (0..3).map(|k| difference(i, k)).fold(0.0, f32::max))
        .collect()
}

impl View<'_> {
    /// Finds the regions of a mask of paper at half the resolution that have at least `min_area` pixels: without narrow parts of the
    /// ground, and joined across bars of print.
    pub fn regions(&self, mask: &[bool], min_area: usize) -> Vec<Region> {
        let width = self.half.width;
        let found = regions(mask, width, min_area);
        if self.narrow == 0 || found.is_empty() {
            return found;
        }
        let (and, or) = (|a, b| a & b, |a, b| a | b);
        let is_paper = |i| found.iter().any(|region| region.mask[i]);
        let paper: Vec<bool> = (0..mask.len()).map(is_paper).collect();
        let wide = closed_plane(&paper, width, self.narrow, and, or);
        let joined = closed_plane(&wide, width, self.narrow, or, and);
        let mut found = regions(&joined, width, min_area);
        found.retain(|region| self.is_paper(region));
        found
    }

    /// Whether there are fewer marks within a region than around it: print is sparser than a pattern.
    fn is_paper(&self, region: &Region) -> bool {
        let mut sums = [[0.0_f64; 2]; 2];
        for (mark, own) in self.marks.iter().zip(&region.mask) {
            sums[usize::from(*own)][0] += f64::from(*mark);
            sums[usize::from(*own)][1] += 1.0;
        }
        let [outside, inside] = sums.map(|[sum, count]| sum / count.max(1.0));
        inside < outside
    }
}
