//! Planes in a mesh with noise: regions of vertices that lie in one plane as nearly as the noise lets them.

use nalgebra::Matrix3;
use rustc_hash::FxHashSet;

use super::polyhedron::{Place, Polyhedron};
use crate::math::index::NO_INDEX;
use crate::math::least_squares::LeastSquares;
use crate::math::symmetric_eigen::symmetric_eigen3;

/// Number of neighbouring vertices from which the noise is measured and a region grows, and minimum number of a region.
const SEED_VERTICES: usize = 16;

/// Distance from a plane, in standard deviations of the noise, within which a vertex may lie in it.
pub(super) const MAX_DEVIATION_SIGMAS: f64 = 3.0;

/// Share of the seeds that are flatter than the noise is measured at: the others may lie across creases.
const FLAT_SEED_QUANTILE: f64 = 0.25;

/// That quantile of the variance of [`SEED_VERTICES`] about their plane, as a share of its mean (chi-squared, 13 degrees).
const FLAT_SEED_VARIANCE_SHARE: f64 = 0.715;

/// Levels of noise that are tried, in multiples of what neighbouring vertices show: noise may be alike at neighbours.
const NOISE_LEVELS: [f64; 2] = [1.0, 2.0];

/// Maximum number of rounds in which a region grows, and of those in which vertices choose among regions.
const MAX_GROWTH_ROUNDS: usize = 12;
const MAX_ASSIGNMENT_ROUNDS: usize = 8;

/// Maximum ratio of the deviations of a region from a plane for two regions and from its own.
const MAX_MERGED_DEVIATION_RATIO: f64 = 1.2;

/// Maximum share of the squared distances from the planes that quadratics explain: more is the shape of a bent surface.
const MAX_BENT_SHARE: f64 = 0.2;

/// Maximum correlation of the distances of neighbouring vertices from their plane.
const MAX_NEIGHBOUR_CORRELATION: f64 = 0.5;

/// Minimum squared sine of the angle between planes that decide where a corner is.
const MIN_SQUARED_SINE: f64 = 1e-4;

/// Minimum extent of a face (root mean square distance from its middle) in standard deviations of the noise.
const MIN_FACE_SIGMAS: f64 = 15.0;

/// Maximum share of the vertices that lie in no plane.
const MAX_OUTLIER_SHARE: f64 = 0.02;

#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub origin: Place,
    pub normal: Place,
}

impl Plane {
    pub(super) fn distance(&self, place: &Place) -> f64 {
        self.normal.dot(&(place - self.origin))
    }

    /// Two directions of the plane; with its normal they are right-handed.
    pub(super) fn axes(&self) -> [Place; 2] {
        let axis = Place::ith(self.normal.iamin(), 1.0);
        let x = axis.cross(&self.normal).normalize();
        [x, self.normal.cross(&x)]
    }
}

/// The plane nearest to points, and the variance of their distances from it.
fn fit_plane(points: impl Iterator<Item = Place> + Clone) -> Option<(Plane, f64)> {
    let count = points.clone().count();
    if count <= 3 {
        return None;
    }
    let origin = points.clone().sum::<Place>() / count as f64;
    let spread = points.map(|p| (p - origin) * (p - origin).transpose());
    let [_, _, (least, normal)] = symmetric_eigen3(spread.sum::<Matrix3<f64>>());
    let variance = least.max(0.0) / (count - 3) as f64;
    Some((Plane { origin, normal }, variance))
}

/// Planes that explain all vertices of a mesh but for noise.
pub(super) struct NoisyPlanes {
    pub planes: Vec<Plane>,
    /// Number of the plane of each vertex.
    pub labels: Vec<u32>,
    /// Standard deviation of the vertices from their planes.
    pub noise: f64,
}

impl NoisyPlanes {
    /// The place nearest to a given one at which planes meet, or come nearest to each other.
    pub(super) fn corner(&self, from: Place, planes: &FxHashSet<u32>) -> Place {
        let (mut matrix, mut right) = (Matrix3::zeros(), Place::zeros());
        for plane in planes.iter().map(|k| &self.planes[*k as usize]) {
            matrix += plane.normal * plane.normal.transpose();
            right -= plane.normal * plane.distance(&from);
        }
        let known = symmetric_eigen3(matrix).into_iter();
        let known = known.filter(|(value, _)| *value > MIN_SQUARED_SINE);
        from + known
            .map(|(value, axis)| axis * (axis.dot(&right) / value))
            .sum::<Place>()
    }

    /// Finds them; `None` if the mesh has no noise, or is no polyhedron.
    pub(super) fn find(solid: &Polyhedron) -> Option<NoisyPlanes> {
        let search = Search::new(solid);
        let mut order = Vec::new();
        for seed in 0..solid.places.len() as u32 {
            let near = search.grow(seed, |near, _| near.len() < SEED_VERTICES);
            if near.len() >= SEED_VERTICES {
                order.push((search.fit(&near)?.1, seed));
            }
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at = (FLAT_SEED_QUANTILE * order.len() as f64) as usize;
        let noise = (order.get(at)?.0 / FLAT_SEED_VARIANCE_SHARE).sqrt();
        let seeds: Vec<u32> = order.iter().map(|(_, seed)| *seed).collect();
        if noise <= solid.rounding {
            return None;
        }
        (NOISE_LEVELS.iter()).find_map(|level| search.planes(&seeds, level * noise))
    }
}

struct Search<'a> {
    places: &'a [Place],
    /// Vertices that have an edge in common with each vertex.
    around: Vec<Vec<u32>>,
}

impl Search<'_> {
    fn new(solid: &Polyhedron) -> Search<'_> {
        let mut around = vec![Vec::new(); solid.places.len()];
        for [a, b, c] in &solid.triangles {
            for (v, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
                around[*v as usize].extend(others);
            }
        }
        around.iter_mut().for_each(|near: &mut Vec<u32>| {
            near.sort_unstable();
            near.dedup();
        });
        Search {
            places: &solid.places,
            around,
        }
    }

    /// Connected vertices from one on, the nearest along edges first, that are admitted one after another.
    fn grow(&self, seed: u32, admits: impl Fn(&[u32], u32) -> bool) -> Vec<u32> {
        let mut seen = FxHashSet::from_iter([seed]);
        let (mut members, mut next) = (vec![seed], 0);
        while let Some(vertex) = members.get(next).copied() {
            next += 1;
            for other in &self.around[vertex as usize] {
                if !seen.contains(other) && admits(&members, *other) {
                    seen.insert(*other);
                    members.push(*other);
                }
            }
        }
        members
    }

    fn fit(&self, members: &[u32]) -> Option<(Plane, f64)> {
        fit_plane(members.iter().map(|v| self.places[*v as usize]))
    }

    fn planes(&self, seeds: &[u32], noise: f64) -> Option<NoisyPlanes> {
        let mut labels = vec![NO_INDEX; self.places.len()];
        let mut planes: Vec<Plane> = Vec::new();
        let is_near = |plane: &Plane, v: u32| {
            plane.distance(&self.places[v as usize]).abs() <= MAX_DEVIATION_SIGMAS * noise
        };
        for seed in seeds {
            let is_free = |v: u32| labels[v as usize] == NO_INDEX;
            if !is_free(*seed) {
                continue;
            }
            let mut members = self.grow(*seed, |near, v| near.len() < SEED_VERTICES && is_free(v));
            for _ in 0..MAX_GROWTH_ROUNDS {
                let before = members.len();
                let Some((plane, _)) = self.fit(&members) else {
                    break;
                };
                members = self.grow(*seed, |_, v| is_free(v) && is_near(&plane, v));
                if members.len() <= before {
                    break;
                }
            }
            if members.len() < SEED_VERTICES {
                continue;
            }
            planes.push(self.fit(&members)?.0);
            (members.iter()).for_each(|v| labels[*v as usize] = planes.len() as u32 - 1);
        }
        for _ in 0..MAX_ASSIGNMENT_ROUNDS {
            let is_same = self.assign(&mut labels, &planes, noise);
            self.merge(&mut labels);
            planes = self.refit(&mut labels)?;
            if is_same {
                break;
            }
        }
        self.checked(NoisyPlanes {
            planes,
            labels,
            noise,
        })
    }

    /// Moves each vertex to that region beside it whose plane is nearest, where one more neighbour of the region counts as much
    /// as a standard deviation. Returns whether none has moved.
    fn assign(&self, labels: &mut [u32], planes: &[Plane], noise: f64) -> bool {
        let mut is_same = true;
        for v in 0..labels.len() {
            let near = || self.around[v].iter().map(|other| labels[*other as usize]);
            let cost = |label: u32| {
                let off = planes[label as usize].distance(&self.places[v]) / noise;
                off * off - near().filter(|other| *other == label).count() as f64
            };
            let own = near().chain([labels[v]]).filter(|label| *label != NO_INDEX);
            let best = own.min_by(|a, b| cost(*a).total_cmp(&cost(*b)));
            let best = best.unwrap_or(NO_INDEX);
            is_same &= best == labels[v];
            labels[v] = best;
        }
        is_same
    }

    fn regions(&self, labels: &[u32]) -> Vec<Vec<u32>> {
        let count = labels.iter().filter(|label| **label != NO_INDEX).max();
        let mut regions = vec![Vec::new(); count.map_or(0, |most| *most as usize + 1)];
        for (v, label) in (0u32..).zip(labels) {
            if *label != NO_INDEX {
                regions[*label as usize].push(v);
            }
        }
        regions
    }

    /// Joins neighbouring regions that one plane explains as well as their own.
    fn merge(&self, labels: &mut [u32]) {
        let mut pairs: Vec<[u32; 2]> = (0..labels.len())
            .flat_map(|v| self.around[v].iter().map(move |other| [v, *other as usize]))
            .map(|ends| ends.map(|v| labels[v]))
            .filter(|[a, b]| a < b && *b != NO_INDEX)
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut regions = self.regions(labels);
        for [a, b] in pairs {
            let both: Vec<u32> = [a, b]
                .iter()
                .flat_map(|k| &regions[*k as usize])
                .copied()
                .collect();
            let Some((plane, _)) = self.fit(&both) else {
                continue;
            };
            let is_explained = |region: &Vec<u32>| {
                let Some((_, own)) = self.fit(region) else {
                    return true;
                };
                let joint = region
                    .iter()
                    .map(|v| plane.distance(&self.places[*v as usize]).powi(2));
                joint.sum::<f64>() <= MAX_MERGED_DEVIATION_RATIO.powi(2) * own * region.len() as f64
            };
            let has_any = [a, b].iter().all(|k| !regions[*k as usize].is_empty());
            if has_any && [a, b].iter().all(|k| is_explained(&regions[*k as usize])) {
                regions[a as usize].clear();
                regions[b as usize] = both;
            }
        }
        for (label, region) in (0u32..).zip(&regions) {
            region.iter().for_each(|v| labels[*v as usize] = label);
        }
    }

    /// Makes each connected part of a region one of its own, or leaves it free if it is small, and fits their planes.
    fn refit(&self, labels: &mut [u32]) -> Option<Vec<Plane>> {
        let mut planes = Vec::new();
        let before = labels.to_vec();
        let mut is_done = vec![false; labels.len()];
        for first in 0..labels.len() as u32 {
            if is_done[first as usize] || before[first as usize] == NO_INDEX {
                continue;
            }
            let members = self.grow(first, |_, v| before[v as usize] == before[first as usize]);
            let is_region = members.len() >= SEED_VERTICES;
            let number = if is_region {
                planes.len() as u32
            } else {
                NO_INDEX
            };
            for v in &members {
                (labels[*v as usize], is_done[*v as usize]) = (number, true);
            }
            if is_region {
                planes.push(self.fit(&members)?.0);
            }
        }
        Some(planes)
    }

    /// Root mean square distance of vertices from their mean.
    fn extent(&self, members: &[u32]) -> f64 {
        let count = members.len() as f64;
        let mean = members
            .iter()
            .map(|v| self.places[*v as usize])
            .sum::<Place>()
            / count;
        let squares = members
            .iter()
            .map(|v| (self.places[*v as usize] - mean).norm_squared());
        (squares.sum::<f64>() / count).sqrt()
    }

    /// The planes with the noise that they leave, if the mesh is a polyhedron with noise: nearly all vertices lie in the planes, and
    /// their distances from them are no shape, neither alike at neighbours nor quadratic in a face.
    fn checked(&self, found: NoisyPlanes) -> Option<NoisyPlanes> {
        let regions = self.regions(&found.labels);
        let limit = MAX_DEVIATION_SIGMAS * found.noise;
        let mut distances = vec![f64::NAN; self.places.len()];
        for (region, plane) in regions.iter().zip(&found.planes) {
            for v in region {
                let off = plane.distance(&self.places[*v as usize]);
                distances[*v as usize] = if off.abs() <= limit { off } else { f64::NAN };
            }
        }
        let is_inner = |v: &u32| !distances[*v as usize].is_nan();
        let (mut all, mut bent) = (0.0, 0.0);
        for (region, plane) in regions.iter().zip(&found.planes) {
            let [x, y] = plane.axes();
            let size = self.extent(region);
            let mut quadratic = LeastSquares::<6>::new();
            for v in region.iter().filter(|v| is_inner(v)) {
                let off = self.places[*v as usize] - plane.origin;
                let [p, q] = [x, y].map(|axis| axis.dot(&off) / size);
                let row = [1.0, p, q, p * p, p * q, q * q].into();
                quadratic.add(&row, [distances[*v as usize]], 1.0);
                all += distances[*v as usize].powi(2);
            }
            bent += (quadratic.solve()?.transpose() * quadratic.right).x;
        }
        let (mut products, mut squares) = (0.0, 0.0);
        for v in (0..distances.len() as u32).filter(is_inner) {
            let same = self.around[v as usize].iter().filter(|other| {
                found.labels[**other as usize] == found.labels[v as usize] && is_inner(other)
            });
            for other in same {
                products += distances[v as usize] * distances[*other as usize];
                squares += distances[v as usize].powi(2);
            }
        }
        let inner = (0..distances.len() as u32).filter(is_inner).count();
        let noise = (all / inner as f64).sqrt();
        let is_large = |region: &Vec<u32>| self.extent(region) >= MIN_FACE_SIGMAS * noise;
        let is_polyhedron = inner as f64 >= (1.0 - MAX_OUTLIER_SHARE) * distances.len() as f64
            && bent <= MAX_BENT_SHARE * all
            && products <= MAX_NEIGHBOUR_CORRELATION * squares
            && regions.iter().all(is_large)
            && !found.labels.contains(&NO_INDEX);
        is_polyhedron.then_some(NoisyPlanes { noise, ..found })
    }
}
