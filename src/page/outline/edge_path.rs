//! Edges of a page to a fraction of a pixel: the path of the strongest contrast in a band along a region's border.

use super::planes::Planes;
use crate::math::planar::distance;

/// Half of the width of the band in which an edge is looked for, in pixels of the reduced photo.
const BAND_RADIUS: usize = 10;

/// Number of pixels beyond the band from which the colours of paper and ground are taken.
const BAND_MARGIN: usize = 4;

/// Length of the window over which a border is smoothed, and colours along it, on either side and in pixels.
const SMOOTHING_LENGTH: usize = 8;

/// Cost of a step of one pixel across the band, where an edge of full contrast is worth 1 for each pixel of its length.
const STEP_COST: f32 = 0.15;

/// Difference of logarithmic colour at which contrast in direction of the paper's colour and any contrast count alike.
const WEAK_CONTRAST: f32 = 0.15;

/// Minimum difference of logarithmic colour across an edge that can be seen: 4 % of the light.
const MIN_EDGE_CONTRAST: f32 = 0.04;

/// Minimum number of points of a border along which an edge is looked for.
const MIN_BORDER_POINTS: usize = 24;

/// An edge in the reduced photo.
pub(super) struct EdgePath {
    /// Points about one pixel from each other, in the border's order.
    pub points: Vec<[f64; 2]>,
    /// Share of the points, of those with both sides in the photo, across which a contrast can be seen.
    pub support: f64,
    /// Share of the points with both sides in the photo.
    pub visible: f64,
    /// Median difference of logarithmic colour across the edge.
    pub contrast: f64,
}

/// Points at distances of one on a polyline.
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

/// Means of each point and its neighbours on either side, as many as there are on both.
fn smoothed(points: &[[f64; 2]], radius: usize) -> Vec<[f64; 2]> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let reach = radius.min(i).min(n - 1 - i);
            let near = &points[i - reach..=i + reach];
            [0, 1].map(|k| near.iter().map(|p| p[k]).sum::<f64>() / near.len() as f64)
        })
        .collect()
}

/// Unit normals to the right of a polyline's direction, as seen in an image: into the page.
fn inward_normals(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let (a, b) = (
                points[i.saturating_sub(SMOOTHING_LENGTH)],
                points[(i + SMOOTHING_LENGTH).min(n - 1)],
            );
            let length = distance(a, b).max(1e-9);
            [(a[1] - b[1]) / length, (b[0] - a[0]) / length]
        })
        .collect()
}

/// Mean of some colours; `None` without any.
fn mean_colour(colours: impl Iterator<Item = [f32; 3]>) -> Option<[f32; 3]> {
    let (mut sum, mut count) = ([0.0; 3], 0.0_f32);
    for colour in colours {
        (0..3).for_each(|k| sum[k] += colour[k]);
        count += 1.0;
    }
    (count > 0.0).then(|| sum.map(|value| value / count))
}

/// Colours along normals of a border, from outside to inside.
struct Band {
    profiles: Vec<Vec<Option<[f32; 3]>>>,
}

/// Number of places in a profile, and the place of the border in it.
const PROFILE_LENGTH: usize = 2 * PROFILE_MIDDLE + 1;
const PROFILE_MIDDLE: usize = BAND_RADIUS + BAND_MARGIN;

impl Band {
    fn new(planes: &Planes, border: &[[f64; 2]], normals: &[[f64; 2]]) -> Self {
        let profile = |(point, normal): (&[f64; 2], &[f64; 2])| {
            (0..PROFILE_LENGTH)
                .map(|k| {
                    let offset = k as f64 - PROFILE_MIDDLE as f64;
                    planes.colour([0, 1].map(|j| point[j] + offset * normal[j]))
                })
                .collect()
        };
        Band {
            profiles: border.iter().zip(normals).map(profile).collect(),
        }
    }

    /// Mean colour of a range of places in the profiles near a point of the border.
    fn mean(&self, i: usize, places: std::ops::Range<usize>) -> Option<[f32; 3]> {
        let (from, to) = (
            i.saturating_sub(SMOOTHING_LENGTH),
            (i + SMOOTHING_LENGTH + 1).min(self.profiles.len()),
        );
        mean_colour(
            self.profiles[from..to]
                .iter()
                .flat_map(|profile| profile[places.clone()].iter().copied().flatten()),
        )
    }
}

/// Worth of an edge at each place of a band's profile: 1 for a step from the ground's colour to the paper's.
fn edge_strengths(clean: &Band, raw: &Band, i: usize) -> [f32; PROFILE_LENGTH] {
    let mut strengths = [0.0; PROFILE_LENGTH];
    let (Some(ground), Some(paper)) = (
        clean.mean(i, 0..BAND_MARGIN + BAND_RADIUS / 2),
        clean.mean(i, PROFILE_LENGTH - BAND_MARGIN - BAND_RADIUS / 2..PROFILE_LENGTH),
    ) else {
        return strengths;
    };
    let difference = [0, 1, 2].map(|k| paper[k] - ground[k]);
    let squared = difference.iter().map(|d| d * d).sum::<f32>();
    let contrast = squared.sqrt();
    let share = |k: usize| {
        clean.profiles[i][k].map(|colour| {
            let along: f32 = (0..3).map(|j| (colour[j] - ground[j]) * difference[j]).sum();
            (along / squared.max(1e-8)).clamp(0.0, 1.0)
        })
    };
    let raw_weight = WEAK_CONTRAST / (WEAK_CONTRAST + contrast);
    let clean_weight = 1.0 - raw_weight;
    for (k, strength) in strengths
        .iter_mut()
        .enumerate()
        .take(PROFILE_LENGTH - BAND_MARGIN)
        .skip(BAND_MARGIN)
    {
        if let (Some(a), Some(b), Some(c), Some(d)) =
            (share(k - 2), share(k - 1), share(k + 1), share(k + 2))
        {
            *strength += clean_weight * (0.5 * (c + d - a - b)).max(0.0);
        }
        if let (Some(a), Some(b)) = (raw.profiles[i][k - 1], raw.profiles[i][k + 1]) {
            let step = (0..3).map(|j| (b[j] - a[j]).powi(2)).sum::<f32>().sqrt();
            *strength += raw_weight * (step / WEAK_CONTRAST).min(1.0);
        }
    }
    strengths
}

/// The place in each profile of the path with the largest sum of strengths minus the cost of its steps (Viterbi).
fn best_path(strengths: &[[f32; PROFILE_LENGTH]]) -> Vec<usize> {
    let range = BAND_MARGIN..PROFILE_LENGTH - BAND_MARGIN;
    let mut worth = [f32::MIN; PROFILE_LENGTH];
    range.clone().for_each(|k| worth[k] = strengths[0][k]);
    let mut from = vec![[0_u8; PROFILE_LENGTH]; strengths.len()];
    for (i, own) in strengths.iter().enumerate().skip(1) {
        let before = worth;
        for k in range.clone() {
            let mut best = (before[k], k);
            for j in [k - 1, k + 1] {
                let value = before[j] - STEP_COST;
                if value > best.0 {
                    best = (value, j);
                }
            }
            worth[k] = best.0 + own[k];
            from[i][k] = best.1 as u8;
        }
    }
    let mut place = range
        .max_by(|a, b| worth[*a].total_cmp(&worth[*b]))
        .unwrap_or(PROFILE_MIDDLE);
    let mut path = vec![place; strengths.len()];
    for i in (1..strengths.len()).rev() {
        place = usize::from(from[i][place]);
        path[i - 1] = place;
    }
    path
}

impl EdgePath {
    /// The edge near a border, given from one corner to the next and clockwise, in a reduced photo as it is and without
    /// print. `None` if the border is too short.
    pub fn new(raw: &Planes, clean: &Planes, border: &[[f64; 2]]) -> Option<Self> {
        let border = resampled(&smoothed(&resampled(border), SMOOTHING_LENGTH));
        if border.len() < MIN_BORDER_POINTS {
            return None;
        }
        let normals = inward_normals(&border);
        let clean = Band::new(clean, &border, &normals);
        let raw = Band::new(raw, &border, &normals);
        let strengths: Vec<_> = (0..border.len())
            .map(|i| edge_strengths(&clean, &raw, i))
            .collect();
        let path = best_path(&strengths);
        let mut contrasts = Vec::new();
        let points = (0..border.len())
            .map(|i| {
                let k = path[i];
                let [a, b, c] = [k - 1, k, k + 1].map(|k| f64::from(strengths[i][k]));
                let bend = 2.0 * b - a - c;
                let shift = if bend > 1e-6 {
                    (0.5 * (c - a) / bend).clamp(-0.5, 0.5)
                } else {
                    0.0
                };
                let outside = mean_colour(clean.profiles[i][k - BAND_MARGIN..k].iter().copied().flatten());
                let inside =
                    mean_colour(clean.profiles[i][k + 1..=k + BAND_MARGIN].iter().copied().flatten());
                if let (Some(a), Some(b)) = (outside, inside) {
                    contrasts.push((0..3).map(|j| (b[j] - a[j]).powi(2)).sum::<f32>().sqrt());
                }
                let offset = k as f64 + shift - PROFILE_MIDDLE as f64;
                [0, 1].map(|j| border[i][j] + offset * normals[i][j])
            })
            .collect();
        let seen = contrasts.iter().filter(|c| **c > MIN_EDGE_CONTRAST).count();
        let support = seen as f64 / contrasts.len().max(1) as f64;
        let visible = contrasts.len() as f64 / border.len() as f64;
        let mut contrasts: Vec<f64> = contrasts.iter().map(|c| f64::from(*c)).collect();
        let contrast = crate::math::statistics::median(&mut contrasts).unwrap_or(0.0);
        Some(EdgePath {
            points,
            support,
            visible,
            contrast,
        })
    }
}
