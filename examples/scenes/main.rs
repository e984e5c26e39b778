//! How close to the truth the default comes, without any parameter, beside the λ that is best for each shape, which only
//! who knows the truth can pick.
//!
//! ```sh
//! cargo run --release --example scenes
//! cargo run --release --example scenes -- 64 0 "8 bit" fan list
//! ```
//!
//! The second form is for one size in pixels, one seed (0: those that constants are chosen on, 1: those that are kept,
//! both: all), and for faults and shapes whose names begin so; `list` writes a line for each case. The best λ are kept in
//! `target/scenes-oracles.txt`. `-- pictures docs` writes six scenes as pictures, and the page that shows them, to the
//! folder `docs`; `-- meshes FOLDER` all of them as meshes, for `benches/pymeshlab/compare.py`.

mod distance;
mod meshes;
mod noise;
mod pictures;
mod random_shapes;
mod sensors;
mod shapes;
mod table;

use std::path::Path;

/// Width and height of the images in pixels.
const DEFAULT_SIZE: usize = 64;

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1).peekable();
    for (what, write) in [
        ("pictures", pictures::write as fn(&Path) -> _),
        ("meshes", meshes::write),
    ] {
        if args.next_if_eq(what).is_some() {
            return write(args.next().ok_or("name a folder for them")?.as_ref());
        }
    }
    let size = args.next().map_or(Ok(DEFAULT_SIZE), |size| size.parse())?;
    let seeds = match args.next().as_deref() {
        Some("0") => 0..1,
        Some("1") => 1..2,
        _ => 0..2,
    };
    let [fault, shape, list] = [(); 3].map(|()| args.next().unwrap_or_default());
    table::write(size, seeds, &fault, &shape, !list.is_empty())?;
    Ok(())
}
