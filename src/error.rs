//! Everything that can be wrong with an input, an option or a file.

mod readable;

pub use readable::{Readable, rounded};

use readable::count;
use thiserror::Error;

/// Result type of this library, whose error is an [`enum@Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// An error of this library: what was wrong, where, and what to do about it.
///
/// An optimisation that was cancelled or ran out of iterations is no error: it is a [`StopReason`](crate::StopReason)
/// of its report. [`Error::code`] gives each variant a name that stays the same across versions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// An input has nothing in it.
    #[error("{what} is empty: there is nothing in it to work with")]
    Empty {
        /// Name of the array that was being read, for example `"height image"`.
        what: &'static str,
    },

    /// The number of an input array's values does not match its stated shape, or its rows differ in length.
    #[error(
        "{what}: there are {found} values, and its shape of {} × {} (rows × columns) needs {}; \
         every row must be equally long and the shape must match the data",
        count(*.rows), count(*.cols), count(*.expected)
    )]
    Shape {
        /// Name of the array that was being read, for example `"height image"`.
        what: &'static str,
        /// Number of rows, as stated or as found.
        rows: usize,
        /// Number of columns as stated, or the length of the first row.
        cols: usize,
        /// Number of values that an array of that shape has.
        expected: usize,
        /// Number of values that were given.
        found: usize,
    },

    /// A value of an input array that must be finite is infinite or NaN.
    #[error("{what} is {} at row {row}, column {col}; {advice}", .value.readable())]
    NotFinite {
        /// Name of the array that was being read, for example `"height image"`.
        what: &'static str,
        /// The first value that is not finite: an infinity or NaN.
        value: f64,
        /// Row of the value that is not finite, counted from 0 at the top.
        row: usize,
        /// Column of the value that is not finite, counted from 0 at the left.
        col: usize,
        /// What the user can give instead, as the end of the message.
        advice: &'static str,
    },

    /// No vertex has both a height and six neighbours with heights, so that there is no surface to solve for.
    #[error("{}", no_interior([*rows, *cols], *valid))]
    NoInterior {
        /// Number of rows of the lattice.
        rows: usize,
        /// Number of columns of the lattice.
        cols: usize,
        /// Number of vertices with a height.
        valid: usize,
    },

    /// A connected part of the surface can tilt or move, because it has no three given heights that are not on one
    /// line.
    #[error(
        "the part of the surface around row {row}, column {col} ({vertices} vertices) is not held \
         in place: it needs heights at three vertices that are not on a line, as constraints or \
         with a confidence above 0; add some, or mask the part out"
    )]
    Underdetermined {
        /// Lattice row of the part's first vertex.
        row: usize,
        /// Lattice column of the part's first vertex.
        col: usize,
        /// Number of the part's vertices.
        vertices: usize,
    },

    /// Two arguments that must belong to one surface, such as a surface and its patches, belong to two.
    #[error(
        "{what} are those of another surface: they differ at row {row}, column {col}; take those of \
         this very surface"
    )]
    Mismatch {
        /// Name of the argument that belongs to another surface, for example `"patches"`.
        what: &'static str,
        /// Lattice row of the first vertex at which the two differ.
        row: usize,
        /// Lattice column of the first vertex at which the two differ.
        col: usize,
    },

    /// An option's value is outside its range.
    #[error("option `{name}` is {value}, but {requirement}")]
    Option {
        /// The option's name, as in Rust and JavaScript.
        name: &'static str,
        /// The value that was given, as text.
        value: String,
        /// What the value has to be, for example `"must be a finite number above zero"`.
        requirement: &'static str,
    },

    /// Edges traced in a photo cannot be the edges of one page.
    #[error("these edges do not outline a page: {reason}")]
    Edges {
        /// What is wrong with the edges, and what to do about it.
        reason: String,
    },

    /// A fold is curved, so that sheet metal cannot be bent along it.
    #[error(
        "fold {fold} of sheet {sheet} is curved, and a bend allowance needs straight ones; without a thickness it is \
         drawn as it is"
    )]
    CurvedFold {
        /// Number of the sheet, from 1.
        sheet: usize,
        /// Number of the fold on the sheet, from 1.
        fold: usize,
    },

    /// No page can be told from the background in a photo.
    #[error(
        "no page was found in the photo; trace its edges, or take the photo again with the whole page \
         on a contrasting background"
    )]
    NoPage,

    /// The triangles of a mesh make no surface that can be fitted, or one without interior vertices.
    #[error("this mesh is no surface that can be fitted: {reason}; {advice}")]
    Topology {
        /// What is wrong with the mesh, and where.
        reason: String,
        /// What to do about the fault in the mesh.
        advice: &'static str,
    },

    /// A part of a surface stays strained too much however it is cut, within the limits that the options set.
    #[error(
        "the part of the surface around {place} ({vertices} vertices) cannot be laid flat: {reason}; smooth the \
         surface more (a smaller lambda), take larger patches or allow more strain"
    )]
    NotFlat {
        /// A place on the part: row and column of a lattice, or coordinates on a mesh.
        place: String,
        /// Number of the part's vertices.
        vertices: usize,
        /// The limit that is not met, and by how much.
        reason: String,
    },

    /// The energy of the input is not a finite number, because its heights are too large for the lattice's spacing.
    #[error(
        "the energy overflows: the heights are too large for a lattice spacing of {}; \
         check the units of the heights and of the spacing",
        .spacing.readable()
    )]
    Overflow {
        /// Distance between neighbouring lattice vertices, in the input's unit of length.
        spacing: f64,
    },

    /// The energy of the input is so small that squared values would round to zero.
    #[error(
        "the energy underflows: the heights are too small for a lattice spacing of {}; \
         check the units of the heights and of the spacing",
        .spacing.readable()
    )]
    Underflow {
        /// Distance between neighbouring lattice vertices, in the input's unit of length.
        spacing: f64,
    },

    /// An array would have more cells than [`MAX_CELLS`], or than the machine has memory for; raised before it is
    /// allocated.
    #[error(
        "{what} needs {} cells, more than the limit of {}; use a coarser spacing, a lower resolution or a smaller input",
        count(*.requested), count(*.limit)
    )]
    TooLarge {
        /// Name of the array that would have been allocated.
        what: &'static str,
        /// Number of cells (vertices or pixels) that were asked for.
        requested: usize,
        /// Maximum number of cells that one array may have.
        limit: usize,
    },

    /// The machine could not provide the memory for an array, though its size is within the limit.
    #[error("out of memory while allocating {} bytes for {what}; use a coarser spacing, a lower resolution or a smaller input", count(*.bytes))]
    OutOfMemory {
        /// Name of the array that was being allocated.
        what: &'static str,
        /// Size of the array in bytes.
        bytes: usize,
    },

    /// A file is damaged, cut short or not of the format that it was read as.
    #[error("cannot read this as {format}: {reason}")]
    Format {
        /// Name of the file format that was tried, for example `"PNG"`.
        format: &'static str,
        /// What the decoder found wrong with the bytes.
        reason: String,
    },

    /// A well-formed file holds something that this library does not read or write.
    #[error("{format}: {reason}")]
    Unsupported {
        /// Name of the file format, for example `"PNG"`.
        format: &'static str,
        /// What of the format is not supported, and what is.
        reason: String,
    },
}

impl Error {
    /// Returns a stable, upper-case name for the variant, such as `"NO_PAGE"`: the `code` of the JavaScript error.
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
            Error::CurvedFold { .. } => "CURVED_FOLD",
            Error::NoPage => "NO_PAGE",
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

    /// Makes an [`Error::Edges`] with the reason why traced edges cannot be a page's.
    pub(crate) fn edges(reason: impl Into<String>) -> Self {
        Error::Edges {
            reason: reason.into(),
        }
    }

    /// Makes the [`Error::Topology`] of a mesh whose size (in the unit of its coordinates) is 0, not finite or too
    /// small.
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

    /// Makes an [`Error::Option`] from the option's name, the value given, and what it has to be.
    pub fn option(name: &'static str, value: impl Readable, requirement: &'static str) -> Self {
        Error::Option {
            name,
            value: value.readable(),
            requirement,
        }
    }
}

/// Maximum number of cells (lattice vertices or pixels) of one input: 5 · 2²², room for an image of 4096 × 4096 pixels
/// and for its lattice, which has 2/√3 times as many vertices. The solver holds them in less than the 4 GiB that a
/// wasm32 memory can grow to.
pub const MAX_CELLS: usize = 5 << 22;

/// Maximum number of pixels of one photo and of a flat image: 25 · 2²⁰, as cameras of 26 megapixels have. Nothing is solved at
/// them, so that there may be more than [`MAX_CELLS`].
pub const MAX_PHOTO_PIXELS: usize = 25 << 20;

/// Says why a lattice has no vertex to solve for.
fn no_interior([rows, cols]: [usize; 2], valid: usize) -> String {
    let lattice = format!("a lattice of {rows} rows by {cols} columns");
    match valid {
        0 => format!(
            "there is no height: no vertex of {lattice} has one; check which values stand for no data, and the mask"
        ),
        _ => format!(
            "no interior vertex: of {valid} valid vertices on {lattice} none has all six neighbours valid and no occlusion; use a \
             finer spacing, a larger input, a mask with fewer holes or a higher threshold for occlusions"
        ),
    }
}

/// Checks that a photo has `4 · rows · cols` bytes and at most `MAX_PHOTO_PIXELS` pixels. `what` names it, `found` is the
/// number of pixels that its bytes are.
pub fn check_photo(what: &'static str, rows: usize, cols: usize, found: usize) -> Result<()> {
    checked_pixels(what, rows, cols)?;
    check_count(what, rows, cols, found)
}

/// Returns `rows · cols`, or [`Error::TooLarge`] if that exceeds [`MAX_PHOTO_PIXELS`]. `what` names the photo.
pub(crate) fn checked_pixels(what: &'static str, rows: usize, cols: usize) -> Result<usize> {
    let (requested, limit) = (rows.saturating_mul(cols), MAX_PHOTO_PIXELS);
    if requested > limit {
        return Err(Error::TooLarge {
            what,
            requested,
            limit,
        });
    }
    Ok(requested)
}

/// Returns `rows · cols`, or [`Error::TooLarge`] if that exceeds [`MAX_CELLS`]. `what` names the array.
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

/// Checks that an array has `rows · cols` values and at most [`MAX_CELLS`] of them. `what` names the array, `found` is
/// the number of values it has.
pub fn check_shape(what: &'static str, rows: usize, cols: usize, found: usize) -> Result<()> {
    checked_cells(what, rows, cols)?;
    check_count(what, rows, cols, found)
}

/// Checks that an array has `rows · cols` values, without a limit to their number. `what` names the array, `found` is
/// the number of values it has.
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

/// Makes a vector of `len` copies of `value`, or returns [`Error::OutOfMemory`] if there is no room for it. `what` names
/// the array. Where another thread takes the room meanwhile, the process aborts.
pub fn try_filled<T: Clone>(what: &'static str, len: usize, value: T) -> Result<Vec<T>> {
    // Whether there is room is asked first, so that `vec!` may take memory that the system has cleared: threads touch
    // its pages when they first write there, side by side, instead of one thread here.
    let mut room: Vec<T> = Vec::new();
    room.try_reserve_exact(len)
        .map_err(|_| Error::OutOfMemory {
            what,
            bytes: len.saturating_mul(size_of::<T>()),
        })?;
    drop(room);
    Ok(vec![value; len])
}

/// Returns an option's value if it is finite and above zero, or [`Error::Option`]. `name` is the option's.
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
