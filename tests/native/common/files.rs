//! The files in `tests/data`, and what the scripts there wrote into them.

use std::path::PathBuf;

use developable::files::images::{Decoded, decode};

pub fn file(name: &str) -> Vec<u8> {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests", "data", name]
        .iter()
        .collect();
    std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

pub fn read(name: &str) -> Decoded {
    decode(&file(name), None).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The values that both scripts start from.
pub fn ramp() -> Vec<f64> {
    (0..12).map(|i| f64::from(i * 7 + 3)).collect()
}

/// The same as heights, one of which is missing.
pub fn holes() -> Vec<f64> {
    let mut holes: Vec<f64> = ramp().iter().map(|v| v / 8.0 - 2.0).collect();
    holes[6] = f64::NAN;
    holes
}

/// The names of files of every type, as NumPy writes it and as [`Decoded::data_type`] says it, and
/// their values.
pub fn of_every_type() -> impl Iterator<Item = (&'static str, &'static str, Vec<f64>)> {
    [
        ("u1", "u8"),
        ("i1", "i8"),
        ("u2", "u16"),
        ("i2", "i16"),
        ("u4", "u32"),
        ("i4", "i32"),
        ("u8", "u64"),
        ("i8", "i64"),
        ("f2", "f16"),
        ("f4", "f32"),
        ("f8", "f64"),
    ]
    .into_iter()
    .map(|(name, data_type)| {
        let values = match &name[..1] {
            "u" => ramp(),
            "i" => ramp().iter().map(|v| v - 50.0).collect(),
            _ => holes(),
        };
        (name, data_type, values)
    })
}

/// Reads an image of any format: as many heights as its size says, or one of the errors that a file can deserve.
pub fn check_decoded(bytes: &[u8]) -> Result<(), proptest::test_runner::TestCaseError> {
    use developable::files::images::{Decoded, decode};
    use proptest::prop_assert;
    match decode(bytes, None).and_then(Decoded::into_image) {
        Ok(image) => prop_assert!(image.values().len() == image.width() * image.height()),
        Err(error) => {
            let deserved = [
                "FORMAT",
                "UNSUPPORTED",
                "EMPTY",
                "NOT_FINITE",
                "TOO_LARGE",
                "SHAPE",
                "OPTION",
            ];
            prop_assert!(
                deserved.contains(&error.code()),
                "{} {}",
                error.code(),
                error
            );
        }
    }
    Ok(())
}
