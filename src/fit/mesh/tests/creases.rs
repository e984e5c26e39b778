use super::*;
use crate::fit::mesh::smooth_regions::SmoothRegions;

/// Two squares at a right angle, `y` along the crease.
fn corner() -> Mesh {
    let floor = grid(16, 16, |u, v| [u, v, 0.0]);
    let wall = grid(16, 16, |u, v| [0.0, v, 1.0 - u]);
    indexed(&[floor, wall].concat())
}

fn frames(given: &MeshInput) -> Vec<Frame> {
    let up = normals(&given.topology, &given.noisy, None);
    let frame = |up| Frame::from_normal(up, Point::new(0.3, 0.5, 0.7));
    up.into_iter().map(frame).collect()
}

#[test]
fn fits_beside_a_crease_go_by_their_own_side() {
    let given = given(&corner());
    let sides = SmoothRegions::new(&given.topology, &given.noisy).unwrap();
    let bends = |sides: Option<&SmoothRegions>| {
        let x = given.noisy.clone();
        let vertices = LevelVertices::from_mesh(&given, x, frames(&given), sides);
        Linearisation::new(vertices, huber_penalty(), 1e4, sides).unwrap()
    };
    let largest = |linear: &Linearisation| {
        let mut most = 0.0f64;
        let operator = &linear.problem.operator;
        operator.hessians(&linear.start(), |stencil, hessian| {
            if !sides.is_on_crease(linear.centres[stencil] as usize) {
                most = most.max(hessian.nuclear_norm());
            }
        });
        most
    };
    let [any, own] = [None, Some(&sides)].map(|sides| largest(&bends(sides)));
    assert!(any > 0.1, "{any}");
    assert!(own < 1e-9, "{own}");
}
