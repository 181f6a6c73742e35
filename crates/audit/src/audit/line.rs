//! A row, column or slice that departs from all others of its axis, as it was not made again, or holds what
//! its neighbour holds.

use super::defects::{Defect, Grain, SEEN, of_extent, repeated_lines, without};
use super::errors::Residuals;
use super::extent::Extent;
use super::table::place;

/// A line stands out where its root mean square is this many times that of any other.
const APART: f64 = 6.0;

/// The same at an end of an axis, where errors grow by themselves.
const APART_AT_END: f64 = 24.0;

/// Fewest lines of an axis of which one may stand out.
const LINES: usize = 5;

/// Lines that hold what the next to them has of its own, though their truths differ: the first or last of a
/// table that was padded.
pub(super) fn copies(r: &Residuals, grain: Grain) -> Option<Defect> {
    let (dims, least) = (r.sample.dims(), SEEN * r.spread());
    repeated_lines(r).iter().enumerate().find_map(|(axis, repeated)| {
        let lines = lines(r, axis);
        let mut groups = (1..dims[axis]).filter(|k| repeated[*k] && !repeated[k - 1]).map(|k| {
            let last = (k..dims[axis]).take_while(|k| repeated[*k]).last().unwrap_or(k);
            k - 1..=last
        });
        groups.find_map(|group| {
            let own = group.clone().min_by(|a, b| r.rms(&lines[*a]).total_cmp(&r.rms(&lines[*b])))?;
            let is_off = |k: &usize| *k != own && group.contains(k);
            let of = |off: bool| -> Vec<usize> {
                let some = (0..dims[axis]).filter(|k| is_off(k) == off);
                some.flat_map(|k| lines[k].iter().copied()).collect()
            };
            let (off, others) = (of(true), of(false));
            let is_seen = off.iter().any(|i| r.errors[*i].abs() > least.max(grain.leaves(r, *i)));
            // Lines that a clamp makes one have the errors of the one.
            let beyond = |list: &[usize]| without(r.rms(list), grain.rms(list.iter().map(|i| r.values[*i])));
            let rounding = grain.rms(off.iter().map(|i| r.values[*i]));
            let usual = (APART * beyond(&others).max(beyond(&lines[own]))).max(rounding);
            let stands_out = beyond(&off) > usual && is_seen;
            let rest = r.rms(&others);
            stands_out.then(|| of_extent(r, Extent::of(r.sample, &off), &off, rest))
        })
    })
}

/// The judged texels of every line of an axis.
fn lines(r: &Residuals, axis: usize) -> Vec<Vec<usize>> {
    let dims = r.sample.dims();
    let mut lines = vec![Vec::new(); dims[axis]];
    r.judged.iter().for_each(|i| lines[place(*i, &dims)[axis]].push(*i));
    lines
}

/// The line that stands out so.
pub(super) fn line(r: &Residuals, grain: Grain) -> Option<Defect> {
    let dims = r.sample.dims();
    let least = SEEN * r.spread();
    (0..dims.len()).filter(|axis| dims.len() > 1 && dims[*axis] >= LINES).find_map(|axis| {
        let lines = lines(r, axis);
        let rms: Vec<f64> = lines.iter().map(|line| r.rms(line)).collect();
        let worst = (0..rms.len()).max_by(|a, b| rms[*a].total_cmp(&rms[*b]))?;
        let others = (0..rms.len()).filter(|k| *k != worst).map(|k| rms[k]).fold(0.0, f64::max);
        let at_end = worst == 0 || worst + 1 == rms.len();
        let apart = if at_end { APART_AT_END } else { APART };
        let off = &lines[worst];
        let is_seen = off.iter().any(|i| r.errors[*i].abs() > least.max(grain.leaves(r, *i)));
        let stands_out = rms[worst] > apart * others && is_seen;
        stands_out.then(|| of_extent(r, Extent::of(r.sample, off), off, others))
    })
}
