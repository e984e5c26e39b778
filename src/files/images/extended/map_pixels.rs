//! How large the pixels of an image are on a map, in metres, and how they lie there.

use crate::files::images::decoded::differ;
use crate::files::images::georeference::Georeference;

/// Number of the key `GTModelTypeGeoKey` of the GeoTIFF format, which tells whether coordinates are lengths or degrees.
const MODEL_TYPE_KEY: u16 = 1024;
/// Value of the key `GTModelTypeGeoKey` of the GeoTIFF format for degrees of longitude and latitude.
const MODEL_TYPE_GEOGRAPHIC: u16 = 2;
/// Number of the key `ProjectedCSTypeGeoKey` of the GeoTIFF format, the coordinate system of a map by its number in EPSG.
const MAP_SYSTEM_KEY: u16 = 3072;
/// Value of the key `ProjectedCSTypeGeoKey` of the GeoTIFF format for the Web Mercator map, whose coordinates are lengths on the equator.
const WEB_MERCATOR: u16 = 3857;
/// Number of the key `ProjLinearUnitsGeoKey` of the GeoTIFF format, the unit of map coordinates.
const LINEAR_UNIT_KEY: u16 = 3076;
/// Number of the key `ProjLinearUnitSizeGeoKey` of the GeoTIFF format, the length of that unit in metres if it has no number.
const LINEAR_UNIT_SIZE_KEY: u16 = 3077;
/// Number of the key `GeogAngularUnitsGeoKey` of the GeoTIFF format, the unit of longitudes and latitudes.
const ANGULAR_UNIT_KEY: u16 = 2054;
/// Number of the key `GeogAngularUnitSizeGeoKey` of the GeoTIFF format, the size of that unit in radians if it has no number.
const ANGULAR_UNIT_SIZE_KEY: u16 = 2055;
/// Sizes of angular units in degrees, by their numbers in the GeoTIFF format: radian, degree, minute and second of arc, grad and gon.
const UNIT_DEGREES: [(u16, f64); 6] = [
    (9101, 57.295_779_513_082_32),
    (9102, 1.0),
    (9103, 1.0 / 60.0),
    (9104, 1.0 / 3600.0),
    (9105, 0.9),
    (9106, 0.9),
];
/// Number of the TIFF tag `GeoDoubleParams`, which holds the values of some keys of the GeoTIFF format.
const DOUBLES_TAG: u16 = 34_736;
/// Number of the key `VerticalUnitsGeoKey` of the GeoTIFF format, the unit of heights.
const VERTICAL_UNIT_KEY: u16 = 4099;
/// Number of the key `VerticalGeoKey` of the GeoTIFF format, the coordinate system of heights.
const VERTICAL_SYSTEM_KEY: u16 = 4096;
/// Coordinate systems of heights in feet, by their numbers in EPSG, which the GeoTIFF format takes, and the numbers of their units: NAVD 88, NGVD 29 and mean sea
/// level. GDAL names the system alone.
const HEIGHTS_IN_FEET: [(u16, u16); 5] = [
    (6360, 9003),
    (8228, 9002),
    (5702, 9003),
    (8050, 9002),
    (8052, 9003),
];
/// Lengths of units in metres, by their numbers in the GeoTIFF format: metre, international foot, US survey foot.
const UNIT_METRES: [(u16, f64); 3] = [(9001, 1.0), (9002, 0.3048), (9003, 1200.0 / 3937.0)];
/// Ends of the names of coordinate systems in feet, as EPSG has them, and the numbers of their units in the GeoTIFF format.
const UNIT_NAMES: [(&str, u16); 2] = [("(ftUS)", 9003), ("(ft)", 9002)];
/// Semi-major axis of the ellipsoid of the specification WGS 84, in metres.
const ELLIPSOID_AXIS_METRES: f64 = 6_378_137.0;
/// Square of the first eccentricity of the ellipsoid of the specification WGS 84.
const ELLIPSOID_ECCENTRICITY_SQUARED: f64 = 0.006_694_379_990_14;
/// Keys of the GeoTIFF format for degrees on WGS 84 (EPSG 4326) at the middles of pixels.
const WGS84_KEYS: [u16; 16] = [1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 2, 2048, 0, 1, 4326];

impl Georeference {
    /// Creates the georeference of pixels whose place on a map is given, in the coordinate system that keys of the GeoTIFF format
    /// name.
    pub(super) fn new(transformation: [f64; 6], keys: &[u16]) -> Self {
        Georeference {
            transformation,
            keys: keys.into(),
            doubles: Vec::new(),
            text: String::new(),
            size: None,
        }
    }

    /// Whether the image lies elsewhere than at the origin, upright.
    pub(super) fn has_place(&self) -> bool {
        let [_, b, c, d, _, f] = self.transformation;
        [b, c, d, f] != [0.0; 4]
    }

    /// Value of a GeoTIFF key that is stored among the numbers of the tag `GeoDoubleParams`.
    pub(super) fn number(&self, wanted: u16) -> Option<f64> {
        let mut entries = self.keys.chunks_exact(4).skip(1);
        let entry = entries.find(|entry| entry[..2] == [wanted, DOUBLES_TAG])?;
        self.doubles.get(usize::from(entry[3])).copied()
    }

    /// Creates the georeference of pixels of degrees of longitude and latitude, of which the first has its middle in the north-west.
    pub(super) fn of_degrees([west, north]: [f64; 2], [across, down]: [f64; 2]) -> Self {
        Georeference::new([across, 0.0, west, 0.0, -down, north], &WGS84_KEYS)
    }

    /// Whether map coordinates are longitudes and latitudes.
    pub(super) fn is_geographic(&self) -> bool {
        self.key(MODEL_TYPE_KEY) == Some(MODEL_TYPE_GEOGRAPHIC)
    }

    /// Size of the unit of longitudes and latitudes in degrees, which are the unit that goes without saying.
    pub(super) fn angular_unit(&self) -> f64 {
        let mut known = UNIT_DEGREES.into_iter();
        let number = self.key(ANGULAR_UNIT_KEY);
        let size = known.find_map(|(unit, size)| (Some(unit) == number).then_some(size));
        let size = size.or_else(|| self.number(ANGULAR_UNIT_SIZE_KEY).map(f64::to_degrees));
        size.unwrap_or(1.0)
    }

    /// Length of the unit of map coordinates in metres, if the file says it.
    pub(super) fn linear_unit(&self) -> Option<f64> {
        // GDAL leaves the unit out of systems with heights, whose name has it.
        let map_name = self.text.split('+').next().unwrap_or_default();
        let named = || {
            let mut units = UNIT_NAMES.into_iter();
            units.find_map(|(name, unit)| map_name.contains(name).then_some(unit))
        };
        let unit = self.key(LINEAR_UNIT_KEY).or_else(named)?;
        metres(unit).or_else(|| self.number(LINEAR_UNIT_SIZE_KEY))
    }

    /// Length of the unit of heights in metres, if the file says it.
    pub(super) fn vertical_unit(&self) -> Option<f64> {
        let system = || {
            let system = self.key(VERTICAL_SYSTEM_KEY)?;
            let mut known = HEIGHTS_IN_FEET.into_iter();
            known.find_map(|(number, unit)| (number == system).then_some(unit))
        };
        metres(self.key(VERTICAL_UNIT_KEY).or_else(system)?)
    }

    /// Latitude of the middle of an image of the given size, in degrees, if the unit of coordinates has other lengths elsewhere:
    /// degrees, and the unit of a Web Mercator map.
    pub(super) fn latitude(&self, (width, height): (usize, usize)) -> Option<f64> {
        let [.., d, e, f] = self.transformation;
        let ends = f64::from(u8::from(self.is_point()));
        let [i, j] = [width, height].map(|side| 0.5 * (side as f64 - ends));
        let north = d * i + e * j + f;
        if self.is_geographic() {
            return Some(north * self.angular_unit());
        }
        let on_sphere = (north / ELLIPSOID_AXIS_METRES).sinh().atan();
        (self.key(MAP_SYSTEM_KEY) == Some(WEB_MERCATOR)).then_some(on_sphere.to_degrees())
    }

    /// Width and height of a pixel: in metres where the latitude counts, else in the unit of map coordinates.
    pub(super) fn pixel_sides(&self, size: (usize, usize)) -> [f64; 2] {
        let [a, b, _, d, e, _] = self.transformation;
        let [x, y] = match self.latitude(size) {
            Some(latitude) if self.is_geographic() => {
                metres_per_degree(latitude).map(|degree| degree * self.angular_unit())
            }
            // The map is that of a sphere: its degree of longitude is that of the equator everywhere.
            Some(latitude) => {
                let [x, y] = metres_per_degree(latitude);
                let degree = ELLIPSOID_AXIS_METRES.to_radians();
                [x / degree, y / degree * latitude.to_radians().cos()]
            }
            None => [1.0, 1.0],
        };
        [(a * x).hypot(d * y), (b * x).hypot(e * y)]
    }

    /// Returns the mean of the width and height of a pixel of an image of `size` columns and rows, in metres where the file says
    /// the unit.
    pub fn pixel_size(&self, size: (usize, usize)) -> f64 {
        let [x, y] = self.pixel_sides(size);
        0.5 * (x + y) * self.linear_unit().unwrap_or(1.0)
    }

    /// Returns the georeference with pixels of the given side length, where they have another one. The first pixel stays where
    /// it is.
    pub(super) fn with_pixel_size(&self, size: (usize, usize), side: f64) -> Georeference {
        let unit = self.linear_unit().unwrap_or(1.0);
        let mut map = self.clone();
        // Degrees have other lengths at the latitude of the new middle.
        for _ in 0..3 {
            if differ([map.pixel_size(size), side]) {
                map.scale_pixels(map.pixel_sides(size).map(|own| side / (own * unit)));
            }
        }
        map
    }

    /// Whether the image is a mirror image of the map, as with rows from south to north.
    pub(super) fn is_mirrored(&self) -> bool {
        let [a, b, _, d, e, _] = self.transformation;
        a * e - b * d > 0.0
    }

    /// Reverses the rows of an image of `height` rows.
    pub(super) fn reverse_rows(&mut self, height: usize) {
        let height = height - usize::from(self.is_point());
        let [_, b, c, _, e, f] = &mut self.transformation;
        *c += *b * height as f64;
        *f += *e * height as f64;
        (*b, *e) = (-*b, -*e);
    }
}

/// Length of a unit in metres, by its number in GeoTIFF keys.
fn metres(unit: u16) -> Option<f64> {
    (UNIT_METRES.into_iter()).find_map(|(number, length)| (number == unit).then_some(length))
}

/// Lengths of a degree of longitude and of latitude on the ellipsoid, in metres, at a latitude in degrees.
fn metres_per_degree(latitude: f64) -> [f64; 2] {
    let (sin, cos) = latitude.to_radians().sin_cos();
    let w = 1.0 - ELLIPSOID_ECCENTRICITY_SQUARED * sin * sin;
    let radius = ELLIPSOID_AXIS_METRES / w.sqrt();
    [
        radius * cos,
        radius * (1.0 - ELLIPSOID_ECCENTRICITY_SQUARED) / w,
    ]
    .map(f64::to_radians)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_have_the_lengths_of_the_ground() {
        // A degree on WGS 84 at 45 degrees has 78.847 km and 111.132 km, and 50 grads, as GDAL writes NTF (Paris), are 45 degrees. 60° N
        // is 8,399,737.89 on the Web Mercator map (EPSG's Guidance Note 7-2), and a degree there 55.800 km by 111.412 km on the ground.
        let equator = 111_319.491;
        let mercator = [55_800.0 / equator, 111_412.0 / (2.0 * equator)];
        let foot = 1200.0 / 3937.0;
        #[rustfmt::skip]
        let maps: [(&[u16], &str, f64, [f64; 2]); 7] = [
            (&[1024, 0, 1, 2], "", 45.0, [78_847.0, 111_132.0]),
            (&[1024, 0, 1, 2, 2054, 0, 1, 9102], "", 45.0, [78_847.0, 111_132.0]),
            (&[1024, 0, 1, 2, 2048, 0, 1, 4807, 2054, 0, 1, 9105], "", 50.0, [70_962.3, 100_018.8]),
            (&[1024, 0, 1, 1, 3072, 0, 1, 3857], "", 8_399_737.89, mercator),
            // As GDAL writes kilometres, and systems with heights, of whose name that of the map alone counts.
            (&[1024, 0, 1, 1, 3076, 0, 1, 32767, 3077, 34736, 1, 1], "", 0.0, [1000.0; 2]),
            (&[1024, 0, 1, 1, 3072, 0, 1, 2263], "New York (ftUS) + NAVD88 height", 0.0, [foot; 2]),
            (&[1024, 0, 1, 1, 3072, 0, 1, 6347], "zone 18N + NAVD88 height (ftUS)", 0.0, [1.0; 2]),
        ];
        for (keys, name, north, known) in maps {
            let keys = [&[1, 1, 0, 1][..], keys].concat();
            let mut map = Georeference::new([1.0, 0.0, 0.0, 0.0, -1.0, north], &keys);
            (map.doubles, map.text) = (vec![7.0, 1000.0], name.to_owned());
            let unit = map.linear_unit().unwrap_or(1.0);
            for (side, known) in map.pixel_sides((0, 0)).into_iter().zip(known) {
                assert!(
                    (side * unit / known - 1.0).abs() < 1e-5,
                    "{keys:?}: {side} {known}"
                );
            }
        }
    }

    #[test]
    fn degrees_get_the_size_that_is_given() {
        let map = Georeference::new(
            [1e-3, 0.0, 11.0, 0.0, -2e-3, 47.5],
            &[1, 1, 0, 1, 1024, 0, 1, 2],
        );
        let scaled = map.with_pixel_size((90, 70), 4.0);
        let [x, y] = scaled.pixel_sides((90, 70));
        assert!((x - 4.0).abs() < 1e-6 && (y - 4.0).abs() < 1e-6, "{x} {y}");
        assert_eq!(
            (scaled.transformation[2], scaled.transformation[5]),
            (11.0, 47.5)
        );
    }

    #[test]
    fn heights_are_in_the_unit_of_their_coordinate_system() {
        // As GDAL writes NAD83(2011) / UTM zone 18N + NAVD88 height (ftUS), without a unit.
        let map = |vertical: u16| {
            let keys = [
                1, 1, 1, 3, 1024, 0, 1, 1, 3072, 0, 1, 6347, 4096, 0, 1, vertical,
            ];
            Georeference::new([1.0, 0.0, 0.0, 0.0, -1.0, 0.0], &keys)
        };
        assert_eq!(map(6360).vertical_unit(), Some(1200.0 / 3937.0));
        assert_eq!(map(5703).vertical_unit(), None);
    }

    #[test]
    fn reversed_rows_lie_where_they_lay() {
        let mut map = Georeference::new([2.0, 0.5, 100.0, 0.25, 3.0, 200.0], &[]);
        let corner = |map: &Georeference, i: f64, j: f64| {
            let [a, b, c, d, e, f] = map.transformation;
            [a * i + b * j + c, d * i + e * j + f]
        };
        let before = corner(&map, 3.0, 0.0);
        map.reverse_rows(7);
        assert_eq!(corner(&map, 3.0, 7.0), before);
        assert!(!map.is_mirrored());
    }
}
