//! Lines of text in a photo of a page, found by themselves.
//!
//! On the flat page that the edges show, lines of text are nearly level. There the ink is added up along the
//! rows of narrow upright strips; where that has bands which go on from strip to strip, their lower edge is
//! where letters stand. What scatters too much, or runs another way than what is above and below it, is none.

mod bands;
mod baseline;
mod ink;
mod lines;
mod ranking;

pub(super) use lines::find;
