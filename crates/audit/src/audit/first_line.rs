//! A clamp of an input that shows in the first line of its axis alone.

use super::AuditError;
use super::column::Column;
use super::errors::{Residuals, rms};
use super::judge::judge;
use super::sample::{Candidate, Sample};
use super::truth::Truth;
use lobefit_math::ops;

/// Powers of 2 by which a clamp is looked for between the first line and the next: to 1e-5 of 16 texels.
const POWERS: i32 = 13;

/// Share of a clamp to which it is looked for.
const NARROW: f64 = 1e-6;

/// Share of the width that is left beside the vertex of a parabola.
const STEEP: f64 = 0.03;

/// How much larger the sum of squares may be of a line but for its corners, under a clamp that they tell.
const CORNER: f64 = 2.0;

/// Errors of a line that is clamped beside the median of all.
pub(super) const STANDS_OUT: f64 = 3.0;

/// Root mean square of rounding or noise beside its median, at most.
pub(super) const USUAL: f64 = 1.5;

/// A line of a table under clamps of an axis, of which it is the first.
pub(super) struct FirstLine<'a> {
    pub truth: &'a Truth<'a>,
    pub at: &'a Candidate,
    pub axis: usize,
    /// The line, or a part of it.
    pub line: Sample,
}

impl FirstLine<'_> {
    /// The errors of every channel that is judged, under a clamp.
    pub(super) fn errors(&self, floor: f64) -> Result<Vec<Vec<f64>>, AuditError> {
        let FirstLine { truth, at, axis, line } = self;
        let mut axes = at.axes.clone();
        axes[*axis].floor = floor;
        let judgement = judge(truth, line, &axes, at.lobe, Truth::ranked)?;
        let of = |(column, own): (&Option<Column>, &Vec<f64>)| {
            Some(Residuals::new(line, &judgement, (*column)?, own).errors)
        };
        Ok(at.fitted.columns.iter().zip(&line.values).filter_map(of).collect())
    }

    /// The sum of their squares.
    fn square(&self, floor: f64) -> Result<f64, AuditError> {
        Ok(self.errors(floor)?.iter().flatten().map(|e| e * e).sum())
    }

    /// The clamp that leaves least, and what it leaves, about one with what that leaves, within a width: by
    /// parabolas, which squares of errors are near the least of them.
    fn narrowed(&self, [mut floor, mut least, mut width]: [f64; 3]) -> Result<[f64; 2], AuditError> {
        while width > NARROW * floor {
            width *= 0.5;
            let sides = [floor - width, floor + width];
            let [below, above] = [self.square(sides[0])?, self.square(sides[1])?];
            let bend = below - 2.0 * least + above;
            let vertex = floor + 0.5 * width * (below - above) / bend;
            for (tried, square) in sides.into_iter().zip([below, above]) {
                if square < least {
                    (floor, least) = (tried, square);
                }
            }
            if bend > 0.0 && sides[0] < vertex && vertex < sides[1] {
                let square = self.square(vertex)?;
                if square < least {
                    (floor, least) = (vertex, square);
                    width *= STEEP;
                }
            }
        }
        Ok([floor, least])
    }
}

/// Whether the errors of a channel are so many times what is usual of it.
pub(super) fn stand_out(errors: &[Vec<f64>], usual: &[f64], times: f64) -> bool {
    errors.iter().zip(usual).any(|(own, usual)| rms(own.iter().copied()) > times * usual)
}

/// The largest of some errors.
pub(super) fn largest_of(errors: &[Vec<f64>]) -> f64 {
    errors.iter().flatten().fold(0.0, |most, e| most.max(e.abs()))
}

/// The clamp between two inputs that explains most of a line, of which the part that no other axis clamps and
/// the whole are given.
pub(super) fn found([most, whole]: [&FirstLine; 2], [own, next]: [f64; 2]) -> Result<f64, AuditError> {
    let mut found = [own, f64::INFINITY, 0.0];
    for share in (1..=POWERS).rev().map(|k| ops::exp2(-f64::from(k))).chain([0.75]) {
        let floor = own + share * (next - own);
        let square = most.square(floor)?;
        if square < found[1] {
            found = [floor, square, 0.5 * share * (next - own)];
        }
    }
    let [floor, square] = most.narrowed(found)?;
    // With nothing but this clamp the corner tells most of it.
    let [corner, _] = whole.narrowed([floor, whole.square(floor)?, 0.1 * (floor - own)])?;
    Ok(if most.square(corner)? < CORNER * square { corner } else { floor })
}
