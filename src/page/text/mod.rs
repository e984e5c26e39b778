//! Detection of lines of text in a photo of a page.
//!
//! On the flat page that the edges show, lines of text are nearly level. There the ink is summed along the rows of
//! narrow vertical strips. A line of text is a band of ink that continues from strip to strip; its lower edge is the
//! baseline. Bands that scatter too much are discarded. Thresholds were
//! chosen on the shapes and layouts of `benches/README.md` (flat pages from a photo alone), at half their resolution.

mod bands;
mod baseline;
mod grey_photo;
mod ink;
mod lines;
pub(super) mod ranking;

pub(super) use grey_photo::GreyPhoto;
pub(super) use lines::{find_baselines, is_upside_down};
