//! Initial guess for a curled sheet: the ruled surface through two opposite edges of the page.

use nalgebra::Vector3;

use super::grid::{SheetGrid, node_shares};
use super::plane::{CameraPrior, Homography, UNKNOWN_RATIO_DEVIATION, grid_rows};
use super::polyline::{Polyline, equidistant};

impl Homography {
    /// Makes the sheet of a page that is curled in one direction: the ruled surface between its upper and lower edge, or
    /// between its left and right edge if `sideways`. Each of the two edges lies in a plane that is normal to the rulings;
    /// its points are where their lines of sight meet that plane. The grid has `cols` columns; `apparent` is the ratio of
    /// height to width in the photo. None if a part of the sheet is not in front of the camera.
    pub fn ruled_sheet(
        &self,
        cols: usize,
        edges: &[Polyline; 4],
        sideways: bool,
        prior: &CameraPrior,
        apparent: f64,
    ) -> Option<SheetGrid> {
        // The chord of a bent edge is shorter than the edge, so that the page's own ratio does not apply.
        let chords = CameraPrior {
            log_ratio: Some([apparent.ln(), UNKNOWN_RATIO_DEVIATION]),
            ..*prior
        };
        let plane = self.sheet(2, &chords, apparent)?;
        let last = plane.nodes.len() - 1;
        let [a, b, c, d] = [0, 1, last - 1, last].map(|i| plane.nodes[i]);
        let (rulings, pair) = if sideways {
            (b - a + d - c, [(&edges[2], a), (&edges[3], b)])
        } else {
            (c - a + d - b, [(&edges[0], a), (&edges[1], c)])
        };
        let log_ratio = prior.ratio(apparent)[0];
        let rows = grid_rows(cols, log_ratio.exp());
        let (count, length) = if sideways {
            (rows, log_ratio.exp())
        } else {
            (cols, 1.0)
        };
        let curves = pair.map(|(edge, start)| {
            let points: Vec<[f64; 3]> = (edge.points().iter())
                .map(|seen| {
                    let ray = plane.camera.ray(*seen);
                    (ray * (start.dot(&rulings) / ray.dot(&rulings))).into()
                })
                .collect();
            equidistant(&points, count)
        });
        let [one, other] = &curves;
        let unit = 0.5 * (one.1 + other.1) / length;
        let nodes: Vec<_> = (node_shares([cols, rows]).enumerate())
            .map(|(i, [across, down])| {
                let (along, share) = if sideways {
                    (i / cols, across)
                } else {
                    (i % cols, down)
                };
                let [from, to] = [&one.0, &other.0].map(|curve| Vector3::from(curve[along]));
                from.lerp(&to, share) / unit
            })
            .collect();
        let visible = (nodes.iter()).all(|node| plane.camera.project(*node).is_some());
        visible.then_some(SheetGrid {
            cols,
            rows,
            log_ratio,
            nodes,
            ..plane
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::sheet::camera::SheetCamera;

    /// Half angle of the arc of a circle of length 1 to which the page is curled.
    const HALF_ANGLE: f64 = 0.6;

    const RATIO: f64 = 1.4;

    const CAMERA: SheetCamera = SheetCamera {
        log_scale: 0.0,
        centre: [0.0; 2],
    };

    /// A page that is curled across by an arc of a circle, or down by one if `sideways`, tilted about both axes.
    fn page([x, y]: [f64; 2], sideways: bool) -> Vector3<f64> {
        let (along, across, length) = if sideways {
            (y, x, RATIO)
        } else {
            (x, RATIO * y, 1.0)
        };
        let angle = HALF_ANGLE * (2.0 * along - 1.0);
        let radius = 0.5 * length / HALF_ANGLE;
        let (bent, up) = (radius * angle.sin(), -radius * angle.cos());
        let at = if sideways {
            Vector3::new(across - 0.5, bent, up)
        } else {
            Vector3::new(bent, across - 0.5 * RATIO, up)
        };
        let turn = nalgebra::Rotation3::from_euler_angles(0.4, -0.3, 0.2);
        turn * at + Vector3::new(0.1, -0.1, 3.0)
    }

    #[test]
    fn the_edges_of_a_cylinder_give_the_cylinder() {
        for sideways in [false, true] {
            let seen = |share| CAMERA.project(page(share, sideways)).unwrap();
            let edge = |at: fn(f64) -> [f64; 2]| {
                Polyline::new((0..=400).map(|i| seen(at(i as f64 / 400.0))).collect())
            };
            let edges = [
                edge(|t| [t, 0.0]),
                edge(|t| [t, 1.0]),
                edge(|t| [0.0, t]),
                edge(|t| [1.0, t]),
            ];
            let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(seen);
            let homography = Homography::new(corners).unwrap();
            let chord = HALF_ANGLE.sin() / HALF_ANGLE;
            let apparent = RATIO * if sideways { chord } else { 1.0 / chord };
            let prior = CameraPrior {
                scale_deviation: 1e-6,
                centre_deviation: 1e-6,
                log_ratio: Some([RATIO.ln(), 0.002]),
            };
            let sheet = homography.ruled_sheet(9, &edges, sideways, &prior, apparent);
            let sheet = sheet.unwrap();
            for (node, share) in (sheet.nodes.iter()).zip(node_shares([sheet.cols, sheet.rows])) {
                let expected = page(share, sideways);
                assert!((node - expected).norm() < 0.01, "{node} {expected}");
            }
        }
    }
}
