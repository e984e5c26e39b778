//! Bridging of small holes in what a sensor delivers: dead pixels, speckle, lost rows and columns.
//!
//! A vertex has a stencil only if its six neighbours have heights, so that a dead vertex costs seven stencils.
//! Narrow holes are bridged instead: their vertices take part in the solve with heights to start from and a
//! small confidence.

mod crossing;
mod holes;
mod raster;
mod sites;
mod spikes;

use super::heightfield::{HeightImage, Heightfield};
use super::pixel_noise::PixelNoise;
use crate::error::{Error, Result, check_shape, try_filled};
use crossing::Crossings;
use holes::narrow;
use raster::Raster;
use spikes::remove_spikes;

/// Which holes in the data are bridged (filled before the solve), by their width.
///
/// Only the **width** of a hole counts, not its length: a missing row or column, a slot that is open to the border and
/// the narrow end of a notch are bridged like a single dead pixel, and so is speckle that leaves no two neighbours next
/// to each other. A hole, or a part of it, is wider than `n` if a regular hexagon of `n + 1` vertices across fits into
/// it (in an image, an octagon of `n + 1` pixels across). Nothing is added outside of the data's outline, as such a
/// hexagon fits into every corner of it.
///
/// A hole is not bridged where the surface on one side does not continue the other side: where the slope across the
/// hole differs from the slopes beside it by more than noise and bends explain. So a hole between two levels of depth
/// stays a hole. Nor is a hole bridged next to a known occlusion, or where a mask excludes the surface.
///
/// Bridged vertices are part of the surface. They start from the plane that fits the data around best, and have a small
/// confidence: a fifth of the data's next to it, less further away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bridging {
    /// No hole is bridged: a vertex without a height is not part of the surface.
    Off,
    /// Holes of at most this width, in vertices or pixels, are bridged: 1 to 16.
    UpTo(usize),
}

/// Maximum width of a hole that may be bridged, in lattice vertices or pixels: beyond it a plane says little about the
/// missing surface.
const MAX_BRIDGE_WIDTH_VERTICES: usize = 16;

/// Confidence of a bridged vertex one step from data on all sides, relative to the data's confidence; it falls with the
/// distance. With a hundredth of it, or none, the same surface takes more iterations
/// (`benches/scenes.md`, One constant at a time).
pub(crate) const BRIDGE_CONFIDENCE: f64 = 0.2;

impl Default for Bridging {
    /// Returns the default: holes of up to 4 vertices or pixels across are bridged.
    fn default() -> Self {
        Bridging::UpTo(4)
    }
}

impl Bridging {
    /// Maximum width of a bridged hole, in vertices or pixels; 0 if none is bridged.
    ///
    /// # Errors
    /// [`Error::Option`] for a width out of range.
    pub fn width(self) -> Result<usize> {
        match self {
            Bridging::Off => Ok(0),
            Bridging::UpTo(width) if (1..=MAX_BRIDGE_WIDTH_VERTICES).contains(&width) => Ok(width),
            Bridging::UpTo(width) => {
                let requirement = "must be a width from 1 to 16 vertices or pixels, or none";
                Err(Error::option("bridge", width, requirement))
            }
        }
    }
}

/// A vertex or pixel in a hole that is bridged, with its height and confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bridge {
    pub index: usize,
    pub height: f64,
    pub confidence: f64,
}

/// Width of the padding of a raster in which spikes are searched, in cells: they are compared with neighbours so far away.
const SPIKE_PADDING: usize = 4;

/// Heights of a field, and what is known about each of them, for bridging its holes.
pub(crate) struct Surroundings<'a> {
    /// Heights, row by row; NaN where there is none.
    pub heights: &'a [f64],
    /// Confidence of each height; empty if all are 1. Heights of confidence 0 do not count.
    pub confidence: &'a [f64],
    /// Whether the vertex or pixel with this index is excluded from the surface, so that it is never bridged.
    pub outside: &'a dyn Fn(usize) -> bool,
    /// Whether the vertex or pixel with this index is at an occlusion: it and its neighbours are not bridged.
    pub torn: &'a dyn Fn(usize) -> bool,
}

impl Surroundings<'_> {
    /// Finds the bridges of a heightfield, an image sampled on a lattice as by [`HeightImage::to_lattice`]: holes up to
    /// `width` vertices across.
    pub(crate) fn on_lattice(&self, field: &Heightfield, width: usize) -> Result<Vec<Bridge>> {
        let lattice = field.lattice();
        let raster = Raster::hexagonal(lattice.rows(), lattice.cols(), width)?;
        self.bridges(raster, width, lattice.spacing())
    }

    fn on_image(&self, image: &HeightImage, width: usize) -> Result<Vec<Bridge>> {
        let raster = Raster::square(image.height(), image.width(), width)?;
        self.bridges(raster, width, image.pixel_size())
    }

    fn bridges(&self, raster: Raster, width: usize, spacing: f64) -> Result<Vec<Bridge>> {
        if width == 0 || !self.heights.iter().any(|z| z.is_nan()) {
            return Ok(Vec::new());
        }
        let heights = raster.padded(self.heights, f64::NAN)?;
        let mut holes = narrow(&raster, &heights, width)?;
        holes.retain(|cell| self.may_be_bridged(&raster, *cell));
        // Heights of confidence 0 are part of the surface, but carry no information about it.
        let mut given = heights;
        let mut confidence = Vec::new();
        if !self.confidence.is_empty() {
            confidence = raster.padded(self.confidence, 0.0)?;
            for (z, confidence) in given.iter_mut().zip(&confidence) {
                if confidence.is_nan() || *confidence <= 0.0 {
                    *z = f64::NAN;
                }
            }
        }
        let crossings = Crossings::new(&raster, &given, &confidence, width, spacing);
        let mut bridges = Vec::new();
        for crossing in crossings.sound(&holes)? {
            bridges.push(Bridge {
                index: raster.index(crossing.cell),
                height: crossing.height,
                confidence: BRIDGE_CONFIDENCE / crossing.distance * crossing.confidence,
            });
        }
        Ok(bridges)
    }

    fn may_be_bridged(&self, raster: &Raster, cell: usize) -> bool {
        let torn = |cell: usize| raster.is_inside(cell) && (self.torn)(raster.index(cell));
        !(self.outside)(raster.index(cell)) && !torn(cell) && !raster.neighbours(cell).any(torn)
    }
}

/// Finds the vertices of a heightfield whose heights are spikes: far from all around them.
pub(crate) fn spikes_on_lattice(field: &Heightfield) -> Result<Vec<usize>> {
    let lattice = field.lattice();
    let raster = Raster::hexagonal(lattice.rows(), lattice.cols(), SPIKE_PADDING)?;
    spikes(&raster, field.heights())
}

fn spikes(raster: &Raster, heights: &[f64]) -> Result<Vec<usize>> {
    let found = remove_spikes(raster, &mut raster.padded(heights, f64::NAN)?);
    Ok(found.into_iter().map(|cell| raster.index(cell)).collect())
}

/// A height image whose small holes are bridged, with a confidence for each pixel.
///
/// ```
/// use developable::{Bridging, HeightImage, Input, Options, fit};
/// # fn main() -> developable::Result<()> {
/// let mut values: Vec<f64> = (0..900).map(|i| 0.01 * ((i % 30) as f64).powi(2)).collect();
/// for dead in (0..900).step_by(17) {
///     values[dead] = f64::NAN;
/// }
/// let image = HeightImage::new(30, 30, values)?;
/// let bridged = image.bridged(Bridging::default())?;
/// assert_eq!(bridged.len(), 52); // all but the one in the corner
/// let surface = fit(Input::from_bridged(&bridged, None)?, &Options::default())?;
/// let pixels = surface.heightfield().to_image(bridged.image())?;
/// assert_eq!(pixels.values().iter().filter(|z| z.is_nan()).count(), 1);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BridgedImage {
    image: HeightImage,
    /// The image as it was before bridging.
    original: HeightImage,
    /// Confidence of each pixel; `None` if all are equal.
    confidence: Option<HeightImage>,
    bridged: usize,
    noise: PixelNoise,
}

/// A bridged image sampled at the vertices of a lattice.
pub(crate) struct OnLattice {
    pub heights: Heightfield,
    pub confidence: Option<Vec<f64>>,
    /// Number of lattice vertices that have a height only because a hole in the image was bridged.
    pub bridges: usize,
    pub noise: PixelNoise,
}

impl HeightImage {
    /// Bridges small holes of the image before it is sampled on a lattice: a lattice vertex has a height only
    /// if all pixels around it have one, so that missing pixels are better bridged as such. Linear cost.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) for a width out of range,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn bridged(&self, bridging: Bridging) -> Result<BridgedImage> {
        self.bridged_where(bridging, None, None, None)
    }

    /// Returns the image without faults of a sensor: offsets of whole rows or columns are taken out, and spikes, single
    /// heights far from all around them, are no data. Linear cost.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn repaired(&self) -> Result<HeightImage> {
        let mut image = match self.without_line_offsets()? {
            Some(levelled) => levelled,
            None => self.clone(),
        };
        let raster = Raster::square(image.height(), image.width(), SPIKE_PADDING)?;
        let found = spikes(&raster, image.values())?;
        if !found.is_empty() {
            let mut values = image.values().to_vec();
            found.iter().for_each(|pixel| values[*pixel] = f64::NAN);
            image = image.with_values(values)?;
        }
        Ok(image)
    }

    /// Bridges small holes of the image with more information about its pixels: the confidence of each height (NaN or 0
    /// where it does not count), `keep`, which is 0 where there is no surface, and `torn`, which is not 0 at an
    /// occlusion.
    ///
    /// # Errors
    /// As [`HeightImage::bridged`]; [`Error::Shape`](crate::Error::Shape) for what is not one value
    /// for each pixel.
    pub fn bridged_where(
        &self,
        bridging: Bridging,
        confidence: Option<&HeightImage>,
        keep: Option<&[u8]>,
        torn: Option<&[u8]>,
    ) -> Result<BridgedImage> {
        let given = [
            ("confidence", confidence.map(|image| image.values().len())),
            ("mask", keep.map(<[u8]>::len)),
            ("occlusions", torn.map(<[u8]>::len)),
        ];
        for (what, found) in given {
            let found = found.unwrap_or(self.values().len());
            check_shape(what, self.height(), self.width(), found)?;
        }
        let surroundings = Surroundings {
            heights: self.values(),
            confidence: confidence.map_or(&[], HeightImage::values),
            outside: &|pixel| keep.is_some_and(|keep| keep[pixel] == 0),
            torn: &|pixel| torn.is_some_and(|torn| torn[pixel] != 0),
        };
        let bridges = surroundings.on_image(self, bridging.width()?)?;
        let mut values = self.values().to_vec();
        let mut trust = match confidence {
            Some(image) => image.values().to_vec(),
            None if bridges.is_empty() => Vec::new(),
            None => try_filled("confidence", values.len(), 1.0)?,
        };
        for bridge in &bridges {
            values[bridge.index] = bridge.height;
            trust[bridge.index] = bridge.confidence;
        }
        Ok(BridgedImage {
            confidence: match trust.is_empty() {
                true => None,
                false => Some(self.with_values(trust)?),
            },
            image: self.with_values(values)?,
            original: self.clone(),
            bridged: bridges.len(),
            noise: self.pixel_noise(),
        })
    }
}

impl BridgedImage {
    /// The image with heights in bridged holes: for [`Heightfield::to_image`] on the way back.
    pub fn image(&self) -> &HeightImage {
        &self.image
    }

    /// Returns the image with heights in bridged holes.
    pub fn into_image(self) -> HeightImage {
        self.image
    }

    /// Samples the bridged image on a lattice, as [`HeightImage::to_lattice`] does.
    pub(crate) fn on_lattice(&self, spacing: Option<f64>) -> Result<OnLattice> {
        let heights = self.image.to_lattice(spacing)?;
        let lattice = *heights.lattice();
        let mut bridges = 0;
        if !self.is_empty() {
            let before = self.original.sampled_on(&lattice)?;
            let pairs = heights.heights().iter().zip(before.heights());
            bridges = pairs.filter(|(z, old)| old.is_nan() && !z.is_nan()).count();
        }
        let confidence = match &self.confidence {
            Some(image) => Some(image.sampled_on(&lattice)?.into_heights()),
            None => None,
        };
        Ok(OnLattice {
            heights,
            confidence,
            bridges,
            noise: self.noise,
        })
    }

    /// Number of pixels in holes that were bridged, that is filled with a height.
    pub fn len(&self) -> usize {
        self.bridged
    }

    /// Whether no hole was bridged.
    pub fn is_empty(&self) -> bool {
        self.bridged == 0
    }
}
