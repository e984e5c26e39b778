//! The sheets of a net: outlines, folds, creases and places to write on.

use rustc_hash::FxHashMap;

use super::bends::{mark_bends, radii};
use super::net::Net;
use super::patches::FlatPatches;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, distance_to_segment, orientation};
use crate::math::union_find::UnionFind;
use crate::pattern::{Direction, Faces, Fold, MeshPattern, Missing, Run, Seam, Sheet, Spot};
use crate::scene::half_edges::{half_edge_ends, next_half_edge};
use crate::scene::polyhedron::{MAX_BEND_STEP, Polyhedron};
use crate::shape::patches::{Crease, Patch};

pub(super) fn draw(solid: &Polyhedron, net: &Net, patches: &FlatPatches) -> Result<MeshPattern> {
    let mut drawing = Drafter {
        solid,
        net,
        patches,
        closed: (0..solid.twins.len() as u32)
            .map(|side| net.is_closed(side))
            .collect(),
        crease_of: vec![NO_INDEX; solid.twins.len()],
        creases: Vec::new(),
        seams: Vec::new(),
        radii: radii(solid, patches),
    };
    drawing.find_creases()?;
    let edges = solid.twins.len() as f64;
    let sides = 0..solid.twins.len() as u32;
    let spacing = sides.map(|side| solid.length(side)).sum::<f64>() / edges;
    let mut sheets: Vec<Sheet> = net
        .pieces()
        .iter()
        .map(|facets| drawing.sheet(facets, spacing))
        .collect();
    sheets.sort_by_key(|sheet| sheet.patches[0]);
    let mut vertices: Vec<(u32, u32)> = (solid.triangles.iter().zip(&solid.facets))
        .flat_map(|(t, facet)| t.map(|v| (patches.of[*facet as usize], v)))
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    let counted = vertices.chunk_by(|a, b| a.0 == b.0).map(<[_]>::len);
    Ok(MeshPattern {
        sheets,
        patches: (counted.zip(&patches.areas))
            .map(|(vertices, area)| Patch {
                vertices,
                area: *area,
            })
            .collect(),
        creases: drawing.creases,
        missing: Missing::default(),
    })
}

struct Drafter<'a> {
    solid: &'a Polyhedron,
    net: &'a Net<'a>,
    patches: &'a FlatPatches,
    /// Whether both sides of each half-edge's edge lie on each other.
    closed: Vec<bool>,
    /// Crease of each half-edge between facets.
    crease_of: Vec<u32>,
    creases: Vec<Crease>,
    seams: Vec<Seam>,
    /// Radius of each patch that is a bend.
    radii: Vec<Option<f64>>,
}

impl Drafter<'_> {
    fn patch(&self, side: u32) -> u32 {
        self.patches.of[self.solid.facet(side) as usize]
    }

    /// The next half-edge along the outline of a piece, after one of its border.
    fn next_on_outline(&self, side: u32) -> u32 {
        let mut next = next_half_edge(side);
        while self.is_inside(next) {
            next = next_half_edge(self.solid.twins[next as usize]);
        }
        next
    }

    /// Whether the piece goes on beyond a half-edge.
    fn is_inside(&self, side: u32) -> bool {
        self.closed[side as usize]
    }

    /// Groups edges: cuts that follow each other on both sides between the same patches, and folds along one line.
    fn find_creases(&mut self) -> Result<()> {
        let solid = self.solid;
        let mut sets = UnionFind::new("edges", solid.twins.len())?;
        let sides: Vec<u32> = solid.inner_sides().collect();
        for side in 0..solid.twins.len() as u32 {
            let twin = solid.twins[side as usize];
            if twin == NO_INDEX || solid.facet(side) == solid.facet(twin) {
                continue;
            }
            sets.union(side, twin);
            if !self.closed[side as usize] {
                let next = self.next_on_outline(side);
                let other = solid.twins[next as usize];
                if other != NO_INDEX
                    && solid.facet(next) != solid.facet(other)
                    && self.patch(next) == self.patch(side)
                    && self.patch(other) == self.patch(twin)
                    && self.next_on_outline(other) == twin
                {
                    sets.union(side, next);
                }
            }
        }
        // Edges of a fold are between the same two facets.
        let mut between: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        for side in sides.iter().filter(|side| self.closed[**side as usize]) {
            let (a, b) = (solid.facet(*side), solid.facet(solid.twins[*side as usize]));
            let first = *between.entry([a.min(b), a.max(b)]).or_insert(*side);
            sets.union(first, *side);
        }
        let mut groups: Vec<(u32, u32)> =
            sides.iter().map(|side| (sets.find(*side), *side)).collect();
        groups.sort_unstable();
        for group in groups.chunk_by(|a, b| a.0 == b.0) {
            let number = self.creases.len() as u32;
            let sides: Vec<u32> = group.iter().map(|(_, side)| *side).collect();
            let (mut length, mut sum, mut signed) = (0.0, 0.0, 0.0);
            for side in &sides {
                self.crease_of[*side as usize] = number;
                self.crease_of[solid.twins[*side as usize] as usize] = number;
                let [a, b] = solid.ends(*side);
                let (long, angle) = ((b - a).norm(), solid.angle(*side));
                length += long;
                sum += long * angle.abs();
                signed += long * angle;
            }
            let (a, b) = (
                self.patch(sides[0]),
                self.patch(solid.twins[sides[0] as usize]),
            );
            let patches = [a.min(b), a.max(b)];
            let fold = sum / length.max(f64::MIN_POSITIVE);
            let lines = chains(
                sides
                    .iter()
                    .map(|side| half_edge_ends(&solid.triangles, *side))
                    .collect(),
            );
            self.creases.push(Crease {
                patches,
                points: (lines.first().into_iter().flatten())
                    .map(|v| solid.places[*v as usize].into())
                    .collect(),
                length,
                fold,
            });
            self.seams.push(Seam {
                crease: number as usize,
                patches,
                direction: if signed >= 0.0 {
                    Direction::Mountain
                } else {
                    Direction::Valley
                },
                angle: fold,
                slit: false,
                torn: false,
            });
        }
        Ok(())
    }

    fn sheet(&self, facets: &[u32], spacing: f64) -> Sheet {
        let solid = self.solid;
        let mut is_own = vec![false; solid.normals.len()];
        facets
            .iter()
            .for_each(|facet| is_own[*facet as usize] = true);
        let triangles: Vec<u32> = (0u32..)
            .zip(&solid.facets)
            .filter(|(_, facet)| is_own[**facet as usize])
            .map(|(t, _)| t)
            .collect();
        let sides: Vec<u32> = triangles.iter().flat_map(|t| 3 * t..3 * t + 3).collect();
        let mut own: Vec<u32> = facets
            .iter()
            .map(|f| self.patches.of[*f as usize])
            .collect();
        own.sort_unstable();
        own.dedup();
        Sheet {
            outlines: self.outlines(&sides),
            folds: self.folds(&sides),
            spots: own
                .iter()
                .filter_map(|patch| self.spot(*patch, &triangles))
                .collect(),
            faces: self.faces(&triangles),
            patches: own,
            spacing,
            area: facets
                .iter()
                .map(|facet| solid.areas[*facet as usize])
                .sum(),
            strain: 0.0,
            seam_gap: 0.0,
            loops: 0,
            refolding: None,
            exact: true,
        }
    }

    /// The closed lines around a piece, the longest first, each divided where the crease or the patch changes.
    fn outlines(&self, sides: &[u32]) -> Vec<Vec<Run>> {
        let mut is_done: FxHashMap<u32, bool> = (sides.iter())
            .filter(|side| !self.is_inside(**side))
            .map(|side| (*side, false))
            .collect();
        let mut lines = Vec::new();
        for first in sides {
            if is_done.get(first) != Some(&false) {
                continue;
            }
            let mut line = Vec::new();
            let mut side = *first;
            while is_done.insert(side, true) == Some(false) {
                line.push(side);
                side = self.next_on_outline(side);
            }
            let long = |side: &u32| {
                let [a, b] = self.solid.ends(*side);
                (b - a).norm()
            };
            lines.push((line.iter().map(long).sum::<f64>(), self.runs(&line)));
        }
        lines.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        lines.into_iter().map(|(_, runs)| runs).collect()
    }

    fn runs(&self, line: &[u32]) -> Vec<Run> {
        let key = |i: usize| {
            let side = line[i % line.len()];
            (self.crease_of[side as usize], self.patch(side))
        };
        let n = line.len();
        let start = (0..n).find(|i| key(*i) != key(i + n - 1)).unwrap_or(0);
        let mut order: Vec<usize> = (start..start + n).collect();
        if start == 0 && key(0) == key(n - 1) {
            // One run all around begins at a corner, if it has any.
            let place = |i: usize| self.net.placed_ends(line[i % n])[0];
            let turn = |i: usize| {
                let [a, b, c] = [place(i + n - 1), place(i), place(i + 1)];
                ((c - b) * (b - a).conj()).arg().abs()
            };
            let corner = (0..n).max_by(|a, b| turn(*a).total_cmp(&turn(*b)).then(b.cmp(a)));
            order.rotate_left(corner.unwrap_or(0));
        }
        let runs = order.chunk_by(|a, b| key(*a) == key(*b));
        runs.map(|run| {
            let side = line[run[0] % n];
            let crease = self.crease_of[side as usize];
            let seam = (crease != NO_INDEX).then(|| self.seams[crease as usize]);
            let mut points: Vec<Point2> = run
                .iter()
                .map(|i| self.net.placed_ends(line[i % n])[0])
                .collect();
            points.push(self.net.placed_ends(line[run[run.len() - 1] % n])[1]);
            if run.len() == n {
                points[run.len()] = points[0];
            }
            Run {
                seam,
                patch: seam.map(|_| self.patch(side)),
                ends: [None; 2],
                points: without_straight(&points, self.solid.rounding),
            }
        })
        .collect()
    }

    fn folds(&self, sides: &[u32]) -> Vec<Fold> {
        let mut of: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for side in sides {
            let (crease, twin) = (
                self.crease_of[*side as usize],
                self.solid.twins[*side as usize],
            );
            if crease != NO_INDEX && *side < twin && self.closed[*side as usize] {
                of.entry(crease).or_default().push(*side);
            }
        }
        let mut folds: Vec<Fold> = Vec::new();
        for (crease, sides) in of {
            let ends = |side: &u32| half_edge_ends(&self.solid.triangles, *side);
            let place: FxHashMap<u32, Point2> = (sides.iter())
                .flat_map(|side| {
                    let (from, to) = (ends(side), self.net.placed_ends(*side));
                    [(from[0], to[0]), (from[1], to[1])]
                })
                .collect();
            for line in chains(sides.iter().map(ends).collect()) {
                let points: Vec<Point2> = line.iter().map(|v| place[v]).collect();
                folds.push(Fold {
                    seam: self.seams[crease as usize],
                    bend: None,
                    ends: [None; 2],
                    points: without_straight(&points, self.solid.rounding),
                });
            }
        }
        let key = |fold: &Fold| (fold.seam.crease, fold.points[0]);
        folds.sort_by(|a, b| {
            let ((a, [x, _]), (b, [u, _])) = (key(a), key(b));
            a.cmp(&b).then(x.total_cmp(&u))
        });
        mark_bends(&mut folds, |fold| {
            let beside = fold.seam.patches.into_iter();
            let mut bent = beside.filter_map(|p| Some((p, self.radii[p as usize]?)));
            bent.next().filter(|_| fold.seam.angle <= MAX_BEND_STEP)
        });
        folds
    }

    /// Triangles of a piece; corners that lie on each other are one vertex.
    fn faces(&self, triangles: &[u32]) -> Faces {
        let mut faces = Faces::default();
        let mut found: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        let near = self.solid.rounding;
        if !self.solid.textured.is_empty() {
            let textured = triangles.iter().map(|t| self.solid.textured[*t as usize]);
            faces.textured = textured.collect();
        }
        for t in triangles {
            let placed = self.net.placed(*t);
            let corners = self.solid.triangles[*t as usize];
            faces.triangles.push([0, 1, 2].map(|k| {
                let at = placed[k];
                let all = found.entry(corners[k]).or_default();
                let same = all.iter().copied().find(|v| {
                    let [x, y]: [f64; 2] = faces.flat[*v as usize];
                    (Point2::new(x, y) - at).norm() <= near
                });
                same.unwrap_or_else(|| {
                    let number = faces.flat.len() as u32;
                    faces.flat.push([at.re, at.im]);
                    faces
                        .built
                        .push(self.solid.places[corners[k] as usize].into());
                    all.push(number);
                    number
                })
            }));
        }
        faces
    }

    /// A place for a patch's number: of the middles of its triangles and edges that which is farthest from its border.
    fn spot(&self, patch: u32, triangles: &[u32]) -> Option<Spot> {
        let own = |t: &&u32| self.patch(3 * **t) == patch;
        let own: Vec<u32> = triangles.iter().filter(own).copied().collect();
        let sides = || own.iter().flat_map(|t| 3 * t..3 * t + 3);
        let is_border = |side: &u32| {
            let twin = self.solid.twins[*side as usize];
            !self.closed[*side as usize] || self.patch(twin) != patch
        };
        let border: Vec<[Point2; 2]> = (sides().filter(is_border))
            .map(|side| self.net.placed_ends(side))
            .collect();
        let room = |place: Point2| {
            let away = border.iter().map(|edge| distance_to_segment(place, *edge));
            away.fold(f64::INFINITY, f64::min)
        };
        let middles = own
            .iter()
            .map(|t| self.net.placed(*t).iter().sum::<Point2>() / 3.0);
        let inner = sides().filter(|side| !is_border(side));
        let halves = inner.map(|side| {
            let [a, b] = self.net.placed_ends(side);
            0.5 * (a + b)
        });
        let all: Vec<Point2> = middles.chain(halves).collect();
        let step = all.len().div_ceil(MAX_LABEL_CANDIDATES);
        let tried = all
            .iter()
            .step_by(step.max(1))
            .map(|place| (room(*place), *place));
        let (room, place) = tried.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Spot {
            patch,
            place: [place.re, place.im],
            room,
        })
    }
}

/// Maximum number of points that are compared as the place of a patch's number.
const MAX_LABEL_CANDIDATES: usize = 200;

/// Joins edges, each given by its two vertices, to lines as long as they can be.
fn chains(mut edges: Vec<[u32; 2]>) -> Vec<Vec<u32>> {
    let mut lines = Vec::new();
    while let Some([a, b]) = edges.pop() {
        let mut line = std::collections::VecDeque::from([a, b]);
        let mut grown = true;
        while grown {
            grown = false;
            edges.retain(|edge| {
                let (first, last) = (line[0], line[line.len() - 1]);
                for [p, q] in [*edge, [edge[1], edge[0]]] {
                    if p == last {
                        line.push_back(q);
                    } else if p == first {
                        line.push_front(q);
                    } else {
                        continue;
                    }
                    grown = true;
                    return false;
                }
                true
            });
        }
        lines.push(line.into());
    }
    lines
}

/// Leaves out the points of a line at which it goes straight on.
fn without_straight(points: &[Point2], tolerance: f64) -> Vec<[f64; 2]> {
    let mut line: Vec<Point2> = Vec::with_capacity(points.len());
    for (i, p) in points.iter().enumerate() {
        if i > 0 && i + 1 < points.len() {
            let (a, b) = (line[line.len() - 1], points[i + 1]);
            let is_on = orientation(a, *p, b).abs() <= tolerance * (b - a).norm();
            let goes_on = ((b - p) * (p - a).conj()).re > 0.0;
            if (is_on && goes_on) || (p - a).norm() <= tolerance {
                continue;
            }
        }
        line.push(*p);
    }
    line.iter().map(|p| [p.re, p.im]).collect()
}
