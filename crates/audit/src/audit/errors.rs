//! The error of a channel at its texels under one reading, and what it tells of how the table was
//! made.

use std::collections::BTreeSet;

use serde::Serialize;

use super::column::Column;
use super::extent::Extent;
use super::judge::Judgement;
use super::sample::Sample;
use lobefit::data::Place;

/// Error figures with the worst texel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TexelErrors {
    /// Largest magnitude.
    pub max: f64,
    /// Root mean square.
    pub rms: f64,
    /// Signed mean.
    pub mean: f64,
    /// Median magnitude.
    pub median: f64,
    /// Texel of the largest, by axis; nothing of lookups.
    pub texel: Vec<usize>,
    /// Its inputs.
    pub at: Place,
    /// What the table holds there.
    pub value: f64,
    /// What is true there.
    pub truth: f64,
    /// Texels judged.
    pub judged: usize,
    /// Texels in all, but for lines that were never filled.
    pub all: usize,
    /// Texels that were not looked at, of a table of three axes with more than
    /// [`super::JUDGED_TEXELS`].
    #[serde(skip)]
    pub unsampled: usize,
}

impl TexelErrors {
    /// The figures of two parts of a table together, but for the median.
    pub(super) fn with(self, other: TexelErrors) -> TexelErrors {
        let [own, its] = [&self, &other].map(|e| e.judged as f64);
        let mean = |f: fn(&TexelErrors) -> f64| (own * f(&self) + its * f(&other)) / (own + its);
        let (rms, mean) = (mean(|e| e.rms * e.rms).sqrt(), mean(|e| e.mean));
        let judged = self.judged + other.judged;
        let worst = if other.max > self.max { other } else { self };
        TexelErrors { rms, mean, judged, ..worst }
    }
}

/// The golden ratio less 1: its multiples are spread evenly, however many they are.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A texel as an audit reads it, for whoever integrates its truth again.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// Index along every axis.
    pub texel: Vec<usize>,
    /// Its inputs.
    pub at: Place,
    /// What the table holds there.
    pub value: f64,
    /// What is true there.
    pub truth: f64,
}

/// A channel beside its truth at the texels that are judged.
pub(super) struct Residuals<'a> {
    pub sample: &'a Sample,
    pub judgement: &'a Judgement,
    pub column: Column,
    /// Values of the channel at every texel of the sample.
    pub values: &'a [f64],
    /// Signed errors there; 0 where a texel is not judged.
    pub errors: Vec<f64>,
    /// Places of the judged texels.
    pub judged: Vec<usize>,
}

impl<'a> Residuals<'a> {
    pub(super) fn new(
        sample: &'a Sample,
        judgement: &'a Judgement,
        column: Column,
        values: &'a [f64],
    ) -> Residuals<'a> {
        let judged: Vec<usize> = (0..values.len()).filter(|i| judgement.judged[*i]).collect();
        let mut errors = vec![0.0; values.len()];
        for i in &judged {
            errors[*i] = values[*i] - column.value(judgement.base[*i]);
        }
        Residuals { sample, judgement, column, values, errors, judged }
    }

    /// The truth of the channel at a texel.
    pub(super) fn truth(&self, i: usize) -> f64 {
        self.column.value(self.judgement.base[i])
    }

    /// Difference of the largest and the smallest truth: what errors are compared with.
    pub(super) fn spread(&self) -> f64 {
        self.spread_of(&self.judged)
    }

    fn spread_of(&self, texels: &[usize]) -> f64 {
        spread(texels.iter().map(|i| self.truth(*i)))
    }

    /// Root mean square of the errors of some texels beside the spread of their truth; an error of an
    /// albedo above 1 counts as a share of it.
    pub(super) fn misfit(&self, texels: &[usize]) -> f64 {
        let share = |i: &usize| if self.is_albedo() { self.truth(*i).max(1.0) } else { 1.0 };
        rms(texels.iter().map(|i| self.errors[*i] / share(i))) / self.bounded(texels)
    }

    /// The same of all that are judged; infinite where there are no texels to judge.
    pub(super) fn of_all(&self) -> f64 {
        if self.judged.is_empty() { f64::INFINITY } else { self.misfit(&self.judged) }
    }

    /// The spread of some texels, of an albedo at most 1: what is above it has no bound at grazing view,
    /// which excuses nothing elsewhere.
    pub(super) fn bounded(&self, texels: &[usize]) -> f64 {
        self.spread_of(texels).min(if self.is_albedo() { 1.0 } else { f64::INFINITY })
    }

    fn is_albedo(&self) -> bool {
        self.column.albedo(0.5) == Some(0.5)
    }

    /// Median magnitude of the errors.
    pub(super) fn median(&self) -> f64 {
        median(self.judged.iter().map(|i| self.errors[*i].abs()).collect())
    }

    /// Index along every axis of the table.
    pub(super) fn texel(&self, i: usize) -> Vec<usize> {
        self.sample.texel(i)
    }

    /// Whether a texel is of an extent.
    pub(super) fn lies_in(&self, i: usize, extent: &Extent) -> bool {
        extent.holds(&self.texel(i))
    }

    /// Root mean square of the errors of some texels; 0 of none.
    pub(super) fn rms(&self, texels: &[usize]) -> f64 {
        rms(texels.iter().map(|i| self.errors[*i]))
    }

    /// At most `count` of the judged texels, by steps of the golden ratio through them: all of so few.
    pub(super) fn drawn(&self, count: usize, at: impl Fn(&[usize]) -> Place) -> Vec<Drawn> {
        let n = self.judged.len();
        let step = |k: usize| ((k as f64 * GOLDEN).fract() * n as f64) as usize;
        let mut places = BTreeSet::new();
        let mut k = 0;
        while places.len() < count.min(n) {
            k += 1;
            places.insert(step(k));
        }
        let one = |i: usize| {
            let texel = self.texel(i);
            Drawn { at: at(&texel), texel, value: self.values[i], truth: self.truth(i) }
        };
        places.into_iter().map(|k| one(self.judged[k])).collect()
    }

    /// The first of the judged texels, of which there are some, with the largest error.
    pub(super) fn worst(&self) -> usize {
        self.judged.iter().fold(self.judged[0], |worst, i| {
            if self.errors[*i].abs() > self.errors[worst].abs() { *i } else { worst }
        })
    }

    /// The figures, with the inputs of a texel as `at` gives them.
    pub(super) fn figures(&self, at: impl Fn(&[usize]) -> Place) -> TexelErrors {
        let worst = self.worst();
        let n = self.judged.len() as f64;
        let texel = self.texel(worst);
        TexelErrors {
            max: self.errors[worst].abs(),
            rms: self.rms(&self.judged),
            mean: self.judged.iter().map(|i| self.errors[*i]).sum::<f64>() / n,
            median: self.median(),
            at: at(&texel),
            texel,
            value: self.values[worst],
            truth: self.truth(worst),
            judged: self.judged.len(),
            all: self.sample.texels,
            unsampled: self.sample.texels.saturating_sub(self.values.len()),
        }
    }
}

/// Root mean square; 0 of none.
pub(super) fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let (squares, n) = errors.fold((0.0, 0_usize), |(sum, n), error| (sum + error * error, n + 1));
    (squares / n.max(1) as f64).sqrt()
}

/// Median of a list; 0 of none.
pub(super) fn median(mut list: Vec<f64>) -> f64 {
    if list.is_empty() {
        return 0.0;
    }
    let middle = list.len() / 2;
    *list.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Difference of the largest value and the smallest; of none minus infinity.
pub(super) fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let ends = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    ends[1] - ends[0]
}
