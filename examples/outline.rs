//! Finds the page in each JPEG photo of a folder and its subfolders, and says how well.
//!
//! `cargo run --release --example outline -- FOLDER [TRUTH.json]`. The truth is a JSON object from the end of a photo's path to
//! its four corners in pixels, `[x, y]` each, clockwise from the page's upper left one.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use developable::dewarp::Photo;
use developable::files::images::decode_photo;
use developable::page::find_outline;

type Corners = [[f64; 2]; 4];

/// The JPEG files below a folder, in order.
fn photos(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(photos(&path)?);
        } else if path.extension().is_some_and(|end| end == "jpg") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// The largest distance of a corner from its true place, in % of the page's diagonal, and whether the order is right.
fn error(corners: &Corners, truth: &Corners) -> (f64, bool) {
    let distance = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let worst = |turn: usize| {
        (0..4)
            .map(|k| distance(corners[(k + turn) % 4], truth[k]))
            .fold(0.0, f64::max)
    };
    let least = (0..4).map(worst).fold(f64::MAX, f64::min);
    let diagonal = distance(truth[0], truth[2]);
    (100.0 * least / diagonal, worst(0) <= least)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("which folder?")?;
    let truth: BTreeMap<String, Corners> = match arguments.next() {
        Some(path) => serde_json::from_str(&std::fs::read_to_string(path)?)?,
        None => BTreeMap::new(),
    };
    let mut verdicts: BTreeMap<String, usize> = BTreeMap::new();
    for path in photos(Path::new(&folder))? {
        let image = decode_photo(&std::fs::read(&path)?)?;
        let photo = Photo::new(image.width, image.height, &image.rgba)?;
        let start = Instant::now();
        let report = find_outline(&photo);
        let seconds = start.elapsed().as_secs_f64();
        let verdict = format!("{:?}", report.verdict);
        print!(
            "{} {verdict} {:?} {seconds:.2} s",
            path.display(),
            report.reasons
        );
        if let Some(page) = report.pages.first() {
            print!(" score {:.2} corners {:.0?}", page.score, page.corners);
            let name = path.to_string_lossy();
            if let Some((_, truth)) = truth.iter().find(|(end, _)| name.ends_with(end.as_str())) {
                let (error, is_upright) = error(&page.corners, truth);
                print!(" error {error:.2} % upright {is_upright}");
            }
        }
        println!();
        *verdicts.entry(verdict).or_default() += 1;
    }
    println!("{verdicts:?}");
    Ok(())
}
