//! The free parameters: of least work at a given rate of wrongly culled boxes, chosen on some shots
//! and reported on others.

use rayon::prelude::*;
use serde::Serialize;

use crate::grid::Lod;
use crate::measure::{Measured, Tally, Trial, measured};
use crate::passes::{Passes, Work};
use crate::site::Site;
use crate::study::{Set, usual};
use lobefit::scene::{CameraPath, Culling};

/// Largest part of the visible boxes that parameters may cull on any of the shots that they are chosen
/// on, and of the hidden ones that they may keep on all of these together.
pub const ALLOWED: [f64; 2] = [0.005, 0.2];

/// Every path.
pub(crate) const PATHS: [CameraPath; 3] = [CameraPath::Turn, CameraPath::Strafe, CameraPath::Walk];

/// Places that shots start from, on each path. As on a chessboard: chosen on the corners and the middle,
/// reported on what lies between.
const CHOSEN_ON: [usize; 5] = [0, 2, 4, 6, 8];
const REPORTED_ON: [usize; 4] = [1, 3, 5, 7];
/// What a texel or voxel of each pass costs, so that counts of several passes can be added: nanoseconds of
/// a thread, medians over the rows of one record of `lobefit report --study occlusion --times` on an AMD
/// EPYC, those of splats spread from 0.5 to 13. Constants: no machine decides a choice.
pub(crate) const COST: Work<f64> =
    Work { reproject: 6.0, median: 1.5, accumulate: 17.0, voxels: 2.3, dilation: 1.2 };

/// A choice of the free parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Choice {
    /// The parameters.
    pub trial: Trial,
    /// On the shots that it was chosen on.
    pub chosen: OnShots,
    /// On the others.
    pub reported: OnShots,
}

/// What parameters do on several shots.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct OnShots {
    /// On all together.
    pub sum: Tally,
    /// On those of the path sideways together.
    pub sideways: Tally,
    /// Largest part of the visible boxes that is wrongly culled on any of them.
    pub most_culled: f64,
}

/// The scene's own parameters and the best ones.
#[derive(Clone, Debug, Serialize)]
pub struct Choices {
    /// The scene's own, with the usual values of what it does not say.
    pub usual: Choice,
    /// Of all that were tried those of least work, weighed by pass, that keep [`ALLOWED`]; where none do,
    /// those that keep least of what is hidden.
    pub best: Choice,
    /// Combinations of radii and levels of detail that were tried, each with the least margin that
    /// culls no more than is allowed.
    pub tried: usize,
}

/// What passes do on each shot.
struct OfPasses {
    passes: Passes,
    shots: Vec<(CameraPath, Measured)>,
}

impl OfPasses {
    fn at(&self, bias: f32) -> OnShots {
        let tallies: Vec<_> = self.shots.iter().map(|(path, shot)| (*path, shot.at(bias))).collect();
        let sum = |keep: &dyn Fn(CameraPath) -> bool| {
            let kept = tallies.iter().filter(|(path, _)| keep(*path));
            kept.fold(Tally::default(), |sum, (_, tally)| sum.plus(*tally))
        };
        OnShots {
            sum: sum(&|_| true),
            sideways: sum(&|path| path == CameraPath::Strafe),
            most_culled: tallies.iter().map(|(_, tally)| tally.wrongly_culled()).fold(0.0, f64::max),
        }
    }

    /// With the least margin that culls no more than is allowed on any shot.
    fn best(&self) -> (Trial, OnShots) {
        let bias = self.shots.iter().map(|(_, shot)| shot.least_bias(ALLOWED[0])).fold(0.0, f32::max);
        (Trial { passes: self.passes, bias }, self.at(bias))
    }
}

/// How much more of what is hidden is kept than allowed, then the work weighed by [`COST`], then what is
/// culled: less is better.
fn rank((_, found): &(Trial, OnShots)) -> (u64, u64, u64) {
    let kept = (found.sum.wrongly_kept() / ALLOWED[1]).max(1.0);
    let cost = found.sum.work.zip(COST, |count, each| count as f64 * each).total();
    // Bits of positive numbers have their order.
    (kept.to_bits(), cost.to_bits(), found.sum.culled)
}

/// What passes do on shots.
fn on(set: &Set, starts: &[usize], passes: &[Passes]) -> Vec<OfPasses> {
    let shots: Vec<_> =
        PATHS.into_iter().flat_map(|path| starts.iter().map(move |start| (path, *start))).collect();
    let one = |(path, start): &(CameraPath, usize)| {
        // The scene says how fine its depth is, whatever else is tried.
        let film = set.film(set.shot(*path, *start, 1.0), &[usual(set.culling).passes.fineness()]);
        measured(&film, &set.span(set.culling.latency as usize), passes)
    };
    let all: Vec<Vec<Measured>> = shots.par_iter().map(one).collect();
    let mut found: Vec<OfPasses> =
        passes.iter().map(|passes| OfPasses { passes: *passes, shots: Vec::new() }).collect();
    for ((path, _), of_shot) in shots.into_iter().zip(all) {
        found.iter_mut().zip(of_shot).for_each(|(found, one)| found.shots.push((path, one)));
    }
    found
}

/// Every combination of the radii and of levels of detail, with and without voxels. The margin needs
/// none: see [`Measured::least_bias`].
fn combinations(own: &Passes) -> Vec<Passes> {
    let lods = [[0.0, 0.0], [0.0, 24.0], [0.0, 96.0], [12.0, 48.0], [24.0, 96.0]];
    let voxels = lods.map(|[near, far]| Some(Lod { near, far })).into_iter().chain([None]);
    let half = own.half.or(Some(false));
    let mut all = Vec::new();
    for voxels in voxels {
        for [median, dilation] in [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2], [2, 0], [2, 1], [2, 2]] {
            let with = |erosion| Passes { half, median, voxels, dilation, erosion, ..Passes::NONE };
            all.extend((0..=3).map(with));
        }
    }
    all
}

/// Tries everything; reports the scene's own parameters and the best.
pub fn choices(culling: &Culling, site: &Site) -> Choices {
    let (set, own) = (&Set::new(culling, site), usual(culling));
    let all = combinations(&own.passes);
    let passes: Vec<Passes> = std::iter::once(own.passes).chain(all.iter().copied()).collect();
    let found = on(set, &CHOSEN_ON, &passes);
    let usual = found[0].at(own.bias);
    let best = found[1..].iter().map(OfPasses::best).min_by_key(rank);
    let (trial, chosen) = best.unwrap_or((own, usual));
    let others = on(set, &REPORTED_ON, &[own.passes, trial.passes]);
    Choices {
        usual: Choice { trial: own, chosen: usual, reported: others[0].at(own.bias) },
        best: Choice { trial, chosen, reported: others[1].at(trial.bias) },
        tried: all.len(),
    }
}
