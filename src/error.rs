//! Everything that can be wrong with an input, an option or a file.

mod readable;

pub use readable::{Readable, rounded};

use readable::count;
use thiserror::Error;

/// The crate's result type.
pub type Result<T> = std::result::Result<T, Error>;

/// What was wrong, where, and what to do about it.
///
/// An optimisation that was cancelled or ran out of iterations is no error: it
/// is a [`StopReason`](crate::StopReason) of its report. [`Error::code`] gives
/// each variant a name that stays the same across versions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// There are no values at all.
    #[error("{what} is empty: it needs at least one row and one column")]
    Empty {
        /// What was being read, for example `"height image"`.
        what: &'static str,
    },

    /// The number of values does not match the stated shape, or rows differ in length.
    #[error(
        "{what}: there are {found} values, and its shape of {} × {} (rows × columns) needs {}; \
         every row must be equally long and the shape must match the data",
        count(*.rows), count(*.cols), count(*.expected)
    )]
    Shape {
        /// What was being read.
        what: &'static str,
        /// Rows stated or found.
        rows: usize,
        /// Columns stated, or the length of the first row.
        cols: usize,
        /// Values that the shape needs.
        expected: usize,
        /// Values there are.
        found: usize,
    },

    /// A value that must be finite is not.
    #[error("{what} is {} at row {row}, column {col}; {advice}", .value.readable())]
    NotFinite {
        /// What was being read.
        what: &'static str,
        /// The offending value: an infinity or NaN.
        value: f64,
        /// Row, counted from 0 at the top.
        row: usize,
        /// Column, counted from 0 at the left.
        col: usize,
        /// What to do instead.
        advice: &'static str,
    },

    /// No vertex has a height and six neighbours with heights, so there is nothing to solve.
    #[error(
        "no interior vertex: of {valid} valid vertices on a lattice of {rows} rows by {cols} \
         columns none has all six neighbours valid and no occlusion; use a finer spacing, a larger \
         input, a mask with fewer holes or a higher threshold for occlusions"
    )]
    NoInterior {
        /// Rows of the lattice.
        rows: usize,
        /// Columns of the lattice.
        cols: usize,
        /// Vertices with a height.
        valid: usize,
    },

    /// A connected part of the surface that its constraints and fidelity do not hold in place.
    #[error(
        "the part of the surface around row {row}, column {col} ({vertices} vertices) is not held \
         in place: it needs heights at three vertices that are not on a line, as constraints or \
         with a confidence above 0; add some, or mask the part out"
    )]
    Underdetermined {
        /// Row of its first vertex.
        row: usize,
        /// Column of its first vertex.
        col: usize,
        /// Number of its vertices.
        vertices: usize,
    },

    /// Two things that must be of one surface are of two.
    #[error(
        "{what} are those of another surface: they differ at row {row}, column {col}; take those of \
         this very surface"
    )]
    Mismatch {
        /// What belongs to another surface, for example `"patches"`.
        what: &'static str,
        /// Row of the first vertex where that shows.
        row: usize,
        /// Column of it.
        col: usize,
    },

    /// An option is outside its range.
    #[error("option `{name}` is {value}, but {requirement}")]
    Option {
        /// The option's name, as in Rust and JS.
        name: &'static str,
        /// The value given.
        value: String,
        /// What it must be.
        requirement: &'static str,
    },

    /// Traced edges that cannot be those of a page.
    #[error("these edges are no page's: {reason}")]
    Edges {
        /// What is wrong with them, and what to do.
        reason: String,
    },

    /// No page can be told from its ground in a photo.
    #[error(
        "no page was found in the photo; trace its edges, or take the photo anew, with the whole \
         page on a ground of another colour"
    )]
    NoPage,

    /// The focal length of a photo is not known and cannot be found.
    #[error(
        "the camera's focal length cannot be found from these edges, for they show too little \
         perspective; give it in pixels, as Exif's focal length in 35 mm film, or as a field of \
         view, or give the page's format"
    )]
    FocalLength,

    /// Triangles that make no surface, or one with nothing inside.
    #[error("this mesh is no surface that can be fitted: {reason}; {advice}")]
    Topology {
        /// What is wrong with it, and where.
        reason: String,
        /// What to do about it.
        advice: &'static str,
    },

    /// A part of the surface that no cut makes flat within the limits that were asked for.
    #[error(
        "the part of the surface around row {row}, column {col} ({vertices} vertices) cannot be laid \
         flat: {reason}; smooth the surface more (a smaller lambda), take larger patches or allow \
         more strain"
    )]
    NotFlat {
        /// Row of a vertex in its middle.
        row: usize,
        /// Column of it.
        col: usize,
        /// Number of its vertices.
        vertices: usize,
        /// What cannot be met, and by how much.
        reason: String,
    },

    /// The energy of the input is not a finite number.
    #[error(
        "the energy overflows: the heights are too large for a lattice spacing of {}; \
         check the units of the heights and of the spacing",
        .spacing.readable()
    )]
    Overflow {
        /// The lattice spacing, in the input's units.
        spacing: f64,
    },

    /// The energy of the input is so small that its squares would be lost.
    #[error(
        "the energy underflows: the heights are too small for a lattice spacing of {}; \
         check the units of the heights and of the spacing",
        .spacing.readable()
    )]
    Underflow {
        /// The lattice spacing, in the input's units.
        spacing: f64,
    },

    /// More memory would be needed than the limit allows or the machine has.
    /// Raised before anything of that size is allocated.
    #[error(
        "{what} needs {} cells, more than the limit of {}; use a coarser spacing, a lower resolution or a smaller input",
        count(*.requested), count(*.limit)
    )]
    TooLarge {
        /// What would have been allocated.
        what: &'static str,
        /// Cells (vertices or pixels) asked for.
        requested: usize,
        /// Cells allowed.
        limit: usize,
    },

    /// The machine could not provide the memory, though it is within the limit.
    #[error("out of memory while allocating {} bytes for {what}; use a coarser spacing", count(*.bytes))]
    OutOfMemory {
        /// What was being allocated.
        what: &'static str,
        /// Its size in bytes.
        bytes: usize,
    },

    /// A file is damaged, cut short or not what its name says.
    #[error("cannot read this as {format}: {reason}")]
    Format {
        /// The format that was tried.
        format: &'static str,
        /// What the decoder found.
        reason: String,
    },

    /// A well-formed file that holds something this library does not read or write.
    #[error("{format}: {reason}")]
    Unsupported {
        /// The format.
        format: &'static str,
        /// What is not supported, and what is.
        reason: String,
    },
}

impl Error {
    /// A stable, upper-case name for the variant: the `code` of the JS error.
    pub fn code(&self) -> &'static str {
        match self {
            Error::Empty { .. } => "EMPTY",
            Error::Shape { .. } => "SHAPE",
            Error::NotFinite { .. } => "NOT_FINITE",
            Error::NoInterior { .. } => "NO_INTERIOR",
            Error::Underdetermined { .. } => "UNDERDETERMINED",
            Error::Mismatch { .. } => "MISMATCH",
            Error::Option { .. } => "OPTION",
            Error::Edges { .. } => "EDGES",
            Error::NoPage => "NO_PAGE",
            Error::FocalLength => "FOCAL_LENGTH",
            Error::Topology { .. } => "TOPOLOGY",
            Error::NotFlat { .. } => "NOT_FLAT",
            Error::Overflow { .. } => "OVERFLOW",
            Error::Underflow { .. } => "UNDERFLOW",
            Error::TooLarge { .. } => "TOO_LARGE",
            Error::OutOfMemory { .. } => "OUT_OF_MEMORY",
            Error::Format { .. } => "FORMAT",
            Error::Unsupported { .. } => "UNSUPPORTED",
        }
    }

    /// Edges that are no page's.
    pub(crate) fn edges(reason: &str) -> Self {
        Error::Edges {
            reason: reason.to_string(),
        }
    }

    /// A mesh whose size, in the unit of its coordinates, is 0 or cannot be computed with.
    pub(crate) fn mesh_size(size: f64) -> Self {
        let reason = match size == 0.0 {
            true => "all its vertices are in one place",
            false => "its coordinates are too large or too small to compute with",
        };
        Error::Topology {
            reason: reason.into(),
            advice: "check its coordinates and their unit",
        }
    }

    /// An option out of its range, by its name.
    pub fn option(name: &'static str, value: impl Readable, requirement: &'static str) -> Self {
        Error::Option {
            name,
            value: value.readable(),
            requirement,
        }
    }
}

/// Most cells (lattice vertices or pixels) that one input may have: 5 · 2²², room for an image of
/// 4096 × 4096 pixels and for its lattice, which has 2/√3 times as many vertices. The solver holds
/// them in less than the 4 GiB that a wasm32 memory can grow to.
pub const MAX_CELLS: usize = 5 << 22;

/// `rows · cols`, if neither overflows nor exceeds [`MAX_CELLS`].
pub(crate) fn checked_cells(what: &'static str, rows: usize, cols: usize) -> Result<usize> {
    let requested = rows.saturating_mul(cols);
    if requested > MAX_CELLS {
        return Err(Error::TooLarge {
            what,
            requested,
            limit: MAX_CELLS,
        });
    }
    Ok(requested)
}

/// Whether `found` values fill a shape within [`MAX_CELLS`].
pub fn check_shape(what: &'static str, rows: usize, cols: usize, found: usize) -> Result<()> {
    checked_cells(what, rows, cols)?;
    check_count(what, rows, cols, found)
}

/// Whether `found` values fill a shape of any size.
pub fn check_count(what: &'static str, rows: usize, cols: usize, found: usize) -> Result<()> {
    let expected = rows.saturating_mul(cols);
    if found == expected {
        return Ok(());
    }
    Err(Error::Shape {
        what,
        rows,
        cols,
        expected,
        found,
    })
}

/// A vector of `len` copies of `value`, with a failed allocation as an error.
pub fn try_filled<T: Clone>(what: &'static str, len: usize, value: T) -> Result<Vec<T>> {
    let mut out = Vec::new();
    out.try_reserve_exact(len).map_err(|_| Error::OutOfMemory {
        what,
        bytes: len.saturating_mul(size_of::<T>()),
    })?;
    out.resize(len, value);
    Ok(out)
}

/// `value` itself if it is finite and above zero.
pub fn positive(name: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(Error::option(
            name,
            value,
            "must be a finite number above zero",
        ))
    }
}
