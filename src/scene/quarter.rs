//! Rotation of images by quarter turns, for depth images that lie on their side relative to a photo.

use super::camera::{Distortion, Intrinsics};
use crate::error::{Result, try_filled};
use crate::heights::heightfield::HeightImage;

/// A clockwise rotation of an image by quarter turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(try_from = "u32"))]
#[non_exhaustive]
pub enum Turn {
    /// No rotation of the image.
    #[default]
    None,
    /// Rotation by 90 degrees clockwise: the left side becomes the top.
    Quarter,
    /// Rotation by 180 degrees.
    Half,
    /// Rotation by 270 degrees clockwise: the right side becomes the top.
    ThreeQuarters,
}

impl TryFrom<u32> for Turn {
    type Error = &'static str;

    /// Converts from an angle in degrees, which is 0, 90, 180 or 270.
    fn try_from(degrees: u32) -> std::result::Result<Self, Self::Error> {
        match degrees {
            0 => Ok(Turn::None),
            90 => Ok(Turn::Quarter),
            180 => Ok(Turn::Half),
            270 => Ok(Turn::ThreeQuarters),
            _ => Err("expected 0, 90, 180 or 270 degrees"),
        }
    }
}

impl Turn {
    fn quarters(self) -> usize {
        self as usize
    }

    /// Rotates values given at the pixels of an image of size (width, height), row by row. Returns them with the new
    /// width and height.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    ///
    /// # Panics
    /// If there are not as many values as pixels.
    pub fn values<T: Copy>(self, values: &[T], size: [usize; 2]) -> Result<(Vec<T>, [usize; 2])> {
        assert_eq!(values.len(), size[0] * size[1]);
        let [width, height] = size;
        let turned = match self.quarters() % 2 {
            0 => size,
            _ => [height, width],
        };
        let mut out = Vec::new();
        if let Some(first) = values.first() {
            out = try_filled("turned image", values.len(), *first)?;
        }
        for (i, value) in out.iter_mut().enumerate() {
            let (col, row) = (i % turned[0], i / turned[0]);
            let [x, y] = match self {
                Turn::None => [col, row],
                Turn::Quarter => [row, height - 1 - col],
                Turn::Half => [width - 1 - col, height - 1 - row],
                Turn::ThreeQuarters => [width - 1 - row, col],
            };
            *value = values[y * width + x];
        }
        Ok((out, turned))
    }

    /// Rotates a height or depth image.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn image(self, image: &HeightImage) -> Result<HeightImage> {
        let (values, [width, height]) =
            self.values(image.values(), [image.width(), image.height()])?;
        HeightImage::new(width, height, values)?.with_pixel_size(image.pixel_size())
    }

    /// Returns the intrinsics for rotated images; `size` is the size of the images before, used if the intrinsics have
    /// none.
    pub fn camera(self, camera: &Intrinsics, size: [usize; 2]) -> Intrinsics {
        let mut camera = *camera;
        for _ in 0..self.quarters() {
            let [width, height] = camera.size.unwrap_or(size);
            let Distortion { k1, k2, p1, p2, k3 } = camera.distortion;
            camera = Intrinsics {
                fx: camera.fy,
                fy: camera.fx,
                cx: height as f64 - 1.0 - camera.cy,
                cy: camera.cx,
                size: Some([height, width]),
                // The direction to the right becomes down, and down becomes left.
                distortion: Distortion {
                    k1,
                    k2,
                    p1: p2,
                    p2: -p1,
                    k3,
                },
                ..camera
            };
        }
        camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_and_cameras_turn_alike() {
        let mut camera = Intrinsics::new(30.0, 31.0, 10.0, 7.0);
        camera.size = Some([24, 18]);
        camera.distortion = Distortion {
            k1: 0.1,
            k2: -0.02,
            p1: 0.01,
            p2: -0.02,
            k3: 0.003,
        };
        let point = [0.2, -0.1, -1.0];
        let [col, row] = camera.project(point).unwrap();
        for (turn, turned, place) in [
            (Turn::None, point, [col, row]),
            (Turn::Quarter, [-0.1, -0.2, -1.0], [17.0 - row, col]),
            (Turn::Half, [-0.2, 0.1, -1.0], [23.0 - col, 17.0 - row]),
            (Turn::ThreeQuarters, [0.1, 0.2, -1.0], [row, 23.0 - col]),
        ] {
            let found = turn.camera(&camera, [1, 1]).project(turned).unwrap();
            assert!(
                (0..2).all(|k| (found[k] - place[k]).abs() < 1e-9),
                "{turn:?} {found:?} {place:?}"
            );
        }
        let image = [1, 2, 3, 4, 5, 6];
        let turned = |turn: Turn| turn.values(&image, [3, 2]).unwrap();
        assert_eq!(turned(Turn::Quarter), (vec![4, 1, 5, 2, 6, 3], [2, 3]));
        assert_eq!(turned(Turn::Half), (vec![6, 5, 4, 3, 2, 1], [3, 2]));
        assert_eq!(
            turned(Turn::ThreeQuarters),
            (vec![3, 6, 2, 5, 1, 4], [2, 3])
        );
        assert_eq!(turned(Turn::None), (image.to_vec(), [3, 2]));
    }
}
