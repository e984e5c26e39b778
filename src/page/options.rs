//! What is known of a page and its camera.

/// What is known of the camera's focal length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum FocalLength {
    /// Nothing: it is found from the perspective, if that is strong enough.
    #[default]
    Unknown,
    /// In pixels of the photo.
    Pixels(f64),
    /// As the angle, in degrees, that the photo's longer side covers.
    FieldOfView(f64),
    /// In millimetres, as for a film of 36 by 24 mm with the same diagonal angle: Exif's
    /// `FocalLengthIn35mmFilm`. Such numbers are taken to be right to 2 %.
    Film35(f64),
}

/// What is known of a page's size.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Format {
    /// Nothing: the page's width is the unit of length.
    #[default]
    Unknown,
    /// 210 by 297 mm, upright or across, whichever is nearer to what is seen.
    A4,
    /// 8.5 by 11 inches, likewise.
    Letter,
    /// Width and height of a page, in millimetres.
    Millimetres([f64; 2]),
    /// Height over width; the page's width is the unit of length.
    Ratio(f64),
}

/// A known distance on the flat page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ruler {
    /// Where it begins in the photo, in pixels.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// Its length, in millimetres.
    pub length: f64,
}

/// What is known besides the edges.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct PageOptions {
    /// The camera's focal length. Default: unknown.
    pub focal_length: FocalLength,
    /// The page's format; of a spread that of each of its pages. Default: unknown.
    pub format: Format,
    /// A known length on the page, where its format is not known in millimetres.
    pub ruler: Option<Ruler>,
    /// The principal point, in pixels; of a photo that was cropped, the middle of the whole one.
    /// Default: the photo's middle, right to 0.4 % of the diagonal.
    pub centre: Option<[f64; 2]>,
    /// How near to the edge traced points are meant to lie, as a standard deviation in pixels; the
    /// points' own scatter corrects it. Default: 1/2500 of the photo's diagonal, 2 pixels of a
    /// 12-megapixel photo.
    pub accuracy: Option<f64>,
}

impl PageOptions {
    /// These options with another focal length.
    pub fn focal_length(self, focal_length: FocalLength) -> Self {
        PageOptions {
            focal_length,
            ..self
        }
    }

    /// These options with another format.
    pub fn format(self, format: Format) -> Self {
        PageOptions { format, ..self }
    }

    /// These options with a ruler.
    pub fn ruler(self, ruler: Ruler) -> Self {
        PageOptions {
            ruler: Some(ruler),
            ..self
        }
    }

    /// These options with another principal point.
    pub fn centre(self, centre: [f64; 2]) -> Self {
        PageOptions {
            centre: Some(centre),
            ..self
        }
    }

    /// These options with another accuracy.
    pub fn accuracy(self, accuracy: f64) -> Self {
        PageOptions {
            accuracy: Some(accuracy),
            ..self
        }
    }
}
