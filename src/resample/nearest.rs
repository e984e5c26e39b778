//! What must not be spread: hard constraints and flags belong to the pixel, or
//! the vertex, that is nearest.

use std::collections::BTreeMap;

use super::{Cell, ON_GRID, bilinear_weights, in_pixels, pixel_at};
use crate::error::{Error, Result, try_filled};
use crate::heightfield::{HeightImage, Heightfield};
use crate::lattice::Lattice;

impl HeightImage {
    /// Hard constraints at the vertices of a surface, which are those with a
    /// height: a vertex has one if the pixel nearest to it has one, so that a
    /// point stays a point and a line a line. Its height is bilinear between
    /// those of the four pixels around it that have one: a single pixel's own
    /// height, along a line of pixels the line's, within an area the area's.
    ///
    /// A pixel that is nearest to no vertex, as there are many where the lattice
    /// is coarser than the image, constrains the vertex nearest to it; several
    /// of them by their mean.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn constraints_on(&self, surface: &Heightfield) -> Result<Heightfield> {
        let lattice = surface.lattice();
        let mut heights = try_filled("constraints", lattice.len(), f64::NAN)?;
        let mut met = try_filled("constraints", self.values().len(), false)?;
        for (vertex, z) in heights.iter_mut().enumerate() {
            let p = lattice.position(vertex / lattice.cols(), vertex % lattice.cols());
            let pixel = nearest_pixel(self, p).filter(|i| !self.values()[*i].is_nan());
            if let Some(pixel) = pixel.filter(|_| !surface.heights()[vertex].is_nan()) {
                *z = mean(&Cell::around(self, p));
                met[pixel] = true;
            }
        }
        // Sum and number for each vertex that has none yet.
        let mut missed: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
        for (pixel, z) in self.values().iter().enumerate() {
            if z.is_nan() || met[pixel] {
                continue;
            }
            let p = self.position(pixel / self.width(), pixel % self.width());
            let vertex = nearest_vertex(lattice, p, |v| !surface.heights()[v].is_nan());
            if let Some(vertex) = vertex.filter(|v| heights[*v].is_nan()) {
                let (sum, number) = missed.entry(vertex).or_default();
                *sum += z;
                *number += 1.0;
            }
        }
        for (vertex, (sum, number)) in missed {
            heights[vertex] = sum / number;
        }
        Heightfield::new(*lattice, heights)
    }

    /// Flags of the pixels, at the vertices of a lattice: each has its nearest pixel's.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each pixel, [`Error::OutOfMemory`].
    pub fn flags_on(&self, lattice: &Lattice, flags: &[u8]) -> Result<Vec<u8>> {
        check_flags(self.height(), self.width(), flags)?;
        let mut out = try_filled("flags", lattice.len(), 0)?;
        for (i, flag) in out.iter_mut().enumerate() {
            let p = lattice.position(i / lattice.cols(), i % lattice.cols());
            *flag = nearest_pixel(self, p).map_or(0, |i| flags[i]);
        }
        Ok(out)
    }

    /// Flags of a lattice's vertices, at the pixels: each pixel with a height
    /// has its nearest vertex's, the others 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each vertex, [`Error::OutOfMemory`].
    pub fn flags_from(&self, lattice: &Lattice, flags: &[u8]) -> Result<Vec<u8>> {
        check_flags(lattice.rows(), lattice.cols(), flags)?;
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

/// Index of the pixel around a point; on the border of two the right or lower one's.
fn nearest_pixel(image: &HeightImage, p: [f64; 2]) -> Option<usize> {
    let [u, v] = in_pixels(image, p).map(|w| (w + 0.5 + ON_GRID).floor());
    pixel_at(image, v, u)
}

/// Index of the vertex nearest to a point among the corners of its triangle that count.
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

/// The bilinear mean of the corners that have a height.
fn mean(cell: &Cell) -> f64 {
    let weights = bilinear_weights(cell.fx, cell.fy);
    let (sum, total) = (cell.corners.iter().zip(weights))
        .filter(|(z, _)| !z.is_nan())
        .fold((0.0, 0.0), |(sum, total), (z, w)| (sum + w * z, total + w));
    sum / total
}

fn check_flags(rows: usize, cols: usize, flags: &[u8]) -> Result<()> {
    if flags.len() == rows * cols {
        return Ok(());
    }
    Err(Error::Shape {
        what: "occlusions",
        rows,
        cols,
        expected: rows * cols,
        found: flags.len(),
    })
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
    fn each_constrained_pixel_is_met_and_a_lone_one_keeps_its_height() {
        let image = blank(9, 8);
        for spacing in [1.0, 0.7, 0.31] {
            let (level, positions) = vertices(&image, spacing);
            for pixel in 0..72 {
                let lone = with(&image, |row, col| {
                    if row * 9 + col == pixel {
                        4.25
                    } else {
                        f64::NAN
                    }
                });
                let centre = lone.position(pixel / 9, pixel % 9);
                let found = lone.constraints_on(&level).unwrap();
                let met: Vec<_> = (found.heights().iter().zip(&positions))
                    .filter(|(z, _)| !z.is_nan())
                    .collect();
                assert!(!met.is_empty(), "pixel {pixel} at spacing {spacing}");
                for (z, p) in met {
                    assert_eq!(*z, 4.25);
                    assert!(distance(*p, centre) < 0.5f64.sqrt() + 1e-8);
                }
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
            let on_line = (y - 5.5).abs() < 0.5 && (0.5..11.5).contains(x);
            if on_line {
                met += 1;
                assert!((found.heights()[i] - 0.4 * (x - 0.5)).abs() < 1e-12);
            }
        }
        assert!(met >= 11);
    }

    #[test]
    fn on_a_coarse_lattice_no_constraint_is_lost() {
        let image = blank(21, 19);
        let (level, positions) = vertices(&image, 4.0);
        for (pixel, height) in [(0, 1.0), (210, 2.0), (217, 3.0), (378, 4.0)] {
            let lone = with(&image, |row, col| {
                if row * 21 + col == pixel {
                    height
                } else {
                    f64::NAN
                }
            });
            let found = lone.constraints_on(&level).unwrap();
            let met: Vec<_> = (0..positions.len())
                .filter(|v| !found.heights()[*v].is_nan())
                .collect();
            assert_eq!(met.len(), 1, "pixel {pixel}");
            assert_eq!(found.heights()[met[0]], height);
            let centre = lone.position(pixel / 21, pixel % 21);
            assert!(distance(positions[met[0]], centre) <= 4.0);
        }
        // All at once: the mean of those that come to one vertex lies between them.
        let all = with(&image, |row, col| (row + col) as f64);
        let found = all.constraints_on(&level).unwrap();
        for (z, surface) in found.heights().iter().zip(level.heights()) {
            assert_eq!(z.is_nan(), surface.is_nan());
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
