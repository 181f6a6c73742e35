//! Which helpers and links pay: narrow searches for cheap forms, each with one of them.

use super::beam::{Beam, Entry};
use super::finish::solved;
use super::helper::Helper;
use super::link::Link;
use super::score::Data;
use super::space::{SearchSamples, Space};
use super::{Found, Progress};
use crate::FitError;

/// What a form may have beside sums of powers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aid {
    /// A function of the inputs, as a factor of terms.
    Helper(Helper),
    /// A function of the form's value.
    Link(Link),
}

/// What a narrow search with one aid gained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// What was tried.
    pub aid: Aid,
    /// The part of the error that the aid took away, at the number of operations where that is
    /// most; 0 where no form with it is better than one without, or where it cannot be: a value
    /// that the link does not take.
    pub gain: f64,
    /// That number of operations.
    pub ops: u32,
    /// Whether it pays: it gains 3 % or more, and, a helper, no two others gain more.
    pub admitted: bool,
}

/// Forms of each cost that are built upon, and sweeps, of a narrow search.
const WIDTH: usize = 4;
const SWEEPS: usize = 2;

/// Most operations of a narrow search.
const OPS: u32 = 13;

/// What pays takes away this part of the error.
const PAYS: f64 = 0.03;

/// Helpers that are admitted: each doubles the forms of a search.
const HELPERS: usize = 2;

/// Samples of a narrow search, of all and of those on edges.
const SAMPLES: [usize; 2] = [160, 100];

/// Tries aids one by one: the smallest errors of a narrow search (width 4, two sweeps, at most 13
/// operations, few samples) with and without.
///
/// # Errors
/// As [`super::search`], but for spaces without any form.
pub fn scout(
    space: &Space,
    aids: &[Aid],
    samples: &SearchSamples,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Trial>, FitError> {
    space.check(samples)?;
    let few = samples.some(SAMPLES);
    let count = aids.len() + 1;
    let told = |k: usize, at: &Progress| progress(&Progress { trial: Some([k + 1, count]), ..*at });
    let plain = narrow(space, &few, &|at| told(0, at));
    let mut trials = Vec::new();
    for (k, aid) in aids.iter().enumerate() {
        let told = |at: &Progress| told(k + 1, at);
        let (gain, ops) = match (space.with(*aid), aid) {
            (None, _) => (0.0, 0),
            (Some(aided), Aid::Helper(helper)) => of_helper(*helper, &narrow(&aided, &few, &told), &plain),
            (Some(aided), Aid::Link(link)) => match link.linked(&few) {
                Some(linked) => {
                    let levels = narrow(&aided, &linked, &told);
                    of_link((&aided, &linked, levels), (space, &few, &plain))?
                }
                None => (0.0, 0),
            },
        };
        trials.push(Trial { aid: *aid, gain, ops, admitted: gain >= PAYS });
    }
    let helpers = trials.iter().filter(|t| t.admitted && matches!(t.aid, Aid::Helper(_)));
    let mut gains: Vec<f64> = helpers.map(|t| t.gain).collect();
    gains.sort_by(|a, b| b.total_cmp(a));
    if let Some(last) = gains.get(HELPERS - 1) {
        let dropped = |t: &&mut Trial| matches!(t.aid, Aid::Helper(_)) && t.gain < *last;
        trials.iter_mut().filter(dropped).for_each(|t| t.admitted = false);
    }
    Ok(trials)
}

type Levels = [Vec<Entry>];

/// Where forms with a helper take most away from the error of those without, which are among the
/// same levels too.
fn of_helper(helper: Helper, levels: &Levels, plain: &Levels) -> (f64, u32) {
    let has = |e: &Entry| e.form.helpers.iter().any(|h| h.kind == helper);
    let (with, without) = (least(levels, has), least(levels, |e| !has(e)));
    let plain = least(plain, |_| true);
    most(&with, &without.iter().zip(plain).map(|(a, b)| a.min(b)).collect::<Vec<_>>())
}

/// The same of a link. Its levels are ranked by errors of what is put into it, so both are solved,
/// and measured by those of the value.
fn of_link(
    (aided, linked, levels): (&Space, &SearchSamples, Vec<Vec<Entry>>),
    (space, samples, plain): (&Space, &SearchSamples, &Levels),
) -> Result<(f64, u32), FitError> {
    let without = solved(&small(space), samples, samples, plain.to_vec())?;
    let with = solved(&small(aided), linked, samples, levels)?;
    let at = |found: &[Found], ops: usize| {
        let cheap = found.iter().filter(|f| f.ops as usize <= ops);
        cheap.map(|f| f.max).fold(f64::INFINITY, f64::min)
    };
    let all = |found: &[Found]| (0..plain.len()).map(|ops| at(found, ops)).collect::<Vec<_>>();
    Ok(most(&all(&with), &all(&without)))
}

/// The largest part of the second errors that the first are without, and at how many operations.
fn most(with: &[f64], without: &[f64]) -> (f64, u32) {
    let mut best = (0.0, 0);
    for (ops, (with, without)) in with.iter().zip(without).enumerate() {
        let gain = 1.0 - with / without;
        if gain > best.0 {
            best = (gain, ops as u32);
        }
    }
    best
}

fn small(space: &Space) -> Space {
    Space {
        width: space.width.min(WIDTH),
        sweeps: space.sweeps.min(SWEEPS),
        max_ops: space.max_ops.min(OPS),
        domain: None,
        ..space.clone()
    }
}

fn narrow(space: &Space, samples: &SearchSamples, progress: &dyn Fn(&Progress)) -> Vec<Vec<Entry>> {
    let narrow = small(space);
    Beam::new(&narrow, Data::new(&narrow, samples), &[]).run(progress)
}

/// The smallest error of the chosen forms, at every cost or below.
fn least(levels: &Levels, chosen: impl Fn(&Entry) -> bool) -> Vec<f64> {
    let mut least = f64::INFINITY;
    let best = |level: &Vec<Entry>| {
        least = level.iter().find(|e| chosen(e)).map_or(least, |e| least.min(e.score.max));
        least
    };
    levels.iter().map(best).collect()
}
