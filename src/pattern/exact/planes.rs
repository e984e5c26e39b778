//! Planes in a mesh with noise: regions of vertices that lie in one plane as nearly as the noise lets them.

use std::collections::BTreeSet;

use nalgebra::Matrix3;

use super::growth::grow;
use crate::math::index::NO_INDEX;
use crate::math::least_squares::LeastSquares;
use crate::math::symmetric_eigen::symmetric_eigen3;
use crate::scene::polyhedron::{Place, Polyhedron};

/// Number of neighbouring vertices from which the noise is measured and a region grows, and minimum number of a region.
/// `benches/patterns.md` has what others give.
const SEED_VERTICES: usize = 16;

/// Distance from a plane, in standard deviations of the noise, within which a vertex may lie in it. `benches/patterns.md` has what
/// others give.
pub(super) const MAX_DEVIATION_SIGMAS: f64 = 3.0;

/// Share of the seeds that are flatter than the noise is measured at: the others may lie across creases. `benches/patterns.md` has
/// what others give.
const FLAT_SEED_QUANTILE: f64 = 0.25;

/// That quantile of the variance of [`SEED_VERTICES`] about their plane, as a share of its mean (chi-squared, 13 degrees).
const FLAT_SEED_VARIANCE_SHARE: f64 = 0.715;

/// Levels of noise that are tried, in multiples of what neighbouring vertices show: noise may be alike at neighbours.
/// `benches/patterns.md` has what others give.
const NOISE_LEVELS: [f64; 2] = [1.0, 2.0];

/// Maximum number of rounds in which a region grows, and of those in which vertices choose among regions. `benches/patterns.md` has
/// what others give.
const MAX_ROUNDS: usize = 12;

/// Maximum ratio of the deviations of a region from a plane for two regions and from its own. `benches/patterns.md` has what others
/// give.
const MAX_MERGED_DEVIATION_RATIO: f64 = 1.2;

/// Maximum share of the squared distances from its plane that a quadratic explains in a face: more is the shape of a bent surface.
/// `benches/patterns.md` has what others give.
const MAX_BENT_SHARE: f64 = 0.2;

/// Sum of squared distances, in variances, that a quadratic explains by chance in noise: four standard deviations above the mean
/// of a chi-squared of three degrees. `benches/patterns.md` has what others give.
const MAX_CHANCE_VARIANCES: f64 = 13.0;

/// Minimum squared sine of the angle between planes that decide where a corner is. `benches/patterns.md` has what others give.
const MIN_SQUARED_SINE: f64 = 1e-4;

/// Minimum extent of a face across its length (root mean square distance from its middle) in standard deviations of the noise: the
/// plane of a single row of vertices may have any tilt. `benches/patterns.md` has what others give.
const MIN_FACE_SIGMAS: f64 = 15.0;

/// Maximum share of the vertices that lie in no plane. `benches/patterns.md` has what others give.
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

/// Number of points, their sum, and the sum of the products of their coordinates.
#[derive(Debug, Clone, Copy, Default)]
struct Spread {
    count: f64,
    sum: Place,
    products: Matrix3<f64>,
}

impl Spread {
    fn of(points: impl Iterator<Item = Place>) -> Spread {
        points.fold(Spread::default(), |spread, p| Spread {
            count: spread.count + 1.0,
            sum: spread.sum + p,
            products: spread.products + p * p.transpose(),
        })
    }

    fn with(&self, other: &Spread) -> Spread {
        Spread {
            count: self.count + other.count,
            sum: self.sum + other.sum,
            products: self.products + other.products,
        }
    }

    /// Sum of the products of the coordinates from the mean.
    fn scatter(&self) -> Matrix3<f64> {
        self.products - self.sum * self.sum.transpose() / self.count
    }

    /// Sum of the squared distances from a plane.
    fn squares_from(&self, plane: &Plane) -> f64 {
        let off = plane.distance(&(self.sum / self.count));
        (plane.normal.dot(&(self.scatter() * plane.normal))).max(0.0) + self.count * off * off
    }

    /// The nearest plane, and the variance of the distances from it.
    fn plane(&self) -> Option<(Plane, f64)> {
        if self.count <= 3.0 {
            return None;
        }
        let origin = self.sum / self.count;
        let [_, _, (least, normal)] = symmetric_eigen3(self.scatter());
        Some((
            Plane { origin, normal },
            least.max(0.0) / (self.count - 3.0),
        ))
    }
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
    pub(super) fn corner(&self, from: Place, planes: &BTreeSet<u32>) -> Place {
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
            let near = grow(&search.around, seed, |near, _| near.len() < SEED_VERTICES);
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

    fn fit(&self, members: &[u32]) -> Option<(Plane, f64)> {
        // About the first point: squares of coordinates lose digits.
        let first = self.places[*members.first()? as usize];
        let spread = Spread::of(members.iter().map(|v| self.places[*v as usize] - first));
        let (plane, variance) = spread.plane()?;
        let origin = plane.origin + first;
        Some((Plane { origin, ..plane }, variance))
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
            let mut members = grow(&self.around, *seed, |near, v| {
                near.len() < SEED_VERTICES && is_free(v)
            });
            for _ in 0..MAX_ROUNDS {
                let before = members.len();
                let Some((plane, _)) = self.fit(&members) else {
                    break;
                };
                members = grow(&self.around, *seed, |_, v| is_free(v) && is_near(&plane, v));
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
        for _ in 0..MAX_ROUNDS {
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
        let regions = self.regions(labels);
        let place = |v: &u32| self.places[*v as usize];
        let mut spreads: Vec<Spread> = (regions.iter())
            .map(|region| Spread::of(region.iter().map(place)))
            .collect();
        let mut joined: Vec<u32> = (0..regions.len() as u32).collect();
        for [a, b] in pairs {
            let [one, other] = [a, b].map(|k| spreads[k as usize]);
            let both = one.with(&other);
            let Some((plane, _)) = both.plane() else {
                continue;
            };
            let is_explained = |own: &Spread| {
                own.plane().is_none_or(|(_, variance)| {
                    own.squares_from(&plane)
                        <= MAX_MERGED_DEVIATION_RATIO.powi(2) * variance * own.count
                })
            };
            let has_any = one.count > 0.0 && other.count > 0.0;
            if has_any && is_explained(&one) && is_explained(&other) {
                (spreads[a as usize], spreads[b as usize]) = (Spread::default(), both);
                joined[a as usize] = b;
            }
        }
        // A region joins a later one only, which may have joined another.
        for k in (0..joined.len()).rev() {
            joined[k] = joined[joined[k] as usize];
        }
        for (label, region) in joined.iter().zip(&regions) {
            region.iter().for_each(|v| labels[*v as usize] = *label);
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
            let members = grow(&self.around, first, |_, v| {
                before[v as usize] == before[first as usize]
            });
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

    /// Root mean square distances of vertices from their mean, along the directions in which they are longest and second longest.
    fn extents(&self, members: &[u32]) -> [f64; 2] {
        let spread = Spread::of(members.iter().map(|v| self.places[*v as usize]));
        let [(long, _), (middle, _), _] = symmetric_eigen3(spread.scatter());
        [long, middle].map(|value| (value.max(0.0) / spread.count).sqrt())
    }

    /// The planes with the noise that they leave, if the mesh is a polyhedron with noise: nearly all vertices lie in the planes, and
    /// their distances from them are not quadratic in a face.
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
        let (mut all, mut bent) = (0.0, 0);
        for (region, plane) in regions.iter().zip(&found.planes) {
            let [x, y] = plane.axes();
            let [size, _] = self.extents(region);
            let mut quadratic = LeastSquares::<6>::new();
            let mut own = 0.0;
            for v in region.iter().filter(|v| is_inner(v)) {
                let off = self.places[*v as usize] - plane.origin;
                let [p, q] = [x, y].map(|axis| axis.dot(&off) / size);
                let row = [1.0, p, q, p * p, p * q, q * q].into();
                quadratic.add(&row, [distances[*v as usize]], 1.0);
                own += distances[*v as usize].powi(2);
            }
            all += own;
            let explained = (quadratic.solve()?.transpose() * quadratic.right).x;
            let chance = MAX_CHANCE_VARIANCES * own / region.len() as f64;
            if explained > MAX_BENT_SHARE * own + chance {
                bent += region.len();
            }
        }
        let inner = (0..distances.len() as u32).filter(is_inner).count();
        let noise = (all / inner as f64).sqrt();
        let is_large = |region: &Vec<u32>| self.extents(region)[1] >= MIN_FACE_SIGMAS * noise;
        // Vertices without triangles are none of the surface.
        let used = (found.labels.iter().zip(&self.around)).filter(|(_, near)| !near.is_empty());
        let count = used.clone().count() as f64;
        let is_polyhedron = inner as f64 >= (1.0 - MAX_OUTLIER_SHARE) * count
            && bent as f64 <= MAX_OUTLIER_SHARE * count
            && regions.iter().all(is_large)
            && used.clone().all(|(label, _)| *label != NO_INDEX);
        is_polyhedron.then_some(NoisyPlanes { noise, ..found })
    }
}
