//! Parts joined to sheets, as far as their sides fit and nothing comes to lie on anything else.

use std::collections::BTreeMap;
use std::ops::Range;

use super::body::Body;
use super::lay::Laid;
use crate::error::Result;
use crate::flat::pattern::outline::Motion;
use crate::flat::unroll::joint::Until;
use crate::flat::unroll::pieces::Point;
use crate::math::hash::NumberMap;
use crate::scene::twins::{NONE, ends, twins};
use crate::shape::patches::chains::chains;

/// A line between two parts.
pub(super) struct Seam {
    /// The lower number first.
    pub parts: [u32; 2],
    pub vertices: Vec<u32>,
    /// The sides of either part along it, in order.
    pub sides: Vec<[u32; 2]>,
    pub length: f64,
    /// Whether it is a cut through what was one patch.
    pub smooth: bool,
    /// By how much the surface folds along it, above 0 for a ridge.
    pub angle: f64,
}

/// The seams of a body, and that of each side.
pub(super) struct Seams {
    pub all: Vec<Seam>,
    of: Vec<u32>,
}

impl Seams {
    /// A cut that runs along a crease from some place on, which bends by more than `bend`, is two seams.
    pub(super) fn new(body: &Body, bend: f64) -> Seams {
        let twins = twins(&body.triangles);
        let mut between: BTreeMap<[u32; 2], Vec<[u32; 2]>> = BTreeMap::new();
        for (side, twin) in (0u32..).zip(&twins).filter(|(_, twin)| **twin != NONE) {
            let [a, b] = [side, *twin].map(|side| body.parts[side as usize / 3]);
            if a < b {
                between.entry([a, b]).or_default().push([side, *twin]);
            }
        }
        let mut seams = Seams {
            all: Vec::new(),
            of: vec![NONE; twins.len()],
        };
        let pointed = body.pointed();
        for (parts, pairs) in between {
            let edges: Vec<[u32; 2]> = pairs.iter().map(|p| ends(&body.triangles, p[0])).collect();
            for chain in chains(&edges, |vertex| pointed[vertex as usize]) {
                let sides: Vec<[u32; 2]> = chain.edges.iter().map(|edge| pairs[*edge]).collect();
                let folds: Vec<(f64, f64)> = sides.iter().map(|pair| fold(body, *pair)).collect();
                // Between patches a line is a crease unless it is quite smooth.
                let bend = match is_one(body, sides[0]) {
                    true => bend,
                    false => SMOOTH * bend,
                };
                for (run, sharp) in stretches(&folds, bend) {
                    seams.add(Seam {
                        parts,
                        vertices: chain.vertices[run.start..=run.end].to_vec(),
                        smooth: !sharp && is_one(body, sides[run.start]),
                        sides: sides[run.clone()].to_vec(),
                        length: folds[run.clone()].iter().map(|(long, _)| long).sum(),
                        angle: mean(&folds[run]),
                    });
                }
            }
        }
        seams
    }

    fn add(&mut self, seam: Seam) {
        for side in seam.sides.as_flattened() {
            self.of[*side as usize] = self.all.len() as u32;
        }
        self.all.push(seam);
    }

    /// The seam that a side of the body is on.
    pub(super) fn of(&self, side: u32) -> Option<usize> {
        let seam = self.of[side as usize];
        (seam != NONE).then_some(seam as usize)
    }
}

/// Whether both sides of an edge were one patch.
fn is_one(body: &Body, pair: [u32; 2]) -> bool {
    let [a, b] = pair.map(|side| body.patches[side as usize / 3]);
    a == b
}

/// The angle of a stretch between patches that is no crease, as a share of what is one.
const SMOOTH: f64 = 0.25;

/// So many edges on either side say whether a line is a crease, and a stretch of it has as many.
const BESIDE: usize = 2;

/// Where a line of edges, given by their lengths and angles, is a crease, and where it is none.
fn stretches(folds: &[(f64, f64)], bend: f64) -> Vec<(Range<usize>, bool)> {
    let is_sharp = |k: usize| {
        let near = k.saturating_sub(BESIDE)..(k + BESIDE + 1).min(folds.len());
        mean(&folds[near]).abs() > bend
    };
    let mut found: Vec<(Range<usize>, bool)> = Vec::new();
    for k in 0..folds.len() {
        let sharp = is_sharp(k);
        match found.last_mut() {
            Some((run, before)) if *before == sharp || run.len() <= BESIDE => run.end = k + 1,
            _ => found.push((k..k + 1, sharp)),
        }
    }
    found
}

/// The mean angle by length.
fn mean(folds: &[(f64, f64)]) -> f64 {
    let long: f64 = folds.iter().map(|(long, _)| long).sum();
    let bent: f64 = folds.iter().map(|(long, angle)| long * angle).sum();
    if long > 0.0 { bent / long } else { 0.0 }
}

/// The length of an edge, and the angle between its triangles: above 0 for a ridge.
fn fold(body: &Body, [one, other]: [u32; 2]) -> (f64, f64) {
    let normal = |side: u32| {
        let [a, b, c] = body.triangles[side as usize / 3].map(|v| body.places[v as usize]);
        (b - a).cross(&(c - a))
    };
    let [a, b] = ends(&body.triangles, one).map(|v| body.places[v as usize]);
    let (m, n, along) = (normal(one), normal(other), b - a);
    let cross = m.cross(&n);
    let angle = cross.norm().atan2(m.dot(&n));
    (along.norm(), angle.copysign(cross.dot(&along)))
}

/// What joined parts have to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// How far sides may be apart, as a share of their length.
    pub gap: f64,
    pub strain: f64,
    pub until: Until,
}

/// A distance that triangles cannot tell from none, in lengths of edges.
const FINE: f64 = 0.25;

/// Strain that needs no relaxing.
const NO_STRAIN: f64 = 1e-9;

/// Parts laid flat together.
#[derive(Debug, Clone)]
pub(super) struct Joined {
    pub parts: Vec<u32>,
    /// The seams that are whole.
    pub whole: Vec<usize>,
    pub laid: Laid,
    /// How far the sides of seams were apart at most.
    pub gap: f64,
}

/// Joins parts along their seams, the longest first.
pub(super) fn joined(
    body: &Body,
    seams: &Seams,
    parts: Vec<Laid>,
    limits: Limits,
) -> Result<Vec<Joined>> {
    let mut of: Vec<usize> = (0..parts.len()).collect();
    let mut sheets: Vec<Option<Joined>> = (parts.into_iter().enumerate())
        .map(|(part, laid)| {
            Some(Joined {
                parts: vec![part as u32],
                whole: Vec::new(),
                laid,
                gap: 0.0,
            })
        })
        .collect();
    let mut order: Vec<usize> = (0..seams.all.len()).collect();
    order.sort_by(|a, b| seams.all[*b].length.total_cmp(&seams.all[*a].length));
    for seam in &order {
        let [a, b] = seams.all[*seam].parts.map(|part| of[part as usize]);
        let done = sheets[a]
            .as_ref()
            .is_some_and(|sheet| sheet.whole.contains(seam));
        if done {
            continue;
        }
        let found = match (&sheets[a], &sheets[b]) {
            (Some(one), _) if a == b => one.with(body, seams, &order, *seam, None, limits)?,
            (Some(one), Some(other)) => {
                one.with(body, seams, &order, *seam, Some(other), limits)?
            }
            _ => None,
        };
        if let Some(found) = found {
            sheets[a.max(b)] = None;
            found
                .parts
                .iter()
                .for_each(|part| of[*part as usize] = a.min(b));
            sheets[a.min(b)] = Some(found);
        }
    }
    Ok(sheets.into_iter().flatten().collect())
}

type Corners = NumberMap<(u32, u32), Point>;

impl Joined {
    /// Joined along a seam to itself or another one, if they fit.
    fn with(
        &self,
        body: &Body,
        seams: &Seams,
        order: &[usize],
        seam: usize,
        other: Option<&Joined>,
        limits: Limits,
    ) -> Result<Option<Joined>> {
        let mut at: Corners = self.laid.corners().collect();
        let mut parts = self.parts.clone();
        let mut before = self.whole.clone();
        let mut gap = self.gap;
        if let Some(other) = other {
            let theirs: Corners = other.laid.corners().collect();
            let [mine, yours] = match at.contains_key(&corner(seams.all[seam].sides[0][0])) {
                true => nodes(&seams.all[seam], [&at, &theirs]),
                false => {
                    let [a, b] = nodes(&seams.all[seam], [&theirs, &at]);
                    [b, a]
                }
            };
            let motion = Motion::between(&yours, &mine);
            at.extend(
                theirs
                    .into_iter()
                    .map(|(key, place)| (key, motion.of(place))),
            );
            parts.extend(&other.parts);
            parts.sort_unstable();
            before.extend(&other.whole);
            gap = gap.max(other.gap);
        }
        let fits = |seam: usize| {
            let [one, other] = nodes(&seams.all[seam], [&at, &at]);
            let squares: f64 = (one.iter().zip(&other))
                .map(|(p, q)| (p - q).norm_sqr())
                .sum();
            let apart = (squares / one.len() as f64).sqrt();
            let most = (limits.gap * seams.all[seam].length).max(FINE * body.spacing);
            (apart <= most).then_some(apart)
        };
        if fits(seam).is_none() {
            return Ok(None);
        }
        // Others may fit as well then: around a vertex with a full turn, the last one does.
        let own = |other: &usize| {
            let parts_of = seams.all[*other].parts;
            !before.contains(other) && parts_of.iter().all(|p| parts.binary_search(p).is_ok())
        };
        let also: Vec<usize> = (order.iter().copied())
            .filter(|other| *other != seam && own(other) && fits(*other).is_some())
            .collect();
        let mut choices = vec![vec![seam]];
        if !also.is_empty() {
            choices.insert(0, [&[seam], &also[..]].concat());
        }
        for more in choices {
            let whole = [&before[..], &more].concat();
            let gap = more
                .iter()
                .filter_map(|seam| fits(*seam))
                .fold(gap, f64::max);
            if let Some(laid) = laid(body, seams, &parts, &whole, &at, limits)? {
                return Ok(Some(Joined {
                    parts,
                    whole,
                    laid,
                    gap,
                }));
            }
        }
        Ok(None)
    }
}

/// Parts together, if they lie flat without overlap.
fn laid(
    body: &Body,
    seams: &Seams,
    parts: &[u32],
    whole: &[usize],
    at: &Corners,
    limits: Limits,
) -> Result<Option<Laid>> {
    let all = body.parts.iter().zip(0..);
    let own = all.filter(|(part, _)| parts.binary_search(part).is_ok());
    let members = own.map(|(_, t)| t).collect();
    let is_cut = |side: u32| seams.of(side).is_some_and(|seam| !whole.contains(&seam));
    let as_it_is = Until {
        steps: 0,
        ..limits.until
    };
    let rough = Laid::new(body, members, is_cut, Some(at), as_it_is)?;
    let sound = |laid: &Laid| laid.strain <= limits.strain && !laid.overlaps();
    if rough.strain <= NO_STRAIN {
        return Ok(Some(rough).filter(sound));
    }
    if rough.overlaps() {
        return Ok(None);
    }
    Ok(Some(rough.relaxed(body, limits.until)?).filter(sound))
}

fn corner(side: u32) -> (u32, u32) {
    (side / 3, side % 3)
}

/// The ends of the pieces along a seam, as either of its parts has them.
fn nodes(seam: &Seam, at: [&Corners; 2]) -> [Vec<Point>; 2] {
    let following = |side: u32| (side / 3, (side % 3 + 1) % 3);
    let one = seam
        .sides
        .iter()
        .flat_map(|[side, _]| [corner(*side), following(*side)]);
    let other = seam
        .sides
        .iter()
        .flat_map(|[_, twin]| [following(*twin), corner(*twin)]);
    [
        one.map(|corner| at[0][&corner]).collect(),
        other.map(|corner| at[1][&corner]).collect(),
    ]
}
