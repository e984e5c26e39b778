//! Conversion of a view's frame (the axes of its image) from and to JavaScript.

use serde::{Deserialize, Serialize};

use developable::Frame;

/// Axes of a view's image, read from and written as JavaScript's `Frame` object.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct FrameFields {
    right: [f64; 3],
    up: [f64; 3],
    towards: [f64; 3],
}

impl From<Frame> for FrameFields {
    fn from(Frame { right, up, towards }: Frame) -> Self {
        FrameFields { right, up, towards }
    }
}

impl From<FrameFields> for Frame {
    fn from(FrameFields { right, up, towards }: FrameFields) -> Self {
        Frame { right, up, towards }
    }
}
