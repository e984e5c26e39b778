//! Cuts through parts that cannot be laid flat in one piece.

use std::cmp::Reverse;

use nalgebra::{Matrix3, Vector3};

use super::flat_patch::FlatPatch;
use super::labels::{Labels, connected_groups};
use crate::error::Result;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::math::statistics::weighted_median;
use rustc_hash::FxHashMap;

/// Number of directions in which a straight cut through a part of the surface is tried, evenly spaced over half a turn.
/// `benches/patterns.md` has what others give.
const CUT_DIRECTIONS: usize = 16;

/// Minimum number of vertices of a connected group on one side of a cut; a smaller group stays with its neighbour.
/// `benches/patterns.md` has what others give.
const MIN_GROUP_VERTICES: usize = 4;

/// Weight of a cut's length in its score, relative to the variance of the normals that is left on both sides.
/// `benches/patterns.md` has what others give.
const CUT_LENGTH_WEIGHT: f64 = 0.002;

impl Labels {
    /// Cuts a part into two or more along a line that is straight seen from above. Candidate lines pass through the
    /// median of the vertices, weighted by their strain or not; the one with the best [`score`] is used. Returns the
    /// numbers of the pieces, the first being the part's own, or `None` if the part is too small.
    pub(super) fn cut(
        &mut self,
        surface: &Heightfield,
        part: u32,
        flat_patch: &FlatPatch,
    ) -> Result<Option<Vec<u32>>> {
        let lattice = *surface.lattice();
        let vertex_strain_energy = flat_patch.vertex_strain_energy(&lattice);
        if flat_patch.is_too_small_to_cut() {
            return Ok(None);
        }
        let samples: Vec<Sample> = (vertex_strain_energy.iter())
            .map(|(i, square)| Sample::new(surface, *i, *square))
            .collect();
        let mut lines: Vec<(f64, [f64; 3])> = (0..CUT_DIRECTIONS)
            .flat_map(|k| {
                let (sin, cos) =
                    (std::f64::consts::PI * k as f64 / CUT_DIRECTIONS as f64).sin_cos();
                // A line through the strain-weighted median, and one through the unweighted median.
                [2.0, 0.0].map(|power| {
                    let offset = median(&samples, [cos, sin], power);
                    let line = [cos, sin, -offset];
                    (score(&samples, line, lattice.spacing()), line)
                })
            })
            .collect();
        lines.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, [a, b, c]) in lines {
            let beyond = |i: usize| {
                let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
                a * x + b * y + c > 0.0
            };
            let cut = self.try_cut(&lattice, part, &vertex_strain_energy, beyond);
            if cut.is_some() {
                return Ok(cut);
            }
        }
        Ok(None)
    }

    /// Cuts a part into the connected components on both sides of a line; `None` if fewer than two are large enough.
    fn try_cut(
        &mut self,
        lattice: &Lattice,
        part: u32,
        vertex_strain_energy: &[(usize, f64)],
        beyond: impl Fn(usize) -> bool,
    ) -> Option<Vec<u32>> {
        let first = self.origins.len() as u32;
        let members = || vertex_strain_energy.iter().map(|(i, _)| *i);
        let side: FxHashMap<usize, bool> = members().map(|i| (i, beyond(i))).collect();
        let same = |i: usize, k: usize| side[&i] == side[&k];
        let groups = connected_groups(lattice, members(), same);
        let mut numbers =
            FxHashMap::with_capacity_and_hasher(vertex_strain_energy.len(), Default::default());
        for (number, group) in groups.iter().enumerate() {
            numbers.extend(group.iter().map(|i| (*i, number)));
        }
        // Groups that are too small are merged with the largest neighbouring group.
        let mut order: Vec<usize> = (0..groups.len()).collect();
        order.sort_by_key(|g| Reverse(groups[*g].len()));
        let large: Vec<usize> = order
            .into_iter()
            .filter(|g| groups[*g].len() >= MIN_GROUP_VERTICES)
            .collect();
        if large.len() < 2 {
            return None;
        }
        let mut named = FxHashMap::default();
        for (k, group) in large.iter().enumerate() {
            let number = if k == 0 { part } else { first + k as u32 - 1 };
            named.insert(*group, number);
        }
        let mut pending: Vec<usize> = (0..groups.len())
            .filter(|g| !named.contains_key(g))
            .collect();
        while !pending.is_empty() {
            let before = pending.len();
            pending.retain(|group| {
                let beside = groups[*group].iter().flat_map(|i| lattice.around(*i));
                let found = beside
                    .filter_map(|k| named.get(numbers.get(&k)?))
                    .min()
                    .copied();
                if let Some(number) = found {
                    named.insert(*group, number);
                }
                found.is_none()
            });
            if pending.len() == before {
                break;
            }
        }
        for (group, members) in groups.iter().enumerate() {
            for i in members {
                self.of[*i] = named.get(&group).copied().unwrap_or(part);
            }
        }
        let origin = self.origins[part as usize];
        let count = large.len() as u32;
        self.origins.extend((1..count).map(|_| origin));
        Some(
            std::iter::once(part)
                .chain(first..first + count - 1)
                .collect(),
        )
    }
}

/// A vertex of the part that is cut: its position seen from above, its normal, and its squared strain as weight.
struct Sample {
    place: [f64; 2],
    normal: Vector3<f64>,
    square: f64,
}

impl Sample {
    fn new(surface: &Heightfield, i: usize, square: f64) -> Sample {
        let lattice = surface.lattice();
        let (row, col) = (i / lattice.cols(), i % lattice.cols());
        let here = lattice.position(row, col);
        // Least-squares plane through those neighbours that exist.
        let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (r, c) in lattice.neighbours(row, col).into_iter().flatten() {
            let rise = surface.height(r, c) - surface.heights()[i];
            if rise.is_nan() {
                continue;
            }
            let there = lattice.position(r, c);
            let [x, y] = [0, 1].map(|k| there[k] - here[k]);
            xx += x * x;
            xy += x * y;
            yy += y * y;
            xz += x * rise;
            yz += y * rise;
        }
        let determinant = xx * yy - xy * xy;
        let gradient = match determinant > 0.0 {
            true => [(yy * xz - xy * yz), (xx * yz - xy * xz)].map(|v| v / determinant),
            false => [0.0; 2],
        };
        Sample {
            place: here,
            normal: Vector3::new(-gradient[0], -gradient[1], 1.0).normalize(),
            square,
        }
    }
}

/// Computes the median of the vertices' positions along a direction, each vertex weighted by a power of its strain.
fn median(samples: &[Sample], [x, y]: [f64; 2], power: f64) -> f64 {
    let mut along: Vec<(f64, f64)> = (samples.iter())
        .map(|s| (x * s.place[0] + y * s.place[1], s.square.powf(power)))
        .collect();
    weighted_median(&mut along).unwrap_or(0.0)
}

/// Computes the score of a straight cut, lower is better: adds for each side the smallest eigenvalue of the scatter
/// matrix of the normals, over the number of all vertices: 0 for planes, cylinders and cones (Julius, Kraevoy and
/// Sheffer 2005, *D-Charts*). The length of the cut is added with [`CUT_LENGTH_WEIGHT`].
fn score(samples: &[Sample], [a, b, c]: [f64; 3], spacing: f64) -> f64 {
    let mut sums = [(0.0, Vector3::zeros(), Matrix3::zeros()); 2];
    let mut length = 0.0;
    for sample in samples {
        let away = a * sample.place[0] + b * sample.place[1] + c;
        let (count, sum, squares) = &mut sums[usize::from(away > 0.0)];
        *count += 1.0;
        *sum += sample.normal;
        *squares += sample.normal * sample.normal.transpose();
        length += f64::from(away.abs() < 0.5 * spacing);
    }
    let left = sums.map(|(count, sum, squares)| {
        if count == 0.0 {
            return 0.0;
        }
        let variance = squares - sum * sum.transpose() / count;
        variance.symmetric_eigenvalues().min().max(0.0)
    });
    let total = samples.len() as f64;
    let balance = (sums[0].0 - sums[1].0).abs() / total;
    (left[0] + left[1]) / total + CUT_LENGTH_WEIGHT * length / total.sqrt() * (1.0 + balance)
}
