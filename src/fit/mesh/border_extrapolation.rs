//! Extrapolation of a mesh's border vertices from the surface inside.

use super::geometry::{Frame, Point};
use super::input::MeshInput;
use super::quadratic::{Neighbour, Quadratic};
use super::smooth_regions::SmoothRegions;
use super::topology::Topology;

/// Number of rings of neighbours around a border vertex in which an interior vertex is searched for.
const INNER_SEARCH_RINGS: usize = 3;

/// Weight of a second-ring vertex relative to a first-ring vertex in the quadratic that the surface is extrapolated by.
const SECOND_RING_WEIGHT: f64 = 0.3;

/// Maximum noise amplification of a quadratic that the surface is extrapolated by, relative to that of a quadratic
/// fitted to a hexagonal ring; a quadratic that amplifies more is not used.
const MAX_CONTINUATION_AMPLIFICATION: f64 = 100.0;

/// Maximum step of a border vertex, as a share of its reach: three standard deviations of the noise. A quadratic that
/// leads farther than noise does is discarded.
const MAX_EXTRAPOLATION_REACH_SHARE: f64 = 0.6;

/// Extrapolates each border vertex from the quadratics fitted at its interior neighbours, on the same side of
/// every crease where `sides` are known. A vertex without interior neighbours stays.
pub(super) fn extrapolate_border(
    given: &MeshInput,
    x: &mut [Point],
    frames: &[Frame],
    sides: Option<&SmoothRegions>,
) {
    let topology = &given.topology;
    let old = x.to_vec();
    for vertex in 0..topology.len() {
        if topology.inside[vertex] || given.held[vertex] {
            continue;
        }
        let mut ring: Vec<u32> = topology.around(vertex).to_vec();
        for _ in 1..INNER_SEARCH_RINGS {
            if ring.iter().any(|other| topology.inside[*other as usize]) {
                break;
            }
            let wider = ring
                .iter()
                .flat_map(|other| topology.around(*other as usize));
            let mut wider: Vec<u32> = wider.copied().collect();
            wider.sort_unstable();
            wider.dedup();
            ring = wider;
        }
        let (mut sum, mut count) = (Point::zeros(), 0.0);
        for inner in ring.into_iter().map(|other| other as usize) {
            // A border vertex where regions meet belongs to all of them.
            let own = sides.filter(|sides| !sides.is_on_crease(vertex));
            let inside = |other: usize| {
                let fits = own.is_none_or(|sides| sides.region[other] == sides.region[vertex]);
                topology.inside[other] && fits
            };
            if !inside(inner) {
                continue;
            }
            let frame = &frames[inner];
            if let Some((rise, up)) =
                continue_surface(topology, &old, frame, inner, inside, old[vertex])
            {
                // The border vertex moves along the normal of the interior vertex, by the height of its quadratic.
                let step = frame.normal * (rise / up.dot(&frame.normal));
                if step.norm() <= MAX_EXTRAPOLATION_REACH_SHARE * given.reach[vertex] {
                    // The error of an extrapolation grows with the distance squared.
                    let weight = (old[vertex] - old[inner]).norm_squared().powi(-2);
                    sum += step * weight;
                    count += weight;
                }
            }
        }
        if count > 0.0 {
            x[vertex] = given.within_reach(vertex, old[vertex] + sum / count);
        }
    }
}

/// Continues the surface to the point `at` by the quadratic fitted at the vertex `inner` to those of its neighbours
/// that are `usable`. Returns how far the quadratic is above the point along the quadratic's normal there, and that
/// normal.
pub(super) fn continue_surface(
    topology: &Topology,
    x: &[Point],
    frame: &Frame,
    inner: usize,
    usable: impl Fn(usize) -> bool,
    at: Point,
) -> Option<(f64, Point)> {
    let mut second = Vec::new();
    topology.second_ring(inner, &mut second);
    let near = topology.around(inner).iter().map(|other| (other, 1.0));
    let all = near.chain(second.iter().map(|other| (other, SECOND_RING_WEIGHT)));
    let neighbours: Vec<Neighbour> = all
        .filter(|(other, _)| usable(**other as usize))
        .map(|(other, weight)| Neighbour {
            offset: x[*other as usize] - x[inner],
            weight,
        })
        .collect();
    if neighbours.iter().filter(|n| n.weight == 1.0).count() < 2 {
        return None;
    }
    let fit = Quadratic::fit(frame, neighbours.iter().copied())
        .filter(|fit| fit.amplification() <= MAX_CONTINUATION_AMPLIFICATION)?;
    let [a, b, height] = frame.coordinates(at - x[inner]);
    let [along, across] = fit.gradient([a, b]);
    let [t1, t2] = &frame.tangents;
    let up = (frame.normal - along * t1 - across * t2).normalize();
    let rise = (fit.height([a, b]) - height) * up.dot(&frame.normal);
    rise.is_finite().then_some((rise, up))
}
