//! Texels that are off by far more than the texels next to them, in a table of samples, whose errors
//! elsewhere are too large for damage to be known by its share of them.

use super::defects::{Defect, Grain, of_extent};
use super::errors::Residuals;
use super::extent::Extent;
use super::table::{flat, place};

/// At most so many, or one of `LARGE`: more are a part of the table.
const MOST: usize = 32;
const LARGE: usize = 4096;

/// One of so many texels, at most.
const SHARE: usize = 100;

/// How many times the largest error of the others each is off by. Of one set of points for all texels
/// (Hammersley's) the two largest errors are within a tenth of each other; where light grazes errors grow,
/// and fade to all sides. Of points drawn anew for each texel one may stand out so: too few samples.
pub(super) const GAP: f64 = 2.0;

/// The same of a texel at an end of an axis, where the hardest integrals are.
const GAP_AT_END: f64 = 8.0;

/// How many times the largest error of the texels next to it.
const STEEP: f64 = 4.0;

/// Texels that stand out so.
pub(super) struct Spikes {
    /// Their places in the sample, the worst first.
    pub off: Vec<usize>,
    /// The largest error of the others.
    pub rest: f64,
}

impl Spikes {
    /// The part of the table that they are.
    pub(super) fn part(&self, r: &Residuals) -> Defect {
        of_extent(r, Extent::of(r.sample, &self.off), &self.off, self.rest)
    }
}

/// The texels that stand out so; none where none does.
pub(super) fn spikes(r: &Residuals, grain: Grain) -> Option<Spikes> {
    let most = most(r).min(r.judged.len() / SHARE);
    let error = |i: usize| r.errors[i].abs();
    let mut largest = r.judged.clone();
    if most == 0 || largest.len() <= most {
        return None;
    }
    largest.select_nth_unstable_by(most, |a, b| error(*b).total_cmp(&error(*a)));
    largest.truncate(most + 1);
    largest.sort_by(|a, b| error(*b).total_cmp(&error(*a)).then(a.cmp(b)));
    let is_spike = |off: &[usize], i: usize| {
        let beside = beside(r, i).into_iter().filter(|j| !off.contains(j)).map(error);
        let beside = beside.fold(f64::NAN, f64::max);
        error(i) > grain.leaves(r, i) && error(i) >= STEEP * beside
    };
    let are_spikes = |k: &usize| {
        let (off, rest) = largest.split_at(*k);
        let gap = |i: &usize| if at_end(r, *i) { GAP_AT_END } else { GAP };
        off.iter().all(|i| error(*i) >= gap(i) * error(rest[0]) && is_spike(off, *i))
    };
    let k = (1..=most).rev().find(are_spikes)?;
    Some(Spikes { off: largest[..k].to_vec(), rest: error(largest[k]) })
}

fn most(r: &Residuals) -> usize {
    MOST.max(r.judged.len() / LARGE)
}

/// Whether texels are few, and none of them is next to another.
pub(super) fn are_apart(r: &Residuals, off: &[usize]) -> bool {
    let touches = |i: &usize| beside(r, *i).iter().any(|j| off.contains(j));
    off.len() > 1 && off.len() <= most(r) && !off.iter().any(touches)
}

/// Whether a texel is at an end of an axis of the table.
fn at_end(r: &Residuals, i: usize) -> bool {
    r.texel(i).iter().zip(&r.sample.size).any(|(k, n)| *k == 0 || k + 1 == *n)
}

/// The judged texels next to one, those across a corner among them.
fn beside(r: &Residuals, i: usize) -> Vec<usize> {
    let size = &r.sample.dims();
    let at = place(i, size);
    let steps = 3_usize.pow(size.len() as u32);
    let near = (0..steps).filter_map(|step| {
        let by = place(step, &vec![3; size.len()]);
        let moved = at.iter().zip(by).zip(size).map(|((k, by), n)| (k + by).checked_sub(1).filter(|k| k < n));
        moved.collect::<Option<Vec<usize>>>().map(|texel| flat(&texel, size))
    });
    near.filter(|j| *j != i && r.judged.binary_search(j).is_ok()).collect()
}
