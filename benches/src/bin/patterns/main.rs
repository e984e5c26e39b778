//! Time and quality of patterns of examples, rough scans and meshes, as rows of a table.
//!
//! ```sh
//! cargo run --release --bin patterns -- FOLDER [NAME…]
//! ```
//!
//! `FOLDER` has `range.npy` and `bunny.obj`; a name is the beginning of a surface's name. Fitted surfaces are kept in
//! the folder `fitted` of the system's temporary files.

mod scans;
mod shapes;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use developable::drawing::{Drawing, DrawingOptions};
use developable::files::meshes::read_mesh;
use developable::patches::{MeshPatches, PatchOptions, Patches};
use developable::pattern::{Missing, PatternOptions, Sheet, pattern, pattern_mesh};
use developable::{
    Example, ExampleOptions, Heightfield, Mesh, MeshOptions, Options, fit, fit_mesh,
};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Weights of the fidelity at which each scan is fitted.
const LAMBDAS: [f64; 3] = [1e5, 1e6, 1e7];

/// Pixels of a side of each example.
const EXAMPLE_SIZES: [usize; 2] = [120, 250];

/// Length of the longer side of a drawing's surface, in millimetres.
const DRAWN_SIZE_MM: f64 = 300.0;

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments
        .next()
        .ok_or("the folder of the scans is missing")?;
    let wanted: Vec<String> = arguments.collect();
    let is_wanted =
        |name: &str| wanted.is_empty() || wanted.iter().any(|w| name.starts_with(w.as_str()));
    println!("{HEAD}");
    for example in Example::ALL {
        for size in EXAMPLE_SIZES {
            let name = format!("{} {size}", example.name());
            if is_wanted(&name) {
                let surface = kept(&name, || {
                    let options = ExampleOptions {
                        size,
                        ..ExampleOptions::default()
                    };
                    let input = example.generate(&options)?.input.to_lattice(None)?;
                    Ok(fit(&input, &Options::default())?.into_heightfield())
                })?;
                heightfield_row(&name, &surface)?;
            }
        }
    }
    for scan in scans::SCANS {
        for lambda in LAMBDAS {
            let name = format!("{} {lambda:.0e}", scan.name);
            if is_wanted(&name) {
                let surface = kept(&name, || {
                    let input = (scan.make)(Path::new(&folder))?;
                    Ok(fit(&input, &Options::default().lambda(lambda))?.into_heightfield())
                })?;
                heightfield_row(&name, &surface)?;
            }
        }
    }
    let name = "bunny mesh";
    if is_wanted(name) {
        let mesh = kept_mesh(name, || {
            let bytes = std::fs::read(Path::new(&folder).join("bunny.obj"))?;
            let mesh = read_mesh(&bytes, None)?;
            Ok(fit_mesh(&mesh, &MeshOptions::default())?.into_parts().0)
        })?;
        mesh_row(name, &mesh)?;
    }
    for shape in shapes::SHAPES {
        for noise in shapes::NOISE {
            let name = format!("{}, {} %", shape.name, 100.0 * noise);
            if is_wanted(&name) {
                let mesh = kept_mesh(&name, || shapes::fitted(&shape, noise, 1))?;
                mesh_row(&name, &mesh)?;
            }
        }
    }
    Ok(())
}

/// A fitted surface, read from where it was kept or made and kept.
fn kept(name: &str, make: impl Fn() -> Outcome<Heightfield>) -> Outcome<Heightfield> {
    let file = kept_file(name)?;
    if let Ok(bytes) = std::fs::read(&file) {
        return scans::from_bytes(&bytes);
    }
    let surface = make()?;
    std::fs::write(file, scans::to_bytes(&surface))?;
    Ok(surface)
}

/// A fitted mesh, read from where it was kept or made and kept.
fn kept_mesh(name: &str, make: impl Fn() -> Outcome<Mesh>) -> Outcome<Mesh> {
    let file = kept_file(name)?;
    if let Ok(bytes) = std::fs::read(&file) {
        return shapes::from_bytes(&bytes);
    }
    let mesh = make()?;
    std::fs::write(file, shapes::to_bytes(&mesh))?;
    Ok(mesh)
}

/// The file in which a fitted surface is kept.
fn kept_file(name: &str) -> Outcome<PathBuf> {
    let folder = std::env::temp_dir().join("fitted");
    std::fs::create_dir_all(&folder)?;
    Ok(folder.join(name.replace(' ', "-")))
}

fn heightfield_row(name: &str, surface: &Heightfield) -> Outcome<()> {
    let patches = Patches::new(surface, &PatchOptions::default())?;
    let (start, user) = (Instant::now(), user_seconds());
    let found = pattern(surface, &patches, &PatternOptions::default());
    let times = [user_seconds() - user, start.elapsed().as_secs_f64()];
    let vertices = surface.heights().iter().filter(|z| !z.is_nan()).count();
    match found {
        Ok(found) => {
            let size = surface.lattice().cols() as f64 * surface.lattice().spacing();
            let parts = found.patches.len();
            row(
                name,
                [vertices, patches.patches().len(), parts],
                times,
                &found.sheets,
                &found.missing,
                size,
            )
        }
        Err(error) => {
            println!(
                "| {name} | {vertices} | {} | {:.2} | {error} |",
                patches.patches().len(),
                times[0]
            );
            Ok(())
        }
    }
}

fn mesh_row(name: &str, mesh: &Mesh) -> Outcome<()> {
    let patches = MeshPatches::new(mesh, &PatchOptions::default())?;
    let (start, user) = (Instant::now(), user_seconds());
    let found = pattern_mesh(mesh, &patches, &PatternOptions::default())?;
    let times = [user_seconds() - user, start.elapsed().as_secs_f64()];
    let heights = mesh.positions().iter().map(|p| p[1]);
    let size = heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min);
    let parts = found.sheets.iter().map(|sheet| sheet.patches.len()).sum();
    let counts = [mesh.positions().len(), patches.patches().len(), parts];
    row(
        name,
        counts,
        times,
        &found.sheets,
        &Missing::default(),
        size,
    )
}

const HEAD: &str = "| scan | vertices | patches | parts | user s | s | sheets | slits | cuts mm | slits mm | strain % | \
     mismatch % | points | angle off ° | empty outlines | left out |\n\
     | :--- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |";

fn row(
    name: &str,
    [vertices, patches, parts]: [usize; 3],
    [user, seconds]: [f64; 2],
    sheets: &[Sheet],
    missing: &Missing,
    size: f64,
) -> Outcome<()> {
    let scale = DRAWN_SIZE_MM / size;
    let drawing = Drawing::new(sheets, &DrawingOptions::default().scale(scale))?;
    let all = &drawing.summary;
    let off = all
        .worst_angle
        .map_or(0.0, |worst| (worst.flat - worst.surface).abs());
    // Outlines around less than one cell of the lattice.
    let least = (scale * sheets[0].spacing).powi(2);
    let cuts = drawing.sheets.iter().flat_map(|sheet| &sheet.cuts);
    let empty = cuts.filter(|cut| area(cut).abs() < least).count();
    println!(
        "| {name} | {vertices} | {patches} | {parts} | {user:.2} | {seconds:.2} | {} | {} | {:.0} | {:.0} | {:.3} | \
         {:.3} | {} | {off:.1} | {empty} | {} |",
        all.sheets,
        all.slits,
        all.cut_length,
        all.slit_length,
        100.0 * all.strain,
        100.0 * all.mismatch,
        all.points,
        missing.vertices,
    );
    Ok(())
}

/// Area of a closed polyline, positive if it runs counter-clockwise.
fn area(line: &[[f64; 2]]) -> f64 {
    let next = line.iter().cycle().skip(1);
    let pairs = line.iter().zip(next);
    0.5 * pairs.map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>()
}

/// Processor time of this process in user mode, in seconds; 0 where the system does not tell.
fn user_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = stat
        .rsplit(')')
        .next()
        .and_then(|rest| rest.split_whitespace().nth(11));
    ticks
        .and_then(|ticks| ticks.parse::<f64>().ok())
        .unwrap_or(0.0)
        / 100.0
}
