//! The input of a solve: heights, and what is known about them: confidence, constraints, occlusions.

use crate::error::try_filled;
use crate::error::{Error, Readable, Result, check_shape};
use crate::heights::bridging::{
    BRIDGE_CONFIDENCE, BridgedImage, Bridging, OnLattice, Surroundings, spikes_on_lattice,
};
use crate::heights::heightfield::Heightfield;
use crate::heights::occlusions::Occlusions;
use crate::heights::pixel_noise::PixelNoise;
use crate::lattice::domain::Domain;

/// Minimum positive confidence of a height: double precision resolves it beside the maximum, but no smaller one.
const MIN_CONFIDENCE: f64 = 1e-6;

/// Maximum confidence of a height.
const MAX_CONFIDENCE: f64 = 1e6;

/// A heightfield with all that may be known besides its heights: the confidence of each, constraints, and occlusions.
/// A plain [`Heightfield`] converts to an input.
///
/// ```
/// use developable::{Heightfield, Input, Lattice, Options, fit};
/// # fn main() -> developable::Result<()> {
/// // A roof through five points: free everywhere else.
/// let lattice = Lattice::new(40, 40, 1.0)?;
/// let mut points = vec![f64::NAN; lattice.len()];
/// for (row, col, height) in [(2, 2, 0.0), (2, 37, 0.0), (37, 2, 0.0), (37, 37, 0.0), (20, 20, 9.0)] {
///     points[row * 40 + col] = height;
/// }
/// let input = Input::design(Heightfield::new(lattice, points)?, None)?;
/// let surface = fit(input, &Options::default())?;
/// assert_eq!(surface.heightfield().height(20, 20), 9.0);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    pub(crate) field: Heightfield,
    /// Confidence of each vertex's height; empty if each is 1.
    pub(crate) confidence: Vec<f64>,
    /// Whether each vertex keeps its height exactly; empty if none does.
    pub(crate) constrained: Vec<bool>,
    pub(crate) occlusions: Option<Occlusions>,
    /// Whether each vertex is outside of the surface, so that no hole is bridged there; empty if none is.
    outside: Vec<bool>,
    bridging: Bridging,
    /// Number of vertices whose heights were filled in to bridge a hole.
    pub(crate) bridged: usize,
    /// Noise of the image that the heights were sampled from, if they were.
    pub(crate) pixel_noise: Option<PixelNoise>,
    /// Whether a camera has measured the heights, so that they have noise.
    pub(crate) is_measured: bool,
    /// Whether offsets of its rows and columns have been taken out as far as surfaces tell them from the shape.
    pub(crate) is_levelled: bool,
}

impl Input {
    /// Makes an input of measured heights, all of confidence 1; small holes are [bridged](Bridging) when the solve is
    /// set up.
    pub fn new(field: Heightfield) -> Self {
        Input {
            field,
            confidence: Vec::new(),
            constrained: Vec::new(),
            occlusions: None,
            outside: Vec::new(),
            bridging: Bridging::default(),
            bridged: 0,
            pixel_noise: None,
            is_measured: false,
            is_levelled: false,
        }
    }

    /// Makes an input from a height image whose holes are bridged, sampled on the lattice as by
    /// [`HeightImage::to_lattice`](crate::HeightImage::to_lattice), with the confidence that the bridging has given. No
    /// further holes are bridged.
    ///
    /// # Errors
    /// As [`HeightImage::to_lattice`](crate::HeightImage::to_lattice).
    pub fn from_bridged(image: &BridgedImage, spacing: Option<f64>) -> Result<Self> {
        let OnLattice {
            heights,
            confidence,
            bridges,
            noise,
        } = image.on_lattice(spacing)?;
        let input = Input {
            pixel_noise: Some(noise),
            ..Input::new(heights).already_bridged(bridges)
        };
        match confidence {
            Some(confidence) => input.with_confidence(confidence),
            None => Ok(input),
        }
    }

    /// Marks the input as bridged at a number of vertices, so that no further holes are bridged.
    pub(crate) fn already_bridged(self, bridged: usize) -> Self {
        Input {
            bridging: Bridging::Off,
            bridged,
            ..self
        }
    }

    /// Makes the input of a design, which has constraints alone (paper, Sec. 5.3): the surface passes through every
    /// height of `constraints` and is free where that is NaN. It covers the whole lattice, or the vertices where
    /// `shape` is not 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if `shape` is not one value for each vertex.
    pub fn design(constraints: Heightfield, shape: Option<&[u8]>) -> Result<Self> {
        let lattice = *constraints.lattice();
        let mut field = Heightfield::new(lattice, vec![0.0; lattice.len()])?;
        if let Some(shape) = shape {
            field = field.masked(shape)?;
        }
        Input::new(field)
            .with_bridging(Bridging::Off)?
            .with_confidence(vec![0.0; lattice.len()])?
            .with_constraints(constraints.into_heights())
    }

    /// Sets the confidence of each height: the factor of its fidelity term. 1 is the default and 0 discards the height.
    /// The range is 10⁻⁶ to 10⁶; smaller values count as 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one value for each vertex, [`Error::NotFinite`] or [`Error::Option`] if a value
    /// is not finite, below 0 or above 10⁶ where there is a height.
    pub fn with_confidence(mut self, mut confidence: Vec<f64>) -> Result<Self> {
        self.check_length("confidence", confidence.len())?;
        check_confidence(
            &confidence,
            self.field.heights(),
            self.field.lattice().cols(),
        )?;
        for weight in confidence
            .iter_mut()
            .filter(|weight| **weight < MIN_CONFIDENCE)
        {
            *weight = 0.0;
        }
        self.confidence = confidence;
        Ok(self)
    }

    /// Says that a camera has measured the heights: what is rough in them is noise, however large it is. Of other heights, such as
    /// those of a terrain or of a design, it may be their shape, to which a surface keeps that is chosen by default.
    pub fn measured_by_camera(mut self) -> Self {
        self.is_measured = true;
        self
    }

    /// Sets constraints: heights that are met exactly (paper, Sec. 5.3); NaN is no constraint. A constraint replaces
    /// the input height of its vertex. A constraint at a vertex without an input height is ignored, as the vertex is
    /// outside of the surface.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one value for each vertex,
    /// [`Error::NotFinite`] if one is infinite.
    pub fn with_constraints(mut self, constraints: Vec<f64>) -> Result<Self> {
        self.check_length("constraints", constraints.len())?;
        let lattice = *self.field.lattice();
        let mut heights = self.field.into_heights();
        for (height, constraint) in heights.iter_mut().zip(&constraints) {
            if !height.is_nan() && !constraint.is_nan() {
                *height = *constraint;
            }
        }
        self.field = Heightfield::new(lattice, heights)?;
        let both = self.field.heights().iter().zip(&constraints);
        self.constrained = both
            .map(|(height, z)| !height.is_nan() && !z.is_nan())
            .collect();
        Ok(self)
    }

    /// Sets the occlusions, where the surface is torn: no Hessian is evaluated there.
    ///
    /// # Errors
    /// [`Error::Shape`] if the occlusions are not of the same lattice.
    pub fn with_occlusions(mut self, occlusions: Occlusions) -> Result<Self> {
        self.check_length("occlusions", occlusions.vertices().len())?;
        self.occlusions = Some(occlusions);
        Ok(self)
    }

    /// Sets which holes are bridged when the solve is set up; default: those of up to 4 vertices across. A design has
    /// no holes to bridge.
    ///
    /// # Errors
    /// [`Error::Option`] if the bridging's width is out of range.
    pub fn with_bridging(mut self, bridging: Bridging) -> Result<Self> {
        bridging.width()?;
        self.bridging = bridging;
        Ok(self)
    }

    /// Restricts the surface to the vertices where `keep` is not 0. No hole is bridged elsewhere.
    ///
    /// # Errors
    /// [`Error::Shape`] if `keep` is not one value for each vertex.
    pub fn masked(mut self, keep: &[u8]) -> Result<Self> {
        self.field = self.field.masked(keep)?;
        self.outside = keep.iter().map(|keep| *keep == 0).collect();
        for (vertex, constrained) in self.constrained.iter_mut().enumerate() {
            *constrained &= !self.outside[vertex];
        }
        Ok(self)
    }

    /// Returns the input with means of the neighbours in place of spikes, single heights far from all around them, and with the
    /// confidence of bridged holes there. An input of an image stays as it is, as that is repaired before it is sampled; so does
    /// one whose caller says what is to be trusted.
    pub(crate) fn without_spikes(mut self) -> Result<Self> {
        let is_told = !self.confidence.is_empty() || !self.constrained.is_empty();
        if is_told || self.pixel_noise.is_some() || self.bridging == Bridging::Off {
            return Ok(self);
        }
        let spikes = spikes_on_lattice(&self.field)?;
        if spikes.is_empty() {
            return Ok(self);
        }
        let lattice = *self.field.lattice();
        self.confidence = try_filled("confidence", lattice.len(), 1.0)?;
        let mut heights = self.field.into_heights();
        let heights_before = spikes
            .iter()
            .map(|spike| heights[*spike])
            .collect::<Vec<_>>();
        spikes.iter().for_each(|spike| heights[*spike] = f64::NAN);
        for (spike, before) in spikes.iter().zip(heights_before) {
            let around = lattice.neighbours(spike / lattice.cols(), spike % lattice.cols());
            let around = around.into_iter().flatten();
            let around = around.map(|(row, col)| heights[lattice.index(row, col)]);
            let (sum, count) = (around.filter(|z| z.is_finite()))
                .fold((0.0, 0.0), |(sum, count), z| (sum + z, count + 1.0));
            // Spikes side by side take the mean of those before.
            heights[*spike] = if count > 0.0 { sum / count } else { before };
            self.confidence[*spike] = BRIDGE_CONFIDENCE;
        }
        self.bridged += spikes.len();
        self.field = Heightfield::new(lattice, heights)?;
        Ok(self)
    }

    /// Finds the domain of a solve: the roles of the input's vertices; occluded vertices have no Hessian.
    pub(crate) fn domain(&self) -> Result<Domain> {
        Domain::with_occlusions(&self.field, |vertex| self.is_occluded(vertex))
    }

    /// Returns the input with its small holes bridged, which fills their heights in.
    pub(crate) fn bridge(mut self) -> Result<Self> {
        let width = self.bridging.width()?;
        let surroundings = Surroundings {
            heights: self.field.heights(),
            confidence: &self.confidence,
            outside: &|v| self.outside.get(v) == Some(&true) || self.is_constrained(v),
            torn: &|v| self.is_occluded(v),
        };
        let bridges = surroundings.on_lattice(&self.field, width)?;
        self.bridging = Bridging::Off;
        self.bridged += bridges.len();
        if bridges.is_empty() {
            return Ok(self);
        }
        if self.confidence.is_empty() {
            self.confidence = try_filled("confidence", self.field.lattice().len(), 1.0)?;
        }
        let lattice = *self.field.lattice();
        let mut heights = self.field.into_heights();
        for bridge in &bridges {
            heights[bridge.index] = bridge.height;
            self.confidence[bridge.index] = bridge.confidence;
        }
        self.field = Heightfield::new(lattice, heights)?;
        Ok(self)
    }

    /// Heights of the input, with those of constraints.
    pub fn field(&self) -> &Heightfield {
        &self.field
    }

    fn check_length(&self, what: &'static str, found: usize) -> Result<()> {
        let lattice = self.field.lattice();
        check_shape(what, lattice.rows(), lattice.cols(), found)
    }

    /// Tells whether the rows, and the columns, of the image that the heights were sampled from had offsets.
    pub(crate) fn offset_lines(&self) -> [bool; 2] {
        self.pixel_noise
            .map_or([false; 2], |noise| noise.offset_lines)
    }

    /// Returns whether the height of a vertex is a constraint, which the surface meets exactly.
    pub(crate) fn is_constrained(&self, vertex: usize) -> bool {
        self.constrained.get(vertex) == Some(&true)
    }

    /// Confidence of a vertex's height: the weight of its fidelity term, relative to λ.
    pub(crate) fn weight(&self, vertex: usize) -> f64 {
        self.confidence.get(vertex).copied().unwrap_or(1.0)
    }

    /// Returns the confidence of a height, and 1 for a constraint.
    pub(crate) fn trust(&self, vertex: usize) -> f64 {
        match self.is_constrained(vertex) {
            true => 1.0,
            false => self.weight(vertex),
        }
    }

    /// Returns whether no height of the surface has a fidelity term, so that there are constraints and free vertices
    /// alone.
    pub(crate) fn is_design(&self) -> bool {
        let valid = |vertex: &usize| !self.field.heights()[*vertex].is_nan();
        let mut vertices = (0..self.field.heights().len()).filter(valid);
        vertices.all(|vertex| self.is_constrained(vertex) || self.weight(vertex) == 0.0)
    }

    /// Returns whether the height of some vertex of the surface has neither a fidelity term nor a constraint.
    pub(crate) fn has_free_vertices(&self) -> bool {
        let heights = self.field.heights().iter().enumerate();
        heights
            .filter(|(_, height)| !height.is_nan())
            .any(|(vertex, _)| !self.is_given(vertex))
    }

    /// Returns whether a vertex has a height that counts: with confidence, or as a constraint.
    pub(crate) fn is_given(&self, vertex: usize) -> bool {
        self.weight(vertex) > 0.0 || self.is_constrained(vertex)
    }

    /// Returns whether a vertex has no Hessian because of an occlusion.
    pub(crate) fn is_occluded(&self, vertex: usize) -> bool {
        self.occlusions
            .as_ref()
            .is_some_and(|occlusions| occlusions.vertices()[vertex] != 0)
    }
}

/// Checks that the confidence of every height, in rows of `cols`, is within its range.
pub fn check_confidence(confidence: &[f64], heights: &[f64], cols: usize) -> Result<()> {
    for (i, (weight, height)) in confidence.iter().zip(heights).enumerate() {
        if height.is_nan() {
            continue;
        }
        if !weight.is_finite() {
            return Err(Error::NotFinite {
                what: "confidence",
                value: *weight,
                row: i / cols,
                col: i % cols,
                advice: "0 means that a height is not to be trusted at all",
            });
        }
        if !(0.0..=MAX_CONFIDENCE).contains(weight) {
            return Err(Error::option(
                "confidence",
                format!(
                    "{} at row {}, column {}",
                    weight.readable(),
                    i / cols,
                    i % cols
                ),
                "must lie between 0 and 1e6; a height that must be met is a constraint",
            ));
        }
    }
    Ok(())
}

impl From<Heightfield> for Input {
    fn from(field: Heightfield) -> Self {
        Input::new(field)
    }
}

impl From<&Heightfield> for Input {
    fn from(field: &Heightfield) -> Self {
        Input::new(field.clone())
    }
}
