//! Formulas of f0: two functions of the other inputs, searched together. With E the albedo of a white lobe, B that of a lobe without
//! reflectance at normal incidence, and the share B/E, which is smoother than B:
//!
//! | target | formula |
//! |---|---|
//! | `f0-blend` | E (share + f0 (1 - share)), or B + f0 (E - B) |
//! | `coupling`, single | 1 less the first of these |
//! | `coupling`, normalised | (1 - f0) (1 - share): one function |
//! | `coupling`, compensated | g (a + loss (1 - g a)), g = 1 - f0, a = 1 - share, loss = 1 - E |
//!
//! Errors of E and B are averaged by f0, so that those of a blend are as large as the larger of theirs.

use std::collections::BTreeMap;

use super::space;
use super::{Demand, SearchJob};
use crate::data::Use;
use crate::effects::Quantity;
use crate::effects::target::{Span, Target, TargetError, TargetSpec};
use crate::fit::FitError;
use crate::fit::search::{
    Anchor, Found, Pair, PairSamples, Pairing, Progress, SearchSamples, Second, Space, search, search_pair,
};
use crate::fitting::FittingError;

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
    f0: &Span,
    job: &SearchJob,
    progress: &dyn Fn(&Progress),
) -> Result<(Vec<Found>, String), FittingError> {
    refuse(target, f0, &job.demands)?;
    let split = Split::of(target, job)?;
    let at_mirror = split.anchor.as_ref().map(|anchor| space::words(target, Some(anchor)));
    match target.words.get("specular").map(String::as_str) {
        None => {
            let found = blends(target, f0, job, &split, progress)?;
            Ok((found, at_mirror.map_or(String::new(), |words| format!("{words} for f0 = 1"))))
        }
        Some("single") => Ok((blends(target, f0, job, &split, progress)?, String::new())),
        Some("normalised") => Ok((faded(target, job, &split, progress)?, "0 at f0 = 1".into())),
        Some(_) => Ok((recycled(target, f0, job, &split, progress)?, "0 at f0 = 1".into())),
    }
}

/// What cannot be asked of formulas of f0.
fn refuse(target: &Target, f0: &Span, demands: &[Demand]) -> Result<(), TargetError> {
    if let Some(demand) = demands.first() {
        let reason = "forms of f0 are searched as two functions, and keep to no constraint but those that the truth itself has; search \
                      without it, then fit a formula of the frontier with it"
            .into();
        return Err(TargetError::Edge { setting: "exact", input: demand.words(), reason });
    }
    if !f0.is_spanned() {
        let reason = format!(
            "a search goes over formulas for a range of f0; for f0 = {} alone, fit a formula of your own without f0",
            f0.range[0]
        );
        return Err(TargetError::Use { used_as: target.used_as.name(), reason });
    }
    Ok(())
}

impl Split {
    fn of(target: &Target, job: &SearchJob) -> Result<Split, FittingError> {
        let Some(quantity) = Quantity::find("ggx-reflection") else {
            let reason = "there is no quantity ggx-reflection to be made of".into();
            return Err(TargetError::Use { used_as: target.used_as.name(), reason }.into());
        };
        let mut domain = job.spec.domain.clone();
        domain.remove("f0");
        let spec = |used_as: Use| TargetSpec {
            quantity,
            column: None,
            used_as: Some(used_as),
            smith: target.smith,
            alpha_map: target.alpha_map,
            domain: domain.clone(),
            words: BTreeMap::new(),
        };
        // For f0 = 0, which is B, then for f0 = 1, which is E.
        let both = space::target(&spec(Use::F0Blend))?;
        let SearchSamples { mut axes, target: mut bias, .. } = space::samples(&both)?;
        let albedo = bias.split_off(bias.len() / 2);
        axes.iter_mut().for_each(|column| column.truncate(albedo.len()));
        let anchor = space::anchor(&space::target(&spec(Use::Value))?, &[])?;
        Ok(Split { axes, albedo, bias, anchor })
    }

    fn share(&self) -> Vec<f64> {
        self.bias.iter().zip(&self.albedo).map(|(b, e)| b / e).collect()
    }

    fn samples(&self, first: Vec<f64>, at: Vec<f64>) -> PairSamples {
        PairSamples { axes: self.axes.clone(), first, at }
    }
}

/// Operations that one of two functions may have, of those of the formula: most of the others are left to the second, whose division
/// may be the same.
fn part(max_ops: u32, tenths: u32) -> u32 {
    (max_ops * tenths / 10).max(max_ops.min(8))
}

/// Forms of a part, named as in the formula.
fn part_space(target: &Target, name: &str, job: &SearchJob, tenths: u32) -> Space {
    let mut space = Space::new(name, space::axes(target), part(job.max_ops, tenths));
    space.width = job.width.unwrap_or(space.width);
    space
}

fn with_reciprocal(mut space: Space, target: &Target) -> Space {
    space.helpers.extend(space::reciprocal(target, &space.axes));
    space
}

fn with_complement(mut space: Space) -> Space {
    space.helpers.extend(space::complement(&space.axes));
    space
}

fn pair(target: &Target, job: &SearchJob, first: Space, seconds: Vec<Second>) -> Result<Pair, FitError> {
    Ok(Pair {
        name: format!("{}_", space::name(target)),
        argument: "f0".into(),
        first,
        seconds,
        max_ops: job.max_ops,
        domain: Some(target.domain()?),
    })
}

/// f0 A + B, or 1 less it.
fn blends(
    target: &Target,
    f0: &Span,
    job: &SearchJob,
    split: &Split,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    let albedo = with_reciprocal(part_space(target, "albedo", job, 6), target);
    let albedo = Space { anchor: split.anchor.clone(), ..albedo };
    let second = |pairing, name: &str, truth: Vec<f64>, words: &str| Second {
        pairing,
        title: title(target, words),
        space: with_complement(part_space(target, name, job, 5)),
        truth,
    };
    let of_share = "E = A + B and the share B/E are two forms, and f0 blends between E and B.";
    let seconds = match target.used_as {
        Use::F0Blend => vec![
            second(
                Pairing::Mix,
                "bias",
                split.bias.clone(),
                "E = A + B and B are two forms, and f0 blends between them.",
            ),
            second(Pairing::Blend, "share", split.share(), of_share),
        ],
        _ => vec![second(Pairing::Rest, "share", split.share(), of_share)],
    };
    let samples = split.samples(split.albedo.clone(), f0.range.to_vec());
    search_pair(&pair(target, job, albedo, seconds)?, &samples, progress)
}

/// (1 - f0) (1 - share).
fn faded(
    target: &Target,
    job: &SearchJob,
    split: &Split,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    let name = format!("{}_", space::name(target));
    let space = with_reciprocal(with_complement(part_space(target, &name, job, 10)), target);
    let space = Space {
        title: title(target, "1 - f0 times a form of the share that f0 scales, A / (A + B)."),
        anchor: Some(Anchor { value: 1.0, zeros: Vec::new() }),
        faded: Some("f0".into()),
        domain: Some(target.domain()?),
        ..space
    };
    let rest: Vec<f64> = split.share().iter().map(|share| 1.0 - share).collect();
    let samples = SearchSamples { axes: split.axes.clone(), scale: vec![1.0; rest.len()], target: rest };
    search(&space, &samples, progress)
}

/// g (a + loss (1 - g a)).
fn recycled(
    target: &Target,
    f0: &Span,
    job: &SearchJob,
    split: &Split,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    let loss = with_reciprocal(part_space(target, "loss", job, 6), target);
    let loss = Space { anchor: split.anchor.clone().map(|anchor| Anchor { value: 0.0, ..anchor }), ..loss };
    let share = with_complement(part_space(target, "diffuse", job, 5));
    let second = Second {
        pairing: Pairing::Recycled,
        title: title(
            target,
            "g (a + loss (1 - g a)) with g = 1 - f0: the share a = A / (A + B) that f0 scales and the loss 1 - (A + B) are two forms.",
        ),
        space: Space { anchor: Some(Anchor { value: 1.0, zeros: Vec::new() }), ..share },
        truth: split.share().iter().map(|share| 1.0 - share).collect(),
    };
    let [low, high] = f0.range;
    let at = (0..CURVED).map(|i| low + (high - low) * i as f64 / CURVED as f64).collect();
    let losses = split.albedo.iter().map(|e| 1.0 - e).collect();
    search_pair(&pair(target, job, loss, vec![second])?, &split.samples(losses, at), progress)
}

/// What the formula is, then how.
fn title(target: &Target, how: &str) -> String {
    format!("{}\n{how}", space::title(target))
}
