//! The parts that a mesh is cut into, each of which lies flat by itself.

use std::collections::BTreeMap;

use super::body::{Body, Plane};
use super::join::Limits;
use super::lay::FlatPart;
use crate::error::{Error, Result, rounded};
use crate::pattern::sheets::Missing;
use crate::progress;
use rustc_hash::FxHashSet;

/// Maximum number of parts of a mesh: a pattern of more parts cannot be assembled in practice.
const MAX_PARTS: u32 = 500;

/// Minimum number of vertices of a part that may be cut into smaller parts. `benches/patterns.md` has what others give.
const MIN_CUT_VERTICES: usize = 24;

/// Maximum share of a surface's area that may be left out of its pattern: with more it is no pattern of the surface.
pub(in crate::pattern) const MAX_OMITTED_SHARE: f64 = 0.1;

/// Cuts the parts of a mesh until each lies flat within the strain limit, and leaves out those that do not and cannot be cut
/// further. Returns the parts by area, the largest first, and what is left out.
pub(super) fn flat_parts(mut body: Body, limits: Limits) -> Result<(Body, Vec<FlatPart>, Missing)> {
    // Parts that lie flat, each with its triangles at that time: later cuts of neighbours divide some of them.
    let mut flat: BTreeMap<u32, FlatPart> = BTreeMap::new();
    let mut open: Vec<u32> = (0..body.count).rev().collect();
    let whole: f64 = body.areas().iter().sum();
    let mut missing = Missing::default();
    let mut left_out: Vec<u32> = Vec::new();
    let mut leave_out = |body: &Body, part: u32, laid: &FlatPart| {
        missing.area += laid.area;
        left_out.push(part);
        match missing.area <= MAX_OMITTED_SHARE * whole {
            true => Ok(()),
            false => Err(refused(body, laid, limits.strain)),
        }
    };
    loop {
        let Some(part) = open.pop() else {
            let moved = |(part, laid): (&u32, &FlatPart)| {
                (body.members(*part).len() != laid.members.len()).then_some(*part)
            };
            open = flat.iter().filter_map(moved).collect();
            if open.is_empty() {
                break;
            }
            continue;
        };
        let end = flat.len() as f64 / (flat.len() + 1 + open.len()) as f64;
        let laid = progress::part(end, || {
            FlatPart::whole(&body, body.members(part), limits.trial())
        })?;
        if limits.allow(&laid) {
            flat.insert(part, laid);
            continue;
        }
        flat.remove(&part);
        if laid.source.len() < MIN_CUT_VERTICES {
            leave_out(&body, part, &laid)?;
            continue;
        }
        let alone = body.alone(&laid.members);
        let around = body.perimeter(&laid.members);
        let worst = body.middle(laid.members[laid.worst]);
        let mut best: Option<([f64; 2], Plane)> = None;
        for plane in body.planes(&laid.members, worst) {
            let mut trial = alone.clone();
            let parts = trial.cut(0, &plane)?;
            if parts.len() < 2 || body.count - 1 + trial.count > MAX_PARTS {
                continue;
            }
            let (mut energy, mut length) = (0.0, -0.5 * around);
            for part in &parts {
                let laid = progress::part(end, || {
                    FlatPart::whole(&trial, trial.members(*part), limits.until)
                })?;
                energy += laid.energy();
                length += 0.5 * trial.perimeter(&laid.members);
            }
            // Less strain than is allowed gains nothing.
            let gain = (laid.energy() / energy.max(laid.area * limits.strain.powi(2))).ln();
            let cost = match gain > 0.0 {
                true => length / gain,
                false => f64::INFINITY,
            };
            if best
                .as_ref()
                .is_none_or(|(least, _)| [cost, energy] < *least)
            {
                best = Some(([cost, energy], plane));
            }
        }
        let Some((_, plane)) = best else {
            leave_out(&body, part, &laid)?;
            continue;
        };
        open.extend(body.cut(part, &plane)?);
    }
    let unused = body.unused_vertices();
    let moved = body.remove(&left_out);
    missing.vertices = body.unused_vertices() - unused;
    for laid in flat.values_mut() {
        laid.members
            .iter_mut()
            .for_each(|t| *t = moved[*t as usize]);
    }
    let numbers = body.sort();
    // Those that are left out have no area, and the last numbers.
    body.count -= left_out.len() as u32;
    let mut parts: Vec<(u32, FlatPart)> = (flat.into_iter())
        .map(|(part, laid)| (numbers[part as usize], laid))
        .collect();
    parts.sort_by_key(|(part, _)| *part);
    let parts = parts.into_iter().map(|(_, laid)| laid).collect();
    Ok((body, parts, missing))
}

/// The error for a part with which more would be left out than [`MAX_OMITTED_SHARE`] allows, with its most strained place.
fn refused(body: &Body, laid: &FlatPart, limit: f64) -> Error {
    let [x, y, z] = <[f64; 3]>::from(body.middle(laid.members[laid.worst])).map(rounded);
    let vertices: FxHashSet<u32> = (laid.members.iter())
        .flat_map(|t| body.triangles[*t as usize])
        .collect();
    let [strain, limit] = [laid.strain, limit].map(|share| rounded(100.0 * share));
    let fault = match strain > limit {
        true => format!("its strain would be {strain} %, more than the limit of {limit} %"),
        false => "its outline would cross itself".into(),
    };
    Error::NotFlat {
        place: format!("({x}, {y}, {z})"),
        vertices: vertices.len(),
        reason: format!(
            "{fault}, and with it more than a tenth of the surface would be left out, or there would be more than {MAX_PARTS} parts"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::Place;
    use super::super::join::join_parts;
    use super::super::seams::Seams;
    use super::*;
    use crate::unroll::arap_mesh::StoppingCriteria;

    const UNTIL: StoppingCriteria = StoppingCriteria {
        tolerance: 1e-12,
        relative_tolerance: 0.0,
        target_energy: 0.0,
        hopeless_energy: f64::INFINITY,
        max_steps: 200,
    };
    const LIMITS: Limits = Limits {
        gap: 0.02,
        strain: 0.01,
        until: UNTIL,
    };

    /// The triangles of a disk, ring by ring and sector by sector.
    fn disk(rings: u32, sectors: u32, vertex: impl Fn(u32, u32) -> u32) -> Vec<Vec<[u32; 3]>> {
        let cells = (0..rings).flat_map(|r| (0..sectors).map(move |s| (r, s)));
        let cells = cells.map(|(ring, sector)| {
            let [a, b] = [vertex(ring, sector), vertex(ring + 1, sector)];
            let [c, d] = [vertex(ring + 1, sector + 1), vertex(ring, sector + 1)];
            match ring {
                0 => vec![[a, b, c]],
                _ => vec![[a, b, c], [a, c, d]],
            }
        });
        cells.collect()
    }

    /// A disk of ten rings without 30 degrees, and a triangle, the last one, that stands upright on one side of the gap.
    fn disk_with_tooth() -> (Vec<Place>, Vec<[u32; 3]>) {
        let (rings, sectors) = (10u32, 5u32);
        let place = |ring: u32, sector: u32| {
            let (far, angle) = (
                f64::from(ring) / 10.0,
                (66.0 * f64::from(sector)).to_radians(),
            );
            Place::new(far * angle.cos(), far * angle.sin(), 0.0)
        };
        let vertex = |ring: u32, sector: u32| match ring {
            0 => 0,
            _ => 1 + (ring - 1) * (sectors + 1) + sector,
        };
        let mut places = vec![Place::zeros()];
        places.extend((1..=rings).flat_map(|r| (0..=sectors).map(move |s| place(r, s))));
        let mut triangles = disk(rings, sectors, vertex).concat();
        // Laid flat it would reach across the other side.
        let foot = [vertex(8, 0), vertex(7, 0)];
        let up = Place::new(0.75, 0.0, 0.45);
        places.push(up);
        triangles.push([foot[1], places.len() as u32 - 1, foot[0]]);
        (places, triangles)
    }

    #[test]
    fn what_cannot_be_cut_further_is_left_out_up_to_a_tenth_of_the_area() {
        let (mut places, mut triangles) = disk_with_tooth();
        for k in 1..MAX_PARTS {
            let first = places.len() as u32;
            let far = 2.0 + f64::from(k);
            places.extend(
                [[far, 0.0], [far + 0.5, 0.0], [far, 0.5]].map(|[x, y]| Place::new(x, y, 0.0)),
            );
            triangles.push([first, first + 1, first + 2]);
        }
        let labels = vec![0; triangles.len()];
        let body = Body::new(places, triangles, labels).unwrap();
        assert_eq!(body.count, MAX_PARTS);
        let area = |body: &Body| body.areas().iter().sum::<f64>();
        let whole = area(&body);
        let disk = whole - 0.125 * f64::from(MAX_PARTS - 1);
        let (rest, parts, missing) = flat_parts(body.clone(), LIMITS).unwrap();
        assert_eq!((parts.len() as u32, missing.vertices), (MAX_PARTS - 1, 62));
        assert!((missing.area - disk).abs() < 1e-9 && (area(&rest) + disk - whole).abs() < 1e-9);
        // Of a larger share there is no pattern.
        let mut large = body;
        large
            .places
            .iter_mut()
            .skip(62)
            .for_each(|place| *place *= 0.5);
        let error = flat_parts(large, LIMITS).err().unwrap();
        assert_eq!(error.code(), "NOT_FLAT");
        assert!(error.to_string().contains("more than a tenth"), "{error}");
    }

    #[test]
    fn a_cut_is_closed_where_that_strains_its_sheet_less_than_allowed() {
        // A disk without a narrow wedge, whose sides meet in space, in two halves of one patch. Laid flat they fit along one of
        // the two lines between them, and along the other they part by the wedge.
        let (rings, sectors, missing) = (10u32, 24u32, 2.0f64.to_radians());
        let slope = (1.0 - missing / std::f64::consts::TAU).acos();
        let mut places = vec![Place::zeros()];
        for ring in 1..=rings {
            let far = f64::from(ring) / 10.0;
            places.extend((0..sectors).map(|sector| {
                let angle = std::f64::consts::TAU * f64::from(sector) / f64::from(sectors);
                let wide = far * slope.cos();
                Place::new(wide * angle.cos(), wide * angle.sin(), -far * slope.sin())
            }));
        }
        let vertex = |ring: u32, sector: u32| match ring {
            0 => 0,
            _ => 1 + (ring - 1) * sectors + sector % sectors,
        };
        let by_sector = disk(rings, sectors, vertex);
        let halves = (0u32..).zip(&by_sector).flat_map(|(cell, own)| {
            let half = u32::from(cell % sectors >= sectors / 2);
            own.iter().map(move |_| half)
        });
        let (halves, triangles) = (halves.collect(), by_sector.concat());
        let mut body = Body::new(places, triangles, halves).unwrap();
        body.patches.fill(0);
        let joined = |strain: f64| {
            let limits = Limits {
                gap: 1e-4,
                strain,
                ..LIMITS
            };
            let parts =
                (0..2).map(|part| FlatPart::whole(&body, body.members(part), UNTIL).unwrap());
            let seams = Seams::new(&body, 0.3, 0.0);
            join_parts(&body, seams, parts.collect(), limits).unwrap()
        };
        let (seams, sheets) = joined(0.01);
        assert_eq!((sheets.len(), sheets[0].whole.len()), (1, seams.all.len()));
        assert!(sheets[0].laid.strain > 1e-4 && sheets[0].laid.strain < 0.01);
        let (seams, sheets) = joined(1e-4);
        let closed: usize = sheets.iter().map(|sheet| sheet.whole.len()).sum();
        assert!(closed < seams.all.len());
    }
}
