//! What a search hands back: coefficients, how it ended, and what is known of them.

use std::fmt;

use super::rank;

/// How a fit has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Termination {
    /// Least squares or p-norm: the residuals, weighted by the norm, are orthogonal to the Jacobian
    /// within this cosine. [`Fitted::second_order`] says whether second derivatives were looked at.
    Converged {
        /// Largest cosine between the residuals and a column of the Jacobian.
        cosine: f64,
    },
    /// Minimax: the linear programs found nothing more to gain near these coefficients. Within
    /// constraints to first order only.
    Minimax,
    /// Minimax: no coefficients whatsoever are better by more than the gap, by proof.
    GlobalMinimax,
    /// On the edge of what the constraints allow: the programs found no step within them that gains
    /// anything to first order, and searches from beside it ended no lower. Its second derivatives
    /// are not looked at.
    Constrained,
    /// The formula reproduces the targets.
    ZeroResidual,
    /// The formula has no free parameters: there was nothing to fit.
    NoParameters,
    /// A minimum, but some coefficients are undetermined: the formula has more parameters than it
    /// needs.
    RankDeficient {
        /// Number of determined combinations of parameters.
        rank: usize,
    },
    /// Not known to be a minimum though derivatives vanish: saddle after saddle was left for lower
    /// ground beside it, and these coefficients come from the last that was allowed.
    Saddle,
    /// Iterations used up.
    IterationCap,
    /// No step made progress, short of a minimum.
    Stalled,
    /// Fewer samples than parameters: the coefficients are the starting values.
    TooFewSamples,
}

impl Termination {
    /// Whether the coefficients are a minimum of the norm asked for, within constraints to first
    /// order.
    pub fn is_converged(self) -> bool {
        !matches!(
            self,
            Termination::IterationCap
                | Termination::Stalled
                | Termination::Saddle
                | Termination::TooFewSamples
        )
    }
}

impl fmt::Display for Termination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = match self {
            Termination::Converged { cosine } => {
                return write!(
                    f,
                    "a minimum: residuals and derivatives are orthogonal within a cosine of {}",
                    if *cosine == 0.0 { "0".into() } else { format!("{cosine:.1e}") }
                );
            }
            Termination::RankDeficient { rank } if *rank > 1 => {
                return write!(f, "a minimum, but only {rank} combinations of the parameters are determined");
            }
            Termination::RankDeficient { rank: 1 } => {
                "a minimum, but only one combination of the parameters is determined"
            }
            Termination::RankDeficient { .. } => {
                "nothing was found: the derivative by every parameter is 0 at every sample"
            }
            Termination::Minimax => "a minimum: no change near these coefficients lowers the largest error",
            Termination::GlobalMinimax => {
                "the global minimum, by proof to rounding (its bounds are computed in f64)"
            }
            Termination::Constrained => {
                "on the edge of what the constraints allow: no step within them gains anything to first order, and \
                 searches from beside it, where they leave room, end no lower"
            }
            Termination::ZeroResidual => "the formula reproduces the truth",
            Termination::NoParameters => "the formula has no free parameter: nothing was fitted",
            Termination::Saddle => {
                "saddles, left one after the other for lower ground beside them until no more were allowed: not \
                 known to be a minimum; give other starting values"
            }
            Termination::IterationCap => "the iterations were used up",
            Termination::Stalled => "no step made progress, short of a minimum",
            Termination::TooFewSamples => "fewer samples than parameters",
        };
        f.write_str(words)
    }
}

/// What second derivatives say of where a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SecondOrder {
    /// No direction of negative curvature leads to lower ground.
    Checked,
    /// Second derivatives could not be computed: beside the end the formula is not finite, or a
    /// divisor changes its sign.
    NotChecked,
    /// The search does not use them: it ended short of a minimum, reproduced the targets, has a
    /// proof over all coefficients, or is one of programs, which look at the first order and search
    /// from beside the end.
    Unused,
}

impl SecondOrder {
    /// The word for it in reports; none where second derivatives have no part in the search.
    pub fn name(self) -> Option<&'static str> {
        match self {
            SecondOrder::Checked => Some("checked"),
            SecondOrder::NotChecked => Some("not checked"),
            SecondOrder::Unused => None,
        }
    }
}

/// How far from the best possible the coefficients can be, as a part of the largest residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gap {
    /// Proven over all coefficients: max (1 - gap) is a lower bound on what the formula can reach
    /// on these samples.
    Global(f64),
    /// What the last linear program could still have gained near these coefficients; infinite if
    /// its trust region held every step back. Says nothing of other valleys.
    Local(f64),
    /// Not known: the goal is not the largest residual, or a part of all coefficients could be
    /// neither searched nor excluded.
    Unknown,
}

impl Gap {
    /// The number, if there is one.
    pub fn value(self) -> Option<f64> {
        match self {
            Gap::Global(gap) | Gap::Local(gap) => Some(gap),
            Gap::Unknown => None,
        }
    }
}

impl Fitted {
    /// Whether [`Fitted::undetermined`] says of this parameter that it does not matter, or has no
    /// derivative.
    pub fn is_idle(&self, parameter: &str) -> bool {
        [false, true].iter().any(|in_steps| self.undetermined.contains(&rank::idle(parameter, *in_steps)))
    }

    /// Whether [`Fitted::undetermined`] names this parameter.
    pub fn names_undetermined(&self, parameter: &str) -> bool {
        let quoted = format!("`{parameter}`");
        self.undetermined.iter().any(|sentence| sentence.contains(&quoted))
    }

    /// Whether the coefficients are where no step within the constraints gains anything to first
    /// order and searches from beside it end no lower: the second derivatives are not looked at.
    pub fn is_first_order(&self) -> bool {
        !self.constraints.is_empty() && self.stages.iter().any(|stage| stage.method == Method::Programs)
    }
}

/// A way to search.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// Levenberg-Marquardt on the residuals.
    LeastSquares,
    /// Levenberg-Marquardt on the residuals weighted by |residual|^(p-2).
    Power(f64),
    /// Linear programs in a trust region, or quadratic ones where the goal is not the maximum and
    /// there are constraints.
    Programs,
    /// Quadratic programs: of coefficients with one largest residual, those of the least mean
    /// square.
    Ties,
    /// Differential correction: linear programs whose solution is the best of all coefficients.
    DifferentialCorrection,
}

impl Method {
    /// A few words: `least squares`, ...
    pub fn name(self) -> &'static str {
        match self {
            Method::LeastSquares => "least squares",
            Method::Power(_) => "p-norm",
            Method::Programs => "sequential programs",
            Method::Ties => "least squares among ties",
            Method::DifferentialCorrection => "differential correction",
        }
    }
}

/// One stage of the search that gave the coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// How it searched.
    pub method: Method,
    /// How it ended.
    pub end: Termination,
    /// Largest residual where it ended.
    pub max: f64,
    /// Root of the mean square residual where it ended.
    pub rms: f64,
}

/// Coefficients found for a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// In the order of the parameters.
    pub coefficients: Vec<f64>,
    /// How the search ended.
    pub termination: Termination,
    /// Whether the end was checked to second order.
    pub second_order: SecondOrder,
    /// The norm asked for, over the samples.
    pub value: f64,
    /// Root of the mean square residual over the samples.
    pub rms: f64,
    /// Largest residual over the samples.
    pub max: f64,
    /// Evaluations of all samples (values or derivatives), over all starts.
    pub evaluations: u64,
    /// How far `max` may be from the best possible.
    pub gap: Gap,
    /// No coefficients bring the largest residual on these samples below this, by proof; none where
    /// nothing is proven.
    pub bound: Option<f64>,
    /// Combinations of parameters that the samples, and the constraints, determine.
    pub rank: usize,
    /// What is wrong with the others, in words that name the parameters: "`c` does not matter", ...
    pub undetermined: Vec<String>,
    /// Whether the formula determines no more of them at any start of the search: the formula's
    /// fault, and not that of where the search ended.
    pub undetermined_everywhere: bool,
    /// The stages of the search that led here, in order.
    pub stages: Vec<Stage>,
    /// How the constraints hold, in the order given.
    pub constraints: Vec<Held>,
}

/// How a constraint holds at its points, with coefficients rounded to f32 and the formula in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// The constraint's name.
    pub name: String,
    /// Largest violation, in units of the formula's value; 0 where it holds everywhere.
    pub worst: f64,
    /// What rounding of the coefficients may do to it: the violation that is accepted.
    pub tolerance: f64,
    /// Index of the point of the largest violation.
    pub at: usize,
    /// Number of points.
    pub points: usize,
}
