//! Depths of a camera among images of numbers: how they are told from heights, and their unit.

use crate::files::number_type::NumberType;
use crate::files::{Assumption, Unit};

/// Whether the values of an image are depths of a camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum DepthEvidence {
    /// Nothing tells them from heights.
    None,
    /// Their range and their occlusions are those of depths.
    Likely,
    /// Besides, the name of the file says so, or pixels have no depth.
    Certain,
}

/// Smallest typical value from which on depths are millimetres: no camera sees as far in metres.
const MIN_MILLIMETRES: f64 = 100.0;

/// Depths of cameras, in metres.
const METRES: std::ops::RangeInclusive<f64> = 0.05..=60.0;

/// Depths of cameras, in millimetres.
const MILLIMETRES: std::ops::RangeInclusive<f64> = MIN_MILLIMETRES..=20_000.0;

/// Smallest value that stands for no depth: what is far away, or the largest number of 16 bits.
const MIN_FAR_DEPTH: f64 = 65_000.0;

/// Minimum share of the depths that lie within the range of cameras.
const MIN_SHARE_IN_RANGE: f64 = 0.98;

/// Minimum difference of neighbouring depths at an occlusion, as a share of the smaller depth.
const MIN_JUMP_SHARE: f64 = 0.15;

/// Minimum difference of neighbouring depths at an occlusion, in mean differences: a ramp that begins at 0 has no occlusion.
const MIN_JUMP_STEPS: f64 = 5.0;

/// Minimum number of occlusions, as a share of the image's shorter side: they lie along curves.
const MIN_JUMPS_PER_SIDE: f64 = 0.3;

/// Maximum share of the pairs of neighbours at an occlusion: noise is everywhere.
const MAX_JUMP_SHARE: f64 = 0.05;

/// Minimum share of pixels without a depth in an image from a camera.
const MIN_HOLE_SHARE: f64 = 0.002;

/// Words in the names of files that hold depths.
const DEPTH_WORDS: [&str; 5] = ["depth", "tiefe", "kinect", "lidar", "tof"];

/// Unit that values of the given type have if they are depths: integers are millimetres, floats metres unless they are as
/// large as only millimetres are. Costs `O(pixels)`.
pub(super) fn unit(values: &[f64], number_type: NumberType) -> Unit {
    let depths = || values.iter().filter(|depth| is_depth(**depth));
    let is_large =
        || 2 * depths().filter(|depth| **depth >= MIN_MILLIMETRES).count() > depths().count();
    match !number_type.is_float() || is_large() {
        true => Unit::Millimetre,
        false => Unit::Metre,
    }
}

/// Tells whether the values of an image, `width` in a row, are depths in a unit; `name` is that of the file. Depths lie within
/// the range of cameras, above zero, and have occlusions and holes. Costs `O(pixels)`.
pub(super) fn evidence(
    values: &[f64],
    width: usize,
    number_type: NumberType,
    unit: Unit,
    name: &str,
) -> DepthEvidence {
    let is_integer = matches!(
        number_type,
        NumberType::U16 | NumberType::I32 | NumberType::U32
    );
    let name = name.to_ascii_lowercase();
    let is_named = DEPTH_WORDS.iter().any(|word| name.contains(word));
    let count = values.iter().filter(|depth| is_depth(**depth)).count();
    let range = match unit {
        Unit::Metre => METRES,
        Unit::Millimetre => MILLIMETRES,
    };
    let in_range = values.iter().filter(|depth| range.contains(depth)).count();
    if !(is_integer || number_type.is_float())
        || count == 0
        || values.iter().any(|value| *value < 0.0)
        || (in_range as f64) < MIN_SHARE_IN_RANGE * count as f64
    {
        return DepthEvidence::None;
    }
    let has_holes = (values.len() - count) as f64 > MIN_HOLE_SHARE * values.len() as f64;
    let seen = has_occlusions(values, width) && (has_holes || !is_integer && unit == Unit::Metre);
    match (is_named || seen, is_named || has_holes) {
        (true, true) => DepthEvidence::Certain,
        (true, false) => DepthEvidence::Likely,
        (false, _) => DepthEvidence::None,
    }
}

/// Whether depths jump between neighbours along curves.
fn has_occlusions(values: &[f64], width: usize) -> bool {
    let pairs = || {
        let rows = values.chunks_exact(width);
        rows.flat_map(|row| row.windows(2))
            .filter(|pair| pair.iter().all(|depth| is_depth(*depth)))
    };
    let step = |pair: &[f64]| (pair[1] - pair[0]).abs();
    let count = pairs().count() as f64;
    let min_step = MIN_JUMP_STEPS * pairs().map(step).sum::<f64>() / count;
    let is_jump = |pair: &&[f64]| step(pair) > min_step.max(MIN_JUMP_SHARE * pair[0].min(pair[1]));
    let jumps = pairs().filter(is_jump).count() as f64;
    let shorter = width.min(values.len() / width) as f64;
    jumps > MIN_JUMPS_PER_SIDE * shorter && jumps < MAX_JUMP_SHARE * count
}

/// Replaces what is no depth by NaN: cameras store 0, or a very large value for what is far away. Returns what is assumed, if
/// there was any.
pub(super) fn without_missing(values: &mut [f64], unit: Unit) -> Option<Assumption> {
    let mut missing = 0;
    for value in values
        .iter_mut()
        .filter(|value| !value.is_nan() && !is_depth(**value))
    {
        *value = f64::NAN;
        missing += 1;
    }
    let words = format!(
        "the values look like depths of a camera in {}, and those of 0 or beyond {MIN_FAR_DEPTH} are none ({missing} pixels)",
        unit.symbol()
    );
    (missing > 0).then(|| Assumption::new("depths", words, "noData"))
}

/// Whether a value is a depth.
fn is_depth(value: f64) -> bool {
    value > 0.0 && value < MIN_FAR_DEPTH
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 160;

    fn told(number_type: NumberType, name: &str, value: impl Fn(f64, f64) -> f64) -> Option<Unit> {
        let at = |i: usize| value((i % WIDTH) as f64, (i / WIDTH) as f64);
        let values: Vec<f64> = (0..120 * WIDTH).map(at).collect();
        let unit = unit(&values, number_type);
        let evidence = evidence(&values, WIDTH, number_type, unit, name);
        (evidence != DepthEvidence::None).then_some(unit)
    }

    #[test]
    fn depths_are_told_from_heights_by_their_unit_and_their_edges() {
        // A disc before a wall, and what is beyond it.
        let scene = |metre: f64, beyond: f64| {
            move |col: f64, row: f64| match ((col - 80.0).hypot(row - 60.0) < 40.0, row < 20.0) {
                (true, _) => metre * (0.5 + 0.001 * col),
                (false, true) => beyond,
                (false, false) => metre * (1.6 + 0.002 * row),
            }
        };
        let [mm, m] = [Unit::Millimetre, Unit::Metre].map(Some);
        assert_eq!(told(NumberType::U16, "a.png", scene(1000.0, 0.0)), mm);
        assert_eq!(told(NumberType::F32, "a.exr", scene(1.0, 1e10)), m);
        let millimetres = scene(1000.0, 0.0);
        assert_eq!(told(NumberType::F32, "a_depth.exr", millimetres), mm);
        assert_eq!(told(NumberType::U8, "grey.png", scene(100.0, 0.0)), None);
        // A ramp from 0, terrain, and depths that only their name tells.
        let ramp = |col, row| 0.1 * col + 0.15 * row;
        assert_eq!(told(NumberType::F32, "a.npy", ramp), None);
        let hills =
            |x: f64, y: f64| 900.0 + 300.0 * (x / 17.0).sin() + 200.0 * (y / 13.0 + x / 31.0).cos();
        assert_eq!(told(NumberType::U16, "dem.tif", hills), None);
        let slope = |col, _| 800.0 + col;
        assert_eq!(told(NumberType::U16, "Depth.png", slope), mm);
        assert_eq!(told(NumberType::U16, "a.png", slope), None);
    }

    #[test]
    fn zeros_among_depths_are_none() {
        let mut depths = [0.0, 800.0, 65_535.0, f64::NAN, 900.0];
        let told = without_missing(&mut depths, Unit::Millimetre).unwrap();
        let words = told.words;
        assert!(
            words.contains("in mm") && words.contains("(2 pixels)"),
            "{words}"
        );
        assert_eq!(depths.map(f64::is_nan), [true, false, true, true, false]);
    }
}
