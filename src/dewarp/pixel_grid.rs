//! Pixel grid of a flat image.

/// Pixel grid of a flat image: its size, resolution and corner on the sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PixelGrid {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Pixels per unit of length of the sheet.
    pub resolution: f64,
    /// Position of the upper left corner on the sheet, in its unit of length, with y upwards.
    pub corner: [f64; 2],
}

impl PixelGrid {
    /// The grid of the same resolution whose upper left pixel has the column and row `first` in this one.
    pub(crate) fn framed(&self, first: [isize; 2], [width, height]: [usize; 2]) -> Self {
        let [across, down] = first.map(|pixels| pixels as f64 / self.resolution);
        PixelGrid {
            width,
            height,
            corner: [self.corner[0] + across, self.corner[1] - down],
            ..*self
        }
    }
}
