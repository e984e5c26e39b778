//! The committed fixtures are what the library gives now. If a change is meant
//! to change them: `cargo run --release --example fixtures`.

use crate::native::check;

// Tighter than for wasm: it is the same compiler's arithmetic.
check::fixture_tests!(test, 1e-12);

#[test]
fn every_file_is_checked() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures");
    let mut found: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    found.sort();
    let mut expected = NAMES.to_vec();
    expected.sort();
    assert_eq!(found, expected);
}
