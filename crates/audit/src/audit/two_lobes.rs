//! A table of which a part, or a channel, was made with the other shadowing form: stale since the code around
//! it changed. No single convention fits it, and those that do best are compromises; the right one is
//! that under which each texel is of one lobe or of the other.

use rayon::prelude::*;

use super::best::{CLOSE, Case};
use super::column::Column;
use super::convention::{Fixed, Misfit};
use super::defects::{Defect, Grain, without};
use super::errors::{Residuals, rms};
use super::extent::Extent;
use super::judge::{Judgement, judge};
use super::lobe::Lobe;
use super::sample::{Candidate, Sample};
use super::table::Source;
use super::truth::{Truth, Truths};
use super::{AuditError, FITS};

/// The root mean square must be this many times less with two lobes than that of the best with one
/// is.
const BETTER: f64 = 4.0;

/// Least share of the texels that each of the lobes explains and the other does not.
const LEAST_SHARE: f64 = 0.05;

/// A texel tells lobes apart where their errors differ by this many times the misfit of both
/// together.
const APART: f64 = 6.0;

/// And by more than a step of the format, in halves of it.
const A_STEP: f64 = 2.0;

/// What some texels, by the quick truth, may leave more than all do.
const LIKELY: f64 = 2.0;

/// The two parts of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoLobes {
    /// Lobe of the smaller part.
    pub lobe: Lobe,
    /// Texels that are of the larger part's lobe only, of the smaller part's only, and in all; the
    /// rest is the same in both.
    pub texels: [usize; 3],
    /// Where the smaller part lies.
    pub extent: Extent,
    /// Largest error at the smaller part's texels under its own lobe.
    pub max: f64,
    /// Root mean square of the largest error of all channels, under the lobe that suits each texel.
    pub rms: f64,
}

/// The reading under which a table that fits nothing is of two lobes, read as the larger part's,
/// with its parts; none if it is not so. `grains` are those of the channels, `tried` are readings, and `best`
/// is the best with one lobe.
pub(super) fn found<'a>(
    truth: &Truth<'a>,
    [some, all]: [&Sample; 2],
    (fixed, grains): (&Fixed, &[Grain]),
    tried: &[Candidate],
    best: &Candidate,
) -> Result<Option<(Candidate, TwoLobes)>, AuditError> {
    let lobes = fixed.lobes(truth);
    let pairs = tried.iter().flat_map(|candidate| {
        let own = candidate.lobe;
        let others = lobes.iter().copied().filter(move |l| *l != own && may_change(truth, *l, own));
        others.map(move |other| (candidate, [own, other]))
    });
    let pairs: Vec<(&Candidate, [usize; 2])> = pairs.collect();
    let parts = |(candidate, both): &(&Candidate, [usize; 2]), sample, values: Truths<'a>| {
        let [own, second] = both.map(|lobe| judge(truth, sample, &candidate.axes, lobe, values));
        Ok::<_, AuditError>(Parts::new(sample, &candidate.fitted.columns, grains, [own?, second?]))
    };
    let with_one =
        |sample, values| Ok::<_, AuditError>(parts(&(best, [best.lobe; 2]), sample, values)?.left());
    let quick: Vec<Parts> =
        pairs.par_iter().map(|pair| parts(pair, some, Truth::quick)).collect::<Result<_, _>>()?;
    let ranks: Vec<f64> = quick.par_iter().map(|parts| parts.misfit().rank()).collect();
    let Some(first) = (0..ranks.len()).min_by(|a, b| ranks[*a].total_cmp(&ranks[*b])) else {
        return Ok(None);
    };
    if !quick[first].explain(LIKELY, with_one(some, Truth::quick)?) {
        return Ok(None);
    }
    let (candidate, both) = pairs[first];
    let parts = parts(&pairs[first], all, Truth::exact)?;
    let misfit = parts.misfit();
    if !parts.explain(1.0, with_one(all, Truth::exact)?) {
        return Ok(None);
    }
    let sides = [parts.of(0), parts.of(1)];
    let least = LEAST_SHARE * parts.texels.len() as f64;
    if sides.iter().any(|side| (side.len() as f64) < least) {
        return Ok(None);
    }
    let smaller = usize::from(sides[1].len() <= sides[0].len());
    let counts = [sides[1 - smaller].len(), sides[smaller].len(), parts.texels.len()];
    let max = sides[smaller].iter().map(|i| parts.errors[smaller][*i]).fold(0.0, f64::max);
    let two_lobes = TwoLobes {
        lobe: truth.lobes[both[smaller]],
        texels: counts,
        extent: Extent::of(all, &sides[smaller]),
        max,
        rms: misfit.rms,
    };
    Ok(Some((Candidate { lobe: both[1 - smaller], ..candidate.clone() }, two_lobes)))
}

/// The channels that are of another lobe than those beside them, by channel: by the convention they are off,
/// others are not, and by the other lobe they are not.
pub(super) fn of_some(
    truth: &Truth,
    case: &Case,
    (sample, judgement): (&Sample, &Judgement),
    best: &Candidate,
) -> Result<Vec<Option<Defect>>, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let mut found = vec![None; table.channels.len()];
    let judged: Vec<(usize, Residuals)> = live
        .iter()
        .zip(sample.values.iter().zip(&best.fitted.columns))
        .filter_map(|(k, (values, column))| Some((*k, Residuals::new(sample, judgement, (*column)?, values))))
        .collect();
    let off = |k: usize, r: &Residuals| {
        let grain = Grain::of(table, k, fixed);
        without(r.rms(&r.judged), grain.rms(r.judged.iter().map(|i| r.values[*i]))) / r.bounded(&r.judged)
    };
    let is_off: Vec<bool> = judged.iter().map(|(k, r)| off(*k, r) > CLOSE).collect();
    if table.source == Source::Function || is_off.iter().all(|off| *off) || !is_off.contains(&true) {
        return Ok(found);
    }
    for lobe in fixed.lobes(truth).into_iter().filter(|l| *l != best.lobe && may_change(truth, *l, best.lobe))
    {
        let other = judge(truth, sample, &best.axes, lobe, Truth::exact)?;
        for ((k, own), _) in judged.iter().zip(&is_off).filter(|(_, off)| **off) {
            let under = Residuals::new(sample, &other, own.column, own.values);
            let is_judged = under.judged.len() == own.judged.len();
            if found[*k].is_none() && is_judged && BETTER * off(*k, &under) <= off(*k, own) {
                let (worst, lobe) = (own.worst(), truth.lobes[lobe]);
                let (most, texel) = (own.errors[worst].abs(), own.texel(worst));
                found[*k] = Some(Defect::ChannelLobe { lobe, column: own.column, most, texel });
            }
        }
    }
    Ok(found)
}

/// Whether two lobes are of one side and of the quantity's own forms: nobody changes Schlick's for
/// another.
fn may_change(truth: &Truth, a: usize, b: usize) -> bool {
    let [a, b] = [a, b].map(|lobe| truth.lobes[lobe]);
    (a.side, a.both) == (b.side, b.both) && a.form.integrand.is_none() && b.form.integrand.is_none()
}

/// Errors under two lobes.
struct Parts {
    /// Texels that are judged.
    texels: Vec<usize>,
    /// Largest magnitude of all channels, under either lobe, at every texel of the sample.
    errors: [Vec<f64>; 2],
    /// Largest difference of truths, of any channel.
    spread: f64,
    /// Root mean square of half a step of the format.
    rounding: f64,
}

impl Parts {
    fn new(
        sample: &Sample,
        columns: &[Option<Column>],
        grains: &[Grain],
        judgements: [Judgement; 2],
    ) -> Parts {
        let texels: Vec<usize> =
            (0..judgements[0].judged.len()).filter(|i| judgements[0].judged[*i]).collect();
        let all = judgements[0].base.len();
        let (mut errors, mut rounding) = ([vec![0.0_f64; all], vec![0.0; all]], vec![0.0_f64; all]);
        let mut spread = 0.0_f64;
        for ((channel, column), grain) in sample.values.iter().zip(columns).zip(grains) {
            let Some(column) = column else { continue };
            texels.iter().for_each(|i| rounding[*i] = rounding[*i].max(grain.rounding(channel[*i])));
            for (errors, judgement) in errors.iter_mut().zip(&judgements) {
                let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
                for i in &texels {
                    let truth = column.value(judgement.base[*i]);
                    errors[*i] = errors[*i].max((channel[*i] - truth).abs());
                    (low, high) = (low.min(truth), high.max(truth));
                }
                spread = spread.max(high - low);
            }
        }
        let rounding = rms(texels.iter().map(|i| rounding[*i]));
        Parts { texels, errors, spread, rounding }
    }

    /// Whether they leave clearly less than the `best` with one lobe, and little; `slack` times as much
    /// where they are judged quickly. Where rounding explains both, the texels that tell lobes apart decide.
    fn explain(&self, slack: f64, best: f64) -> bool {
        let left = self.left();
        left * BETTER <= slack * best && left <= slack * FITS * self.spread
    }

    /// Root mean square but for what rounding may leave: of the largest of some channels up to half a step.
    fn left(&self) -> f64 {
        without(self.misfit().rms, self.rounding)
    }

    /// Of the lobe that suits each texel.
    fn misfit(&self) -> Misfit {
        let least = |i: &usize| self.errors[0][*i].min(self.errors[1][*i]);
        Misfit::of(&self.texels.iter().map(least).collect::<Vec<f64>>())
    }

    /// Texels that are of one lobe and not of the other.
    fn of(&self, lobe: usize) -> Vec<usize> {
        let least = (APART * self.left()).max(A_STEP * self.rounding).max(1e-9);
        let [own, other] = [lobe, 1 - lobe].map(|lobe| &self.errors[lobe]);
        let apart = |i: &&usize| other[**i] - own[**i] > least;
        self.texels.iter().filter(apart).copied().collect()
    }
}
