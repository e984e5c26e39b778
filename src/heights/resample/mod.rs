//! Resampling between square pixels and the hexagonal lattice, without pixels or vertices that have no data.

mod nearest;

use std::collections::VecDeque;

use super::heightfield::{HeightImage, Heightfield};
use crate::error::{Result, try_filled};
use crate::lattice::hexagonal::{Lattice, Located};

/// Distance from a row or column of pixels or vertices, in grid steps, below which a point lies on it: far above
/// rounding errors, far below anything visible.
const ON_GRID_TOLERANCE: f64 = 1e-9;

/// Maximum distance beyond the lattice's outermost vertices at which heights are extrapolated, in units of the larger
/// of lattice spacing and pixel size.
const MAX_EXTRAPOLATION_STEPS: f64 = 3.0;

/// Marks a pixel to which the plane fitted around a lattice vertex has not been extended.
const NO_SOURCE: u32 = u32::MAX;

/// Marks a pixel that lies within a lattice triangle, so that its height is interpolated.
const PIXEL_IN_TRIANGLE: u32 = u32::MAX - 1;

impl HeightImage {
    /// Samples the image at the vertices of a lattice of the given spacing
    /// (`None`: the pixel size), whose vertex `(0, 0)` is the centre of the
    /// top left pixel.
    ///
    /// Between four pixels with data the surface is bilinear. Between three it
    /// is their plane, within their triangle. On the line between two, and on
    /// a single pixel, it is the line's or pixel's own height. Everywhere else,
    /// so also beyond the outermost pixel centres, the vertex has no height.
    /// Pixels without data therefore never change a height, and a linear ramp
    /// comes through exactly. Nothing is smoothed: on a spacing coarser than
    /// the pixels the image is sampled, not averaged.
    ///
    /// Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless the spacing is positive and finite,
    /// [`Error::TooLarge`](crate::Error::TooLarge) if the lattice would exceed
    /// [`MAX_CELLS`](crate::MAX_CELLS).
    pub fn to_lattice(&self, spacing: Option<f64>) -> Result<Heightfield> {
        let lattice = Lattice::covering(
            self.position(self.height() - 1, 0),
            self.position(0, self.width() - 1),
            spacing.unwrap_or(self.pixel_size()),
        )?;
        self.sampled_on(&lattice)
    }

    /// Samples the image at the vertices of a given lattice, by the rules of [`HeightImage::to_lattice`]. For a further
    /// image of the same scene, such as one of confidences.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn sampled_on(&self, lattice: &Lattice) -> Result<Heightfield> {
        let mut heights = try_filled("lattice heights", lattice.len(), f64::NAN)?;
        for (row, heights) in heights.chunks_mut(lattice.cols()).enumerate() {
            for (col, z) in heights.iter_mut().enumerate() {
                *z = sample(&Cell::around(self, lattice.position(row, col)));
            }
        }
        Heightfield::new(*lattice, heights)
    }
}

impl Heightfield {
    /// Samples the surface at the pixels of the image `like`: a height wherever `like` has one, NaN elsewhere.
    ///
    /// Within a lattice triangle with three heights the surface is linear.
    /// Pixels beyond (the lattice of an image ends up to one cell before its
    /// border and its holes) continue the plane fitted around the nearest
    /// vertex that can be reached through pixels with data, at most three
    /// spacings (or pixels, if these are larger) away. A pixel that no plane
    /// reaches, such as one of an island too small to hold a vertex, keeps the
    /// value it has in `like`: rather the input's height than none.
    /// A linear ramp comes through exactly.
    ///
    /// Costs `O(pixels + vertices)`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory) if the image cannot be allocated.
    pub fn to_image(&self, like: &HeightImage) -> Result<HeightImage> {
        let (width, pixels) = (like.width(), like.values().len());
        let reach = MAX_EXTRAPOLATION_STEPS * self.lattice().spacing().max(like.pixel_size());
        let mut values = try_filled("height image", pixels, f64::NAN)?;
        let mut sources = try_filled("height image", pixels, NO_SOURCE)?;
        let triangle_of = |i: usize| self.triangle_at(like.position(i / width, i % width));
        let mut missing = Vec::new();
        for row in 0..like.height() {
            for (col, i) in (row * width..(row + 1) * width).enumerate() {
                if like.values()[i].is_nan() {
                    continue;
                }
                let triangle = self.triangle_at(like.position(row, col));
                values[i] = triangle.map_or(f64::NAN, |triangle| self.linear(&triangle));
                if values[i].is_finite() {
                    sources[i] = PIXEL_IN_TRIANGLE;
                } else {
                    missing.push(i);
                }
            }
        }

        // The search starts at pixels next to one without a height, which are few: those at the lattice's border.
        let beside = |i: &usize| neighbours(like, *i).filter(|k| sources[*k] == PIXEL_IN_TRIANGLE);
        let mut border: Vec<usize> = missing.iter().flat_map(beside).collect();
        border.sort_unstable();
        border.dedup();
        for i in &border {
            sources[*i] = triangle_of(*i).map_or(NO_SOURCE, |triangle| self.heaviest(&triangle));
        }
        let mut queue = VecDeque::from(border);

        // Breadth first into the pixels without a height yet, each taking over its predecessor's
        // vertex: never across a gap in `like`, and every pixel is visited once.
        while let Some(i) = queue.pop_front() {
            for k in neighbours(like, i) {
                if sources[k] != NO_SOURCE || like.values()[k].is_nan() {
                    continue;
                }
                let p = like.position(k / width, k % width);
                if let Some(z) = self.continued(sources[i], p, reach) {
                    values[k] = z;
                    sources[k] = sources[i];
                    queue.push_back(k);
                }
            }
        }

        for i in missing.into_iter().filter(|i| sources[*i] == NO_SOURCE) {
            // No path leads to a triangle with three heights; a corner of the pixel's own triangle may still have a
            // plane.
            let p = like.position(i / width, i % width);
            values[i] = triangle_of(i)
                .and_then(|t| self.continued(self.heaviest(&t), p, reach))
                .unwrap_or(like.values()[i]);
        }
        HeightImage::new(width, like.height(), values)?.with_pixel_size(like.pixel_size())
    }

    /// Finds the lattice triangle around the point `p`; `None` if `p` is more than a cell outside of the lattice.
    fn triangle_at(&self, p: [f64; 2]) -> Option<Located> {
        let lattice = self.lattice();
        let ([x0, y0], h) = (lattice.origin(), lattice.spacing());
        // Keeps the vertices' indices within a cell of the lattice, whatever the positions.
        let col = (p[0] - x0) / h;
        let row = (y0 - p[1]) / lattice.row_spacing();
        let near = (-1.0..=lattice.cols() as f64).contains(&col)
            && (-1.0..=lattice.rows() as f64).contains(&row);
        near.then(|| lattice.locate(p))
    }

    /// Height of a vertex in a row and column; NaN outside of the lattice.
    fn height_or_nan(&self, (row, col): (isize, isize)) -> f64 {
        if self.lattice().contains(row, col) {
            self.height(row as usize, col as usize)
        } else {
            f64::NAN
        }
    }

    /// Interpolates the height linearly in a triangle; NaN if a vertex with a weight has no height.
    fn linear(&self, triangle: &Located) -> f64 {
        let corners = triangle.vertices.map(|v| self.height_or_nan(v));
        if corners.iter().all(|z| z.is_finite()) {
            (corners.iter().zip(triangle.weights))
                .map(|(z, w)| w * z)
                .sum()
        } else {
            let weights = triangle.weights.map(snap);
            (corners.iter().zip(weights))
                .filter(|(_, w)| *w != 0.0)
                .map(|(z, w)| w * z)
                .sum()
        }
    }

    /// Index of the triangle's vertex with the largest weight, that is the nearest to the point, among those with a
    /// height.
    fn heaviest(&self, triangle: &Located) -> u32 {
        (triangle.vertices.into_iter().zip(triangle.weights))
            .filter(|(v, _)| self.height_or_nan(*v).is_finite())
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map_or(NO_SOURCE, |((row, col), _)| {
                self.lattice().index(row as usize, col as usize) as u32
            })
    }

    /// Height at the point `p` of the plane fitted around a vertex; `None` if `p` is further than `reach` from it, or
    /// there is no plane.
    fn continued(&self, vertex: u32, p: [f64; 2], reach: f64) -> Option<f64> {
        if vertex == NO_SOURCE {
            return None;
        }
        let cols = self.lattice().cols();
        let (row, col) = (vertex as usize / cols, vertex as usize % cols);
        let [x, y] = self.lattice().position(row, col);
        let (dx, dy) = (p[0] - x, p[1] - y);
        if dx.hypot(dy) > reach {
            return None;
        }
        let [gx, gy] = self.gradient(row, col)?;
        let z = self.height(row, col) + gx * dx + gy * dy;
        z.is_finite().then_some(z)
    }

    /// Slope `[∂z/∂x, ∂z/∂y]` of the least-squares plane through a vertex and near its neighbours with heights; `None`
    /// where these lie on one line.
    pub(crate) fn gradient(&self, row: usize, col: usize) -> Option<[f64; 2]> {
        let lattice = self.lattice();
        let ([x, y], h) = (lattice.position(row, col), lattice.spacing());
        let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (r, c) in lattice.neighbours(row, col).into_iter().flatten() {
            let dz = self.height(r, c) - self.height(row, col);
            if dz.is_nan() {
                continue;
            }
            let [nx, ny] = lattice.position(r, c);
            let (dx, dy) = ((nx - x) / h, (ny - y) / h);
            xx += dx * dx;
            xy += dx * dy;
            yy += dy * dy;
            xz += dx * dz;
            yz += dy * dz;
        }
        // Unit vectors at multiples of 60°: the determinant is 0 on a line, else at least 3/4.
        let determinant = xx * yy - xy * xy;
        (determinant > 0.5).then(|| {
            let gx = (yy * xz - xy * yz) / determinant;
            let gy = (xx * yz - xy * xz) / determinant;
            [gx / h, gy / h]
        })
    }
}

/// The four pixels around a point, between which heights are interpolated.
struct Cell {
    /// Heights of the four pixels, NaN outside of the image. Pixel `k` lies to the right if bit 0 of `k` is set, and
    /// below if bit 1 is.
    corners: [f64; 4],
    /// Position of the point, from 0 to 1 to the right of the upper left pixel's centre; `fy` is that below it.
    fx: f64,
    fy: f64,
}

impl Cell {
    fn around(image: &HeightImage, p: [f64; 2]) -> Self {
        let [u, v] = in_pixels(image, p);
        let (left, top) = (u.floor(), v.floor());
        let corners = std::array::from_fn(|k| {
            pixel_at(image, top + (k >> 1) as f64, left + (k & 1) as f64)
                .map_or(f64::NAN, |i| image.values()[i])
        });
        Cell {
            corners,
            fx: u - left,
            fy: v - top,
        }
    }
}

/// Converts a point to pixels, to the right of and below the centre of the first pixel.
fn in_pixels(image: &HeightImage, [x, y]: [f64; 2]) -> [f64; 2] {
    [
        x / image.pixel_size() - 0.5,
        image.height() as f64 - 0.5 - y / image.pixel_size(),
    ]
}

/// Index of the pixel in a row and column, which are whole numbers; `None` outside of the image.
fn pixel_at(image: &HeightImage, row: f64, col: f64) -> Option<usize> {
    let inside =
        (0.0..image.height() as f64).contains(&row) && (0.0..image.width() as f64).contains(&col);
    inside.then(|| row as usize * image.width() + col as usize)
}

fn bilinear_weights(fx: f64, fy: f64) -> [f64; 4] {
    [
        (1.0 - fx) * (1.0 - fy),
        fx * (1.0 - fy),
        (1.0 - fx) * fy,
        fx * fy,
    ]
}

/// Interpolates the height between four pixels, by the rules of [`HeightImage::to_lattice`]; NaN where there is none.
fn sample(&Cell { corners, fx, fy }: &Cell) -> f64 {
    let bilinear = |fx: f64, fy: f64| -> f64 {
        (corners.iter().zip(bilinear_weights(fx, fy)))
            .filter(|(_, w)| *w != 0.0)
            .map(|(z, w)| w * z)
            .sum()
    };
    let mut missing = (0..4).filter(|k| corners[*k].is_nan());
    match (missing.next(), missing.next()) {
        (None, _) => return bilinear(fx, fy),
        (Some(k), None) => {
            // Distances from the corner opposite the missing one, the triangle's right angle.
            let dx = if k & 1 == 1 { fx } else { 1.0 - fx };
            let dy = if k & 2 == 2 { fy } else { 1.0 - fy };
            let rest = 1.0 - dx - dy;
            if rest >= -ON_GRID_TOLERANCE {
                return rest * corners[k ^ 3] + dx * corners[k ^ 2] + dy * corners[k ^ 1];
            }
        }
        _ => {}
    }
    // On a line between two pixels or on a pixel the others do not count; elsewhere NaN results.
    bilinear(snap(fx), snap(fy))
}

/// Rounds an interpolation weight to 0 or 1 if it differs from that by rounding errors only.
fn snap(weight: f64) -> f64 {
    if weight.abs() < ON_GRID_TOLERANCE {
        0.0
    } else if (1.0 - weight).abs() < ON_GRID_TOLERANCE {
        1.0
    } else {
        weight
    }
}

/// Indices of the up to eight pixels around pixel `i` of an image.
fn neighbours(image: &HeightImage, i: usize) -> impl Iterator<Item = usize> {
    let (width, height) = (image.width(), image.height());
    let (row, col) = (i / width, i % width);
    let rows = row.saturating_sub(1)..=(row + 1).min(height - 1);
    rows.flat_map(move |r| {
        let cols = col.saturating_sub(1)..=(col + 1).min(width - 1);
        cols.map(move |c| r * width + c)
    })
    .filter(move |k| *k != i)
}
