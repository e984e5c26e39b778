use super::*;
use crate::fit::mesh::geometry::twice_area;
use crate::fit::mesh::orientation::turn_back;

/// A vertex of a flat sheet that lies beyond its neighbours goes back, and no other one moves farther than it did.
#[test]
fn a_vertex_beyond_its_neighbours_goes_back() {
    let sheet = given(&indexed(&grid(8, 8, |u, v| [u, v, 0.0])));
    let mut x = sheet.noisy.clone();
    let at = |x: &Point| (x - Point::new(0.5, 0.5, 0.0)).norm() < 1e-9;
    let vertex = x.iter().position(at).unwrap();
    x[vertex].x += 0.2;
    let before = x.clone();
    let turned = |x: &[Point]| {
        let triangles = sheet.topology.triangles.iter();
        triangles.filter(|t| twice_area(x, t).z <= 0.0).count()
    };
    assert!(turned(&x) > 0);
    assert!(turn_back(&sheet, &mut x));
    assert_eq!(turned(&x), 0);
    let moved = x.iter().zip(&before).map(|(a, b)| (a - b).norm());
    assert!(moved.fold(0.0, f64::max) < 0.2);
}
