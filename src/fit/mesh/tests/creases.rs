use super::*;
use crate::fit::mesh::border_extrapolation::extrapolate_border;
use crate::fit::mesh::smooth_regions::SmoothRegions;

/// Two squares at a right angle, `y` along the crease.
fn corner() -> Mesh {
    let floor = grid(16, 16, |u, v| [u, v, 0.0]);
    let wall = grid(16, 16, |u, v| [0.0, v, 1.0 - u]);
    indexed(&[floor, wall].concat())
}

/// How far a place is from the nearer of the squares.
fn off(x: &Point) -> f64 {
    x.x.abs().min(x.z.abs())
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
        Linearisation::new(vertices, HUBER_PENALTY, |_| 1e4, sides).unwrap()
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

#[test]
fn a_border_ends_at_a_crease_by_the_side_that_it_is_on() {
    let given = given(&corner());
    let topology = &given.topology;
    let sides = SmoothRegions::new(topology, &given.noisy).unwrap();
    let frames = frames(&given);
    let mut random = random(5);
    let mut shaken = given.noisy.clone();
    for (vertex, x) in shaken.iter_mut().enumerate() {
        if !topology.inside[vertex] && !sides.is_on_crease(vertex) {
            *x += 0.01 * random() * frames[vertex].normal;
        }
    }
    let worst = |sides: Option<&SmoothRegions>, of: &SmoothRegions| {
        let mut x = shaken.clone();
        extrapolate_border(&given, &mut x, &frames, sides);
        let put = (0..x.len()).filter(|v| !of.is_on_crease(*v) && x[*v] != shaken[*v]);
        let far: Vec<f64> = put.map(|v| off(&x[v])).collect();
        assert!(far.len() > 80, "{}", far.len());
        far.into_iter().fold(0.0, f64::max)
    };
    let [any, own] = [None, Some(&sides)].map(|own| worst(own, &sides));
    assert!(any > 1e-3, "{any}");
    assert!(own < 1e-9, "{own}");
}
