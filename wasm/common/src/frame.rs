//! The axes of a view in and out.

use serde::{Deserialize, Serialize};

use developable::Frame;

/// `Frame` of `types.d.ts`.
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
