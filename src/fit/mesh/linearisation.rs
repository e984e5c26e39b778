//! Linearisation of the energy of a mesh about a base, from which vertices move along their normals (rays).
//!
//! The unknowns are `√w s`, where `s` is the distance along the ray and `w` each vertex's share of the area, so
//! that the fidelity has the same weight at all of them. The second fundamental form of the base itself is the
//! column of one more vertex, which is held at 1.

use super::adjacency::Adjacency;
use super::geometry::{Frame, Point};
use super::level_vertices::LevelVertices;
use super::quadratic::{Neighbour, Quadratic, SECOND_RING_FIT_WEIGHT, STENCIL_ROW_CAPACITY};
use super::smooth_regions::SmoothRegions;
use super::topology::Topology;
use crate::error::{Error, Result, try_filled};
use crate::fit::energy::problem;
use crate::fit::energy::spectral_penalty::{HuberParameters, PenaltyKind};
use crate::fit::operator::sparse::matrix::SparseMatrix;
use crate::fit::operator::sparse::{Rows, SparseOperator, SparseOperatorParts};
use crate::lattice::per_cell::PerCell;
use crate::math::index::NO_INDEX;

pub(super) type Problem = problem::Problem<SparseOperator>;

/// Minimum area of a vertex in the energy, as a share of the mean; smaller areas are raised to it (`benches/whole.md`).
const MIN_AREA_SHARE: f64 = 0.1;

/// Maximum noise amplification of a quadratic fitted to the first ring of a vertex, relative to a hexagonal ring's;
/// above it the second ring is added. Including the second ring on all irregular meshes reduces the angle between
/// normals of surface and truth by a third (`benches/whole.md`).
const MAX_RING_AMPLIFICATION: f64 = 1.05;

/// Minimum number of first-ring vertices at which a quadratic may be fitted to them without the second ring.
const MIN_RING_VERTICES: usize = 6;

/// Minimum confidence of a mesh's vertex that counts: a smaller one would need a linear system of its own.
pub(super) const MIN_CONFIDENCE: f64 = 1e-4;

/// Problem of a mesh's fit, linearised about a base: the convex problem that one pass solves.
#[derive(Debug, Clone)]
pub(super) struct Linearisation {
    pub problem: Problem,
    /// Vertices of the problem. The unknowns of their directions across the rays follow those of the vertices and the
    /// constant.
    pub vertices: LevelVertices,
    /// Vertex in the middle of each stencil.
    pub centres: Vec<u32>,
    /// Stencil whose middle each vertex is, or [`NO_INDEX`].
    pub about: Vec<u32>,
    /// Factor from each vertex's unknown to a distance along its ray.
    pub scales: Vec<f64>,
    /// Spacing of a hexagonal lattice with vertices of the same mean area.
    pub spacing: f64,
}

/// Returns the spacing of a hexagonal lattice whose vertices have this area each.
pub(super) fn hexagonal_spacing(area: f64) -> f64 {
    (2.0 * area / 3f64.sqrt()).sqrt()
}

impl Linearisation {
    /// Linearises the energy about the vertices of a level, which move along the normals of their frames, and across
    /// these as well on creases, where smooth regions of `sides` meet.
    ///
    /// # Errors
    /// [`Error::Topology`] if no vertex has triangles all around, or [`Error::OutOfMemory`].
    pub(super) fn new(
        vertices: LevelVertices,
        bends: HuberParameters,
        lambda: f64,
        sides: Option<&SmoothRegions>,
    ) -> Result<Self> {
        let LevelVertices {
            adjacency,
            base,
            frames,
            areas,
            directions,
            ..
        } = &vertices;
        let count = vertices.len();
        let constant = count as u32;
        let side = |vertex: usize| {
            let sides = sides?;
            let own = sides.region[vertices.source[vertex] as usize];
            (own != NO_INDEX).then_some(own)
        };
        let touches = |other: u32, own: u32| {
            sides.is_none_or(|s| s.touches(vertices.source[other as usize] as usize, own))
        };
        let across = constant + 1;
        let unknowns = count + 1 + directions.all.len();
        let mut about = try_filled("stencils", count, NO_INDEX)?;
        let (mut centres, mut rows) = (Vec::new(), Rows::new());
        rows.reserve(count, STENCIL_ROW_CAPACITY);
        let mut row = Vec::new();
        for vertex in 0..count {
            if !vertices.inside[vertex] {
                continue;
            }
            let ray = &frames[vertex];
            let own = side(vertex);
            let is_beside = |other: u32| own.is_none_or(|own| touches(other, own));
            let Some((fit, ring, frame)) =
                fit_quadratic_on_side(adjacency, base, ray, vertex, is_beside)
            else {
                continue;
            };
            row.clear();
            for (k, other) in ring.iter().enumerate() {
                let change = fit.change(&frame, k, frames[*other as usize].normal);
                row.push((*other, change.coordinates()));
                for (way, along) in directions.at_vertex(*other as usize) {
                    row.push((across + way, fit.change(&frame, k, along).coordinates()));
                }
            }
            for (way, along) in directions.at_vertex(vertex) {
                let own = fit.change_at_centre(&frame, along);
                row.push((across + way, own.coordinates()));
            }
            let own = fit.change_at_centre(&frame, ray.normal);
            row.push((vertex as u32, own.coordinates()));
            row.push((constant, fit.hessian().coordinates()));
            if row
                .iter()
                .any(|(_, entry)| entry.iter().any(|x| !x.is_finite()))
            {
                continue;
            }
            about[vertex] = centres.len() as u32;
            centres.push(vertex as u32);
            rows.push(row.iter().copied());
        }
        if centres.is_empty() {
            return Err(Error::Topology {
                reason:
                    "no vertex has triangles all around it that say how the surface bends there"
                        .into(),
                advice: "take a mesh with vertices inside, not a strip or separate triangles",
            });
        }
        let mean = centres.iter().map(|v| areas[*v as usize]).sum::<f64>() / centres.len() as f64;
        let spacing = hexagonal_spacing(mean);
        if !(mean > 0.0 && mean.is_finite()) {
            return Err(Error::Topology {
                reason: "its triangles have no area".into(),
                advice: "check its coordinates",
            });
        }
        let share = |vertex: usize| (areas[vertex] / mean).max(MIN_AREA_SHARE);
        let mut scales = try_filled("vertices", count, 0.0)?;
        for (vertex, scale) in scales.iter_mut().enumerate() {
            let trust = vertices
                .confidence
                .get(vertex)
                .map_or(1.0, |c| c.max(MIN_CONFIDENCE));
            *scale = (share(vertex) * trust).sqrt().recip();
        }
        rows.scale_columns(|unknown| match unknown.checked_sub(across) {
            Some(way) => scales[directions.all[way as usize].0 as usize],
            None => scales.get(unknown as usize).copied().unwrap_or(1.0),
        });
        let mut beside = SparseMatrix::new(centres.len());
        for vertex in &centres {
            let ring = adjacency.around(*vertex as usize).iter();
            let ring = ring.map(|other| about[*other as usize]);
            let stencils = ring.filter(|stencil| *stencil != NO_INDEX);
            beside.push(stencils.map(|stencil| (stencil, ())));
        }
        let operator = SparseOperator::new(SparseOperatorParts {
            beside,
            areas: centres
                .iter()
                .map(|vertex| share(*vertex as usize))
                .collect(),
            rows,
            constant: Some(constant),
            places: try_filled("vertices", unknowns, [0.0; 2])?,
            spacing,
            size: 1.0,
        })?;
        let mut target = try_filled("vertices", unknowns, 1.0)?;
        for vertex in 0..count {
            target[vertex] = vertices.offset[vertex].dot(&frames[vertex].normal) / scales[vertex];
        }
        for (target, (vertex, along)) in target[count + 1..].iter_mut().zip(&directions.all) {
            let vertex = *vertex as usize;
            *target = vertices.offset[vertex].dot(along) / scales[vertex];
        }
        let mut problem = Problem::unweighted(operator, lambda, target, PenaltyKind::Huber(bends));
        problem.constrained.push(constant);
        let mut inverse = try_filled("fidelity", unknowns, 1.0)?;
        inverse[count] = 0.0;
        for (vertex, held) in vertices.held.iter().enumerate() {
            if *held {
                problem.constrained.push(vertex as u32);
                inverse[vertex] = 0.0;
            }
        }
        problem.inverse_fidelity = PerCell::Each(inverse);
        let sizes = (base.iter().zip(&vertices.offset)).map(|(x, offset)| (x + offset).norm());
        let largest = sizes.fold(0.0, f64::max);
        problem.set_rounding(largest);
        Ok(Linearisation {
            problem,
            vertices,
            centres,
            about,
            scales,
            spacing,
        })
    }

    /// Returns the unknowns at which all vertices are at the base.
    pub(super) fn start(&self) -> Vec<f64> {
        let mut z = vec![0.0; self.problem.target.len()];
        z[self.vertices.len()] = 1.0;
        for vertex in &self.problem.constrained {
            z[*vertex as usize] = self.problem.target[*vertex as usize];
        }
        z
    }

    /// Returns the positions of the vertices at given unknowns `z`.
    pub(super) fn moved(&self, z: &[f64]) -> Vec<Point> {
        let LevelVertices {
            base,
            frames,
            directions,
            ..
        } = &self.vertices;
        let all = base.iter().zip(frames).zip(z.iter().zip(&self.scales));
        let mut x: Vec<Point> = all
            .map(|((base, frame), (z, scale))| base + frame.normal * (scale * z))
            .collect();
        for (z, (vertex, along)) in z[base.len() + 1..].iter().zip(&directions.all) {
            let vertex = *vertex as usize;
            x[vertex] += along * (self.scales[vertex] * z);
        }
        x
    }
}

/// Maximum slope of a local quadratic fit against its frame's tangent plane. Above it the frame is rotated into the
/// fit's tangent plane, because second derivatives over a slanting plane are not the second fundamental form (`benches/whole.md`).
const MAX_FRAME_SLOPE: f64 = 0.02;

/// Fits a quadratic to the surface about a vertex, over its tangent plane. Returns the quadratic, the vertices that it
/// was fitted to, and its frame.
pub(crate) fn fit_quadratic(
    topology: &Topology,
    x: &[Point],
    frame: &Frame,
    vertex: usize,
) -> Option<(Quadratic, Vec<u32>, Frame)> {
    fit_quadratic_on_side(&topology.adjacency, x, frame, vertex, |_| true)
}

/// Fits as [`fit_quadratic`] does, of the second ring to those vertices alone for which `is_beside` holds.
fn fit_quadratic_on_side(
    adjacency: &Adjacency,
    x: &[Point],
    frame: &Frame,
    vertex: usize,
    is_beside: impl Fn(u32) -> bool,
) -> Option<(Quadratic, Vec<u32>, Frame)> {
    let ring = adjacency.around(vertex);
    let mut vertices = Vec::with_capacity(STENCIL_ROW_CAPACITY);
    vertices.extend_from_slice(ring);
    let mut fit = match ring.len() >= MIN_RING_VERTICES {
        true => Quadratic::fit(frame, weighted_neighbours(x, vertex, ring, ring.len())),
        false => None,
    };
    if fit
        .as_ref()
        .is_none_or(|fit| fit.amplification() > MAX_RING_AMPLIFICATION)
    {
        adjacency.add_second_ring(vertex, &mut vertices, is_beside);
        let neighbours = weighted_neighbours(x, vertex, &vertices, ring.len());
        fit = match fit {
            Some(fit) => fit.with_neighbours(frame, neighbours.skip(ring.len())),
            None => Quadratic::fit(frame, neighbours),
        };
    }
    let fit = fit?;
    let [a, b] = fit.slope();
    if a.hypot(b) > MAX_FRAME_SLOPE {
        let [t1, t2] = &frame.tangents;
        let turned = Frame::from_normal((frame.normal - a * t1 - b * t2).normalize(), *t1);
        let neighbours = weighted_neighbours(x, vertex, &vertices, ring.len());
        if let Some(fit) = Quadratic::fit(&turned, neighbours) {
            return Some((fit, vertices, turned));
        }
    }
    Some((fit, vertices, frame.clone()))
}

/// Iterates over vertices as neighbours of a vertex that a quadratic is fitted at: the first `ring_len` have full weight,
/// and the others that of the second ring.
fn weighted_neighbours<'a>(
    x: &'a [Point],
    vertex: usize,
    others: &'a [u32],
    ring_len: usize,
) -> impl Iterator<Item = Neighbour> + Clone + 'a {
    others.iter().enumerate().map(move |(k, other)| Neighbour {
        offset: x[*other as usize] - x[vertex],
        weight: match k < ring_len {
            true => 1.0,
            false => SECOND_RING_FIT_WEIGHT,
        },
    })
}
