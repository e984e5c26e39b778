//! Regions of photos as masks of a depth image, and resampling of further images to its size.

use nalgebra::Vector3;

use super::camera::{Camera, Intrinsics};
use super::footprint::Footprint;
use crate::error::{Error, Result, check_count, try_filled};
use crate::heights::heightfield::HeightImage;
use crate::math::planar::polygon_contains;

/// Region of a photo: the part that shows the object of interest.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Region<'a> {
    /// The pixels whose value is not 0, in an image with this width and height.
    Mask([usize; 2], &'a [u8]),
    /// The polygon between these corners, in pixels of a photo with this width and height; `[0, 0]` is the centre of
    /// the upper left pixel. Four corners are assumed to be those of a page, whose edges may be bent: the region is
    /// then the view along the normal of the plane through the corners, if there are depths around each.
    Polygon([usize; 2], &'a [[f64; 2]]),
}

impl Region<'_> {
    fn size(&self) -> [usize; 2] {
        match self {
            Region::Mask(size, _) | Region::Polygon(size, _) => *size,
        }
    }

    fn check(&self) -> Result<()> {
        let [width, height] = self.size();
        if width == 0 || height == 0 {
            return Err(Error::Empty { what: "photo" });
        }
        match self {
            Region::Mask(_, flags) => check_count("mask", height, width, flags.len()),
            Region::Polygon(_, corners) => check_crop(corners),
        }
    }

    fn holds(&self, place: [f64; 2]) -> bool {
        match self {
            Region::Mask([width, height], flags) => {
                let [col, row] = place.map(f64::round);
                let inside =
                    (0.0..*width as f64).contains(&col) && (0.0..*height as f64).contains(&row);
                inside && flags[row as usize * width + col as usize] != 0
            }
            Region::Polygon(_, corners) => polygon_contains(corners, place),
        }
    }
}

/// Returns an error unless the value of the option `crop` is a polygon of at least three finite corners.
pub(crate) fn check_crop(polygon: &[[f64; 2]]) -> Result<()> {
    if polygon.len() >= 3 && polygon.as_flattened().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    let requirement = "must be three or more corners, each with a finite x and y";
    Err(Error::option("crop", polygon, requirement))
}

impl Intrinsics {
    /// Computes the mask of a depth image for [`HeightImage::masked`]: 1 where a depth shows the region, else 0. The
    /// camera `photo` took the photo of the region; without one, the photo shows the same view as the depth image.
    /// Costs `O(pixels · corners)`.
    ///
    /// # Errors
    /// Those of [`Intrinsics::for_size`] and [`Camera::for_size`]; [`Error::Shape`] for a mask of another
    /// length than its size, [`Error::Option`] for less than three corners or one that is not finite,
    /// [`Error::Unsupported`] for a region without a camera that has other proportions than the depths,
    /// to 2 %; [`Error::OutOfMemory`].
    pub fn within(
        &self,
        depths: &HeightImage,
        region: &Region<'_>,
        photo: Option<&Camera>,
    ) -> Result<Vec<u8>> {
        region.check()?;
        let size = [depths.width(), depths.height()];
        let camera = self.for_size(size)?;
        let photo = photo
            .map(|photo| photo.for_size(region.size()))
            .transpose()?;
        let stretch = match photo {
            Some(_) => [0.0; 2],
            None => stretch("part of a photo", region.size(), size)?,
        };
        let mut inside = try_filled("mask", depths.values().len(), 0)?;
        let point = |i: usize| {
            let pixel = [(i % size[0]) as f64, (i / size[0]) as f64];
            let value = depths.values()[i];
            let ahead = value > 0.0 && value.is_finite();
            ahead.then(|| camera.point(pixel[0], pixel[1], value))?
        };
        let place = |i: usize| match photo {
            Some(photo) => point(i).and_then(|point| photo.project(point)),
            None => {
                let pixel = [(i % size[0]) as f64, (i / size[0]) as f64];
                Some([0, 1].map(|k| (pixel[k] + 0.5) * stretch[k] - 0.5))
            }
        };
        let footprint = match region {
            Region::Polygon(_, corners) if let [a, b, c, d] = **corners => {
                let seen: Vec<([f64; 2], Vector3<f64>)> = (0..inside.len())
                    .filter_map(|i| Some((place(i)?, Vector3::from(point(i)?))))
                    .collect();
                Footprint::new(&[a, b, c, d], &seen)
            }
            _ => None,
        };
        for (i, inside) in inside.iter_mut().enumerate() {
            let holds = match &footprint {
                Some(footprint) => point(i).is_some_and(|point| footprint.holds(&point.into())),
                None => place(i).is_some_and(|place| region.holds(place)),
            };
            *inside = u8::from(holds);
        }
        Ok(inside)
    }
}

/// Resamples values given at the pixels of an image of some width and height to an image of another size that shows the
/// same view, by the nearest pixel. `what` names the values in errors.
///
/// # Errors
/// [`Error::Shape`] if there are not as many as the size says, [`Error::Empty`],
/// [`Error::Unsupported`] where the two sizes have not the same proportions, to 2 %,
/// [`Error::OutOfMemory`].
pub fn resampled<T: Copy>(
    what: &'static str,
    values: &[T],
    [width, height]: [usize; 2],
    size: [usize; 2],
) -> Result<Vec<T>> {
    check_count(what, height, width, values.len())?;
    let stretch = stretch(what, [width, height], size)?;
    let mut out = try_filled(what, size[0] * size[1], values[0])?;
    for (i, value) in out.iter_mut().enumerate() {
        let at = |k: usize, pixel: usize| ((pixel as f64 + 0.5) * stretch[k]) as usize;
        *value = values[at(1, i / size[0]) * width + at(0, i % size[0])];
    }
    Ok(out)
}

/// Ratios of width and height of one image to those of another that shows the same view; an error if their proportions
/// differ by more than 2 %.
fn stretch(what: &'static str, from: [usize; 2], to: [usize; 2]) -> Result<[f64; 2]> {
    if from.contains(&0) || to.contains(&0) {
        return Err(Error::Empty { what });
    }
    let stretch = [0, 1].map(|k| from[k] as f64 / to[k] as f64);
    if (stretch[0] / stretch[1] - 1.0).abs() > 0.02 {
        return Err(Error::Unsupported {
            format: what,
            reason: format!(
                "it has {} × {} pixels and the depths {} × {}: other proportions, so that it does not show \
                 the same; neither may be cropped, nor lie on its side",
                from[0], from[1], to[0], to[1]
            ),
        });
    }
    Ok(stretch)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane() -> (Intrinsics, HeightImage) {
        let camera = Intrinsics::new(10.0, 10.0, 3.5, 2.5);
        let depths = HeightImage::new(8, 6, vec![2.0; 48]).unwrap();
        (camera, depths)
    }

    #[test]
    fn a_mask_of_another_size_is_one_of_these_depths() {
        let (camera, depths) = plane();
        // Three times as fine: columns 2 to 4 of the depths.
        let fine: Vec<u8> = (0..24 * 18)
            .map(|i| u8::from((6..15).contains(&(i % 24))))
            .collect();
        let region = Region::Mask([24, 18], &fine);
        let found = camera.within(&depths, &region, None).unwrap();
        let wanted = |from: usize, to: usize| -> Vec<u8> {
            (0..48)
                .map(|i| u8::from((from..to).contains(&(i % 8))))
                .collect()
        };
        assert_eq!(found, wanted(2, 5));
        assert_eq!(
            resampled("mask", &fine, [24, 18], [8, 6]).unwrap(),
            wanted(2, 5)
        );
        let coarse = [1u8, 0, 0, 2, 0, 0];
        let finer = resampled("mask", &coarse, [3, 2], [9, 6]).unwrap();
        assert_eq!(finer.iter().map(|v| usize::from(*v)).sum::<usize>(), 9 * 3);
        assert_eq!((finer[0], finer[2], finer[3], finer[5 * 9]), (1, 1, 0, 2));
    }

    #[test]
    fn another_camera_sees_the_region_elsewhere() {
        let (camera, depths) = plane();
        let corners = [[1.5, 0.5], [5.5, 0.5], [5.5, 4.5], [1.5, 4.5]];
        let region = Region::Polygon([8, 6], &corners);
        let beside = |found: &[u8]| (0..48).filter(|i| found[*i] != 0).collect::<Vec<_>>();
        let same = camera.within(&depths, &region, None).unwrap();
        assert_eq!(beside(&same)[..4], [10, 11, 12, 13]);
        // 0.4 to its left: at a depth of 2 all is two pixels farther to the right there.
        let mut photo = Camera::new(camera);
        photo.pose.translation[0] = 0.4;
        let other = camera.within(&depths, &region, Some(&photo)).unwrap();
        assert_eq!(beside(&other)[..4], [8, 9, 10, 11]);
    }

    #[test]
    fn what_does_not_show_the_same_is_refused() {
        let (camera, depths) = plane();
        let code = |region: Region| {
            let found = camera.within(&depths, &region, None);
            found.unwrap_err().code()
        };
        assert_eq!(code(Region::Mask([6, 8], &[1; 48])), "UNSUPPORTED");
        assert_eq!(code(Region::Mask([8, 6], &[1; 47])), "SHAPE");
        assert_eq!(code(Region::Mask([0, 6], &[])), "EMPTY");
        assert_eq!(code(Region::Polygon([8, 6], &[[0.0; 2]; 2])), "OPTION");
        assert_eq!(
            resampled("mask", &[1u8; 3], [2, 2], [8, 8])
                .unwrap_err()
                .code(),
            "SHAPE"
        );
    }
}
