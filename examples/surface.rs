//! Makes meshes piecewise developable as they are, without a view:
//!
//! ```text
//! cargo run --release --example surface -- noisy.ply found.ply [more pairs]
//! ```
//!
//! and writes the report of each, a line of JSON, to standard output. PLY files only.

use std::env;
use std::fs;

use developable::files::meshes::{MeshFormat, read_mesh};
use developable::{MeshOptions, fit_mesh};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files: Vec<String> = env::args().skip(1).collect();
    for pair in files.chunks_exact(2) {
        let mesh = read_mesh(&fs::read(&pair[0])?, Some(MeshFormat::Ply))?;
        let surface = fit_mesh(&mesh, &MeshOptions::default())?;
        fs::write(
            &pair[1],
            developable::files::meshes::write_ply(surface.mesh())?,
        )?;
        println!("{}", serde_json::to_string(surface.report())?);
    }
    Ok(())
}
