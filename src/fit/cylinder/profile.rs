//! The profile of a cylinder: heights along an axis across the rulings, piecewise linear, by least squares with a
//! penalty on changes of the slope.

use crate::error::{Result, try_filled};

/// Normal equations of a cylinder's profile for a given direction of the rulings: the unknowns are the profile's values
/// in bins (weights of hat functions) and the slope along the rulings. Equations of several sets of points add up.
#[derive(Debug, Clone)]
pub(super) struct ProfileEquations {
    /// Diagonal of the normal matrix: sums of the squares of each hat function.
    own: Vec<f64>,
    /// Secondary diagonal of the normal matrix: sums of products of neighbouring hat functions.
    next: Vec<f64>,
    /// Right-hand side of the normal equations: weighted sums of hat functions times heights.
    heights: Vec<f64>,
    /// Weighted sums of hat functions times positions along the rulings.
    places: Vec<f64>,
    /// Sum of the squares of heights.
    square: f64,
    /// Sum of the squares of positions along the rulings.
    along: f64,
    /// Sum of the products of heights and positions along the rulings.
    both: f64,
    /// Sum of the weights of all points.
    pub weight: f64,
}

impl ProfileEquations {
    /// Makes equations without points, for a profile of `bins` bins.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(bins: usize) -> Result<Self> {
        let zeros = || try_filled("profile", bins, 0.0);
        Ok(ProfileEquations {
            own: zeros()?,
            next: zeros()?,
            heights: zeros()?,
            places: zeros()?,
            square: 0.0,
            along: 0.0,
            both: 0.0,
            weight: 0.0,
        })
    }

    /// Adds a height at the position `at` across the rulings, in bins, and `place` along them, with its weight.
    pub fn add(&mut self, at: f64, place: f64, height: f64, weight: f64) {
        let bin = (at as usize).min(self.own.len() - 2);
        let right = at - bin as f64;
        let left = 1.0 - right;
        self.own[bin] += weight * left * left;
        self.own[bin + 1] += weight * right * right;
        self.next[bin] += weight * left * right;
        for (sums, value) in [(&mut self.heights, height), (&mut self.places, place)] {
            sums[bin] += weight * left * value;
            sums[bin + 1] += weight * right * value;
        }
        self.square += weight * height * height;
        self.along += weight * place * place;
        self.both += weight * place * height;
        self.weight += weight;
    }

    /// Adds other equations, multiplied by `sign`: −1 removes their points.
    pub fn add_scaled(&mut self, other: &ProfileEquations, sign: f64) {
        let pairs = [
            (&mut self.own, &other.own),
            (&mut self.next, &other.next),
            (&mut self.heights, &other.heights),
            (&mut self.places, &other.places),
        ];
        for (own, other) in pairs {
            for (own, other) in own.iter_mut().zip(other) {
                *own += sign * other;
            }
        }
        self.square += sign * other.square;
        self.along += sign * other.along;
        self.both += sign * other.both;
        self.weight += sign * other.weight;
    }

    /// Fits a profile under a penalty, whose weight is scaled by the mean weight of the points in a bin.
    pub fn fit(&self, penalty: Penalty) -> Profile {
        let bins = self.own.len();
        let scale = self.weight / bins as f64;
        match penalty {
            Penalty::Squares(weight) => self.fit_weighted(&vec![weight * scale; bins]),
            Penalty::Kinks(weight) => {
                // Iteratively reweighted: |x| is x²/|x|.
                let mut weights = vec![weight * scale; bins];
                let mut found = self.fit_weighted(&weights);
                for _ in 0..KINK_REWEIGHTING_PASSES {
                    for (own, bend) in weights.iter_mut().zip(found.bends()) {
                        *own = weight * scale / bend.abs().max(MIN_KINK_BEND);
                    }
                    found = self.fit_weighted(&weights);
                }
                found
            }
        }
    }

    /// Fits a profile with a penalty weight for the square of each bend; the first and the last weight have no effect.
    fn fit_weighted(&self, weights: &[f64]) -> Profile {
        let bins = self.own.len();
        // Each row's diagonal and the two entries to the left of it.
        let mut matrix: Vec<[f64; 3]> = (0..bins)
            .map(|i| {
                let before = if i > 0 { self.next[i - 1] } else { 0.0 };
                // A ridge so small that it decides only bins without points.
                [self.own[i] + 1e-12 * self.weight, before, 0.0]
            })
            .collect();
        for i in 1..bins - 1 {
            let weight = weights[i];
            matrix[i - 1][0] += weight;
            matrix[i][0] += 4.0 * weight;
            matrix[i][1] -= 2.0 * weight;
            matrix[i + 1][0] += weight;
            matrix[i + 1][1] -= 2.0 * weight;
            matrix[i + 1][2] += weight;
        }
        factor(&mut matrix);
        let solved = |right: &[f64]| solve(&matrix, right.to_vec());
        let (by_heights, by_places) = (solved(&self.heights), solved(&self.places));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let free = self.along - dot(&self.places, &by_places);
        let pull = self.both - dot(&self.places, &by_heights);
        let slope = if free > 1e-12 * self.along {
            pull / free
        } else {
            0.0
        };
        let values = (by_heights.iter().zip(&by_places))
            .map(|(height, place)| height - slope * place)
            .collect();
        let misfit = self.square - dot(&self.heights, &by_heights) - slope * pull;
        Profile {
            values,
            slope,
            misfit,
        }
    }

    /// Returns the sum of the squared residuals of a profile at these equations' points.
    pub fn squared_residual(&self, profile: &Profile) -> f64 {
        let (f, m) = (&profile.values, profile.slope);
        let mut sum = self.square - 2.0 * m * self.both + m * m * self.along;
        for (i, value) in f.iter().enumerate() {
            sum += value * (self.own[i] * value - 2.0 * (self.heights[i] - m * self.places[i]));
            if let Some(next) = f.get(i + 1) {
                sum += 2.0 * value * next * self.next[i];
            }
        }
        sum
    }
}

/// Maximum number of reweighting passes for a profile that is straight between kinks.
const KINK_REWEIGHTING_PASSES: usize = 20;

/// Minimum absolute bend (second difference), in bins, that a weight is divided by: smaller bends count as straight.
const MIN_KINK_BEND: f64 = 1e-4;

/// Penalty on the bends (second differences) of a cylinder's profile, with its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Penalty {
    /// Penalty on the sum of the squared bends, which makes profiles smooth.
    Squares(f64),
    /// Penalty on the sum of the absolute bends, which makes profiles straight between kinks.
    Kinks(f64),
}

/// Profile of a cylinder: heights at the bins' positions, in the unit of the bins, and the slope along the rulings.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    pub values: Vec<f64>,
    pub slope: f64,
    /// Sum of squared residuals and penalty at the fit.
    pub misfit: f64,
}

impl Profile {
    /// Returns the profile's height at a position across the rulings, in bins.
    pub fn at(&self, at: f64) -> f64 {
        let bin = (at.max(0.0) as usize).min(self.values.len() - 2);
        let right = at - bin as f64;
        (1.0 - right) * self.values[bin] + right * self.values[bin + 1]
    }

    /// Iterates over the bends of the profile: second differences of its heights.
    fn bends(&self) -> impl Iterator<Item = f64> + '_ {
        let inner = self.values.windows(3).map(|f| f[0] - 2.0 * f[1] + f[2]);
        std::iter::once(0.0).chain(inner).chain([0.0])
    }
}

/// Computes in place the Cholesky factor of a symmetric matrix with two diagonals below the main one; each row holds
/// the diagonal entry and the two entries to its left.
fn factor(matrix: &mut [[f64; 3]]) {
    for i in 0..matrix.len() {
        let [mut own, mut near, mut far] = matrix[i];
        if i > 1 {
            far /= matrix[i - 2][0];
            near -= far * matrix[i - 1][1];
        }
        if i > 0 {
            near /= matrix[i - 1][0];
        }
        own -= near * near + far * far;
        matrix[i] = [own.max(f64::MIN_POSITIVE).sqrt(), near, far];
    }
}

/// Solves a linear system with the right-hand side `x` by the Cholesky factor of its matrix.
fn solve(factor: &[[f64; 3]], mut x: Vec<f64>) -> Vec<f64> {
    for i in 0..x.len() {
        let [own, near, far] = factor[i];
        let before = if i > 0 { near * x[i - 1] } else { 0.0 };
        let first = if i > 1 { far * x[i - 2] } else { 0.0 };
        x[i] = (x[i] - before - first) / own;
    }
    for i in (0..x.len()).rev() {
        let [own, near, far] = factor[i];
        x[i] /= own;
        if i > 0 {
            x[i - 1] -= near * x[i];
        }
        if i > 1 {
            x[i - 2] -= far * x[i];
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a line with one kink, on a slope along the rulings.
    fn roof() -> (ProfileEquations, impl Fn(f64) -> f64) {
        let height = |at: f64| 0.3 * (at - 17.0).abs();
        let mut sums = ProfileEquations::new(40).unwrap();
        for i in 0..3000 {
            let (at, place) = (39.0 * (i % 300) as f64 / 300.0, (i / 300) as f64 - 4.5);
            sums.add(at, place, height(at) - 0.2 * place, 1.0);
        }
        (sums, height)
    }

    #[test]
    fn what_has_no_noise_is_met_under_any_small_penalty() {
        let (sums, height) = roof();
        for penalty in [Penalty::Squares(1e-9), Penalty::Kinks(1e-9)] {
            let profile = sums.fit(penalty);
            assert!((profile.slope + 0.2).abs() < 1e-9);
            for at in [0.0, 3.3, 17.0, 38.9] {
                assert!((profile.at(at) - height(at)).abs() < 1e-6, "{at}");
            }
            assert!(sums.squared_residual(&profile) < 1e-9);
        }
    }

    #[test]
    fn kinks_stay_where_squares_round_them() {
        let (sums, height) = roof();
        let at_kink = |penalty| (sums.fit(penalty).at(17.0) - height(17.0)).abs();
        assert!(at_kink(Penalty::Squares(100.0)) > 0.1);
        assert!(at_kink(Penalty::Kinks(0.1)) < 0.05);
    }
}
