//! Vertices on the border, put where the surface inside goes on to.

use super::geometry::{Frame, Point};
use super::linear::Given;
use super::quadratic::{Neighbour, Quadratic, SECOND};

/// Rings around a vertex of the border in which a vertex inside is looked for.
const RINGS: usize = 3;

/// Puts each vertex that is not inside on the mean of the quadratics that fit at the vertices inside next
/// to it. Where there are none it stays.
pub(super) fn restore(given: &Given, x: &mut [Point], frames: &[Frame]) {
    let topology = &given.topology;
    let old = x.to_vec();
    let mut second = Vec::new();
    for vertex in 0..topology.len() {
        if topology.inside[vertex] || given.held[vertex] {
            continue;
        }
        let mut ring: Vec<u32> = topology.around(vertex).to_vec();
        for _ in 1..RINGS {
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
            if !topology.inside[inner] {
                continue;
            }
            topology.second_ring(inner, &mut second);
            let near = topology.around(inner).iter().map(|other| (other, 1.0));
            let all = near.chain(second.iter().map(|other| (other, SECOND)));
            let neighbours: Vec<Neighbour> = all
                .filter(|(other, _)| topology.inside[**other as usize])
                .map(|(other, weight)| Neighbour {
                    offset: old[*other as usize] - old[inner],
                    weight: if weight == 1.0 { 1.0 } else { 0.3 },
                })
                .collect();
            if neighbours.iter().filter(|n| n.weight == 1.0).count() < 2 {
                continue;
            }
            let frame = &frames[inner];
            let Some(fit) = Quadratic::fit(frame, &neighbours) else {
                continue;
            };
            if fit.amplification() > 100.0 {
                continue;
            }
            let [a, b, height] = frame.coordinates(old[vertex] - old[inner]);
            let rise = fit.height([a, b]) - height;
            if rise.is_finite() {
                sum += frame.normal * rise;
                count += 1.0;
            }
        }
        if count > 0.0 {
            x[vertex] += sum / count;
        }
    }
}
