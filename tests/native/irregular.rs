//! Whole meshes of any triangulation: no vertex moves farther than the noise may have moved it, no triangle turns over,
//! and a bend over several edges is no crease.

use crate::native::common::irregular::{NoisyMesh, Sheet, Tessellation};
use developable::{MeshOptions, fit_mesh};

const SHEETS: [Sheet; 3] = [Sheet::Curled, Sheet::Folded, Sheet::Bracket { radius: 0.1 }];

/// Relative tolerance for rounding.
const ROUNDING: f64 = 1e-6;

#[test]
fn no_vertex_moves_farther_than_five_times_the_noise_and_no_triangle_turns_over() {
    for sheet in SHEETS {
        for tessellation in Tessellation::ALL {
            for sigma in [0.0, 0.003] {
                let sample = NoisyMesh::new(sheet, tessellation, 20, sigma, true, 5);
                let found = fit_mesh(&sample.mesh, &MeshOptions::default()).unwrap();
                let what = format!("{sheet:?} {tessellation:?} {sigma}");
                let noise = found.report().sigma.unwrap();
                let moved = sample.moved(found.mesh());
                let most = 5.0 * (1.0 + ROUNDING) * noise + 1e-12;
                assert!(moved <= most, "{what}: {moved} {noise}");
                let [before, after] = found.report().flipped;
                let reported = found.report().entangled.len();
                let most = if sigma > 0.0 { reported } else { before };
                assert!(after <= most, "{what}: {after} {reported}");
                // The noise does not determine which side thin triangles face, nor triangles far smaller than itself.
                let [given, own] = [&sample.mesh, found.mesh()].map(|mesh| sample.turned(mesh));
                let share = if matches!(tessellation, Tessellation::Graded) {
                    4
                } else {
                    8
                };
                assert!(own <= 2 + given / share, "{what}: {given} {own}");
                // Few long triangles, as at a ragged rim, do not hold enough of the shape to take all noise away.
                let is_coarse = matches!(
                    tessellation,
                    Tessellation::Hubs | Tessellation::Decimated | Tessellation::RaggedRim
                );
                let noisy = 1.2 * sample.distance(&sample.mesh) + 1e-3;
                let distance = sample.distance(found.mesh());
                assert!(is_coarse || distance < noisy, "{what}: {distance} {noisy}");
            }
        }
    }
}

#[test]
fn a_bend_over_several_edges_stays_a_bend() {
    for (side, sigma) in [(75, 0.003), (75, 0.001)] {
        let sheet = Sheet::Bracket { radius: 0.035 };
        let sample = NoisyMesh::new(sheet, Tessellation::Regular, side, sigma, true, 1);
        let [own, smooth] = [None, Some(0)].map(|passes| {
            let mut options = MeshOptions::default();
            if let Some(passes) = passes {
                options = options.crease_passes(passes);
            }
            let found = fit_mesh(&sample.mesh, &options).unwrap();
            [sample.distance(found.mesh()), sample.angle(found.mesh())]
        });
        assert!(
            (0..2).all(|k| own[k] < 1.1 * smooth[k]),
            "{side} {sigma}: {own:?} {smooth:?}"
        );
    }
}

#[test]
fn a_fold_stays_a_fold() {
    let fold = NoisyMesh::new(Sheet::Folded, Tessellation::Regular, 40, 0.003, true, 3);
    let found = fit_mesh(&fold.mesh, &MeshOptions::default()).unwrap();
    let smooth = fit_mesh(&fold.mesh, &MeshOptions::default().crease_passes(0)).unwrap();
    assert!(fold.angle(found.mesh()) < 0.8 * fold.angle(smooth.mesh()));
}
