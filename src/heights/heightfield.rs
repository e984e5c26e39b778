//! Heights: on the hexagonal lattice, and on the square pixels of an image.

use crate::error::{Error, Result, check_shape, positive};
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::Lattice;

/// Heights at the vertices of a [`Lattice`], in the lattice's own units.
///
/// NaN means that a vertex has no height: a hole, or outside of the shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Heightfield {
    lattice: Lattice,
    heights: Vec<f64>,
}

impl Heightfield {
    /// Makes a heightfield from the heights of a lattice's vertices, row by row.
    ///
    /// # Errors
    /// [`Error::Shape`] if their number is not `lattice.len()`,
    /// [`Error::NotFinite`] if one is infinite (NaN is no data).
    pub fn new(lattice: Lattice, heights: Vec<f64>) -> Result<Self> {
        check_values("heightfield", lattice.rows(), lattice.cols(), &heights)?;
        Ok(Heightfield { lattice, heights })
    }

    /// Makes a heightfield from a function of the vertex position `(x, y)`.
    ///
    /// # Errors
    /// As [`Heightfield::new`].
    pub fn from_fn(lattice: Lattice, f: impl Fn(f64, f64) -> f64) -> Result<Self> {
        let heights = (0..lattice.rows())
            .flat_map(|row| (0..lattice.cols()).map(move |col| (row, col)))
            .map(|(row, col)| {
                let [x, y] = lattice.position(row, col);
                f(x, y)
            })
            .collect();
        Heightfield::new(lattice, heights)
    }

    /// Returns the heightfield with NaN at the vertices where `keep` is 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if `keep` is not one value for each vertex.
    pub fn masked(mut self, keep: &[u8]) -> Result<Self> {
        apply_mask(
            self.lattice.rows(),
            self.lattice.cols(),
            &mut self.heights,
            keep,
        )?;
        Ok(self)
    }

    /// The lattice whose vertices have the heights.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Heights of the vertices, row by row; NaN where there is none.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Returns the heights of the vertices, row by row; NaN where there is none.
    pub fn into_heights(self) -> Vec<f64> {
        self.heights
    }

    /// Height of the vertex in a row and column of the lattice; NaN if it has none.
    ///
    /// # Panics
    /// If the lattice has no such vertex.
    pub fn height(&self, row: usize, col: usize) -> f64 {
        let (rows, cols) = (self.lattice.rows(), self.lattice.cols());
        assert!(
            row < rows && col < cols,
            "no vertex at row {row}, column {col} of a lattice of {rows} rows by {cols} columns"
        );
        self.heights[self.lattice.index(row, col)]
    }
}

/// Heights at the centres of square pixels, row 0 at the top.
///
/// The image covers the box from `(0, 0)` to `(width, height) · pixel_size`,
/// with `x` to the right and `y` up: the centre of pixel `(row, col)` lies at
/// `((col + ½), (height − row − ½)) · pixel_size`. NaN means no data.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightImage {
    width: usize,
    height: usize,
    pixel_size: f64,
    values: Vec<f64>,
    /// Whether its rows, and its columns, had offsets, of which a part was taken out.
    offset_lines: [bool; 2],
}

impl HeightImage {
    /// Makes an image with pixels of size 1 from its heights, row by row from the top.
    ///
    /// # Errors
    /// [`Error::Empty`], [`Error::TooLarge`], [`Error::Shape`] if there are not
    /// `width · height` values, [`Error::NotFinite`] if one is infinite.
    pub fn new(width: usize, height: usize, values: Vec<f64>) -> Result<Self> {
        if width == 0 || height == 0 {
            return Err(Error::Empty {
                what: "height image",
            });
        }
        check_values("height image", height, width, &values)?;
        Ok(HeightImage {
            width,
            height,
            pixel_size: 1.0,
            values,
            offset_lines: [false; 2],
        })
    }

    /// Makes an image with pixels of size 1 from rows of heights, top row first.
    ///
    /// # Errors
    /// As [`HeightImage::new`]; [`Error::Shape`] also when the rows differ in length.
    pub fn from_rows<R: AsRef<[f64]>>(rows: &[R]) -> Result<Self> {
        let width = rows.first().map_or(0, |row| row.as_ref().len());
        let values: Vec<f64> = rows.iter().flat_map(|r| r.as_ref()).copied().collect();
        if rows.iter().any(|row| row.as_ref().len() != width) {
            return Err(Error::Shape {
                what: "height image",
                rows: rows.len(),
                cols: width,
                expected: rows.len() * width,
                found: values.len(),
            });
        }
        HeightImage::new(width, rows.len(), values)
    }

    /// Returns the image with another side length of its pixels, in units of height.
    ///
    /// # Errors
    /// [`Error::Option`] unless it is positive and finite.
    pub fn with_pixel_size(self, pixel_size: f64) -> Result<Self> {
        Ok(HeightImage {
            pixel_size: positive("pixel_size", pixel_size)?,
            ..self
        })
    }

    /// Returns the image with all heights multiplied by `scale`: converts grey levels to units of height.
    ///
    /// # Errors
    /// [`Error::Option`] if `scale` is 0, is not finite or makes a value infinite.
    pub fn scaled(mut self, scale: f64) -> Result<Self> {
        let sound = scale.is_finite() && scale != 0.0 && {
            self.values.iter_mut().for_each(|v| *v *= scale);
            self.values.iter().all(|v| !v.is_infinite())
        };
        if sound {
            Ok(self)
        } else {
            Err(Error::option(
                "height_scale",
                scale,
                "must be finite and not 0, and leave every height finite",
            ))
        }
    }

    /// Returns the image with NaN at the pixels where `keep` is 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if `keep` is not one value for each pixel.
    pub fn masked(mut self, keep: &[u8]) -> Result<Self> {
        apply_mask(self.height, self.width, &mut self.values, keep)?;
        Ok(self)
    }

    /// Returns the image with NaN at the pixels whose value is `no_data`.
    pub fn without(mut self, no_data: f64) -> Self {
        for v in &mut self.values {
            if *v == no_data {
                *v = f64::NAN;
            }
        }
        self
    }

    /// Number of columns of the image.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows of the image.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Returns an image of the same pixels with other values, of which NaN are missing.
    ///
    /// # Errors
    /// As [`HeightImage::new`].
    pub(super) fn with_values(&self, values: Vec<f64>) -> Result<Self> {
        let image = HeightImage::new(self.width, self.height, values)?;
        Ok(HeightImage {
            values: image.values,
            ..*self
        })
    }

    /// Tells whether its rows, and its columns, had offsets, of which a part was taken out.
    pub(super) fn offset_lines(&self) -> [bool; 2] {
        self.offset_lines
    }

    /// Returns the image marked as one whose rows, and whose columns, had offsets, of which a part was taken out.
    pub(super) fn with_offset_lines(self, offset_lines: [bool; 2]) -> Self {
        HeightImage {
            offset_lines,
            ..self
        }
    }

    /// Side length of a pixel, in units of height.
    pub fn pixel_size(&self) -> f64 {
        self.pixel_size
    }

    /// Heights of the pixels, row by row from the top; NaN where there is none.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Root mean square difference to the heights of another image of the same size, over the pixels that have both.
    pub fn distance(&self, other: &HeightImage) -> f64 {
        let differences = self.values.iter().zip(&other.values).map(|(a, b)| a - b);
        let (squares, count) = differences
            .filter(|difference| difference.is_finite())
            .fold((0.0, 0.0), |(squares, count), d| {
                (squares + d * d, count + 1.0)
            });
        f64::sqrt(squares / f64::max(count, 1.0))
    }

    /// Returns the heights of the pixels, row by row from the top; NaN where there is none.
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// Position `[x, y]` of the centre of a pixel; x runs to the right and y up from the image's lower left corner.
    pub fn position(&self, row: usize, col: usize) -> [f64; 2] {
        [
            (col as f64 + 0.5) * self.pixel_size,
            (self.height as f64 - row as f64 - 0.5) * self.pixel_size,
        ]
    }
}

fn check_values(what: &'static str, rows: usize, cols: usize, values: &[f64]) -> Result<()> {
    check_shape(what, rows, cols, values.len())?;
    match values.iter().position(|v| v.is_infinite()) {
        None => Ok(()),
        Some(i) => Err(Error::NotFinite {
            what,
            value: values[i],
            row: i / cols,
            col: i % cols,
            advice: "mark it as no data with NaN, or repair it",
        }),
    }
}

fn apply_mask(rows: usize, cols: usize, values: &mut [f64], keep: &[u8]) -> Result<()> {
    check_shape("mask", rows, cols, keep.len())?;
    for (v, k) in values.iter_mut().zip(keep) {
        if *k == 0 {
            *v = f64::NAN;
        }
    }
    Ok(())
}

impl Domain {
    /// Makes the domain of a solve from a heightfield: a vertex is valid where its height is not NaN.
    ///
    /// # Errors
    /// [`Error::NoInterior`] if no vertex has all six neighbours valid.
    pub fn new(field: &Heightfield) -> Result<Self> {
        Domain::with_occlusions(field, |_| false)
    }

    /// Makes the domain of a solve from a heightfield; `occluded` tells for a vertex's index whether no Hessian is
    /// taken there.
    pub(crate) fn with_occlusions(
        field: &Heightfield,
        occluded: impl Fn(usize) -> bool,
    ) -> Result<Self> {
        let heights = field.heights();
        Domain::from_validity(
            *field.lattice(),
            |vertex| !heights[vertex].is_nan(),
            occluded,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixel_centres_run_down_and_right() {
        let image = HeightImage::new(3, 2, vec![0.0; 6])
            .unwrap()
            .with_pixel_size(2.0)
            .unwrap();
        assert_eq!(image.position(0, 0), [1.0, 3.0]);
        assert_eq!(image.position(1, 2), [5.0, 1.0]);
    }

    #[test]
    #[should_panic(expected = "no vertex at row 0, column 3 of a lattice of 2 rows by 3 columns")]
    fn a_column_past_the_end_is_no_vertex_of_the_next_row() {
        let lattice = Lattice::new(2, 3, 1.0).unwrap();
        let field = Heightfield::new(lattice, vec![0.0; 6]).unwrap();
        let _ = field.height(0, 3);
    }

    #[test]
    fn bad_shapes_and_values_are_named() {
        let code = |r: Result<HeightImage>| r.unwrap_err().code();
        assert_eq!(code(HeightImage::new(0, 2, vec![])), "EMPTY");
        assert_eq!(code(HeightImage::new(2, 2, vec![0.0; 3])), "SHAPE");
        assert_eq!(
            code(HeightImage::from_rows(&[vec![0.0, 1.0], vec![0.0]])),
            "SHAPE"
        );
        assert_eq!(code(HeightImage::from_rows::<Vec<f64>>(&[])), "EMPTY");
        let error = HeightImage::new(2, 2, vec![0.0, 1.0, f64::INFINITY, f64::NAN]).unwrap_err();
        assert_eq!(error.code(), "NOT_FINITE");
        assert!(error.to_string().contains("row 1, column 0"), "{error}");
        let image = HeightImage::new(1, 1, vec![2.0]).unwrap();
        assert_eq!(code(image.clone().scaled(f64::NAN)), "OPTION");
        assert_eq!(code(image.clone().with_pixel_size(-1.0)), "OPTION");
        assert_eq!(code(image.masked(&[1, 1])), "SHAPE");
    }

    #[test]
    fn mask_and_no_data_become_nan() {
        let image = HeightImage::new(2, 2, vec![0.0, 1.0, 2.0, 3.0]).unwrap();
        let image = image.masked(&[1, 1, 1, 0]).unwrap().without(0.0);
        let valid: Vec<_> = image.values().iter().map(|v| v.is_finite()).collect();
        assert_eq!(valid, [false, true, true, false]);
    }
}
