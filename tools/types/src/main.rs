//! Writes the types of results, `pkg/result-types.d.ts`: for each structure and enumeration that Rust serialises for JavaScript
//! an interface or a union of names, with the documentation that it has in Rust; and the names that options may have as their
//! values, `pkg/schema/names.js`.
//!
//! It parses the sources, and compiles none of them. (`ts-rs` would take a derive on each structure, a test in each crate of
//! `wasm/`, and leaves out what is said of an enumeration's variants.)

mod docs;
mod items;
mod types;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// First line of the file of types.
const TYPES_HEAD: &str = "/** Results of all calls. Made of the structures in `src/` and `wasm/` by `tools/types`. *The paper* is that in `option-types.d.ts`. */\n";

/// First line of the file of names.
const NAMES_HEAD: &str = "/** Names that options may have as their values. Made of the enumerations in `src/` by `tools/types`. */\n";

/// Enumerations whose names are values of options.
const OPTION_VALUES: [&str; 4] = ["Energy", "Format", "LightTreatment", "Unit"];

fn main() -> ExitCode {
    let write = |(path, text)| fs::write(path, text).map_err(|error| error.to_string());
    match files().and_then(|files| files.into_iter().try_for_each(write)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

/// Paths and texts of the files, as the sources have them.
fn files() -> Result<[(PathBuf, String); 2], String> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let items = items::collect(root)?;
    let types = format!("{TYPES_HEAD}{}", types::declarations(&items)?);
    let names = format!("{NAMES_HEAD}{}", types::names(&items, &OPTION_VALUES)?);
    Ok([
        (root.join("pkg/result-types.d.ts"), types),
        (root.join("pkg/schema/names.js"), names),
    ])
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_files_are_those_of_the_sources() {
        for (path, text) in super::files().unwrap() {
            let written = std::fs::read_to_string(&path).unwrap_or_default();
            let remedy = "run `cargo run -p developable-types`";
            assert!(
                written == text,
                "{} is out of date: {remedy}",
                path.display()
            );
        }
    }
}
