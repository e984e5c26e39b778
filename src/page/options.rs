//! Options of the search for a page in a photo: what is known about the page and its camera.

/// What is known about the camera's focal length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum FocalLength {
    /// The focal length is not known: it is assumed to be a usual one, and corrected by the perspective as far as
    /// that shows it.
    #[default]
    Unknown,
    /// The focal length is given in pixels of the photo.
    Pixels(f64),
    /// Field of view along the photo's longer side, in degrees.
    FieldOfView(f64),
    /// Focal length in millimetres of a camera for 35 mm film (36 by 24 mm) with the same diagonal field of view:
    /// Exif's `FocalLengthIn35mmFilm`.
    Film35(f64),
}

/// What is known about a page's size: its paper format, its width and height, or their ratio.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(
        rename_all = "camelCase",
        expecting = "expected `a4`, `letter` or width and height in millimetres"
    )
)]
#[non_exhaustive]
pub enum Format {
    /// The size is not known: the page's width is the unit of length.
    #[default]
    #[cfg_attr(feature = "serde", serde(skip))]
    Unknown,
    /// A4: 210 by 297 mm, portrait or landscape, whichever is nearer to the traced edges.
    A4,
    /// US letter: 8.5 by 11 inches, portrait or landscape, whichever is nearer to the traced edges.
    Letter,
    /// Ratio of the page's height to its width; the page's width is the unit of length.
    #[cfg_attr(feature = "serde", serde(skip))]
    Ratio(f64),
    /// Width and height of a page, in millimetres.
    #[cfg_attr(feature = "serde", serde(untagged))]
    Millimetres([f64; 2]),
}

/// A known distance on the flat page, which sets the scale in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(expecting = "{ from, to, length }: two places in the photo, and millimetres")
)]
pub struct Ruler {
    /// Position of the first end in the photo, in pixels.
    pub from: [f64; 2],
    /// Position of the second end in the photo, in pixels.
    pub to: [f64; 2],
    /// Distance between the ends on the flat page, in millimetres.
    pub length: f64,
}

/// Options of finding a page: what is known besides its edges.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct PageOptions {
    /// The camera's focal length, in pixels, as a field of view or in millimetres of 35 mm film. Default: unknown.
    pub focal_length: FocalLength,
    /// The page's format; of a spread that of each of its pages. Default: unknown.
    pub format: Format,
    /// A known distance on the page, for a page whose format is not known in millimetres.
    pub ruler: Option<Ruler>,
    /// The principal point, in pixels: in a photo that was cropped, the middle of the original one.
    /// Default: the photo's middle.
    pub centre: Option<[f64; 2]>,
}

impl PageOptions {
    /// Returns these options with another focal length of the camera.
    pub fn focal_length(self, focal_length: FocalLength) -> Self {
        PageOptions {
            focal_length,
            ..self
        }
    }

    /// Returns these options with another format of the page.
    pub fn format(self, format: Format) -> Self {
        PageOptions { format, ..self }
    }

    /// Returns these options with a known distance on the page.
    pub fn ruler(self, ruler: Ruler) -> Self {
        PageOptions {
            ruler: Some(ruler),
            ..self
        }
    }

    /// Returns these options with another principal point, in pixels.
    pub fn centre(self, centre: [f64; 2]) -> Self {
        PageOptions {
            centre: Some(centre),
            ..self
        }
    }
}
