//! Edges of a page with subpixel accuracy: the path of strongest contrast in a band along a region's border.

use super::corners::is_outside;
use super::planes::Planes;
use super::smooth_curve::piecewise_smooth;
use super::views::View;
use crate::math::planar::distance;
use crate::page::best_path::{best_path, parabola_peak};

/// Half the width of the band along a region's border in which the page's edge is searched, in pixels of the reduced
/// photo.
const BAND_RADIUS: usize = 10;

/// Half the length, in pixels of the reduced photo, over which colours and contrast are averaged along an edge, and length of its
/// bends that are smoothed: those of frayed paper and of patterns of the ground. Chosen by `benches/page.md`.
pub(super) const AVERAGING_RADIUS: usize = 8;

/// Number of pixels by which colour profiles across the border extend beyond the searched band on each side, for the
/// colours of paper and background.
const BAND_MARGIN: usize = AVERAGING_RADIUS / 2;

/// Length, in pixels, of the bends of a region's border that are smoothed before the page's edge is searched beside it.
/// Its row: `benches/page.md`, Constants of the outline.
const BORDER_SMOOTHING_LENGTH: f64 = 25.0;

/// Difference of logarithmic colour between paper and background at which contrast in their direction and contrast of
/// any colour have equal weight; below it the latter weighs more.
/// Its row: `benches/page.md`, Constants of the outline.
const WEAK_CONTRAST: f32 = 0.15;

/// Minimum difference of logarithmic colour across an edge, of a page or of a printed area, that counts as visible: 4 % of the
/// light. A pale tint has 0.05, the grain of paper 0.01.
/// Its row: `benches/page.md`, One rule at a time.
pub(in crate::page) const MIN_EDGE_CONTRAST: f32 = 0.04;

/// Difference of logarithmic colour across an edge of a page at which the edge's contrast has a score of one half.
/// Its row: `benches/page.md`, Constants of the outline.
const HALF_SCORE_CONTRAST: f64 = 0.25;

/// An edge of a page in the reduced photo: its points, and how clearly it is visible.
pub(super) struct EdgePath {
    /// Points of the page's edge, about one pixel apart, in the order of the region's border.
    pub points: Vec<[f64; 2]>,
    /// Share of the points with visible contrast, among those with page and background in the photo.
    pub support: f64,
    /// Share of the points at which page and background are both in the photo.
    pub visible: f64,
    /// Median difference of logarithmic colour between page and background across the edge.
    pub contrast: f64,
}

/// Resamples a polyline at a spacing of one pixel.
fn resampled(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    let mut ahead = 0.0;
    for pair in points.windows(2) {
        let length = distance(pair[0], pair[1]);
        while ahead < length {
            let t = ahead / length;
            found.push([0, 1].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k])));
            ahead += 1.0;
        }
        ahead -= length;
    }
    found
}

/// Unit normals of a polyline to the right of its direction, as seen in an image; along a clockwise border they point
/// into the page.
fn inward_normals(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let (a, b) = (
                points[i.saturating_sub(AVERAGING_RADIUS)],
                points[(i + AVERAGING_RADIUS).min(n - 1)],
            );
            let length = distance(a, b).max(1e-9);
            [(a[1] - b[1]) / length, (b[0] - a[0]) / length]
        })
        .collect()
}

/// Mean of colours, component by component; black for none.
fn mean_colour<'a>(colours: impl Iterator<Item = &'a [f32; 3]>) -> [f32; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0_f32);
    for colour in colours {
        (0..3).for_each(|k| sum[k] += colour[k]);
        count += 1.0;
    }
    sum.map(|value| value / count.max(1.0))
}

/// Euclidean distance between two colours.
fn difference(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|j| (b[j] - a[j]).powi(2)).sum::<f32>().sqrt()
}

/// Colour profiles across a region's border, one for each of its points, from outside to inside.
struct Band {
    profiles: Vec<[[f32; 3]; PROFILE_LENGTH]>,
}

/// Number of pixels in a colour profile across a region's border.
const PROFILE_LENGTH: usize = PROFILE_MIDDLE + 1 + PROFILE_MIDDLE;

/// Index of the border itself in a colour profile across it.
const PROFILE_MIDDLE: usize = BAND_RADIUS + BAND_MARGIN;

/// Number of pixels at either end of a colour profile that are averaged for the colour of background and paper.
const SIDE_LENGTH: usize = BAND_MARGIN + BAND_RADIUS / 2;

impl Band {
    fn new(planes: &Planes, border: &[[f64; 2]], normals: &[[f64; 2]]) -> Self {
        let profile = |(point, normal): (&[f64; 2], &[f64; 2])| {
            std::array::from_fn(|k| {
                let offset = k as f64 - PROFILE_MIDDLE as f64;
                planes.colour([0, 1].map(|j| point[j] + offset * normal[j]))
            })
        };
        Band {
            profiles: border.iter().zip(normals).map(profile).collect(),
        }
    }

    /// Mean colours of background and paper, averaged over the profiles near point `i` of the border.
    fn sides(&self, i: usize) -> [[f32; 3]; 2] {
        let from = i.saturating_sub(AVERAGING_RADIUS);
        let near = &self.profiles[from..(i + AVERAGING_RADIUS + 1).min(self.profiles.len())];
        [
            mean_colour(near.iter().flat_map(|profile| &profile[..SIDE_LENGTH])),
            mean_colour(
                near.iter()
                    .flat_map(|profile| &profile[PROFILE_LENGTH - SIDE_LENGTH..]),
            ),
        ]
    }
}

/// Strength of a page's edge at each place of profile `i`, from 0 to 1: 1 for a step from the background's colour to
/// the paper's. `clean` is from the photo with print suppressed, `raw` from the photo as it is.
fn edge_strengths(clean: &Band, raw: &Band, i: usize) -> [f32; PROFILE_LENGTH] {
    let [ground, paper] = clean.sides(i);
    let direction = [0, 1, 2].map(|k| paper[k] - ground[k]);
    let squared = direction.iter().map(|d| d * d).sum::<f32>();
    let share = clean.profiles[i].map(|colour| {
        let along: f32 = (0..3).map(|j| (colour[j] - ground[j]) * direction[j]).sum();
        (along / squared.max(1e-8)).clamp(0.0, 1.0)
    });
    let raw_weight = WEAK_CONTRAST / (WEAK_CONTRAST + squared.sqrt());
    let own = &raw.profiles[i];
    std::array::from_fn(|k| {
        if !(BAND_MARGIN..PROFILE_LENGTH - BAND_MARGIN).contains(&k) {
            return 0.0;
        }
        let step = 0.5 * (share[k + 1] + share[k + 2] - share[k - 1] - share[k - 2]);
        let any = (difference(own[k - 1], own[k + 1]) / WEAK_CONTRAST).min(1.0);
        (1.0 - raw_weight) * step.max(0.0) + raw_weight * any
    })
}

impl EdgePath {
    /// Score of the contrast across the edge, from 0 to 1.
    pub fn contrast_score(&self) -> f64 {
        self.contrast / (self.contrast + HALF_SCORE_CONTRAST)
    }

    /// How clearly the edge is seen along its whole length, from 0 to 1.
    pub fn clarity(&self) -> f64 {
        self.support * self.visible * self.contrast_score()
    }

    /// Finds the edge of a page in a view of a photo near a region's border, which is given clockwise from one corner to the
    /// next. `None` if the border is too short.
    pub fn new(view: &View<'_>, border: &[[f64; 2]]) -> Option<Self> {
        let size = [view.raw.width, view.raw.height];
        let border = resampled(&piecewise_smooth(
            &resampled(border),
            BORDER_SMOOTHING_LENGTH,
        ));
        if border.len() <= 2 * AVERAGING_RADIUS {
            return None;
        }
        let normals = inward_normals(&border);
        let clean = Band::new(view.planes, &border, &normals);
        let raw = Band::new(view.raw, &border, &normals);
        let strengths: Vec<_> = (0..border.len())
            .map(|i| edge_strengths(&clean, &raw, i))
            .collect();
        let searched = BAND_MARGIN..PROFILE_LENGTH - BAND_MARGIN;
        let path = best_path(
            strengths.iter().map(|own| &own[searched.clone()]),
            view.step_cost,
        );
        let mut steps: Vec<Option<[f32; 3]>> = Vec::new();
        let points: Vec<[f64; 2]> = (0..border.len())
            .map(|i| {
                let k = BAND_MARGIN + path[i];
                let shift = parabola_peak([k - 1, k, k + 1].map(|k| strengths[i][k]));
                let offset = k as f64 + shift - PROFILE_MIDDLE as f64;
                let at = |offset: f64| [0, 1].map(|j| border[i][j] + offset * normals[i][j]);
                let is_seen = !is_outside(at(offset - view.ground_width), size, 0.0);
                steps.push(is_seen.then(|| {
                    let profile = &clean.profiles[i];
                    let ground = mean_colour(profile[k - BAND_MARGIN..k].iter());
                    let paper = mean_colour(profile[k + 1..=k + BAND_MARGIN].iter());
                    [0, 1, 2].map(|j| paper[j] - ground[j])
                }));
                at(offset)
            })
            .collect();
        // Contrast of changing signs is none.
        let reach = (view.averaged_share * border.len() as f64) as usize;
        let contrasts: Vec<f32> = (0..steps.len())
            .filter(|i| steps[*i].is_some())
            .map(|i| {
                let near = &steps[i.saturating_sub(reach)..(i + reach + 1).min(steps.len())];
                difference([0.0; 3], mean_colour(near.iter().flatten()))
            })
            .collect();
        let seen = contrasts.iter().filter(|c| **c > MIN_EDGE_CONTRAST).count();
        let support = seen as f64 / contrasts.len().max(1) as f64;
        let visible = contrasts.len() as f64 / border.len() as f64;
        let mut contrasts: Vec<f64> = contrasts.iter().map(|c| f64::from(*c)).collect();
        let contrast = crate::math::statistics::median(&mut contrasts).unwrap_or(0.0);
        Some(EdgePath {
            points: piecewise_smooth(&points, AVERAGING_RADIUS as f64),
            support,
            visible,
            contrast,
        })
    }
}
