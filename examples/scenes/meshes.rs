//! Scenes as meshes, for `benches/pymeshlab/compare.py`: noisy, true, and what we make of them.

use std::fs;
use std::path::Path;

use developable::files::wavefront::write_obj;
use developable::{Frame, Heightfield, Lattice, Options, Triangulation, fit};

use super::noise::Noise;
use super::shapes;

const NOISES: [Noise; 3] = [Noise::White(0.01), Noise::White(0.05), Noise::Voxels(0.03)];

/// Vertices from one side to the other.
const SIZE: usize = 80;

/// Writes OBJ files, and `scenes.json` that lists them.
pub fn write(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    fs::create_dir_all(folder)?;
    let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / SIZE as f64)?;
    let options = Options::default();
    let mut list = Vec::new();
    for scene in shapes::all().iter().filter(|scene| scene.name != "plane") {
        let truth = Heightfield::from_fn(lattice, scene.height)?;
        for (i, noise) in NOISES.into_iter().enumerate() {
            let noisy = noise.add_to(&truth)?;
            let surface = fit(&noisy, &options)?;
            let name = |part: &str| format!("{}-{i}-{part}.obj", scene.name);
            let parts = [
                ("noisy", &noisy),
                ("truth", &truth),
                ("ours", surface.heightfield()),
            ];
            for (part, surface) in parts {
                let surface = Triangulation::new(surface, &Frame::default())?;
                fs::write(folder.join(name(part)), write_obj(surface.mesh(), None)?)?;
            }
            list.push(serde_json::json!({
                "name": scene.name, "noise": noise.to_string(), "vertices": lattice.len(), "seconds": surface.report().seconds.total,
                "noisy": name("noisy"), "truth": name("truth"), "ours": name("ours"),
            }));
            eprintln!("{}, {noise}", scene.name);
        }
    }
    fs::write(
        folder.join("scenes.json"),
        serde_json::to_vec_pretty(&list)?,
    )?;
    Ok(())
}
