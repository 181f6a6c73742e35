//! The search for two functions that make one formula with a further argument.

use rayon::prelude::*;

use super::beam::{Beam, Entry};
use super::draft::{Draft, Part};
use super::finish::{best, column, finished};
use super::form::Form;
use super::pairing::{Pairing, write_pair};
use super::score::{Data, Known, Score};
use super::space::{SearchSamples, Space};
use super::write::Written;
use super::{Found, Progress};
use crate::FitError;
use lobefit_shade::{Domain, ShadeError};

/// What is searched: forms of two functions u and v, which have the same axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Beginning of the names of the formulas; their operations are appended.
    pub name: String,
    /// Name of the further argument.
    pub argument: String,
    /// Forms of u; its name is that of u in a formula.
    pub first: Space,
    /// What may be v.
    pub seconds: Vec<Second>,
    /// Most operations of a formula.
    pub max_ops: u32,
    /// Where the formulas must have no pole, the further argument included. None: not proven.
    pub domain: Option<Domain>,
}

/// A function v that makes the formula with u.
#[derive(Clone, Debug, PartialEq)]
pub struct Second {
    /// How a formula is made of u, v and the further argument.
    pub pairing: Pairing,
    /// First lines of a formula's documentation.
    pub title: String,
    /// Forms of v; its name is that of v in a formula.
    pub space: Space,
    /// What v should be at every sample.
    pub truth: Vec<f64>,
}

/// Where u, v and the formula are sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct PairSamples {
    /// One column per axis.
    pub axes: Vec<Vec<f64>>,
    /// What u should be.
    pub first: Vec<f64>,
    /// Values of the further argument, at least one of them below 1.
    pub at: Vec<f64>,
}

/// Forms of each cost and function that are paired.
const PAIRED: usize = 6;

/// A form is paired if its error is below this multiple of the best that is as cheap.
const WORSE: f64 = 1.3;

/// Pairs of each cost that are solved.
const FINALISTS: usize = 3;

/// Operations that two functions may have in common, or that a common division saves, at most.
const COMMON: u32 = 8;

/// Searches forms of u and of v, each residual weighted by the error that it makes; pairs them; and
/// solves the best pairs: first u, then v for the u that was found. The frontier by rising cost.
///
/// # Errors
/// As [`super::search`]; functions of different axes, a further argument that is nowhere below 1.
pub fn search_pair(
    pair: &Pair,
    samples: &PairSamples,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    let refuse =
        |message: &str| Err(ShadeError::Domain { input: pair.name.clone(), message: message.into() }.into());
    if pair.seconds.iter().any(|second| second.space.axes != pair.first.axes) {
        return refuse("both functions of a pair have the same axes");
    }
    if pair.first.link.is_some() || pair.seconds.iter().any(|second| second.space.link.is_some()) {
        return refuse("the functions of a pair are put into no other");
    }
    if !samples.at.iter().any(|t| *t < 1.0) {
        return refuse("the further argument is nowhere below 1");
    }
    let mut found = Vec::new();
    let mut firsts: Vec<(SearchSamples, Vec<Entry>)> = Vec::new();
    for second in &pair.seconds {
        let weighted = samples.weighted(second);
        pair.first.check(&weighted[0])?;
        second.space.check(&weighted[1])?;
        // The same errors of u: the same forms.
        let known = firsts.iter().position(|(own, _)| *own == weighted[0]).unwrap_or_else(|| {
            firsts.push((weighted[0].clone(), candidates(&pair.first, &weighted[0], progress)));
            firsts.len() - 1
        });
        let seconds = candidates(&second.space, &weighted[1], progress);
        let way = Way { pair, samples, second, first: &weighted[0] };
        found.extend(way.solved(&firsts[known].1, &seconds)?);
    }
    best(found, &Space { name: pair.name.clone(), ..pair.first.clone() }, pair.max_ops)
}

impl PairSamples {
    /// Samples of u and of v by themselves, where the other is exact: an error of the one is
    /// multiplied by the most that the formula makes of it.
    fn weighted(&self, second: &Second) -> [SearchSamples; 2] {
        let samples = |truth: &[f64], other: &[f64], of: fn(Pairing, f64, f64) -> f64| {
            let most = |y: &f64| self.at.iter().map(|t| of(second.pairing, *t, *y).abs()).fold(0.0, f64::max);
            let scale: Vec<f64> = other.iter().map(most).collect();
            let target = scale.iter().zip(truth).map(|(s, x)| s * x).collect();
            SearchSamples { axes: self.axes.clone(), scale, target }
        };
        let of_first = |pairing: Pairing, t: f64, v: f64| pairing.of_first(t, v);
        let of_second = |pairing: Pairing, t: f64, u: f64| pairing.of_second(t, u)[0];
        [samples(&self.first, &second.truth, of_first), samples(&second.truth, &self.first, of_second)]
    }
}

/// The best forms of every cost, as long as they are not much worse than cheaper ones.
fn candidates(space: &Space, samples: &SearchSamples, progress: &dyn Fn(&Progress)) -> Vec<Entry> {
    let ranked = samples.ranked();
    let levels = Beam::new(space, Data::new(space, &ranked), &[]).run(progress);
    let mut least = f64::INFINITY;
    let mut all = Vec::new();
    for level in levels {
        least = level.first().map_or(least, |e| least.min(e.score.max));
        all.extend(level.into_iter().take(PAIRED).take_while(|e| e.score.max <= WORSE * least));
    }
    all
}

/// One kind of v, with everything that it is paired by.
struct Way<'a> {
    pair: &'a Pair,
    samples: &'a PairSamples,
    second: &'a Second,
    /// Samples of u by itself.
    first: &'a SearchSamples,
}

/// u solved on all samples.
struct First<'a> {
    form: &'a Form,
    score: Score,
    bound: f64,
    /// Its values at the samples.
    values: Vec<f64>,
}

impl Way<'_> {
    fn spaces(&self) -> [&Space; 2] {
        [&self.pair.first, &self.second.space]
    }

    /// The best pairs of these forms.
    fn solved(&self, firsts: &[Entry], seconds: &[Entry]) -> Result<Vec<Found>, FitError> {
        let pairs = self.pairs(firsts, seconds);
        let data = Data::new(&self.pair.first, self.first);
        let paired = |i: usize| pairs.iter().any(|p| p[0] == i);
        let firsts: Vec<Option<First>> = firsts
            .par_iter()
            .enumerate()
            .map(|(i, entry)| paired(i).then(|| solve_first(&data, entry)).flatten())
            .collect();
        let solved: Vec<Option<Found>> = pairs
            .par_iter()
            .map(|[i, j]| firsts[*i].as_ref().map_or(Ok(None), |first| self.solve(first, &seconds[*j])))
            .collect::<Result<_, _>>()?;
        Ok(solved.into_iter().flatten().collect())
    }

    /// The best pairs of every cost, by their indices.
    fn pairs(&self, firsts: &[Entry], seconds: &[Entry]) -> Vec<[usize; 2]> {
        let cost = |(i, j): (usize, usize)| -> Option<(u32, f64, [usize; 2])> {
            let ([u, v], first, second) = (self.spaces(), &firsts[i], &seconds[j]);
            if first.ops + second.ops > self.pair.max_ops + COMMON {
                return None;
            }
            let parts =
                [Part::new(u, &first.form, &first.score)?, Part::new(v, &second.form, &second.score)?];
            let (ops, _) = self.write(&parts)?;
            let error = self.second.pairing.error(first.score.max, second.score.max);
            (ops <= self.pair.max_ops).then_some((ops, error, [i, j]))
        };
        let all: Vec<(usize, usize)> =
            (0..firsts.len()).flat_map(|i| (0..seconds.len()).map(move |j| (i, j))).collect();
        let mut priced: Vec<(u32, f64, [usize; 2])> = all.into_par_iter().filter_map(cost).collect();
        priced.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let (mut least, mut ops, mut count) = (f64::INFINITY, u32::MAX, 0);
        let mut kept = Vec::new();
        for (cost, error, indices) in priced {
            count = if cost == ops { count + 1 } else { 0 };
            ops = cost;
            if count < self.pair.first.finalists(FINALISTS) && error <= WORSE * least {
                kept.push(indices);
            }
            least = least.min(error);
        }
        kept
    }

    fn write(&self, parts: &[Part; 2]) -> Option<(u32, Written)> {
        write_pair(self.second.pairing, self.spaces(), parts, &self.pair.argument)
    }

    /// v solved for a u, and the formula of both.
    fn solve(&self, first: &First, second: &Entry) -> Result<Option<Found>, FitError> {
        let [u, v] = self.spaces();
        let known = Known { form: &second.form, coefficients: &second.score.coefficients };
        let rows = self.rows(&first.values);
        let Some((score, _)) = Data::new(v, &rows).prove(&second.form, &known) else { return Ok(None) };
        let parts = (Part::new(u, first.form, &first.score), Part::new(v, &second.form, &score));
        let (Some(u), Some(v)) = parts else { return Ok(None) };
        let parts = [u, v];
        let Some((_, written)) = self.write(&parts) else { return Ok(None) };
        let draft = Draft::new(&self.pair.name, &self.second.title, None, &parts, written);
        let (all, at) = self.whole();
        let columns = |name: &str| match name == self.pair.argument {
            true => at.clone(),
            false => column(&self.pair.first, &all, name),
        };
        // At t = 1 the formula is u, or 1 less it.
        let alone = self.second.pairing != Pairing::Recycled && self.samples.at.contains(&1.0);
        let bound = if alone { first.bound } else { 0.0 };
        finished(&draft, &columns, &all, self.pair.domain.as_ref(), bound, draft.constants > 0)
    }

    /// Samples of the formula, those of the axes for every value of the further argument, and the
    /// column of that argument.
    fn whole(&self) -> (SearchSamples, Vec<f64>) {
        let times = self.samples.at.len();
        let axes: Vec<Vec<f64>> = self.samples.axes.iter().map(|column| column.repeat(times)).collect();
        let at: Vec<f64> = self.samples.at.iter().flat_map(|t| vec![*t; self.samples.first.len()]).collect();
        let truth = |(k, t): (usize, &f64)| {
            let k = k % self.samples.first.len();
            let [m, n] = self.second.pairing.of_second(*t, self.samples.first[k]);
            m * self.second.truth[k] + n
        };
        let target = at.iter().enumerate().map(truth).collect();
        (SearchSamples { axes, scale: vec![1.0; at.len()], target }, at)
    }

    /// Samples of v for the values of u, wherever the formula depends on v.
    fn rows(&self, u: &[f64]) -> SearchSamples {
        let (all, at) = self.whole();
        let mut rows =
            SearchSamples { axes: vec![Vec::new(); all.axes.len()], scale: Vec::new(), target: Vec::new() };
        for (i, t) in at.iter().enumerate().filter(|(_, t)| **t != 1.0) {
            let [m, n] = self.second.pairing.of_second(*t, u[i % u.len()]);
            rows.axes.iter_mut().zip(&all.axes).for_each(|(row, column)| row.push(column[i]));
            rows.scale.push(m);
            rows.target.push(all.target[i] - n);
        }
        rows
    }
}

/// None if no coefficients make it finite at every sample.
fn solve_first<'a>(data: &Data, entry: &'a Entry) -> Option<First<'a>> {
    let known = Known { form: &entry.form, coefficients: &entry.score.coefficients };
    let (score, bound) = data.prove(&entry.form, &known)?;
    let values = data.values(&entry.form, &score)?;
    Some(First { form: &entry.form, score, bound, values })
}
