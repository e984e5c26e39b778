//! Parts joined to sheets, as far as their sides fit and nothing comes to lie on anything else.

use super::body::Body;
use super::lay::{FlatPart, Lying};
use super::reach::reach_into_each_other;
use super::seams::Seams;
use crate::error::Result;
use crate::math::motion::Motion;
use crate::progress;
use crate::scene::half_edges::next_half_edge;
use crate::unroll::arap_mesh::StoppingCriteria;
use crate::unroll::flat_triangle::Point;

/// Seam gap below which a seam counts as closed, because it is finer than the mesh's resolution; in edge lengths of the mesh.
/// `benches/patterns.md` has what others give.
pub(super) const NEGLIGIBLE_GAP_LENGTHS: f64 = 0.25;

/// Limits that a flat sheet of a mesh has to keep: seam gap, strain, and when the solver stops.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Maximum seam gap, as a share of the seam's length.
    pub gap: f64,
    pub strain: f64,
    pub until: StoppingCriteria,
}

/// Strain, as a share of the limit, at which a part that may still be cut or joined is flat enough.
/// `benches/patterns.md` has what others give.
const TRIAL_STRAIN_SHARE: f64 = 0.8;

/// Weights of the squared difference between the two sides of a cut edge, tried in this order until a sheet is valid. An edge between two
/// equilateral triangles has the weight 0.58. `benches/patterns.md` has what others give.
const SIDE_WEIGHTS: [f64; 3] = [100.0, 10.0, 1.0];

impl Limits {
    /// Returns the stopping criteria of the solver for laying parts flat that may still be cut or joined.
    pub(super) fn trial(&self) -> StoppingCriteria {
        StoppingCriteria {
            // The energy is the sum of the squares of both principal strains.
            target_energy: 2.0 * (TRIAL_STRAIN_SHARE * self.strain).powi(2),
            ..self.until
        }
    }

    /// Returns whether a layout is a valid sheet: its strain is within the limit and it has no self-intersection.
    pub(super) fn allow(&self, laid: &FlatPart) -> bool {
        laid.strain <= self.strain && !laid.overlaps()
    }
}

/// A flat sheet of a mesh: parts laid flat together.
#[derive(Debug, Clone)]
pub(super) struct Joined {
    pub parts: Vec<u32>,
    /// Numbers of the seams whose two sides are joined within the sheet.
    pub whole: Vec<usize>,
    pub laid: FlatPart,
    /// Largest seam gap of the joined seams before their sides were joined: root mean square distance between a seam's
    /// sides, in the mesh's units.
    pub gap: f64,
}

/// Joins the parts of a mesh to flat sheets along their seams, the longest seam first, and then closes cuts again. Returns the
/// seams, some of them divided, and the sheets.
pub(super) fn join_parts(
    body: &Body,
    seams: Seams,
    parts: Vec<FlatPart>,
    limits: Limits,
) -> Result<(Seams, Vec<Joined>)> {
    let mut sheets = Sheets::new(body, seams, parts, limits);
    sheets.divide_by_fit();
    let mut order: Vec<usize> = (0..sheets.seams.all.len()).collect();
    order.sort_by(|a, b| {
        let [a, b] = [a, b].map(|seam| sheets.seams.all[*seam].length);
        b.total_cmp(&a)
    });
    let steps = (order.len() + sheets.all.len()) as f64;
    progress::part(0.7, || -> Result<()> {
        for (done, seam) in (1u32..).zip(&order) {
            if !sheets.whole[*seam] {
                progress::part(f64::from(done) / steps, || sheets.join(*seam, &order))?;
            }
        }
        for number in 0..sheets.all.len() {
            let done = order.len() + number + 1;
            progress::part(done as f64 / steps, || sheets.settle(number))?;
        }
        Ok(())
    })?;
    progress::part(1.0, || sheets.close_cuts())?;
    sheets.even_sides()?;
    let numbers = sheets.seams.put_together(&sheets.whole);
    let mut joined: Vec<Joined> = sheets.all.into_iter().flatten().collect();
    for sheet in &mut joined {
        let whole = sheet.whole.iter().map(|seam| numbers[*seam]);
        sheet.whole = whole.collect();
        sheet.whole.sort_unstable();
        sheet.whole.dedup();
    }
    Ok((sheets.seams, joined))
}

/// The sheets found so far, while parts of a mesh are joined to sheets.
pub(super) struct Sheets<'a> {
    pub body: &'a Body,
    pub seams: Seams,
    pub limits: Limits,
    pub all: Vec<Option<Joined>>,
    /// Whether the solver has laid each sheet flat until convergence.
    settled: Vec<bool>,
    /// Number of the sheet that each part of the mesh is on.
    pub of: Vec<usize>,
    /// Position on its sheet of each corner of the mesh's triangles.
    pub at: Vec<Point>,
    /// For each seam whether its two sides are joined on a sheet.
    pub whole: Vec<bool>,
}

impl<'a> Sheets<'a> {
    /// Makes both sides of each cut equally long: strain, which is largest at the border of a sheet, has made them differ. A sheet stays as
    /// it is where it would become invalid.
    fn even_sides(&mut self) -> Result<()> {
        let mut lengths = vec![f64::NAN; self.seams.twins.len()];
        for sheet in self.all.iter().flatten() {
            for (side, length) in sheet.laid.side_lengths() {
                lengths[side as usize] = length;
            }
        }
        let twins = &self.seams.twins;
        let mean = |side: u32| {
            let other = lengths.get(twins[side as usize] as usize)?;
            Some(0.5 * (lengths[side as usize] + other)).filter(|length| length.is_finite())
        };
        // What has no area cannot be strained.
        let sheets = self.all.iter_mut().flatten();
        for sheet in sheets.filter(|sheet| sheet.laid.area > 0.0) {
            for weight in SIDE_WEIGHTS {
                let laid =
                    sheet
                        .laid
                        .clone()
                        .with_sides(self.body, mean, weight, self.limits.until)?;
                if self.limits.allow(&laid) {
                    sheet.laid = laid;
                    break;
                }
            }
        }
        Ok(())
    }

    fn new(body: &'a Body, seams: Seams, parts: Vec<FlatPart>, limits: Limits) -> Self {
        let alone = |(part, laid): (u32, FlatPart)| Joined {
            parts: vec![part],
            whole: Vec::new(),
            laid,
            gap: 0.0,
        };
        let mut sheets = Sheets {
            of: (0..parts.len()).collect(),
            all: vec![None; parts.len()],
            settled: vec![false; parts.len()],
            at: vec![Point::default(); 3 * body.triangles.len()],
            whole: vec![false; seams.all.len()],
            body,
            seams,
            limits,
        };
        for (number, part) in (0..).zip(parts) {
            sheets.put(number as usize, alone((number, part)));
        }
        sheets
    }

    pub(super) fn put(&mut self, number: usize, sheet: Joined) {
        for (t, corners) in sheet.laid.members.iter().zip(&sheet.laid.triangles) {
            for (k, corner) in corners.iter().enumerate() {
                self.at[3 * *t as usize + k] = sheet.laid.places[*corner as usize];
            }
        }
        for part in &sheet.parts {
            self.of[*part as usize] = number;
        }
        for seam in &sheet.whole {
            self.whole[*seam] = true;
        }
        self.all[number] = Some(sheet);
    }

    /// Joins the two sheets on either side of a seam, or closes a seam within one sheet, if the result is a valid flat
    /// sheet.
    fn join(&mut self, seam: usize, order: &[usize]) -> Result<()> {
        let [a, b] = self.seams.all[seam]
            .parts
            .map(|part| self.of[part as usize]);
        let mut found = self.together(seam, [a, b], order)?;
        if found.is_none() && (self.settle(a)? | self.settle(b)?) {
            found = self.together(seam, [a, b], order)?;
        }
        if let Some(found) = found {
            self.all[a.max(b)] = None;
            self.put(a.min(b), found);
            self.settled[a.min(b)] = false;
        }
        Ok(())
    }

    /// Lays two sheets flat together, joined along a seam and along all other seams that then fit; `None` if the
    /// result is not a valid sheet.
    fn together(
        &self,
        seam: usize,
        numbers: [usize; 2],
        order: &[usize],
    ) -> Result<Option<Joined>> {
        let both = SheetPair::new(self, seam, numbers);
        let Some(apart) = both.fits(seam) else {
            return Ok(None);
        };
        // Other seams may fit as well, such as the last one around a vertex whose angles sum to 2π.
        let others = order
            .iter()
            .filter(|other| **other != seam && both.has(**other));
        let also = others.filter_map(|other| Some((*other, both.fits(*other)?)));
        let all: Vec<(usize, f64)> = std::iter::once((seam, apart)).chain(also).collect();
        let found = both.laid(&all, self.limits, Trial::Join)?;
        if found.is_some() || all.len() == 1 {
            return Ok(found);
        }
        both.laid(&all[..1], self.limits, Trial::Join)
    }

    /// Lays a sheet flat until convergence. Returns false if that was done before.
    fn settle(&mut self, number: usize) -> Result<bool> {
        if std::mem::replace(&mut self.settled[number], true) {
            return Ok(false);
        }
        let Some(sheet) = &self.all[number] else {
            return Ok(false);
        };
        let laid = sheet.laid.clone().relaxed(self.body, self.limits.until)?;
        if self.limits.allow(&laid) {
            let sheet = Joined {
                laid,
                ..sheet.clone()
            };
            self.put(number, sheet);
        }
        Ok(true)
    }
}

/// How sheets are tried to be joined along seams.
#[derive(Debug, Clone, Copy)]
pub(super) enum Trial {
    /// Their sides fit, so that they lie beside each other at once.
    Join,
    /// Their sides are pulled together.
    Close,
}

/// One sheet that is closed along a seam, or two sheets of which the second is moved to the first along a seam.
pub(super) struct SheetPair<'a> {
    sheets: &'a Sheets<'a>,
    numbers: [usize; 2],
    /// Rigid motion in the plane that moves the second sheet to the first; `None` if there is only one sheet.
    motion: Option<Motion>,
}

impl<'a> SheetPair<'a> {
    pub(super) fn new(sheets: &'a Sheets<'a>, seam: usize, numbers: [usize; 2]) -> Self {
        let mut both = SheetPair {
            sheets,
            numbers,
            motion: None,
        };
        if numbers[0] != numbers[1] {
            let [mine, yours] = both.nodes(seam);
            both.motion = Some(Motion::between(&yours, &mine));
        }
        both
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &'a Joined> {
        let two = self.motion.map_or(1, |_| 2);
        let numbers = self.numbers.into_iter().take(two);
        numbers.filter_map(|number| self.sheets.all[number].as_ref())
    }

    /// Returns whether a seam may be joined here: it is not joined yet, and the parts on both of its sides lie on these
    /// sheets.
    pub(super) fn has(&self, seam: usize) -> bool {
        let mut parts = self.sheets.seams.all[seam].parts.iter();
        let is_here = |part: &u32| self.numbers.contains(&self.sheets.of[*part as usize]);
        !self.sheets.whole[seam] && parts.all(is_here)
    }

    /// Returns the flat position of a corner of the mesh's triangles, after the second sheet was moved to the first.
    fn place(&self, corner: u32) -> Point {
        let part = self.sheets.body.parts[corner as usize / 3];
        let place = self.sheets.at[corner as usize];
        match &self.motion {
            Some(motion) if self.sheets.of[part as usize] == self.numbers[1] => motion.apply(place),
            _ => place,
        }
    }

    /// Returns whether two sheets reach into each other by more than a distance.
    pub(super) fn reach_into_each_other(&self, distance: f64) -> bool {
        let outlines: Vec<Vec<Vec<Point>>> = (self
            .all()
            .zip([Motion::IDENTITY, self.motion.unwrap_or(Motion::IDENTITY)]))
        .map(|(sheet, motion)| {
            let lines = sheet.laid.lines().into_iter();
            let moved = lines.map(|line| line.into_iter().map(|p| motion.apply(p)).collect());
            moved.collect()
        })
        .collect();
        match &outlines[..] {
            [one, other] => reach_into_each_other([one, other], distance),
            _ => false,
        }
    }

    /// Lists the positions of the ends of a seam's edges, on both sides of the seam.
    fn nodes(&self, seam: usize) -> [Vec<Point>; 2] {
        let sides = &self.sheets.seams.all[seam].sides;
        let one = sides
            .iter()
            .flat_map(|[side, _]| [*side, next_half_edge(*side)]);
        let other = sides
            .iter()
            .flat_map(|[_, twin]| [next_half_edge(*twin), *twin]);
        [
            one.map(|corner| self.place(corner)).collect(),
            other.map(|corner| self.place(corner)).collect(),
        ]
    }

    /// Computes the seam gap: the root mean square distance between the two sides of a seam.
    pub(super) fn gap(&self, seam: usize) -> f64 {
        let [one, other] = self.nodes(seam);
        let squares: f64 = (one.iter().zip(&other))
            .map(|(p, q)| (p - q).norm_sqr())
            .sum();
        (squares / one.len() as f64).sqrt()
    }

    /// Returns the seam gap; `None` if it is too large for the two sides to be joined.
    fn fits(&self, seam: usize) -> Option<f64> {
        let Sheets {
            seams,
            limits,
            body,
            ..
        } = self.sheets;
        let apart = self.gap(seam);
        let most = (limits.gap * seams.all[seam].length).max(NEGLIGIBLE_GAP_LENGTHS * body.spacing);
        (apart <= most).then_some(apart)
    }

    /// Lays the sheets flat as one sheet, closed along given seams, each with its seam gap; `None` if the result is not
    /// a valid sheet.
    pub(super) fn laid(
        &self,
        along: &[(usize, f64)],
        limits: Limits,
        how: Trial,
    ) -> Result<Option<Joined>> {
        let Sheets { seams, body, .. } = self.sheets;
        let more = along.iter().map(|(seam, _)| *seam);
        let mut joined = self.sheets.whole.clone();
        more.clone().for_each(|seam| joined[seam] = true);
        let laid = self.all().flat_map(|sheet| &sheet.laid.members);
        let mut members: Vec<u32> = laid.copied().collect();
        members.sort_unstable();
        let start = Lying::At(&|corner| self.place(corner));
        let twins = seams.twins(&members, |seam| joined[seam]);
        let rough = FlatPart::new(body, members, twins, start)?;
        let laid = match how {
            Trial::Join if rough.overlaps() => return Ok(None),
            Trial::Join if rough.strain <= TRIAL_STRAIN_SHARE * limits.strain => rough,
            Trial::Close if limits.allow(&rough) => rough,
            _ => {
                let laid = match how {
                    Trial::Join => rough.relaxed(body, limits.trial())?,
                    Trial::Close => rough.closed(body)?,
                };
                if !limits.allow(&laid) {
                    return Ok(None);
                }
                laid
            }
        };
        let mut parts: Vec<u32> = self.all().flat_map(|sheet| &sheet.parts).copied().collect();
        parts.sort_unstable();
        let gaps = self.all().map(|sheet| sheet.gap);
        Ok(Some(Joined {
            parts,
            whole: (self.all().flat_map(|sheet| &sheet.whole).copied())
                .chain(more)
                .collect(),
            laid,
            gap: gaps
                .chain(along.iter().map(|(_, apart)| *apart))
                .fold(0.0, f64::max),
        }))
    }
}
