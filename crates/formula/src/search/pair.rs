//! Formulas of f0: two functions of the other inputs, searched together. With E the albedo of a
//! white lobe, B that of a lobe without reflectance at normal incidence, and the share B/E, which
//! is smoother than B:
//!
//! | value | formula |
//! |---|---|
//! | [`F0Form::Albedo`] | E (share + f0 (1 - share)), or B + f0 (E - B) |
//! | [`F0Form::Rest`] | 1 less the first of these |
//! | [`F0Form::Share`] | (1 - f0) (1 - share): one function |
//! | [`F0Form::Recycled`] | g (a + loss (1 - g a)), g = 1 - f0, a = 1 - share, loss = 1 - E |
//!
//! Errors of E and B are averaged by f0, so that those of a blend are as large as the larger of
//! theirs.

use super::aids::{self, AidKind};
use super::space;
use super::{Frontier, SearchJob, Tried};
use crate::fitting::FittingError;
use lobefit::approximate::target::{Span, Target, TargetError, TargetSpec};
use lobefit::data::Use;
use lobefit_fit::FitError;
use lobefit_fit::search::{
    Anchor, Found, Pair, PairSamples, Pairing, Progress, SearchSamples, Second, Space, search, search_pair,
};
use lobefit_truth::quantity::{F0Form, OverF0};

/// Values of f0 where an error that is not affine in it is searched.
const CURVED: usize = 5;

/// E and B/E at the samples of a target, one column per axis.
struct Split {
    axes: Vec<Vec<f64>>,
    albedo: Vec<f64>,
    bias: Vec<f64>,
    /// Where E is 1: at alpha = 0, if that is a place of the domain's kind.
    anchor: Option<Anchor>,
}

/// The frontier of formulas of f0, and where they are exact.
pub(super) fn run(
    target: &Target,
    (f0, over): (&Span, OverF0),
    job: &SearchJob,
    progress: &dyn Fn(&Progress),
) -> Result<Frontier, FittingError> {
    refuse(target, (f0, over.form), job)?;
    let split = Split::of(target, over, job)?;
    let at_mirror = split.anchor.as_ref().map(|anchor| space::words(target, Some(anchor)));
    let mut asked = Asked { target, job, split: &split, progress, tried: Vec::new() };
    let (found, anchor) = match over.form {
        F0Form::Albedo => {
            let bias = ("bias", split.bias.clone(), vec![1.0; split.bias.len()], OF_BIAS);
            let ways = vec![(Pairing::Mix, bias), (Pairing::Blend, split.share_of_albedo())];
            let found = asked.blends(f0, ways)?;
            (found, at_mirror.map_or(String::new(), |words| format!("{words} for f0 = 1")))
        }
        F0Form::Rest => (asked.blends(f0, vec![(Pairing::Rest, split.share_of_albedo())])?, String::new()),
        F0Form::Share => (asked.faded()?, "0 at f0 = 1".into()),
        F0Form::Recycled => (asked.recycled(f0)?, "0 at f0 = 1".into()),
    };
    Ok(Frontier { found, anchor, tried: asked.tried })
}

/// What cannot be asked of formulas of f0.
fn refuse(target: &Target, (f0, form): (&Span, F0Form), job: &SearchJob) -> Result<(), TargetError> {
    if let Some(demand) = job.demands.first() {
        let reason = "forms of f0 are searched as two functions, and keep to no constraint but those that the truth itself has; search \
                      without it, then fit a formula of the frontier with it"
            .into();
        return Err(TargetError::Edge { setting: "exact", input: demand.words(), reason });
    }
    if let Some(kind) = job.aids.of_whole().filter(|_| form != F0Form::Share) {
        let reason = format!("{} is for formulas of one form, and these are made of two", kind.name());
        return Err(TargetError::Edge { setting: "helpers", input: kind.name().into(), reason });
    }
    if !f0.is_spanned() {
        let reason = format!(
            "a search goes over formulas for a range of f0; for f0 = {} alone, fit a formula of your own without f0",
            f0.range[0]
        );
        return Err(TargetError::Use { used_as: target.used_as.name, reason });
    }
    Ok(())
}

impl Split {
    fn of(target: &Target, over: OverF0, job: &SearchJob) -> Result<Split, FittingError> {
        let mut domain = job.spec.domain.clone();
        domain.remove("f0");
        let spec = |used_as: Use| TargetSpec {
            quantity: over.lobe,
            column: None,
            used_as: Some(used_as),
            variant: target.variant.clone(),
            alpha_map: target.alpha_map,
            domain: domain.clone(),
        };
        // For f0 = 0, which is B, then for f0 = 1, which is E.
        let both = space::target(&spec(Use::F0_BLEND))?;
        let SearchSamples { mut axes, target: mut bias, .. } = space::samples(&both)?;
        let albedo = bias.split_off(bias.len() / 2);
        axes.iter_mut().for_each(|column| column.truncate(albedo.len()));
        let anchor = space::anchor(&space::target(&spec(Use::VALUE))?, &[])?;
        Ok(Split { axes, albedo, bias, anchor })
    }

    fn share(&self) -> Vec<f64> {
        self.bias.iter().zip(&self.albedo).map(|(b, e)| b / e).collect()
    }

    fn share_of_albedo(&self) -> Way {
        ("share", self.share(), self.albedo.clone(), OF_SHARE)
    }

    fn samples(&self, first: Vec<f64>, at: Vec<f64>) -> PairSamples {
        PairSamples { axes: self.axes.clone(), first, at }
    }
}

/// The second function of a blend: its name, its values, the factors of its errors, and what the
/// blend is.
type Way = (&'static str, Vec<f64>, Vec<f64>, &'static str);

const OF_SHARE: &str = "E = A + B and the share B/E are two forms, and f0 blends between E and B.";
const OF_BIAS: &str = "E = A + B and B are two forms, and f0 blends between them.";

/// Operations that one of two functions may have, of those of the formula: most of the others are
/// left to the second, whose division may be the same.
fn share(max_ops: u32, tenths: u32) -> u32 {
    (max_ops * tenths / 10).max(max_ops.min(8))
}

/// A search, and what was tried for it so far.
struct Asked<'a> {
    target: &'a Target,
    job: &'a SearchJob,
    split: &'a Split,
    progress: &'a dyn Fn(&Progress),
    tried: Vec<Tried>,
}

/// A function of a formula: its name there, its share of the operations in tenths, what its forms
/// may have, where they are exact, and its values with the factors that its errors have.
struct Part {
    name: &'static str,
    tenths: u32,
    usual: &'static [AidKind],
    anchor: Option<Anchor>,
    truth: Vec<f64>,
    scale: Vec<f64>,
}

impl Asked<'_> {
    /// Forms of a part, with what is asked for or pays.
    fn space(&mut self, part: Part) -> Result<Space, FittingError> {
        let Asked { target, job, split, .. } = *self;
        let space = Space::new(part.name, space::axes(target), share(job.max_ops, part.tenths));
        let (width, prices) = (job.width.unwrap_or(space.width), job.prices()?);
        let space = Space { width, prices, anchor: part.anchor, ..space };
        let target_of = part.truth.iter().zip(&part.scale).map(|(x, scale)| x * scale).collect();
        let samples = SearchSamples { axes: split.axes.clone(), scale: part.scale, target: target_of };
        let (space, trials) = aids::aided(space, part.usual, false, (target, job), &samples, self.progress)?;
        self.tried.extend(aids::named(&space.axes, Some(part.name), trials));
        Ok(space)
    }

    fn pair(&self, first: Space, seconds: Vec<Second>) -> Result<Pair, FitError> {
        Ok(Pair {
            name: format!("{}_", space::name(self.target)),
            argument: "f0".into(),
            first,
            seconds,
            max_ops: self.job.max_ops,
            domain: Some(self.target.domain()?),
        })
    }

    /// f0 A + B, or 1 less it, by E and each of these.
    fn blends(&mut self, f0: &Span, ways: Vec<(Pairing, Way)>) -> Result<Vec<Found>, FittingError> {
        let split = self.split;
        let albedo = self.space(Part {
            name: "albedo",
            tenths: 6,
            usual: &[AidKind::Reciprocal],
            anchor: split.anchor.clone(),
            truth: split.albedo.clone(),
            scale: vec![1.0; split.albedo.len()],
        })?;
        let mut seconds = Vec::new();
        for (pairing, (name, truth, scale, words)) in ways {
            let usual = &[AidKind::Complement];
            let part = Part { name, tenths: 5, usual, anchor: None, truth: truth.clone(), scale };
            let space = self.space(part)?;
            seconds.push(Second { pairing, title: title(self.target, words), space, truth });
        }
        let samples = split.samples(split.albedo.clone(), f0.range.to_vec());
        Ok(search_pair(&self.pair(albedo, seconds)?, &samples, self.progress)?)
    }

    /// (1 - f0) (1 - share).
    fn faded(&mut self) -> Result<Vec<Found>, FittingError> {
        let Asked { target, job, split, progress, .. } = *self;
        let name = format!("{}_", space::name(target));
        let space = Space::new(&name, space::axes(target), share(job.max_ops, 10));
        let space = Space {
            width: job.width.unwrap_or(space.width),
            title: title(target, "1 - f0 times a form of the share that f0 scales, A / (A + B)."),
            anchor: Some(Anchor { value: 1.0, zeros: Vec::new() }),
            faded: Some("f0".into()),
            domain: Some(target.domain()?),
            ..space
        };
        let rest: Vec<f64> = split.share().iter().map(|share| 1.0 - share).collect();
        let samples = SearchSamples { axes: split.axes.clone(), scale: vec![1.0; rest.len()], target: rest };
        let usual = &[AidKind::Complement, AidKind::Reciprocal];
        let (space, trials) = aids::aided(space, usual, true, (target, job), &samples, progress)?;
        self.tried.extend(aids::named(&space.axes, None, trials));
        Ok(search(&space, &samples, progress)?)
    }

    /// g (a + loss (1 - g a)).
    fn recycled(&mut self, f0: &Span) -> Result<Vec<Found>, FittingError> {
        let split = self.split;
        let losses: Vec<f64> = split.albedo.iter().map(|e| 1.0 - e).collect();
        let rest: Vec<f64> = split.share().iter().map(|share| 1.0 - share).collect();
        let loss = self.space(Part {
            name: "loss",
            tenths: 6,
            usual: &[AidKind::Reciprocal],
            anchor: split.anchor.clone().map(|anchor| Anchor { value: 0.0, ..anchor }),
            truth: losses.clone(),
            scale: vec![1.0; rest.len()],
        })?;
        let space = self.space(Part {
            name: "diffuse",
            tenths: 5,
            usual: &[AidKind::Complement],
            anchor: Some(Anchor { value: 1.0, zeros: Vec::new() }),
            truth: rest.clone(),
            scale: split.albedo.clone(),
        })?;
        let words = "g (a + loss (1 - g a)) with g = 1 - f0: the share a = A / (A + B) that f0 scales and the loss 1 - (A + B) are two \
                     forms.";
        let title = title(self.target, words);
        let second = Second { pairing: Pairing::Recycled, title, space, truth: rest };
        let samples = split.samples(losses, curved(f0.range));
        Ok(search_pair(&self.pair(loss, vec![second])?, &samples, self.progress)?)
    }
}

/// Values of f0 that are evenly spread over a range, both its ends among them; but at f0 = 1 every
/// form is exactly 0, which says nothing.
fn curved([low, high]: [f64; 2]) -> Vec<f64> {
    let parts = if high == 1.0 { CURVED } else { CURVED - 1 };
    (0..CURVED).map(|i| low + (high - low) * i as f64 / parts as f64).collect()
}

/// What the formula is, then how.
fn title(target: &Target, how: &str) -> String {
    format!("{}\n{how}", space::title(target))
}
