//! A triangle of a surface laid flat by itself, and how it is rotated best (the local step).
//!
//! Points of the plane are complex numbers, and rotations complex numbers of modulus 1.

use std::iter::Sum;
use std::ops::{Add, Mul, Sub, SubAssign};

use nalgebra::{Complex, Vector3};

use super::cholesky::Cholesky;

/// A point of the plane, as a complex number.
pub(crate) type Point = Complex<f64>;

/// A position of a mesh's vertex, in the plane or in space.
pub(crate) trait Position:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + SubAssign + Mul<f64, Output = Self> + Sum
{
    /// Makes the local step for one triangle: finds the rotation `R` nearest to the triangle's map `J`, and returns the
    /// energy `area · ‖J − R‖²`. Adds minus half the energy's gradient to `descent`.
    fn local_step(
        triangle: &FlatTriangle,
        positions: &[Self],
        descent: &mut [Self],
        corners: [usize; 3],
    ) -> f64;

    /// Solves the system of the global step for all coordinates.
    fn solve(factor: &mut Cholesky, descent: &[Self], corrections: &mut [Self]);
}

/// A triangle of a surface, moved to the plane without strain, with counter-clockwise corners: the first at 0, the
/// second on the positive real axis. All fields are 0 where there is no triangle, so that it weighs nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct FlatTriangle {
    /// Position of the triangle's second corner on the real axis.
    pub(super) second: f64,
    /// Position of the triangle's third corner.
    pub(super) third: Point,
    /// Half the cotangents of the angles opposite the edges 1–2, 2–3 and 3–1, the weights of these edges in the energy.
    pub(super) weights: [f64; 3],
}

impl FlatTriangle {
    /// Creates the triangle between three points in space, in their unit; all fields are 0 if it has no area.
    #[inline]
    pub(crate) fn from_points([a, b, c]: [[f64; 3]; 3]) -> Self {
        let edge = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| q[k] - p[k]);
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let (ab, ac) = (edge(a, b), edge(a, c));
        let (square2, square3, cosine) = (dot(ab, ab), dot(ac, ac), dot(ab, ac));
        let cross = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            ab[i] * ac[j] - ab[j] * ac[i]
        });
        let doubled = dot(cross, cross).sqrt();
        if !(doubled > 0.0 && doubled.is_finite()) {
            return FlatTriangle::default();
        }
        let (second, half) = (square2.sqrt(), 0.5 / doubled);
        FlatTriangle {
            second,
            third: Point::new(cosine / second, doubled / second),
            weights: [square3 - cosine, cosine, square2 - cosine].map(|c| half * c),
        }
    }

    /// Creates an edge of a given length as a triangle without an area, between its first two corners: by the weight its length is
    /// kept. An edge between two equilateral triangles has the weight 0.58.
    pub(crate) fn edge(length: f64, weight: f64) -> Self {
        FlatTriangle {
            second: length,
            third: Point::new(length, 0.0),
            weights: [weight, 0.0, 0.0],
        }
    }

    pub(crate) fn exists(&self) -> bool {
        self.second > 0.0
    }

    /// Computes the position of the triangle's third corner when the triangle is moved and scaled so that the first
    /// corner is at 0 and the second one at 1.
    pub(crate) fn third_corner(&self) -> Point {
        self.third / self.second
    }

    pub(crate) fn area(&self) -> f64 {
        0.5 * self.second * self.third.im
    }

    /// Computes the singular values `[σ₁, σ₂]` of the linear map from this triangle to three points of the plane; `σ₂`
    /// is negative where the map turns the triangle over.
    #[inline]
    pub(crate) fn singular_values(&self, [a, b, c]: [Point; 3]) -> [f64; 2] {
        // The map is e ↦ αe + βē.
        let sum = (b - a) / self.second;
        let difference = ((c - a) - sum * self.third.re) / Point::new(0.0, self.third.im);
        let (alpha, beta) = (
            0.5 * (sum + difference).norm_sqr().sqrt(),
            0.5 * (sum - difference).norm_sqr().sqrt(),
        );
        [alpha + beta, alpha - beta]
    }
}

impl Position for Point {
    #[inline(always)]
    fn local_step(
        triangle: &FlatTriangle,
        places: &[Self],
        descent: &mut [Self],
        [a, b, c]: [usize; 3],
    ) -> f64 {
        let [wab, wbc, wca] = triangle.weights;
        let (ab, ac) = (places[b] - places[a], places[c] - places[a]);
        let bc = ac - ab;
        let own_bc = triangle.third - triangle.second;
        // The best rotation: the direction of the weighted correlation of the edges.
        let correlation = ab * (wab * triangle.second)
            + bc * own_bc.conj() * wbc
            + ac * triangle.third.conj() * wca;
        let square = correlation.norm_sqr();
        let turn = if square > 0.0 {
            correlation * (1.0 / square.sqrt())
        } else {
            Point::new(1.0, 0.0)
        };
        let (dab, dbc, dac) = (
            turn * triangle.second - ab,
            turn * own_bc - bc,
            turn * triangle.third - ac,
        );
        let (pab, pbc, pac) = (dab * wab, dbc * wbc, dac * wca);
        descent[a] -= pab + pac;
        descent[b] += pab - pbc;
        descent[c] += pac + pbc;
        wab * dab.norm_sqr() + wbc * dbc.norm_sqr() + wca * dac.norm_sqr()
    }

    fn solve(factor: &mut Cholesky, descent: &[Self], corrections: &mut [Self]) {
        factor.solve(descent, corrections);
    }
}

impl Position for Vector3<f64> {
    fn local_step(
        triangle: &FlatTriangle,
        places: &[Self],
        descent: &mut [Self],
        [a, b, c]: [usize; 3],
    ) -> f64 {
        // ‖J − R‖² is smallest for the polar factor of the edges' correlation.
        let [wab, wbc, wca] = triangle.weights;
        let (ab, ac) = (places[b] - places[a], places[c] - places[a]);
        let bc = ac - ab;
        let own_bc = triangle.third - triangle.second;
        let first =
            ab * (wab * triangle.second) + bc * (wbc * own_bc.re) + ac * (wca * triangle.third.re);
        let second = bc * (wbc * own_bc.im) + ac * (wca * triangle.third.im);
        let (p, q, r) = (
            first.norm_squared(),
            first.dot(&second),
            second.norm_squared(),
        );
        // The root of the symmetric 2×2 matrix, and its inverse.
        let root = (p * r - q * q).max(0.0).sqrt();
        let trace = (p + r + 2.0 * root).sqrt();
        let (s, t, u) = ((p + root) / trace, q / trace, (r + root) / trace);
        let determinant = s * u - t * t;
        if !(determinant > 0.0 && determinant.is_finite()) {
            return 0.0;
        }
        let right = (first * u - second * t) / determinant;
        let up = (second * s - first * t) / determinant;
        let dab = right * triangle.second - ab;
        let dbc = right * own_bc.re + up * own_bc.im - bc;
        let dac = right * triangle.third.re + up * triangle.third.im - ac;
        let (pab, pbc, pac) = (dab * wab, dbc * wbc, dac * wca);
        descent[a] -= pab + pac;
        descent[b] += pab - pbc;
        descent[c] += pac + pbc;
        wab * dab.norm_squared() + wbc * dbc.norm_squared() + wca * dac.norm_squared()
    }

    fn solve(factor: &mut Cholesky, descent: &[Self], corrections: &mut [Self]) {
        // Two coordinates at once, then the third.
        let mut solution = vec![Point::default(); descent.len()];
        let plan: Vec<Point> = descent.iter().map(|d| Point::new(d.x, d.y)).collect();
        factor.solve(&plan, &mut solution);
        for (correction, solved) in corrections.iter_mut().zip(&solution) {
            (correction.x, correction.y) = (solved.re, solved.im);
        }
        let heights: Vec<Point> = descent.iter().map(|d| Point::new(d.z, 0.0)).collect();
        factor.solve(&heights, &mut solution);
        for (correction, solved) in corrections.iter_mut().zip(&solution) {
            correction.z = solved.re;
        }
    }
}
