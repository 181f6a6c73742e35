//! Which helpers and links pay: narrow searches for cheap forms, each with one of them.

use super::Progress;
use super::beam::{Beam, Entry};
use super::helper::Helper;
use super::link::Link;
use super::score::Data;
use super::space::{SearchSamples, Space};
use crate::fit::FitError;

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
    /// The part of the error that the aid took away, at the number of operations where that is most; 0 where no form with it is
    /// better than one without, or where it cannot be: a value that the link does not take.
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

/// Tries aids one by one: the smallest errors of a narrow search (width 4, two sweeps, at most 13 operations, few samples) with and
/// without.
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
    let plain = least(&narrow(space, &few, &|at| told(0, at)), |_| true);
    let one = |(k, aid): (usize, &Aid)| {
        let found = space.with(*aid).and_then(|aided| {
            let linked = match aid {
                Aid::Link(link) => link.linked(&few)?,
                Aid::Helper(_) => few.clone(),
            };
            Some(narrow(&aided, &linked, &|at| told(k + 1, at)))
        });
        let (gain, ops) = found.map_or((0.0, 0), |levels| gained(*aid, &levels, &plain));
        Trial { aid: *aid, gain, ops, admitted: gain >= PAYS }
    };
    let mut trials: Vec<Trial> = aids.iter().enumerate().map(one).collect();
    let helpers = trials.iter().filter(|t| t.admitted && matches!(t.aid, Aid::Helper(_)));
    let mut gains: Vec<f64> = helpers.map(|t| t.gain).collect();
    gains.sort_by(|a, b| b.total_cmp(a));
    if let Some(last) = gains.get(HELPERS - 1) {
        let dropped = |t: &&mut Trial| matches!(t.aid, Aid::Helper(_)) && t.gain < *last;
        trials.iter_mut().filter(dropped).for_each(|t| t.admitted = false);
    }
    Ok(trials)
}

/// Where forms with an aid take most away from the error of those without, which are among the same levels too.
fn gained(aid: Aid, levels: &[Vec<Entry>], plain: &[f64]) -> (f64, u32) {
    let has = |e: &Entry| match aid {
        Aid::Helper(helper) => e.form.helpers.iter().any(|h| h.kind == helper),
        Aid::Link(_) => true,
    };
    let (with, without) = (least(levels, has), least(levels, |e| !has(e)));
    let mut best = (0.0, 0);
    for (ops, ((with, without), plain)) in with.iter().zip(without).zip(plain).enumerate() {
        let gain = 1.0 - with / without.min(*plain);
        if gain > best.0 {
            best = (gain, ops as u32);
        }
    }
    best
}

fn narrow(space: &Space, samples: &SearchSamples, progress: &dyn Fn(&Progress)) -> Vec<Vec<Entry>> {
    let narrow = Space {
        width: space.width.min(WIDTH),
        sweeps: space.sweeps.min(SWEEPS),
        max_ops: space.max_ops.min(OPS),
        ..space.clone()
    };
    Beam::new(&narrow, Data::new(&narrow, samples)).run(progress)
}

/// The smallest error of the chosen forms, at every cost or below.
fn least(levels: &[Vec<Entry>], chosen: impl Fn(&Entry) -> bool) -> Vec<f64> {
    let mut least = f64::INFINITY;
    let best = |level: &Vec<Entry>| {
        least = level.iter().find(|e| chosen(e)).map_or(least, |e| least.min(e.score.max));
        least
    };
    levels.iter().map(best).collect()
}
