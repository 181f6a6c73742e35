//! The largest error of a formula where truths are dear, or points have to fill three axes: few are
//! measured, and the largest error lies between them. Boxes about the worst point of each cell close in
//! on it.

use super::Memo;
use super::certificate::{certificate, worse};
use super::target::{Sampled, Target, TargetError};
use crate::data::{Certificate, HalfRefusal, Place, shortest};
use lobefit_fit::FitError;
use lobefit_shade::{Hypothesis, Precision, ShadeError};

/// Cells along each axis, from each of which one search starts.
const CELLS: usize = 16;

/// Part of the largest error from which on the worst point of a cell starts a search.
const FOLLOWED: f64 = 0.9;

/// After each width one of so many searches goes on, those of the largest errors, and no fewer than this:
/// the peaks of a fit that is best are nearly of one height.
const KEPT: usize = 3;
const FEWEST: usize = 6;

/// Widths of the boxes, as parts of the axes, and the points in each.
const WIDTHS: [f64; 5] = [0.06, 0.03, 0.015, 0.007, 0.003];
const NEAR: usize = 64;

/// Where formulas for a target are measured.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    /// What they are to be.
    pub target: &'a Target,
    /// Points to certify at.
    pub measured: &'a Sampled,
    /// The truths about the worst of them: formulas that err alike ask for the same.
    pub memo: &'a Memo<'a>,
}

/// The certificate at the points measured, its largest errors searched from the worst of these
/// where they are sparse. RMS and mean are those of the points alone.
///
/// # Errors
/// An input that the target does not have; a value that is not finite in this arithmetic; a truth that
/// cannot be integrated.
pub fn closer(
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    places: &Places,
    precision: Precision,
) -> Result<Certificate, TargetError> {
    let Places { target, measured, memo } = *places;
    let at = |sampled: &Sampled| -> Result<Certificate, ShadeError> {
        certificate(hypothesis, coefficients, target, sampled, precision)
    };
    let mut first = at(measured)?;
    if !target.is_sparse() {
        return Ok(first);
    }
    let cells = measured.cells(&target.axes, CELLS);
    let mut peaks: Vec<Certificate> = cells.iter().map(at).collect::<Result<_, _>>()?;
    peaks.retain(|peak| peak.max_abs >= FOLLOWED * first.max_abs);
    for width in WIDTHS {
        for peak in &mut peaks {
            let near = at(&target.near(&peak.at, (width, NEAR), memo)?)?;
            first.points += near.points;
            first.max_rel = first.max_rel.max(near.max_rel);
            *peak = worse(peak.clone(), near);
        }
        peaks.sort_by(|a, b| b.max_abs.total_cmp(&a.max_abs));
        peaks.truncate((peaks.len() / KEPT).max(FEWEST));
    }
    if let Some(peak) = peaks.into_iter().next() {
        let Certificate { max_abs, at, .. } = worse(first.clone(), peak);
        first = Certificate { max_abs, at, ..first };
    }
    Ok(first)
}

/// The error of a formula in half precision, by the worse of the two ways of rounding products, or
/// why it has none.
///
/// # Errors
/// An input that the target does not have; a truth that cannot be integrated.
pub fn half(
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    places: &Places,
) -> Result<Result<Certificate, HalfRefusal>, TargetError> {
    let of = |precision| match closer(hypothesis, coefficients, places, precision) {
        Ok(certificate) => Ok(Ok(certificate)),
        Err(TargetError::Fit(FitError::Shade(error))) => Ok(Err(refused(error)?)),
        Err(error) => Err(error),
    };
    Ok(match [of(Precision::F16)?, of(Precision::F16Fused)?] {
        [Ok(apart), Ok(fused)] => Ok(worse(apart, fused)),
        [Err(refusal), _] | [_, Err(refusal)] => Err(refusal),
    })
}

/// What an arithmetic without a finite value is refused for; other errors are handed on.
fn refused(error: ShadeError) -> Result<HalfRefusal, ShadeError> {
    let refused = error.to_string();
    match error {
        ShadeError::Unmeasurable { at, .. } => {
            let at = at.into_iter().map(|(name, x)| (name, shortest(x))).collect();
            Ok(HalfRefusal { refused, at })
        }
        ShadeError::Unrepresentable { .. } => Ok(HalfRefusal { refused, at: Place::new() }),
        other => Err(other),
    }
}
