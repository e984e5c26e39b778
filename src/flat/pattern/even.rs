//! Both sides of each cut made equally long, so that they can be joined.
//!
//! What little strain is left in a sheet shows along its border, where nothing holds it: one side of a
//! cut may be longer than the other by several times the strain. So both are asked to have the length
//! between, piece by piece, and are asked for more where they do not give way enough.

use std::collections::BTreeMap;

use super::assembly::{fault, folded};
use super::check::{Measure, Tied, marks};
use super::layout::Arrangement;
use super::line::length;
use super::net::Net;
use super::outline::Layout;
use super::shape::{Side, lines};
use crate::error::Result;
use crate::flat::unroll::joint::Until;
use crate::flat::unroll::pieces::Point;

/// How often lengths are asked for.
const ROUNDS: usize = 8;

/// A difference that is none, as a share.
const EVEN: f64 = 5e-4;

/// The least lengths, in spacings, of what is measured, one after the other.
const SHORTEST: [f64; 2] = [12.0, 5.0];

/// Where one side is drawn longer or shorter than the other by more, in spacings, sheets are not stretched
/// for the rest: there its line ends elsewhere.
const MOST: f64 = 0.5;

/// Each round begins near its end.
const EFFORT: Until = Until {
    tolerance: 0.0,
    hopeless: f64::INFINITY,
    steps: 6,
};

/// A cut, and the lengths that its pieces are to have.
struct Cut {
    seam: usize,
    /// As found, halfway between both sides.
    goals: Vec<f64>,
    /// How much longer each side is drawn than its nodes are: lines go on to the border, and meet others
    /// at their ends.
    beyond: [f64; 2],
    /// The mean of both at first.
    usual: f64,
    /// The length that both sides are to be drawn with.
    drawn: f64,
    /// What either side is asked for.
    asked: [Vec<f64>; 2],
}

/// The length that each side of each seam is drawn with.
type Drawn = BTreeMap<Side, f64>;

impl Cut {
    fn pieces(net: &Net, seam: usize, side: usize) -> Vec<f64> {
        let points = &net.seams[seam].sides[side];
        let marks = marks(points.len());
        let piece = |pair: &[usize]| length(&points[pair[0]..=pair[1]]);
        marks.windows(2).map(piece).collect()
    }

    fn new(net: &Net, seam: usize, drawn: &Drawn) -> Cut {
        let [one, other] = [0, 1].map(|side| Cut::pieces(net, seam, side));
        let asked = [0, 1].map(|side| {
            let patch = net.seams[seam].patches[side];
            let marks = marks(net.seams[seam].nodes.len());
            let place = |mark: &usize| net.held(seam, *mark, patch);
            let places: Vec<Point> = marks.iter().map(place).collect();
            places.windows(2).map(|p| (p[1] - p[0]).norm()).collect()
        });
        let mut cut = Cut {
            seam,
            goals: one.iter().zip(&other).map(|(a, b)| 0.5 * (a + b)).collect(),
            beyond: [0.0; 2],
            usual: 0.0,
            drawn: 0.0,
            asked,
        };
        let found: f64 = cut.goals.iter().sum();
        let both = net.seams[seam]
            .patches
            .map(|patch| drawn.get(&(seam, patch)));
        if let [Some(one), Some(other)] = both {
            cut.usual = 0.5 * (one + other) - found;
        }
        cut.drawn = found + cut.usual;
        for side in 0..2 {
            cut.look(net, side, drawn);
        }
        cut
    }

    /// Sees how a side is drawn now.
    fn look(&mut self, net: &Net, side: usize, drawn: &Drawn) {
        let found: f64 = Cut::pieces(net, self.seam, side).iter().sum();
        let patch = net.seams[self.seam].patches[side];
        let beyond = drawn
            .get(&(self.seam, patch))
            .map_or(0.0, |all| all - found);
        self.beyond[side] = beyond.clamp(-MOST * found, MOST * found);
    }

    /// Asks for more or less; the difference from the goal, as a share of it.
    fn ask(&mut self, net: &Net, side: usize) -> f64 {
        let found = Cut::pieces(net, self.seam, side);
        let share = (self.drawn - self.beyond[side]) / self.goals.iter().sum::<f64>();
        for ((asked, found), goal) in self.asked[side].iter_mut().zip(&found).zip(&self.goals) {
            if *found > 0.0 {
                *asked *= (share * goal / found).clamp(0.8, 1.25);
            }
        }
        (found.iter().sum::<f64>() + self.beyond[side] - self.drawn).abs() / self.drawn
    }
}

/// The lengths that a sheet's sides are drawn with.
fn drawn(net: &Net, layout: &Layout, members: &[u32]) -> Drawn {
    let mut drawn = Drawn::new();
    for (side, points) in lines(net, layout, members).0.into_iter().flatten() {
        if let Some(side) = side {
            *drawn.entry(side).or_default() += length(&points);
        }
    }
    drawn
}

/// Makes the sides of cuts alike, as far as sheets stay what they have to be.
pub(super) fn evened(net: &mut Net, arrangement: &mut Arrangement, limit: f64) -> Result<()> {
    let Arrangement { layout, sheets } = arrangement;
    // What is short differs by more of its length, and costs strain that the others may need.
    for shortest in SHORTEST {
        let of = |members: &Vec<u32>| drawn(net, layout, members);
        let all: Drawn = sheets.iter().flat_map(of).collect();
        let open = |seam: &usize| {
            let long = length(&net.seams[*seam].sides[0]) > shortest * net.spacing;
            long && !layout.folded[*seam] && !net.is_torn(*seam)
        };
        let mut cuts: Vec<Cut> = (0..net.seams.len())
            .filter(open)
            .map(|seam| Cut::new(net, seam, &all))
            .collect();
        for members in sheets.iter() {
            even(net, layout, members, &mut cuts, limit)?;
        }
    }
    Ok(())
}

/// The same for one sheet.
fn even(
    net: &mut Net,
    layout: &mut Layout,
    members: &[u32],
    cuts: &mut [Cut],
    limit: f64,
) -> Result<()> {
    let own = |net: &Net, seam: usize, side: usize| {
        members
            .binary_search(&net.seams[seam].patches[side])
            .is_ok()
    };
    let mut tied: Option<Tied> = None;
    for _ in 0..ROUNDS {
        let now = drawn(net, layout, members);
        let (mut measures, mut worst) = (Vec::new(), 0.0f64);
        for cut in cuts.iter_mut() {
            let seam = cut.seam;
            for side in (0..2).filter(|side| own(net, seam, *side)) {
                cut.look(net, side, &now);
                worst = worst.max(cut.ask(net, side));
                measures.push(Measure {
                    seam: cut.seam,
                    side,
                    lengths: cut.asked[side].clone(),
                });
            }
        }
        if worst < EVEN {
            break;
        }
        let before: Vec<(u32, Vec<Point>)> = (members.iter())
            .filter_map(|p| {
                let leaf = net.leaves[*p as usize].as_ref()?;
                let motion = layout.motions[*p as usize];
                Some((
                    *p,
                    leaf.places()
                        .iter()
                        .map(|place| motion.of(*place))
                        .collect(),
                ))
            })
            .collect();
        let sheet = match tied.as_mut() {
            Some(tied) => tied,
            None => {
                let ties = folded(net, layout, members);
                tied.insert(Tied::new(net, layout, members, &ties, &measures)?)
            }
        };
        sheet.ask(&measures);
        sheet.relax(net, layout, EFFORT)?;
        if fault(net, layout, members, limit).is_none() {
            continue;
        }
        // Half of the way, or none.
        for share in [0.5, 0.0] {
            for (patch, places) in &before {
                let Some(leaf) = net.leaves[*patch as usize].as_ref() else {
                    continue;
                };
                let pairs = places.iter().zip(leaf.places());
                let between = pairs.map(|(from, to)| from + (to - from) * share).collect();
                net.set_places(*patch, between);
            }
            if fault(net, layout, members, limit).is_none() {
                break;
            }
        }
        break;
    }
    Ok(())
}
