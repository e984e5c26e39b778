//! Surfaces as pictures, seen from above: shaded, or in the colours of their curvature or patches.
//!
//! ```
//! use developable::picture::{Picture, PictureOptions, Style};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! let roof = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let options = PictureOptions::default().style(Style::patches()).width(200);
//! let picture = Picture::new(&roof, &options)?;
//! assert_eq!(picture.rgba().len(), 4 * picture.width() * picture.height());
//! # Ok(())
//! # }
//! ```

pub(crate) mod colours;

use crate::dewarp::Extent;
use crate::error::{Error, Result, checked_cells, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::heights::normalization::{Normalization, bounds};
use crate::shape::analysis::Curvatures;
use crate::shape::patches::{NO_PATCH, PatchOptions, Patches};

/// Ambient brightness: brightness of a surface that the light does not reach, from 0 to 1.
const AMBIENT_BRIGHTNESS: f64 = 0.15;

/// Minimum sum of the interpolation weights of the vertices with heights around a point for the point to be on the
/// surface: half, less rounding, so that between two vertices the nearer one decides.
const MIN_VERTEX_WEIGHT: f64 = 0.5 - 1e-9;

/// Distance beyond its outermost vertices up to which a surface is extrapolated in a picture, in units of the larger of
/// lattice spacing and pixel size.
const MAX_CONTINUATION_STEPS: f64 = 0.5 + 1e-9;

/// Distance beyond the lattice's first and last row up to which a surface is extrapolated in a picture, in units of the
/// larger of lattice spacing and pixel size: a height image may end a row and half a pixel beyond them.
const MAX_ROW_CONTINUATION_STEPS: f64 = 1.5;

/// What a picture shows of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Style {
    /// The surface with diffuse (Lambertian) shading under one directional light: brightness 0.15 + 0.85 max(0,
    /// n·l), for the unit normal n and the direction l towards the light.
    Shaded {
        /// Direction towards the light, of any length: x to the right, y up, z towards the viewer and positive.
        light: [f64; 3],
    },
    /// A curvature that is zero on developable surfaces, [`Curvature::Gaussian`] or [`Curvature::Kappa2`]: from blue
    /// (negative) over white (0) to red (positive), and grey next to the border, where it is not defined.
    Curvature {
        /// Curvature that is shown: Gaussian, or the smaller eigenvalue of the Hessian.
        kind: Curvature,
        /// Absolute value at the ends of the colour scale, in the surface's units; larger values have the colour of
        /// the end. `None`: the curvature of a sphere as wide as the longer side of the surface.
        limit: Option<f64>,
    },
    /// The patches of the surface, each in one colour, with darker creases.
    Patches(PatchOptions),
}

/// Measure of curvature that tells how far a surface is from developable; see [`Curvatures`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Curvature {
    /// Discrete Gaussian curvature, in `1/length²`.
    #[default]
    Gaussian,
    /// Eigenvalue of the Hessian with the smaller magnitude, in `1/length`.
    Kappa2,
}

impl Style {
    /// Returns the style [`Style::Shaded`] with light from the upper left.
    pub fn shaded() -> Self {
        Style::Shaded {
            light: [-0.38, 0.42, 0.82],
        }
    }

    /// Returns the style [`Style::Curvature`] with Gaussian curvature and the default limit.
    pub fn curvature() -> Self {
        Style::Curvature {
            kind: Curvature::default(),
            limit: None,
        }
    }

    /// Returns the style [`Style::Patches`] with default options.
    pub fn patches() -> Self {
        Style::Patches(PatchOptions::default())
    }
}

/// Options of a picture: its style, its width and the part of the plane it shows.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PictureOptions {
    /// What the picture shows. Default [`Style::shaded`].
    pub style: Style,
    /// Width of the picture, in pixels; the height follows from the extent. `None`: one pixel for each lattice spacing.
    pub width: Option<usize>,
    /// Rectangle of the plane that the picture shows. `None`: the box around the lattice's vertices, half a spacing
    /// larger on each side. For a surface made from a height image use [`Extent::from_image`], so that the pixels of
    /// both coincide.
    pub extent: Option<Extent>,
}

impl Default for PictureOptions {
    fn default() -> Self {
        PictureOptions {
            style: Style::shaded(),
            width: None,
            extent: None,
        }
    }
}

impl PictureOptions {
    /// Returns these options with another style of the picture.
    pub fn style(self, style: Style) -> Self {
        PictureOptions { style, ..self }
    }

    /// Returns these options with another width of the picture, in pixels.
    pub fn width(self, width: usize) -> Self {
        PictureOptions {
            width: Some(width),
            ..self
        }
    }

    /// Returns these options with another rectangle of the plane that the picture shows.
    pub fn extent(self, extent: Extent) -> Self {
        PictureOptions {
            extent: Some(extent),
            ..self
        }
    }
}

/// A picture of RGBA pixels, transparent where there is no surface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    width: usize,
    height: usize,
    rgba: Vec<u8>,
}

impl Picture {
    /// Draws a picture of a surface seen from above.
    ///
    /// Slopes and curvatures are linear between vertices, labels the nearest vertex's. A pixel is
    /// opaque if the surface has a height at its centre or nearest to it. Where pixels are larger
    /// than the lattice's spacing the surface is sampled, not averaged. Costs
    /// `O(vertices + pixels)`, and with patches what [`Patches::new`] costs.
    ///
    /// # Errors
    /// [`Error::Option`] for a width of 0, a light that is not above the surface, a limit that is
    /// not positive and finite or the options of patches; [`Error::TooLarge`] above
    /// [`MAX_CELLS`](crate::MAX_CELLS) pixels; [`Error::Empty`] for an extent without area;
    /// [`Error::NoInterior`] where curvature or patches are wanted and no vertex has all six
    /// neighbours; [`Error::OutOfMemory`].
    pub fn new(surface: &Heightfield, options: &PictureOptions) -> Result<Self> {
        let frame = Frame::new(surface, options)?;
        match options.style {
            Style::Shaded { light } => shaded(&frame, light),
            Style::Curvature { kind, limit } => curved(&frame, kind, limit),
            Style::Patches(wanted) => patched(&frame, &wanted),
        }
    }

    /// Number of columns of the picture.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows of the picture.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green, blue and alpha bytes of each pixel, row by row from the top.
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }
}

fn shaded(frame: &Frame<'_>, light: [f64; 3]) -> Result<Picture> {
    let length = light[0].hypot(light[1]).hypot(light[2]);
    if !(length.is_finite() && light[2] > 0.0) {
        let requirement = "must be three finite numbers, the last above zero";
        return Err(Error::option("light", light, requirement));
    }
    let [lx, ly, lz] = light.map(|c| c / length);
    let (surface, lattice) = (frame.surface, frame.surface.lattice());
    let mut slopes = try_filled("slopes", lattice.len(), [f64::NAN; 2])?;
    for (i, slope) in slopes.iter_mut().enumerate() {
        if !surface.heights()[i].is_nan() {
            // A vertex without a gradient counts as horizontal.
            let found = surface.gradient(i / lattice.cols(), i % lattice.cols());
            *slope = found.unwrap_or([0.0; 2]);
        }
    }
    frame.coloured(|_, corners| {
        let [x, y] = corners.mean(&slopes)?;
        let cosine = (lz - x * lx - y * ly) / x.hypot(y).hypot(1.0);
        let tone = AMBIENT_BRIGHTNESS + (1.0 - AMBIENT_BRIGHTNESS) * cosine.max(0.0);
        Some(colours::steel(tone))
    })
}

fn curved(frame: &Frame<'_>, kind: Curvature, limit: Option<f64>) -> Result<Picture> {
    let size = 1.0 / Normalization::UnitSquare.factor(frame.surface);
    let limit = match (limit, kind) {
        (Some(limit), _) => positive("limit", limit)?,
        (None, Curvature::Gaussian) => (2.0 / size).powi(2),
        (None, Curvature::Kappa2) => 2.0 / size,
    };
    let found = Curvatures::new(frame.surface)?;
    let values = match kind {
        Curvature::Gaussian => found.gaussian,
        Curvature::Kappa2 => found.kappa2,
    };
    let (values, _) = values.as_chunks::<1>();
    frame.coloured(|_, corners| {
        let [value] = corners.mean(values)?;
        Some(colours::diverging(value / limit))
    })
}

fn patched(frame: &Frame<'_>, options: &PatchOptions) -> Result<Picture> {
    let found = Patches::new(frame.surface, options)?;
    // The label of the nearest vertex that has one.
    let label = |corners: &Corners| {
        (corners.0.iter())
            .map(|(vertex, weight)| (found.labels()[*vertex], *weight))
            .filter(|(label, weight)| *label != NO_PATCH && *weight > 0.0)
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(label, _)| label)
    };
    let label_at = |p: [f64; 2]| frame.corners(p).as_ref().and_then(label);
    // Creases are as wide as a cell, and at least as wide as a pixel, so that none is missed.
    let half = 0.5 * frame.surface.lattice().spacing().max(frame.pixel[0]);
    frame.coloured(|[x, y], corners| {
        let sides = [
            [[x - half, y], [x + half, y]],
            [[x, y - half], [x, y + half]],
        ];
        let meet = |[a, b]: [[f64; 2]; 2]| {
            matches!((label_at(a), label_at(b)), (Some(a), Some(b)) if a != b)
        };
        Some(if sides.into_iter().any(meet) {
            colours::crease(label(corners)?)
        } else {
            colours::patch(label(corners)?)
        })
    })
}

/// A surface, and the rectangle of the plane and the pixels of its picture.
struct Frame<'a> {
    surface: &'a Heightfield,
    width: usize,
    height: usize,
    /// Position of the picture's upper left corner in the plane.
    corner: [f64; 2],
    /// Width and height of a pixel in the plane: nearly equal, because a whole number of pixels fills the picture.
    pixel: [f64; 2],
    /// Bounding box of the vertices with heights: lower left and upper right corner.
    bounds: [[f64; 2]; 2],
}

impl<'a> Frame<'a> {
    fn new(surface: &'a Heightfield, options: &PictureOptions) -> Result<Self> {
        let extent = options.extent.unwrap_or_else(|| around(surface));
        let empty = |_| Error::Empty { what: "picture" };
        let [across, down] = extent.sides().map_err(empty)?;
        let width = match options.width {
            Some(0) => return Err(Error::option("width", 0, "must be at least 1")),
            Some(width) => width,
            None => ((across / surface.lattice().spacing()).round() as usize).max(1),
        };
        let height = ((width as f64 * down / across).round() as usize).max(1);
        checked_cells("picture", height, width)?;
        Ok(Frame {
            surface,
            width,
            height,
            corner: [extent.min[0], extent.max[1]],
            pixel: [across / width as f64, down / height as f64],
            bounds: bounds(surface),
        })
    }

    /// Draws the picture. `colour` gives the colour of a point from its position and the vertices around it; where it
    /// gives none, the pixel is grey.
    fn coloured(&self, colour: impl Fn([f64; 2], &Corners) -> Option<[u8; 3]>) -> Result<Picture> {
        let mut rgba = try_filled("picture", 4 * self.width * self.height, 0)?;
        let (pixels, _) = rgba.as_chunks_mut::<4>();
        for (i, pixel) in pixels.iter_mut().enumerate() {
            let centre = [
                self.corner[0] + ((i % self.width) as f64 + 0.5) * self.pixel[0],
                self.corner[1] - ((i / self.width) as f64 + 0.5) * self.pixel[1],
            ];
            if let Some(corners) = self.corners(centre) {
                let [r, g, b] = colour(centre, &corners).unwrap_or(colours::NO_VALUE);
                *pixel = [r, g, b, u8::MAX];
            }
        }
        Ok(Picture {
            width: self.width,
            height: self.height,
            rgba,
        })
    }

    /// Finds the vertices around a point, or around the nearest point of the surface's bounding box; none where there
    /// is no surface.
    fn corners(&self, [x, y]: [f64; 2]) -> Option<Corners> {
        let lattice = self.surface.lattice();
        let unit = lattice.spacing().max(self.pixel[0]);
        let ([_, top], [min, max]) = (lattice.origin(), self.bounds);
        let bottom = top - (lattice.rows() - 1) as f64 * lattice.row_spacing();
        let row = y.max(bottom).min(top);
        let inside = [x.max(min[0]).min(max[0]), row.max(min[1]).min(max[1])];
        let beyond = (x - inside[0]).abs().max((row - inside[1]).abs());
        if (y - row).abs() > MAX_ROW_CONTINUATION_STEPS * unit
            || beyond > MAX_CONTINUATION_STEPS * unit
        {
            return None;
        }
        let triangle = lattice.locate(inside);
        let mut corners = [(0, 0.0); 3];
        let mut share = 0.0;
        for (corner, ((row, col), weight)) in
            (corners.iter_mut()).zip(triangle.vertices.into_iter().zip(triangle.weights))
        {
            if !lattice.contains(row, col) {
                continue;
            }
            let vertex = lattice.index(row as usize, col as usize);
            if !self.surface.heights()[vertex].is_nan() {
                *corner = (vertex, weight);
                share += weight;
            }
        }
        (share >= MIN_VERTEX_WEIGHT).then_some(Corners(corners))
    }
}

/// Default extent of a surface's picture: the box around its lattice's vertices, half a spacing larger on each side.
/// Pixels of the spacing's size then have their centres at the vertices of even rows.
fn around(surface: &Heightfield) -> Extent {
    let mut extent = Extent::from_heightfield(surface);
    let half = 0.5 * surface.lattice().spacing();
    extent.min = [surface.lattice().origin()[0] - half, extent.min[1] - half];
    extent.max = extent.max.map(|end| end + half);
    extent
}

/// Indices of the three vertices around a point, with their interpolation weights; a vertex without a height has weight
/// 0.
struct Corners([(usize, f64); 3]);

impl Corners {
    /// Interpolates values given at the vertices: weighted mean of those that are not NaN. None if there are none.
    fn mean<const N: usize>(&self, values: &[[f64; N]]) -> Option<[f64; N]> {
        let (mut sum, mut share) = ([0.0; N], 0.0);
        for (vertex, weight) in self.0 {
            let value = values[vertex];
            if weight > 0.0 && !value[0].is_nan() {
                share += weight;
                for (sum, value) in sum.iter_mut().zip(value) {
                    *sum += weight * value;
                }
            }
        }
        (share > 0.0).then(|| sum.map(|sum| sum / share))
    }
}

#[cfg(test)]
mod tests;
