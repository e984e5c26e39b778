//! Colours of pictures as sRGB bytes; the web page uses the same ones.

/// Colour of points without a value, such as a curvature next to a border: grey.
pub(super) const NO_VALUE: [u8; 3] = [150, 155, 160];

/// Colour scale for curvature, from the lowest to the highest value: blue over white to red. ColorBrewer's RdBu, whose
/// ends are also told apart by the colour-blind.
const CURVATURE_COLOURS: [[f64; 3]; 11] = [
    [5.0, 48.0, 97.0],
    [33.0, 102.0, 172.0],
    [67.0, 147.0, 195.0],
    [146.0, 197.0, 222.0],
    [209.0, 229.0, 240.0],
    [247.0, 247.0, 247.0],
    [253.0, 219.0, 199.0],
    [244.0, 165.0, 130.0],
    [214.0, 96.0, 77.0],
    [178.0, 24.0, 43.0],
    [103.0, 0.0, 31.0],
];

/// Colours of patches, told apart by hue and lightness; patch numbers above 11 begin again with the first.
const PATCH_COLOURS: [[u8; 3]; 12] = [
    [86, 148, 206],
    [240, 160, 75],
    [107, 178, 106],
    [214, 108, 120],
    [160, 134, 204],
    [222, 200, 88],
    [92, 184, 184],
    [198, 122, 176],
    [164, 140, 110],
    [140, 196, 240],
    [246, 190, 170],
    [172, 210, 130],
];

/// Brightness of a crease's pixels relative to the colour of their patch.
const CREASE_BRIGHTNESS: f64 = 0.4;

/// Diverging colour scale: returns the colour of a value, which is clamped to the range from −1 (blue) to 1 (red).
pub(super) fn diverging(value: f64) -> [u8; 3] {
    let last = CURVATURE_COLOURS.len() - 1;
    let place = 0.5 * (value.clamp(-1.0, 1.0) + 1.0) * last as f64;
    let from = (place as usize).min(last - 1);
    let share = place - from as f64;
    std::array::from_fn(|k| {
        let [low, high] = [CURVATURE_COLOURS[from][k], CURVATURE_COLOURS[from + 1][k]];
        (low + share * (high - low)).round() as u8
    })
}

/// Colour of a shaded surface by its brightness `tone`, from 0 to 1: bluish where dark, white where bright.
pub(super) fn steel(tone: f64) -> [u8; 3] {
    let tint = 0.1 * (1.0 - tone);
    [1.0 - tint, 1.0, 1.0 + 1.3 * tint].map(|share| (255.0 * tone * share).round() as u8)
}

pub(crate) fn patch(label: u32) -> [u8; 3] {
    PATCH_COLOURS[label as usize % PATCH_COLOURS.len()]
}

/// Colour of the patch with number `label` along its creases.
pub(super) fn crease(label: u32) -> [u8; 3] {
    patch(label).map(|channel| (CREASE_BRIGHTNESS * f64::from(channel)).round() as u8)
}
