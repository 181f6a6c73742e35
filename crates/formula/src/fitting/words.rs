//! What a search did, in words.

use super::ConstraintCheck;
use super::one::Weighted;
use super::weight::PERCEPTUAL;
use lobefit::approximate::target::Target;
use lobefit_fit::{Fitted, Gap, Goal, Method, SecondOrder, Stage, Termination};

/// `max`, `rms`, `p=8`: as on the command line.
pub(super) fn goal(goal: Goal) -> String {
    match goal {
        Goal::Max => "max".into(),
        Goal::Rms => "rms".into(),
        Goal::Power(p) => format!("p={p}"),
    }
}

/// Two digits of a small number.
pub(super) fn figure(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.1e}") }
}

/// `, weighted by mu`, or nothing; of `perceptual` what its norm has to be for the word to hold.
pub(super) fn weighted(weight: Option<&str>, goal: Goal) -> String {
    match weight {
        None => String::new(),
        Some(weight) if weight.trim() == PERCEPTUAL && goal != Goal::Rms => format!(
            ", weighted by {weight} (the difference seen, which is a mean square, is least with --norm rms)"
        ),
        Some(weight) => format!(", weighted by {weight}"),
    }
}

/// A fit's weighted error.
pub(super) fn weighted_error(weight: &str, error: &Weighted) -> String {
    let digits = lobefit::emit::header::short;
    let of = if weight.trim() == PERCEPTUAL {
        "weight times error: to first order the difference in lightness, 1 being that of a furnace's white that errs by 1"
    } else {
        "weight times error"
    };
    let Weighted { max, rms, points } = *error;
    format!("rms {}, max {} of {of}; at {points} points, evenly spread", digits(rms), digits(max))
}

/// What a goal minimises.
pub(super) fn minimised(goal: Goal) -> String {
    match goal {
        Goal::Max => "the largest error".into(),
        Goal::Rms => "the root of the mean square error".into(),
        Goal::Power(p) => format!("the p-norm of the error, p = {p}"),
    }
}

/// `, smith correlated`, or nothing where the quantity has no such form.
pub(crate) fn smith(target: &Target) -> String {
    target.variant.smith.map_or_else(String::new, |smith| format!(", smith {}", smith.name()))
}

/// How the search for a fit ended.
pub(super) fn end(fitted: &Fitted) -> String {
    let end = within(fitted.termination, fitted.is_first_order());
    match fitted.second_order {
        SecondOrder::NotChecked => {
            format!(
                "{end}; not checked to second order: beside these coefficients the formula is not finite, or a divisor changes its sign"
            )
        }
        SecondOrder::Checked | SecondOrder::Unused => end,
    }
}

/// How a search ended that looked at the first order alone, as it does within constraints, or not.
fn within(end: Termination, first_order: bool) -> String {
    match end {
        Termination::Minimax | Termination::Converged { .. } if first_order => {
            "no step within the constraints gains anything to first order, and searches from beside it, where they leave room, end no lower"
                .into()
        }
        end => end.to_string(),
    }
}

/// How far from the best possible the coefficients may be, with errors `weighted` or not.
pub(super) fn optimality(fitted: &Fitted, weighted: bool) -> String {
    if matches!(fitted.termination, Termination::NoParameters | Termination::TooFewSamples) {
        return "none: nothing was searched for".into();
    }
    let part = |gap: f64| format!("{} of the error", figure(gap));
    match (fitted.gap, fitted.bound) {
        (Gap::Global(gap), Some(bound)) => {
            let kept = if fitted.constraints.is_empty() { "" } else { "the constraints and " };
            let error = if weighted { "weighted largest error" } else { "largest error" };
            format!(
                "global: no coefficients of this formula that keep {kept}every divisor's sign bring the {error} on the samples \
                 below {bound:.6}, which is {} away",
                part(gap)
            )
        }
        (Gap::Global(gap), None) => format!("global: within {} of the best of all coefficients", part(gap)),
        (Gap::Local(gap), _) if gap.is_finite() => {
            format!(
                "local: near these coefficients at most {} is left to gain; other minima are not excluded",
                part(gap)
            )
        }
        (Gap::Local(_), _) => "local, and no bound on what is left to gain".into(),
        (Gap::Unknown, _) => "local: the best found from the starting points; others are not excluded".into(),
    }
}

/// How a constraint holds.
pub(super) fn constraint(kept: &ConstraintCheck) -> String {
    let held = &kept.held;
    let missed = || format!("by at most {} (rounding allows {})", figure(held.worst), figure(held.tolerance));
    match (kept.proven, kept.is_kept()) {
        (true, _) => format!("{}: proven over the whole domain", held.name),
        (false, true) => format!("{}: held at {} points, missed {}", held.name, held.points, missed()),
        (false, false) => format!("{}: BROKEN {} at {}", held.name, missed(), kept.at),
    }
}

/// One stage of the search, within constraints or not.
pub(super) fn stage(stage: &Stage, constrained: bool) -> [String; 4] {
    let digits = lobefit::emit::header::short;
    [
        stage.method.name().into(),
        within(stage.end, constrained && matches!(stage.method, Method::Programs | Method::Ties)),
        digits(stage.max),
        digits(stage.rms),
    ]
}
