//! Sites (neighbouring cells) around a cell in a hole, ring by ring.

use nalgebra::Vector2;

use super::raster::Raster;

/// Sites around a cell (the relative positions of further cells), sorted by their number of steps from it: those `k`
/// steps away are `sites[rings[k - 1]..rings[k]]`.
pub(super) struct Sites {
    pub sites: Vec<Site>,
    pub rings: Vec<usize>,
}

pub(super) struct Site {
    pub offset: isize,
    pub place: Vector2<f64>,
    /// Number of the sector of directions that the site lies in, of twelve around the cell.
    pub sector: u32,
    /// Indices of half of this site's neighbours in the list of sites, so that each pair of neighbours occurs once.
    pub next: Vec<usize>,
}

/// Number of sectors of directions by which it is decided whether heights surround a cell in a hole.
const DIRECTION_SECTORS: u32 = 12;

/// Angle, in full turns, added so that directions on the border of two sectors fall into the same one despite rounding.
const SECTOR_BORDER_OFFSET_TURNS: f64 = 1e-9;

impl Sites {
    pub(super) fn new(raster: &Raster, odd: bool, most: usize) -> Self {
        let steps = [raster.steps(false), raster.steps(true)];
        let parity = |[row, _]: [isize; 2]| usize::from(odd) ^ row.rem_euclid(2) as usize;
        let mut places: Vec<[isize; 2]> = vec![[0, 0]];
        let mut rings = vec![1];
        let mut from = 0;
        for _ in 0..most {
            for i in from..places.len() {
                let at = places[i];
                for [r, c] in &steps[parity(at)] {
                    let to = [at[0] + r, at[1] + c];
                    if !places.contains(&to) {
                        places.push(to);
                    }
                }
            }
            from = rings[rings.len() - 1];
            rings.push(places.len());
        }
        let stride = raster.stride as isize;
        let sites = places.iter().map(|at| {
            let place = raster.place(odd, *at);
            let angle = place[1].atan2(place[0]) / std::f64::consts::TAU;
            let half = steps[parity(*at)].len() / 2;
            let next = steps[parity(*at)][..half].iter();
            let next = next.filter_map(|[r, c]| {
                let to = [at[0] + r, at[1] + c];
                places.iter().position(|place| *place == to)
            });
            Site {
                offset: at[0] * stride + at[1],
                place: place.into(),
                sector: ((angle + SECTOR_BORDER_OFFSET_TURNS).rem_euclid(1.0)
                    * f64::from(DIRECTION_SECTORS)) as u32
                    % DIRECTION_SECTORS,
                next: next.collect(),
            }
        });
        Sites {
            sites: sites.collect(),
            rings,
        }
    }
}

/// Whether sites in the given sectors, a bit for each, surround a cell: no half turn is without one.
pub(super) fn surround(sectors: u32) -> bool {
    let all = sectors | sectors << DIRECTION_SECTORS;
    let half = (1 << (DIRECTION_SECTORS / 2)) - 1;
    (0..DIRECTION_SECTORS).all(|first| all >> first & half != 0)
}
