//! Both sides of each cut made equally long, so that they can be joined.
//!
//! What little strain is left in a sheet shows along its border, where nothing holds it: one side of a
//! cut may be longer than the other by several times the strain. So both are asked to have the length
//! between, piece by piece, and are asked for more where they do not give way enough.

use super::assembly::{fault, folded};
use super::check::{Measure, Tied, marks};
use super::layout::Arrangement;
use super::line::length;
use super::net::Net;
use crate::error::Result;
use crate::flat::unroll::joint::Until;
use crate::flat::unroll::pieces::Point;

/// How often lengths are asked for.
const ROUNDS: usize = 8;

/// A difference that is none, as a share.
const EVEN: f64 = 5e-4;

/// The least length, in spacings, of what is measured.
const SHORT: f64 = 12.0;

/// Each round begins near its end.
const EFFORT: Until = Until {
    tolerance: 0.0,
    hopeless: f64::INFINITY,
    steps: 6,
};

/// A cut, the lengths that its pieces are to have, and what either side is asked for.
struct Cut {
    seam: usize,
    goals: Vec<f64>,
    asked: [Vec<f64>; 2],
}

impl Cut {
    fn pieces(net: &Net, seam: usize, side: usize) -> Vec<f64> {
        let points = &net.seams[seam].sides[side];
        let marks = marks(points.len());
        let piece = |pair: &[usize]| length(&points[pair[0]..=pair[1]]);
        marks.windows(2).map(piece).collect()
    }

    fn new(net: &Net, seam: usize) -> Cut {
        let [one, other] = [0, 1].map(|side| Cut::pieces(net, seam, side));
        let asked = [0, 1].map(|side| {
            let patch = net.seams[seam].patches[side];
            let marks = marks(net.seams[seam].nodes.len());
            let place = |mark: &usize| net.held(seam, *mark, patch);
            let places: Vec<Point> = marks.iter().map(place).collect();
            places.windows(2).map(|p| (p[1] - p[0]).norm()).collect()
        });
        Cut {
            seam,
            goals: one.iter().zip(other).map(|(a, b)| 0.5 * (a + b)).collect(),
            asked,
        }
    }

    /// Asks for more or less; the difference from the goal, as a share of it.
    fn ask(&mut self, net: &Net, side: usize) -> f64 {
        let found = Cut::pieces(net, self.seam, side);
        for ((asked, found), goal) in self.asked[side].iter_mut().zip(&found).zip(&self.goals) {
            if *found > 0.0 {
                *asked *= (goal / found).clamp(0.8, 1.25);
            }
        }
        let goal: f64 = self.goals.iter().sum();
        (found.iter().sum::<f64>() - goal).abs() / goal
    }
}

/// Makes the sides of cuts alike, as far as sheets stay what they have to be.
pub(super) fn evened(net: &mut Net, arrangement: &mut Arrangement, limit: f64) -> Result<()> {
    let layout = &mut arrangement.layout;
    let open = |seam: &usize| !layout.folded[*seam] && !net.is_torn(*seam);
    let long = |seam: &usize| length(&net.seams[*seam].sides[0]) > SHORT * net.spacing;
    let seams: Vec<usize> = (0..net.seams.len()).filter(open).filter(long).collect();
    let mut cuts: Vec<Cut> = seams.iter().map(|seam| Cut::new(net, *seam)).collect();
    for members in &arrangement.sheets {
        let mut tied = None;
        for _ in 0..ROUNDS {
            let (mut measures, mut worst) = (Vec::new(), 0.0f64);
            for cut in &mut cuts {
                for side in 0..2 {
                    let patch = net.seams[cut.seam].patches[side];
                    if members.binary_search(&patch).is_ok() {
                        worst = worst.max(cut.ask(net, side));
                        measures.push(Measure {
                            seam: cut.seam,
                            side,
                            lengths: cut.asked[side].clone(),
                        });
                    }
                }
            }
            if worst < EVEN {
                break;
            }
            let before: Vec<(u32, Vec<Point>)> = (members.iter())
                .filter_map(|p| Some((*p, net.leaves[*p as usize].as_ref()?.places().to_vec())))
                .collect();
            let motions = layout.motions.clone();
            let mut sheet = match tied.take() {
                Some(tied) => tied,
                None => {
                    let ties = folded(net, layout, members);
                    Tied::new(net, layout, members, &ties, &measures)?
                }
            };
            sheet.ask(&measures);
            sheet.relax(net, layout, EFFORT)?;
            if fault(net, layout, members, limit).is_some() {
                layout.motions = motions;
                for (patch, places) in before {
                    net.set_places(patch, places);
                }
                break;
            }
            tied = Some(sheet);
        }
    }
    Ok(())
}
