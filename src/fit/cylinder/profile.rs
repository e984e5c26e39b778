//! A cylinder's profile: heights along one axis, linear in between, by least squares under a penalty on how
//! their slope changes.

use crate::error::{Result, try_filled};

/// What heights have to say about a profile, once it is known which way the rulings run: the normal equations
/// of hat functions, and of the slope along the rulings. Sums of several are those of all their points.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    /// Of products of two hats: the same one, and neighbours.
    own: Vec<f64>,
    next: Vec<f64>,
    /// Of hats times heights, and times places along the rulings.
    heights: Vec<f64>,
    places: Vec<f64>,
    /// Of squares of heights, of places, and of their products.
    square: f64,
    along: f64,
    both: f64,
    /// Of weights.
    pub weight: f64,
}

impl Sums {
    pub fn new(bins: usize) -> Result<Self> {
        let zeros = || try_filled("profile", bins, 0.0);
        Ok(Sums {
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

    /// A height at `at`, counted in bins, and at a place along the rulings.
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

    /// These and others, `sign` times.
    pub fn plus(&mut self, other: &Sums, sign: f64) {
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

    /// The profile under a penalty, stated for one point in each bin.
    pub fn fit(&self, penalty: Penalty) -> Profile {
        let bins = self.own.len();
        let scale = self.weight / bins as f64;
        match penalty {
            Penalty::Squares(weight) => self.under(&vec![weight * scale; bins]),
            Penalty::Kinks(weight) => {
                // By squares whose weights follow: |x| is x²/|x|.
                let mut weights = vec![weight * scale; bins];
                let mut found = self.under(&weights);
                for _ in 0..ROUNDS {
                    for (own, bend) in weights.iter_mut().zip(found.bends()) {
                        *own = weight * scale / bend.abs().max(STRAIGHT);
                    }
                    found = self.under(&weights);
                }
                found
            }
        }
    }

    /// With a weight for the square of each bend, the first and the last being none.
    fn under(&self, weights: &[f64]) -> Profile {
        let bins = self.own.len();
        // Of each row the diagonal and two places left of it.
        let mut matrix: Vec<[f64; 3]> = (0..bins)
            .map(|i| {
                let before = if i > 0 { self.next[i - 1] } else { 0.0 };
                // So little that it counts only where nothing else does.
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

    /// Sum of squares of what a profile leaves of these heights.
    pub fn off(&self, profile: &Profile) -> f64 {
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

/// Rounds of reweighting, and the least bend that counts as one, in shares of a bin.
const ROUNDS: usize = 20;
const STRAIGHT: f64 = 1e-4;

/// What a profile is to be: smooth, or straight between kinks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Penalty {
    /// Of the squares of its bends.
    Squares(f64),
    /// Of their sizes.
    Kinks(f64),
}

/// Heights at the middles of bins, in the bins' unit, and the slope along the rulings.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    pub values: Vec<f64>,
    pub slope: f64,
    /// Sum of squares that is left, and the penalty.
    pub misfit: f64,
}

impl Profile {
    pub fn at(&self, at: f64) -> f64 {
        let bin = (at.max(0.0) as usize).min(self.values.len() - 2);
        let right = at - bin as f64;
        (1.0 - right) * self.values[bin] + right * self.values[bin + 1]
    }

    fn bends(&self) -> impl Iterator<Item = f64> + '_ {
        let inner = self.values.windows(3).map(|f| f[0] - 2.0 * f[1] + f[2]);
        std::iter::once(0.0).chain(inner).chain([0.0])
    }
}

/// Cholesky's factor of a matrix with two diagonals below the main one.
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
    fn roof() -> (Sums, impl Fn(f64) -> f64) {
        let height = |at: f64| 0.3 * (at - 17.0).abs();
        let mut sums = Sums::new(40).unwrap();
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
            assert!(sums.off(&profile) < 1e-9);
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
