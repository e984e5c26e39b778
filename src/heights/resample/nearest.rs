//! Resampling by the nearest pixel or vertex, for hard constraints and flags, which must not be interpolated.

use super::{Cell, ON_GRID_TOLERANCE, bilinear_weights, in_pixels, pixel_at};
use crate::error::{Result, check_shape, try_filled};
use crate::heights::heightfield::{HeightImage, Heightfield};
use crate::lattice::hexagonal::Lattice;

impl HeightImage {
    /// Transfers hard constraints from the pixels of this image to the vertices of a surface that have a height. Each
    /// pixel with a constraint constrains the vertex nearest to it, so that a point stays a point and a line a line; in
    /// an area of such pixels all vertices between them are constrained. The height is bilinear between those of the
    /// four pixels around the vertex that have one: a lone pixel's own, and along a line and within an area exact on a
    /// slope. On a lattice so coarse that none of these four has one, it is the mean of the pixels that constrain the
    /// vertex.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn constraints_on(&self, surface: &Heightfield) -> Result<Heightfield> {
        let lattice = surface.lattice();
        let within = |vertex: usize| !surface.heights()[vertex].is_nan();
        let mut claims = try_filled("constraints", lattice.len(), 0u32)?;
        let mut heights = try_filled("constraints", lattice.len(), 0.0)?;
        for (i, z) in self.values().iter().enumerate() {
            if !z.is_nan() {
                let p = self.position(i / self.width(), i % self.width());
                if let Some(vertex) = nearest_vertex(lattice, p, within) {
                    claims[vertex] += 1;
                    heights[vertex] += z;
                }
            }
        }
        for (vertex, z) in heights.iter_mut().enumerate() {
            let p = lattice.position(vertex / lattice.cols(), vertex % lattice.cols());
            let (mean, share) = mean(&Cell::around(self, p));
            *z = match claims[vertex] {
                0 if share > 1.0 - ON_GRID_TOLERANCE && within(vertex) => mean,
                0 => f64::NAN,
                number if share == 0.0 => *z / f64::from(number),
                _ => mean,
            };
        }
        Heightfield::new(*lattice, heights)
    }

    /// Transfers flags from the pixels to the vertices of a lattice: each vertex gets the flag of its nearest pixel.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) if there is not one for each pixel,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn flags_on(&self, lattice: &Lattice, flags: &[u8]) -> Result<Vec<u8>> {
        check_shape("occlusions", self.height(), self.width(), flags.len())?;
        let mut out = try_filled("flags", lattice.len(), 0)?;
        for (i, flag) in out.iter_mut().enumerate() {
            let p = lattice.position(i / lattice.cols(), i % lattice.cols());
            *flag = nearest_pixel(self, p).map_or(0, |i| flags[i]);
        }
        Ok(out)
    }

    /// Transfers flags from a lattice's vertices to the pixels: each pixel with a height gets the flag of its nearest
    /// vertex, the others 0.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) if there is not one for each vertex,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn flags_from(&self, lattice: &Lattice, flags: &[u8]) -> Result<Vec<u8>> {
        check_shape("occlusions", lattice.rows(), lattice.cols(), flags.len())?;
        let mut out = try_filled("flags", self.values().len(), 0)?;
        for (i, flag) in out.iter_mut().enumerate() {
            if !self.values()[i].is_nan() {
                let p = self.position(i / self.width(), i % self.width());
                *flag = nearest_vertex(lattice, p, |_| true).map_or(0, |i| flags[i]);
            }
        }
        Ok(out)
    }
}

/// Index of the pixel that contains a point; on the border of two pixels the right or lower one. None outside of the
/// image.
fn nearest_pixel(image: &HeightImage, p: [f64; 2]) -> Option<usize> {
    let [u, v] = in_pixels(image, p).map(|w| (w + 0.5 + ON_GRID_TOLERANCE).floor());
    pixel_at(image, v, u)
}

/// Index of the vertex nearest to a point, among the corners of the point's lattice triangle that satisfy `counts`.
fn nearest_vertex(lattice: &Lattice, p: [f64; 2], counts: impl Fn(usize) -> bool) -> Option<usize> {
    // In an equilateral triangle the nearest corner is the one of the largest weight.
    let triangle = lattice.locate(p);
    (triangle.vertices.into_iter().zip(triangle.weights))
        .filter(|((row, col), _)| lattice.contains(*row, *col))
        .map(|((row, col), weight)| (lattice.index(row as usize, col as usize), weight))
        .filter(|(vertex, _)| counts(*vertex))
        .max_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(vertex, _)| vertex)
}

/// Bilinear mean of those of the four pixels around a point that have a height, and the sum of their weights.
fn mean(cell: &Cell) -> (f64, f64) {
    let weights = bilinear_weights(cell.fx, cell.fy);
    let (sum, share) = (cell.corners.iter().zip(weights))
        .filter(|(z, _)| !z.is_nan())
        .fold((0.0, 0.0), |(sum, share), (z, w)| (sum + w * z, share + w));
    (sum / share, share)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blank(width: usize, height: usize) -> HeightImage {
        HeightImage::new(width, height, vec![f64::NAN; width * height]).unwrap()
    }

    fn with(image: &HeightImage, f: impl Fn(usize, usize) -> f64) -> HeightImage {
        let values = (0..image.values().len())
            .map(|i| f(i / image.width(), i % image.width()))
            .collect();
        HeightImage::new(image.width(), image.height(), values).unwrap()
    }

    /// A level surface over an image, and where its lattice's vertices are.
    fn vertices(image: &HeightImage, spacing: f64) -> (Heightfield, Vec<[f64; 2]>) {
        let level = with(image, |_, _| 0.0).to_lattice(Some(spacing)).unwrap();
        let lattice = level.lattice();
        let positions = (0..lattice.len())
            .map(|i| lattice.position(i / lattice.cols(), i % lattice.cols()))
            .collect();
        (level, positions)
    }

    fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
        (a[0] - b[0]).hypot(a[1] - b[1])
    }

    #[test]
    fn a_lone_pixel_constrains_one_vertex_with_its_own_height() {
        let image = blank(21, 19);
        for spacing in [4.0, 1.3, 1.0, 0.7, 0.31] {
            let (level, positions) = vertices(&image, spacing);
            for pixel in (0..399).step_by(7) {
                let lone = with(&image, |row, col| {
                    if row * 21 + col == pixel {
                        4.25
                    } else {
                        f64::NAN
                    }
                });
                let centre = lone.position(pixel / 21, pixel % 21);
                let found = lone.constraints_on(&level).unwrap();
                let met: Vec<_> = (0..positions.len())
                    .filter(|v| !found.heights()[*v].is_nan())
                    .collect();
                assert_eq!(met.len(), 1, "pixel {pixel} at spacing {spacing}");
                assert!((found.heights()[met[0]] - 4.25).abs() < 1e-12);
                let least = (positions.iter().zip(level.heights()))
                    .filter(|(_, z)| !z.is_nan())
                    .map(|(p, _)| distance(*p, centre))
                    .fold(f64::INFINITY, f64::min);
                assert!(distance(positions[met[0]], centre) < least + 1e-9);
            }
        }
    }

    #[test]
    fn a_slope_of_constraints_is_a_slope_along_a_line_and_over_an_area() {
        let image = blank(12, 11);
        let slope = |p: [f64; 2]| 0.4 * p[0] - 0.3 * p[1];
        let (level, positions) = vertices(&image, 1.0);
        let area = with(&image, |row, col| slope(image.position(row, col)));
        let found = area.constraints_on(&level).unwrap();
        for (i, p) in positions.iter().enumerate() {
            if !level.heights()[i].is_nan() {
                assert!((found.heights()[i] - slope(*p)).abs() < 1e-12);
            }
        }
        // One row of pixels: across it the height is the line's.
        let line = with(&image, |row, col| match row {
            5 => 0.4 * col as f64,
            _ => f64::NAN,
        });
        let found = line.constraints_on(&level).unwrap();
        let mut met = 0;
        for (i, [x, y]) in positions.iter().enumerate() {
            if !found.heights()[i].is_nan() {
                met += 1;
                assert!((y - 5.5).abs() < 0.51);
                assert!((found.heights()[i] - 0.4 * (x - 0.5)).abs() < 1e-12);
            }
        }
        assert_eq!(met, 12);
    }

    #[test]
    fn an_area_constrains_every_vertex_in_it() {
        let image = with(&blank(21, 19), |row, col| (row + col) as f64);
        for spacing in [4.0, 1.0, 0.4] {
            let (level, _) = vertices(&image, spacing);
            let found = image.constraints_on(&level).unwrap();
            for (z, surface) in found.heights().iter().zip(level.heights()) {
                assert_eq!(z.is_nan(), surface.is_nan());
            }
        }
    }

    #[test]
    fn flags_are_those_of_the_nearest() {
        let image = with(&blank(7, 6), |_, col| if col == 6 { f64::NAN } else { 1.0 });
        let (level, positions) = vertices(&image, 1.3);
        let lattice = *level.lattice();
        let flags: Vec<u8> = (0..42).map(|i| i as u8).collect();
        let found = image.flags_on(&lattice, &flags).unwrap();
        let pixels: Vec<_> = (0..42).map(|i| image.position(i / 7, i % 7)).collect();
        for (flag, p) in found.iter().zip(&positions) {
            let least = pixels.iter().map(|q| distance(*p, *q)).fold(9.0, f64::min);
            let inside = (-1e-9..7.0).contains(&p[0]) && (0.0..6.0).contains(&p[1]);
            let nearest = inside && distance(pixels[*flag as usize], *p) < least + 1e-8;
            assert!(nearest || (!inside && *flag == 0), "{flag} at {p:?}");
        }
        let flags: Vec<u8> = (0..lattice.len()).map(|i| i as u8 + 1).collect();
        let found = image.flags_from(&lattice, &flags).unwrap();
        for (flag, q) in found.iter().zip(&pixels) {
            let least = positions
                .iter()
                .map(|p| distance(*p, *q))
                .fold(9.0, f64::min);
            if q[0] > 6.0 {
                assert_eq!(*flag, 0, "no data at {q:?}");
            } else {
                assert!(distance(positions[*flag as usize - 1], *q) < least + 1e-8);
            }
        }
        assert_eq!(image.flags_on(&lattice, &[0]).unwrap_err().code(), "SHAPE");
        assert_eq!(
            image.flags_from(&lattice, &[0]).unwrap_err().code(),
            "SHAPE"
        );
    }
}
