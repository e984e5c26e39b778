//! Outputs of a curled page: size of the flat page, warp map and mesh in space.

use super::curled_page::CurledPage;
use super::cylinder::SampledCurve;
use super::page_warp::PageWarp;
use super::working_photo::PhotoScale;
use crate::dewarp::{DewarpOptions, WarpMap};
use crate::error::{Error, Result, try_filled};
use crate::math::lanes;
use crate::scene::mesh::Mesh;

/// Maximum number of steps of Newton's method for finding the place on the page that a pixel shows.
const MAX_NEWTON_STEPS: usize = 30;

/// Number of mesh vertices along one page's curve.
const VERTICES_PER_CURVE: usize = 97;

impl CurledPage {
    /// Width and height of the flat page, or of both pages of a spread together, in millimetres if
    /// the format or a ruler is known, else in widths of a page.
    pub fn flat_size(&self) -> [f64; 2] {
        self.size().map(|side| side * self.unit)
    }

    /// Whether lengths of the flat page are in millimetres; otherwise in widths of a page.
    pub fn is_millimetres(&self) -> bool {
        self.millimetres
    }

    /// Number of pages side by side: 1, or 2 for a spread.
    pub fn pages(&self) -> usize {
        self.cylinder.pages.len()
    }

    /// Width and height of the flat page in the cylinder's unit, the width of the first page.
    pub(super) fn size(&self) -> [f64; 2] {
        let width = self.cylinder.pages.iter().map(|page| page.width).sum();
        if self.sideways {
            [self.cylinder.length, width]
        } else {
            [width, self.cylinder.length]
        }
    }

    /// Projects a place on the flat page to the photo, in pixels; `from_left` and `from_top` are shares of the page's
    /// width and height. None if the place is not in front of the camera.
    pub fn photo_place(&self, [from_left, from_top]: [f64; 2]) -> Option<[f64; 2]> {
        self.photo_place_on(&self.cylinder.curve(), [from_left, from_top])
    }

    /// Projects a place on the flat page to the photo by the curve of [`Cylinder::curve`](super::cylinder::Cylinder::curve).
    fn photo_place_on(&self, curve: &SampledCurve, share: [f64; 2]) -> Option<[f64; 2]> {
        let (along, down) = self.curve_shares(share);
        let on = self.on_curve(curve, along);
        self.cylinder.project(on, down * self.cylinder.length)
    }

    /// Returns this page as it is seen in the photo itself instead of its working photo.
    pub(super) fn in_full_photo(mut self, scale: PhotoScale) -> Self {
        self.cylinder.focal *= scale.block;
        self.cylinder.centre = scale.to_photo(self.cylinder.centre);
        self.photo = scale.photo;
        self.report = self.report.in_full_photo(scale);
        for line in self.found.iter_mut().flatten() {
            *line = line.map_points(|point| scale.to_photo(point));
        }
        self
    }

    /// Converts a place on the flat page, in shares of its width and height, to shares of the curve's length and of the
    /// rulings' length.
    pub(super) fn curve_shares(&self, [from_left, from_top]: [f64; 2]) -> (f64, f64) {
        if self.sideways {
            (from_top, 1.0 - from_left)
        } else {
            (from_left, from_top)
        }
    }

    /// Point of the curve, in its plane, at a share of the total width of all pages.
    fn on_curve(&self, curve: &SampledCurve, share: f64) -> [f64; 2] {
        let pages = &self.cylinder.pages;
        let mut rest = share * pages.iter().map(|page| page.width).sum::<f64>();
        for (number, page) in pages.iter().enumerate() {
            if rest <= page.width || number + 1 == pages.len() {
                return curve.at(number, rest / page.width);
            }
            rest -= page.width;
        }
        curve.at(0, 0.0)
    }

    /// Back-projects a pixel to the flat page: returns its position in the cylinder's unit, from the upper left corner.
    /// None if the pixel is not on the page.
    pub(super) fn flat_place(&self, pixel: [f64; 2]) -> Option<[f64; 2]> {
        let share = back_project(|at| self.photo_place(at), pixel)?;
        let size = self.size();
        Some([share[0] * size[0], share[1] * size[1]])
    }

    /// Computes the page's warp map, which holds for photos of any resolution.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn warp(&self) -> Result<PageWarp> {
        let curve = self.cylinder.curve();
        PageWarp::from_projection(self.flat_size(), self.millimetres, self.photo, |share| {
            self.photo_place_on(&curve, share)
        })
    }

    /// Computes the warp map of the flat page: for each pixel of the flat image its place in the photo. `dots` are
    /// pixels per unit of [`CurledPage::flat_size`], by default as many as give the flat image the number of pixels
    /// that the page covers in the photo; `trim` has no effect, because the page fills its image. The flat image is
    /// transparent where the page is outside of the photo.
    ///
    /// # Errors
    /// [`Error::Option`] for a resolution that is not positive and finite, [`Error::TooLarge`] for an
    /// image of more than [`MAX_CELLS`](crate::MAX_CELLS) pixels, [`Error::OutOfMemory`].
    pub fn warp_map(&self, options: &DewarpOptions) -> Result<WarpMap> {
        self.warp()?.warp_map(self.photo, options)
    }

    /// Makes a mesh of the page in space, with texture coordinates for the photo: 97 vertices along each page's curve,
    /// squares of about the same size along its rulings, row by row from the upper left corner. The axes are those of
    /// [`Intrinsics::back_project`](crate::Intrinsics::back_project): x to the right, y up, z towards the viewer, the
    /// camera at the origin. So [`sample`](crate::sample) with [`View::BestFit`](crate::View::BestFit) makes it a
    /// [`Heightfield`](crate::Heightfield).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn mesh(&self) -> Result<Mesh> {
        let pages = self.pages();
        let along = pages * (VERTICES_PER_CURVE - 1) + 1;
        let step = self
            .cylinder
            .pages
            .iter()
            .map(|page| page.width)
            .sum::<f64>()
            / along as f64;
        let down = ((self.cylinder.length / step) as usize).clamp(8, 1000) + 1;
        let (cols, rows) = if self.sideways {
            (down, along)
        } else {
            (along, down)
        };
        let mut positions = try_filled("mesh", cols * rows, [0.0; 3])?;
        let mut uvs = try_filled("mesh", cols * rows, [0f32; 2])?;
        let curve = self.cylinder.curve();
        for i in 0..cols * rows {
            let share = [
                (i % cols) as f64 / (cols - 1) as f64,
                (i / cols) as f64 / (rows - 1) as f64,
            ];
            let (at, down) = self.curve_shares(share);
            let on = self.on_curve(&curve, at);
            let down = down * self.cylinder.length;
            let point = self.cylinder.point(on, down) * self.unit;
            positions[i] = [point.x, -point.y, -point.z];
            let [x, y] = self
                .cylinder
                .project(on, down)
                .ok_or(Error::Empty { what: "page" })?;
            uvs[i] = texture_coordinates([x, y], self.photo);
        }
        grid_mesh(positions, uvs, cols)
    }
}

/// Converts a place in a photo, in pixels, to texture coordinates; `photo` is the photo's width and height.
pub(super) fn texture_coordinates([x, y]: [f64; 2], photo: [usize; 2]) -> [f32; 2] {
    let [width, height] = photo.map(|n| n as f64);
    [(x + 0.5) / width, 1.0 - (y + 0.5) / height].map(lanes::single)
}

/// Makes a triangle mesh of a grid of vertices, which are given row by row from the upper left corner, `cols` in a row.
pub(super) fn grid_mesh(positions: Vec<[f64; 3]>, uvs: Vec<[f32; 2]>, cols: usize) -> Result<Mesh> {
    let mut triangles = Vec::new();
    for row in 1..positions.len() / cols {
        for col in 1..cols {
            let last = (row * cols + col) as u32;
            let [above, before] = [last - cols as u32, last - 1];
            let first = above - 1;
            triangles.extend([[first, before, last], [first, last, above]]);
        }
    }
    Mesh::new(positions, triangles)?.with_uvs(uvs)
}

/// Finds the place on a flat page, in shares of its width and height, that the photo shows at a pixel: by Newton's
/// method from the nearest of a grid of initial places. None if the pixel is not on the page.
pub(super) fn back_project(
    photo_place: impl Fn([f64; 2]) -> Option<[f64; 2]>,
    pixel: [f64; 2],
) -> Option<[f64; 2]> {
    /// Number of initial places along each side of the page, from the nearest of which Newton's method starts.
    const INITIAL_PLACES_PER_SIDE: usize = 24;
    let off = |at: [f64; 2]| {
        let seen = photo_place(at)?;
        Some([seen[0] - pixel[0], seen[1] - pixel[1]])
    };
    let mut best = (f64::INFINITY, [0.5; 2]);
    for i in 0..INITIAL_PLACES_PER_SIDE * INITIAL_PLACES_PER_SIDE {
        let at = [i % INITIAL_PLACES_PER_SIDE, i / INITIAL_PLACES_PER_SIDE]
            .map(|k| (k as f64 + 0.5) / INITIAL_PLACES_PER_SIDE as f64);
        let distance = off(at).map_or(f64::INFINITY, |o| o[0].hypot(o[1]));
        if distance < best.0 {
            best = (distance, at);
        }
    }
    let mut at = best.1;
    for _ in 0..MAX_NEWTON_STEPS {
        /// Step of the forward differences in Newton's method, as a share of a page's side.
        const NEWTON_DIFFERENCE_STEP: f64 = 1e-6;
        let here = off(at)?;
        let [right, below] = [
            off([at[0] + NEWTON_DIFFERENCE_STEP, at[1]])?,
            off([at[0], at[1] + NEWTON_DIFFERENCE_STEP])?,
        ];
        let [a, c] = [0, 1].map(|k| (right[k] - here[k]) / NEWTON_DIFFERENCE_STEP);
        let [b, d] = [0, 1].map(|k| (below[k] - here[k]) / NEWTON_DIFFERENCE_STEP);
        let area = a * d - b * c;
        at = [
            (at[0] - (d * here[0] - b * here[1]) / area).clamp(0.0, 1.0),
            (at[1] - (a * here[1] - c * here[0]) / area).clamp(0.0, 1.0),
        ];
    }
    let left = off(at)?;
    // To one pixel: outside of the page the nearest place on it is farther away.
    (left[0].hypot(left[1]) < 1.0).then_some(at)
}
