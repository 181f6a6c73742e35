//! What can be wrong with a fit or a measurement.

use lobefit_fit::FitError;
use lobefit_shade::ShadeError;
use lobefit_shade::code::CodeError;
use lobefit_truth::integrate::IntegrateError;

/// A linearly transformed cosine that is not made or measured.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LtcError {
    /// A truth that cannot be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// The text of the shader's function.
    #[error(transparent)]
    Shader(#[from] ShadeError),
    /// A language that cannot print it.
    #[error(transparent)]
    Code(#[from] CodeError),
    /// The solver.
    #[error("alpha {alpha}, mu {mu}: {source}")]
    Fit {
        /// Width of the lobe.
        alpha: f64,
        /// Cosine of the view.
        mu: f64,
        /// What it says.
        source: FitError,
    },
    /// A search without a place to begin at.
    #[error("alpha {alpha}, mu {mu}: `starts` is empty; give a matrix to begin at")]
    NoStart {
        /// Width of the lobe.
        alpha: f64,
        /// Cosine of the view.
        mu: f64,
    },
    /// A pair of tables whose parts contradict one another.
    #[error("{0}")]
    Shape(String),
    /// A value that is not a number.
    #[error("{what} is {value} at roughness {roughness}, mu {mu}")]
    NotFinite {
        /// What is not finite.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Where.
        roughness: f64,
        /// Where.
        mu: f64,
    },
}
