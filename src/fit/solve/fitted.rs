//! What a search hands back: coefficients, how it ended, and what is known of them.

/// How a fit has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Termination {
    /// Least squares or p-norm: the residuals, weighted by the norm, are orthogonal to the Jacobian within this cosine.
    Converged {
        /// Largest cosine between the residuals and a column of the Jacobian.
        cosine: f64,
    },
    /// Minimax: the linear programs found nothing more to gain near these coefficients.
    Minimax,
    /// Minimax: no coefficients whatsoever are better by more than the gap, by proof.
    GlobalMinimax,
    /// A minimum on the edge of what the constraints allow: the programs found no step within them that gains anything.
    Constrained,
    /// The formula reproduces the targets.
    ZeroResidual,
    /// The formula has no free parameters: there was nothing to fit.
    NoParameters,
    /// A minimum, but some coefficients are undetermined: the formula has more parameters than it needs.
    RankDeficient {
        /// Number of determined combinations of parameters.
        rank: usize,
    },
    /// No minimum though derivatives vanish: there is lower ground beside these coefficients, and leaving saddles led to saddles only.
    Saddle,
    /// Iterations used up.
    IterationCap,
    /// No step made progress, short of a minimum.
    Stalled,
    /// Fewer samples than parameters: the coefficients are the starting values.
    TooFewSamples,
}

impl Termination {
    /// Whether the coefficients are a minimum of the norm asked for.
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

/// How far from the best possible the coefficients can be, as a part of the largest residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gap {
    /// Proven over all coefficients: max (1 - gap) is a lower bound on what the formula can reach on these samples.
    Global(f64),
    /// What the last linear program could still have gained near these coefficients; infinite if its trust region held every step
    /// back. Says nothing of other valleys.
    Local(f64),
    /// Not known: the goal is not the largest residual, or a part of all coefficients could be neither searched nor excluded.
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

/// A way to search.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// Levenberg-Marquardt on the residuals.
    LeastSquares,
    /// Levenberg-Marquardt on the residuals weighted by |residual|^(p-2).
    Power(f64),
    /// Linear programs in a trust region, or quadratic ones where the goal is not the maximum and there are constraints.
    Programs,
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
    /// No coefficients bring the largest residual on these samples below this, by proof; none where nothing is proven.
    pub bound: Option<f64>,
    /// Combinations of parameters that the samples determine.
    pub rank: usize,
    /// What is wrong with the others, in words that name the parameters: "`c` does not matter", ...
    pub undetermined: Vec<String>,
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
